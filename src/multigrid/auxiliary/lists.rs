//! Lists of entries in one piece of memory.

/// A list of entries for each of some nodes.
pub struct Lists<T> {
    starts: Vec<u32>,
    entries: Vec<T>,
}

impl<T: Copy + Default> Lists<T> {
    /// From pairs of a list and an entry, which stay in their order within each list.
    pub fn new(count: usize, pairs: impl Iterator<Item = (usize, T)> + Clone) -> Self {
        let mut starts = vec![0; count + 1];
        pairs.clone().for_each(|(list, _)| starts[list + 1] += 1);
        (0..count).for_each(|list| starts[list + 1] += starts[list]);
        let (mut next, mut entries) = (starts.clone(), vec![T::default(); starts[count] as usize]);
        for (list, entry) in pairs {
            entries[next[list] as usize] = entry;
            next[list] += 1;
        }
        Self { starts, entries }
    }

    /// The entries of a list.
    #[inline(always)]
    pub fn of(&self, list: usize) -> &[T] {
        &self.entries[self.starts[list] as usize..self.starts[list + 1] as usize]
    }
}
