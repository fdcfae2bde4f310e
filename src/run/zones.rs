//! What each zone of a contact that presses is, and what is estimated of its pressure.

use super::trust::{LEAST_PARTS, PROVES};
use crate::contact::{MultiplierSpace, Zone};
use crate::mesh::MacroMesh;
use crate::output::ContactPoint;
use crate::output::summary;
use crate::system::recovery::TracePoint;
use crate::system::{Contact, ContactPressure, Solved};

/// Growth of the pressure from the last segment but one to the last, and by one refinement, above which it may be singular at
/// an end.
const GROWS: f64 = 1.02;

/// Share of the growth by one refinement that the next one adds where λ goes like a power of the distance below zero: one or
/// more; where it is bounded a half or less.
const GOES_ON: f64 = 0.75;

/// Fewer segments say nothing of each other.
const LEAST_SEGMENTS: usize = 3;

/// Two ends are one if they are nearer than this share of the length.
const SAME: f64 = 1e-6;

/// The zones of contact `at`, in order of arc length; `points` are its traces.
pub fn zones(solved: &Solved, at: usize, points: &[TracePoint]) -> Vec<summary::ZoneSummary> {
    let Solved { problem, solution, estimate, .. } = solved;
    let contact = &problem.contacts[at];
    let pressure = solution.pressure(contact);
    let zones = pressure.zones();
    let forces: Vec<f64> = zones.iter().map(|zone| pressure.force_of(zone)).collect();
    let whole: f64 = forces.iter().map(|force| force.abs()).sum();
    let estimates = estimate.of_zones(at, &pressure, &zones, points);
    let describe = |(k, zone): (usize, &Zone)| {
        let (found, at_ends) = &estimates[k];
        let before = |end: usize| at_ends.map(|values| values.map(|values| values[end]));
        let singular = (0..2).any(|end| grows_towards(&pressure, zone, end, before(end)));
        let edges: f64 = zone.segments.clone().map(|k| contact.boundary.segment_length(k) / contact.edge_lengths[k]).sum();
        // All signs of a narrow zone may be small beside its error, unless they are very small.
        let wide = edges >= LEAST_PARTS && zone.segments.len() >= LEAST_SEGMENTS;
        let tells = |_: &f64| wide || found.worst.is_some_and(|worst| worst <= PROVES);
        summary::ZoneSummary {
            ends: Some(zone.arcs),
            edges: Some(edges),
            segments: Some(zone.segments.len()),
            share: Some(forces[k] / whole),
            pressure_max: Some(pressure.peak_of(zone)),
            lambda: found.pressure.filter(tells),
            whole: found.inside.filter(tells),
            worst: found.worst,
            force: found.force,
            peak: found.peak.filter(tells),
            singular: Some(singular),
            corner: Some((0..2).any(|end| ends_at_a_corner(&problem.scene.mesh, contact, zone, end))),
        }
    };
    zones.iter().enumerate().map(describe).collect()
}

/// Leaves out the errors of largest pressures that grow without bound.
pub fn without_singular_peaks(zones: &mut [summary::ZoneSummary]) {
    zones.iter_mut().filter(|zone| zone.singular == Some(true)).for_each(|zone| zone.peak = None);
}

/// Whether λ grows towards an end of Γ_C, ever more quickly, and without bound as meshes are refined, as far as the values
/// there on the mesh `before` and the one before that tell. Steps grow towards any steep end.
fn grows_towards(pressure: &ContactPressure, zone: &Zone, end: usize, [before, earlier]: [Option<f64>; 2]) -> bool {
    let contact = pressure.contact;
    if !touches(contact, zone, end) || zone.segments.len() < 3 {
        return false;
    }
    let nth = |i: usize| if end == 0 { zone.segments.start + i } else { zone.segments.end - 1 - i };
    let [a, b, c] = [0, 1, 2].map(|i| pressure.value(nth(i), 0.5));
    let lengths = [0, 1, 2].map(|i| contact.boundary.segment_length(nth(i)));
    let slopes = [(a - b) / (lengths[0] + lengths[1]), (b - c) / (lengths[1] + lengths[2])];
    let last = pressure.value(nth(0), if end == 0 { 0.05 } else { 0.95 });
    let grown = match (before, earlier) {
        (Some(before), Some(earlier)) => {
            last > GROWS * before && before > earlier && last - before > GOES_ON * (before - earlier)
        }
        (Some(before), None) => contact.multipliers.space != MultiplierSpace::P0 && last > GROWS * before,
        _ => true,
    };
    a > GROWS * b && slopes[0] > slopes[1] && grown
}

/// Whether a zone reaches an end of Γ_C.
fn touches(contact: &Contact, zone: &Zone, end: usize) -> bool {
    if end == 0 { zone.segments.start == 0 } else { zone.segments.end == contact.boundary.segments() }
}

/// Whether a zone reaches an end of Γ_C where one of the bodies has a corner and the other goes on.
fn ends_at_a_corner(mesh: &MacroMesh, contact: &Contact, zone: &Zone, end: usize) -> bool {
    let boundary = &contact.boundary;
    if !touches(contact, zone, end) || boundary.period().is_some() {
        return false;
    }
    let knots = boundary.knots();
    let (here, length) = (if end == 0 { knots[0] } else { knots[knots.len() - 1] }, knots[knots.len() - 1] - knots[0]);
    // How far each body's boundary goes on beyond the end.
    let beyond = contact.pair.between.each_ref().map(|name| {
        let edges = mesh.boundary(name).map(|boundary| boundary.edges.as_slice()).unwrap_or(&[]);
        let vertices = edges.iter().flat_map(|&edge| mesh.edges[edge as usize].vertices);
        let feet = vertices.map(|vertex| boundary.foot(mesh.vertices[vertex as usize]) - here);
        feet.map(|foot| if end == 0 { -foot } else { foot }).fold(f64::NEG_INFINITY, f64::max) / length
    });
    let least = beyond[0].min(beyond[1]);
    least.abs() < SAME && beyond[0].max(beyond[1]) > SAME
}

/// Force that is missing because bodies overlap where no segment presses, relative to the force found; without a force, the
/// largest overlap relative to the largest relative displacement.
///
/// A pressure p over a width w moves the boundary by about 2 p w/E; so an overlap δ asks for the force E δ/2, however wide.
pub fn missing_force(contact: &Contact, zones: &[summary::ZoneSummary], points: &[ContactPoint], force: f64) -> Option<f64> {
    let outside = |s: f64| !zones.iter().filter_map(|zone| zone.ends).any(|[from, to]| s >= from && s <= to);
    let (mut sum, mut deepest, mut largest, mut whole) = (0.0, 0.0f64, 0.0f64, 0.0f64);
    for point in points.iter().filter(|point| point.gap.is_finite()) {
        whole = whole.max((point.un_2 - point.un_1).abs());
        let overlap = if outside(point.s) { (-point.gap).max(0.0) } else { 0.0 };
        if overlap == 0.0 {
            sum += std::mem::take(&mut deepest);
        }
        deepest = deepest.max(overlap);
        largest = largest.max(overlap);
    }
    sum += deepest;
    let missing = if zones.is_empty() { largest / whole } else { 0.5 * contact.modulus * sum / force.abs() };
    Some(missing).filter(|missing| missing.is_finite())
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
}
