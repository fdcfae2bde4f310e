//! Unknowns beside the displacements, which the cycle finds with these: rigid motions, and the multipliers of means.
//!
//! ```text
//! [ A   V ] [x]   [b]
//! [ Vᵀ  E ] [p] = [g]
//! ```
//! `p` and `E` are those of all levels, and `V`, of displacements alone, is restricted as forces are; what multipliers of contact do to
//! its rows is in `g`. Sweeps leave `p` as it is. On the coarsest level it is found with `x`:
//!
//! ```text
//! x = y - Z p,   y = A⁻¹ b,   p = Σ⁻¹ (g - Vᵀ y),   Z = A⁻¹ V,   Σ = E - Vᵀ Z
//! ```

use crate::multigrid::sparse::{Sparse, add_multiple, dot};
use crate::petsc::Session;
use nalgebra::{DMatrix, DVector};

/// Singular values of the scaled `Σ` below this share of the largest belong to motions that nothing resists.
const NOTHING: f64 = 1e-13;

/// Unknowns beside the displacements.
pub struct Border {
    /// `V` on the finest level, by unknowns of the border; rows are this rank's displacement unknowns.
    pub columns: Vec<Sparse>,
    /// `E`.
    pub corner: DMatrix<f64>,
    /// What each is measured by: entries of `E` over those of their row and their column are alike.
    pub scales: Vec<f64>,
}

/// The border on all levels of a cycle.
pub struct LevelBorder {
    session: Session,
    /// `V` by levels that are swept, the coarsest first.
    levels: Vec<Vec<Sparse>>,
    corner: DMatrix<f64>,
    /// `V` and `Z` on the coarsest.
    below: Vec<Sparse>,
    responses: Vec<Vec<f64>>,
    /// `Σ⁻¹`.
    inverse: DMatrix<f64>,
}

impl LevelBorder {
    /// From `V` on the levels between the finest and the coarsest one, and on that, with `Z` there. **Collective**
    pub fn new(
        Border { columns, corner, scales }: Border,
        mut levels: Vec<Vec<Sparse>>,
        below: Vec<Sparse>,
        responses: Vec<Vec<f64>>,
        session: &Session,
    ) -> Self {
        levels.push(columns);
        let count = scales.len();
        let mut works = DMatrix::from_fn(count, count, |i, j| dot(&below[i], &responses[j]));
        session.sum(works.as_mut_slice());
        let inverse = scaled_inverse(&corner - works, &scales);
        Self { session: session.clone(), levels, corner, below, responses, inverse }
    }

    /// `g - Vᵀ x` on a level. **Collective**
    pub fn left(&self, level: usize, g: &[f64], x: &[[f64; 2]]) -> Vec<f64> {
        self.left_of(&self.levels[level], g, x.as_flattened())
    }

    fn left_of(&self, columns: &[Sparse], g: &[f64], x: &[f64]) -> Vec<f64> {
        let mut left: Vec<f64> = columns.iter().map(|column| dot(column, x)).collect();
        self.session.sum(&mut left);
        left.iter_mut().zip(g).for_each(|(left, g)| *left = g - *left);
        left
    }

    /// `g - E p`.
    pub fn subtract_corner(&self, p: &[f64], g: &mut [f64]) {
        let product = &self.corner * DVector::from_column_slice(p);
        g.iter_mut().zip(product.iter()).for_each(|(g, product)| *g -= product);
    }

    /// `b - V p` on a level.
    pub fn subtract(&self, level: usize, p: &[f64], b: &mut [[f64; 2]]) {
        let b = b.as_flattened_mut();
        self.levels[level].iter().zip(p).for_each(|(column, p)| add_multiple(column, -p, b));
    }

    /// `p` of what has been found on the coarsest level without it, which becomes what belongs to it. **Collective**
    pub fn solve(&self, g: &[f64], y: &mut [f64]) -> Vec<f64> {
        let p = &self.inverse * DVector::from_vec(self.left_of(&self.below, g, y));
        for (response, p) in self.responses.iter().zip(p.iter()) {
            y.iter_mut().zip(response).for_each(|(y, z)| *y -= p * z);
        }
        p.as_slice().to_vec()
    }
}

/// Inverse of a Schur complement of unknowns with these scales; nothing of what nothing resists.
pub fn scaled_inverse(schur: DMatrix<f64>, scales: &[f64]) -> DMatrix<f64> {
    if scales.is_empty() {
        return schur;
    }
    let over = |matrix: DMatrix<f64>| matrix.map_with_location(|i, j, entry| entry / (scales[i] * scales[j]));
    let schur = over(schur);
    let least = NOTHING * schur.amax();
    over(schur.pseudo_inverse(least).unwrap_or_else(|_| DMatrix::zeros(scales.len(), scales.len())))
}
