//! What holds bodies whose mean motion is held, once a solution is found.

use super::mean_motion::{mean_motion, mean_weights, nodes_of_body};
use crate::body::{MeanHold, rigid_mode};
use crate::petsc::Session;
use crate::system::{Discretisation, Field, Solution, SystemError, nodal_forces};
use nalgebra::{DMatrix, DVector};

/// Puts the anchors of all bodies whose mean motion is held where a solution has moved them, and finds what holds these bodies:
/// all that is missing in their balance. **Collective**
///
/// # Errors
/// [`SystemError`] from PETSc or an inverted triangle.
pub fn settle_means(problem: &mut Discretisation, solution: &Solution, session: &Session) -> Result<(), SystemError> {
    let loads = nodal_forces(problem, session)?;
    for at in 0..problem.scene.means.len() {
        let hold = problem.scene.means[at].clone();
        let missing = missing_force(problem, &hold, solution, &loads, session)?;
        let motion = mean_motion(problem, &hold, &solution.displacement, session);
        for (k, force) in hold.held().zip(missing) {
            problem.mean_forces[at][k] += force;
        }
        let Discretisation { scene, spaces, .. } = &mut *problem;
        let Some(space) = spaces.last_mut() else { continue };
        let about = hold.middle(&scene.mesh);
        for anchor in hold.anchors(&scene.mesh).unwrap_or_default() {
            let moved = hold.held().zip(&motion).map(|(k, q)| q * rigid_mode(about, k, anchor.place)[anchor.axis]).sum();
            space.constraints.move_anchor(&space.numbering, &anchor, moved);
        }
    }
    Ok(())
}

/// `G⁻¹ ((B R)ᵀ λ - Rᵀ f)` with `G = Rᵀ M`: what balances a body, for each component of its motion that is held. **Collective**
fn missing_force(
    problem: &Discretisation,
    hold: &MeanHold,
    solution: &Solution,
    loads: &Field<2>,
    session: &Session,
) -> Result<Vec<f64>, SystemError> {
    let (scene, space) = (&problem.scene, problem.finest());
    let (about, held) = (hold.middle(&scene.mesh), hold.held().collect::<Vec<usize>>());
    let nodes = nodes_of_body(problem, &hold.body, session.rank());
    let count = held.len();
    let mut sums = vec![0.0; count * count + count];
    for (j, &component) in held.iter().enumerate() {
        let weights = mean_weights(problem, hold, component, session)?;
        for (i, &k) in held.iter().enumerate() {
            sums[i * count + j] = nodes.iter().map(|(&node, &x)| weights.point(node).dot(&rigid_mode(about, k, x))).sum();
        }
        let pushed = nodes.iter().map(|(&node, &x)| loads.point(node).dot(&rigid_mode(about, component, x)));
        sums[count * count + j] = -pushed.sum::<f64>();
    }
    let coupling = &problem.coupling;
    for row in coupling.own(0..coupling.owners.len(), session.rank()) {
        let lambda = solution.multipliers[row];
        for coupled in coupling.rows[row].iter().filter(|coupled| scene.bodies[coupled.body].name == hold.body) {
            let x = coupled.node.place(&scene.mesh, &space.numbering);
            let pushed = held.iter().map(|&k| lambda * coupled.value.dot(&rigid_mode(about, k, x)));
            sums[count * count..].iter_mut().zip(pushed).for_each(|(sum, pushed)| *sum += pushed);
        }
    }
    session.sum(&mut sums);
    let left = DVector::from_row_slice(&sums[count * count..]);
    let modes = DMatrix::from_row_slice(count, count, &sums[..count * count]);
    Ok(modes.lu().solve(&left).map_or_else(|| vec![0.0; count], |found| found.as_slice().to_vec()))
}
