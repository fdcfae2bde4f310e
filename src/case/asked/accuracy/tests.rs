//! What a case may ask for, in which order, and in which words it is refused.

use std::path::Path;

use super::*;
use crate::case::Case;

/// A case with two contacts and two probes, and room for root keys before it.
const SCENE: &str = "mesh.file = 'a.msh'
body.a = { young = 1, poisson = 0.3 }
contact.seam = { between = ['p', 'q'], curve = 'line' }
contact.glue = { between = ['r', 's'], curve = 'line', law = 'bilateral' }
probe.tip = { point = [1, 2], body = 'a' }
probe.end = { point = [0, 0], body = 'a' }
";

/// A case without contacts and probes.
const LEAST: &str = "mesh.file = 'a.msh'\nbody.a = { young = 1, poisson = 0.3 }\n";

fn read(scene: &str, text: &str, overrides: &[&str]) -> Result<Case, String> {
    let overrides: Vec<String> = overrides.iter().map(ToString::to_string).collect();
    Case::parse(&format!("{scene}{text}"), Path::new("case.toml"), &overrides).map_err(|error| error.to_string())
}

/// The goals in words: `pressure seam 0.001`.
fn goals(scene: &str, text: &str, overrides: &[&str]) -> Vec<String> {
    let accuracy = read(scene, text, overrides).expect("a good case").accuracy.expect("an accuracy");
    let words = |goal: &Goal| format!("{} {} {}", goal.quantity.word(), goal.quantity.of().unwrap_or("-"), goal.tolerance);
    accuracy.goals.iter().map(words).collect()
}

#[test]
fn a_number_is_short_for_energy() {
    for text in ["accuracy = 1e-4", "accuracy.energy = 1e-4", "[accuracy]\nenergy = 1e-4"] {
        assert_eq!(goals(SCENE, text, &[]), ["energy - 0.0001"], "{text}");
    }
    assert_eq!(read(SCENE, "", &[]).unwrap().accuracy, None);
    assert!(!read(SCENE, "", &[]).unwrap().resolved().contains("accuracy"), "a case without it is as it was");
}

#[test]
fn goals_are_in_the_order_of_the_case() {
    let all =
        "[accuracy]\nstress = 0.1\ndisplacement = 0.05\npeak = 0.03\nends = 0.02\npressure = 1e-3\nforce = 1e-2\nenergy = 1e-4";
    let expected = [
        "energy - 0.0001",
        "force seam 0.01",
        "pressure seam 0.001",
        "peak seam 0.03",
        "ends seam 0.02",
        "force glue 0.01",
        "pressure glue 0.001",
        "peak glue 0.03",
        "displacement tip 0.05",
        "stress tip 0.1",
        "displacement end 0.05",
        "stress end 0.1",
    ];
    assert_eq!(goals(SCENE, all, &[]), expected);
}

#[test]
fn one_contact_overrides_and_adds() {
    let text = "[accuracy]\nforce = 1e-2\n[accuracy.contact.glue]\nforce = 1e-3\npressure = 0.1";
    assert_eq!(goals(SCENE, text, &[]), ["force seam 0.01", "force glue 0.001", "pressure glue 0.1"]);
    let limits = read(SCENE, "[accuracy]\nenergy = 0.5\nmax_unknowns = 100\nmax_seconds = 0.5", &[]).unwrap().accuracy.unwrap();
    assert_eq!((limits.most_unknowns, limits.most_seconds), (Some(100), Some(0.5)));
}

#[test]
fn the_command_line_takes_either_form_over_either() {
    let table = "[accuracy]\nforce = 1e-2";
    assert_eq!(goals(SCENE, "", &["accuracy=1e-3"]), ["energy - 0.001"]);
    assert_eq!(goals(SCENE, table, &["accuracy=1e-3"]), ["energy - 0.001"], "the whole table is replaced");
    assert_eq!(goals(LEAST, "accuracy = 1e-4", &["accuracy.energy=1e-3"]), ["energy - 0.001"]);
    let both = ["accuracy=1e-3", "accuracy.contact.seam.force=1e-2", "accuracy.max_seconds=5"];
    assert_eq!(goals(SCENE, "", &both), ["energy - 0.001", "force seam 0.01"]);
    let case = read(SCENE, "accuracy = 1e-4", &["accuracy.pressure=1e-3"]).unwrap();
    let again = read(&case.resolved(), "", &[]).unwrap();
    assert_eq!((&again.accuracy, again.resolved()), (&case.accuracy, case.resolved()), "reproduced");
}

#[test]
fn every_error_names_key_value_and_remedy() {
    let mut missed = Vec::new();
    let ranged = "must be a number from 1e-8 to 0.5, the relative error that is asked for";
    for (scene, overrides, expected) in [
        (SCENE, "accuracy=1e-9", &format!("accuracy = 1e-9 (--set): {ranged}; or a table [accuracy]")[..]),
        (SCENE, "accuracy=high", "accuracy = \"high\" (--set): must be a number from"),
        (SCENE, "accuracy.energy=0.6", &format!("accuracy.energy = 0.6 (--set): {ranged}")),
        (SCENE, "accuracy.stress=nan", "accuracy.stress = nan (--set): must be a number from"),
        (SCENE, "accuracy={}", "accuracy: asks for nothing; give energy = 1e-4"),
        (SCENE, "accuracy.max_seconds=1", "accuracy: asks for nothing"),
        (SCENE, "accuracy={energy = 0.1, max_seconds = 0}", "accuracy.max_seconds = 0 (--set): must be > 0"),
        (SCENE, "accuracy={energy = 0.1, max_unknowns = 99}", "must be a whole number of at least 100, such as 100000"),
        (SCENE, "accuracy={energy = 0.1, max_unknowns = 1e5}", "must be a whole number of at least 100"),
        (SCENE, "accuracy.enrgy=0.1", "accuracy.enrgy: unknown key; did you mean \"energy\"?"),
        (SCENE, "accuracy.contact.sam.force=0.1", "accuracy.contact.sam: no such contact; did you mean \"seam\"?"),
        (SCENE, "accuracy.contact.seam={}", "accuracy.contact.seam: asks for nothing; give force, pressure, peak or ends"),
        (SCENE, "accuracy.contact.seam=0.1", "accuracy.contact.seam = 0.1 (--set): must be a table"),
        (
            SCENE,
            "accuracy.contact.seam.energy=0.1",
            "accuracy.contact.seam.energy: unknown key; there are force, pressure, peak, ends",
        ),
        (SCENE, "accuracy.contact.glue.ends=0.1", "accuracy.contact.glue.ends = 0.1 (--set): contact.glue is bilateral"),
        (LEAST, "accuracy.force=0.1", "accuracy.force = 0.1 (--set): there is no contact in this case"),
        (
            LEAST,
            "accuracy.displacement=0.1",
            "accuracy.displacement = 0.1 (--set): there is no point to look at; write [probe.NAME]",
        ),
    ] {
        let words = read(scene, "", &[overrides]).map_or_else(|words| words, |_| "accepted".into());
        let own = words.lines().filter(|line| !line.contains("asks for nothing") || expected.contains("asks for nothing"));
        if !words.contains(expected) || own.count() != 1 {
            missed.push(format!("{overrides}: {words}\n  instead of {expected}"));
        }
    }
    assert!(missed.is_empty(), "{}", missed.join("\n"));
}

#[test]
fn ends_are_asked_of_unilateral_contacts() {
    assert_eq!(goals(SCENE, "accuracy.ends = 0.1", &[]), ["ends seam 0.1"]);
    let words = read(SCENE, "accuracy.ends = 0.1", &["contact.seam.law=bilateral"]).unwrap_err();
    assert!(words.contains("accuracy.ends = 0.1: every contact is bilateral"), "{words}");
}

#[test]
fn one_form_is_enough() {
    for text in [
        "accuracy = 1e-4\n[accuracy]\nforce = 0.1",
        "accuracy = 1e-4\naccuracy.force = 0.1",
        "accuracy.force = 0.1\naccuracy = 1e-4",
    ] {
        let words = read(LEAST, text, &[]).unwrap_err();
        assert!(words.contains("a number under accuracy is short for [accuracy] energy: give one of the two"), "{words}");
    }
}
