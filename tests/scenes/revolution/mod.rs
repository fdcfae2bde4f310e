//! Random scenes of bodies of revolution, and what must hold in any of them.

mod case;
mod draw;
mod exact;

use crate::profile::Apart;
use crate::reference::{Truth, kept};
use crate::run::Said;
use crate::scene::{Press, Settings};
use crate::shape::Shape;
use crate::verdict::{self, Kind, Row, is_quiet};
use case::{Round, Upper};
use serde_json::Value;
use std::f64::consts::PI;
use std::path::{Path, PathBuf};

/// Forces of a body balance along the axis to this, by the largest of them: a thousand times the residual that is asked for.
const BALANCE: f64 = 1e-8;

/// What may pull, by the largest pressure.
const PULL: f64 = 1e-6;

/// How far bodies may overlap, by how far they have come together, where no word is said of it.
const OVERLAP: f64 = 0.05;

/// Draws a scene, runs it and compares. An error is a scene without a truth, in words.
pub fn one(seed: u64) -> Result<Row, String> {
    let (round, settings) = draw::draw(seed);
    let folder = folder(seed);
    let truth = match &round.exact {
        Some(exact) if exact.force == 0.0 => Truth::Unknown("nothing presses".into()),
        Some(exact) => Truth::Known(exact.clone()),
        None => truth(&round, settings.swapped, seed, &folder),
    };
    let said = round.solve(&settings, &folder);
    let mut row = crate::compared(seed, &round.scene, &settings, &truth, said)?;
    // A largest value of which the run itself says that it says nothing.
    if row.said.reason.contains("its largest value says nothing") && row.kind != Kind::FalseAlarm {
        let apart = row.apart.map(|apart| Apart { peak: 0.0, ..apart });
        row.kind = verdict::judge(&row.said, apart.as_ref());
    }
    // A mesh that is said to be too coarse, and is.
    if row.said.summary["status"] == "unresolved" && row.apart.is_some_and(|apart| apart.lambda() > 0.05) {
        row.kind = Kind::Alarm;
    }
    let known = if round.exact.is_some() { ", closed form" } else { "" };
    row.words = format!("{}{known} {:?}{}: {}", round.kind, round.upper, heat(&round), row.words);
    if let Some(fault) = fault(&round, &settings, &row.said).filter(|_| is_quiet(&row.said)) {
        row.kind = Kind::Loud;
        row.words += &format!(" FAULT: {fault}");
    }
    Ok(row)
}

fn heat(round: &Round) -> &'static str {
    if round.hot.iter().any(Option::is_some) { " hot" } else { "" }
}

/// Where everything of a scene is kept.
fn folder(seed: u64) -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).with_file_name("revolution").join(seed.to_string())
}

/// The finest run of the scene with the contact's bodies exchanged; where that tells nothing, as they are.
fn truth(round: &Round, swapped: bool, seed: u64, folder: &Path) -> Truth {
    let scene = &round.scene;
    let smooth = [scene.smooth_end(0), scene.smooth_end(1)];
    let flat = round.flattened();
    let reference = |swapped: bool| {
        let asked = |settings: &Settings| Settings { swapped, ..settings.clone() };
        let case = |settings: &Settings| flat.case(&asked(settings));
        kept(&flat.scene, smooth, seed, folder, case, |settings, folder| flat.solve(&asked(settings), folder))
    };
    match reference(!swapped) {
        Truth::Unknown(words) if !["can move", "nothing presses", "does not end"].iter().any(|known| words.contains(known)) => {
            match reference(swapped) {
                Truth::Unknown(other) => Truth::Unknown(format!("exchanged: {words}; as it is: {other}")),
                known => {
                    println!("{seed:6} exchanged: {}", words.trim());
                    known
                }
            }
        }
        known => known,
    }
}

/// What can be true of no scene: forces that do not balance, contact that pulls, bodies that overlap.
fn fault(round: &Round, settings: &Settings, said: &Said) -> Option<String> {
    let number = |path: &str| said.summary.pointer(path).and_then(Value::as_f64);
    let balance = number("/balance/bodies")?;
    if balance > BALANCE {
        return Some(format!("the bodies balance to {balance:.1e}"));
    }
    let (rest, size) = along_axis(round, settings, said)?;
    if number("/contact/c/force")? > 0.0 && rest.abs() > BALANCE * size {
        return Some(format!("forces along the axis on the upper body leave {:.1e}", rest / size));
    }
    let peak = said.trace.iter().map(|point| point.lambda).fold(0.0, f64::max);
    let pull = said.trace.iter().map(|point| -point.lambda).fold(0.0, f64::max);
    if pull > PULL * peak {
        return Some(format!("contact pulls by {:.1e}", pull / peak));
    }
    let [length, segments] = [number("/contact/c/length")?, number("/contact/c/segments")?];
    // Where λ is said to have no bound at an end, the last segment cannot follow it.
    let end = if is_singular_at_end(said) { length / segments } else { 0.0 };
    let within = said.trace.iter().filter(|point| (end..=length - end).contains(&point.s));
    let inside = within.map(|point| -point.gap).fold(0.0, f64::max);
    let approach = number("/contact/c/approach")?;
    (inside > OVERLAP * approach).then(|| format!("the bodies overlap by {:.1e} of their approach", inside / approach))
}

/// Whether the run says that pressure grows without bound towards an end.
fn is_singular_at_end(said: &Said) -> bool {
    let zones = said.summary.pointer("/contact/c/zones").and_then(Value::as_array);
    zones.into_iter().flatten().any(|zone| zone["singular_at_end"] == true)
}

/// Sum of the forces on the upper body along the axis, and of their sizes.
fn along_axis(round: &Round, settings: &Settings, said: &Said) -> Option<(f64, f64)> {
    let scene = &round.scene;
    let number = |path: &str| said.summary.pointer(path).and_then(Value::as_f64);
    let unit = scene.stress * scene.frame.scale.powi(2);
    let body = &scene.bodies[1];
    let applied = match (round.upper, scene.press) {
        (Upper::Plate(force) | Upper::Tool(force), _) => -force * unit,
        (Upper::Moved(_), _) => number("/rigid/tool/force/1")?,
        // A pressure on a straight line from one point to another; on a curve the meshes of P1 differ.
        (_, Press::Pressure { mean, tilt: 0.0 }) if !matches!(body.seam, Shape::Arc { .. }) => {
            let [[a, _], [b, _]] = body.range.map(|u| scene.frame.place([u, body.depth]));
            -mean * scene.stress * PI * (b * b - a * a)
        }
        (_, Press::Move(_) | Press::Sides) => 0.0,
        _ => return Some((0.0, 1.0)),
    };
    let contact = number("/contact/c/resultant/1")? * if settings.swapped { -1.0 } else { 1.0 };
    let supports = said.summary.pointer("/support").and_then(|all| all.as_object()).into_iter().flatten();
    let of_upper = supports.filter(|(name, _)| name.starts_with("upper") || *name == "press");
    let held: f64 = of_upper.filter_map(|(_, own)| own.pointer("/reaction/1")?.as_f64()).sum();
    let pressed = number("/contact/c/force")?;
    Some((applied + contact + held, applied.abs() + pressed + held.abs()))
}
