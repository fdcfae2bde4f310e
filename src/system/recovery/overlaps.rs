//! Places where the bodies overlap: where nothing presses, and within single segments.

use super::{Evaluation, TracePoint};

/// Penetration below this share of the largest normal displacement is what the solve leaves.
const LEFT: f64 = 1e-7;

impl Evaluation<'_> {
    /// Force that is missing because bodies overlap where no segment presses, relative to the force found; without a force, the
    /// largest overlap relative to the largest relative displacement.
    ///
    /// A pressure p over a width w moves the boundary by about 2 p w/E; so an overlap δ asks for the force E δ/2, however wide.
    pub fn missing_force(&self, contact: usize, zones: &[[f64; 2]], points: &[TracePoint]) -> Option<f64> {
        let force = self.balance.contacts[contact].force;
        let modulus = self.problem.contacts[contact].modulus;
        let outside = |s: f64| !zones.iter().any(|&[from, to]| s >= from && s <= to);
        let (mut sum, mut deepest, mut largest, mut whole) = (0.0, 0.0f64, 0.0f64, 0.0f64);
        for point in points.iter().filter(|point| point.gap.is_finite()) {
            whole = whole.max((point.displacement[1] - point.displacement[0]).abs());
            let overlap = if outside(point.arc) { (-point.gap).max(0.0) } else { 0.0 };
            if overlap == 0.0 {
                sum += std::mem::take(&mut deepest);
            }
            deepest = deepest.max(overlap);
            largest = largest.max(overlap);
        }
        sum += deepest;
        let missing = if zones.is_empty() { largest / whole } else { 0.5 * modulus * sum / force.abs() };
        Some(missing).filter(|missing| missing.is_finite())
    }

    /// Force that would push the bodies out of each other where they penetrate at single points, `E_c/H ∫ max(0, -gap) ds` with
    /// the lengths H of the segments (force per thickness). It is small beside the force of a contact that spans some segments;
    /// contact that is narrower than a segment has one of the same size, or no force at all beside it.
    pub fn unresolved_force(&self, contact: usize, points: &[TracePoint]) -> f64 {
        let contact = &self.problem.contacts[contact];
        let arcs = contact.boundary.arcs();
        let moved = points.iter().map(largest).fold(0.0, f64::max);
        // `max` passes over points that a body has no part in.
        let depth = |p: &TracePoint| (-p.gap - LEFT * moved).max(0.0);
        let part = |ends: &[TracePoint]| {
            let [from, to] = [ends[0].arc, ends[1].arc];
            let segment = arcs.partition_point(|&s| s <= 0.5 * (from + to)).clamp(1, arcs.len() - 1);
            0.5 * (depth(&ends[0]) + depth(&ends[1])) * (to - from) / (arcs[segment] - arcs[segment - 1])
        };
        contact.modulus * points.windows(2).map(part).sum::<f64>()
    }
}

/// The larger one of both normal displacements.
fn largest(point: &TracePoint) -> f64 {
    point.displacement[0].abs().max(point.displacement[1].abs())
}
