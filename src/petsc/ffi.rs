//! The C declarations, written by `build.rs`, and numbers of rows, columns and unknowns.
#![allow(missing_docs, non_camel_case_types, non_snake_case, non_upper_case_globals, dead_code, clippy::all)]

include!(concat!(env!("OUT_DIR"), "/petsc.rs"));

/// PETSc's truth value: a number up to PETSc 3.24, C's own `bool` from then on.
pub fn flag(holds: bool) -> PetscBool {
    PetscBool::from(holds)
}

/// A global number, or a count of such, as PETSc stores it: in 32 bits, or in 64 if PETSc was built so. What MPI counts, and
/// ranks themselves, are `i32` in either case.
pub type Index = PetscInt;
