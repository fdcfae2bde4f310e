//! How far the bodies are strained: whether a theory of small strain holds.

use super::{agreed, nodal};
use crate::body::positions;
use crate::element::{Order, jacobian};
use crate::geometry::Point;
use crate::mesh::lattice;
use crate::petsc::Session;
use crate::system::{Discretisation, Field, SystemError};
use nalgebra::Matrix2;

/// Refinements from which on a macro triangle alone is a region of many triangles.
const MANY: usize = 2;

/// The largest strain of a body and where it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LargestStrain {
    /// Mean, over a macro triangle, of the larger principal strain by magnitude (no unit).
    pub strain: f64,
    /// Middle of that macro triangle.
    pub place: Point,
}

/// The largest strain of each body, as the mean over a macro triangle; where these are hardly refined, over it and its
/// neighbours. So a corner where the strain is singular counts by what its surroundings see, on fine meshes as on coarse
/// ones. **Collective**
///
/// # Errors
/// [`SystemError`] from an inverted triangle.
pub fn largest_strains(problem: &Discretisation, u: &Field<2>, session: &Session) -> Result<Vec<LargestStrain>, SystemError> {
    let mesh = &problem.scene.mesh;
    let count = mesh.triangles.len();
    // Of each macro triangle the integral of the strain, and the area.
    let mut sums = vec![0.0; 2 * count];
    let own = problem.scene.partition.triangles_of(session.rank());
    let added = own.iter().try_for_each(|&triangle| {
        let sum = match problem.finest().numbering.level.order {
            Order::P1 => integral::<3>(problem, u, triangle as usize)?,
            Order::P2 => integral::<6>(problem, u, triangle as usize)?,
        };
        sums[2 * triangle as usize..][..2].copy_from_slice(&sum);
        Ok(())
    });
    agreed(session, added)?;
    session.sum(&mut sums);
    for _ in problem.scene.refine..MANY {
        sums = with_neighbours(problem, &sums);
    }
    let mut largest = vec![LargestStrain { strain: 0.0, place: Point::zeros() }; mesh.bodies.len()];
    for (triangle, sum) in mesh.triangles.iter().zip(sums.chunks_exact(2)) {
        let of_body = &mut largest[triangle.body as usize];
        if sum[0] / sum[1] > of_body.strain {
            let [a, b, c] = triangle.vertices.map(|vertex| mesh.vertices[vertex as usize]);
            *of_body = LargestStrain { strain: sum[0] / sum[1], place: (a + b + c) / 3.0 };
        }
    }
    Ok(largest)
}

/// Each sum with those of the macro triangles beside it.
fn with_neighbours(problem: &Discretisation, sums: &[f64]) -> Vec<f64> {
    let mesh = &problem.scene.mesh;
    let mut wider = sums.to_vec();
    for edge in &mesh.edges {
        let [Some(a), Some(b)] = edge.triangles.map(|triangle| triangle.map(|triangle| triangle as usize)) else { continue };
        for k in 0..2 {
            wider[2 * a + k] += sums[2 * b + k];
            wider[2 * b + k] += sums[2 * a + k];
        }
    }
    wider
}

/// Integral of the larger principal strain over a macro triangle, and its area: one point for each triangle.
fn integral<const N: usize>(problem: &Discretisation, u: &Field<2>, triangle: usize) -> Result<[f64; 2], SystemError> {
    const MIDDLE: [f64; 3] = [1.0 / 3.0; 3];
    let level = problem.finest().numbering.level;
    let mut sum = [0.0; 2];
    for small in lattice::triangles(level.intervals, level.order) {
        let x = positions(&problem.scene.mesh, triangle, level, &small.nodes::<N>());
        let (gradients, area) = jacobian(&x, MIDDLE)?;
        let u = nodal::<N>(problem, u, triangle, &small);
        let gradient = u.iter().zip(&gradients).fold(Matrix2::zeros(), |sum, (u, g)| sum + u * g.transpose());
        sum[0] += area * principal(&gradient);
        sum[1] += area;
    }
    Ok(sum)
}

/// The larger principal strain of a displacement gradient, by magnitude.
fn principal(gradient: &Matrix2<f64>) -> f64 {
    let mean = 0.5 * (gradient[(0, 0)] + gradient[(1, 1)]);
    let half = 0.5 * (gradient[(0, 0)] - gradient[(1, 1)]);
    let shear = 0.5 * (gradient[(0, 1)] + gradient[(1, 0)]);
    mean.abs() + half.hypot(shear)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn principal_strains_do_not_see_rotations() {
        assert_eq!(principal(&Matrix2::new(0.0, -0.3, 0.3, 0.0)), 0.0);
        assert!((principal(&Matrix2::new(0.1, 0.0, 0.0, -0.4)) - 0.4).abs() < 1e-15);
        assert!((principal(&Matrix2::new(0.0, 0.2, 0.0, 0.0)) - 0.1).abs() < 1e-15);
    }
}
