//! Work on all inner nodes of an even macro triangle. Its lattice lies in memory row by row, with the nodes on its sides, so
//! that every inner node finds its neighbours at the same distances.
//!
//! Registers begin at the first node of a row, which lies on a side, and reach behind its last one: values of nodes on sides are
//! put into the recurrence as known, and what a register holds behind them stays as it is.

use super::*;
use crate::mesh::lattice;
use crate::system::triangle_lattice::row_start;
use std::ops::Range;

/// Where the rows of a right-hand side lie.
#[derive(Clone, Copy)]
pub enum RowsOf {
    /// In a lattice.
    Lattice,
    /// One after the other without the nodes on the sides, from this inner node on.
    Inner(usize),
}

impl RowsOf {
    /// Place of the first node of row `j`, which lies on a side: without those the node before the first inner one.
    #[inline(always)]
    fn start(self, n: usize, j: usize) -> usize {
        match self {
            Self::Lattice => row_start(n, j),
            Self::Inner(first) => first + lattice::row_start(n, j) - 1,
        }
    }
}

/// Work on all inner nodes of a macro triangle with `n` intervals: `inner` are their values in the vectors of the rank, `x` is a
/// lattice that has those of the nodes on the sides ([`row_start`]). Inner nodes come into the lattice row by row, and go back,
/// while others are worked on: so memory and registers are busy at once.
pub trait TriangleKernel<T> {
    /// `y = K x`; `room` is another lattice.
    fn multiply(&self, n: usize, inner: &[[T; 2]], x: &mut [[T; 2]], room: &mut [[T; 2]], y: &mut [[T; 2]]);

    /// `r = b - K x`, into a lattice; what `r` has at other nodes is lost. `rows` says where `b` lies.
    fn residual(&self, n: usize, rows: RowsOf, b: &[[T; 2]], inner: &[[T; 2]], x: &mut [[T; 2]], r: &mut [[T; 2]]);

    /// A Gauss-Seidel sweep, row by row; nodes on the sides stay as they are.
    fn relax(&self, n: usize, sweep: SweepHalves, rows: RowsOf, b: &[[T; 2]], inner: &mut [[T; 2]], x: &mut [[T; 2]]);
}

/// The kernel with given registers: couplings of rows with even and with odd `j`; the first one stands for all if there is
/// no other.
pub fn triangle_kernel<L: Lanes>(lanes: L, couplings: &[Couplings]) -> Box<dyn TriangleKernel<L::Real>> {
    match couplings {
        [all] => Box::new(RowKernels::<L, 2, false, 2> { even: UnrolledKernel::new(lanes, all), odd: None }),
        [even, odd] => Box::new(RowKernels::<L, 7, true, 4> {
            even: UnrolledKernel::new(lanes, even),
            odd: Some(UnrolledKernel::new(lanes, odd)),
        }),
        _ => panic!("rows of a lattice are of one kind or of two"),
    }
}

/// Kernels of the rows with even and with odd `j`.
struct RowKernels<L: Lanes, const EVEN: usize, const SECOND: bool, const ODD: usize> {
    even: UnrolledKernel<L, EVEN, SECOND>,
    odd: Option<UnrolledKernel<L, ODD, false>>,
}

impl<L: Lanes, const EVEN: usize, const SECOND: bool, const ODD: usize> RowKernels<L, EVEN, SECOND, ODD> {
    /// Relaxes the inner nodes of row `j`; `b` begins with the row.
    #[inline(always)]
    fn relax_row(&self, way: Way, (n, j): (usize, usize), ends: &RowEnds<L>, b: &[[L::Real; 2]], x: &mut [[L::Real; 2]]) {
        match self.odd.as_ref().filter(|_| j % 2 == 1) {
            Some(odd) => odd.relax_row(way, (n, j), ends, b, x),
            None => self.even.relax_row(way, (n, j), ends, b, x),
        }
    }
}

/// Ones and zeros that tell the nodes of a row's first and last registers apart.
struct RowEnds<L: Lanes> {
    zero: L::Register,
    /// The first node, and all others of its register.
    first: [L::Register; 2],
    /// Nodes before the last one of a row, that one, and it with those behind it, if they are read as many places before the
    /// middle as that one has before it in its register.
    last: [[[L::Real; 2]; 16]; 3],
}

impl<L: Lanes> RowEnds<L> {
    #[inline(always)]
    fn new(lanes: L) -> Self {
        let number = |is_one: bool| [L::Real::of(if is_one { 1.0 } else { 0.0 }); 2];
        let ones = |is_one: fn(usize) -> bool| lanes.load(L::chunks(&std::array::from_fn::<_, 8, _>(|k| number(is_one(k))))[0]);
        Self {
            zero: ones(|_| false),
            first: [ones(|k| k == 0), ones(|k| k > 0)],
            last: [
                std::array::from_fn(|k| number(k < L::COUNT)),
                std::array::from_fn(|k| number(k == L::COUNT)),
                std::array::from_fn(|k| number(k >= L::COUNT)),
            ],
        }
    }

    /// Nodes before the one at a place of a register, that one, and it with those behind it.
    #[inline(always)]
    fn at(&self, lanes: L, place: usize) -> [L::Register; 3] {
        [0, 1, 2].map(|k| lanes.load(L::chunks(&self.last[k][L::COUNT - place..][..L::COUNT])[0]))
    }
}

/// The inner nodes of row `j`: places in a lattice, and among all inner nodes.
#[inline(always)]
fn inner_row(n: usize, j: usize) -> (Range<usize>, Range<usize>) {
    let (own, packed, count) = (row_start(n, j) + 1, lattice::row_start(n, j), n - 1 - j);
    (own..own + count, packed..packed + count)
}

/// What a register of a row is relaxed with.
struct RowRuns<'a, L: Lanes, const UP: usize> {
    b: &'a [L::Nodes],
    /// Neighbours in the next rows and in those before.
    up: [[&'a [L::Nodes]; 2]; UP],
    /// The last register of the row, and the place of the row's last node in it.
    last: (usize, usize),
}

impl<L: Lanes, const UP: usize, const SECOND: bool> UnrolledKernel<L, UP, SECOND> {
    /// Where the runs of the neighbours in the next rows and in those before begin.
    #[inline(always)]
    fn starts(&self, n: usize, j: usize) -> [[usize; 2]; UP] {
        self.up.map(|(di, dj)| {
            let (di, dj) = (di as isize, dj as usize);
            [row_start(n, j + dj).wrapping_add_signed(di), row_start(n, j - dj).wrapping_add_signed(-di)]
        })
    }

    /// `r = b - K x` or `r = K x` in row `j`; `b` begins with the row.
    #[inline(always)]
    fn product_in_row<const RESIDUAL: bool>(
        &self,
        (n, j): (usize, usize),
        b: &[[L::Real; 2]],
        x: &[[L::Real; 2]],
        r: &mut [[L::Real; 2]],
    ) {
        let (lanes, product, first, registers) = (self.lanes, &self.product, row_start(n, j), (n - j) / L::COUNT + 1);
        let chunks = |start: usize| &L::chunks(&x[start..])[..registers];
        let up = self.starts(n, j).map(|starts| starts.map(chunks));
        let beside = [1, Self::REACH].map(|reach| [chunks(first - reach), chunks(first + reach)]);
        let own = chunks(first);
        let forces = if RESIDUAL { &L::chunks(b)[..registers] } else { own };
        let sums = &mut L::chunks_mut(&mut r[first..])[..registers];
        for k in 0..registers {
            let mut sum = Sum::of(lanes, &product.own, lanes.load(own[k]));
            if RESIDUAL {
                sum.same = lanes.add(sum.same, lanes.load(forces[k]));
            }
            for (factor, run) in product.beside.iter().zip(&beside).take(Self::REACH) {
                let [left, right] = run.map(|run| lanes.load(run[k]));
                sum.add(lanes, factor, lanes.add(left, right));
            }
            for (factor, run) in product.up.iter().zip(&up) {
                let [next, before] = run.map(|run| lanes.load(run[k]));
                sum.add(lanes, factor, lanes.add(next, before));
            }
            let sum = sum.total(lanes);
            sums[k] = lanes.store(if RESIDUAL { sum } else { lanes.multiply(self.minus, sum) });
        }
    }

    /// Relaxes the inner nodes of row `j`; `b` begins with the row.
    #[inline(always)]
    fn relax_row(&self, way: Way, (n, j): (usize, usize), ends: &RowEnds<L>, b: &[[L::Real; 2]], x: &mut [[L::Real; 2]]) {
        let (first, following) = (row_start(n, j), row_start(n, j + 1));
        let last = ((n - j) / L::COUNT, (n - j) % L::COUNT);
        // Two places before each row belong to it.
        let (before, rest) = x.split_at_mut(first - 2);
        let (own, next) = rest.split_at_mut(following - first);
        let starts = self.starts(n, j);
        let registers = last.0 + 1;
        let up = starts
            .map(|[up, down]| [&L::chunks(&next[up + 2 - following..])[..registers], &L::chunks(&before[down..])[..registers]]);
        let runs = RowRuns { b: &L::chunks(b)[..registers], up, last };
        let mut state = State { steps: [ends.zero; 3], relaxed: ends.zero };
        let at = |turn: usize| if way == Way::Forward { turn } else { last.0 - turn };
        self.relax_register::<true>(way, at(0), ends, &runs, own, &mut state);
        for turn in 1..last.0 {
            self.relax_register::<false>(way, at(turn), ends, &runs, own, &mut state);
        }
        if last.0 > 0 {
            self.relax_register::<true>(way, at(last.0), ends, &runs, own, &mut state);
        }
    }

    /// Relaxes register `k` of a row; the first and the last one have nodes that stay as they are.
    #[inline(always)]
    fn relax_register<const END: bool>(
        &self,
        way: Way,
        k: usize,
        ends: &RowEnds<L>,
        runs: &RowRuns<'_, L, UP>,
        own: &mut [[L::Real; 2]],
        state: &mut State<L>,
    ) {
        let (lanes, is_forward) = (self.lanes, way == Way::Forward);
        let half = if is_forward { &self.forward } else { &self.backward };
        let mut sum = Sum::of(lanes, &half.right_hand_side, lanes.load(runs.b[k]));
        for reach in 1..=Self::REACH {
            let at = if is_forward { 2 + reach } else { 2 - reach };
            sum.add(lanes, &half.beside[reach - 1], lanes.load(L::chunks(&own[at + k * L::COUNT..][..L::COUNT])[0]));
        }
        for (factor, run) in half.up.iter().zip(&runs.up) {
            let [next, before] = run.map(|run| lanes.load(run[k]));
            sum.add(lanes, factor, lanes.add(next, before));
        }
        let mut sum = sum.total(lanes);
        let own = &mut L::chunks_mut(&mut own[2 + k * L::COUNT..][..L::COUNT])[0];
        if !END {
            *own = lanes.store(state.next::<SECOND>(lanes, way, &half.chain, sum));
            return;
        }
        let (known, [side, free], (last, place)) = (lanes.load(*own), ends.first, runs.last);
        let [inner, end, behind] = ends.at(lanes, place);
        if is_forward && k == 0 {
            sum = lanes.multiply_add(sum, free, lanes.multiply(known, side));
        } else if !is_forward && k == last {
            sum = lanes.multiply_add(sum, inner, lanes.multiply(known, end));
        }
        let mut relaxed = state.next::<SECOND>(lanes, way, &half.chain, sum);
        if k == 0 {
            relaxed = lanes.multiply_add(relaxed, free, lanes.multiply(known, side));
        }
        if k == last {
            relaxed = lanes.multiply_add(relaxed, inner, lanes.multiply(known, behind));
        }
        *own = lanes.store(relaxed);
    }
}

/// What is to be done with the inner nodes of a macro triangle.
enum TriangleTask<'a, T> {
    Multiply { inner: &'a [[T; 2]], room: &'a mut [[T; 2]], y: &'a mut [[T; 2]] },
    Residual { rows: RowsOf, b: &'a [[T; 2]], inner: &'a [[T; 2]], r: &'a mut [[T; 2]] },
    Relax { sweep: SweepHalves, rows: RowsOf, b: &'a [[T; 2]], inner: &'a mut [[T; 2]] },
}

/// A task on a macro triangle, with the lattice of its values.
struct OnLattice<'a, L: Lanes, const EVEN: usize, const SECOND: bool, const ODD: usize> {
    kernels: &'a RowKernels<L, EVEN, SECOND, ODD>,
    n: usize,
    x: &'a mut [[L::Real; 2]],
    task: TriangleTask<'a, L::Real>,
}

impl<L: Lanes, const EVEN: usize, const SECOND: bool, const ODD: usize> LaneWork for OnLattice<'_, L, EVEN, SECOND, ODD> {
    #[inline(always)]
    fn work(self) {
        let Self { kernels, n, x, task } = self;
        let RowKernels { even, odd } = kernels;
        let odd_row = |j: usize| odd.as_ref().filter(|_| j % 2 == 1);
        // Rows that a row reaches are in the lattice before it is worked on.
        let ahead = if SECOND { 2 } else { 1 };
        let bring = |j: usize, inner: &[[L::Real; 2]], x: &mut [[L::Real; 2]]| {
            let rows = if j == 1 { 1..ahead + 2 } else { j + ahead..j + ahead + 1 };
            for (to, from) in rows.filter(|&row| row < n - 1).map(|row| inner_row(n, row)) {
                x[to].copy_from_slice(&inner[from]);
            }
        };
        match task {
            TriangleTask::Multiply { inner, room, y } => {
                for j in 1..n - 1 {
                    bring(j, inner, x);
                    match odd_row(j) {
                        Some(odd) => odd.product_in_row::<false>((n, j), &[], x, room),
                        None => even.product_in_row::<false>((n, j), &[], x, room),
                    }
                    let (from, to) = inner_row(n, j);
                    y[to].copy_from_slice(&room[from]);
                }
            }
            TriangleTask::Residual { rows, b, inner, r } => {
                for j in 1..n - 1 {
                    bring(j, inner, x);
                    let b = &b[rows.start(n, j)..];
                    match odd_row(j) {
                        Some(odd) => odd.product_in_row::<true>((n, j), b, x, r),
                        None => even.product_in_row::<true>((n, j), b, x, r),
                    }
                }
            }
            TriangleTask::Relax { sweep, rows, b, inner } => {
                let ends = RowEnds::new(even.lanes);
                let take = |j: usize, x: &[[L::Real; 2]], inner: &mut [[L::Real; 2]]| {
                    let (from, to) = inner_row(n, j);
                    inner[to].copy_from_slice(&x[from]);
                };
                for j in 1..n - 1 {
                    bring(j, inner, x);
                    kernels.relax_row(Way::Forward, (n, j), &ends, &b[rows.start(n, j)..], x);
                    if sweep == SweepHalves::Forward {
                        take(j, x, inner);
                    }
                }
                for j in (1..n - 1).rev().filter(|_| sweep == SweepHalves::Both) {
                    kernels.relax_row(Way::Backward, (n, j), &ends, &b[rows.start(n, j)..], x);
                    take(j, x, inner);
                }
            }
        }
    }
}

impl<L: Lanes, const EVEN: usize, const SECOND: bool, const ODD: usize> TriangleKernel<L::Real>
    for RowKernels<L, EVEN, SECOND, ODD>
{
    fn multiply(
        &self,
        n: usize,
        inner: &[[L::Real; 2]],
        x: &mut [[L::Real; 2]],
        room: &mut [[L::Real; 2]],
        y: &mut [[L::Real; 2]],
    ) {
        self.even.lanes.run(OnLattice { kernels: self, n, x, task: TriangleTask::Multiply { inner, room, y } });
    }

    fn residual(
        &self,
        n: usize,
        rows: RowsOf,
        b: &[[L::Real; 2]],
        inner: &[[L::Real; 2]],
        x: &mut [[L::Real; 2]],
        r: &mut [[L::Real; 2]],
    ) {
        self.even.lanes.run(OnLattice { kernels: self, n, x, task: TriangleTask::Residual { rows, b, inner, r } });
    }

    fn relax(
        &self,
        n: usize,
        sweep: SweepHalves,
        rows: RowsOf,
        b: &[[L::Real; 2]],
        inner: &mut [[L::Real; 2]],
        x: &mut [[L::Real; 2]],
    ) {
        self.even.lanes.run(OnLattice { kernels: self, n, x, task: TriangleTask::Relax { sweep, rows, b, inner } });
    }
}
