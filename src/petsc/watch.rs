//! How far the linear solve at work has come, for a thread that watches.

use super::error::{Result, petsc};
use super::ffi::{self, Index};
use super::krylov::Krylov;
use std::ffi::c_void;
use std::ptr;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Instant;

/// A linear solve at work.
#[derive(Clone, Copy, Debug)]
pub struct SolveAtWork {
    /// When it began.
    pub started: Instant,
    /// Iterations so far.
    pub iterations: usize,
    /// Relative residual that it began with; NaN before the first one is known.
    pub first: f64,
    /// Relative residual now.
    pub residual: f64,
    /// The one at which it ends.
    pub tolerance: f64,
    /// Norm of the right-hand side.
    pub norm: f64,
}

static AT_WORK: Mutex<Option<SolveAtWork>> = Mutex::new(None);

fn lock() -> MutexGuard<'static, Option<SolveAtWork>> {
    AT_WORK.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The solve at work on this rank, if there is one.
pub fn solve_at_work() -> Option<SolveAtWork> {
    *lock()
}

/// While this lives, watched solvers are noted as at work on one system.
pub struct WatchedSolve(());

impl WatchedSolve {
    /// A solve with this norm of the right-hand side, to this relative residual.
    pub fn begin(norm: f64, tolerance: f64) -> Self {
        let started = Instant::now();
        *lock() = Some(SolveAtWork { started, iterations: 0, first: f64::NAN, residual: f64::NAN, tolerance, norm });
        Self(())
    }
}

impl Drop for WatchedSolve {
    fn drop(&mut self) {
        *lock() = None;
    }
}

impl Krylov {
    /// Notes its iterations: it costs a few stores for each, and changes nothing. **Collective**
    pub fn watch(&self) -> Result<()> {
        petsc!(KSPMonitorSet(self.raw, Some(note), ptr::null_mut(), None))
    }
}

/// Keeps a residual of PETSc's.
unsafe extern "C" fn note(_: ffi::KSP, iteration: Index, norm: f64, _: *mut c_void) -> ffi::PetscErrorCode {
    if let Some(solve) = &mut *lock() {
        solve.residual = norm / solve.norm;
        if solve.first.is_nan() {
            solve.first = solve.residual;
        }
        // A solve that is begun once more counts on.
        solve.iterations += usize::from(iteration > 0);
    }
    0
}
