//! Sentences of limits, and what the documents say of them.

use super::*;
use crate::accuracy::{DEEPEST, NARROWEST, WORTH_WITHIN_SEGMENTS};
use crate::procedure::MOVES;

/// Every row of the table, with its figure.
const ROWS: [(&str, &Limit); 32] = [
    ("inf_sup", &INF_SUP),
    ("oscillation", &OSCILLATION),
    ("zones[].edges", &EDGES),
    ("zones[].segments", &SEGMENTS),
    ("zones[].lambda", &MIDDLE),
    ("zones[].whole", &ALL_OVER),
    ("zones[].whole", &STEPS_ALL_OVER),
    ("zones[].peak", &PEAK),
    ("zones[].peak", &PEAK_AT_END),
    ("zones[].force", &ZONE_FORCE),
    ("missing", &OVERLAP),
    ("unresolved_force", &WITHIN_SEGMENTS),
    ("zones[].cut_off", &CUT_OFF),
    ("estimate.energy", &ENERGY),
    ("estimate.NAME.force", &FORCE),
    ("corner_error", &CORNERS),
    ("shape_error", &SHAPE),
    ("balance.bodies", &BODY_BALANCE),
    ("balance.force", &SIDE_BALANCE),
    ("solver.residual", &RESIDUAL),
    ("slip_error", &SLIP),
    ("lost_at_ends", &LOST_AT_ENDS),
    ("slip_at_ends", &SLIP_AT_ENDS),
    ("slant", &SLANT),
    ("direction_error", &DIRECTION),
    ("cut_at_joint", &CUT_AT_JOINT),
    ("held_force", &HELD_FORCE),
    ("rotation_error", &TURNING),
    ("rotation_error", &GROWTH),
    ("rotation_max", &ROTATION),
    ("strain_max", &STRAIN),
    ("ν of P1 triangles", &P1_LOCKS),
];

/// A number as documents have it: `0.06`, `10⁻⁴`, `5·10⁻³`.
fn written(number: f64) -> String {
    if number >= 0.01 {
        return number.to_string();
    }
    let power = number.log10().floor() as i32;
    let digits = format!("{power}").replace('-', "⁻");
    let raised = "0123456789"
        .chars()
        .zip("⁰¹²³⁴⁵⁶⁷⁸⁹".chars())
        .fold(digits, |text, (digit, small)| text.replace(digit, &small.to_string()));
    match (number / 10f64.powi(power)).round() {
        1.0 => format!("10{raised}"),
        factor => format!("{factor}·10{raised}"),
    }
}

#[test]
fn a_sentence_is_filled_by_names_and_names_are_none() {
    let told = |value, named: &[(&str, &str)]| ROTATION.judge(Some(value), named).map(|doubt| doubt.figure);
    assert_eq!(told(0.2, &[]), None);
    assert_eq!(told(0.25, &[("of", "a {limit}")]).as_deref(), Some("body a {limit} turns by 0.25, at most 0.2 wanted"));
    assert_eq!(INF_SUP.judge(Some(0.1), &[]).map(|doubt| doubt.figure), None);
    assert_eq!(INF_SUP.judge(Some(0.05), &[]).expect("a doubt").figure, "inf-sup constant 0.050, at least 0.1 wanted");
    let turned = TURNING.judge(Some(0.0123), &[]).expect("a doubt").figure;
    assert!(turned.ends_with("wrong by about 0.012 (relative), at most 0.010 wanted"), "{turned}");
    assert!(RESIDUAL.judge(None, &[]).is_none() && RESIDUAL.judge(Some(f64::NAN), &[]).is_none());
}

/// Each row of the table stands in one of the tables of docs/method.md, with its figure and its limit.
#[test]
fn the_method_shows_every_limit() {
    let rows: Vec<Vec<&str>> =
        METHOD.lines().filter(|line| line.starts_with('|')).map(|line| line.split('|').collect()).collect();
    for (figure, limit) in ROWS {
        let has = |cells: &Vec<&str>| {
            let words = cells[2].split(|letter: char| letter.is_whitespace() || "(),;".contains(letter));
            cells[1].contains(figure) && words.into_iter().any(|word| word == written(limit.value))
        };
        assert!(rows.iter().any(has), "no row of docs/method.md has {figure} and {}", written(limit.value));
    }
}

#[test]
fn a_value_just_beyond_its_limit_is_told_from_it() {
    let told = |value| ALL_OVER.judge(Some(value), &[]).expect("a doubt").figure;
    assert!(
        told(0.0604).contains("0.0604, at most 0.06 wanted") && told(0.074).contains("0.07, at most 0.06 wanted"),
        "{}",
        told(0.0604)
    );
}

#[test]
fn a_limit_that_is_just_met_is_no_doubt() {
    assert!(EDGES.judge(Some(3.999_999_999_999), &[]).is_none());
    assert!(EDGES.judge(Some(3.9999), &[]).is_some_and(|doubt| doubt.figure.contains("3.9999 edges wide")));
}

const METHOD: &str = include_str!("../../../../docs/method.md");
const LIMITS: &str = include_str!("../../../../docs/limits.md");
const HARD_CASES: &str = include_str!("../../../../docs/hard-cases.md");

/// Limits that the documents have in their sentences.
#[test]
fn the_documents_say_the_limits_of_the_program() {
    let [strain, small, passed, moves, lost] =
        [STRAIN.value, SMALL_STRAIN, PASSED_THROUGH, MOVES, LOST_AT_ENDS.value].map(|share| format!("{} %", percent(share)));
    let [proves, nothing, share, edges] = [PROVES, NEXT_TO_NOTHING, LEAST_FORCE_SHARE, EDGES.value].map(written);
    let locks = P1_LOCKS.value;
    for (document, words) in [
        (METHOD, format!("`balance.bodies` is above {OUT_OF_BALANCE}")),
        (METHOD, format!("overlap by more than {passed} of the displacements")),
        (METHOD, format!("on less than {edges} edges")),
        (METHOD, format!("the force is estimated to {} %", percent(TRUSTED_FORCE))),
        (METHOD, format!("these signs are below {proves} ({nothing} on one or two segments)")),
        (METHOD, format!("unless λ is estimated to {proves} |")),
        (METHOD, format!("`worst` ≤ {}, or proved good", PEAK.value)),
        (METHOD, format!("force of a zone with {} % of the whole", percent(LEAST_FORCE_SHARE))),
        (METHOD, format!("`missing` where nothing presses {} of the displacement", written(OVERLAP_ALONE))),
        (METHOD, format!("`missing` at most {}", written(OVERLAP_ALONE))),
        (METHOD, format!("warning above {SMALL_STRAIN} |")),
        (METHOD, format!("| ≤ {LITTLE_SLIP}, or ≤ {} |", SLIP.value)),
        (METHOD, format!("how far they have come together | {DEEPEST} |")),
        (METHOD, format!("| {moves} of its length just before |")),
        (METHOD, format!("| {FORCE_OFF} of the force |")),
        (METHOD, format!("a warning comes above ν = {P1_STIFF}")),
        (
            LIMITS,
            format!(
                "Above {small} strain mezha warns; above {strain}, or where a triangle of the mesh file turns by more than {} radians",
                ROTATION.value
            ),
        ),
        (LIMITS, format!("lose more than {lost} of the contact by sliding")),
        (LIMITS, format!("Above ν = {locks} mezha trusts no pressure of P1 triangles")),
        (HARD_CASES, format!("mezha warns above {P1_STIFF} and trusts no pressure above {locks}")),
    ] {
        assert!(document.contains(&words), "no document says: {words}");
    }
    assert_eq!((share.as_str(), NARROWEST, WORTH_WITHIN_SEGMENTS), ("0.05", 1.0, 0.5), "an edge and half of the force, in words");
}
