//! Multiplier spaces on the segments of a contact boundary.

use super::contact_boundary::ContactBoundary;
use super::pair::MultiplierSpace;
use std::ops::Range;

/// Strength of the augmentation, `γ = α E_c / H`: a flat optimum, for every pair of spaces and up to three ranks.
const ALPHA: f64 = 3.0;

/// Strength of the augmentation beside a jump term.
const ALPHA_STABILISED: f64 = 2.0;

/// A diagonal block over one multiplier, or over the two of a discontinuous segment.
#[derive(Clone, Debug, PartialEq)]
pub struct DiagonalBlock {
    /// Multipliers it couples: one, or two that follow each other.
    pub rows: Range<usize>,
    /// Symmetric entries `[row][column]`; the unused ones are zero.
    pub values: [[f64; 2]; 2],
}

impl DiagonalBlock {
    fn single(row: usize, value: f64) -> Self {
        Self { rows: row..row + 1, values: [[value, 0.0], [0.0, 0.0]] }
    }

    /// The block with its sign changed.
    pub fn negative(&self) -> Self {
        Self { rows: self.rows.clone(), values: self.values.map(|row| row.map(|value| -value)) }
    }

    /// The inverse block.
    pub fn inverse(&self) -> Self {
        let [[a, b], [_, d]] = self.values;
        match self.rows.len() {
            1 => Self::single(self.rows.start, 1.0 / a),
            _ => {
                let determinant = a * d - b * b;
                Self {
                    rows: self.rows.clone(),
                    values: [[d / determinant, -b / determinant], [-b / determinant, a / determinant]],
                }
            }
        }
    }
}

/// The multipliers of one contact boundary, numbered along it. Linear ones are linear in the parameter of Γ_C, which
/// is its arc length on lines and circles only. On a closed boundary a continuous pressure goes on across the seam: its last
/// multiplier is its first.
#[derive(Clone, Debug)]
pub struct Multipliers {
    /// Space of the multipliers.
    pub space: MultiplierSpace,
    /// Strength `α` of the augmentation.
    pub alpha: f64,
    /// Segment lengths.
    lengths: Vec<f64>,
    /// `∫ψ_i w ds` with the width `w` of the boundary across the plane.
    integrals: Vec<f64>,
    /// Mean widths across the plane, `∫ψ_i w ds / ∫ψ_i ds`.
    widths: Vec<f64>,
    /// Whether the last segment is followed by the first.
    pub closed: bool,
}

impl Multipliers {
    /// The multipliers of a space on a boundary's segments.
    pub fn new(space: MultiplierSpace, boundary: &ContactBoundary) -> Self {
        let lengths = (0..boundary.segments()).map(|k| boundary.segment_length(k)).collect();
        let mut multipliers =
            Self { space, alpha: ALPHA, lengths, integrals: Vec::new(), widths: Vec::new(), closed: boundary.is_closed() };
        let mut plain = vec![0.0; multipliers.count()];
        multipliers.integrals = plain.clone();
        for (k, z, t, length) in boundary.gauss_by_parameter(10) {
            let (rows, values) = multipliers.on_segment(k, z);
            for a in 0..2 {
                plain[rows[a]] += length * values[a];
                multipliers.integrals[rows[a]] += length * boundary.width(t) * values[a];
            }
        }
        multipliers.widths = multipliers.integrals.iter().zip(plain).map(|(whole, plain)| whole / plain).collect();
        multipliers
    }

    /// These multipliers with the weaker augmentation that they have beside a jump term.
    pub fn stabilised(self) -> Self {
        Self { alpha: ALPHA_STABILISED, ..self }
    }

    /// Number of multipliers.
    pub fn count(&self) -> usize {
        let segments = self.lengths.len();
        match self.space {
            MultiplierSpace::P0 => segments,
            MultiplierSpace::P1Discontinuous => 2 * segments,
            MultiplierSpace::P1Continuous if self.closed => segments,
            MultiplierSpace::P1Continuous => segments + 1,
        }
    }

    /// Multipliers of segment `k` with their values at the fraction `z` of the segment; the second is unused for P0.
    /// Beyond the last segment of a closed boundary its first ones follow.
    pub fn on_segment(&self, k: usize, z: f64) -> ([usize; 2], [f64; 2]) {
        let segments = self.lengths.len();
        let k = if self.closed { k % segments } else { k };
        match self.space {
            MultiplierSpace::P0 => ([k, k], [1.0, 0.0]),
            MultiplierSpace::P1Discontinuous => ([2 * k, 2 * k + 1], [1.0 - z, z]),
            MultiplierSpace::P1Continuous if self.closed => ([k, (k + 1) % segments], [1.0 - z, z]),
            MultiplierSpace::P1Continuous => ([k, k + 1], [1.0 - z, z]),
        }
    }

    /// How many multipliers live on a segment.
    pub fn per_segment(&self) -> usize {
        if self.space == MultiplierSpace::P0 { 1 } else { 2 }
    }

    /// Value at the fraction `z` of segment `k`.
    pub fn value(&self, values: &[f64], k: usize, z: f64) -> f64 {
        let (rows, shapes) = self.on_segment(k, z);
        values[rows[0]] * shapes[0] + values[rows[1]] * shapes[1]
    }

    /// Segment that a multiplier is counted to: its own, or for a segment end the one before it.
    pub fn segment_of(&self, multiplier: usize) -> usize {
        match self.space {
            MultiplierSpace::P0 => multiplier,
            MultiplierSpace::P1Discontinuous => multiplier / 2,
            MultiplierSpace::P1Continuous => multiplier.saturating_sub(1),
        }
    }

    /// Length `H_i` that a multiplier stands for: its segment, or the lumped length of a segment end.
    pub fn length(&self, multiplier: usize) -> f64 {
        match self.space {
            MultiplierSpace::P1Continuous => self.beside(multiplier).map(|k| 0.5 * self.lengths[k]).sum(),
            _ => self.lengths[self.segment_of(multiplier)],
        }
    }

    /// Harmonic mean of what the segments beside a multiplier have; of one segment, but for those at segment ends.
    pub fn mean_beside(&self, multiplier: usize, of_segments: &[f64]) -> f64 {
        let beside = self.beside(multiplier);
        beside.clone().count() as f64 / beside.map(|k| 1.0 / of_segments[k]).sum::<f64>()
    }

    /// The segments beside a multiplier: its own, or those on both sides of a segment end.
    fn beside(&self, multiplier: usize) -> impl Iterator<Item = usize> + Clone {
        let segments = self.lengths.len();
        let both = match self.space {
            MultiplierSpace::P1Continuous if self.closed => [Some((multiplier + segments - 1) % segments), Some(multiplier)],
            MultiplierSpace::P1Continuous => [multiplier.checked_sub(1), Some(multiplier).filter(|&k| k < segments)],
            _ => [Some(self.segment_of(multiplier)), None],
        };
        both.into_iter().flatten()
    }

    /// Mean width across the plane where a multiplier counts: one (no unit) in the plane, a circumference (length) in a body of
    /// revolution.
    pub fn width(&self, multiplier: usize) -> f64 {
        self.widths[multiplier]
    }

    /// `∫ψ_i ds` (length); the area of the ring, `∫ψ_i 2πx ds`, in a body of revolution.
    pub fn integral(&self, multiplier: usize) -> f64 {
        self.integrals[multiplier]
    }

    /// `κ_i = γ_i / ∫ψ_i`: the pressure that one unit of weighted penetration is worth (stress per length squared). It
    /// scales the test of the active set; only its size matters.
    pub fn penalty(&self, multiplier: usize, modulus: f64) -> f64 {
        self.alpha * modulus / (self.length(multiplier) * self.integral(multiplier))
    }

    /// Augmentation weight `D_ii` of a multiplier alone (stress per length squared).
    pub fn single_weight(&self, multiplier: usize, modulus: f64) -> f64 {
        let mass = match self.space {
            MultiplierSpace::P1Discontinuous => self.length(multiplier) / 3.0,
            _ => self.length(multiplier),
        };
        self.alpha * modulus / (self.length(multiplier) * mass * self.width(multiplier))
    }

    /// Group of a multiplier: those of a group are coupled by `W`. A group is one multiplier, or the two of a discontinuous
    /// segment.
    pub fn group_of(&self, multiplier: usize) -> usize {
        if self.space == MultiplierSpace::P1Discontinuous { multiplier / 2 } else { multiplier }
    }

    /// How many groups there are; they have equally many multipliers, in the order of these.
    pub fn groups(&self) -> usize {
        if self.space == MultiplierSpace::P1Discontinuous { self.lengths.len() } else { self.count() }
    }

    /// Augmentation weights `D = √γ W⁻¹ √γ` with `γ_i = α E_c / H_i` over the active multipliers of one group, nothing if
    /// none is; `W` is the mass matrix, lumped for P1 continuous. `modulus` is `E_c` (stress); entries have the unit stress
    /// per length squared.
    pub fn augmentation(&self, group: usize, modulus: f64, active: &[bool]) -> Option<DiagonalBlock> {
        let one = |i: usize| DiagonalBlock::single(i, self.single_weight(i, modulus));
        if self.space != MultiplierSpace::P1Discontinuous {
            return active[group].then(|| one(group));
        }
        let (i, h) = (2 * group, self.lengths[group]);
        match (active[i], active[i + 1]) {
            (false, false) => None,
            (true, true) => {
                let unit = self.alpha * modulus / h * 2.0 / h;
                // `W` of a ring is the plane one between the roots of the widths: as strong, and no integral of its own.
                let [a, b] = [i, i + 1].map(|i| self.width(i).sqrt().recip());
                let across = -unit * a * b;
                Some(DiagonalBlock { rows: i..i + 2, values: [[2.0 * unit * a * a, across], [across, 2.0 * unit * b * b]] })
            }
            (first, _) => Some(one(if first { i } else { i + 1 })),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Curve, Point};

    const SPACES: [MultiplierSpace; 3] = [MultiplierSpace::P0, MultiplierSpace::P1Discontinuous, MultiplierSpace::P1Continuous];

    fn multipliers(space: MultiplierSpace) -> Multipliers {
        let mut boundary = ContactBoundary::new(Curve::Line([[0.0, 0.0], [2.0, 0.0]]), [0.0, 1.0], Point::new(0.0, 1.0));
        boundary.cut(&[0.0, 0.25, 0.5, 1.0]);
        Multipliers::new(space, &boundary)
    }

    #[test]
    fn values_sum_to_one_and_weights_to_the_length() {
        for space in SPACES {
            let m = multipliers(space);
            assert!((m.value(&vec![3.0; m.count()], 1, 0.3) - 3.0).abs() < 1e-14);
            assert!(((0..m.count()).map(|i| m.integral(i)).sum::<f64>() - 2.0).abs() < 1e-15);
        }
    }

    /// Around a circle, whatever the space, each multiplier has one before and one behind it.
    #[test]
    fn multipliers_of_a_closed_boundary_go_round() {
        let curve = Curve::Circle { centre: [0.0, 0.0], radius: 1.0 };
        let mut boundary = ContactBoundary::new(curve, [0.0, std::f64::consts::TAU], Point::new(-1.0, 0.0));
        boundary.cut(&[0.0, 0.1, 0.4, 1.0]);
        for (space, count) in SPACES.into_iter().zip([3, 6, 3]) {
            let m = Multipliers::new(space, &boundary);
            assert_eq!((m.count(), m.on_segment(1, 0.2)), (count, m.on_segment(4, 0.2)));
            let whole = |of: &dyn Fn(usize) -> f64| (0..m.count()).map(of).sum::<f64>() / std::f64::consts::TAU;
            assert!((whole(&|i| m.integral(i)) - 1.0).abs() < 1e-14);
            let times = if space == MultiplierSpace::P1Discontinuous { 2.0 } else { 1.0 };
            assert!((whole(&|i| m.length(i)) - times).abs() < 1e-14, "{space:?}");
            assert!((m.value(&vec![3.0; m.count()], 2, 0.9) - 3.0).abs() < 1e-14);
        }
        let continuous = Multipliers::new(MultiplierSpace::P1Continuous, &boundary);
        assert_eq!(continuous.value(&[5.0, 7.0, 9.0], 2, 1.0), 5.0, "the seam has one value");
    }

    /// `α E_c / (H m)` with the mass `m` of the multiplier alone: `∫ψ² ds`, or that of a whole row.
    #[test]
    fn a_multiplier_alone_has_the_inverse_of_its_own_mass() {
        for (space, mass) in [(MultiplierSpace::P0, 1.0), (MultiplierSpace::P1Discontinuous, 1.0 / 3.0)] {
            let m = multipliers(space);
            // The last segment has the length 1, the one before 0.5.
            let (last, before) = (m.count() - 1, m.count() - 1 - m.per_segment());
            assert!((m.single_weight(last, 7.0) / (7.0 * ALPHA / mass) - 1.0).abs() < 1e-14, "{space:?}");
            assert!((m.single_weight(before, 7.0) / (7.0 * ALPHA / (0.25 * mass)) - 1.0).abs() < 1e-14, "{space:?}");
        }
    }

    #[test]
    fn augmentation_inverts_the_mass_matrix() {
        let m = multipliers(MultiplierSpace::P1Discontinuous);
        let block = m.augmentation(2, 1.0, &[true; 6]).expect("active multipliers");
        let h = 1.0;
        let (unit, gamma) = (h / 6.0, ALPHA / h);
        let inverse = block.inverse();
        assert_eq!(inverse.rows, 4..6);
        for (i, row) in inverse.values.iter().enumerate() {
            for (j, value) in row.iter().enumerate() {
                let mass = if i == j { 2.0 * unit } else { unit };
                assert!((value * gamma - mass).abs() < 1e-15);
            }
        }
    }

    #[test]
    fn inactive_multipliers_have_no_weight() {
        for space in SPACES {
            let m = multipliers(space);
            let mut active = vec![true; m.count()];
            active[1] = false;
            let blocks = (0..m.groups()).filter_map(|group| m.augmentation(group, 7.0, &active));
            let rows: Vec<usize> = blocks.flat_map(|block| block.rows).collect();
            assert_eq!(rows, (0..m.count()).filter(|&i| i != 1).collect::<Vec<_>>());
        }
    }
}
