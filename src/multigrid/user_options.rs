//! What PETSc options of the user's mean for the matrices.

use crate::petsc::{Session, options};

/// Whether options of the user's may ask more of the stiffness than its products and symmetric Gauss-Seidel sweeps: another
/// preconditioner on the displacements or on the levels, settings of the sweep, Galerkin products. Then all rows are stored.
pub fn want_entries(session: &Session) -> bool {
    options::any_of_user(session, |name| {
        let own = name.strip_prefix("-fieldsplit_u_").filter(|rest| !rest.starts_with("mg_coarse"));
        own.is_some_and(|rest| rest.contains("pc_") && (!rest.contains("pc_mg_") || rest.contains("galerkin")))
    })
}
