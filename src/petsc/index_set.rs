//! Sets of global numbers.

use super::error::{Result, given_back, petsc};
use super::ffi::{self, Index};
use super::session::Session;
use std::ptr;

/// A distributed set of global numbers, such as the unknowns of one field.
pub struct IndexSet {
    pub(super) raw: ffi::IS,
    _session: Session,
}

impl IndexSet {
    /// Takes over one reference to an index set of PETSc's.
    pub(super) fn from_raw(session: &Session, raw: ffi::IS) -> Self {
        Self { raw, _session: session.clone() }
    }

    /// The numbers on this rank.
    pub fn indices(&self) -> Result<Vec<Index>> {
        let (mut count, mut array) = (0, ptr::null());
        petsc!(ISGetLocalSize(self.raw, &mut count))?;
        petsc!(ISGetIndices(self.raw, &mut array))?;
        let indices = if count == 0 { Vec::new() } else { unsafe { std::slice::from_raw_parts(array, count as usize) }.to_vec() };
        petsc!(ISRestoreIndices(self.raw, &mut array))?;
        Ok(indices)
    }
}

given_back!(IndexSet, raw, ISDestroy);
