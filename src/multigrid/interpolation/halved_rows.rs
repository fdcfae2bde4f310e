//! Interpolation inside macro triangles: every second node has a coarse twin, the others are the mean of two coarse nodes.

use crate::discretisation::{Scene, Space};
use crate::mesh::lattice;
use std::ops::Range;

/// Consecutive nodes of a fine lattice row whose parents are inner nodes of the same macro triangle; the first one has an even
/// place in its row.
#[derive(Clone, Copy, Debug)]
pub struct HalvedRow {
    /// The first node, counted from the first of a range.
    first: usize,
    /// How many.
    pub count: usize,
    /// Nodes of the two coarse rows: the parents of the first node. The same twice where the fine row lies on a coarse one.
    parents: [usize; 2],
}

impl HalvedRow {
    /// Places of such nodes in row `j` of a lattice.
    pub fn places(n: usize, j: usize) -> Range<usize> {
        if j < 2 || j + 4 > n { 0..0 } else { 2..n - 1 - j }
    }

    /// Adds the interpolated values of `x` to `y`.
    #[inline]
    fn prolong(&self, x: &[[f64; 2]], y: &mut [[f64; 2]]) {
        let [a, b] = self.parents;
        let mean = |sum: &mut [f64; 2], x: [f64; 2], y: [f64; 2]| (0..2).for_each(|k| sum[k] += 0.5 * (x[k] + y[k]));
        let (pairs, last) = y[self.first..][..self.count].as_chunks_mut::<2>();
        let n = pairs.len();
        // The second node of each two lies between a coarse node and the next, or right of the one below.
        let next = if a == b { [a, a + 1] } else { [a + 1, b] };
        let (even, odd) = ([a, b].map(|start| &x[start..][..n]), next.map(|start| &x[start..][..n]));
        for (k, pair) in pairs.iter_mut().enumerate() {
            mean(&mut pair[0], even[0][k], even[1][k]);
            mean(&mut pair[1], odd[0][k], odd[1][k]);
        }
        last.iter_mut().for_each(|last| mean(last, x[a + n], x[b + n]));
    }

    /// Adds what the transposed interpolation makes of `y` to `x`. Each coarse node is met once.
    #[inline]
    fn restrict(&self, y: &[[f64; 2]], x: &mut [[f64; 2]]) {
        let (zero, [a, b]) = ([0.0; 2], self.parents);
        let (pairs, last) = y[self.first..][..self.count].as_chunks::<2>();
        let (n, last) = (pairs.len(), last.first().copied().unwrap_or(zero));
        let mut before = zero;
        let ends = pairs.iter().map(|[even, odd]| (*even, *odd)).chain([(last, zero)]);
        if a == b {
            for ((even, odd), sum) in ends.zip(&mut x[a..=a + n]) {
                (0..2).for_each(|k| sum[k] += even[k] + 0.5 * (before[k] + odd[k]));
                before = odd;
            }
        } else {
            for ((even, odd), sum) in ends.clone().zip(&mut x[a..=a + n]) {
                (0..2).for_each(|k| sum[k] += 0.5 * (before[k] + even[k]));
                before = odd;
            }
            for ((even, odd), sum) in ends.zip(&mut x[b..][..self.count.div_ceil(2)]) {
                (0..2).for_each(|k| sum[k] += 0.5 * (even[k] + odd[k]));
            }
        }
    }
}

/// Halved rows of some macro triangles.
#[derive(Default)]
pub struct HalvedRows(Vec<HalvedRow>);

impl HalvedRows {
    /// Of these triangles, whose inner nodes are this rank's on both levels.
    pub fn new(scene: &Scene, fine: &Space, coarse: &Space, triangles: &[u32]) -> Self {
        let n = fine.numbering.level.intervals;
        let of_triangle = |&triangle: &u32| {
            let numbers = fine.numbering.triangle(&scene.mesh, triangle as usize);
            let below = coarse.numbering.triangle(&scene.mesh, triangle as usize);
            (0..=n).filter(move |&j| !HalvedRow::places(n, j).is_empty()).map(move |j| HalvedRow {
                first: numbers.node(2, j) - fine.own.start,
                count: HalvedRow::places(n, j).len(),
                parents: lattice::parents(2, j).map(|(i, j)| below.node(i, j) - coarse.own.start),
            })
        };
        Self(triangles.iter().flat_map(of_triangle).collect())
    }

    /// Adds the interpolated values of `x` to `y`.
    pub fn prolong(&self, x: &[[f64; 2]], y: &mut [[f64; 2]]) {
        self.0.iter().for_each(|row| row.prolong(x, y));
    }

    /// Makes zeros of the nodes of all rows.
    pub fn clear(&self, y: &mut [[f64; 2]]) {
        self.0.iter().for_each(|row| y[row.first..][..row.count].fill([0.0; 2]));
    }

    /// Adds what the transposed interpolation makes of `y` to `x`.
    pub fn restrict(&self, y: &[[f64; 2]], x: &mut [[f64; 2]]) {
        self.0.iter().for_each(|row| row.restrict(y, x));
    }
}
