//! Entries of a distributed vector that a rank needs and others own.

use super::error::{Result, given_back, petsc};
use super::ffi;
use super::index::Index;
use super::index_set::IndexSet;
use super::vector::{Vector, length};
use std::ops::Deref;
use std::ptr;

/// Brings chosen entries of a vector, from whatever rank, to this one.
pub struct Gather {
    raw: ffi::VecScatter,
    /// Where the entries arrive, a vector of this rank alone.
    arrived: Vector,
}

impl Gather {
    /// Prepares to fetch the entries `indices` (global, any order, repeats allowed, each rank its own)
    /// from vectors laid out like `layout`. **Collective**
    pub fn new(layout: &Vector, indices: &[Index]) -> Result<Self> {
        let session = &layout.session;
        let alone = unsafe { mpi::ffi::RSMPI_COMM_SELF };
        let mut from = ptr::null_mut();
        petsc!(ISCreateGeneral(
            alone,
            length(indices.len()),
            indices.as_ptr(),
            ffi::PetscCopyMode::PETSC_COPY_VALUES,
            &mut from
        ))?;
        let from = IndexSet::from_raw(session, from);
        let arrived = Vector::alone(session, indices.len())?;
        let mut raw = ptr::null_mut();
        petsc!(VecScatterCreate(layout.raw, from.raw, arrived.raw, ptr::null_mut(), &mut raw))?;
        Ok(Self { raw, arrived })
    }

    /// The chosen entries of `vector`, in the order of the indices. **Collective**
    pub fn fetch(&mut self, vector: &Vector) -> Result<Vec<f64>> {
        Ok(self.read(vector)?.to_vec())
    }

    /// The chosen entries of `vector`, in the order of the indices, without a copy: the next gather writes to the same place, so this
    /// one is borrowed for as long. **Collective**
    pub fn read(&mut self, vector: &Vector) -> Result<impl Deref<Target = [f64]> + '_> {
        let (insert, forward) = (ffi::InsertMode::INSERT_VALUES, ffi::ScatterMode::SCATTER_FORWARD);
        petsc!(VecScatterBegin(self.raw, vector.raw, self.arrived.raw, insert, forward))?;
        petsc!(VecScatterEnd(self.raw, vector.raw, self.arrived.raw, insert, forward))?;
        Ok(self.arrived.values())
    }
}

given_back!(Gather, raw, VecScatterDestroy);
