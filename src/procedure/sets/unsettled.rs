//! Words for active sets that do not come to rest.

use crate::contact::{MultiplierSpace, SegmentRule, tidy};
use crate::discretisation::{Contact, Discretisation};

/// Segments that a verdict names at most.
const NAMED: usize = 4;

/// Words for a set that still changes after so many solves, with the multipliers that did last and what helps.
pub(crate) fn going_on(problem: &Discretisation, solves: usize, changed: &[usize]) -> String {
    let contacts = problem.contacts.iter().filter(|contact| changed.iter().any(|i| contact.range().contains(i)));
    let mut remedies: Vec<&str> = contacts.map(remedy).collect();
    remedies.dedup();
    format!(
        "the active set still changes after {solves} solves, the last time at {}; {}",
        places(problem, changed),
        remedies.join("; ")
    )
}

/// Contacts and segments of multipliers, in words: the first few of them.
pub(crate) fn places(problem: &Discretisation, multipliers: &[usize]) -> String {
    let mut places: Vec<String> = multipliers.iter().map(|&i| place(problem.contact_of(i), i)).collect();
    places.dedup();
    let more = if places.len() > NAMED { format!(" and {} more", places.len() - NAMED) } else { String::new() };
    places.truncate(NAMED);
    format!("{}{more}", places.join(", "))
}

/// What makes sets come to rest: multipliers that the displacements control.
fn remedy(contact: &Contact) -> &'static str {
    let jumps = !contact.jumps.is_empty() || contact.pair.space == MultiplierSpace::P1Continuous;
    match (contact.has_short_segments(), contact.pair.segments == SegmentRule::Auto) {
        (true, false) if jumps => "take fewer segments (\"auto\" is safe)",
        (true, false) => "take fewer segments (\"auto\" is safe), or stabilise = true",
        (_, true) => "take another multiplier space, or refine the mesh where contact is",
        _ => "take segments = \"auto\", another multiplier space, or refine the mesh where contact is",
    }
}

/// Contact and segment of a multiplier, in words.
pub(crate) fn place(contact: &Contact, multiplier: usize) -> String {
    let segment = contact.multipliers.segment_of(multiplier - contact.first);
    let ends = [contact.boundary.arcs()[segment], contact.boundary.arcs()[segment + 1]];
    let [s, t] = ends.map(|s| tidy(s, contact.boundary.length()));
    format!("contact {} segment {segment} (s = {s} ... {t})", contact.pair.name)
}
