//! The jump term that heals a multiplier space too rich for the displacements.
//!
//! `C = δ (h / E_c) Σ H [ψ_i] [ψ_j]` in place of the zero block, over the jumps between neighbouring values: at the
//! inner segment ends, at the seam of a closed boundary and, for linear λ, across each segment. For continuous P1 that is twelve
//! times `∫(λ - Πλ)²`, Π the mean of a segment (Dohrmann, Bochev 2004; Bochev, Dohrmann, Gunzburger 2006). `h` is the length of the
//! softer body's edges and `H` that of the segments, both means of the segments beside. It vanishes with `h H` for a smooth pressure.
//!
//! `h` is local: on `bars_inclined/graded.toml` with 400 even segments the energy is off by 2.4e-9, with the longest edge
//! everywhere it was 2.5e-7. Measured on example 1, 17 000 unknowns, `direct`: H/h, and the largest error of λ at x = 1.2 to 4.8
//! without and with the term. The oscillation is between 0.13 and 0.9 where the error is above 0.1, and below 2e-3 elsewhere.
//! `fieldsplit` agrees, in 11 to 14 iterations with the term.
//!
//! | segments | P1/`p0` | P2/`p0` | P2/`p1-discontinuous` |
//! |---|---|---|---|
//! | 60 | 1.60: 3.5e-4, 2.5e-4 | 0.80: 5.2e-5, 4.5e-5 | 0.80: 3.0e-4, 2.4e-5 |
//! | 120 | 0.80: 2.0e-4, 2.1e-4 | 0.40: 1.0e-4, 1.3e-5 | 0.40: 1.9e3, 8.7e-6 |
//! | 176 | 0.55: 1.3e-1, 5.4e-4 | 0.27: 2.3e-1, 6.0e-4 | 0.27: 3.7e4, 2.8e-4 |
//! | 352 | 0.27: 1.3e10, 5.1e-4 | 0.14: 6.5e5, 2.8e-4 | 0.14: not solved, 1.3e-4 |
//!
//! The same of `p1-continuous` (`even.toml`, `fieldsplit`, 66 000 unknowns): with P1 1.09: 8.2e-5, 6.1e-5 and 0.55: not solved, 8.9e-5;
//! with P2 0.80: 1.3e-5, 1.3e-5, 0.55: 1.0e-5, 3.8e-6 and 0.27: not solved, 3.3e-6.

use super::multiplier::Multipliers;
use std::collections::BTreeMap;

/// `δ`: the results change little between 0.1 and 1.
const DELTA: f64 = 0.5;

/// A weighted jump between two neighbouring multipliers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jump {
    /// The two multipliers.
    pub rows: [usize; 2],
    /// Weight of the squared jump (length squared per stress).
    pub weight: f64,
}

/// Sparse rows: for each row its columns and values.
pub type SparseRows = Vec<BTreeMap<usize, f64>>;

/// Jumps of one contact boundary, between neighbouring multipliers. `edges` are the lengths of the edges beside each segment, `moduli`
/// the `E_c` of each multiplier (stress). Between two materials the harder one counts, for λ itself may jump there.
pub fn jumps(multipliers: &Multipliers, edges: &[f64], moduli: &[f64]) -> Vec<Jump> {
    let count = multipliers.count();
    let across_the_seam = multipliers.closed.then_some([count - 1, 0]).filter(|_| count > 2);
    let neighbours = (1..count).map(|i| [i - 1, i]).chain(across_the_seam);
    let jump = |rows: [usize; 2]| {
        let mean = |of: &dyn Fn(usize) -> f64| 0.5 * (of(rows[0]) + of(rows[1]));
        let area = mean(&|i| multipliers.length(i) * multipliers.width(i));
        let edge = mean(&|i| edges[multipliers.segment_of(i)]);
        Jump { rows, weight: DELTA * edge * area / moduli[rows[0]].max(moduli[rows[1]]) }
    };
    neighbours.map(jump).collect()
}

/// `C` over `count` multipliers. The jump to an open segment counts, too: so there is one `C`, whatever the active set, and
/// one pressure that goes with it.
pub fn jump_matrix<'a>(jumps: impl Iterator<Item = &'a Jump>, count: usize) -> SparseRows {
    let mut rows = vec![BTreeMap::new(); count];
    for Jump { rows: [i, j], weight } in jumps {
        for (a, b, sign) in [(i, i, 1.0), (j, j, 1.0), (i, j, -1.0), (j, i, -1.0)] {
            *rows[*a].entry(*b).or_insert(0.0) += sign * weight;
        }
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::super::contact_boundary::ContactBoundary;
    use super::super::pair::MultiplierSpace;
    use super::*;
    use crate::geometry::{Curve, Point};

    fn matrix(space: MultiplierSpace) -> SparseRows {
        let mut boundary = ContactBoundary::new(Curve::Line([[0.0, 0.0], [2.0, 0.0]]), [0.0, 1.0], Point::new(0.0, 1.0));
        boundary.cut(&[0.0, 0.2, 0.5, 1.0]);
        let multipliers = Multipliers::new(space, &boundary);
        jump_matrix(jumps(&multipliers, &[0.1; 3], &vec![7.0; multipliers.count()]).iter(), multipliers.count())
    }

    #[test]
    fn a_constant_pressure_costs_nothing_and_an_alternation_does() {
        for space in [MultiplierSpace::P0, MultiplierSpace::P1Discontinuous, MultiplierSpace::P1Continuous] {
            let rows = matrix(space);
            assert!(rows.iter().all(|row| row.values().sum::<f64>().abs() < 1e-16));
            let sign = |i: usize| if i.is_multiple_of(2) { 1.0 } else { -1.0 };
            let energy: f64 =
                rows.iter().enumerate().map(|(i, row)| row.iter().map(|(&j, v)| sign(i) * v * sign(j)).sum::<f64>()).sum();
            assert!(energy > 0.0);
        }
    }

    /// Where edges are ten times shorter, so is the weight: a jump costs by what the displacements there can see.
    #[test]
    fn a_jump_is_weighed_by_the_edges_beside_it() {
        let mut boundary = ContactBoundary::new(Curve::Line([[0.0, 0.0], [4.0, 0.0]]), [0.0, 1.0], Point::new(0.0, 1.0));
        boundary.cut(&[0.0, 0.25, 0.5, 0.75, 1.0]);
        let multipliers = Multipliers::new(MultiplierSpace::P0, &boundary);
        let weights: Vec<f64> = jumps(&multipliers, &[0.1, 0.1, 0.01, 0.01], &[7.0; 4]).iter().map(|jump| jump.weight).collect();
        assert!(
            (weights[0] / weights[2] - 10.0).abs() < 1e-12 && weights[0] > weights[1] && weights[1] > weights[2],
            "{weights:?}"
        );
    }

    /// Around a circle of even segments no multiplier is another than the next.
    #[test]
    fn a_closed_boundary_has_a_jump_at_its_seam() {
        let curve = Curve::Circle { centre: [0.0, 0.0], radius: 1.0 };
        let mut boundary = ContactBoundary::new(curve, [1.0, 1.0 + std::f64::consts::TAU], Point::new(-1.0, 0.0));
        boundary.cut(&[0.0, 0.25, 0.5, 0.75, 1.0]);
        for space in [MultiplierSpace::P0, MultiplierSpace::P1Discontinuous, MultiplierSpace::P1Continuous] {
            let multipliers = Multipliers::new(space, &boundary);
            let rows = jump_matrix(jumps(&multipliers, &[0.1; 4], &vec![7.0; multipliers.count()]).iter(), multipliers.count());
            let count = rows.len();
            for (i, row) in rows.iter().enumerate() {
                assert_eq!(row.len(), 3, "{space:?}: {rows:?}");
                let next = row[&((i + 1) % count)];
                assert!((next / rows[0][&1] - 1.0).abs() < 1e-12 && (row[&i] + 2.0 * next).abs() < 1e-12 * row[&i]);
            }
        }
    }

    /// The last multiplier before an open one is drawn to zero, and the open one towards contact.
    #[test]
    fn an_open_segment_is_a_neighbour_without_pressure() {
        let lambda = [1.0, 0.0, 0.0];
        let jump: Vec<f64> =
            matrix(MultiplierSpace::P0).iter().map(|row| row.iter().map(|(&j, value)| value * lambda[j]).sum()).collect();
        assert!(jump[0] > 0.0 && jump[1] == -jump[0] && jump[2] == 0.0, "{jump:?}");
    }
}
