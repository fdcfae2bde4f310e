//! The direct solver: MUMPS on the plain system.

use super::field_split::replace_action;
use super::options::Options;
use super::prepared::{Prepared, set_plain_operators};
use crate::discretisation::{Form, SystemError};
use crate::petsc::{self, Krylov};
use crate::system::saddle_point::SaddlePoint;

/// PETSc options of the direct solver.
const OPTIONS: Options = &[
    ("-ksp_type", "gmres"),
    ("-ksp_pc_side", "right"),
    ("-ksp_norm_type", "unpreconditioned"),
    ("-ksp_divtol", "1e30"),
    ("-pc_type", "cholesky"),
    ("-pc_factor_mat_solver_type", "mumps"),
    // Towards ν = 0.5 good pivots fall short of MUMPS's own 0.01, and those put off outgrow its memory from 0.4999 on.
    ("-mat_mumps_cntl_1", "1e-4"),
    ("-mat_mumps_icntl_14", "100"),
];

/// A factor of the plain system by MUMPS, with GMRES around it for what rounding leaves. **Collective**
///
/// # Errors
/// [`SystemError`] from PETSc.
pub fn direct(system: &SaddlePoint) -> Result<Prepared, SystemError> {
    for (name, value) in OPTIONS {
        petsc::options::set_default(&system.session, name, value)?;
    }
    let krylov = Krylov::new(&system.session, "")?;
    set_plain_operators(&krylov, system)?;
    krylov.set_from_options()?;
    krylov.watch()?;
    krylov.set_up()?;
    let (_replaced, bordered) = replace_action(&krylov, None, system, Form::Plain)?;
    let (levels, name) = (None, "direct (MUMPS)".into());
    Ok(Prepared { krylov, _replaced, bordered, levels, name })
}
