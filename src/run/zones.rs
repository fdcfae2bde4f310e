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
pub fn zones(solved: &Solved, at: usize, points: &[TracePoint]) -> Vec<summary::Zone> {
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
        summary::Zone {
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
pub fn without_singular_peaks(zones: &mut [summary::Zone]) {
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
pub fn missing_force(contact: &Contact, zones: &[summary::Zone], points: &[ContactPoint], force: f64) -> Option<f64> {
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
pub fn contact_estimate(force: Option<f64>, zones: &[summary::Zone]) -> summary::ContactEstimate {
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
        let zone = |pressure_max, share, lambda, peak| summary::Zone {
            pressure_max: Some(pressure_max),
            share: Some(share),
            lambda,
            peak: Some(peak),
            ..summary::Zone::default()
        };
        let all = [zone(1.0, 0.3, Some(0.02), 0.1), zone(3.0, 0.4, Some(0.05), 0.2), zone(2.0, 0.3, Some(0.03), 0.3)];
        let found = contact_estimate(Some(0.01), &all);
        assert_eq!((found.force, found.lambda, found.peak), (Some(0.01), Some(0.05), Some(0.2)));
        // What nobody would look at says nothing; what cannot be told of one zone is not of the contact.
        let faint = zone(0.01, 1e-3, Some(0.9), 0.9);
        assert_eq!(contact_estimate(None, &[all[0].clone(), faint]).lambda, Some(0.02));
        assert_eq!(contact_estimate(None, &[all[0].clone(), zone(1.0, 0.5, None, 0.1)]).lambda, None);
    }

    use crate::contact::{Known, SegmentRule};
    use crate::geometry::Point;
    use crate::system::samples::{blocks, contact, pair};

    /// Whether a pressure, given at the middles of uneven segments by their distance from an end, grows towards that end.
    fn grows(space: MultiplierSpace, end: usize, pressure: impl Fn(f64) -> f64, before: [Option<f64>; 2]) -> bool {
        let mut pair = pair(space, 1);
        let from_first = [0.0, 0.05, 0.2, 0.5, 0.8, 1.0];
        let fractions = from_first.map(|z| if end == 0 { z } else { 1.0 - z });
        let mut fractions = fractions.to_vec();
        fractions.sort_by(f64::total_cmp);
        pair.segments = SegmentRule::Fractions(fractions);
        let contact = contact(&blocks(pair, |_| Point::zeros(), Vec::new()), Known::default());
        let away = |k: usize| {
            let middle = 0.5 * (contact.boundary.arcs()[k] + contact.boundary.arcs()[k + 1]);
            if end == 0 { middle } else { 2.0 - middle }
        };
        let times = if space == MultiplierSpace::P0 { 1 } else { 2 };
        let values: Vec<f64> = (0..5).flat_map(|k| vec![pressure(away(k)); times]).collect();
        let active: Vec<bool> = vec![true; values.len()];
        let pressure = ContactPressure { contact: &contact, values: &values, active: &active };
        let zones = pressure.zones();
        assert_eq!(zones.len(), 1);
        grows_towards(&pressure, &zones[0], end, before)
    }

    #[test]
    fn a_pressure_grows_towards_an_end_if_it_does_so_ever_more_quickly() {
        for end in [0, 1] {
            let first = |pressure: &dyn Fn(f64) -> f64| grows(MultiplierSpace::P0, end, pressure, [None; 2]);
            assert!(first(&|r| 1.0 / r.sqrt()) && first(&|r| 4.0 - r + 0.1 * r * r));
            assert!(!first(&|r| 4.0 - r - 0.1 * r * r), "it grows, but less and less");
            assert!(!first(&|r| 4.0 - 0.1 * r + 0.01 * r * r), "next to even");
            assert!(!first(&|r| 1.0 + r * r) && !first(&|_| 1.0));
        }
    }

    #[test]
    fn a_pressure_is_singular_only_if_it_went_on_growing_with_each_mesh() {
        // In the segment at the end it is 2.
        let singular = |space, before, earlier| grows(space, 1, |r| 2.0 * (0.05 / r).sqrt(), [before, earlier]);
        let found = |before, earlier| singular(MultiplierSpace::P0, Some(before), Some(earlier));
        assert!(found(1.5, 1.0) && found(1.9, 1.8));
        assert!(!found(1.5, 0.7), "each time by much less");
        assert!(!found(1.97, 1.96), "next to nothing");
        assert!(!found(1.5, 1.6), "it fell before");
        assert!(!found(2.5, 1.0), "it falls");
        assert!(!singular(MultiplierSpace::P0, Some(1.5), None), "steps say nothing");
        assert!(singular(MultiplierSpace::P1Discontinuous, Some(1.5), None));
        assert!(!singular(MultiplierSpace::P1Discontinuous, Some(1.97), None));
    }

    #[test]
    fn a_zone_that_ends_inside_or_on_two_segments_is_not_singular() {
        let contact = contact(&blocks(pair(MultiplierSpace::P0, 10), |_| Point::zeros(), Vec::new()), Known::default());
        let found = |pressed: std::ops::Range<usize>, end: usize| {
            let power = |k: usize| 1.0 / (if end == 0 { k - pressed.start + 1 } else { pressed.end - k } as f64);
            let values: Vec<f64> = (0..10).map(|k| if pressed.contains(&k) { power(k) } else { 0.0 }).collect();
            let active: Vec<bool> = (0..10).map(|k| pressed.contains(&k)).collect();
            let pressure = ContactPressure { contact: &contact, values: &values, active: &active };
            grows_towards(&pressure, &pressure.zones()[0], end, [None; 2])
        };
        assert!(found(0..5, 0) && found(5..10, 1) && found(0..3, 0) && found(0..10, 1));
        assert!(!found(1..6, 0) && !found(4..9, 1) && !found(0..2, 0) && !found(8..10, 1));
    }

    /// Both ends of a zone that reaches them, and of one that does not.
    fn corners(upper: impl Fn(Point) -> Point, ends: Option<[f64; 2]>) -> [bool; 2] {
        let scene = blocks(pair(MultiplierSpace::P0, 8), upper, Vec::new());
        let contact = contact(&scene, Known { ends, ..Known::default() });
        let zone = |active: &[bool]| Zone::all(&contact.boundary, &contact.multipliers, &[1.0; 8], active).remove(0);
        let inner: Vec<bool> = (0..8).map(|k| (1..7).contains(&k)).collect();
        let of = |zone: &Zone| [0, 1].map(|end| ends_at_a_corner(&scene.mesh, &contact, zone, end));
        assert_eq!(of(&zone(&inner)), [false; 2]);
        of(&zone(&[true; 8]))
    }

    #[test]
    fn a_corner_is_where_one_body_ends_and_the_other_goes_on() {
        assert_eq!(corners(|_| Point::zeros(), None), [false; 2], "both end");
        assert_eq!(corners(|_| Point::new(0.3, 0.0), None), [true; 2]);
        assert_eq!(corners(|_| Point::new(-0.3, 0.0), None), [true; 2]);
        assert_eq!(corners(|x| Point::new(-0.5 * x.x, 0.0), None), [false, true]);
        assert_eq!(corners(|x| Point::new(0.5 * (2.0 - x.x), 0.0), None), [true, false]);
        assert_eq!(corners(|_| Point::zeros(), Some([0.25, 0.75])), [false; 2], "both go on");
    }

    #[test]
    fn missing_force_is_that_of_the_deepest_overlap_of_each_place_outside_the_zones() {
        // E is 2 and 6: their harmonic mean is 3.
        let contact = contact(&blocks(pair(MultiplierSpace::P0, 8), |_| Point::zeros(), Vec::new()), Known::default());
        let gaps = [-0.01, -0.03, -0.5, -0.5, -0.5, 0.1, -0.02, 0.2, f64::NAN, -0.005];
        let point = |(k, &gap): (usize, &f64)| ContactPoint {
            s: 0.25 * k as f64,
            gap,
            un_1: if gap.is_nan() { 99.0 } else { 0.1 },
            un_2: if k == 4 { 0.9 } else { -0.1 },
            ..ContactPoint::default()
        };
        let points: Vec<ContactPoint> = gaps.iter().enumerate().map(point).collect();
        let zone = summary::Zone { ends: Some([0.5, 1.0]), ..summary::Zone::default() };
        let near = |found: Option<f64>, wanted: f64| assert!((found.expect("a number") - wanted).abs() < 1e-12, "{found:?}");
        for force in [0.25, -0.25] {
            near(missing_force(&contact, std::slice::from_ref(&zone), &points, force), 0.5 * 3.0 * 0.055 / 0.25);
        }
        near(missing_force(&contact, &[], &points, 0.0), 0.5 / 0.8);
        assert_eq!(missing_force(&contact, &[], &[ContactPoint::default()], 0.0), None);
    }

    #[test]
    fn only_singular_zones_lose_the_error_of_their_peak() {
        let zone = |singular| summary::Zone { singular, peak: Some(0.1), ..summary::Zone::default() };
        let mut zones = [zone(Some(true)), zone(Some(false)), zone(None)];
        without_singular_peaks(&mut zones);
        assert_eq!(zones.map(|zone| zone.peak), [None, Some(0.1), Some(0.1)]);
    }
}
