//! Scenes that nobody wrote for mezha: no `converged` beside a wrong pressure.

#[path = "../support/mod.rs"]
mod support;

mod assembly;
mod draw;
mod known;
mod layers;
mod profile;
mod reference;
mod revolution;
mod run;
mod scene;
mod shape;
mod verdict;

use reference::Truth;
use run::Said;
use scene::{Scene, Settings};
use verdict::{Kind, Row, Totals, totals};

/// Draws a scene, runs it and compares. An error is a scene without a truth, in words.
fn one(seed: u64) -> Result<Row, String> {
    let (scene, settings) = draw::draw(seed);
    let truth = reference::truth(&scene, seed);
    let said = run::solve(&scene, &settings, &reference::folder(seed));
    compared(seed, &scene, &settings, &truth, said)
}

/// What a run of a scene is worth beside the truth.
fn compared(seed: u64, scene: &Scene, settings: &Settings, truth: &Truth, said: Said) -> Result<Row, String> {
    let ends = scene.ends();
    let smooth = [scene.smooth_end(0), scene.smooth_end(1)];
    let apart = match (truth, &said.profile) {
        (Truth::Known(truth), Some(own)) if scene.drawn_aside != 0.0 => {
            Some(own.moved(truth.centre() - own.centre()).apart(truth, ends, smooth))
        }
        (Truth::Known(truth), Some(own)) => Some(own.apart(truth, ends, smooth)),
        (Truth::Known(_), None) => None,
        (Truth::Unknown(words), _) if words.contains("can move") || words == "nothing presses" => None,
        (Truth::Unknown(words), _) => return Err(format!("{seed:6} dropped: {words}")),
    };
    let possible = matches!(truth, Truth::Known(_));
    let mut kind = verdict::judge(&said, apart.as_ref());
    // Bodies that do not touch are right without a pressure.
    let idle = matches!(truth, Truth::Unknown(words) if words == "nothing presses");
    if idle && said.code == Some(0) && said.profile.as_ref().is_some_and(|own| own.force == 0.0) {
        kind = if verdict::is_quiet(&said) { Kind::Right } else { Kind::FalseAlarm };
    }
    // A right scene that gets no answer, though nobody chose its segments badly.
    if possible && (apart.is_none() || said.code != Some(0) && settings.segments.is_none()) {
        kind = Kind::FalseAlarm;
    }
    let words = format!(
        "{} P{} {} refine {} segments {:?} ranks {}{}{}",
        settings.curve,
        settings.order,
        settings.space,
        settings.refine,
        settings.segments,
        settings.ranks,
        if settings.deformed { " deformed" } else { "" },
        if possible { "" } else { " impossible" },
    );
    Ok(Row { seed, kind, possible, apart, said, words })
}

/// Draws and runs scenes, says each, and adds them up.
fn many(seeds: impl Iterator<Item = u64>, one: impl Fn(u64) -> Result<Row, String>) -> Totals {
    let (mut rows, mut dropped) = (Vec::new(), 0);
    for seed in seeds {
        match one(seed) {
            Ok(row) => {
                println!("{}", row.line());
                rows.push(row);
            }
            Err(words) => {
                println!("{words}");
                dropped += 1;
            }
        }
    }
    totals(&rows, dropped)
}

/// The numbers of as many scenes as `SCENES` says, from the number `SEED` on.
fn numbers(count: u64) -> std::ops::Range<u64> {
    let number = |name: &str, default: u64| std::env::var(name).ok().and_then(|text| text.parse().ok()).unwrap_or(default);
    let (count, seed) = (number("SCENES", count), number("SEED", 1));
    seed..seed + count
}

/// `ci/scenes`.
#[test]
#[ignore = "hours: ci/scenes"]
fn two_hundred_scenes() {
    let totals = many(numbers(200), one);
    println!("{}", totals.text);
    assert!(totals.held, "{}", totals.text);
}

/// `ci/scenes revolution`.
#[test]
#[ignore = "half an hour: ci/scenes revolution"]
fn sixty_scenes_of_revolution() {
    let totals = many(numbers(60), revolution::one);
    println!("{}", totals.text);
    assert!(totals.held, "{}", totals.text);
}

/// `ci/scenes assemblies`.
#[test]
#[ignore = "half an hour: ci/scenes assemblies"]
fn two_hundred_assemblies() {
    let wrong = assembly::many(numbers(200));
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// The first twenty of few bodies, but for one on a curved tool, whose forces are off by 3 % as long as Γ_C lies on the tool's own
/// curve: it is solved with a doubt.
#[test]
fn twenty_assemblies() {
    let wrong = assembly::many((1..).filter(|seed| *seed != 4 && assembly::is_small(seed)).take(20));
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Bent bodies whose turn is held, and loads under which bodies roll off the places where they touch.
#[test]
fn turns_of_assemblies() {
    let wrong = assembly::many([47, 66, 67, 90].into_iter());
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// All goals hold on the first mesh, on which one contact presses on less than an edge: the mesh has to become finer there.
#[test]
fn an_assembly_with_a_contact_narrower_than_an_edge() {
    let wrong = assembly::many([89].into_iter());
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// A handful of them, on small meshes.
#[test]
fn a_handful_of_scenes() {
    let totals = many([3, 6, 9, 13].into_iter(), one);
    assert!(totals.held, "{}", totals.text);
}

/// Of revolution, as Lamé and Hertz know them.
#[test]
fn a_handful_of_scenes_of_revolution() {
    let totals = many([4, 27, 38, 40, 41].into_iter(), revolution::one);
    assert!(totals.all_right, "{}", totals.text);
}

/// Two at a time: ranks wait for each other more than for the processor.
#[test]
fn a_wrong_pressure_is_doubted() {
    let only = std::env::var("ONLY").unwrap_or_default();
    let all: Vec<_> = known::all().into_iter().filter(|known| known.name.contains(&only)).collect();
    let outcomes: Vec<_> = std::thread::scope(|scope| {
        let all = &all;
        let half = move |first: usize| all.iter().skip(first).step_by(2).map(|known| known.end()).collect::<Vec<_>>();
        let halves = [0, 1].map(|first| scope.spawn(move || half(first)));
        halves.into_iter().flat_map(|half| half.join().expect("scenes end")).collect()
    });
    outcomes.iter().for_each(|outcome| println!("{}", outcome.line));
    let bad: Vec<&str> = outcomes.iter().filter(|outcome| !outcome.good).map(|outcome| outcome.line.as_str()).collect();
    let doubted = outcomes.iter().filter(|outcome| outcome.doubted).count();
    println!("{} of {} bad, {doubted} doubted that have an answer", bad.len(), outcomes.len());
    assert!(bad.is_empty(), "{}", bad.join("\n"));
}
