//! What is kept of a pass of the loop over active sets.

use serde::Serialize;

/// One pass of the loop, in figures.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Pass {
    /// Number of the pass, from 1.
    pub iteration: usize,
    /// Number of the contact boundary it was made on, from 1.
    pub boundary: usize,
    /// Active multipliers of the solve.
    pub active: usize,
    /// Multipliers that became active after it.
    pub added: usize,
    /// Multipliers that were released after it.
    pub released: usize,
    /// Krylov iterations of its linear solve.
    pub krylov_iterations: usize,
    /// Its relative residual.
    pub residual: f64,
    /// Largest mean penetration over a multiplier (length).
    pub max_penetration: f64,
    /// Change of the displacement, relative to its norm.
    pub du: f64,
    /// The stronger preconditioner that the linear solver went over to, in words.
    #[serde(skip)]
    pub fallback: Option<String>,
}
