//! Values of blocks that several ranks know a part of, added up by the rank that owns the block.

use super::session::Session;
use std::ops::Range;

impl Session {
    /// Adds `others`, pairs of a block's global number and its `K` values, to the sums of the ranks that own those blocks. The
    /// order of the additions does not depend on when messages come: own values first, then those of rank 0, 1, … as they are
    /// listed there. (`VecSetValues` adds in the order of arrival, and so gives other digits in each run on three ranks.)
    ///
    /// | argument | what |
    /// |---|---|
    /// | `own` | blocks of this rank; the ranges of the ranks follow each other |
    /// | `sums` | values of those blocks, to add to |
    /// | `others` | blocks of any rank, in any order |
    ///
    /// **Collective**
    pub fn add_to_owners<const K: usize>(&self, own: &Range<usize>, sums: &mut [[f64; K]], others: Vec<(usize, [f64; K])>) {
        let owner = self.owners(own.len());
        let (blocks, values): (Vec<u64>, Vec<[f64; K]>) =
            others.into_iter().map(|(block, values)| (block as u64, values)).unzip();
        let ranks: Vec<usize> = blocks.iter().map(|block| owner(*block as usize)).collect();
        let (blocks, values) = (self.send_to(&ranks, &blocks, 1), self.send_to(&ranks, values.as_flattened(), K));
        for (block, values) in blocks.iter().zip(values.chunks_exact(K)) {
            let sum = &mut sums[*block as usize - own.start];
            sum.iter_mut().zip(values).for_each(|(sum, value)| *sum += value);
        }
    }
}
