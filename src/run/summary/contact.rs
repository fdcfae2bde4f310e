//! A contact in the terms of the summary.

use super::zones::{Zones, contact_estimate};
use crate::case::Choice;
use crate::contact::Configuration;
use crate::geometry::Point;
use crate::output::summary::{ContactEstimate, ContactSummary, ContactTrust};
use crate::procedure::Solved;
use crate::recovery::{Evaluation, TracePoint};

/// All figures of a contact, `at` its place among all, and the errors that are estimated of it; `points` are its traces.
pub fn contact(solved: &Solved, found: &Evaluation, at: usize, points: &[TracePoint]) -> (ContactSummary, ContactEstimate) {
    let Evaluation { problem, solution, balance, .. } = found;
    let pressure = found.pressure(at);
    let contact = pressure.contact;
    let boundary = &contact.boundary;
    let (force, penetration) = (&balance.contacts[at], &found.penetrations[at]);
    let point = |s: f64| -> [f64; 2] { boundary.point(boundary.parameter_at(s)).into() };
    let zones = Zones::new(solved, at, points);
    let closed = zones.closed();
    let corners = contact.pair.curve.is_found().then(|| found.corners(at, &zones.counting()));
    let is_reference = contact.pair.configuration == Configuration::Reference;
    let pressing = zones.arcs();
    let missing = is_reference.then(|| found.missing_force(at, &pressing, points));
    let at_ends = if is_reference { found.slip_at_ends(at, &pressing, points) } else { None };
    let motion = found.motions[at];
    // Where nothing presses, the growth of bodies that turn is compared with the smallest gap.
    let growth = || found.growth_by_gap(at, points).filter(|_| closed.is_empty());
    let described = ContactSummary {
        length: Some(boundary.length()),
        segments: Some(boundary.segments()),
        multiplier: Some(contact.pair.space.word().into()),
        h_ratio: Some(contact.segment_ratio),
        inf_sup: solution.inf_sup.get(at).copied().flatten(),
        ends: Some(boundary.ends().map(|t| boundary.point(t).into())),
        closed_edges: zones.closed_edges(),
        closed_points: Some(closed.iter().map(|ends| ends.map(point)).collect()),
        force: Some(force.force),
        unresolved_force: Some(found.unresolved_force(at, points)),
        resultant: Some(force.resultants[1].into()),
        place: pressure.centre().or_else(|| nearest(points)).map(Into::into),
        moment: Some(force.moments[1]),
        pressure_max: Some(pressure.largest()),
        oscillation: pressure.oscillation(),
        lost_points: Some(problem.coupling.lost[at] + points.iter().filter(|point| !point.is_complete()).count()),
        slip: motion.and_then(|motion| motion.slip),
        slip_at_ends: at_ends.map(|slip| slip.way),
        lost_at_ends: at_ends.map(|slip| slip.lost),
        slip_error: motion.and_then(|motion| motion.slip_error),
        rotation_error: motion.map(|motion| motion.rotation_error).or_else(growth),
        corner_angle: corners.as_ref().map(|corners| corners.angle.to_degrees()),
        corner_error: corners.as_ref().map(|corners| corners.error),
        missing: missing.and_then(|(share, _)| share),
        missing_force: missing.map(|(_, force)| force),
        missing_beyond: found.missing_beyond(at),
        depth: Some(penetration.depth),
        deepest: (penetration.depth > 0.0).then(|| penetration.place.into()),
        approach: Some(penetration.approach),
        zones: zones.summaries(corners.as_ref().map(|corners| corners.error)),
        closed: Some(closed),
        judged: ContactTrust::default(),
    };
    let estimate = contact_estimate(solved.estimate.force.get(at).copied().flatten(), &described.zones);
    (described, estimate)
}

/// Where the sides come nearest (length).
fn nearest(points: &[TracePoint]) -> Option<Point> {
    let nearest = points.iter().filter(|point| point.gap.is_finite()).min_by(|a, b| a.gap.total_cmp(&b.gap));
    nearest.map(|point| point.x)
}
