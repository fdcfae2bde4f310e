//! A sparse factor on one rank alone, of a matrix that it has.

use super::error::{Error, Result, petsc};
use super::ffi;
use super::index::Index;
use super::index_set::IndexSet;
use super::matrix::Matrix;
use super::session::Session;
use super::vector::{Vector, length};
use std::ptr;

/// `L U` of a small sparse matrix, by PETSc's own factorisation.
pub struct Factor {
    factor: Matrix,
    right_hand_side: Vector,
    solution: Vector,
}

/// Pivots that count as zero: functions of a coarse level may be as small as one likes, and so may pivots.
const ZERO_PIVOT: f64 = 1e-300;

impl Factor {
    /// Of a square matrix with the given rows: columns and values. No other rank takes part.
    ///
    /// # Errors
    /// PETSc's, and [`Error::Singular`] if a pivot is zero: the matrix is singular.
    pub fn new(session: &Session, rows: &[(Vec<Index>, Vec<f64>)]) -> Result<Self> {
        let alone = unsafe { mpi::ffi::RSMPI_COMM_SELF };
        let n = length(rows.len());
        let counts: Vec<Index> = rows.iter().map(|(columns, _)| length(columns.len())).collect();
        let mut raw = ptr::null_mut();
        petsc!(MatCreateSeqAIJ(alone, n, n, 0, counts.as_ptr(), &mut raw))?;
        let mut matrix = Matrix::from_raw(session, raw);
        for (row, (columns, values)) in rows.iter().enumerate() {
            matrix.insert(&[row as Index], columns, values)?;
        }
        matrix.assemble()?;
        let (mut rows, mut columns) = (ptr::null_mut(), ptr::null_mut());
        petsc!(MatGetOrdering(matrix.raw(), c"nd".as_ptr(), &mut rows, &mut columns))?;
        let [rows, columns] = [rows, columns].map(|set| IndexSet::from_raw(session, set));
        let mut raw = ptr::null_mut();
        petsc!(MatGetFactor(matrix.raw(), c"petsc".as_ptr(), ffi::MatFactorType::MAT_FACTOR_LU, &mut raw))?;
        let factor = Matrix::from_raw(session, raw);
        let mut information = ffi::MatFactorInfo::default();
        petsc!(MatFactorInfoInitialize(&mut information))?;
        information.zeropivot = ZERO_PIVOT;
        information.fill = 5.0;
        petsc!(MatLUFactorSymbolic(factor.raw(), matrix.raw(), rows.raw(), columns.raw(), &information))?;
        petsc!(MatLUFactorNumeric(factor.raw(), matrix.raw(), &information))?;
        let mut failure = ffi::MatFactorError::MAT_FACTOR_NOERROR;
        petsc!(MatFactorGetError(factor.raw(), &mut failure))?;
        if failure != ffi::MatFactorError::MAT_FACTOR_NOERROR {
            return Err(Error::Singular);
        }
        let vector = || Vector::alone(session, counts.len());
        Ok(Self { right_hand_side: vector()?, solution: vector()?, factor })
    }

    /// `x = A⁻¹ b`: `set` writes `b`, `get` reads `x`.
    pub fn solve(&mut self, set: impl FnOnce(&mut [f64]), get: impl FnOnce(&[f64])) -> Result<()> {
        set(&mut self.right_hand_side.values_mut());
        petsc!(MatSolve(self.factor.raw(), self.right_hand_side.raw(), self.solution.raw()))?;
        get(&self.solution.values());
        Ok(())
    }
}
