//! Matrices known by their action alone.

use super::error::{Result, petsc};
use super::ffi;
use super::matrix::Matrix;
use super::session::Session;
use super::vector::{Values, ValuesMut, length};
use mpi::collective::SystemOperation;
use mpi::topology::SimpleCommunicator;
use mpi::traits::CommunicatorCollectives;
use std::ffi::{CString, c_void};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::{mem, ptr};

/// What a shell does: from this rank's entries of `x` to this rank's entries of `y = A x`, or why it could not.
pub type Action = Box<dyn Fn(&[f64], &mut [f64]) -> std::result::Result<(), String>>;

impl Matrix {
    /// A matrix with `rows` × `columns` on this rank whose product with a vector is `action`. An error on one rank
    /// is an error on all; a panic ends all ranks like any other. **Collective**
    pub fn shell(session: &Session, rows: usize, columns: usize, action: Action) -> Result<Self> {
        let any = ffi::mezha_determine;
        let context = Box::into_raw(Box::new(action));
        let mut raw = ptr::null_mut();
        petsc!(MatCreateShell(session.raw(), length(rows), length(columns), any, any, context.cast(), &mut raw))?;
        let matrix = Self::from_raw(session, raw);
        petsc!(MatShellSetContextDestroy(raw, Some(drop_action)))?;
        // PETSc stores every operation as a function without arguments and calls it as what it is.
        let multiply: unsafe extern "C" fn() = unsafe { mem::transmute(multiply as Multiply) };
        petsc!(MatShellSetOperation(raw, ffi::MatOperation::MATOP_MULT, Some(multiply)))?;
        Ok(matrix)
    }
}

type Multiply = unsafe extern "C" fn(ffi::Mat, ffi::Vec, ffi::Vec) -> ffi::PetscErrorCode;

/// `y = A x` as PETSc calls it. No panic crosses into C, even where the hook that ends all ranks has been replaced.
unsafe extern "C" fn multiply(matrix: ffi::Mat, x: ffi::Vec, y: ffi::Vec) -> ffi::PetscErrorCode {
    let outcome =
        catch_unwind(AssertUnwindSafe(|| apply(matrix, x, y))).unwrap_or_else(|_| Err("panic in the action of a shell".into()));
    let mut failed = 0_i32;
    SimpleCommunicator::world().all_reduce_into(&i32::from(outcome.is_err()), &mut failed, SystemOperation::max());
    if failed == 0 {
        return 0;
    }
    let message = outcome.err().unwrap_or_else(|| "another rank failed in the action of a shell".into());
    let message = CString::new(message.replace('\0', " ")).expect("no zero byte is left");
    unsafe { ffi::mezha_callback_error(message.as_ptr()) }
}

fn apply(matrix: ffi::Mat, x: ffi::Vec, y: ffi::Vec) -> std::result::Result<(), String> {
    let arrays = || -> Result<_> {
        let mut context = ptr::null_mut::<c_void>();
        petsc!(MatShellGetContext(matrix, ptr::from_mut(&mut context).cast()))?;
        Ok((context.cast::<Action>(), Values::of(x)?, ValuesMut::of(y)?))
    };
    let (action, x, mut y) = arrays().map_err(|error| error.to_string())?;
    let action = unsafe { &*action };
    action(&x, &mut y)
}

/// Drops the action with the matrix.
unsafe extern "C" fn drop_action(context: *mut c_void) -> ffi::PetscErrorCode {
    drop(unsafe { Box::from_raw(context.cast::<Action>()) });
    0
}
