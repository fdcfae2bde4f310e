//! The C declarations, written by `build.rs`.
#![allow(missing_docs, non_camel_case_types, non_snake_case, non_upper_case_globals, dead_code, clippy::all)]

include!(concat!(env!("OUT_DIR"), "/petsc.rs"));

/// PETSc's truth value: a number up to PETSc 3.24, C's own `bool` from then on.
pub fn flag(holds: bool) -> PetscBool {
    PetscBool::from(holds)
}
