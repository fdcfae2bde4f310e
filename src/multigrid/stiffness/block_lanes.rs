//! Blocks of two by two in registers, one for each node.

use super::lanes::Lanes;
use crate::element::Block;

/// A block for each node of a register: what it does to the component of the same name, and to the other one. Registers begin
/// with lines of the cache: those that lie in two lines are read twice, and kernels read little else.
#[repr(align(64))]
pub struct BlockLanes<L: Lanes> {
    pub same: L::Register,
    pub other: L::Register,
}

impl<L: Lanes> BlockLanes<L> {
    /// For a sum: the components change places at its end.
    pub fn of_sums(lanes: L, block: impl Fn(usize) -> Block) -> Self {
        Self::of(lanes, |node| {
            let k = block(node);
            [[k[0][0], k[1][0]], [k[0][1], k[1][1]]]
        })
    }

    /// Of the block of each node.
    pub fn of(lanes: L, block: impl Fn(usize) -> Block) -> Self {
        let register = |turned: usize| lanes.gather(|node| [0, 1].map(|a| block(node)[a][a ^ turned]));
        Self { same: register(0), other: register(1) }
    }

    /// `sum + M x`.
    #[inline(always)]
    pub fn add(&self, lanes: L, x: L::Register, sum: L::Register) -> L::Register {
        lanes.multiply_add(self.other, lanes.turned(x), lanes.multiply_add(self.same, x, sum))
    }
}

/// A sum of products with blocks. The parts for the other components are brought there once, at the end: their factors are
/// those of transposed blocks ([`BlockLanes::of_sums`]).
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
