//! Vectors that look at parts of other vectors.

use super::error::{Result, petsc};
use super::ffi;
use super::session::Session;
use super::vector::{Vector, length};
use std::ptr;

/// A vector without values of its own: for the length of a call it has those that it is lent.
pub struct Window(Vector);

impl Window {
    /// Onto `local` values on this rank. **Collective**
    pub fn new(session: &Session, local: usize) -> Result<Self> {
        let mut raw = ptr::null_mut();
        let (n, comm) = (length(local), session.raw());
        if session.size() == 1 {
            petsc!(VecCreateSeqWithArray(comm, 1, n, ptr::null(), &mut raw))?;
        } else {
            petsc!(VecCreateMPIWithArray(comm, 1, n, ffi::mezha_determine, ptr::null(), &mut raw))?;
        }
        Ok(Self(Vector::from_raw(session, raw)))
    }

    /// Shows `values` as a vector that `with` may read. **Collective** as `with` is.
    ///
    /// # Panics
    /// If there are not as many as the window has.
    pub fn read<T>(&self, values: &[f64], with: impl FnOnce(&Vector) -> Result<T>) -> Result<T> {
        assert_eq!(values.len(), self.0.local_len(), "as many values as the window has");
        petsc!(VecPlaceArray(self.0.raw, values.as_ptr()))?;
        let outcome = with(&self.0);
        petsc!(VecResetArray(self.0.raw))?;
        outcome
    }

    /// Shows `values` as a vector that `with` may write to. **Collective** as `with` is.
    ///
    /// # Panics
    /// If there are not as many as the window has.
    pub fn write<T>(&mut self, values: &mut [f64], with: impl FnOnce(&mut Vector) -> Result<T>) -> Result<T> {
        assert_eq!(values.len(), self.0.local_len(), "as many values as the window has");
        petsc!(VecPlaceArray(self.0.raw, values.as_mut_ptr()))?;
        let outcome = with(&mut self.0);
        petsc!(VecResetArray(self.0.raw))?;
        outcome
    }
}
