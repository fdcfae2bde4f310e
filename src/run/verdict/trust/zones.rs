//! Whether the zones of a contact are wide enough and fine enough for their pressure.

use super::doubt::Doubt;
use super::remedies::FINER;
use super::told::Unknown;
use crate::output::summary::{ContactSummary, ZoneSummary};
use crate::run::report::short;

/// On fewer edges, or fewer segments, the pressure of a zone is off by tens of per cent, unless the estimate proves it good.
pub(crate) const LEAST_PARTS: f64 = 4.0;

/// The largest sign of an error that proves a pressure good.
pub(crate) const PROVES: f64 = 0.05;

/// Signs of error that prove a pressure on one or two segments, too.
const NEXT_TO_NOTHING: f64 = 1e-3;

/// The same of λ in the middle of a zone that presses, and of the force of a zone.
pub const MOST_PRESSURE_ERROR: f64 = 0.08;

/// The same of λ all over a zone: where it falls to zero it is steep, and steps (`p0`) miss it by more than their means do.
const MOST_ERROR_ALL_OVER: f64 = 0.06;
const MOST_ERROR_OF_STEPS: f64 = 0.12;

/// The same of the largest λ of a zone.
const MOST_PEAK_ERROR: f64 = 0.12;

/// Share of the force of a contact from which that of a zone is judged.
const LEAST_FORCE_SHARE: f64 = 0.05;

/// Largest force, relative to that found, that overlaps of the bodies beside the zones may ask for; where nothing presses, the
/// largest overlap relative to the displacements.
const MOST_MISSING: [f64; 2] = [0.1, 1e-5];

/// What tells that zones are too narrow, or too coarse, for their pressure.
pub fn zone_doubts(contact: &ContactSummary, trust_force: Option<bool>, shorter: &'static str) -> Vec<Doubt> {
    let mut doubts = Vec::new();
    let zones = &contact.zones;
    for zone in zones.iter().filter(|zone| zone.counts(zones)) {
        let place = if zones.len() > 1 {
            zone.ends.map_or(String::new(), |[a, b]| format!(" at s = {} to {}", short(a), short(b)))
        } else {
            String::new()
        };
        let (edges, segments) = (zone.edges.unwrap_or(f64::NAN), zone.segments.unwrap_or(0));
        if is_concentrated(zone, trust_force) {
            continue;
        }
        let proved = is_proved(zone.worst) && edges >= 1.0 && is_divided(zone);
        let good = proved || is_proved(zone.lambda) && zone.worst.is_some_and(|worst| worst <= MOST_PEAK_ERROR);
        if edges < LEAST_PARTS && !proved {
            doubts.push(Doubt {
                cause: "contact is narrower than four edges",
                figure: format!("contact{place} {edges:.1} edges wide, at least {LEAST_PARTS} wanted"),
                remedy: FINER,
            });
        } else if (segments as f64) < LEAST_PARTS && !good {
            let words = format!("contact{place} on {segments} segments, at least {LEAST_PARTS} wanted");
            doubts.push(Doubt { cause: "contact lies on fewer than four segments", figure: words, remedy: shorter });
        }
        let force = zone.force.filter(|_| zone.share.is_some_and(|share| share.abs() >= LEAST_FORCE_SHARE));
        let steps = contact.multiplier.as_deref() == Some("p0");
        let most_all_over = if steps { MOST_ERROR_OF_STEPS } else { MOST_ERROR_ALL_OVER };
        let errors = [
            ("of λ", "λ is too inexact", zone.lambda, MOST_PRESSURE_ERROR),
            ("of λ up to the ends of contact", "λ is too inexact up to the ends of contact", zone.whole, most_all_over),
            ("of the largest λ", "the largest λ is too inexact", zone.peak, MOST_PEAK_ERROR),
            ("of the force", "the force is too inexact", force, MOST_PRESSURE_ERROR),
        ];
        for (what, cause, error, most) in errors {
            let wrong = error.filter(|error| *error > most);
            let figure = |error| format!("estimated error {what}{place} {error:.2}, at most {most} wanted");
            doubts.extend(wrong.map(|error| Doubt { cause, figure: figure(error), remedy: FINER }));
        }
    }
    let cause = "the bodies overlap where no segment presses";
    doubts.extend(overlaps(contact).then(|| Doubt { cause, figure: cause.into(), remedy: shorter }));
    doubts
}

/// What neither speaks for a pressure nor against it.
pub fn unknown_of(contact: &ContactSummary, trust_force: Option<bool>, remedy: &'static str) -> Option<Unknown> {
    let zones = &contact.zones;
    let counting = || zones.iter().filter(|zone| zone.counts(zones));
    if let Some(zone) = counting().find(|zone| is_concentrated(zone, trust_force)) {
        let edges = zone.edges.unwrap_or(f64::NAN);
        let words = format!(
            "the corner of a body presses on {edges:.1} edges: its force is to be trusted, its pressure is singular there"
        );
        return Some(Unknown { cause: "the corner of a body presses, the force is to be trusted", words, remedy: None });
    }
    let cause = "nothing estimates the error of its pressure";
    counting().any(|zone| zone.lambda.is_none() && !(is_proved(zone.worst) && is_divided(zone))).then(|| Unknown {
        cause,
        words: cause.into(),
        remedy: Some(remedy),
    })
}

/// Whether bodies overlap where no segment presses by what a force that counts would part.
pub fn overlaps(contact: &ContactSummary) -> bool {
    let [most, most_alone] = MOST_MISSING;
    contact.missing.is_some_and(|missing| missing > if contact.zones.is_empty() { most_alone } else { most })
}

/// A reaction at the corner of a body that no mesh resolves: the force is right.
fn is_concentrated(zone: &ZoneSummary, trust_force: Option<bool>) -> bool {
    zone.corner == Some(true) && zone.edges.is_some_and(|edges| edges < LEAST_PARTS) && trust_force == Some(true)
}

/// Whether its signs of error can tell anything: on one or two segments they may all be small beside the error, unless they
/// are next to nothing, as where the pressure is even.
fn is_divided(zone: &ZoneSummary) -> bool {
    zone.segments.is_some_and(|segments| segments > 2) || zone.worst.is_some_and(|worst| worst <= NEXT_TO_NOTHING)
}

pub fn is_proved(worst: Option<f64>) -> bool {
    worst.is_some_and(|worst| worst <= PROVES)
}
