//! The couplings of one row of the lattices of even macro triangles, a register holding the same node of each.
//!
//! Opposite couplings are alike, so neighbours are added before they are multiplied. All factors of a sweep hold `D⁻¹`; the node
//! relaxed last comes into the sum last, since it is ready last.

use super::block_lanes::{BlockLanes, Sum};
use super::couplings::{Couplings, Step};
use super::lanes::Lanes;
use crate::element::block::{inverse, product};
use crate::mesh::lattice;

/// The way of a sweep through a row.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Way {
    Forward,
    Backward,
}

/// Work on one row of lattices with `n` intervals: `(n, j)` says which.
pub trait RowStencil<L: Lanes> {
    /// Relaxes the inner nodes, `b` being their right-hand side by their places.
    fn relax(&self, lanes: L, way: Way, row: (usize, usize), b: impl Fn(usize) -> L::Register, x: &mut [L::Nodes]);

    /// Shows `-K x` at the inner nodes: `put(place, value)`.
    fn product(&self, lanes: L, row: (usize, usize), x: &[L::Nodes], put: impl FnMut(usize, L::Register));
}

/// The factors of nodes of one kind.
struct NodeStencil<L: Lanes, const UP: usize> {
    /// Steps to the next rows; the opposite ones lead to the rows before.
    up: [Step; UP],
    sweep: Factors<L, UP>,
    /// Of the neighbour that was relaxed last.
    chain: BlockLanes<L>,
    product: Factors<L, UP>,
}

struct Factors<L: Lanes, const UP: usize> {
    own: BlockLanes<L>,
    up: [BlockLanes<L>; UP],
    /// Of the first and the second neighbours in the row.
    beside: [BlockLanes<L>; 2],
}

impl<L: Lanes, const UP: usize> NodeStencil<L, UP> {
    /// Of nodes of this kind; each lane has couplings of its own.
    fn new(lanes: L, couplings: &[&Couplings], kind: usize) -> Self {
        let up: [Step; UP] = couplings[0].up_of(kind).as_slice().try_into().expect("as many steps");
        let inverse = |lane: usize| inverse(&couplings[lane].block(kind, (0, 0))).expect("a stiffness has a diagonal");
        let negative = |lane: usize, step: Step| couplings[lane].block(kind, step).map(|row| row.map(|v| -v));
        let scaled = |step: Step| move |lane: usize| product(&inverse(lane), &negative(lane, step));
        Self {
            up,
            sweep: Factors {
                own: BlockLanes::of_sums(lanes, inverse),
                up: up.map(|step| BlockLanes::of_sums(lanes, scaled(step))),
                beside: [1, 2].map(|step| BlockLanes::of_sums(lanes, scaled((step, 0)))),
            },
            chain: BlockLanes::of(lanes, scaled((1, 0))),
            product: Factors {
                own: BlockLanes::of_sums(lanes, |lane| negative(lane, (0, 0))),
                up: up.map(|step| BlockLanes::of_sums(lanes, |lane| negative(lane, step))),
                beside: [1, 2].map(|step| BlockLanes::of_sums(lanes, |lane| negative(lane, (step, 0)))),
            },
        }
    }

    /// Relaxes a node: `up(k)` are its neighbours along step `k` and opposite to it, `ahead` those in the row that are still to
    /// come, `behind` the two that were relaxed last.
    #[inline(always)]
    fn relax<const SECOND: bool>(
        &self,
        lanes: L,
        b: L::Register,
        up: impl Fn(usize) -> [L::Register; 2],
        ahead: impl Fn(usize) -> L::Register,
        behind: &mut [L::Register; 2],
    ) -> L::Register {
        let mut sum = Sum::of(lanes, &self.sweep.own, b);
        for (k, factor) in self.sweep.up.iter().enumerate() {
            let [next, before] = up(k);
            sum.add(lanes, factor, lanes.add(next, before));
        }
        if SECOND {
            sum.add(lanes, &self.sweep.beside[1], lanes.add(ahead(2), behind[1]));
        }
        sum.add(lanes, &self.sweep.beside[0], ahead(1));
        let relaxed = self.chain.add(lanes, behind[0], sum.total(lanes));
        *behind = [relaxed, behind[0]];
        relaxed
    }

    /// `-K x` at a node; `beside(d)` are its neighbours `d` places before and behind it in the row.
    #[inline(always)]
    fn product<const SECOND: bool>(
        &self,
        lanes: L,
        own: L::Register,
        up: impl Fn(usize) -> [L::Register; 2],
        beside: impl Fn(usize) -> [L::Register; 2],
    ) -> L::Register {
        let mut sum = Sum::of(lanes, &self.product.own, own);
        let mut add = |factor, [a, b]: [L::Register; 2]| sum.add(lanes, factor, lanes.add(a, b));
        self.product.up.iter().enumerate().for_each(|(k, factor)| add(factor, up(k)));
        add(&self.product.beside[0], beside(1));
        if SECOND {
            add(&self.product.beside[1], beside(2));
        }
        sum.total(lanes)
    }

    /// The neighbours in other rows of `span` nodes from node `i` of row `j` on.
    #[inline(always)]
    fn runs<'a>(&self, rows: &OtherRows<'a, L>, i: usize, span: usize) -> [[&'a [L::Nodes]; 2]; UP] {
        self.up.map(|(di, dj)| [rows.run(i, (di, dj), span), rows.run(i, (-di, -dj), span)])
    }
}

/// The rows before a row, and those behind it.
struct OtherRows<'a, L: Lanes> {
    row: (usize, usize),
    before: &'a [L::Nodes],
    next: &'a [L::Nodes],
}

impl<'a, L: Lanes> OtherRows<'a, L> {
    /// What lies a step from `span` nodes of the row, the first of which is node `i`.
    #[inline(always)]
    fn run(&self, i: usize, (di, dj): Step, span: usize) -> &'a [L::Nodes] {
        if span == 0 {
            return &[];
        }
        let (n, j) = self.row;
        let place = lattice::index(n, 0, j.wrapping_add_signed(dj as isize)).wrapping_add_signed(i as isize + di as isize);
        if dj < 0 { &self.before[place..][..span] } else { &self.next[place - lattice::index(n, 0, j + 1)..][..span] }
    }
}

/// A row, to be written to, and the others.
#[inline(always)]
fn split<L: Lanes>(row: (usize, usize), x: &mut [L::Nodes]) -> (OtherRows<'_, L>, &mut [L::Nodes]) {
    let (n, j) = row;
    let (before, rest) = x.split_at_mut(lattice::index(n, 0, j));
    let (own, next) = rest.split_at_mut(n + 1 - j);
    (OtherRows { row, before, next }, own)
}

/// A row of nodes of one kind.
pub struct Alike<L: Lanes, const UP: usize>(NodeStencil<L, UP>);

impl<L: Lanes, const UP: usize> Alike<L, UP> {
    /// Each lane has couplings of its own.
    pub fn new(lanes: L, couplings: &[&Couplings]) -> Self {
        Self(NodeStencil::new(lanes, couplings, 0))
    }
}

impl<L: Lanes, const UP: usize> RowStencil<L> for Alike<L, UP> {
    #[inline(always)]
    fn relax(&self, lanes: L, way: Way, (n, j): (usize, usize), b: impl Fn(usize) -> L::Register, x: &mut [L::Nodes]) {
        let count = n - 1 - j;
        let (rows, own) = split::<L>((n, j), x);
        let (up, own) = (self.0.runs(&rows, 1, count), &mut own[..count + 2]);
        let is_forward = way == Way::Forward;
        let mut behind = [lanes.load(own[if is_forward { 0 } else { count + 1 }]); 2];
        for turn in 0..count {
            let k = if is_forward { turn } else { count - 1 - turn };
            let ahead = lanes.load(own[if is_forward { k + 2 } else { k }]);
            let up = |step: usize| up[step].map(|run| lanes.load(run[k]));
            own[k + 1] = lanes.store(self.0.relax::<false>(lanes, b(k), up, |_| ahead, &mut behind));
        }
    }

    #[inline(always)]
    fn product(&self, lanes: L, (n, j): (usize, usize), x: &[L::Nodes], mut put: impl FnMut(usize, L::Register)) {
        let (count, start) = (n - 1 - j, lattice::index(n, 0, j));
        let (before, rest) = x.split_at(start);
        let (own, next) = rest.split_at(n + 1 - j);
        let (up, own) = (self.0.runs(&OtherRows { row: (n, j), before, next }, 1, count), &own[..count + 2]);
        for k in 0..count {
            let up = |step: usize| up[step].map(|run| lanes.load(run[k]));
            let beside = |_| [own[k], own[k + 2]].map(|nodes| lanes.load(nodes));
            put(k, self.0.product::<false>(lanes, lanes.load(own[k + 1]), up, beside));
        }
    }
}

/// A row of nodes of two kinds in turn, those with even `i` perhaps having couplings with their second neighbours.
pub struct Alternate<L: Lanes, const ODD: usize, const EVEN: usize, const SECOND: bool> {
    odd: NodeStencil<L, ODD>,
    even: NodeStencil<L, EVEN>,
}

impl<L: Lanes, const ODD: usize, const EVEN: usize, const SECOND: bool> Alternate<L, ODD, EVEN, SECOND> {
    /// Each lane has couplings of its own.
    pub fn new(lanes: L, couplings: &[&Couplings]) -> Self {
        Self { odd: NodeStencil::new(lanes, couplings, 1), even: NodeStencil::new(lanes, couplings, 0) }
    }
}

impl<L: Lanes, const ODD: usize, const EVEN: usize, const SECOND: bool> RowStencil<L> for Alternate<L, ODD, EVEN, SECOND> {
    #[inline(always)]
    fn relax(&self, lanes: L, way: Way, (n, j): (usize, usize), b: impl Fn(usize) -> L::Register, x: &mut [L::Nodes]) {
        let count = n - 1 - j;
        let (rows, own) = split::<L>((n, j), x);
        // Nodes with odd places in the row, from the first one on, and those between them.
        let (odd, even) = (self.odd.runs(&rows, 1, spans(count)[0]), self.even.runs(&rows, 2, spans(count)[1]));
        let is_forward = way == Way::Forward;
        let mut behind = [lanes.load(own[if is_forward { 0 } else { count + 1 }]); 2];
        for turn in 0..count {
            let k = if is_forward { turn } else { count - 1 - turn };
            let ahead = |d: usize| lanes.load(own[if is_forward { k + 1 + d } else { k + 1 - d }]);
            let relaxed = if k % 2 == 0 {
                let up = |step: usize| odd[step].map(|run| lanes.load(run[k]));
                self.odd.relax::<false>(lanes, b(k), up, ahead, &mut behind)
            } else {
                let up = |step: usize| even[step].map(|run| lanes.load(run[k - 1]));
                self.even.relax::<SECOND>(lanes, b(k), up, ahead, &mut behind)
            };
            own[k + 1] = lanes.store(relaxed);
        }
    }

    #[inline(always)]
    fn product(&self, lanes: L, (n, j): (usize, usize), x: &[L::Nodes], mut put: impl FnMut(usize, L::Register)) {
        let (count, start) = (n - 1 - j, lattice::index(n, 0, j));
        let (before, rest) = x.split_at(start);
        let (own, next) = rest.split_at(n + 1 - j);
        let rows = OtherRows { row: (n, j), before, next };
        let (odd, even) = (self.odd.runs(&rows, 1, spans(count)[0]), self.even.runs(&rows, 2, spans(count)[1]));
        for k in 0..count {
            let beside = |d: usize| [own[k + 1 - d], own[k + 1 + d]].map(|nodes| lanes.load(nodes));
            let node = lanes.load(own[k + 1]);
            let sum = if k % 2 == 0 {
                self.odd.product::<false>(lanes, node, |step| odd[step].map(|run| lanes.load(run[k])), beside)
            } else {
                self.even.product::<SECOND>(lanes, node, |step| even[step].map(|run| lanes.load(run[k - 1])), beside)
            };
            put(k, sum);
        }
    }
}

/// Nodes from the first to the last one with an odd place among `count`, and with an even one.
fn spans(count: usize) -> [usize; 2] {
    [count - (count + 1) % 2, count.saturating_sub(1 + count % 2)]
}
