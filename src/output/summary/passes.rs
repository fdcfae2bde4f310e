//! What the solution procedure keeps of its steps and of the linear solver, in the terms of `summary.json`.

use crate::procedure::{BoundaryStep, Pass};
use serde::{Deserialize, Serialize};

/// One outer iteration.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct OuterIteration {
    /// Number, from 1.
    pub iteration: usize,
    /// Number of the contact boundary it was made on, from 1.
    pub boundary: usize,
    /// Active multipliers.
    pub active: Option<usize>,
    /// Multipliers that became active.
    pub added: Option<usize>,
    /// Multipliers that became inactive.
    pub released: Option<usize>,
    /// Krylov iterations of its linear solves.
    pub krylov_iterations: Option<usize>,
    /// Relative residual.
    pub residual: Option<f64>,
    /// Largest penetration (length).
    pub max_penetration: Option<f64>,
    /// Relative change of the displacement.
    pub du: Option<f64>,
}

/// One contact boundary of those that followed the solution.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct BoundaryIteration {
    /// Number, from 1.
    pub iteration: usize,
    /// Its length.
    pub length: Option<f64>,
    /// Largest way of a segment end to the next boundary, relative to the length; null if the segments are others.
    pub moved: Option<f64>,
    /// Relative change of the displacement since the boundary before.
    pub du: Option<f64>,
    /// Multipliers that changed state since the boundary before.
    pub flipped: Option<usize>,
}

/// The linear solver.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SolverSummary {
    /// `fieldsplit` or `direct`.
    pub name: Option<String>,
    /// What solved it, in words, such as `fieldsplit (multigrid F-cycle)`.
    pub krylov: Option<String>,
    /// One number per linear solve.
    pub iterations: Vec<usize>,
    /// Solves on coarser meshes before, the coarsest first.
    pub coarse: Vec<CoarseSolveSummary>,
    /// Iterations on all meshes, each by its unknowns, in iterations on the last one.
    pub cycles: Option<f64>,
    /// Relative residual of the scaled augmented system.
    pub residual: Option<f64>,
    /// Relative residual of the system as it stands.
    pub plain_residual: Option<f64>,
    /// The BLAS in use.
    pub blas: Option<String>,
}

/// A coarser mesh that was solved first.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct CoarseSolveSummary {
    /// Refinements of the macro mesh.
    pub refine: usize,
    /// Displacement unknowns.
    pub unknowns: usize,
    /// One number per linear solve.
    pub iterations: Vec<usize>,
}

impl From<&Pass> for OuterIteration {
    fn from(pass: &Pass) -> Self {
        Self {
            iteration: pass.iteration,
            boundary: pass.boundary,
            active: Some(pass.active),
            added: Some(pass.added),
            released: Some(pass.released),
            krylov_iterations: Some(pass.krylov_iterations),
            residual: Some(pass.residual),
            max_penetration: Some(pass.max_penetration),
            du: Some(pass.du),
        }
    }
}

impl From<&BoundaryStep> for BoundaryIteration {
    fn from(step: &BoundaryStep) -> Self {
        Self { iteration: step.iteration, length: Some(step.length), moved: step.moved, du: step.du, flipped: step.flipped }
    }
}
