//! What all ranks tell each other.

use super::broadcast::broadcast;
use super::session::Session;
use mpi::collective::SystemOperation;
use mpi::datatype::PartitionMut;
use mpi::traits::{Communicator, CommunicatorCollectives, Equivalence, Root};

/// Numbers that ranks can send each other: integers and reals.
pub trait Datum: Equivalence + Copy + Default {}
impl<T: Equivalence + Copy + Default> Datum for T {}

impl Session {
    /// The values of all ranks, in the order of the ranks. **Collective**
    pub fn gather_all<T: Datum>(&self, local: &[T]) -> Vec<T> {
        let counts = self.gather_counts(local.len());
        let mut all = vec![T::default(); counts.iter().sum()];
        let [counts, starts] = layout(&counts, 1);
        self.world().all_gather_varcount_into(local, &mut PartitionMut::new(&mut all[..], counts, starts));
        all
    }

    /// The number `n` of every rank. **Collective**
    pub fn gather_counts(&self, n: usize) -> Vec<usize> {
        let mut all = vec![0; self.size()];
        self.world().all_gather_into(&n, &mut all[..]);
        all
    }

    /// Each value with its sum over the ranks in its place, bit for bit the same on every rank. **Collective**
    pub fn sum<V: AsMut<[f64]>>(&self, mut values: V) -> V {
        let (root, sums) = (self.world().process_at_rank(0), values.as_mut());
        let here = sums.to_vec();
        if self.rank() == 0 {
            root.reduce_into_root(&here[..], sums, SystemOperation::sum());
        } else {
            root.reduce_into(&here[..], SystemOperation::sum());
        }
        root.broadcast_into(sums);
        values
    }

    /// Each value with its maximum over the ranks in its place. **Collective**
    pub fn max<V: AsMut<[f64]>>(&self, mut values: V) -> V {
        let here = values.as_mut().to_vec();
        self.world().all_reduce_into(&here[..], values.as_mut(), SystemOperation::max());
        values
    }

    /// Number of ranks on the machine of this one, which share its memory. **Collective**
    pub fn ranks_here(&self) -> usize {
        self.world().split_shared(0).size() as usize
    }

    /// Whether any rank says so. **Collective**
    pub fn any(&self, here: bool) -> bool {
        let mut anywhere = 0_i32;
        self.world().all_reduce_into(&i32::from(here), &mut anywhere, SystemOperation::max());
        anywhere != 0
    }

    /// Lets every rank know whether all are well, so that none goes on alone. **Collective**
    ///
    /// # Errors
    /// On a rank that failed, its own message; on the others the message of the lowest rank that did.
    pub fn agree<T, E: ToString>(&self, outcome: std::result::Result<T, E>) -> std::result::Result<T, String> {
        let own = outcome.map_err(|error| error.to_string());
        let mut failed = 0;
        let here = if own.is_ok() { self.size() } else { self.rank() };
        self.world().all_reduce_into(&here, &mut failed, SystemOperation::min());
        if failed == self.size() {
            return own;
        }
        let message = own.as_ref().err().map(|text| text.clone().into_bytes()).unwrap_or_default();
        let message = broadcast(self.world(), failed, message);
        own.and_then(|_| Err(format!("another rank failed: {}", String::from_utf8_lossy(&message))))
    }

    /// What rank 0 has got, on every rank: it alone reads, so that all work on the same bytes. **Collective**
    ///
    /// # Errors
    /// The error of rank 0, in its words, on every rank.
    pub fn share<E: ToString>(
        &self,
        on_rank_0: impl FnOnce() -> std::result::Result<Vec<u8>, E>,
    ) -> std::result::Result<Vec<u8>, String> {
        let own = if self.rank() == 0 { on_rank_0().map_err(|error| error.to_string()) } else { Ok(Vec::new()) };
        let failed = self.any(own.is_err());
        let bytes = broadcast(self.world(), 0, own.unwrap_or_else(String::into_bytes));
        if failed { Err(String::from_utf8_lossy(&bytes).into_owned()) } else { Ok(bytes) }
    }
}

/// Counts and starts of consecutive parts, as MPI takes them.
pub(super) fn layout(counts: &[usize], width: usize) -> [Vec<i32>; 2] {
    let mut end = 0;
    let starts = counts.iter().map(|count| {
        end += count * width;
        end - count * width
    });
    let in_32_bits = |n: usize| i32::try_from(n).expect("MPI counts in 32 bits");
    let starts = starts.map(in_32_bits).collect();
    [counts.iter().map(|count| in_32_bits(count * width)).collect(), starts]
}
