//! Penetration that the multipliers do not see, because it lies between larger gaps within one segment.

use crate::output::ContactPoint;
use crate::system::Contact;

/// Penetration below this share of the largest normal displacement is what the solve leaves.
const LEFT: f64 = 1e-7;

/// Force that would push the bodies out of each other where they penetrate at single points, `E_c/H ∫ max(0, -gap) ds` with
/// the lengths H of the segments (force per thickness). It is small beside the force of a contact that spans some segments;
/// contact that is narrower than a segment has one of the same size, or no force at all beside it.
pub fn unresolved_force(contact: &Contact, points: &[ContactPoint]) -> f64 {
    let arcs = contact.boundary.arcs();
    let moved = points.iter().map(|p| p.un_1.abs().max(p.un_2.abs())).fold(0.0, f64::max);
    // `max` passes over points that a body has no part in.
    let depth = |p: &ContactPoint| (-p.gap - LEFT * moved).max(0.0);
    let part = |ends: &[ContactPoint]| {
        let [from, to] = [ends[0].s, ends[1].s];
        let segment = arcs.partition_point(|&s| s <= 0.5 * (from + to)).clamp(1, arcs.len() - 1);
        0.5 * (depth(&ends[0]) + depth(&ends[1])) * (to - from) / (arcs[segment] - arcs[segment - 1])
    };
    contact.modulus * points.windows(2).map(part).sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::{Known, MultiplierSpace, SegmentRule};
    use crate::geometry::Point;
    use crate::system::samples::{blocks, contact, pair};

    #[test]
    fn overlap_between_points_is_a_force_by_the_length_of_their_segment() {
        let mut pair = pair(MultiplierSpace::P0, 1);
        pair.segments = SegmentRule::Fractions(vec![0.0, 0.25, 1.0]);
        let contact = contact(&blocks(pair, |_| Point::zeros(), Vec::new()), Known::default());
        let point = |s, gap, un_1, un_2| ContactPoint { s, gap, un_1, un_2, ..ContactPoint::default() };
        // A ten-millionth of the largest displacement is 0.01.
        let points = [
            point(0.0, 0.2, 0.0, 3.0),
            point(0.25, -0.1, -1e5, 0.0),
            point(0.5, -0.005, f64::NAN, 7.0),
            point(1.0, -0.3, 1.0, -2e4),
            point(2.0, f64::NAN, 0.0, 0.0),
        ];
        // Trapezia of the depths 0.09 and 0.29 on segments of 0.5 and 1.5; E is 2 and 6, their harmonic mean 3.
        let wanted = 3.0 * (0.5 * 0.09 * 0.5 / 0.5 + 0.5 * 0.29 * 1.5 / 1.5);
        let found = unresolved_force(&contact, &points);
        assert!((found - wanted).abs() < 1e-9, "{found} instead of {wanted}");
        assert_eq!(unresolved_force(&contact, &points[4..]), 0.0);
    }
}
