//! Values at nodes of other ranks, from neighbour to neighbour, while this rank goes on with its own.

use super::collective::Datum;
use super::session::Session;
use mpi::request::multiple_scope;
use mpi::traits::{Communicator, Destination, Source};
use std::ops::Range;

/// Nodes of other ranks that this one needs, and nodes of its own that others need.
pub struct Halo {
    session: Session,
    /// Ranks that own what this one needs, and how many nodes of each: in their order.
    from: Vec<(i32, usize)>,
    /// Ranks that need nodes of this one, and which of `sent` these are.
    to: Vec<(i32, Range<usize>)>,
    /// Nodes of this rank, counted from its first.
    sent: Vec<u32>,
}

impl Halo {
    /// For the nodes `far` (global numbers, ascending) of other ranks, each of which owns a range. **Collective**
    pub fn new(session: &Session, own: &Range<usize>, far: &[usize]) -> Self {
        let size = session.size();
        if size == 1 {
            return Self { session: session.clone(), from: Vec::new(), to: Vec::new(), sent: Vec::new() };
        }
        let owner = session.owners(own.len());
        let from: Vec<(i32, usize)> =
            far.chunk_by(|a, b| owner(*a) == owner(*b)).map(|part| (owner(part[0]) as i32, part.len())).collect();
        let mut wanted = vec![0; size];
        from.iter().for_each(|&(rank, count)| wanted[rank as usize] = count);
        let asked = session.counts_to_each(&wanted);
        let numbers: Vec<u64> = far.iter().map(|&node| node as u64).collect();
        let sent = session.to_each(&numbers, &wanted, &asked, 1);
        let asked: Vec<(i32, usize)> = (0..size as i32).zip(asked).filter(|(_, count)| *count > 0).collect();
        let to = parts(&asked).collect();
        let sent = sent.into_iter().map(|node| (node as usize - own.start) as u32).collect();
        Self { session: session.clone(), from, to, sent }
    }

    /// Brings the values of the far nodes, in their order, and does `meanwhile` what needs none of them. **Collective**
    pub fn fetch<T: Datum, const K: usize>(&self, x: &[[T; K]], far: &mut [[T; K]], meanwhile: impl FnOnce()) {
        self.bring(&self.sent(x), far, meanwhile);
    }

    /// Brings the values of the far nodes, in their order, and does `meanwhile`, which changes the values here: other ranks get the
    /// unchanged ones. **Collective**
    pub fn fetch_before<T: Datum>(&self, x: &mut [[T; 2]], far: &mut [[T; 2]], meanwhile: impl FnOnce(&mut [[T; 2]])) {
        let sent = self.sent(x);
        self.bring(&sent, far, || meanwhile(x));
    }

    /// The values that other ranks need.
    fn sent<T: Datum, const K: usize>(&self, x: &[[T; K]]) -> Vec<[T; K]> {
        self.sent.iter().map(|&node| x[node as usize]).collect()
    }

    fn bring<T: Datum, const K: usize>(&self, sent: &[[T; K]], far: &mut [[T; K]], meanwhile: impl FnOnce()) {
        let from: Vec<(i32, Range<usize>)> = parts(&self.from).collect();
        let (sent, far) = ((sent.as_flattened(), &*times(K, &self.to)), (far.as_flattened_mut(), &*times(K, &from)));
        exchange(&self.session, sent, far, meanwhile);
    }

    /// Adds what this rank has for the far nodes to the values of their owners. **Collective**
    pub fn give<T: Datum + std::ops::AddAssign, const K: usize>(&self, far: &[[T; K]], y: &mut [[T; K]]) {
        let mut arrived = vec![[T::default(); K]; self.sent.len()];
        let from: Vec<(i32, Range<usize>)> = parts(&self.from).collect();
        let (far, here) = ((far.as_flattened(), &*times(K, &from)), (arrived.as_flattened_mut(), &*times(K, &self.to)));
        exchange(&self.session, far, here, || ());
        for (&node, value) in self.sent.iter().zip(arrived) {
            (0..K).for_each(|k| y[node as usize][k] += value[k]);
        }
    }
}

/// Consecutive parts of a list for some ranks, from how many entries each has.
fn parts(counts: &[(i32, usize)]) -> impl Iterator<Item = (i32, Range<usize>)> {
    let mut end = 0;
    counts.iter().map(move |&(rank, count)| {
        end += count;
        (rank, end - count..end)
    })
}

/// Parts of a list of nodes as parts of the list of their values, so many for each node.
fn times(count: usize, parts: &[(i32, Range<usize>)]) -> Vec<(i32, Range<usize>)> {
    parts.iter().map(|(rank, range)| (*rank, count * range.start..count * range.end)).collect()
}

/// Sends parts of a list and receives those of another, which follow each other in it; does `meanwhile` while they are under way.
/// **Collective** among the ranks that are named.
fn exchange<T: Datum>(
    session: &Session,
    (sent, to): (&[T], &[(i32, Range<usize>)]),
    (received, from): (&mut [T], &[(i32, Range<usize>)]),
    meanwhile: impl FnOnce(),
) {
    let world = session.world();
    multiple_scope(from.len() + to.len(), |scope, requests| {
        let mut rest = received;
        for (rank, range) in from {
            let part = rest.split_off_mut(..range.len()).expect("room for all values");
            requests.add(world.process_at_rank(*rank).immediate_receive_into(scope, part));
        }
        for (rank, range) in to {
            requests.add(world.process_at_rank(*rank).immediate_send(scope, &sent[range.clone()]));
        }
        meanwhile();
        requests.wait_all(&mut Vec::new());
    });
}
