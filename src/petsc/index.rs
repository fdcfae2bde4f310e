//! Numbers of rows, columns and unknowns.

use super::ffi;

/// A global number, or a count of such, as PETSc stores it: in 32 bits, or in 64 if PETSc was built so. What MPI counts, and
/// ranks themselves, are `i32` in either case.
pub type Index = ffi::PetscInt;
