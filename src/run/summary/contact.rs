//! A contact in the terms of the summary, with what each of its zones that presses is, and what is estimated of its pressure.

use crate::case::Choice;
use crate::contact::{Configuration, Zone};
use crate::geometry::Point;
use crate::output::summary::{ContactEstimate, ContactSummary, ContactTrust, ZoneSummary};
use crate::procedure::Solved;
use crate::recovery::{Evaluation, TracePoint};
use crate::run::verdict::limits::{EDGES, GROWS_AT_CORNERS, PROVES};
use std::f64::consts::SQRT_2;

/// All figures of a contact, `at` its place among all, and the errors that are estimated of it; `points` are its traces. **Collective**
pub fn contact(solved: &Solved, found: &Evaluation, at: usize, points: &[TracePoint]) -> (ContactSummary, ContactEstimate) {
    let Evaluation { problem, solution, balance, .. } = found;
    let pressure = found.pressure(at);
    let contact = pressure.contact;
    let boundary = &contact.boundary;
    let (force, penetration) = (&balance.contacts[at], &found.penetrations[at]);
    let point = |s: f64| -> [f64; 2] { boundary.point(boundary.parameter_at(s)).into() };
    let zones = pressure.zones();
    // On a closed boundary zones may go on beyond its seam, and intervals do not.
    let pressing: Vec<[f64; 2]> = zones.iter().map(|zone| zone.arcs).collect();
    let mut closed: Vec<[f64; 2]> = zones.iter().flat_map(Zone::intervals).collect();
    closed.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let counting = || pressure.counting(&zones, pressing.clone()).collect::<Vec<_>>();
    let corners = contact.pair.curve.is_found().then(|| found.corners(at, &counting()));
    let corner_error = corners.as_ref().map(|corners| corners.error);
    let is_reference = contact.pair.configuration == Configuration::Reference;
    let missing = is_reference.then(|| found.missing_force(at, &pressing, points));
    let at_ends = if is_reference { found.slip_at_ends(at, &pressing, points) } else { None };
    let (motion, shape_errors, joints) = (found.motions[at], found.shape_errors(at, points), found.smooth_joints(at));
    // Where nothing presses, the growth of bodies that turn is compared with the smallest gap.
    let growth = || found.growth_by_gap(at, points).filter(|_| closed.is_empty());
    let described = ContactSummary {
        length: Some(boundary.length()),
        segments: Some(boundary.segments()),
        multiplier: Some(contact.pair.space.word().into()),
        h_ratio: Some(contact.segment_ratio),
        inf_sup: solution.inf_sup.get(at).copied().flatten(),
        ends: Some(boundary.ends().map(|t| boundary.point(t).into())),
        closed_edges: zones.iter().map(|zone| contact.edges_on(zone)).reduce(f64::max),
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
        slant: motion.map(|motion| motion.slant),
        direction_error: motion.map(|motion| motion.direction_error),
        held_force: Some(found.held_forces[at]),
        cut_at_joint: Some(joints.cut),
        shares_with: joints.shared.into_iter().map(|other| problem.contacts[other].pair.name.clone()).collect(),
        corner_angle: corners.as_ref().map(|corners| corners.angle.to_degrees()),
        corner_error,
        shape_error: shape_errors.map(|[of_pressure, _]| of_pressure),
        shape_error_force: shape_errors.map(|[_, of_force]| of_force),
        missing: missing.and_then(|(share, _)| share),
        missing_force: missing.map(|(_, force)| force),
        missing_beyond: found.missing_beyond(at),
        depth: Some(penetration.depth),
        deepest: (penetration.depth > 0.0).then(|| penetration.place.into()),
        approach: Some(penetration.approach),
        zones: zone_summaries(solved, at, points, &zones, corner_error),
        closed: Some(closed),
        judged: ContactTrust::default(),
    };
    let estimate = contact_estimate(solved.estimate.force.get(at).copied().flatten(), &described);
    (described, estimate)
}

/// Where the sides come nearest (length).
fn nearest(points: &[TracePoint]) -> Option<Point> {
    let nearest = points.iter().filter(|point| point.gap.is_finite()).min_by(|a, b| a.gap.total_cmp(&b.gap));
    nearest.map(|point| point.x)
}

/// Fewer segments say nothing of each other.
const LEAST_SEGMENTS: usize = 3;

/// Each zone of contact `at` as the summary has it, in order of arc length; `points` are its traces, `corner_error` is what corners
/// within the contact do to λ.
fn zone_summaries(
    solved: &Solved,
    at: usize,
    points: &[TracePoint],
    zones: &[Zone],
    corner_error: Option<f64>,
) -> Vec<ZoneSummary> {
    let Solved { problem, solution, estimate, adaptation, .. } = solved;
    let contact = &problem.contacts[at];
    let pressure = solution.pressure(contact);
    let estimates = estimate.of_zones(at, &pressure, zones, points);
    // Meshes that adapt are refined there by more than one half, or by nothing.
    let goes_on = if adaptation.is_none() { estimate.peaks_go_on(at) } else { Vec::new() };
    let describe = |(k, share): (usize, f64)| {
        let (zone, (found, at_ends)) = (&zones[k], &estimates[k]);
        let before = |end: usize| at_ends.map(|values| values.map(|values| values[end]));
        let grows = (0..2).any(|end| pressure.grows_towards(&problem.scene, zone, end, before(end)));
        let goes_on = goes_on.get(k).is_none_or(|goes_on| *goes_on);
        let joint = pressure.grows_at_joint(zone).filter(|_| goes_on).map(|t| contact.boundary.point(t).into());
        let at_end = is_singular(grows, corner_error);
        let singular = at_end || joint.is_some();
        let edges = contact.edges_on(zone);
        // All signs of a narrow zone may be small beside its error, unless they are very small.
        let wide = edges >= EDGES.value && contact.segments_on(zone) >= LEAST_SEGMENTS;
        let tells = |_: &f64| wide || found.worst.is_some_and(|worst| worst <= PROVES);
        ZoneSummary {
            ends: Some(zone.arcs),
            edges: Some(edges),
            segments: Some(contact.segments_on(zone)),
            share: Some(share),
            hertz_width: pressure.hertz_width(zone, points),
            pressure_max: Some(pressure.peak_of(zone)),
            lambda: found.pressure.filter(tells),
            whole: found.inside.filter(tells),
            worst: found.worst,
            force: found.force,
            peak: peak_error(found.peak.filter(tells), singular).map(|error| error.max(pressure.variation_at_joints(zone))),
            peak_at_end: Some(pressure.peaks_at_end(zone)),
            singular: Some(singular),
            singular_at_end: Some(at_end),
            singular_at: joint,
            cut_off: Some(pressure.cut_off(&problem.scene.mesh, zone, &problem.contacts)),
            corner: Some((0..2).any(|end| pressure.ends_at_a_corner(&problem.scene.mesh, zone, end))),
        }
    };
    pressure.shares(zones).into_iter().enumerate().map(describe).collect()
}
/// Whether λ grows without bound towards an end: beside corners that matter it grows, too, and what looks singular may be one of
/// them.
fn is_singular(grows: bool, corner_error: Option<f64>) -> bool {
    grows && !corner_error.is_some_and(|error| error > GROWS_AT_CORNERS)
}

/// The error of the largest pressure, which has none where it grows without bound.
fn peak_error(estimated: Option<f64>, singular: bool) -> Option<f64> {
    estimated.filter(|_| !singular)
}

/// Estimated errors of the whole contact: those of its worst zone that counts, the peak of its highest, and what nobody knows of the
/// shapes of its sides. That is a root mean square of waves, whose crest is higher by √2.
fn contact_estimate(force: Option<f64>, ContactSummary { zones, shape_error, .. }: &ContactSummary) -> ContactEstimate {
    let shape = shape_error.unwrap_or(0.0);
    let lambda: Option<Vec<f64>> = ZoneSummary::counting(zones).map(|zone| zone.lambda).collect();
    let highest = zones.iter().max_by(|a, b| a.pressure_max.unwrap_or(0.0).total_cmp(&b.pressure_max.unwrap_or(0.0)));
    ContactEstimate {
        force,
        lambda: lambda.and_then(|all| all.into_iter().reduce(f64::max)).map(|error| error + shape),
        peak: highest.and_then(|zone| zone.peak).map(|error| error + SQRT_2 * shape),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn growth_beside_corners_that_matter_is_not_called_singular() {
        assert_eq!([None, Some(0.004), Some(0.006)].map(|error| is_singular(true, error)), [true, true, false]);
        assert!(!is_singular(false, None));
    }

    #[test]
    fn only_singular_zones_lose_the_error_of_their_peak() {
        assert_eq!([true, false].map(|singular| peak_error(Some(0.1), singular)), [None, Some(0.1)]);
    }

    #[test]
    fn a_contact_has_the_error_of_its_worst_zone_and_the_peak_of_its_highest() {
        let zone = |pressure_max, share, lambda, peak| ZoneSummary {
            pressure_max: Some(pressure_max),
            share: Some(share),
            lambda,
            peak: Some(peak),
            ..ZoneSummary::default()
        };
        let contact =
            |zones: &[ZoneSummary], shape_error| ContactSummary { zones: zones.into(), shape_error, ..Default::default() };
        let all = [zone(1.0, 0.3, Some(0.02), 0.1), zone(3.0, 0.4, Some(0.05), 0.2), zone(2.0, 0.3, Some(0.03), 0.3)];
        let found = contact_estimate(Some(0.01), &contact(&all, None));
        assert_eq!((found.force, found.lambda, found.peak), (Some(0.01), Some(0.05), Some(0.2)));
        // What nobody would look at says nothing; what cannot be told of one zone is not of the contact.
        let faint = zone(0.01, 1e-3, Some(0.9), 0.9);
        assert_eq!(contact_estimate(None, &contact(&[all[0].clone(), faint], None)).lambda, Some(0.02));
        assert_eq!(contact_estimate(None, &contact(&[all[0].clone(), zone(1.0, 0.5, None, 0.1)], None)).lambda, None);
        // A press fit by 32 chords had .032 of waves, and a largest λ 4.8 % too high.
        let waves = contact_estimate(Some(0.0), &contact(&[zone(1.0, 1.0, Some(3e-3), 5e-3)], Some(0.032)));
        assert_eq!((waves.force, waves.lambda), (Some(0.0), Some(0.035)));
        assert!(waves.peak.is_some_and(|error| (0.048..0.055).contains(&error)), "{waves:?}");
    }
}
