//! Scenes that nobody wrote for mezha: no `converged` beside a wrong pressure.

#[path = "../support/mod.rs"]
mod support;

mod draw;
mod known;
mod layers;
mod profile;
mod reference;
mod run;
mod scene;
mod shape;
mod verdict;

use reference::Truth;
use verdict::{Kind, Row};

/// Draws a scene, runs it and compares.
fn one(seed: u64) -> Result<Row, String> {
    let (scene, settings) = draw::draw(seed);
    let truth = reference::truth(&scene, seed);
    let said = run::solve(&scene, &settings, &reference::folder(seed));
    let ends = scene.ends();
    let smooth = [scene.smooth_end(0), scene.smooth_end(1)];
    let apart = match (&truth, &said.profile) {
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
    if possible && apart.is_none() {
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
    Ok(Row { seed, kind, apart, said, words })
}

#[test]
#[ignore = "minutes: ci/scenes"]
fn long_form() {
    let number = |name: &str, default: u64| std::env::var(name).ok().and_then(|text| text.parse().ok()).unwrap_or(default);
    let (count, seed) = (number("SCENES", 10), number("SEED", 1));
    let mut rows = Vec::new();
    for seed in seed..seed + count {
        match one(seed) {
            Ok(row) => {
                println!("{}", row.line());
                rows.push(row);
            }
            Err(words) => println!("{words}"),
        }
    }
    for kind in [Kind::Right, Kind::Alarm, Kind::FalseAlarm, Kind::Quiet, Kind::Loud] {
        println!("{kind:?}: {}", rows.iter().filter(|row| row.kind == kind).count());
    }
}

#[test]
fn a_wrong_pressure_is_doubted() {
    let only = std::env::var("ONLY").unwrap_or_default();
    let outcomes: Vec<_> = known::all().iter().filter(|known| known.name.contains(&only)).map(|known| {
        let outcome = known.end();
        println!("{}", outcome.line);
        outcome
    }).collect();
    let bad = outcomes.iter().filter(|outcome| !outcome.good).count();
    println!("{bad} of {} bad, {} doubted", outcomes.len(), outcomes.iter().filter(|outcome| outcome.doubted).count());
    assert_eq!(bad, 0);
}
