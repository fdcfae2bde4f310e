//! Intervals of a contact boundary that press.

use super::{ContactBoundary, Multipliers};
use std::ops::Range;

/// Share of the length of a zone that counts as its middle: at its ends λ falls like a root, or is singular.
const MIDDLE: f64 = 0.6;

/// Share of it beside an end of the boundary that is left out of the rest.
const BESIDE: f64 = 0.1;

/// Neighbouring segments that carry pressure, with none beside them that does.
#[derive(Clone, Debug, PartialEq)]
pub struct Zone {
    /// Its segments.
    pub segments: Range<usize>,
    /// Arc lengths of its ends.
    pub arcs: [f64; 2],
    /// Arc lengths of the ends of its reach: half way to the next zone, or the end of the boundary.
    pub reach: [f64; 2],
    /// Whether it reaches the ends of the boundary.
    pub is_at_end: [bool; 2],
}

impl Zone {
    /// All zones of a boundary, in order of arc length. None where λ is zero all along: multipliers that are active there
    /// touch without pressure.
    pub fn all(boundary: &ContactBoundary, multipliers: &Multipliers, lambda: &[f64], active: &[bool]) -> Vec<Self> {
        if lambda.iter().all(|&pressure| pressure == 0.0) {
            return Vec::new();
        }
        let presses = |k: usize| multipliers.on_segment(k, 0.0).0.iter().any(|&i| active[i]);
        let mut ranges: Vec<Range<usize>> = Vec::new();
        for k in (0..boundary.segments()).filter(|&k| presses(k)) {
            match ranges.last_mut() {
                Some(range) if range.end == k => range.end = k + 1,
                _ => ranges.push(k..k + 1),
            }
        }
        let arcs = boundary.arcs();
        let between = |k: usize| match k {
            0 => 0.0,
            k if k == ranges.len() => boundary.length(),
            k => 0.5 * (arcs[ranges[k - 1].end] + arcs[ranges[k].start]),
        };
        let zone = |(k, range): (usize, &Range<usize>)| Self {
            segments: range.clone(),
            arcs: [arcs[range.start], arcs[range.end]],
            reach: [between(k), between(k + 1)],
            is_at_end: [range.start == 0, range.end == boundary.segments()],
        };
        ranges.iter().enumerate().map(zone).collect()
    }

    /// Arc length of it.
    pub fn length(&self) -> f64 {
        self.arcs[1] - self.arcs[0]
    }

    /// Whether an arc length lies in its middle.
    pub fn has_in_its_middle(&self, arc: f64) -> bool {
        ((arc - self.arcs[0]) / self.length() - 0.5).abs() <= 0.5 * MIDDLE
    }

    /// Whether an arc length lies in it, and not beside an end of the boundary, where λ may be singular.
    pub fn has_inside(&self, arc: f64) -> bool {
        let beside = |end: usize| if self.is_at_end[end] { BESIDE * self.length() } else { 0.0 };
        arc >= self.arcs[0] + beside(0) && arc <= self.arcs[1] - beside(1)
    }

    /// `∫λ ds` (force per thickness).
    pub fn force(&self, multipliers: &Multipliers, lambda: &[f64]) -> f64 {
        let first = multipliers.on_segment(self.segments.start, 0.0).0[0];
        let rows = multipliers.on_segment(self.segments.end - 1, 0.0).0;
        (first..=rows[0].max(rows[1])).map(|i| lambda[i] * multipliers.weight(i)).sum()
    }

    /// Largest pressure (stress).
    pub fn peak(&self, multipliers: &Multipliers, lambda: &[f64]) -> f64 {
        let ends = self.segments.clone().flat_map(|k| [0.0, 1.0].map(|z| multipliers.value(lambda, k, z)));
        ends.fold(f64::NEG_INFINITY, f64::max)
    }
}
