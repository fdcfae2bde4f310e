//! What was found on one mesh.

use crate::discretisation::space::Space;

/// Displacements and pressures.
pub struct Solution {
    /// This rank's displacements, in the nodes' frames, prescribed components included.
    pub displacement: Vec<f64>,
    /// Contact pressures of all multipliers, along the boundaries (stress).
    pub multipliers: Vec<f64>,
    /// Which multipliers are active.
    pub active: Vec<bool>,
    /// Relative residual of the augmented system.
    pub residual: f64,
    /// Relative residual of the plain system.
    pub plain_residual: f64,
    /// Discrete inf-sup constant of each contact, where it was asked for.
    pub inf_sup: Vec<Option<f64>>,
}

impl Solution {
    /// No solution at all: nothing moves, and there is no residual.
    pub fn nothing(space: &Space, active: &[bool]) -> Self {
        Self {
            displacement: vec![0.0; space.local_unknowns()],
            multipliers: vec![0.0; active.len()],
            active: active.to_vec(),
            residual: f64::NAN,
            plain_residual: f64::NAN,
            inf_sup: Vec::new(),
        }
    }
}
