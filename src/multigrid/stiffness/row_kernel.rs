//! Sweeps, residuals and products of stored rows.

use super::lanes::Lanes;
use super::stored_rows::{Part, StoredRows};
use crate::element::Block;
use std::ops::Range;

/// Work on the rows of a range; products only where rows have blocks. Vectors hold all nodes of the rank.
pub enum RowTask<'a> {
    Multiply { y: &'a mut [[f64; 2]], x: &'a [[f64; 2]] },
    Residual { r: &'a mut [[f64; 2]], b: &'a [[f64; 2]], x: &'a [[f64; 2]] },
    Forward { b: &'a [[f64; 2]], x: &'a mut [[f64; 2]] },
    Backward { b: &'a [[f64; 2]], x: &'a mut [[f64; 2]] },
}

/// A task with what it works on; `far` are the values of columns of other ranks, none stands for zeros.
pub struct OnRows<'a> {
    pub rows: &'a StoredRows,
    pub range: Range<usize>,
    pub far: &'a [[f64; 2]],
    pub task: RowTask<'a>,
}

/// Work on rows, one node after the other.
pub trait RowWork {
    /// Does it.
    fn work<L: Lanes<Nodes = [[f64; 2]; 2]>>(self, lanes: L);
}

impl RowWork for OnRows<'_> {
    #[inline(always)]
    fn work<L: Lanes<Nodes = [[f64; 2]; 2]>>(self, lanes: L) {
        let Self { rows, range, far, task } = self;
        match task {
            RowTask::Multiply { y, x } => {
                for k in range.filter(|&k| rows.is_stored(k)) {
                    let sum = rows.subtract::<L, false>(lanes, k, [0.0; 2], x, far);
                    y[rows.nodes[k] as usize] = [-sum[0], -sum[1]];
                }
            }
            RowTask::Residual { r, b, x } => {
                for k in range {
                    let node = rows.nodes[k] as usize;
                    r[node] = rows.subtract::<L, false>(lanes, k, b[node], x, far);
                }
            }
            RowTask::Forward { b, x } => {
                for k in range {
                    rows.relax::<L, false>(lanes, k, b, x, far);
                }
            }
            RowTask::Backward { b, x } => {
                for k in range.rev() {
                    rows.relax::<L, true>(lanes, k, b, x, far);
                }
            }
        }
    }
}

impl Part {
    /// `sum - Σ K x` of a row. A block fills a register, whose four products come together at the end. Where rows are taken from
    /// the last to the first, their blocks are, too: memory that is read in one direction arrives before it is asked for.
    #[inline(always)]
    fn subtract<L: Lanes<Nodes = [[f64; 2]; 2]>, const BACKWARD: bool>(
        &self,
        lanes: L,
        k: usize,
        sum: [f64; 2],
        x: &[[f64; 2]],
    ) -> [f64; 2] {
        let row = self.row(k);
        let (columns, blocks) = (self.columns[row].as_chunks::<2>(), self.blocks_of(k).as_chunks::<2>());
        let zero = lanes.load([[0.0; 2]; 2]);
        let (mut one, mut other) = (zero, zero);
        let mut add_two = |(columns, blocks): (&[u32; 2], &[Block; 2])| {
            let [a, b] = columns.map(|column| lanes.load([x[column as usize]; 2]));
            one = lanes.multiply_add(lanes.load(blocks[0]), a, one);
            other = lanes.multiply_add(lanes.load(blocks[1]), b, other);
        };
        let last = match (columns.1, blocks.1) {
            ([column], [block]) => lanes.multiply(lanes.load(*block), lanes.load([x[*column as usize]; 2])),
            _ => zero,
        };
        // Loops, not `for_each`: what that calls would not have the registers.
        let twos = columns.0.iter().zip(blocks.0);
        if BACKWARD {
            for two in twos.rev() {
                add_two(two);
            }
        } else {
            for two in twos {
                add_two(two);
            }
        }
        let one = lanes.add(one, last);
        let [[a, b], [c, d]] = lanes.store(lanes.add(one, other));
        [sum[0] - (a + b), sum[1] - (c + d)]
    }
}

impl StoredRows {
    #[inline(always)]
    fn subtract<L: Lanes<Nodes = [[f64; 2]; 2]>, const BACKWARD: bool>(
        &self,
        lanes: L,
        k: usize,
        sum: [f64; 2],
        x: &[[f64; 2]],
        far: &[[f64; 2]],
    ) -> [f64; 2] {
        let sum = self.near.subtract::<L, BACKWARD>(lanes, k, sum, x);
        if far.is_empty() { sum } else { self.far.subtract::<L, BACKWARD>(lanes, k, sum, far) }
    }

    #[inline(always)]
    fn relax<L: Lanes<Nodes = [[f64; 2]; 2]>, const BACKWARD: bool>(
        &self,
        lanes: L,
        k: usize,
        b: &[[f64; 2]],
        x: &mut [[f64; 2]],
        far: &[[f64; 2]],
    ) {
        let node = self.nodes[k] as usize;
        let sum = self.subtract::<L, BACKWARD>(lanes, k, b[node], x, far);
        let ([u, v], inverse) = (x[node], self.inverse(k));
        x[node] = [u + (inverse[0][0] * sum[0] + inverse[0][1] * sum[1]), v + (inverse[1][0] * sum[0] + inverse[1][1] * sum[1])];
    }
}
