//! Interpolation inside macro triangles: every second node has a coarse twin, the others are the mean of two coarse nodes.

use crate::mesh::lattice;
use crate::petsc::{Matrix, Result, Session, Transfer, Vector};
use crate::system::space::Components;
use crate::system::{Scene, Space};
use std::ops::Range;

/// Consecutive nodes of a fine lattice row whose parents are inner nodes of the same macro triangle, all of this rank; the
/// first one has an even place in its row.
pub struct HalvedRow {
    /// The first node, counted from this rank's first.
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
}

/// All rows of this rank.
pub fn halved_rows(scene: &Scene, fine: &Space, coarse: &Space, session: &Session) -> Vec<HalvedRow> {
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
    scene.partition.triangles_of(session.rank()).iter().flat_map(of_triangle).collect()
}

/// Stored and halved rows together.
pub struct LatticeInterpolation {
    stored: Matrix,
    halved: Vec<HalvedRow>,
}

impl LatticeInterpolation {
    /// From stored rows that are empty where rows are halved.
    pub fn new(stored: Matrix, halved: Vec<HalvedRow>) -> Self {
        Self { stored, halved }
    }

    /// Shows each fine node in halved rows with its parents; those of a twin are the same node twice.
    #[inline(always)]
    fn each(&self, mut show: impl FnMut(usize, [usize; 2])) {
        for &HalvedRow { first, count, parents: [a, b] } in &self.halved {
            // The second node of each two lies between a coarse node and the next, or right of the one below.
            let next = if a == b { [a, a + 1] } else { [a + 1, b] };
            for k in 0..count / 2 {
                show(first + 2 * k, [a + k, b + k]);
                show(first + 2 * k + 1, next.map(|node| node + k));
            }
            if count % 2 == 1 {
                show(first + count - 1, [a + count / 2, b + count / 2]);
            }
        }
    }
}

impl Transfer for LatticeInterpolation {
    fn multiply(&self, x: &Vector, y: &mut Vector) -> Result<()> {
        self.stored.multiply(x, y)?;
        let (x, mut y) = (x.values(), y.values_mut());
        let (x, y): (&[Components], &mut [Components]) = (x.as_chunks().0, y.as_chunks_mut().0);
        self.each(|node, [a, b]| y[node] = [0, 1].map(|k| 0.5 * (x[a][k] + x[b][k])));
        Ok(())
    }

    fn multiply_add(&self, x: &Vector, y: &mut Vector) -> Result<()> {
        self.stored.multiply_add(x, y)?;
        let (x, mut y) = (x.values(), y.values_mut());
        let (x, y): (&[Components], &mut [Components]) = (x.as_chunks().0, y.as_chunks_mut().0);
        self.each(|node, [a, b]| (0..2).for_each(|k| y[node][k] += 0.5 * (x[a][k] + x[b][k])));
        Ok(())
    }

    fn multiply_transpose(&self, x: &Vector, y: &mut Vector) -> Result<()> {
        self.stored.multiply_transpose(x, y)?;
        let (x, mut y) = (x.values(), y.values_mut());
        let (x, y): (&[Components], &mut [Components]) = (x.as_chunks().0, y.as_chunks_mut().0);
        self.each(|node, parents| parents.into_iter().for_each(|p| (0..2).for_each(|k| y[p][k] += 0.5 * x[node][k])));
        Ok(())
    }
    fn work(&self) -> f64 {
        self.halved.iter().map(|row| 4.0 * row.count as f64).sum()
    }
}
