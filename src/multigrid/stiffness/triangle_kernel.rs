//! Work on all inner nodes of even macro triangles, several of them side by side: a register holds the same node of each.
//!
//! Nodes of different macro triangles do not wait for each other in a sweep, so registers are full on the smallest lattice as on
//! the largest one. Each macro triangle may have couplings of its own.

use super::couplings::Couplings;
use super::lanes::{LaneWork, Lanes};
use super::row_stencil::{Alike, Alternate, RowStencil, Way};
use super::sweep_order::SweepHalves;
use crate::mesh::lattice;

/// Work on all inner nodes of a few macro triangles. Inner nodes come into the lattice row by row, and go back, while others are
/// worked on: so memory and registers are busy at once.
pub trait TriangleKernel {
    /// Macro triangles side by side.
    fn width(&self) -> usize;

    /// Does a task. `own` is a lattice of as many macro triangles as [`TriangleKernel::width`] says, which has the values of the
    /// nodes on the sides: lanes that are left over repeat the last macro triangle.
    fn work(&self, nodes: InnerNodes, own: &mut [[f64; 2]], task: TriangleTask);
}

/// The kernel with given registers, for macro triangles with these couplings of rows with even and with odd `j`, or of all rows:
/// as many as fill a register, or fewer.
pub fn triangle_kernel<L: Lanes>(lanes: L, couplings: &[&[Couplings]]) -> Box<dyn TriangleKernel> {
    // Lanes that are left over repeat the last macro triangle.
    let row =
        |row: usize| -> Vec<&Couplings> { (0..L::COUNT).map(|lane| &couplings[lane.min(couplings.len() - 1)][row]).collect() };
    match couplings[0].len() {
        1 => Box::new(OfRows { lanes, even: Alike::<L, 2>::new(lanes, &row(0)), odd: None::<Alike<L, 2>> }),
        _ => Box::new(OfRows {
            lanes,
            even: Alternate::<L, 2, 4, true>::new(lanes, &row(0)),
            odd: Some(Alternate::<L, 2, 2, false>::new(lanes, &row(1))),
        }),
    }
}

/// Stencils of the rows with even and with odd `j`; the first one stands for all if there is no other.
struct OfRows<L: Lanes, E, O> {
    lanes: L,
    even: E,
    odd: Option<O>,
}

/// The inner nodes of some macro triangles in the vectors of a rank.
#[derive(Clone, Copy)]
pub struct InnerNodes<'a> {
    /// Lattice intervals.
    pub n: usize,
    /// The first inner node of each.
    pub first: &'a [usize],
}

/// The most macro triangles side by side.
const WIDEST: usize = 4;

impl InnerNodes<'_> {
    /// Places of a row in a lattice.
    #[inline(always)]
    fn row(self, j: usize) -> std::ops::Range<usize> {
        let start = lattice::index(self.n, 1, j);
        start..start + self.n - 1 - j
    }

    /// The values of row `j` of each macro triangle.
    #[inline(always)]
    fn values<L: Lanes>(self, j: usize, values: &[[f64; 2]]) -> [&[[f64; 2]]; WIDEST] {
        let (start, count) = (lattice::row_start(self.n, j), self.n - 1 - j);
        let of = |lane: usize| &values[self.first[lane.min(self.first.len() - 1)] + start..][..count];
        std::array::from_fn(|lane| if lane < L::COUNT { of(lane) } else { &[] })
    }

    /// Brings row `j` into a lattice.
    #[inline(always)]
    fn bring<L: Lanes>(self, lanes: L, j: usize, x: &[[f64; 2]], own: &mut [L::Nodes]) {
        let values = self.values::<L>(j, x);
        for (k, to) in own[self.row(j)].iter_mut().enumerate() {
            *to = lanes.store(lanes.gather(|lane| values[lane][k]));
        }
    }

    /// Takes row `j` from a lattice.
    #[inline(always)]
    fn take<L: Lanes>(self, j: usize, own: &[L::Nodes], x: &mut [[f64; 2]]) {
        let own = &own[self.row(j)];
        for (lane, first) in self.first.iter().enumerate() {
            let to = &mut x[first + lattice::row_start(self.n, j)..][..own.len()];
            to.iter_mut().zip(own).for_each(|(to, from)| *to = from.as_ref()[lane]);
        }
    }
}

impl<L: Lanes, E: RowStencil<L>, O: RowStencil<L>> OfRows<L, E, O> {
    #[inline(always)]
    fn relax_row(&self, way: Way, row: (usize, usize), b: &[&[[f64; 2]]; WIDEST], own: &mut [L::Nodes]) {
        let b = |k: usize| self.lanes.gather(|lane| b[lane][k]);
        match self.odd.as_ref().filter(|_| row.1 % 2 == 1) {
            Some(odd) => odd.relax(self.lanes, way, row, b, own),
            None => self.even.relax(self.lanes, way, row, b, own),
        }
    }

    #[inline(always)]
    fn product_of_row(&self, row: (usize, usize), own: &[L::Nodes], put: impl FnMut(usize, L::Register)) {
        match self.odd.as_ref().filter(|_| row.1 % 2 == 1) {
            Some(odd) => odd.product(self.lanes, row, own, put),
            None => self.even.product(self.lanes, row, own, put),
        }
    }
}

/// What is to be done with the inner nodes.
pub enum TriangleTask<'a> {
    /// `y = K x`; `room` is another lattice.
    Multiply { x: &'a [[f64; 2]], room: &'a mut [[f64; 2]], y: &'a mut [[f64; 2]] },
    /// `r = b - K x`, into the inner nodes of a lattice.
    Residual { b: &'a [[f64; 2]], x: &'a [[f64; 2]], r: &'a mut [[f64; 2]] },
    /// A Gauss-Seidel sweep, row by row; nodes on the sides stay as they are.
    Relax { sweep: SweepHalves, b: &'a [[f64; 2]], x: &'a mut [[f64; 2]] },
}

/// A task on some macro triangles, with the lattice of their values.
struct OnLattice<'a, L: Lanes, E, O> {
    kernel: &'a OfRows<L, E, O>,
    nodes: InnerNodes<'a>,
    own: &'a mut [[f64; 2]],
    task: TriangleTask<'a>,
}

impl<L: Lanes, E: RowStencil<L>, O: RowStencil<L>> LaneWork for OnLattice<'_, L, E, O> {
    #[inline(always)]
    fn work(self) {
        let Self { kernel, nodes, own, task } = self;
        let (n, lanes, own) = (nodes.n, kernel.lanes, L::chunks_mut(own));
        // Rows that a row reaches are in the lattice before it is worked on.
        let ahead = if kernel.odd.is_some() { 2 } else { 1 };
        let bring = |j: usize, x: &[[f64; 2]], own: &mut [L::Nodes]| {
            let rows = if j == 1 { 1..ahead + 2 } else { j + ahead..j + ahead + 1 };
            rows.filter(|&row| row < n - 1).for_each(|row| nodes.bring(lanes, row, x, own));
        };
        match task {
            TriangleTask::Multiply { x, room, y } => {
                let (room, minus) = (L::chunks_mut(room), lanes.gather(|_| [-1.0; 2]));
                for j in 1..n - 1 {
                    bring(j, x, own);
                    let sums = &mut room[nodes.row(j)];
                    kernel.product_of_row((n, j), own, |k, sum| sums[k] = lanes.store(lanes.multiply(minus, sum)));
                    nodes.take::<L>(j, room, y);
                }
            }
            TriangleTask::Residual { b, x, r } => {
                let r = L::chunks_mut(r);
                for j in 1..n - 1 {
                    bring(j, x, own);
                    let (b, sums) = (nodes.values::<L>(j, b), &mut r[nodes.row(j)]);
                    kernel.product_of_row((n, j), own, |k, sum| {
                        sums[k] = lanes.store(lanes.add(lanes.gather(|lane| b[lane][k]), sum));
                    });
                }
            }
            TriangleTask::Relax { sweep, b, x } => {
                if sweep == SweepHalves::ForwardFromZero {
                    let zero = lanes.store(lanes.gather(|_| [0.0; 2]));
                    (1..n - 1).for_each(|j| own[nodes.row(j)].fill(zero));
                }
                for j in 1..n - 1 {
                    if sweep != SweepHalves::ForwardFromZero {
                        bring(j, x, own);
                    }
                    kernel.relax_row(Way::Forward, (n, j), &nodes.values::<L>(j, b), own);
                    if sweep != SweepHalves::Both {
                        nodes.take::<L>(j, own, x);
                    }
                }
                for j in (1..n - 1).rev().filter(|_| sweep == SweepHalves::Both) {
                    kernel.relax_row(Way::Backward, (n, j), &nodes.values::<L>(j, b), own);
                    nodes.take::<L>(j, own, x);
                }
            }
        }
    }
}

impl<L: Lanes, E: RowStencil<L>, O: RowStencil<L>> TriangleKernel for OfRows<L, E, O> {
    fn width(&self) -> usize {
        L::COUNT
    }

    fn work(&self, nodes: InnerNodes, own: &mut [[f64; 2]], task: TriangleTask) {
        self.lanes.run(OnLattice { kernel: self, nodes, own, task });
    }
}

#[cfg(test)]
mod tests;
