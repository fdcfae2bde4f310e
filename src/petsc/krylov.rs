//! Linear solvers.

use super::error::{Error, Result, given_back, petsc, words};
use super::ffi::{self, Index};
use super::matrix::Matrix;
use super::preconditioner::Preconditioner;
use super::session::Session;
use super::vector::{Vector, length};
use std::ffi::CString;
use std::ptr;

/// A Krylov method with its preconditioner.
pub struct Krylov {
    pub(super) raw: ffi::KSP,
    session: Session,
}

/// How a linear solve ended.
#[derive(Clone, Debug, PartialEq)]
pub struct KrylovEnding {
    /// Whether the tolerance was reached.
    pub converged: bool,
    /// Iterations done.
    pub iterations: usize,
    /// Norm of the last residual, in the norm of the method.
    pub residual: f64,
    /// Name of PETSc's reason to stop, such as `KSP_CONVERGED_RTOL`; what failed in the preconditioner follows in words.
    pub reason: String,
}

impl Krylov {
    /// A solver whose options begin with `-<prefix>`. It records its residuals. **Collective**
    pub fn new(session: &Session, prefix: &str) -> Result<Self> {
        let mut raw = ptr::null_mut();
        petsc!(KSPCreate(session.raw(), &mut raw))?;
        let krylov = Self { raw, session: session.clone() };
        let prefix = CString::new(prefix).expect("a prefix has no zero byte");
        petsc!(KSPSetOptionsPrefix(raw, prefix.as_ptr()))?;
        // A right-hand side below PETSc's own absolute tolerance would have the solution zero. Options may set another one.
        let other = ffi::mezha_default_real;
        petsc!(KSPSetTolerances(raw, other, 0.0, other, other as Index))?;
        krylov.recording_residuals()
    }

    /// Another reference to a solver of PETSc's.
    pub(super) fn share(session: &Session, raw: ffi::KSP) -> Result<Self> {
        petsc!(PetscObjectReference(raw.cast()))?;
        Self { raw, session: session.clone() }.recording_residuals()
    }

    fn recording_residuals(self) -> Result<Self> {
        petsc!(mezha_record_residuals(self.raw))?;
        Ok(self)
    }

    /// Sets the matrix of the system and the one the preconditioner is built from, often the same. **Collective**
    pub fn set_operators(&self, system: &Matrix, preconditioner: &Matrix) -> Result<()> {
        petsc!(KSPSetOperators(self.raw, system.raw, preconditioner.raw))
    }

    /// Stops when the residual is below `relative · |b|`, or gives up after `max_iterations`. **Collective**
    pub fn set_tolerance(&self, relative: f64, max_iterations: usize) -> Result<()> {
        let other = ffi::mezha_default_real;
        petsc!(KSPSetTolerances(self.raw, relative, other, other, length(max_iterations)))
    }

    /// Starts from the `x` given to a solve instead of from zero. **Collective**
    pub fn set_initial_guess_nonzero(&self, nonzero: bool) -> Result<()> {
        petsc!(KSPSetInitialGuessNonzero(self.raw, ffi::flag(nonzero)))
    }

    /// Reads its options and those of its preconditioner. **Collective**
    pub fn set_from_options(&self) -> Result<()> {
        petsc!(KSPSetFromOptions(self.raw))
    }

    /// Prepares the method and its preconditioner for the operators. **Collective**
    pub fn set_up(&self) -> Result<()> {
        petsc!(KSPSetUp(self.raw))
    }

    /// The preconditioner of the solver.
    pub fn preconditioner(&self) -> Preconditioner {
        let mut raw = ptr::null_mut();
        let shared = petsc!(KSPGetPC(self.raw, &mut raw)).and_then(|()| Preconditioner::share(&self.session, raw));
        shared.expect("a solver has a preconditioner")
    }

    /// Solves `A x = b`; a method that gives up is no error: `converged` tells, `x` holds the last iterate.
    /// **Collective**
    pub fn solve_allowing(&self, b: &Vector, x: &mut Vector) -> Result<KrylovEnding> {
        petsc!(KSPSolve(self.raw, b.raw, x.raw))?;
        let mut reason = ffi::KSPConvergedReason::KSP_CONVERGED_ITERATING;
        let (mut iterations, mut residual) = (0, 0.0);
        petsc!(KSPGetConvergedReason(self.raw, &mut reason))?;
        petsc!(KSPGetIterationNumber(self.raw, &mut iterations))?;
        petsc!(KSPGetResidualNorm(self.raw, &mut residual))?;
        let converged = reason.0 > 0;
        if reason == ffi::KSPConvergedReason::KSP_DIVERGED_PC_FAILED && self.preconditioner().is_out_of_memory()? {
            return Err(Error::OutOfMemory { call: "the factorisation".into() });
        }
        Ok(KrylovEnding { converged, iterations: iterations as usize, residual, reason: self.reason(reason)? })
    }

    /// `x = A⁻¹ b` as the method gives it, whatever its reason to stop: for methods of one step. **Collective**
    pub fn apply(&self, b: &Vector, x: &mut Vector) -> Result<()> {
        petsc!(KSPSolve(self.raw, b.raw, x.raw))
    }

    /// Name of the reason to stop, and what failed in the preconditioner.
    fn reason(&self, reason: ffi::KSPConvergedReason) -> Result<String> {
        let mut name = ptr::null();
        petsc!(KSPGetConvergedReasonString(self.raw, &mut name))?;
        let name = format!("KSP_{}", words(name));
        if reason != ffi::KSPConvergedReason::KSP_DIVERGED_PC_FAILED {
            return Ok(name);
        }
        Ok(format!("{name} ({})", self.preconditioner().failure()?))
    }

    /// Keeps what [`Krylov::eigenvalues`] needs; before the first solve. **Collective**
    pub fn keep_eigenvalues(&self) -> Result<()> {
        petsc!(KSPSetComputeEigenvalues(self.raw, ffi::flag(true)))
    }

    /// Real parts of the eigenvalues of the preconditioned system as the last solve has seen them (Ritz values),
    /// ascending: one for each iteration since the last restart.
    pub fn eigenvalues(&self, iterations: usize) -> Result<Vec<f64>> {
        let (mut real, mut imaginary) = (vec![0.0; iterations], vec![0.0; iterations]);
        let mut count = 0;
        petsc!(KSPComputeEigenvalues(self.raw, length(iterations), real.as_mut_ptr(), imaginary.as_mut_ptr(), &mut count))?;
        real.truncate(count as usize);
        real.sort_by(f64::total_cmp);
        Ok(real)
    }

    /// Residual norms of the last solve: before it, and after each iteration.
    pub fn residual_history(&self) -> Vec<f64> {
        let (mut array, mut count) = (ptr::null(), 0);
        petsc!(KSPGetResidualHistory(self.raw, &mut array, &mut count)).expect("a solver records its residuals");
        if count == 0 { Vec::new() } else { unsafe { std::slice::from_raw_parts(array, count as usize) }.to_vec() }
    }
}

given_back!(Krylov, raw, KSPDestroy);
