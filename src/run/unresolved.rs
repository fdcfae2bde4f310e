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
