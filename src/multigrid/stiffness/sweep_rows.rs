//! All rows of a level as a sweep reads them: where none of them lies inside of an even macro triangle. Those that are not stored, of nodes
//! among straight triangles, are made from these.
//!
//! A sweep through many rows waits for memory. The stiffness is symmetric, so the couplings of each row with later nodes are read
//! alone: forward they take from these nodes, too, what the new value of the row does there, and what a symmetric sweep's forward half
//! has found of earlier nodes stays for the backward half, and for the residual behind it. They are kept once more in single precision:
//! of five times all blocks that two sweeps and a residual read (36 bytes each, with the column) two and a half are left (20 bytes each).
//! Functions of auxiliary levels may be nearly multiples of each other, so that energies are small differences: these levels are read in
//! double precision.
//!
//! What rounding takes from the couplings of a row is given to its diagonal block: so translations keep their forces to the last
//! digit, and energies are changed by 6e-8 (λ + 2μ)/μ of that of the gradients of a displacement, not of its size. A support by
//! springs that are very much stiffer in one direction than the body would change it by more: then rows are read in double precision,
//! too, from where they are stored, if none shares its blocks.

use super::lanes::Lanes;
use super::registers::on_rows;
use super::row_kernel::RowWork;
use super::stored_rows::{Part, StoredRows};
use super::straight_triangles::StraightTriangles;
use crate::element::block::{add, inverse, transpose};
use crate::element::{Block, PlaneLaw};

/// Smallest part of a diagonal block's trace that its smaller eigenvalue may be. Rounding takes 3e-8 of the trace, three hundredths of
/// an eigenvalue of this size; at a tenth of this value it would take a third of it, at ten times three thousandths.
const LEAST: f64 = 1e-6;

/// Beside the rows of all nodes of a rank, in the order of the nodes, which is that of the sweep: their couplings as it reads them.
pub struct SweepRows {
    /// Where the couplings of each row with later nodes of this rank begin among those of all rows, and their number.
    firsts: Vec<u32>,
    /// These couplings, in the unit; none if they are read in double precision.
    blocks: Option<Vec<[f32; 4]>>,
    /// A power of two that brings the largest entry to the middle of the range of single precision.
    unit: f64,
    /// Inverses of the diagonal blocks.
    inverses: Vec<Block>,
    /// Rows with columns of other ranks.
    far: Vec<u32>,
    /// `b` without the couplings with earlier nodes and with those of other ranks, as the last sweep left them.
    sums: Vec<[f64; 2]>,
    /// Whether the last sweep went backward, too.
    is_whole: bool,
}

/// A coupling as sweeps read it.
trait SweepBlock: Copy {
    /// Whether there are only those with later nodes.
    const IS_HALF: bool;
    fn block(self) -> Block;
}

impl SweepBlock for Block {
    const IS_HALF: bool = false;

    #[inline(always)]
    fn block(self) -> Block {
        self
    }
}

impl SweepBlock for [f32; 4] {
    const IS_HALF: bool = true;

    #[inline(always)]
    fn block(self) -> Block {
        let [a, b, c, d] = self.map(f64::from);
        [[a, b], [c, d]]
    }
}

impl SweepRows {
    /// Of rows that are those of all nodes of this rank, in single precision if they may be and no node is held much more firmly in one
    /// direction than in another; nothing if they are to be read in double precision and share blocks. Those that are not stored
    /// are made from the `straight` triangles, and are in single precision in any case.
    pub fn new(rows: &StoredRows, straight: &StraightTriangles, may_be_single: bool) -> Option<Self> {
        let count = rows.nodes.len();
        let (mut firsts, mut largest, mut is_single) = (Vec::with_capacity(count + 1), straight.largest_modulus(), may_be_single);
        firsts.push(0);
        for k in 0..count {
            let columns = &rows.near.columns[rows.near.row(k)];
            let later = columns.iter().filter(|&&column| column > k as u32).count();
            firsts.push(firsts[k] + later as u32);
            if !rows.is_stored(k) {
                continue;
            }
            let own = &rows.near.blocks_of(k)[columns.len() - later - 1];
            // No coupling of a positive definite matrix is larger than both diagonal entries beside it.
            largest = largest.max(own[0][0]).max(own[1][1]);
            is_single &= is_even(own) || !straight.is_empty();
        }
        if !is_single && !rows.near.is_unshared() {
            return None;
        }
        let mut sweep = Self {
            blocks: is_single.then(|| vec![[0.0; 4]; firsts[count] as usize]),
            firsts,
            unit: if is_single && largest > 0.0 { largest.log2().floor().exp2() } else { 1.0 },
            inverses: vec![[[0.0; 2]; 2]; count],
            far: (0..count as u32).filter(|&k| rows.needs_far(k as usize)).collect(),
            sums: vec![[0.0; 2]; count],
            is_whole: false,
        };
        sweep.refresh(rows, (0..count).filter(|&k| rows.is_stored(k)));
        let Self { firsts, blocks: Some(blocks), unit, inverses, .. } = &mut sweep else { return Some(sweep) };
        straight.each_row(rows, |k, columns, row| {
            let later = firsts[k] as usize..firsts[k + 1] as usize;
            let at = row.len() - later.len();
            // Rows with blocks take care of their own diagonals.
            let mut give = |column: usize, lost: &Block| {
                if !rows.is_stored(column) {
                    add(&mut inverses[column], lost)
                }
            };
            columns[at..]
                .iter()
                .zip(&row[at..])
                .for_each(|(&column, block)| give(column as usize, &transpose(&lost(block, *unit))));
            inverses[k] = take_over(row, &mut blocks[later], *unit, inverses[k]);
        });
        Some(sweep)
    }

    /// Takes over the values of some rows.
    pub fn refresh(&mut self, rows: &StoredRows, changed: impl Iterator<Item = usize>) {
        let Some(blocks) = &mut self.blocks else {
            return changed.for_each(|k| self.inverses[k] = *rows.inverse(k));
        };
        for k in changed {
            let later = &mut blocks[self.firsts[k] as usize..self.firsts[k + 1] as usize];
            self.inverses[k] = take_over(rows.near.blocks_of(k), later, self.unit, [[0.0; 2]; 2]);
        }
    }

    /// A symmetric Gauss-Seidel sweep through the rows that these are of; `far` are the values of other ranks.
    pub fn relax(&mut self, rows: &StoredRows, b: &[[f64; 2]], x: &mut [[f64; 2]], far: &[[f64; 2]]) {
        self.sums.copy_from_slice(b);
        for &k in &self.far {
            self.sums[k as usize] = rows.far.subtract_plainly(k as usize, self.sums[k as usize], far);
        }
        self.work(&rows.near, SweepTask::Forward { x });
        self.work(&rows.near, SweepTask::Backward { x });
        self.is_whole = true;
    }

    /// The forward half of one from zero, whatever `x` holds.
    pub fn relax_from_zero(&mut self, rows: &StoredRows, b: &[[f64; 2]], x: &mut [[f64; 2]]) {
        self.sums.copy_from_slice(b);
        self.work(&rows.near, SweepTask::FromZero { x });
        self.is_whole = false;
    }

    /// The residual `r = b - K x` behind the last sweep, `b` and `x` being those that it worked on.
    pub fn residual(&mut self, rows: &StoredRows, b: &[[f64; 2]], x: &[[f64; 2]], far: &[[f64; 2]], r: &mut [[f64; 2]]) {
        if self.is_whole {
            r.copy_from_slice(b);
        } else {
            r.fill([0.0; 2]);
        }
        for &k in &self.far {
            r[k as usize] = rows.far.subtract_plainly(k as usize, r[k as usize], far);
        }
        let task = if self.is_whole { SweepTask::BehindBoth { x, r } } else { SweepTask::BehindForward { x, r } };
        self.work(&rows.near, task);
    }

    fn work(&mut self, near: &Part, task: SweepTask) {
        let mut sums = std::mem::take(&mut self.sums);
        match &self.blocks {
            Some(blocks) => on_rows(OnSweepRows { rows: self.halves(near, blocks), sums: &mut sums, task }),
            None => on_rows(OnSweepRows { rows: self.halves(near, &near.blocks), sums: &mut sums, task }),
        }
        self.sums = sums;
    }

    fn halves<'a, B>(&'a self, Part { starts, columns, .. }: &'a Part, blocks: &'a [B]) -> HalfRows<'a, B> {
        HalfRows { starts, columns, firsts: &self.firsts, blocks, unit: self.unit, inverses: &self.inverses }
    }
}

/// Takes over a row, those of its blocks that follow its own one in single precision: the inverse of its diagonal block, to which
/// what rounding takes from the others is given, and what it has taken from couplings that the row does not have.
fn take_over(row: &[Block], later: &mut [[f32; 4]], unit: f64, taken: Block) -> Block {
    let (others, all) = row.split_at(row.len() - later.len() - 1);
    // Its own block is not rounded.
    let (own, following) = all.split_first().expect("its own block");
    following.iter().zip(later).for_each(|(block, kept)| *kept = single(block, unit));
    let mut diagonal = *own;
    add(&mut diagonal, &taken);
    others.iter().chain(following).for_each(|block| add(&mut diagonal, &lost(block, unit)));
    inverse(&diagonal).expect("a stiffness has a diagonal")
}

fn single([[a, b], [c, d]]: &Block, unit: f64) -> [f32; 4] {
    [*a, *b, *c, *d].map(|value| (value / unit) as f32)
}

/// What rounding takes from a block.
fn lost(block: &Block, unit: f64) -> Block {
    let rounded = single(block, unit).block();
    std::array::from_fn(|i| std::array::from_fn(|j| block[i][j] - rounded[i][j] * unit))
}

/// Whether a body with this law holds all nodes so inside, whatever the triangles: of each gradient `g` a diagonal block has
/// `(λ + μ) g ⊗ g + μ |g|² I`, where the smaller eigenvalue is this part of the trace.
pub fn holds_evenly(law: &PlaneLaw) -> bool {
    law.mu > LEAST * (law.lambda + 3.0 * law.mu)
}

/// Whether a node with this diagonal block is not held much more firmly in one direction than in another.
fn is_even([[a, b], [c, d]]: &Block) -> bool {
    let (trace, half) = (a + d, b / (a + d));
    (a / trace) * (d / trace) - half * (c / trace) > LEAST
}

/// The rows as a kernel reads them.
struct HalfRows<'a, B> {
    /// Where the columns of each row begin, and their number.
    starts: &'a [u32],
    columns: &'a [u32],
    firsts: &'a [u32],
    blocks: &'a [B],
    unit: f64,
    inverses: &'a [Block],
}

impl<'a, B: SweepBlock> HalfRows<'a, B> {
    /// Couplings of row `k` with later nodes: their columns and blocks.
    #[inline(always)]
    fn later(&self, k: usize) -> (&'a [u32], &'a [B]) {
        let (end, own) = (self.starts[k + 1] as usize, self.firsts[k] as usize..self.firsts[k + 1] as usize);
        let columns = end - own.len()..end;
        (&self.columns[columns.clone()], &self.blocks[if B::IS_HALF { own } else { columns }])
    }

    /// `sum - Σ K x` over couplings with later nodes.
    #[inline(always)]
    fn subtract<L: Lanes<Nodes = [[f64; 2]; 2]>>(
        &self,
        lanes: L,
        (columns, blocks): (&[u32], &[B]),
        sum: [f64; 2],
        x: &[[f64; 2]],
    ) -> [f64; 2] {
        let block = |block: B| lanes.load(block.block());
        let zero = lanes.load([[0.0; 2]; 2]);
        let (mut one, mut other) = (zero, zero);
        let (columns, blocks) = (columns.as_chunks::<2>(), blocks.as_chunks::<2>());
        for (columns, blocks) in columns.0.iter().zip(blocks.0) {
            let [a, b] = columns.map(|column| lanes.load([x[column as usize]; 2]));
            one = lanes.multiply_add(block(blocks[0]), a, one);
            other = lanes.multiply_add(block(blocks[1]), b, other);
        }
        if let ([column], [last]) = (columns.1, blocks.1) {
            one = lanes.multiply_add(block(*last), lanes.load([x[*column as usize]; 2]), one);
        }
        let [[a, b], [c, d]] = lanes.store(lanes.add(one, other));
        [sum[0] - self.unit * (a + b), sum[1] - self.unit * (c + d)]
    }

    /// Subtracts from the sums of later nodes what the value of a row does there.
    #[inline(always)]
    fn spread<L: Lanes<Nodes = [[f64; 2]; 2]>>(
        &self,
        lanes: L,
        (columns, blocks): (&[u32], &[B]),
        [u, v]: [f64; 2],
        sums: &mut [[f64; 2]],
    ) {
        let (u, v) = (self.unit * u, self.unit * v);
        let x = lanes.load([[u, u], [v, v]]);
        for (column, block) in columns.iter().zip(blocks) {
            let [[a, b], [c, d]] = lanes.store(lanes.multiply(lanes.load(block.block()), x));
            let sum = &mut sums[*column as usize];
            *sum = [sum[0] - (a + c), sum[1] - (b + d)];
        }
    }

    /// The value at which the forces `sum` on a node vanish.
    #[inline(always)]
    fn solved(&self, k: usize, sum: [f64; 2]) -> [f64; 2] {
        self.inverses[k].map(|row| row[0] * sum[0] + row[1] * sum[1])
    }
}

/// Work on the rows of a sweep.
enum SweepTask<'a> {
    Forward {
        x: &'a mut [[f64; 2]],
    },
    FromZero {
        x: &'a mut [[f64; 2]],
    },
    Backward {
        x: &'a mut [[f64; 2]],
    },
    /// `r` has `b` without the couplings with other ranks.
    BehindBoth {
        x: &'a [[f64; 2]],
        r: &'a mut [[f64; 2]],
    },
    /// `r` has what the couplings with other ranks take away.
    BehindForward {
        x: &'a [[f64; 2]],
        r: &'a mut [[f64; 2]],
    },
}

/// A task with the rows that it works on.
struct OnSweepRows<'a, B> {
    rows: HalfRows<'a, B>,
    sums: &'a mut [[f64; 2]],
    task: SweepTask<'a>,
}

impl<B: SweepBlock> RowWork for OnSweepRows<'_, B> {
    #[inline(always)]
    fn work<L: Lanes<Nodes = [[f64; 2]; 2]>>(self, lanes: L) {
        let Self { rows, sums, task } = self;
        match task {
            SweepTask::Forward { x } => {
                for k in 0..sums.len() {
                    x[k] = rows.solved(k, rows.subtract(lanes, rows.later(k), sums[k], x));
                    rows.spread(lanes, rows.later(k), x[k], sums);
                }
            }
            SweepTask::FromZero { x } => {
                for k in 0..sums.len() {
                    x[k] = rows.solved(k, sums[k]);
                    rows.spread(lanes, rows.later(k), x[k], sums);
                }
            }
            SweepTask::Backward { x } => {
                for k in (0..sums.len()).rev() {
                    x[k] = rows.solved(k, rows.subtract(lanes, rows.later(k), sums[k], x));
                }
            }
            SweepTask::BehindBoth { x, r } => {
                for (k, sum) in sums.iter().enumerate() {
                    r[k] = [r[k][0] - sum[0], r[k][1] - sum[1]];
                    rows.spread(lanes, rows.later(k), x[k], r);
                }
            }
            SweepTask::BehindForward { x, r } => {
                for (k, r) in r.iter_mut().enumerate() {
                    *r = rows.subtract(lanes, rows.later(k), *r, x);
                }
            }
        }
    }
}

impl Part {
    /// `sum - Σ K x` of row `k`, which is one of few.
    fn subtract_plainly(&self, k: usize, sum: [f64; 2], x: &[[f64; 2]]) -> [f64; 2] {
        self.couplings(k).fold(sum, |sum, (column, block)| {
            let x = x[column as usize];
            [0, 1].map(|a| sum[a] - block[a][0] * x[0] - block[a][1] * x[1])
        })
    }
}

#[cfg(test)]
mod tests;
