//! What is kept of a pass of the loop over active sets, and how much it has changed the displacement.

use crate::petsc::Session;
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

/// Change of a displacement since `then`, relative to its norm: this rank's unknowns of both, none for zeros. **Collective**
pub fn relative_change(now: &[f64], then: &[f64], session: &Session) -> f64 {
    let mut squares = [0.0; 2];
    for (now, then) in now.iter().zip(then.iter().chain(std::iter::repeat(&0.0))) {
        squares[0] += (now - then).powi(2);
        squares[1] += now * now;
    }
    session.sum(&mut squares);
    if squares[1] > 0.0 { (squares[0] / squares[1]).sqrt() } else { 0.0 }
}
