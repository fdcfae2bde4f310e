//! Distributed matrices.

use super::error::{Result, given_back, petsc};
use super::ffi::{self, Index};
use super::session::Session;
use super::vector::{Vector, length};
use std::ops::Range;
use std::ptr;

/// A matrix whose rows lie in consecutive ranges on the ranks: sparse ([`Matrix::aij`]), two by two of others
/// ([`Matrix::nest`]), another one transposed ([`Matrix::transposed`]) or an action ([`Matrix::operator`]). It has one owner, who
/// alone can change it; a nest, a transposed one and a solver keep references of PETSc's own to the matrices they are made of, and
/// see their changes.
pub struct Matrix {
    pub(super) raw: ffi::Mat,
    pub(super) session: Session,
    /// Rows and columns per block of [`Matrix::insert_blocks`].
    block: usize,
}

impl Matrix {
    /// A sparse matrix with `rows` × `columns` scalar entries on this rank, stored by rows and filled in blocks of
    /// `block` × `block`. For each block row, `diagonal` and `off_diagonal` say how many blocks lie in this rank's own
    /// columns and in others': exact counts, since an entry beyond them is an error. **Collective**
    ///
    /// # Panics
    /// If the counts are not one per block row.
    pub fn aij(
        session: &Session,
        rows: usize,
        columns: usize,
        block: usize,
        diagonal: &[Index],
        off_diagonal: &[Index],
    ) -> Result<Self> {
        let has_rows = |counts: &[Index]| block * counts.len() == rows;
        assert!(has_rows(diagonal) && has_rows(off_diagonal), "one count for each block row");
        let mut raw = ptr::null_mut();
        petsc!(MatCreate(session.raw(), &mut raw))?;
        let matrix = Self { raw, session: session.clone(), block };
        petsc!(MatSetSizes(raw, length(rows), length(columns), ffi::mezha_determine, ffi::mezha_determine))?;
        petsc!(MatSetType(raw, c"aij".as_ptr()))?;
        petsc!(MatXAIJSetPreallocation(raw, length(block), diagonal.as_ptr(), off_diagonal.as_ptr(), ptr::null(), ptr::null()))?;
        matrix.set_option(ffi::MatOption::MAT_NEW_NONZERO_ALLOCATION_ERR, true)?;
        Ok(matrix)
    }

    /// The transposed of this matrix, without entries of its own: it follows changes of values, not another matrix in this place.
    /// **Collective**
    pub fn transposed(&self) -> Result<Self> {
        let mut raw = ptr::null_mut();
        petsc!(MatCreateTranspose(self.raw, &mut raw))?;
        Ok(Self::from_raw(&self.session, raw))
    }

    /// Takes over one reference to a matrix of PETSc's.
    pub(super) fn from_raw(session: &Session, raw: ffi::Mat) -> Self {
        Self { raw, session: session.clone(), block: 1 }
    }

    /// Puts a dense block in place of what is in the rows and columns of these blocks (global block numbers; negative ones are
    /// skipped). Holds after [`Matrix::assemble`].
    ///
    /// | argument | shape |
    /// |---|---|
    /// | `values` | (`rows` · block) × (`columns` · block), row after row |
    ///
    /// # Panics
    /// If `values` has another length.
    #[inline]
    pub fn insert_blocks(&mut self, rows: &[Index], columns: &[Index], values: &[f64]) -> Result<()> {
        assert_eq!(values.len(), rows.len() * columns.len() * self.block * self.block, "values of whole blocks");
        let (m, n) = (length(rows.len()), length(columns.len()));
        let insert = ffi::InsertMode::INSERT_VALUES;
        petsc!(MatSetValuesBlocked(self.raw, m, rows.as_ptr(), n, columns.as_ptr(), values.as_ptr(), insert))
    }

    /// Writes `values`, row after row, in place of the entries at `rows` × `columns` (global; negative ones are skipped). Holds after
    /// [`Matrix::assemble`].
    ///
    /// # Panics
    /// If `values` has another length than the product of the two.
    #[inline]
    pub fn insert(&mut self, rows: &[Index], columns: &[Index], values: &[f64]) -> Result<()> {
        assert_eq!(values.len(), rows.len() * columns.len(), "one value for each row and column");
        let (m, n) = (length(rows.len()), length(columns.len()));
        let insert = ffi::InsertMode::INSERT_VALUES;
        petsc!(MatSetValues(self.raw, m, rows.as_ptr(), n, columns.as_ptr(), values.as_ptr(), insert))
    }

    /// Brings inserted values to their ranks and closes the pattern. **Collective**
    pub fn assemble(&mut self) -> Result<()> {
        petsc!(MatAssemblyBegin(self.raw, ffi::MatAssemblyType::MAT_FINAL_ASSEMBLY))?;
        petsc!(MatAssemblyEnd(self.raw, ffi::MatAssemblyType::MAT_FINAL_ASSEMBLY))
    }

    /// `y = A x`. **Collective**
    pub fn multiply(&self, x: &Vector, y: &mut Vector) -> Result<()> {
        petsc!(MatMult(self.raw, x.raw, y.raw))
    }

    /// `y += A x`. **Collective**
    pub fn multiply_add(&self, x: &Vector, y: &mut Vector) -> Result<()> {
        petsc!(MatMultAdd(self.raw, x.raw, y.raw, y.raw))
    }

    /// `r = b - A x`. **Collective**
    pub fn residual(&self, b: &Vector, x: &Vector, r: &mut Vector) -> Result<()> {
        petsc!(MatResidual(self.raw, b.raw, x.raw, r.raw))
    }

    /// Largest sum of magnitudes in a row. **Collective**
    pub fn norm_infinity(&self) -> Result<f64> {
        let mut norm = 0.0;
        petsc!(MatNorm(self.raw, ffi::NormType::NORM_INFINITY, &mut norm))?;
        Ok(norm)
    }

    /// Global numbers of the rows of this rank.
    pub fn row_range(&self) -> Range<usize> {
        let (mut first, mut end) = (0, 0);
        petsc!(MatGetOwnershipRange(self.raw, &mut first, &mut end)).expect("a matrix knows its rows");
        first as usize..end as usize
    }

    /// Rows and columns on this rank.
    pub fn local_size(&self) -> (usize, usize) {
        let (mut rows, mut columns) = (0, 0);
        petsc!(MatGetLocalSize(self.raw, &mut rows, &mut columns)).expect("a matrix knows its size");
        (rows as usize, columns as usize)
    }

    /// Rows and columns on all ranks.
    pub fn size(&self) -> (usize, usize) {
        let (mut rows, mut columns) = (0, 0);
        petsc!(MatGetSize(self.raw, &mut rows, &mut columns)).expect("a matrix knows its size");
        (rows as usize, columns as usize)
    }

    /// Tells solvers that the matrix is symmetric, or not.
    pub fn set_symmetric(&mut self, holds: bool) -> Result<()> {
        self.set_option(ffi::MatOption::MAT_SYMMETRIC, holds)
    }

    /// Tells solvers that the matrix is symmetric and positive definite, or not.
    pub fn set_positive_definite(&mut self, holds: bool) -> Result<()> {
        self.set_option(ffi::MatOption::MAT_SPD, holds)
    }

    fn set_option(&self, option: ffi::MatOption, holds: bool) -> Result<()> {
        petsc!(MatSetOption(self.raw, option, ffi::flag(holds)))
    }

    /// New vectors `(x, y)` that fit `y = A x`. **Collective**
    pub fn create_vectors(&self) -> Result<(Vector, Vector)> {
        let (mut right, mut left) = (ptr::null_mut(), ptr::null_mut());
        petsc!(MatCreateVecs(self.raw, &mut right, &mut left))?;
        Ok((Vector::from_raw(&self.session, right), Vector::from_raw(&self.session, left)))
    }

    /// A sparse copy, as direct solvers want it. **Collective**
    pub fn convert_aij(&self) -> Result<Self> {
        let mut raw = ptr::null_mut();
        petsc!(MatConvert(self.raw, c"aij".as_ptr(), ffi::MatReuse::MAT_INITIAL_MATRIX, &mut raw))?;
        Ok(Self::from_raw(&self.session, raw))
    }
}

given_back!(Matrix, raw, MatDestroy);
