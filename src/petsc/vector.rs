//! Distributed vectors.

use super::error::{Result, give_back, petsc};
use super::ffi;
use super::index::Index;
use super::session::Session;
use std::ops::{Deref, DerefMut, Range};
use std::{ptr, slice};

/// A vector whose entries lie in consecutive ranges on the ranks.
pub struct Vector {
    raw: ffi::Vec,
    session: Session,
}

impl Vector {
    /// A vector of zeros with `local` entries on this rank. **Collective**
    pub fn new(session: &Session, local: usize) -> Result<Self> {
        let mut raw = ptr::null_mut();
        petsc!(VecCreate(session.raw(), &mut raw))?;
        let vector = Self { raw, session: session.clone() };
        petsc!(VecSetSizes(raw, length(local), ffi::mezha_determine))?;
        petsc!(VecSetType(raw, c"standard".as_ptr()))?;
        vector.skipping_negative()
    }

    /// Takes over one reference to a vector of PETSc's.
    pub(super) fn from_raw(session: &Session, raw: ffi::Vec) -> Result<Self> {
        Self { raw, session: session.clone() }.skipping_negative()
    }

    /// A new vector of the same layout. **Collective**
    pub fn duplicate(&self) -> Result<Self> {
        let mut raw = ptr::null_mut();
        petsc!(VecDuplicate(self.raw, &mut raw))?;
        Self::from_raw(&self.session, raw)
    }

    fn skipping_negative(self) -> Result<Self> {
        petsc!(VecSetOption(self.raw, ffi::VecOption::VEC_IGNORE_NEGATIVE_INDICES, ffi::flag(true)))?;
        Ok(self)
    }

    pub(super) fn raw(&self) -> ffi::Vec {
        self.raw
    }

    pub(super) fn session(&self) -> &Session {
        &self.session
    }

    /// The entries of this rank, to read.
    pub fn values(&self) -> impl Deref<Target = [f64]> + '_ {
        Values::of(self.raw).expect("a vector lends its array")
    }

    /// The entries of this rank, to change.
    pub fn values_mut(&mut self) -> impl DerefMut<Target = [f64]> + '_ {
        ValuesMut::of(self.raw).expect("a vector lends its array")
    }

    /// Adds `values` to the entries `indices` (global; negative ones are skipped), of this rank or any other.
    /// Holds after [`Vector::assemble`].
    ///
    /// # Panics
    /// If there are not as many values as indices.
    #[inline]
    pub fn add(&mut self, indices: &[Index], values: &[f64]) -> Result<()> {
        assert_eq!(indices.len(), values.len(), "as many values as indices");
        petsc!(VecSetValues(self.raw, length(indices.len()), indices.as_ptr(), values.as_ptr(), ffi::InsertMode::ADD_VALUES))
    }

    /// Brings the added values to the ranks that own them. **Collective**
    pub fn assemble(&mut self) -> Result<()> {
        petsc!(VecAssemblyBegin(self.raw))?;
        petsc!(VecAssemblyEnd(self.raw))
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

    /// Inner product with `other`. **Collective**
    pub fn dot(&self, other: &Self) -> Result<f64> {
        let mut product = 0.0;
        petsc!(VecDot(self.raw, other.raw, &mut product))?;
        Ok(product)
    }

    /// `self += factor · other`. **Collective**
    pub fn axpy(&mut self, factor: f64, other: &Self) -> Result<()> {
        petsc!(VecAXPY(self.raw, factor, other.raw))
    }

    /// Takes the values of `other`, of the same layout. **Collective**
    pub fn copy_from(&mut self, other: &Self) -> Result<()> {
        petsc!(VecCopy(other.raw, self.raw))
    }

    /// `self *= factor`. **Collective**
    pub fn scale(&mut self, factor: f64) -> Result<()> {
        petsc!(VecScale(self.raw, factor))
    }

    /// Number of entries on this rank.
    pub fn local_len(&self) -> usize {
        self.range().len()
    }

    /// Number of entries on all ranks.
    pub fn len(&self) -> usize {
        let mut count = 0;
        petsc!(VecGetSize(self.raw, &mut count)).expect("a vector knows its size");
        count as usize
    }

    /// Whether there are no entries on any rank.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Global numbers of the entries of this rank.
    pub fn range(&self) -> Range<usize> {
        let (mut first, mut end) = (0, 0);
        petsc!(VecGetOwnershipRange(self.raw, &mut first, &mut end)).expect("a vector knows its range");
        first as usize..end as usize
    }
}

impl Drop for Vector {
    /// Gives back one PETSc reference. **Collective**
    fn drop(&mut self) {
        give_back(|| unsafe { ffi::VecDestroy(&mut self.raw) });
    }
}

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

/// Local length of a vector of PETSc's.
fn local_length(raw: ffi::Vec) -> Result<usize> {
    let mut count = 0;
    petsc!(VecGetLocalSize(raw, &mut count))?;
    Ok(count as usize)
}

/// The local array of a vector while PETSc lends it for reading.
pub(super) struct Values<'a> {
    raw: ffi::Vec,
    values: &'a [f64],
}

impl Values<'_> {
    /// Borrows the array of a vector that outlives the guard.
    pub(super) fn of(raw: ffi::Vec) -> Result<Self> {
        let count = local_length(raw)?;
        let mut array = ptr::null();
        petsc!(VecGetArrayRead(raw, &mut array))?;
        let values = if count == 0 { &[][..] } else { unsafe { slice::from_raw_parts(array, count) } };
        Ok(Self { raw, values })
    }
}

impl Deref for Values<'_> {
    type Target = [f64];
    fn deref(&self) -> &[f64] {
        self.values
    }
}

impl Drop for Values<'_> {
    fn drop(&mut self) {
        let mut array = self.values.as_ptr();
        unsafe { ffi::VecRestoreArrayRead(self.raw, &mut array) };
    }
}

/// The local array of a vector while PETSc lends it for writing.
pub(super) struct ValuesMut<'a> {
    raw: ffi::Vec,
    values: &'a mut [f64],
}

impl ValuesMut<'_> {
    /// Borrows the array of a vector that outlives the guard and that nobody else uses meanwhile.
    pub(super) fn of(raw: ffi::Vec) -> Result<Self> {
        let count = local_length(raw)?;
        let mut array = ptr::null_mut();
        petsc!(VecGetArray(raw, &mut array))?;
        let values = if count == 0 { &mut [][..] } else { unsafe { slice::from_raw_parts_mut(array, count) } };
        Ok(Self { raw, values })
    }
}

impl Deref for ValuesMut<'_> {
    type Target = [f64];
    fn deref(&self) -> &[f64] {
        self.values
    }
}

impl DerefMut for ValuesMut<'_> {
    fn deref_mut(&mut self) -> &mut [f64] {
        self.values
    }
}

impl Drop for ValuesMut<'_> {
    fn drop(&mut self) {
        let mut array = self.values.as_mut_ptr();
        unsafe { ffi::VecRestoreArray(self.raw, &mut array) };
    }
}
