//! All rows of a level as a sweep reads them: where none of them lies inside of an even macro triangle.
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

use super::couplings::inverse;
use super::lanes::Lanes;
use super::registers::on_rows;
use super::row_kernel::RowWork;
use super::stored_rows::{Part, StoredRows};
use crate::element::Block;

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
    /// direction than in another; nothing if they are to be read in double precision and share blocks.
    pub fn new(rows: &StoredRows, may_be_single: bool) -> Option<Self> {
        let count = rows.nodes.len();
        let (mut firsts, mut largest, mut is_single) = (Vec::with_capacity(count + 1), 0.0_f64, may_be_single);
        firsts.push(0);
        for k in 0..count {
            let columns = &rows.near.columns[rows.near.row(k)];
            let later = columns.iter().filter(|&&column| column > k as u32).count();
            firsts.push(firsts[k] + later as u32);
            let own = &rows.near.blocks_of(k)[columns.len() - later - 1];
            // No coupling of a positive definite matrix is larger than both diagonal entries beside it.
            largest = largest.max(own[0][0]).max(own[1][1]);
            is_single &= is_even(own);
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
        sweep.refresh(rows, 0..count);
        Some(sweep)
    }

    /// Takes over the values of some rows.
    pub fn refresh(&mut self, rows: &StoredRows, changed: impl Iterator<Item = usize>) {
        let scale = 1.0 / self.unit;
        let Some(blocks) = &mut self.blocks else {
            return changed.for_each(|k| self.inverses[k] = *rows.inverse(k));
        };
        let single = |[[a, b], [c, d]]: &Block| [*a, *b, *c, *d].map(|value| (value * scale) as f32);
        for k in changed {
            let later = self.firsts[k] as usize..self.firsts[k + 1] as usize;
            let (others, all) = rows.near.blocks_of(k).split_at(rows.near.row(k).len() - later.len() - 1);
            let (own, following) = all.split_first().expect("its own block");
            following.iter().zip(&mut blocks[later]).for_each(|(block, kept)| *kept = single(block));
            // Its own block is not rounded.
            let mut diagonal = *own;
            for block in others.iter().chain(following) {
                let rounded = single(block).map(f64::from);
                (0..4).for_each(|at| diagonal[at / 2][at % 2] += block[at / 2][at % 2] - rounded[at] * self.unit);
            }
            self.inverses[k] = inverse(&diagonal).expect("a stiffness has a diagonal");
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
mod tests {
    use super::super::assembly::{Assembled, Assembly};
    use super::super::stored_rows::BlockColumn;
    use super::*;
    use crate::contact::MultiplierSpace;
    use crate::discretisation::samples::{blocks, pair, vector};
    use crate::discretisation::{Scene, spaces};
    use crate::element::Order;
    use crate::geometry::Point;
    use crate::mesh::Partition;
    use std::rc::Rc;

    /// Stored rows of all nodes, on one rank and on each of three, and how many nodes of other ranks they need.
    fn all_rows() -> Vec<(StoredRows, usize)> {
        let mut found = Vec::new();
        for (order, ranks) in [(Order::P1, 1), (Order::P2, 1), (Order::P1, 3), (Order::P2, 3)] {
            let mut scene = Scene { order, refine: 0, ..blocks(pair(MultiplierSpace::P0, 4), |_| Point::zeros(), Vec::new()) };
            scene.bodies.iter_mut().flat_map(|body| &mut body.parts).for_each(|part| part.material.poisson = 0.4);
            let owners: Vec<i32> = (0..scene.mesh.triangles.len()).map(|triangle| (triangle % ranks) as i32).collect();
            scene.partition = Rc::new(Partition::new(&scene.mesh, &owners, ranks));
            for rank in 0..ranks {
                let space = spaces(&scene, rank).expect("a small mesh").pop().expect("a finest level");
                let assembly = Assembly::new(&scene, &space, true, rank);
                let Assembled { rows, far, .. } = assembly.assemble(&Default::default(), |_, _| ()).expect("good triangles");
                assert_eq!(rows.nodes.len(), space.own.len());
                found.push((rows, far.len()));
            }
        }
        found
    }

    fn largest(values: &[[f64; 2]]) -> f64 {
        values.as_flattened().iter().fold(0.0, |largest, value| largest.max(value.abs()))
    }

    /// To a precision.
    fn check(found: &[[f64; 2]], exact: &[[f64; 2]], size: f64, precision: f64) {
        let differences = found.as_flattened().iter().zip(exact.as_flattened()).map(|(a, b)| (a - b).abs());
        let most = differences.fold(0.0, f64::max);
        assert!(most <= precision * size, "{most:e} beside {size:e}");
    }

    #[test]
    fn sweeps_and_residuals_are_those_of_the_rows_to_their_precision() {
        let mut with_others = 0;
        for ((rows, others), is_single) in all_rows().into_iter().flat_map(|rows| [(rows.clone(), true), (rows, false)]) {
            let (count, mut sweep) = (rows.nodes.len(), SweepRows::new(&rows, is_single).expect("they share nothing"));
            let check = |found: &[[f64; 2]], exact: &[[f64; 2]], size: f64| {
                check(found, exact, size, if is_single { 1e-5 } else { 1e-13 })
            };
            with_others += sweep.far.len();
            let (b, start, far) = (vector(count, 3), vector(count, 8), vector(others, 5));
            let (mut x, mut exact, mut r, mut exact_r) = (start.clone(), start, b.clone(), b.clone());
            sweep.relax(&rows, &b, &mut x, &far);
            rows.forward(0..count, &b, &mut exact, &far);
            rows.backward(0..count, &b, &mut exact, &far);
            check(&x, &exact, largest(&exact));
            // Other ranks have gone on meanwhile.
            let far = vector(others, 6);
            let forces = rows.norm_infinity() * largest(&x).max(largest(&far));
            sweep.residual(&rows, &b, &x, &far, &mut r);
            rows.residual(0..count, &b, &x, &far, &mut exact_r);
            check(&r, &exact_r, forces);
            // From zero the values that stand there do not matter.
            sweep.relax_from_zero(&rows, &b, &mut x);
            exact.fill([0.0; 2]);
            rows.forward(0..count, &b, &mut exact, &[]);
            check(&x, &exact, largest(&exact));
            sweep.residual(&rows, &b, &x, &far, &mut r);
            rows.residual(0..count, &b, &x, &far, &mut exact_r);
            check(&r, &exact_r, forces);
        }
        assert!(with_others > 0, "some rows need nodes of other ranks");
    }

    #[test]
    fn a_translation_keeps_its_forces_to_the_last_digit() {
        for (rows, _) in all_rows() {
            let sweep = SweepRows::new(&rows, true).expect("rows of all nodes");
            let halves = sweep.halves(&rows.near, sweep.blocks.as_ref().expect("single precision"));
            let mut sums: Vec<Block> = sweep.inverses.iter().map(|own| inverse(own).expect("an inverse has one")).collect();
            for k in 0..rows.nodes.len() {
                let (columns, blocks) = halves.later(k);
                for (&column, block) in columns.iter().zip(blocks) {
                    for (a, b) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                        let value = f64::from(block[2 * a + b]) * sweep.unit;
                        sums[k][a][b] += value;
                        sums[column as usize][b][a] += value;
                    }
                }
            }
            for (k, sum) in sums.iter().enumerate() {
                let size = rows.diagonal(k).as_flattened().iter().fold(0.0_f64, |size, v| size.max(v.abs()));
                let exact = rows
                    .near
                    .couplings(k)
                    .fold([0.0; 4], |sum, (_, block)| std::array::from_fn(|at| sum[at] + block[at / 2][at % 2]));
                assert!((0..4).all(|at| (sum[at / 2][at % 2] - exact[at]).abs() <= 1e-13 * size), "row {k}: {sum:?}, {exact:?}");
            }
        }
    }

    #[test]
    fn units_and_changed_rows_are_followed() {
        for factor in [1e-150, 1e150] {
            let (mut rows, others) = all_rows().swap_remove(0);
            rows.near.blocks.as_flattened_mut().as_flattened_mut().iter_mut().for_each(|value| *value *= factor);
            (0..rows.nodes.len()).for_each(|k| rows.invert(k));
            let (count, mut sweep) = (rows.nodes.len(), SweepRows::new(&rows, true).expect("rows of all nodes"));
            let b: Vec<[f64; 2]> = vector(count, 3).into_iter().map(|b| b.map(|b| b * factor)).collect();
            // A support under one node, much stiffer than the body.
            let (changed, stiff) = (count / 2, 1e3 * factor);
            rows.add(changed, BlockColumn::Near(changed as u32), &[[stiff, 0.0], [0.0, stiff]]);
            rows.invert(changed);
            sweep.refresh(&rows, std::iter::once(changed));
            let (mut x, mut exact, far) = (vec![[0.0; 2]; count], vec![[0.0; 2]; count], vector(others, 5));
            sweep.relax(&rows, &b, &mut x, &far);
            rows.forward(0..count, &b, &mut exact, &far);
            rows.backward(0..count, &b, &mut exact, &far);
            check(&x, &exact, largest(&exact), 1e-5);
            assert!(largest(&x[changed..=changed]) < 0.05 * largest(&x), "it is held");
            assert!(SweepRows::new(&rows, true).is_some_and(|sweep| sweep.blocks.is_some()));
            // Springs along an inclined line.
            let spring = 1e8 * rows.diagonal(0)[0][0];
            rows.add(0, BlockColumn::Near(0), &[[0.36 * spring, 0.48 * spring], [0.48 * spring, 0.64 * spring]]);
            let sweep = SweepRows::new(&rows, true).expect("they share nothing");
            assert!(sweep.blocks.is_none(), "single precision would lose the body beside the spring");
        }
    }
}
