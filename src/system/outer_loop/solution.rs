//! What the loop over active sets has found, and how it ended.

use crate::system::{BoundaryStep, OuterStep, Space};

/// How the loop ended.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict {
    /// Everything stands still within its tolerance; in words.
    Converged(String),
    /// It does not, or a body is not held; in words.
    NotConverged(String),
}

/// The solution of the last pass.
pub struct Solution {
    /// How it ended.
    pub verdict: Verdict,
    /// This rank's displacements, in the nodes' frames, prescribed components included.
    pub displacement: Vec<f64>,
    /// Contact pressures of all multipliers, along the boundaries (stress).
    pub multipliers: Vec<f64>,
    /// Which multipliers are active.
    pub active: Vec<bool>,
    /// Whether the active set was found by rising energy, because the plain rule did not.
    pub ascended: bool,
    /// Every pass.
    pub steps: Vec<OuterStep>,
    /// Every contact boundary, where some follow the solution.
    pub boundaries: Vec<BoundaryStep>,
    /// Relative residual of the augmented system.
    pub residual: f64,
    /// Relative residual of the plain system.
    pub plain_residual: f64,
    /// Discrete inf-sup constant of each contact, where it was asked for.
    pub inf_sup: Vec<Option<f64>>,
}

impl Solution {
    /// No solution at all, because a body is not held.
    pub fn nothing(verdict: Verdict, space: &Space, active: &[bool]) -> Self {
        Self {
            verdict,
            displacement: vec![0.0; space.local_unknowns()],
            multipliers: vec![0.0; active.len()],
            active: active.to_vec(),
            ascended: false,
            steps: Vec::new(),
            boundaries: Vec::new(),
            residual: f64::NAN,
            plain_residual: f64::NAN,
            inf_sup: Vec::new(),
        }
    }

    /// Whether there are displacements to look at.
    pub fn is_solved(&self) -> bool {
        !self.steps.is_empty() && self.residual.is_finite()
    }
}
