//! Sweeps, residuals and products over strips, several nodes at once in registers.
//!
//! Of a sweep, all that does not depend on the node before is done for several nodes together; what remains is a recurrence
//! ([`super::recurrence`]). Opposite couplings are alike, so neighbours are added before they are multiplied.

use super::block_lanes::{BlockLanes, Sum, product};
use super::lanes::{LaneWork, Lanes};
use super::recurrence::{Chain, State, Way};
use super::strips::{Couplings, Step, StripNodes, inverse};
use crate::element::Block;

/// Which halves of a symmetric Gauss-Seidel sweep are done.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SweepHalves {
    /// The first one alone, in the order of the nodes.
    Forward,
    /// The first one alone, from zero, whatever the inner nodes of even macro triangles hold; others hold zeros.
    ForwardFromZero,
    /// Both.
    Both,
}

/// Work on strips with the same couplings. Vectors hold all nodes of the rank.
pub trait StripKernel {
    /// `y = K x` at the nodes of strips.
    fn multiply(&self, strips: &[StripNodes], x: &[[f64; 2]], y: &mut [[f64; 2]]);

    /// `r = b - K x` at the nodes of strips.
    fn residual(&self, strips: &[StripNodes], b: &[[f64; 2]], x: &[[f64; 2]], r: &mut [[f64; 2]]);

    /// Relaxes strip after strip, the nodes of each one after the other.
    fn forward(&self, strips: &[StripNodes], b: &[[f64; 2]], x: &mut [[f64; 2]]);

    /// The same from the last to the first.
    fn backward(&self, strips: &[StripNodes], b: &[[f64; 2]], x: &mut [[f64; 2]]);
}

/// The kernel with given registers.
pub fn kernel<L: Lanes>(lanes: L, couplings: &Couplings) -> Box<dyn StripKernel> {
    match (couplings.up.len(), couplings.second) {
        (2, false) => Box::new(UnrolledKernel::<L, 2, false>::new(lanes, couplings)),
        (4, false) => Box::new(UnrolledKernel::<L, 4, false>::new(lanes, couplings)),
        (7, true) => Box::new(UnrolledKernel::<L, 7, true>::new(lanes, couplings)),
        (up, _) => panic!("a strip has 2, 4 or 7 steps to the next rows, not {up}"),
    }
}

/// A kernel for `UP` steps to the next rows; `SECOND` as in [`Couplings`].
struct UnrolledKernel<L: Lanes, const UP: usize, const SECOND: bool> {
    lanes: L,
    up: [Step; UP],
    forward: Half<L, UP>,
    backward: Half<L, UP>,
    product: Stencil<L, UP>,
    /// For nodes at the end of a strip that fill no register.
    single: [EndNode<UP>; 2],
    /// Ones at the nodes that a strip reaches before its first and behind its last one, zeros elsewhere.
    ends: [L::Register; 2],
    /// Minus one everywhere.
    minus: L::Register,
}

/// Half a sweep, all of it times `D⁻¹`.
struct Half<L: Lanes, const UP: usize> {
    right_hand_side: BlockLanes<L>,
    up: [BlockLanes<L>; UP],
    /// First and second neighbour on the side that is still to come.
    beside: [BlockLanes<L>; 2],
    chain: Chain<L>,
}

/// `-K`.
struct Stencil<L: Lanes, const UP: usize> {
    own: BlockLanes<L>,
    up: [BlockLanes<L>; UP],
    beside: [BlockLanes<L>; 2],
}

/// Couplings of one node to others, that with itself and its inverse.
struct EndNode<const UP: usize> {
    up: [Block; UP],
    beside: [Block; 2],
    diagonal: Block,
    inverse: Block,
}

impl<L: Lanes, const UP: usize, const SECOND: bool> UnrolledKernel<L, UP, SECOND> {
    /// Nodes beside a strip that it reaches.
    const REACH: usize = if SECOND { 2 } else { 1 };

    fn new(lanes: L, couplings: &Couplings) -> Self {
        let up: [Step; UP] = couplings.up.as_slice().try_into().expect("as many steps");
        let blocks = |step: Step| [0, 1].map(|kind| couplings.block(kind, step));
        let inverses = blocks((0, 0)).map(|block| inverse(&block).expect("a stiffness has a diagonal"));
        let negative = |step: Step| blocks(step).map(|block| block.map(|row| row.map(|v| -v)));
        let scaled = |step: Step| {
            let blocks = negative(step);
            [0, 1].map(|kind| product(&inverses[kind], &blocks[kind]))
        };
        let half = |way: Way| Half {
            right_hand_side: BlockLanes::of_sum(lanes, &inverses),
            up: up.map(|step| BlockLanes::of_sum(lanes, &scaled(step))),
            beside: [1, 2].map(|step| BlockLanes::of_sum(lanes, &scaled((step, 0)))),
            chain: if SECOND {
                Chain::of_pairs(lanes, way, &scaled((1, 0)), &scaled((2, 0)))
            } else {
                Chain::of_nodes(lanes, &scaled((1, 0)))
            },
        };
        let row = |kind: usize| EndNode {
            up: up.map(|step| couplings.block(kind, step)),
            beside: [1, 2].map(|step| couplings.block(kind, (step, 0))),
            diagonal: couplings.block(kind, (0, 0)),
            inverse: inverses[kind],
        };
        Self {
            lanes,
            up,
            forward: half(Way::Forward),
            backward: half(Way::Backward),
            product: Stencil {
                own: BlockLanes::of_sum(lanes, &negative((0, 0))),
                up: up.map(|step| BlockLanes::of_sum(lanes, &negative(step))),
                beside: [1, 2].map(|step| BlockLanes::of_sum(lanes, &negative((step, 0)))),
            },
            single: [row(0), row(1)],
            minus: lanes.load(L::chunks(&vec![[-1.0; 2]; L::COUNT])[0]),
            ends: [L::COUNT - Self::REACH..L::COUNT, 0..Self::REACH].map(|ones| {
                let one = |node: usize| [if ones.contains(&node) { 1.0 } else { 0.0 }; 2];
                lanes.load(L::chunks(&(0..L::COUNT).map(one).collect::<Vec<_>>())[0])
            }),
        }
    }

    /// First nodes of the runs of the neighbours in the next rows and in those before.
    #[inline(always)]
    fn runs(&self, nodes: StripNodes) -> [[usize; 2]; UP] {
        let start = |step: Step| nodes.first.wrapping_add_signed(nodes.distance(step));
        self.up.map(|(di, dj)| [start((di, dj)), start((-di, -dj))])
    }

    /// `r = b - K x` or `r = K x` at the nodes of a strip, which `b` and `r` hold alone.
    #[inline(always)]
    fn product<const RESIDUAL: bool>(&self, nodes: StripNodes, b: &[[f64; 2]], x: &[[f64; 2]], r: &mut [[f64; 2]]) {
        let (lanes, product) = (self.lanes, &self.product);
        let registers = nodes.count / L::COUNT;
        let chunks = |start: usize| &L::chunks(&x[start..])[..registers];
        let up = self.runs(nodes).map(|starts| starts.map(chunks));
        let own = chunks(nodes.first);
        let beside = [1, Self::REACH].map(|reach| [chunks(nodes.first - reach), chunks(nodes.first + reach)]);
        let forces = if RESIDUAL { &L::chunks(b)[..registers] } else { own };
        let sums = &mut L::chunks_mut(r)[..registers];
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
        for k in Self::rest(nodes) {
            let row = &self.single[k % 2];
            let own = times(&row.diagonal, x[nodes.first + k]).map(|v| -v);
            let sum = sum2(own, self.without_diagonal(nodes, k, x));
            r[k] = if RESIDUAL { sum2(b[k], sum) } else { sum.map(|v| -v) };
        }
    }

    /// Nodes of a strip that fill no register.
    #[inline(always)]
    fn rest(nodes: StripNodes) -> std::ops::Range<usize> {
        nodes.count / L::COUNT * L::COUNT..nodes.count
    }

    /// `-(K - D) x` of one node.
    #[inline(always)]
    fn without_diagonal(&self, nodes: StripNodes, k: usize, x: &[[f64; 2]]) -> [f64; 2] {
        let (node, row) = (nodes.first + k, &self.single[k % 2]);
        let mut sum = [0.0; 2];
        let mut add = |block: &Block, a: usize, b: usize| sum = sum2(sum, times(block, sum2(x[a], x[b])));
        for ((di, dj), block) in self.up.into_iter().zip(&row.up) {
            let [next, before] = [(di, dj), (-di, -dj)].map(|step| node.wrapping_add_signed(nodes.distance(step)));
            add(block, next, before);
        }
        for (reach, block) in (1..=Self::REACH).zip(&row.beside) {
            add(block, node - reach, node + reach);
        }
        sum.map(|v| -v)
    }

    #[inline(always)]
    fn relax(&self, nodes: StripNodes, k: usize, b: &[[f64; 2]], x: &mut [[f64; 2]]) {
        let sum = sum2(b[nodes.first + k], self.without_diagonal(nodes, k, x));
        x[nodes.first + k] = times(&self.single[k % 2].inverse, sum);
    }

    /// The nodes that come before those of a strip on the way.
    #[inline(always)]
    fn beside(&self, way: Way, first: usize, count: usize, x: &[[f64; 2]]) -> State<L> {
        let (run, ends) = match way {
            Way::Forward => (x[..first].len().checked_sub(L::COUNT).map(|start| &x[start..first]), self.ends[0]),
            Way::Backward => (x[first + count..].get(..L::COUNT), self.ends[1]),
        };
        let known = match run {
            Some(run) => self.lanes.multiply(ends, self.lanes.load(L::chunks(run)[0])),
            // At the first and the last nodes of a rank.
            None => {
                let mut nodes = [[0.0; 2]; 8];
                match way {
                    Way::Forward => nodes[L::COUNT - Self::REACH..L::COUNT].copy_from_slice(&x[first - Self::REACH..first]),
                    Way::Backward => nodes[..Self::REACH].copy_from_slice(&x[first + count..][..Self::REACH]),
                }
                self.lanes.load(L::chunks(&nodes)[0])
            }
        };
        State { steps: [known; 2], relaxed: known }
    }

    /// The registers of a strip, one way.
    #[inline(always)]
    fn sweep(&self, way: Way, nodes: StripNodes, b: &[[f64; 2]], x: &mut [[f64; 2]]) {
        let (lanes, half) = (self.lanes, if way == Way::Forward { &self.forward } else { &self.backward });
        let (first, registers) = (nodes.first, nodes.count / L::COUNT);
        let count = registers * L::COUNT;
        if registers == 0 {
            return;
        }
        let starts = self.runs(nodes);
        let mut state = self.beside(way, first, count, x);
        let (before, rest) = x.split_at_mut(first - Self::REACH);
        let (own, next) = rest.split_at_mut(count + 2 * Self::REACH);
        let above = |start: usize| &L::chunks(&next[start - first - count - Self::REACH..])[..registers];
        let up: [[&[L::Nodes]; 2]; UP] = starts.map(|[up, down]| [above(up), &L::chunks(&before[down..])[..registers]]);
        let b = &L::chunks(&b[first..])[..registers];
        for turn in 0..registers {
            let k = if way == Way::Forward { turn } else { registers - 1 - turn };
            let mut sum = Sum::of(lanes, &half.right_hand_side, lanes.load(b[k]));
            for reach in 1..=Self::REACH {
                let at = if way == Way::Forward { Self::REACH + reach } else { Self::REACH - reach };
                let run = &own[at + k * L::COUNT..][..L::COUNT];
                sum.add(lanes, &half.beside[reach - 1], lanes.load(L::chunks(run)[0]));
            }
            for (factor, run) in half.up.iter().zip(&up) {
                let [next, before] = run.map(|run| lanes.load(run[k]));
                sum.add(lanes, factor, lanes.add(next, before));
            }
            let relaxed = state.next::<SECOND>(lanes, way, &half.chain, sum.total(lanes));
            L::chunks_mut(&mut own[Self::REACH + k * L::COUNT..][..L::COUNT])[0] = lanes.store(relaxed);
        }
    }
}

/// What is to be done with the nodes of strips.
enum StripTask<'a> {
    Multiply { x: &'a [[f64; 2]], y: &'a mut [[f64; 2]] },
    Residual { b: &'a [[f64; 2]], x: &'a [[f64; 2]], r: &'a mut [[f64; 2]] },
    Forward { b: &'a [[f64; 2]], x: &'a mut [[f64; 2]] },
    Backward { b: &'a [[f64; 2]], x: &'a mut [[f64; 2]] },
}

/// A task on some strips.
struct OnStrips<'a, L: Lanes, const UP: usize, const SECOND: bool> {
    kernel: &'a UnrolledKernel<L, UP, SECOND>,
    strips: &'a [StripNodes],
    task: StripTask<'a>,
}

impl<L: Lanes, const UP: usize, const SECOND: bool> LaneWork for OnStrips<'_, L, UP, SECOND> {
    #[inline(always)]
    fn work(self) {
        let Self { kernel, strips, task } = self;
        match task {
            StripTask::Multiply { x, y } => {
                for &nodes in strips {
                    kernel.product::<false>(nodes, &[], x, &mut y[nodes.range()]);
                }
            }
            StripTask::Residual { b, x, r } => {
                for &nodes in strips {
                    kernel.product::<true>(nodes, &b[nodes.range()], x, &mut r[nodes.range()]);
                }
            }
            StripTask::Forward { b, x } => {
                for &nodes in strips {
                    kernel.sweep(Way::Forward, nodes, b, x);
                    for k in UnrolledKernel::<L, UP, SECOND>::rest(nodes) {
                        kernel.relax(nodes, k, b, x);
                    }
                }
            }
            StripTask::Backward { b, x } => {
                for &nodes in strips.iter().rev() {
                    for k in UnrolledKernel::<L, UP, SECOND>::rest(nodes).rev() {
                        kernel.relax(nodes, k, b, x);
                    }
                    kernel.sweep(Way::Backward, nodes, b, x);
                }
            }
        }
    }
}

impl<L: Lanes, const UP: usize, const SECOND: bool> StripKernel for UnrolledKernel<L, UP, SECOND> {
    fn multiply(&self, strips: &[StripNodes], x: &[[f64; 2]], y: &mut [[f64; 2]]) {
        self.lanes.run(OnStrips { kernel: self, strips, task: StripTask::Multiply { x, y } });
    }

    fn residual(&self, strips: &[StripNodes], b: &[[f64; 2]], x: &[[f64; 2]], r: &mut [[f64; 2]]) {
        self.lanes.run(OnStrips { kernel: self, strips, task: StripTask::Residual { b, x, r } });
    }

    fn forward(&self, strips: &[StripNodes], b: &[[f64; 2]], x: &mut [[f64; 2]]) {
        self.lanes.run(OnStrips { kernel: self, strips, task: StripTask::Forward { b, x } });
    }

    fn backward(&self, strips: &[StripNodes], b: &[[f64; 2]], x: &mut [[f64; 2]]) {
        self.lanes.run(OnStrips { kernel: self, strips, task: StripTask::Backward { b, x } });
    }
}

#[inline(always)]
fn times(block: &Block, x: [f64; 2]) -> [f64; 2] {
    block.map(|row| row[0] * x[0] + row[1] * x[1])
}

#[inline(always)]
fn sum2(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] + b[0], a[1] + b[1]]
}

#[cfg(test)]
mod tests;
