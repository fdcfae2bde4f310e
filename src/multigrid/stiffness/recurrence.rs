//! The recurrence of a Gauss-Seidel sweep along a strip, in registers.
//!
//! `x_k = t_k + P x_(k-1)` is summed up by doubling steps: `x_k = s_k + P⁴ x_(k-4)`, so that registers wait for each other, and
//! nodes do not (Hillis, Steele 1986). Where nodes reach two back, it is one of pairs of nodes.

use super::block_lanes::{BlockLanes, product, sum4};
use super::lanes::Lanes;
use crate::element::Block;
use nalgebra::Matrix4;

/// The way through a strip.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Way {
    Forward,
    Backward,
}

/// The recurrence: steps that double, the last one of a whole register.
pub struct Chain<L: Lanes> {
    pub steps: [BlockLanes<L>; 3],
    /// Of pairs: what one node gets from the other kind.
    pub crossed: [BlockLanes<L>; 3],
}

/// Where the recurrence stands: the last register before and after each step.
pub struct State<L: Lanes> {
    pub steps: [L::Register; 2],
    pub relaxed: L::Register,
}

impl<L: Lanes> State<L> {
    /// The next register on the way; `t` is what does not depend on the nodes before.
    #[inline(always)]
    pub fn next<const SECOND: bool>(&mut self, lanes: L, way: Way, chain: &Chain<L>, t: L::Register) -> L::Register {
        let shifted = |step: usize, before: L::Register, a: L::Register| match (way, step) {
            (Way::Forward, 0) => lanes.earlier::<1>(before, a),
            (Way::Forward, _) => lanes.earlier::<2>(before, a),
            (Way::Backward, 0) => lanes.later::<1>(a, before),
            (Way::Backward, _) => lanes.later::<2>(a, before),
        };
        let mut sum = t;
        let last = L::COUNT.trailing_zeros() as usize;
        for step in 0..last {
            let from = shifted(step, self.steps[step], sum);
            self.steps[step] = sum;
            sum = chain.steps[step].add(lanes, from, sum);
            if SECOND && step > 0 {
                sum = chain.crossed[step].add(lanes, lanes.crossed(from), sum);
            }
        }
        let far = if SECOND { chain.crossed[last].add(lanes, lanes.crossed(self.relaxed), sum) } else { sum };
        self.relaxed = chain.steps[last].add(lanes, self.relaxed, far);
        self.relaxed
    }
}

impl<L: Lanes> Chain<L> {
    /// `x_k = t_k + P_k x_(k-1)`, `P` being that of even and odd nodes.
    pub fn of_nodes(lanes: L, before: &[Block; 2]) -> Self {
        // Over a step of one the nodes differ in kind, over longer ones they do not.
        let mut power = [product(&before[0], &before[1]), product(&before[1], &before[0])];
        let steps = std::array::from_fn(|step| match step {
            0 => BlockLanes::new(lanes, before),
            _ => {
                let factor = BlockLanes::new(lanes, &power);
                power = power.map(|block| product(&block, &block));
                factor
            }
        });
        Self { steps, crossed: std::array::from_fn(|_| BlockLanes::new(lanes, &[[[0.0; 2]; 2]; 2])) }
    }

    /// The same where nodes that are even also reach the second one before: first inside of pairs, then from pair to pair by a
    /// matrix `M`, then by `M²` and so on. On the way back the odd node of a pair comes first.
    pub fn of_pairs(lanes: L, way: Way, one: &[Block; 2], two: &[Block; 2]) -> Self {
        let zero = [[0.0; 2]; 2];
        let [even, odd] = one;
        // Blocks of a pair: from (even, odd) to (even, odd).
        let (inside, mut pair) = match way {
            Way::Forward => {
                let (a, b) = (*even, two[0]);
                ([zero, *odd], [[b, a], [product(odd, &b), product(odd, &a)]])
            }
            Way::Backward => {
                let through = product(even, odd);
                ([*even, zero], [[sum4(&through, &two[0]), zero], [*odd, zero]])
            }
        };
        let mut steps = vec![BlockLanes::new(lanes, &inside)];
        let mut crossed = vec![BlockLanes::new(lanes, &[zero, zero])];
        for _ in 1..3 {
            steps.push(BlockLanes::new(lanes, &[pair[0][0], pair[1][1]]));
            crossed.push(BlockLanes::new(lanes, &[pair[0][1], pair[1][0]]));
            pair = square(&pair);
        }
        let all = |factors: Vec<BlockLanes<L>>| factors.try_into().unwrap_or_else(|_| unreachable!("three steps"));
        Self { steps: all(steps), crossed: all(crossed) }
    }
}

/// The square of a matrix of two by two blocks.
fn square(pair: &[[Block; 2]; 2]) -> [[Block; 2]; 2] {
    let entry = |i: usize, j: usize| pair[i / 2][j / 2][i % 2][j % 2];
    let matrix = Matrix4::from_fn(entry);
    let matrix = matrix * matrix;
    std::array::from_fn(|i| {
        std::array::from_fn(|j| std::array::from_fn(|a| std::array::from_fn(|b| matrix[(2 * i + a, 2 * j + b)])))
    })
}
