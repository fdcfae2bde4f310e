//! Lists of numbers without repetitions.

/// These numbers ascending, each once.
pub fn each_once<T: Ord>(numbers: impl IntoIterator<Item = T>) -> Vec<T> {
    let mut all: Vec<T> = numbers.into_iter().collect();
    all.sort_unstable();
    all.dedup();
    all
}
