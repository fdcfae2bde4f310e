//! Assemblies run, and judged by statics.

use super::pile::{Assembly, draw};
use super::statics::Finding;
use crate::draw::Lot;
use crate::support::mesh::write_scene;
use crate::support::{Ended, Run};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

/// Forces on every body balance to this, as the program measures it.
const BALANCE: f64 = 1e-8;

/// And to this with weights of the exact areas; where statics knows each force, it is met as well.
const FORCE: f64 = 2e-2;

/// Statics knows the forces of bodies that lie as they are drawn. What the bodies move by under the load turns these forces in proportion to
/// it, what they move by through a clearance does not. Without a load, by the difference at all of it and at a tenth, the forces are met to
/// the error that is asked for; an error of the program would stay.
const WITHOUT_LOAD: f64 = 1e-2;

/// Bodies may be inside each other by this many forces by E: a seventh of Hertz's approach, F/πE* (2 ln(4R/b) - 1), which is
/// some 3 F/E at half widths b of R/50.
const OVERLAP: f64 = 0.45;

/// Iterations of a solve to 1e-11, at most, however many mean motions are held.
const ITERATIONS: u64 = 30;

/// Whether an assembly has few bodies, eight at most.
pub fn is_small(seed: &u64) -> bool {
    draw(&mut Lot::new(*seed)).members.len() <= 8
}

/// Runs assemblies of these numbers, says each, and tells those that are wrong; the folder keeps their files.
pub fn many(seeds: impl Iterator<Item = u64>) -> Vec<String> {
    let (mut wrong, mut times) = (Vec::new(), Vec::new());
    for seed in seeds {
        let assembly = draw(&mut Lot::new(seed));
        let finding = assembly.statics().finding();
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("target/assemblies").join(seed.to_string());
        std::fs::create_dir_all(&folder).expect("a folder");
        let file = write_scene(&folder, &assembly.mesh(), &assembly.case());
        let words = format!("{} bodies, {} contacts, {}", assembly.members.len(), assembly.touches.len(), name(&finding));
        let (verdict, seconds) = run(&file, 1 + (seed % 2) as usize, &assembly, &finding);
        times.extend(seconds);
        let line = format!(
            "{seed:6} {words}: {} ({:.1} s)",
            verdict.as_ref().map_or_else(|words| format!("WRONG: {words}"), |words| words.clone()),
            seconds.unwrap_or(f64::NAN)
        );
        println!("{line}");
        if verdict.is_err() {
            wrong.push(line);
        }
    }
    times.sort_by(f64::total_cmp);
    println!("{} wrong; median {:.1} s", wrong.len(), times.get(times.len() / 2).unwrap_or(&f64::NAN));
    wrong
}

fn name(finding: &Finding) -> &'static str {
    match finding {
        Finding::Forces(_) => "determinate",
        Finding::Indeterminate => "indeterminate",
        Finding::Loose => "loose",
        Finding::Driven => "driven",
    }
}

/// What was right, or what was wrong, and how long it took.
fn run(file: &Path, ranks: usize, assembly: &Assembly, finding: &Finding) -> (Result<String, String>, Option<f64>) {
    let Some(ended) = ended(file, ranks) else { return (Err("it does not end".into()), None) };
    let verdict = match (ended.code, finding) {
        (Some(0), Finding::Forces(forces)) => solved(&ended, assembly, Some(forces)).and_then(|off| match off {
            off if off <= FORCE => Ok(format!("solved, forces to {off:.0e}")),
            off => under_a_tenth(file, ranks, assembly, off),
        }),
        (Some(0), Finding::Indeterminate) => solved(&ended, assembly, None).map(|_| "solved".into()),
        (Some(3), Finding::Loose | Finding::Driven) => refused(&ended.said(), assembly),
        (Some(0), _) => Err("solved, though it cannot stand".into()),
        (code, _) => {
            let is_written = ended.out.join("summary.json").exists();
            Err(format!("exit {code:?}: {}", if is_written { ended.value("/reason").to_string() } else { ended.errors.clone() }))
        }
    };
    (verdict, Some(ended.time.as_secs_f64()))
}

/// A run, if it ends.
fn ended(file: &Path, ranks: usize) -> Option<Ended> {
    let run = Run::file(file);
    let run = if ranks == 1 { run.alone() } else { run.ranks(ranks) };
    catch_unwind(AssertUnwindSafe(|| run.ended())).ok()
}

/// Runs an assembly again whose forces are `off` those of statics, under a tenth of its load.
fn under_a_tenth(file: &Path, ranks: usize, assembly: &Assembly, off: f64) -> Result<String, String> {
    let mut light = assembly.clone();
    light.members.iter_mut().for_each(|member| member.load = member.load.map(|load| 0.1 * load));
    let Finding::Forces(forces) = light.statics().finding() else { return Err("statics depends on the load".into()) };
    let file = file.with_file_name("light.toml");
    std::fs::write(&file, light.case()).expect("a file can be written");
    let Some(ended) = ended(&file, ranks) else {
        return Err(format!("forces off by {off:.1e}, and under a tenth it does not end"));
    };
    if ended.code != Some(0) {
        return Err(format!("a force is off by {off:.1e} of the largest, and under a tenth: {}", ended.said()));
    }
    match solved(&ended, &light, Some(&forces))? {
        least if least <= FORCE && 10.0 * least - off <= 9.0 * WITHOUT_LOAD => {
            Ok(format!("solved, forces to {off:.0e}, under a tenth of the load to {least:.0e}"))
        }
        least => Err(format!("a force is off by {off:.1e} of the largest, under a tenth of the load by {least:.1e}")),
    }
}

/// Balance, forces that push, bodies that do not overlap; and by how much of the largest a force is off that of statics, if it
/// tells them.
fn solved(ended: &Ended, assembly: &Assembly, forces: Option<&Vec<f64>>) -> Result<f64, String> {
    let unit = assembly.young * assembly.scale;
    let balance = ended.number("/balance/bodies");
    if balance > BALANCE {
        return Err(format!("the bodies balance to {balance:.1e}"));
    }
    let iterations = ended.value("/solver/iterations");
    let most = iterations.as_array().into_iter().flatten().filter_map(serde_json::Value::as_u64).max();
    if most.is_none_or(|most| most > ITERATIONS) {
        return Err(format!("a solve takes {most:?} iterations"));
    }
    let mut sums: Vec<[f64; 2]> = assembly.members.iter().map(|member| member.load).collect();
    let mut top = 0.0f64;
    let mut found = Vec::new();
    for (k, touch) in assembly.touches.iter().enumerate() {
        let resultant = [0, 1].map(|c| ended.number(&format!("/contact/c{k}/resultant/{c}")) / unit);
        for (side, sign) in touch.pair.iter().zip([-1.0, 1.0]) {
            if let super::pile::Side::Member(member) = side {
                (0..2).for_each(|c| sums[*member][c] += sign * resultant[c]);
            }
        }
        found.push(resultant[0].hypot(resultant[1]));
        top = top.max(found[k]);
    }
    for (k, (sum, member)) in sums.iter().zip(&assembly.members).enumerate() {
        let rest = [if member.guided { 0.0 } else { sum[0] }, sum[1]];
        if rest[0].hypot(rest[1]) > 0.1 * FORCE * top {
            return Err(format!("the forces on b{k} leave {rest:?}, the largest is {top:.3e}"));
        }
    }
    for (k, force) in found.iter().enumerate() {
        let trace = ended.trace(&format!("c{k}"));
        let peak = trace.iter().map(|point| point.lambda).fold(0.0, f64::max);
        let pull = trace.iter().map(|point| -point.lambda).fold(0.0, f64::max);
        let inside = trace.iter().map(|point| -point.gap).fold(0.0, f64::max) / assembly.scale;
        if pull > 1e-6 * peak {
            return Err(format!("contact c{k} pulls by {pull:.1e} of {peak:.1e}"));
        }
        if inside > OVERLAP * force.max(0.01 * top) {
            return Err(format!("at contact c{k} bodies overlap by {inside:.1e}, its force is {force:.1e}"));
        }
    }
    let off = |forces: &Vec<f64>| forces.iter().zip(&found).map(|(exact, own)| (exact - own).abs()).fold(0.0, f64::max) / top;
    Ok(forces.map_or(0.0, off))
}

/// Refused with a motion of a body that contact and holds leave free, and loads do not resist.
fn refused(said: &str, assembly: &Assembly) -> Result<String, String> {
    let Some((member, motion, words)) = motion(said, assembly) else { return Err(format!("no motion is told: {said}")) };
    let known =
        |sign: f64| assembly.motions().into_iter().map(move |(k, c)| motion[c].filter(|_| k == member).map(|moves| sign * moves));
    if [1.0, -1.0].iter().any(|sign| assembly.statics().is_free(&known(*sign).collect::<Vec<_>>())) {
        Ok(format!("refused: {words}"))
    } else {
        Err(format!("not free: {words}"))
    }
}

/// "body b3 can move by (x, y)", "... can turn about (x, y)": the member and its motion, in one direction or the other. "... turns
/// most, by": a turn that contact stops too late, whatever shift goes with it.
fn motion(said: &str, assembly: &Assembly) -> Option<(usize, [Option<f64>; 3], String)> {
    const MOST: &str = " turns most, by ";
    let at = [" can move by (", " can turn about (", MOST].iter().find_map(|words| said.find(words))?;
    let name = said[..at].rsplit([' ', '.']).next()?;
    let member: usize = name.trim_start_matches('b').parse().ok().filter(|k| *k < assembly.members.len())?;
    let rest = &said[at..];
    if rest.starts_with(MOST) {
        return Some((member, [None, None, Some(1.0)], format!("{name}{MOST}too much")));
    }
    let numbers = &rest[rest.find('(')? + 1..rest.find(')')?];
    let [x, y] = numbers.split(", ").map(|number| number.parse().ok()).collect::<Option<Vec<f64>>>()?.try_into().ok()?;
    let words = format!("{name}{}", &rest[..=rest.find(')')?]);
    if rest.starts_with(" can move") {
        return Some((member, [x, y, 0.0].map(Some), words));
    }
    let middle = assembly.members[member].middle();
    let [x, y] = [middle[0] - x / assembly.scale, middle[1] - y / assembly.scale];
    Some((member, [-y, x, 1.0].map(Some), words))
}
