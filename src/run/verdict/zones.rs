//! What each zone of a contact that presses is, and what is estimated of its pressure.
//!
//! The limits of `whole` and `peak` were chosen on the 200 scenes of `ci/scenes`, of which 193 are sure enough: lines and arcs,
//! gaps with up to three humps, E from 1:1000 to 1000:1, edges from 1:20 to 20:1, all pairs of spaces, `refine` 1 to 3, against
//! solutions on much finer meshes. Of the 15 good pressures that are not trusted most are so for their `peak` or for `whole`.
//! `whole` by the true error: of 86 runs 72 are within 0.5 to 3, three below 0.3.

use crate::contact::{Zone, hertz_width};
use crate::output::summary;
use crate::procedure::Solved;
use crate::recovery::TracePoint;
use crate::run::verdict::trust::{LEAST_PARTS, PROVES};

/// Fewer segments say nothing of each other.
const LEAST_SEGMENTS: usize = 3;

/// The zones of contact `at`, in order of arc length; `points` are its traces.
pub fn zones(solved: &Solved, at: usize, points: &[TracePoint]) -> Vec<summary::ZoneSummary> {
    let Solved { problem, solution, estimate, .. } = solved;
    let contact = &problem.contacts[at];
    let pressure = solution.pressure(contact);
    let zones = pressure.zones();
    let forces: Vec<f64> = zones.iter().map(|zone| pressure.force_of(zone)).collect();
    let whole: f64 = forces.iter().map(|force| force.abs()).sum();
    let estimates = estimate.of_zones(at, &pressure, &zones, points);
    let gaps_at_rest = || points.iter().map(|point| [point.arc, contact.pair.gap.at_rest(point.x, point.distance)]);
    let width = |zone: &Zone| contact.boundary.width(contact.boundary.parameter_at(0.5 * (zone.arcs[0] + zone.arcs[1])));
    let describe = |(k, zone): (usize, &Zone)| {
        let (found, at_ends) = &estimates[k];
        let before = |end: usize| at_ends.map(|values| values.map(|values| values[end]));
        let singular = (0..2).any(|end| pressure.grows_towards(zone, end, before(end)));
        let edges = contact.edges_on(zone);
        // All signs of a narrow zone may be small beside its error, unless they are very small.
        let wide = edges >= LEAST_PARTS && zone.segments.len() >= LEAST_SEGMENTS;
        let tells = |_: &f64| wide || found.worst.is_some_and(|worst| worst <= PROVES);
        summary::ZoneSummary {
            ends: Some(zone.arcs),
            edges: Some(edges),
            segments: Some(zone.segments.len()),
            share: Some(forces[k] / whole),
            hertz_width: hertz_width(gaps_at_rest(), zone.arcs, forces[k] / width(zone), contact.compliance)
                .filter(|width| *width <= contact.boundary.length()),
            pressure_max: Some(pressure.peak_of(zone)),
            lambda: found.pressure.filter(tells),
            whole: found.inside.filter(tells),
            worst: found.worst,
            force: found.force,
            peak: found.peak.filter(tells),
            singular: Some(singular),
            corner: Some((0..2).any(|end| pressure.ends_at_a_corner(&problem.scene.mesh, zone, end))),
        }
    };
    zones.iter().enumerate().map(describe).collect()
}

/// Leaves out the errors of largest pressures that grow without bound.
pub fn without_singular_peaks(zones: &mut [summary::ZoneSummary]) {
    zones.iter_mut().filter(|zone| zone.singular == Some(true)).for_each(|zone| zone.peak = None);
}

/// Estimated errors of the whole contact: those of its worst zone that counts, the peak of its highest.
pub fn contact_estimate(force: Option<f64>, zones: &[summary::ZoneSummary]) -> summary::ContactEstimate {
    let lambda: Option<Vec<f64>> = zones.iter().filter(|zone| zone.counts(zones)).map(|zone| zone.lambda).collect();
    let highest = zones.iter().max_by(|a, b| a.pressure_max.unwrap_or(0.0).total_cmp(&b.pressure_max.unwrap_or(0.0)));
    summary::ContactEstimate {
        force,
        lambda: lambda.and_then(|all| all.into_iter().reduce(f64::max)),
        peak: highest.and_then(|zone| zone.peak),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_contact_has_the_error_of_its_worst_zone_and_the_peak_of_its_highest() {
        let zone = |pressure_max, share, lambda, peak| summary::ZoneSummary {
            pressure_max: Some(pressure_max),
            share: Some(share),
            lambda,
            peak: Some(peak),
            ..summary::ZoneSummary::default()
        };
        let all = [zone(1.0, 0.3, Some(0.02), 0.1), zone(3.0, 0.4, Some(0.05), 0.2), zone(2.0, 0.3, Some(0.03), 0.3)];
        let found = contact_estimate(Some(0.01), &all);
        assert_eq!((found.force, found.lambda, found.peak), (Some(0.01), Some(0.05), Some(0.2)));
        // What nobody would look at says nothing; what cannot be told of one zone is not of the contact.
        let faint = zone(0.01, 1e-3, Some(0.9), 0.9);
        assert_eq!(contact_estimate(None, &[all[0].clone(), faint]).lambda, Some(0.02));
        assert_eq!(contact_estimate(None, &[all[0].clone(), zone(1.0, 0.5, None, 0.1)]).lambda, None);
    }

    #[test]
    fn only_singular_zones_lose_the_error_of_their_peak() {
        let zone = |singular| summary::ZoneSummary { singular, peak: Some(0.1), ..summary::ZoneSummary::default() };
        let mut zones = [zone(Some(true)), zone(Some(false)), zone(None)];
        without_singular_peaks(&mut zones);
        assert_eq!(zones.map(|zone| zone.peak), [None, Some(0.1), Some(0.1)]);
    }
}
