//! How many ranks a level of multigrid is spread over.

/// Unknowns up to which a level is brought together on one rank, and factorised if it is the coarsest: larger ones get auxiliary
/// levels.
pub const SMALL: usize = 3000;

/// Unknowns of a larger level for each of the ranks that it is spread over, at least: with fewer, its messages would take longer
/// than its work.
const FEWEST: usize = 1000;

/// Of how many ranks one takes what all of them have of a level with so many unknowns: a power of two, and all of them if the
/// level is small.
pub fn ranks_together(unknowns: usize, ranks: usize) -> usize {
    let all = ranks.next_power_of_two();
    if unknowns <= SMALL { all } else { (FEWEST * ranks).div_ceil(unknowns).next_power_of_two().min(all) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_levels_are_on_one_rank_and_large_ones_on_all() {
        for ranks in [1_usize, 2, 3, 5, 64, 10_000] {
            let share = |unknowns: usize| ranks.div_ceil(ranks_together(unknowns, ranks));
            assert_eq!([1, 2, SMALL].map(share), [1; 3], "{ranks} ranks");
            assert_eq!(share(FEWEST * ranks + SMALL), ranks);
            let mut before = 1;
            for unknowns in (SMALL + 1..4 * FEWEST * ranks).step_by(977) {
                let now = share(unknowns);
                // Groups are powers of two: so there may be up to twice as many unknowns on each rank.
                assert!(
                    now >= before && (now == 1 || now * FEWEST <= unknowns + FEWEST),
                    "{unknowns} unknowns on {now} of {ranks}"
                );
                before = now;
            }
        }
    }
}
