//! The motions of rigid sets, from the displacements of their nodes.

use crate::body::Motion;
use crate::discretisation::error::SystemError;
use crate::discretisation::levels::Discretisation;
use crate::discretisation::motions::mean_force::settle_means;
use crate::discretisation::solution::Solution;
use crate::discretisation::space::Space;
use crate::geometry::Point;
use nalgebra::{Matrix3, Vector3};

/// Eigenvalues below this share of the largest are none: a set that is one point does not turn.
const FLAT: f64 = 1e-12;

/// Puts the nodes of rigid sets, and bodies whose mean motion is held, where a solution has moved them: what comes after the solve
/// takes their displacement for a prescribed one, and what holds a mean for a load. **Collective**
///
/// # Errors
/// [`SystemError`] from PETSc or an inverted triangle.
pub fn settle(problem: &mut Discretisation, solution: &Solution) -> Result<(), SystemError> {
    let displacement = &solution.displacement;
    if !problem.scene.means.is_empty() {
        settle_means(problem, solution)?;
    }
    let motions = rigid_motions(problem, displacement);
    let finest = problem.spaces.len() - 1;
    let Space { constraints, numbering, .. } = &mut problem.spaces[finest];
    for (set, motion) in problem.scene.rigid.iter().zip(&motions) {
        constraints.move_rigidly(&problem.scene.mesh, numbering, set, motion);
    }
    Ok(())
}

/// Motion of every rigid set of the scene, from this rank's displacements in the nodes' frames, those that are prescribed
/// included: the components that are free by least squares, which are exact, the others as they are prescribed. **Collective**
pub fn rigid_motions(problem: &Discretisation, displacement: &[f64]) -> Vec<Motion> {
    let (mesh, space) = (&problem.scene.mesh, problem.finest());
    let mut motions = Vec::new();
    for set in &problem.scene.rigid {
        let mut motion = set.prescribed_motion();
        let free: Vec<usize> = set.free().collect();
        let places = set.places(mesh, &space.numbering);
        // Turns are measured by the size of the set, so that all components count alike.
        let arm = places.values().map(|x| (x - set.about).norm()).fold(f64::MIN_POSITIVE, f64::max);
        let scale = [1.0, 1.0, 1.0 / arm];
        let mut sums = [0.0; 12];
        for (&node, &x) in places.iter().filter(|(node, _)| space.own.contains(node)) {
            let at = 2 * (node - space.own.start);
            let u = space.to_global(node, Point::new(displacement[at], displacement[at + 1])) - set.displacement(&motion, x);
            for &j in &free {
                let mode = scale[j] * set.mode(j, x);
                sums[9 + j] += mode.dot(&u);
                free.iter().for_each(|&k| sums[3 * j + k] += scale[k] * mode.dot(&set.mode(k, x)));
            }
        }
        problem.session.sum(&mut sums);
        let gram = Matrix3::from_row_slice(&sums[..9]);
        let inverse = gram.pseudo_inverse(FLAT * gram.amax()).unwrap_or_default();
        let found = inverse * Vector3::from_row_slice(&sums[9..]);
        free.iter().for_each(|&k| motion[k] = scale[k] * found[k]);
        motions.push(motion);
    }
    motions
}
