//! How many ranks a level of multigrid is spread over.

/// Unknowns up to which a level is brought together on one rank, and factorised if it is the coarsest: larger ones get auxiliary
/// levels.
pub const SMALL: usize = 3000;

/// Unknowns of a larger level for each of the ranks that it is spread over, at least: with fewer, its messages would take longer
/// than its work.
const LEAST_ON_A_RANK: usize = 1000;

/// Ranks in each group, of which one takes all nodes of a level with so many unknowns: a power of two, and all ranks are one group
/// if the level is small.
pub fn ranks_in_group(unknowns: usize, ranks: usize) -> usize {
    let all = ranks.next_power_of_two();
    if unknowns <= SMALL { all } else { (LEAST_ON_A_RANK * ranks).div_ceil(unknowns).next_power_of_two().min(all) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_levels_are_on_one_rank_and_large_ones_on_all() {
        for ranks in [1_usize, 2, 3, 5, 64, 10_000] {
            let share = |unknowns: usize| ranks.div_ceil(ranks_in_group(unknowns, ranks));
            assert_eq!([1, 2, SMALL].map(share), [1; 3], "{ranks} ranks");
            assert_eq!(share(LEAST_ON_A_RANK * ranks + SMALL), ranks);
            let mut before = 1;
            for unknowns in (SMALL + 1..4 * LEAST_ON_A_RANK * ranks).step_by(977) {
                let now = share(unknowns);
                // The last group may be incomplete: one rank more. Groups are powers of two: twice as many unknowns on a rank at most.
                assert!(
                    now >= before && (now == 1 || now * LEAST_ON_A_RANK <= unknowns + LEAST_ON_A_RANK),
                    "{unknowns} unknowns on {now} of {ranks}"
                );
                before = now;
            }
        }
    }
}
