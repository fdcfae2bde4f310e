//! Bytes of one rank, on every rank.

use mpi::collective::SystemOperation;
use mpi::topology::SimpleCommunicator;
use mpi::traits::{Communicator, CommunicatorCollectives, Root};

/// MPI counts in 32 bits: longer texts are sent in pieces.
const PIECE: usize = 1 << 30;

/// The bytes of one rank, on every rank. **Collective**
pub(super) fn broadcast(world: &SimpleCommunicator, rank: usize, mut bytes: Vec<u8>) -> Vec<u8> {
    let root = world.process_at_rank(rank as i32);
    let mut length = bytes.len();
    root.broadcast_into(&mut length);
    bytes.resize(length, 0);
    bytes.chunks_mut(PIECE).for_each(|piece| root.broadcast_into(piece));
    bytes
}

/// The lowest rank that has other bytes than rank 0, and those bytes; None if there is none. **Collective**
pub(super) fn odd_one(world: &SimpleCommunicator, bytes: &[u8]) -> Option<(usize, Vec<u8>)> {
    let (rank, size) = (world.rank() as usize, world.size() as usize);
    let first = broadcast(world, 0, if rank == 0 { bytes.to_vec() } else { Vec::new() });
    let mut odd = 0;
    world.all_reduce_into(&if bytes == first { size } else { rank }, &mut odd, SystemOperation::min());
    (odd < size).then(|| (odd, broadcast(world, odd, if rank == odd { bytes.to_vec() } else { Vec::new() })))
}
