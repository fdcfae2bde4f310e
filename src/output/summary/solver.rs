//! The linear solver, in the terms of `summary.json`.

use crate::procedure::CoarseSolve;
use serde::Serialize;

/// The linear solver.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct SolverSummary {
    /// `fieldsplit` or `direct`.
    pub name: Option<String>,
    /// What solved it, in words, such as `fieldsplit (multigrid F-cycle)`.
    pub krylov: Option<String>,
    /// One number per linear solve.
    pub iterations: Vec<usize>,
    /// Solves on coarser meshes before, the coarsest first.
    pub coarse: Vec<CoarseSolve>,
    /// Iterations on all meshes, each by its unknowns, in iterations on the last one.
    pub cycles: Option<f64>,
    /// Relative residual of the scaled augmented system.
    pub residual: Option<f64>,
    /// Relative residual of the system as it stands.
    pub plain_residual: Option<f64>,
    /// The BLAS in use.
    pub blas: Option<String>,
}
