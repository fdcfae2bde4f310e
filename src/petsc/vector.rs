//! Distributed vectors.

use super::error::{Result, given_back, petsc};
use super::ffi::{self, Index};
use super::session::Session;
use std::ops::{Deref, DerefMut, Range};
use std::{ptr, slice};

/// A vector whose entries lie in consecutive ranges on the ranks.
pub struct Vector {
    pub(super) raw: ffi::Vec,
    pub(super) session: Session,
}

impl Vector {
    /// A vector of zeros with `local` entries on this rank. **Collective**
    pub fn new(session: &Session, local: usize) -> Result<Self> {
        let mut raw = ptr::null_mut();
        petsc!(VecCreate(session.raw(), &mut raw))?;
        let vector = Self { raw, session: session.clone() };
        petsc!(VecSetSizes(raw, length(local), ffi::mezha_determine))?;
        petsc!(VecSetType(raw, c"standard".as_ptr()))?;
        Ok(vector)
    }

    /// Takes over one reference to a vector of PETSc's.
    pub(super) fn from_raw(session: &Session, raw: ffi::Vec) -> Self {
        Self { raw, session: session.clone() }
    }

    /// A new vector of the same layout. **Collective**
    pub fn duplicate(&self) -> Result<Self> {
        let mut raw = ptr::null_mut();
        petsc!(VecDuplicate(self.raw, &mut raw))?;
        Ok(Self::from_raw(&self.session, raw))
    }

    /// The entries of this rank, to read.
    pub fn values(&self) -> impl Deref<Target = [f64]> + '_ {
        let (mut array, count) = (ptr::null(), self.local_len());
        petsc!(VecGetArrayRead(self.raw, &mut array)).expect("a vector lends its array");
        let values = if count == 0 { &[][..] } else { unsafe { slice::from_raw_parts(array, count) } };
        LentArray { raw: self.raw, values, give_back: give_back_read }
    }

    /// The entries of this rank, to change.
    pub fn values_mut(&mut self) -> impl DerefMut<Target = [f64]> + '_ {
        let (mut array, count) = (ptr::null_mut(), self.local_len());
        petsc!(VecGetArray(self.raw, &mut array)).expect("a vector lends its array");
        let values = if count == 0 { &mut [][..] } else { unsafe { slice::from_raw_parts_mut(array, count) } };
        LentArray { raw: self.raw, values, give_back: give_back_written }
    }

    /// Sets every entry to `value`. **Collective**
    pub fn set(&mut self, value: f64) -> Result<()> {
        petsc!(VecSet(self.raw, value))
    }

    /// Euclidean norm. **Collective**
    pub fn norm(&self) -> Result<f64> {
        let mut norm = 0.0;
        petsc!(VecNorm(self.raw, ffi::NormType::NORM_2, &mut norm))?;
        Ok(norm)
    }

    /// `self += factor · other`. **Collective**
    pub fn axpy(&mut self, factor: f64, other: &Self) -> Result<()> {
        petsc!(VecAXPY(self.raw, factor, other.raw))
    }

    /// Takes the values of `other`, of the same layout. **Collective**
    pub fn copy_from(&mut self, other: &Self) -> Result<()> {
        petsc!(VecCopy(other.raw, self.raw))
    }

    /// Number of entries on this rank.
    pub fn local_len(&self) -> usize {
        self.range().len()
    }

    /// Global numbers of the entries of this rank.
    pub fn range(&self) -> Range<usize> {
        let (mut first, mut end) = (0, 0);
        petsc!(VecGetOwnershipRange(self.raw, &mut first, &mut end)).expect("a vector knows its range");
        first as usize..end as usize
    }
}

given_back!(Vector, raw, VecDestroy);

/// A vector that PETSc lends for the length of a call.
pub(super) struct Lent(Vector);

impl Lent {
    /// Takes no reference and gives none back.
    pub(super) fn new(session: &Session, raw: ffi::Vec) -> Self {
        Self(Vector { raw, session: session.clone() })
    }
}

impl Drop for Lent {
    /// What is destroyed next is nothing.
    fn drop(&mut self) {
        self.0.raw = ptr::null_mut();
    }
}

impl Deref for Lent {
    type Target = Vector;
    fn deref(&self) -> &Vector {
        &self.0
    }
}

impl DerefMut for Lent {
    fn deref_mut(&mut self) -> &mut Vector {
        &mut self.0
    }
}

/// A length as PETSc counts.
///
/// # Panics
/// Beyond what an [`Index`] holds.
#[inline]
pub(super) fn length(count: usize) -> Index {
    Index::try_from(count).expect("a length that PETSc can count")
}

/// The local array of a vector while PETSc lends it.
struct LentArray<S: Deref<Target = [f64]>> {
    raw: ffi::Vec,
    values: S,
    give_back: fn(ffi::Vec, *const f64),
}

impl<S: Deref<Target = [f64]>> Deref for LentArray<S> {
    type Target = [f64];
    fn deref(&self) -> &[f64] {
        &self.values
    }
}

impl<S: DerefMut<Target = [f64]>> DerefMut for LentArray<S> {
    fn deref_mut(&mut self) -> &mut [f64] {
        &mut self.values
    }
}

impl<S: Deref<Target = [f64]>> Drop for LentArray<S> {
    fn drop(&mut self) {
        (self.give_back)(self.raw, self.values.as_ptr());
    }
}

fn give_back_read(raw: ffi::Vec, mut array: *const f64) {
    unsafe { ffi::VecRestoreArrayRead(raw, &mut array) };
}

fn give_back_written(raw: ffi::Vec, array: *const f64) {
    unsafe { ffi::VecRestoreArray(raw, &mut array.cast_mut()) };
}
