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
    pub fn add_to_owners<const K: usize>(&self, own: &Range<usize>, sums: &mut [[f64; K]], mut others: Vec<(usize, [f64; K])>) {
        others.sort_by_key(|(block, _)| *block);
        let mut end = 0;
        let mut of_rank = |count: usize| {
            let begin = others.partition_point(|(block, _)| *block < end);
            end += count;
            others.partition_point(|(block, _)| *block < end) - begin
        };
        let counts: Vec<usize> = self.gather_counts(own.len()).into_iter().map(&mut of_rank).collect();
        let blocks: Vec<u64> = others.iter().map(|(block, _)| *block as u64).collect();
        let values: Vec<f64> = others.iter().flat_map(|(_, values)| *values).collect();
        let arriving = self.counts_to_each(&counts);
        let (blocks, values) = (self.to_each(&blocks, &counts, &arriving, 1), self.to_each(&values, &counts, &arriving, K));
        for (block, values) in blocks.iter().zip(values.chunks_exact(K)) {
            let sum = &mut sums[*block as usize - own.start];
            sum.iter_mut().zip(values).for_each(|(sum, value)| *sum += value);
        }
    }
}
