//! Blocks of two by two in registers, one for each node.

use super::lanes::Lanes;
use crate::element::Block;
use crate::system::space::Real;

/// A block for each node of a register: what it does to the component of the same name, and to the other one. Registers begin
/// with lines of the cache: those that lie in two lines are read twice, and kernels read little else.
#[repr(align(64))]
pub struct BlockLanes<L: Lanes> {
    pub same: L::Register,
    pub other: L::Register,
}

impl<L: Lanes> BlockLanes<L> {
    /// For a sum: the components change places at its end.
    pub fn of_sum(lanes: L, blocks: &[Block; 2]) -> Self {
        Self::new(lanes, &blocks.map(|k| [[k[0][0], k[1][0]], [k[0][1], k[1][1]]]))
    }

    /// Blocks of even and odd nodes.
    pub fn new(lanes: L, blocks: &[Block; 2]) -> Self {
        let at = |k: usize, turned: bool| {
            let (a, block) = (k % 2, &blocks[k / 2 % 2]);
            L::Real::of(block[a][if turned { 1 - a } else { a }])
        };
        let register = |turned: bool| {
            let nodes: Vec<[L::Real; 2]> = (0..L::COUNT).map(|node| [at(2 * node, turned), at(2 * node + 1, turned)]).collect();
            lanes.load(L::chunks(&nodes)[0])
        };
        Self { same: register(false), other: register(true) }
    }

    /// `sum + M x`.
    #[inline(always)]
    pub fn add(&self, lanes: L, x: L::Register, sum: L::Register) -> L::Register {
        lanes.multiply_add(self.other, lanes.turned(x), lanes.multiply_add(self.same, x, sum))
    }
}

/// A sum of products with blocks. The parts for the other components are brought there once, at the end: their factors are
/// those of transposed blocks ([`BlockLanes::of_sum`]).
pub struct Sum<L: Lanes> {
    pub same: L::Register,
    pub other: L::Register,
}

impl<L: Lanes> Sum<L> {
    /// Of one product.
    #[inline(always)]
    pub fn of(lanes: L, factor: &BlockLanes<L>, x: L::Register) -> Self {
        Self { same: lanes.multiply(factor.same, x), other: lanes.multiply(factor.other, x) }
    }

    /// One product more.
    #[inline(always)]
    pub fn add(&mut self, lanes: L, factor: &BlockLanes<L>, x: L::Register) {
        self.same = lanes.multiply_add(factor.same, x, self.same);
        self.other = lanes.multiply_add(factor.other, x, self.other);
    }

    #[inline(always)]
    pub fn total(self, lanes: L) -> L::Register {
        lanes.add(self.same, lanes.turned(self.other))
    }
}

pub fn product(a: &Block, b: &Block) -> Block {
    a.map(|row| [0, 1].map(|j| row[0] * b[0][j] + row[1] * b[1][j]))
}

pub fn sum4(a: &Block, b: &Block) -> Block {
    std::array::from_fn(|i| std::array::from_fn(|j| a[i][j] + b[i][j]))
}
