//! Places where the bodies overlap: where nothing presses, and within single segments.
//!
//! If contact is narrower than a segment, the mean gap may be open although the bodies penetrate: then too small a force, or
//! none, solves the discrete problem. In all cases of `cases/` the force that overlaps within segments are worth is below 4 % of
//! that of the contact, in most 0.1 %; on a leaf that touches on half a segment it is 79 %.

use super::traces::TracePoint;
use crate::contact::{Penetration, SmoothSide, penetration};
use crate::discretisation::{BoundaryMotion, Contact, Discretisation, Solution};
use crate::geometry::Point;
use crate::mesh::EdgeNode;

/// Penetration below this share of the largest normal displacement is what the solve leaves.
const LEFT: f64 = 1e-7;

/// An overlap by less than this share of the largest displacement of all is rounding.
const ROUNDING: f64 = 1e-12;

/// Force that is missing because bodies overlap where no segment presses: relative to the force found, or, without a force, the
/// largest overlap relative to the largest relative displacement, 1 if that is smaller; and as it is (force per thickness; of the whole
/// ring in bodies of revolution).
///
/// A pressure p over a width w moves the boundary by about 2 p w/E; so an overlap δ asks for the force E δ/2, however wide. Bodies
/// have `moved` by so much at most (length).
pub fn missing_force(contact: &Contact, zones: &[[f64; 2]], points: &[TracePoint], force: f64, moved: f64) -> (Option<f64>, f64) {
    let within = |s: f64| zones.iter().any(|&[from, to]| s >= from && s <= to);
    // A zone of a closed boundary may go on across the seam.
    let outside = |s: f64| !within(s) && !contact.boundary.turn().is_some_and(|turn| within(s + turn));
    let (mut sum, mut deepest, mut largest, mut whole) = (0.0, 0.0f64, 0.0f64, 0.0f64);
    for point in points.iter().filter(|point| point.gap.is_finite()) {
        whole = whole.max((point.displacement[1] - point.displacement[0]).abs());
        let overlap = if outside(point.arc) && -point.gap > ROUNDING * moved { -point.gap } else { 0.0 };
        if overlap == 0.0 {
            sum += std::mem::take(&mut deepest);
        }
        deepest = deepest.max(contact.modulus_at(point.arc) * overlap * contact.boundary.width_at(point.x));
        largest = largest.max(overlap);
    }
    sum += deepest;
    let missing = if zones.is_empty() { largest / whole.max(largest) } else { 0.5 * sum / force.abs() };
    (Some(missing).filter(|missing| missing.is_finite()), 0.5 * sum)
}

/// Force that an overlap all `beyond` Γ_C (length) is worth, relative to the force found: `E δ/2`, however wide. Γ_C is the part that
/// presses on the first mesh, and what presses elsewhere on a finer one is lost: on a beam beside its clamp 3.4 % of the force, worth
/// 8 % by this.
pub fn missing_beyond(contact: &Contact, beyond: f64, force: f64) -> Option<f64> {
    let boundary = &contact.boundary;
    let modulus = contact.moduli.iter().copied().fold(0.0, f64::max);
    let width = boundary.width(boundary.parameter_at(0.5 * boundary.length()));
    Some(0.5 * modulus * beyond * width / force.abs()).filter(|missing| missing.is_finite())
}

/// Force that would push the bodies out of each other where they penetrate at single points, `E_c/H ∫ max(0, -gap) ds` with
/// the lengths H of the segments (force per thickness). It is small beside the force of a contact that spans some segments;
/// contact that is narrower than a segment has one of the same size, or no force at all beside it. Bodies have `moved` by so
/// much at most (length).
pub fn unresolved_force(contact: &Contact, points: &[TracePoint], moved: f64) -> f64 {
    let arcs = contact.boundary.arcs();
    let left = (LEFT * points.iter().map(TracePoint::largest_displacement).fold(0.0, f64::max)).max(ROUNDING * moved);
    // `max` passes over points that a body has no part in.
    let depth = |p: &TracePoint| (-p.gap - left).max(0.0);
    let part = |ends: &[TracePoint]| {
        let [from, to] = [ends[0].arc, ends[1].arc];
        let segment = contact.segment_at(0.5 * (from + to));
        let [a, b] = [0, 1].map(|k: usize| depth(&ends[k]) * contact.boundary.width_at(ends[k].x));
        let mean = 0.5 * (a + b);
        contact.moduli[segment] * mean * (to - from) / (arcs[segment + 1] - arcs[segment])
    };
    points.windows(2).map(part).sum::<f64>()
}

/// For each contact, with its force (per thickness, of a body of revolution that of the whole); ranks take them in turn. **Collective**
pub fn penetrations(problem: &Discretisation, solution: &Solution, forces: &[f64]) -> Vec<Penetration> {
    let motion = BoundaryMotion::new(&problem.scene, problem.finest(), &solution.displacement, &problem.session);
    let mut values = vec![0.0; 5 * problem.contacts.len()];
    for (at, contact) in
        problem.contacts.iter().enumerate().filter(|(at, _)| at % problem.session.size() == problem.session.rank())
    {
        let Penetration { depth, place, beyond, approach } = penetration_of(problem, &motion, contact, forces[at]);
        values[5 * at..5 * at + 5].copy_from_slice(&[depth, place.x, place.y, beyond, approach]);
    }
    problem.session.sum(&mut values);
    let found = |&[depth, x, y, beyond, approach]: &[f64; 5]| Penetration { depth, place: Point::new(x, y), beyond, approach };
    values.as_chunks().0.iter().map(found).collect()
}

/// Of one contact with its force, on bodies that have moved. Bodies that lie along each other from the beginning come together by what
/// strains them: a pressure p over a width w moves a boundary by about `2 p w/E`.
pub fn penetration_of(problem: &Discretisation, motion: &BoundaryMotion, contact: &Contact, force: f64) -> Penetration {
    let (mesh, space, boundary) = (&problem.scene.mesh, problem.finest(), &contact.boundary);
    let displacement = |node: EdgeNode| motion.at(node, mesh, space);
    let sides = SmoothSide::of_pair(mesh, &space.numbering, &contact.pair, &displacement);
    let [first, last] = boundary.ends();
    let away = |place| {
        let foot = boundary.foot(place);
        (foot - last).max(0.0) + (foot - first).min(0.0)
    };
    let found = penetration(&sides, &contact.pair, away);
    let softest = contact.moduli.iter().copied().fold(f64::INFINITY, f64::min);
    // The force of a body of revolution is that of the whole ring.
    let width = mesh.plane.width(boundary.point(boundary.parameter_at(0.5 * boundary.length())));
    Penetration { approach: found.approach.max(2.0 * force.abs() / (width * softest)), ..found }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::{Known, MultiplierSpace, SegmentRule};
    use crate::discretisation::samples::{blocks, contact, pair};
    use crate::geometry::Point;

    fn at(arc: f64, gap: f64, first: f64, second: f64) -> TracePoint {
        let (x, normal) = (Point::zeros(), Point::y());
        let displacement = [first, second];
        TracePoint { arc, x, normal, lambda: 0.0, displacement, slip: 0.0, stress: [0.0; 2], distance: [0.0; 2], gap }
    }

    #[test]
    fn overlap_between_points_is_a_force_by_the_length_of_their_segment() {
        let mut pair = pair(MultiplierSpace::P0, 1);
        pair.segments = SegmentRule::Fractions(vec![0.0, 0.25, 1.0]);
        let contact = contact(&blocks(pair, |_| Point::zeros(), Vec::new()), Known::default());

        // A ten-millionth of the largest displacement is 0.01.
        let points = [
            at(0.0, 0.2, 0.0, 3.0),
            at(0.25, -0.1, -1e5, 0.0),
            at(0.5, -0.005, f64::NAN, 7.0),
            at(1.0, -0.3, 1.0, -2e4),
            at(2.0, f64::NAN, 0.0, 0.0),
        ];
        // Trapezia of the depths 0.09 and 0.29 on segments of 0.5 and 1.5; E is 2 and 6, their harmonic mean 3.
        let wanted = 3.0 * (0.5 * 0.09 * 0.5 / 0.5 + 0.5 * 0.29 * 1.5 / 1.5);
        let found = unresolved_force(&contact, &points, 1.0);
        assert!((found - wanted).abs() < 1e-9, "{found} instead of {wanted}");
        assert_eq!(unresolved_force(&contact, &points[4..], 1.0), 0.0);
    }

    #[test]
    fn missing_force_is_that_of_the_deepest_overlap_of_each_place_outside_the_zones() {
        // E is 2 and 6: their harmonic mean is 3.
        let contact = contact(&blocks(pair(MultiplierSpace::P0, 8), |_| Point::zeros(), Vec::new()), Known::default());
        let gaps = [-0.01, -0.03, -0.5, -0.5, -0.5, 0.1, -0.02, 0.2, f64::NAN, -0.005];
        let point = |(k, &gap): (usize, &f64)| {
            at(0.25 * k as f64, gap, if gap.is_nan() { 99.0 } else { 0.1 }, if k == 4 { 0.9 } else { -0.1 })
        };
        let points: Vec<TracePoint> = gaps.iter().enumerate().map(point).collect();
        let near = |(found, worth): (Option<f64>, f64), wanted: f64, force: f64| {
            assert!((found.expect("a number") - wanted).abs() < 1e-12 && (worth - force).abs() < 1e-12, "{found:?}, {worth}")
        };
        for force in [0.25, -0.25] {
            near(missing_force(&contact, &[[0.5, 1.0]], &points, force, 1.0), 0.5 * 3.0 * 0.055 / 0.25, 0.5 * 3.0 * 0.055);
        }
        near(missing_force(&contact, &[], &points, 0.0, 1.0), 0.5 / 0.8, 0.5 * 3.0 * 0.525);
        assert_eq!(missing_force(&contact, &[], &[at(0.0, 0.0, 0.0, 0.0)], 0.0, 1.0), (None, 0.0));
    }
}
