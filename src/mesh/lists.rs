//! Lists: of numbers without repetitions, of which some entries are left out, and many of them in one piece of memory.

/// These numbers ascending, each once.
pub fn each_once<T: Ord>(numbers: impl IntoIterator<Item = T>) -> Vec<T> {
    let mut all: Vec<T> = numbers.into_iter().collect();
    all.sort_unstable();
    all.dedup();
    all
}

/// New numbers of what is kept of a list, in its order.
pub(super) struct Kept(Vec<Option<u32>>);

impl Kept {
    /// Of so many entries those that are `used`, each as often as it may be.
    pub fn new(all: usize, used: impl Iterator<Item = u32>) -> Self {
        let mut kept = vec![None; all];
        used.for_each(|at| kept[at as usize] = Some(0));
        kept.iter_mut().flatten().zip(0..).for_each(|(number, new)| *number = new);
        Self(kept)
    }

    /// The new number of an entry, if it is kept.
    pub fn at(&self, old: u32) -> Option<u32> {
        self.0[old as usize]
    }

    /// Entries that are kept.
    pub fn of<T: Clone>(&self, all: &[T]) -> Vec<T> {
        all.iter().zip(&self.0).filter(|(_, new)| new.is_some()).map(|(entry, _)| entry.clone()).collect()
    }
}

/// Lists of entries, numbered from 0, in one piece of memory.
#[derive(Clone, Debug)]
pub struct Lists<T> {
    /// Where each list begins, and the end of the last.
    starts: Vec<u32>,
    entries: Vec<T>,
}

impl<T> Default for Lists<T> {
    fn default() -> Self {
        Self { starts: vec![0], entries: Vec::new() }
    }
}

impl<T> Lists<T> {
    /// How many lists there are.
    pub fn count(&self) -> usize {
        self.starts.len() - 1
    }

    /// All entries of all lists, in their order.
    pub fn entries(&self) -> &[T] {
        &self.entries
    }

    /// The entries of a list.
    #[inline(always)]
    pub fn of(&self, list: usize) -> &[T] {
        &self.entries[self.starts[list] as usize..self.starts[list + 1] as usize]
    }

    /// The lists, one after the other.
    pub fn iter(&self) -> impl Iterator<Item = &[T]> {
        self.starts.windows(2).map(|ends| &self.entries[ends[0] as usize..ends[1] as usize])
    }

    /// Adds a list behind the last one.
    pub fn push(&mut self, entries: impl IntoIterator<Item = T>) {
        self.entries.extend(entries);
        self.starts.push(self.entries.len() as u32);
    }

    /// Sorts the entries of each list.
    pub fn sort(&mut self)
    where
        T: Ord,
    {
        let Self { starts, entries } = self;
        starts.windows(2).for_each(|ends| entries[ends[0] as usize..ends[1] as usize].sort_unstable());
    }
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
}
