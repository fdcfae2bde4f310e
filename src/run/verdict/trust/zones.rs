//! Whether the zones of a contact are wide enough and fine enough for their pressure.

use super::told::Objection;
use crate::output::summary::{ContactSummary, ZoneSummary};
use crate::run::verdict::limits::*;
use crate::run::words::short;

/// What tells that zones are too narrow, or too coarse, for their pressure.
pub fn zone_doubts(contact: &ContactSummary, trust_force: Option<bool>) -> Vec<Doubt> {
    let counting = ZoneSummary::counting(&contact.zones).filter(|zone| !is_concentrated(zone, trust_force));
    let overlap = contact.missing.filter(|_| overlaps(contact)).map(|missing| OVERLAP.doubt(missing, &[]));
    counting.flat_map(|zone| doubts_of(zone, contact)).chain(overlap).collect()
}

/// What tells that one zone is.
fn doubts_of(zone: &ZoneSummary, contact: &ContactSummary) -> Vec<Doubt> {
    let place = zone.ends.filter(|_| contact.zones.len() > 1);
    let place = place.map_or(String::new(), |[a, b]| format!(" at s = {} to {}", short(a), short(b)));
    let named = [("place", place.as_str())];
    let edges = zone.edges.unwrap_or(f64::NAN);
    let proved = is_proved(zone.worst) && edges >= 1.0 && is_divided(zone);
    let good = proved || is_proved(zone.lambda) && zone.worst.is_some_and(|worst| worst <= PEAK.value);
    let segments = Some(zone.segments.unwrap_or(0) as f64);
    let narrow = EDGES.judge(zone.edges.filter(|_| !proved), &named);
    let narrow = narrow.or_else(|| SEGMENTS.judge(segments.filter(|_| !good), &named));
    let force = zone.force.filter(|_| zone.share.is_some_and(|share| share.abs() >= LEAST_FORCE_SHARE));
    let (all_over, at_end) =
        if contact.multiplier.as_deref() == Some("p0") { (&STEPS_ALL_OVER, &PEAK) } else { (&ALL_OVER, &PEAK_AT_END) };
    let highest = if zone.peak_at_end == Some(true) { at_end } else { &PEAK };
    let errors = [(&MIDDLE, zone.lambda), (all_over, zone.whole), (highest, zone.peak), (&ZONE_FORCE, force)];
    narrow.into_iter().chain(errors.into_iter().filter_map(|(limit, error)| limit.judge(error, &named))).collect()
}

/// What neither speaks for a pressure nor against it.
pub fn unknown_of(contact: &ContactSummary, trust_force: Option<bool>, remedy: String) -> Option<Objection> {
    if let Some(zone) = ZoneSummary::counting(&contact.zones).find(|zone| is_concentrated(zone, trust_force)) {
        let edges = zone.edges.unwrap_or(f64::NAN);
        let words = format!("the corner of a body presses on {edges:.1} edges: its pressure is singular there");
        return Some(Objection { cause: "the corner of a body presses, the force is to be trusted", words, remedy: None });
    }
    let cause = "nothing estimates the error of its pressure";
    let is_untold = |zone: &ZoneSummary| zone.lambda.is_none() && !(is_proved(zone.worst) && is_divided(zone));
    ZoneSummary::counting(&contact.zones).any(is_untold).then(|| Objection { cause, words: cause.into(), remedy: Some(remedy) })
}

/// Whether bodies overlap where no segment presses by what a force that counts would part.
pub fn overlaps(contact: &ContactSummary) -> bool {
    contact.missing.is_some_and(|missing| missing > if contact.zones.is_empty() { OVERLAP_ALONE } else { OVERLAP.value })
}

/// A reaction at the corner of a body that no mesh resolves: the force is right.
fn is_concentrated(zone: &ZoneSummary, trust_force: Option<bool>) -> bool {
    zone.corner == Some(true) && zone.edges.is_some_and(|edges| edges < EDGES.value) && trust_force == Some(true)
}

/// Width of a zone and length of the edges there: by what presses, and by what its force asks for.
pub fn width(zone: &ZoneSummary) -> Option<(f64, f64)> {
    let [from, to] = zone.ends?;
    let edge = (to - from) / zone.edges.filter(|edges| *edges > 0.0)?;
    Some((zone.hertz_width.map_or(to - from, |width| width.min(to - from)), edge))
}

/// Edges on the narrowest zone that counts; the corner of a body has as few on every mesh.
pub fn fewest_edges(contact: &ContactSummary) -> f64 {
    let wide = ZoneSummary::counting(&contact.zones).filter(|zone| zone.corner != Some(true) || zone.hertz_width.is_some());
    wide.filter_map(width).map(|(width, edge)| width / edge).fold(f64::INFINITY, f64::min)
}

/// Whether one of its zones lies on so few segments that its signs of error tell little.
pub fn is_on_few_segments(contact: &ContactSummary) -> bool {
    ZoneSummary::counting(&contact.zones).any(|zone| !is_divided(zone))
}

/// Whether its signs of error can tell anything.
fn is_divided(zone: &ZoneSummary) -> bool {
    zone.segments.is_some_and(|segments| segments > 2) || zone.worst.is_some_and(|worst| worst <= NEXT_TO_NOTHING)
}

pub fn is_proved(worst: Option<f64>) -> bool {
    worst.is_some_and(|worst| worst <= PROVES)
}
