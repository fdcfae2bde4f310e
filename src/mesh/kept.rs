//! Lists of which some entries are left out.

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
