//! The solver's recipes as PETSc options. What a user gives after `--` wins over all of them.

use crate::system::{Rung, SchurPattern};

/// Rows up to which the coarsest level is factorised by all ranks together.
const LARGE: usize = 50_000;

/// Unknowns up to which the coarsest level is factorised on every rank.
const SMALL: usize = 3000;

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
    ("-fieldsplit_lambda_ksp_type", "preonly"),
    ("-fieldsplit_u_mg_levels_pc_type", "sor"),
    ("-fieldsplit_u_mg_coarse_ksp_type", "preonly"),
];

/// The outer method and the smoother of each rung of the ladder.
pub(super) fn rung_options(rung: Rung) -> Options {
    match rung {
        Rung::Sweep => &[
            ("-ksp_type", "gmres"),
            ("-fieldsplit_u_mg_levels_ksp_type", "richardson"),
            ("-fieldsplit_u_mg_levels_ksp_max_it", "1"),
        ],
        Rung::TwoSteps => {
            &[("-ksp_type", "fgmres"), ("-fieldsplit_u_mg_levels_ksp_type", "cg"), ("-fieldsplit_u_mg_levels_ksp_max_it", "2")]
        }
        Rung::FourSteps => {
            &[("-ksp_type", "fgmres"), ("-fieldsplit_u_mg_levels_ksp_type", "cg"), ("-fieldsplit_u_mg_levels_ksp_max_it", "4")]
        }
        Rung::Factor => {
            &[("-ksp_type", "gmres"), ("-fieldsplit_u_pc_type", "cholesky"), ("-fieldsplit_u_pc_factor_mat_solver_type", "mumps")]
        }
    }
}

/// The exact inverse of `S`, for each of its patterns.
pub(super) fn lambda_options(pattern: SchurPattern, ranks: usize) -> Options {
    match (pattern, ranks) {
        (SchurPattern::Diagonal, _) => &[("-fieldsplit_lambda_pc_type", "jacobi")],
        (SchurPattern::Pairs, _) => &[("-fieldsplit_lambda_pc_type", "pbjacobi")],
        (SchurPattern::Mixed, 1) => &[("-fieldsplit_lambda_pc_type", "lu")],
        (SchurPattern::Mixed, _) => &[("-fieldsplit_lambda_pc_type", "redundant")],
    }
}

/// What solves on the coarsest level.
#[derive(Clone, Copy)]
pub(super) enum CoarseSolver {
    /// Factorisation by one rank.
    Alone,
    /// Factorisation by every rank for itself.
    Redundant,
    /// Factorisation by all ranks together.
    Shared,
    /// One cycle of BoomerAMG: the mesh has no coarser levels.
    Algebraic,
}

impl CoarseSolver {
    pub(super) fn of(rows: usize, levels: usize, ranks: usize) -> Self {
        match (rows, levels, ranks) {
            (_, 1, _) => Self::Algebraic,
            (..=SMALL, _, 1) => Self::Alone,
            (..=SMALL, ..) => Self::Redundant,
            (LARGE.., ..) | (_, 2, _) => Self::Algebraic,
            _ => Self::Shared,
        }
    }

    pub(super) fn words(self, multigrid: bool) -> &'static str {
        match (self, multigrid) {
            (Self::Algebraic, false) => "BoomerAMG",
            (Self::Algebraic, true) => "P2 smoother over BoomerAMG",
            _ => "multigrid F-cycle",
        }
    }

    pub(super) fn options(self, multigrid: bool) -> Options {
        match (self, multigrid) {
            // Multigrid takes the place of `none` once the block solvers exist.
            (Self::Alone, _) => &[("-fieldsplit_u_pc_type", "none"), ("-fieldsplit_u_mg_coarse_pc_type", "lu")],
            (Self::Redundant, _) => &[
                ("-fieldsplit_u_pc_type", "none"),
                ("-fieldsplit_u_mg_coarse_pc_type", "redundant"),
                ("-fieldsplit_u_mg_coarse_redundant_pc_type", "lu"),
            ],
            (Self::Shared, _) => &[
                ("-fieldsplit_u_pc_type", "none"),
                ("-fieldsplit_u_mg_coarse_pc_type", "cholesky"),
                ("-fieldsplit_u_mg_coarse_pc_factor_mat_solver_type", "mumps"),
            ],
            (Self::Algebraic, true) => &[
                ("-fieldsplit_u_pc_type", "none"),
                ("-fieldsplit_u_mg_coarse_pc_type", "hypre"),
                ("-fieldsplit_u_mg_coarse_pc_hypre_type", "boomeramg"),
                ("-fieldsplit_u_mg_coarse_pc_hypre_boomeramg_coarsen_type", "HMIS"),
                ("-fieldsplit_u_mg_coarse_pc_hypre_boomeramg_interp_type", "ext+i"),
                ("-fieldsplit_u_mg_coarse_pc_hypre_boomeramg_strong_threshold", "0.25"),
            ],
            (Self::Algebraic, false) => &[
                ("-fieldsplit_u_pc_type", "hypre"),
                ("-fieldsplit_u_pc_hypre_type", "boomeramg"),
                ("-fieldsplit_u_pc_hypre_boomeramg_coarsen_type", "HMIS"),
                ("-fieldsplit_u_pc_hypre_boomeramg_interp_type", "ext+i"),
                ("-fieldsplit_u_pc_hypre_boomeramg_strong_threshold", "0.25"),
            ],
        }
    }
}
