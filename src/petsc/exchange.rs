//! What each rank has for each other.

use super::collective::{Datum, layout};
use super::session::Session;
use mpi::datatype::{Partition, PartitionMut};
use mpi::traits::CommunicatorCollectives;
use std::ops::Range;

impl Session {
    /// Sends entries of `width` values to ranks, `ranks[k]` being that of entry `k`, and gives what came: rank after rank, in the
    /// order in which each listed them. **Collective**
    pub fn send_to<T: Datum>(&self, ranks: &[usize], entries: &[T], width: usize) -> Vec<T> {
        let mut order: Vec<usize> = (0..ranks.len()).collect();
        order.sort_by_key(|&k| ranks[k]);
        let mut counts = vec![0; self.size()];
        ranks.iter().for_each(|&rank| counts[rank] += 1);
        let sorted: Vec<T> = order.iter().flat_map(|&k| &entries[width * k..width * (k + 1)]).copied().collect();
        let arriving = self.counts_to_each(&counts);
        self.to_each(&sorted, &counts, &arriving, width)
    }

    /// The rank that owns a number: each rank owns a range, `count` long on this one, and these follow each other. **Collective**
    pub(super) fn owners(&self, count: usize) -> impl Fn(usize) -> usize + use<> {
        let mut ends = self.gather_counts(count);
        (1..ends.len()).for_each(|rank| ends[rank] += ends[rank - 1]);
        move |number| ends.partition_point(|end| *end <= number)
    }

    /// How many entries each rank has for this one, from how many this one has for each. **Collective**
    pub(super) fn counts_to_each(&self, counts: &[usize]) -> Vec<usize> {
        let mut arriving = vec![0; self.size()];
        self.world().all_to_all_into(counts, &mut arriving[..]);
        arriving
    }

    /// Sends each rank its part of `all`, `width` values for each entry, and gives what came, rank after rank. **Collective**
    pub(super) fn to_each<T: Datum>(&self, all: &[T], counts: &[usize], arriving: &[usize], width: usize) -> Vec<T> {
        let ([sent, from], [received, to]) = (layout(counts, width), layout(arriving, width));
        let mut arrived = vec![T::default(); width * arriving.iter().sum::<usize>()];
        self.world()
            .all_to_all_varcount_into(&Partition::new(all, sent, from), &mut PartitionMut::new(&mut arrived[..], received, to));
        arrived
    }

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
