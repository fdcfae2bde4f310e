//! What PETSc options of the user's mean for the matrices.

use crate::petsc::{Session, options};

/// Whether the user has chosen what preconditions the displacements: then it is a preconditioner of PETSc's, which wants all rows.
pub fn takes_another_preconditioner(session: &Session) -> bool {
    options::any_of_user(session, |name| name == "-fieldsplit_u_pc_type")
}
