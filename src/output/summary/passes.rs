//! What the solution procedure keeps of its steps, in the terms of `summary.json`.

use super::{BoundaryIteration, OuterIteration};
use crate::procedure::{BoundaryStep, Pass};

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
