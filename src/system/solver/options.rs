//! The solver's recipes as PETSc options. What a user gives after `--` wins over all of them.

use crate::multigrid::takes_another_preconditioner;
use crate::petsc::{Session, options};
use crate::system::saddle_point::{SaddlePoint, SchurPattern};
use crate::system::solver::ladder::Chosen;

/// Names and values of PETSc options.
pub(super) type Options = &'static [(&'static str, &'static str)];

/// Defaults of the outer method and the block solvers; what a user gives after `--` wins.
pub(super) const FIELD_SPLIT: Options = &[
    ("-ksp_pc_side", "right"),
    ("-ksp_gmres_restart", "60"),
    ("-ksp_norm_type", "unpreconditioned"),
    // A start from another active set may be far off.
    ("-ksp_divtol", "1e30"),
    ("-pc_type", "fieldsplit"),
    ("-fieldsplit_u_ksp_type", "preonly"),
    // The cycle takes the place of `none` once the block solvers exist.
    ("-fieldsplit_u_pc_type", "none"),
    ("-fieldsplit_lambda_ksp_type", "preonly"),
];

/// What the user has chosen of a ladder.
pub(super) fn chosen(session: &Session) -> Chosen {
    let is_of_method = |name: &str| ["-ksp_type", "-ksp_pc_side", "-ksp_norm_type"].contains(&name);
    Chosen {
        method: options::any_of_user(session, |name| is_of_method(name) || name.starts_with("-ksp_gmres_")),
        preconditioning: takes_another_preconditioner(session),
    }
}

/// Whether the user has changed anything about the preconditioner of the whole system or about one of its fields: then it is
/// PETSc's own fieldsplit, which has options.
pub(super) fn is_split_changed(session: &Session) -> bool {
    let is_like = |name: &str| name.starts_with("-fieldsplit_") || name.starts_with("-pc_");
    options::any_of_user(session, is_like)
}

/// The factor in the place of the cycle.
pub(super) const FACTOR: Options = &[("-fieldsplit_u_pc_type", "cholesky"), ("-fieldsplit_u_pc_factor_mat_solver_type", "mumps")];

/// Unknowns up to which a factor is made by every rank for itself.
const MOST_REDUNDANT: usize = 10_000;

/// A factor of few unknowns by every rank for itself: one that ranks make together adds in the order in which their messages
/// come, so that its last digits differ from run to run.
pub(super) const REDUNDANT_FACTOR: Options = &[
    ("-fieldsplit_u_pc_type", "redundant"),
    ("-fieldsplit_u_redundant_pc_type", "cholesky"),
    ("-fieldsplit_u_redundant_pc_factor_mat_solver_type", "mumps"),
];

/// Options by which every rank makes a factor for itself, where unknowns are few and ranks several; none elsewhere.
pub(super) fn redundant_factor(system: &SaddlePoint) -> Options {
    let unknowns = system.finest_stiffness().operator().size().0;
    if system.session.size() > 1 && unknowns <= MOST_REDUNDANT { REDUNDANT_FACTOR } else { &[] }
}

/// The exact inverse of `S`, for each of its patterns.
pub(super) fn lambda_options(pattern: SchurPattern, ranks: usize) -> Options {
    match (pattern, ranks) {
        (SchurPattern::Diagonal, _) => &[("-fieldsplit_lambda_pc_type", "jacobi")],
        (SchurPattern::Pairs, _) => &[("-fieldsplit_lambda_pc_type", "pbjacobi")],
        // Its entries are as large as E: no pivot is zero for being small.
        (SchurPattern::Mixed, 1) => &[("-fieldsplit_lambda_pc_type", "lu"), ("-fieldsplit_lambda_pc_factor_zeropivot", "1e-300")],
        (SchurPattern::Mixed, _) => {
            &[("-fieldsplit_lambda_pc_type", "redundant"), ("-fieldsplit_lambda_redundant_pc_factor_zeropivot", "1e-300")]
        }
    }
}
