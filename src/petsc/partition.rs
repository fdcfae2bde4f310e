//! Division of a graph into parts.

use super::error::{Result, given_back, petsc};
use super::ffi::{self, Index};
use super::index_set::IndexSet;
use super::matrix::Matrix;
use super::session::Session;
use super::vector::length;
use std::ptr;

/// Divides a graph into `parts` of about equal weight with few edges between them; the part of each vertex.
/// The whole graph is given, the same on every rank, and so is the result; it depends on the
/// arguments and the number of ranks alone. Such a graph and its parts are counted in 32 bits, whatever PETSc's indices have.
/// **Collective**
///
/// | argument | length | |
/// |---|---|---|
/// | `offsets` | vertices + 1 | neighbours of vertex v stand at `offsets[v] .. offsets[v + 1]` |
/// | `neighbours` | `offsets[vertices]` | without v itself; each edge stands at both of its ends |
/// | `edge_weights` | same | > 0, equal at both ends |
/// | `vertex_weights` | vertices | > 0; their sum is less than 2³¹ |
///
/// # Panics
/// If a length is wrong.
pub fn partition(
    session: &Session,
    parts: usize,
    offsets: &[i32],
    neighbours: &[i32],
    edge_weights: &[i32],
    vertex_weights: &[i32],
) -> Result<Vec<i32>> {
    let vertices = offsets.len().checked_sub(1).expect("offsets has vertices + 1 entries");
    assert!(
        neighbours.len() == offsets[vertices] as usize && edge_weights.len() == neighbours.len(),
        "neighbours end at the last offset"
    );
    assert_eq!(vertex_weights.len(), vertices, "each vertex has a weight");
    if parts == 1 {
        return Ok(vec![0; vertices]);
    }
    if size_of::<Index>() > 4 && unsafe { ffi::mezha_scotch_number_size() } == 4 {
        return by_scotch_itself(session, parts, [offsets, neighbours, edge_weights, vertex_weights]);
    }

    // This rank's share: vertices first .. end.
    let [first, end] = [session.rank(), session.rank() + 1].map(|rank| rank * vertices / session.size());
    let entries = offsets[first] as usize..offsets[end] as usize;
    let own_offsets = offsets[first..=end].iter().map(|offset| offset - offsets[first]);
    let rows = handed_over(own_offsets)?;
    let columns = handed_over(neighbours[entries.clone()].iter().copied())?;
    let weights = handed_over(edge_weights[entries].iter().copied())?;
    let mut graph = ptr::null_mut();
    petsc!(MatCreateMPIAdj(session.raw(), length(end - first), length(vertices), rows, columns, weights, &mut graph))?;
    let graph = Matrix::from_raw(session, graph);

    let partitioning = Partitioning::new(session)?;
    petsc!(MatPartitioningSetAdjacency(partitioning.0, graph.raw))?;
    petsc!(MatPartitioningSetType(partitioning.0, c"ptscotch".as_ptr()))?;
    petsc!(MatPartitioningSetNParts(partitioning.0, length(parts)))?;
    if vertex_weights.iter().any(|weight| *weight != 1) {
        petsc!(MatPartitioningSetVertexWeights(partitioning.0, handed_over(vertex_weights[first..end].iter().copied())?))?;
    }
    petsc!(MatPartitioningSetUseEdgeWeights(partitioning.0, ffi::flag(true)))?;
    // Scotch draws random numbers: from the same start, so that a partition does not depend on earlier ones.
    unsafe { ffi::mezha_restart_scotch() };
    let mut part = ptr::null_mut();
    petsc!(MatPartitioningApply(partitioning.0, &mut part))?;
    let own = IndexSet::from_raw(session, part).indices()?;
    #[allow(clippy::unnecessary_cast, reason = "an index may have 64 bits")]
    let own: Vec<i32> = own.into_iter().map(|part| part as i32).collect();
    Ok(session.gather_all(&own))
}

/// The partition of a graph by Scotch on rank 0 alone. Debian's PETSc of 64-bit indices has a Scotch of 32-bit numbers, and would have it read
/// each index as two of them. **Collective**
fn by_scotch_itself(session: &Session, parts: usize, graph: [&[i32]; 4]) -> Result<Vec<i32>> {
    let [offsets, neighbours, edge_weights, vertex_weights] = graph;
    let mut part = vec![0; if session.rank() == 0 { vertex_weights.len() } else { 0 }];
    if session.rank() == 0 {
        unsafe { ffi::mezha_restart_scotch() };
        petsc!(mezha_scotch_partition(
            parts as i32,
            vertex_weights.len() as i32,
            offsets.as_ptr(),
            neighbours.as_ptr(),
            edge_weights.as_ptr(),
            vertex_weights.as_ptr(),
            part.as_mut_ptr()
        ))?;
    }
    Ok(session.gather_all(&part))
}

/// A copy as PETSc counts, which it will free.
fn handed_over(values: impl Iterator<Item = i32>) -> Result<*mut Index> {
    let values: Vec<Index> = values.map(|value| value as Index).collect();
    let mut memory = ptr::null_mut();
    petsc!(mezha_malloc(size_of_val(&values[..]).max(1), &mut memory))?;
    let memory = memory.cast::<Index>();
    unsafe { ptr::copy_nonoverlapping(values.as_ptr(), memory, values.len()) };
    Ok(memory)
}

struct Partitioning(ffi::MatPartitioning);

impl Partitioning {
    fn new(session: &Session) -> Result<Self> {
        let mut raw = ptr::null_mut();
        petsc!(MatPartitioningCreate(session.raw(), &mut raw))?;
        Ok(Self(raw))
    }
}

given_back!(Partitioning, 0, MatPartitioningDestroy);
