//! Operators of the auxiliary levels.

use crate::petsc::{Matrix, Result};

/// Added to the diagonal, relative to it. Two functions that reach the same single node of their body, and no other, are
/// multiples of each other: without the shift the operator would be singular, and a factor of it would meet a zero pivot.
const SHIFT: f64 = 1e-9;

/// Galerkin products `Pᵀ A P`, each of the next finer one, the finest of the coarsest operator that is assembled. So contact
/// comes down with the bodies.
#[derive(Default)]
pub struct GalerkinLevels {
    /// Coarsest first.
    operators: Vec<Matrix>,
}

impl GalerkinLevels {
    /// Below `finest`; the interpolations lead from the coarsest level up to it. **Collective**
    pub fn new(finest: &Matrix, interpolations: &[&Matrix]) -> Result<Self> {
        let mut operators: Vec<Matrix> = Vec::new();
        for interpolation in interpolations.iter().rev() {
            let mut operator = operators.last().unwrap_or(finest).galerkin(interpolation)?;
            operator.scale_diagonal(1.0 + SHIFT)?;
            operators.push(operator);
        }
        operators.reverse();
        Ok(Self { operators })
    }

    /// The same of a matrix with other values. **Collective**
    pub fn refresh(&mut self, finest: &Matrix, interpolations: &[&Matrix]) -> Result<()> {
        for (level, interpolation) in interpolations.iter().enumerate().take(self.operators.len()).rev() {
            let (coarser, finer) = self.operators.split_at_mut(level + 1);
            finer.first().unwrap_or(finest).galerkin_into(interpolation, &mut coarser[level])?;
            coarser[level].scale_diagonal(1.0 + SHIFT)?;
        }
        Ok(())
    }

    /// Coarsest first.
    pub fn iter(&self) -> impl Iterator<Item = &Matrix> {
        self.operators.iter()
    }
}
