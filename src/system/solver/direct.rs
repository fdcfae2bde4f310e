//! The direct solver: MUMPS on the plain system.

use super::fallback::Preconditioning;
use super::field_split::replace_action;
use super::linear_solver::LinearSolver;
use super::options::Options;
use crate::discretisation::{Form, SystemError};
use crate::multigrid::GalerkinLevels;
use crate::petsc::{self, Krylov, Session};
use crate::system::saddle_point::SaddlePoint;
use std::rc::Rc;

/// PETSc options of the direct solver.
const DIRECT: Options = &[
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

impl LinearSolver {
    /// A factor of the plain system by MUMPS, with GMRES around it for what rounding leaves. **Collective**
    ///
    /// # Errors
    /// [`SystemError`] from PETSc.
    pub(super) fn direct(system: &SaddlePoint, session: &Session) -> Result<Self, SystemError> {
        for (name, value) in DIRECT {
            petsc::options::set_default(session, name, value)?;
        }
        let krylov = Krylov::new(session, "")?;
        let name = "direct (MUMPS)".into();
        let mut solver = Self {
            krylov,
            _replaced: None,
            bordered: None,
            session: session.clone(),
            form: Form::Plain,
            converted: None,
            interpolations: Rc::new([]),
            auxiliary: GalerkinLevels::default(),
            cycle: None,
            preconditioning: Preconditioning::Factor,
            is_short: false,
            name,
            is_set_up: true,
        };
        solver.refresh(system)?;
        solver.krylov.set_from_options()?;
        solver.krylov.watch()?;
        solver.krylov.set_up()?;
        (solver._replaced, solver.bordered) = replace_action(&solver.krylov, None, system, Form::Plain, session)?;
        Ok(solver)
    }
}
