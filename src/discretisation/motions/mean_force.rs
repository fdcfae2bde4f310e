//! What holds bodies whose mean motion is held, once a solution is found.

use crate::body::Motion;
use crate::discretisation::error::SystemError;
use crate::discretisation::forces::nodal_forces;
use crate::discretisation::held_bodies::{HeldBodies, held_motions, holds_of_bodies};
use crate::discretisation::levels::Discretisation;
use crate::discretisation::solution::Solution;
use crate::geometry::Point;

/// Puts the anchors of all bodies whose mean motion is held where a solution has moved them, and finds what holds these bodies:
/// all that is missing in their balance. **Collective**
///
/// # Errors
/// [`SystemError`] from PETSc or an inverted triangle.
pub fn settle_means(problem: &mut Discretisation, solution: &Solution) -> Result<(), SystemError> {
    let bodies = problem.held_bodies()?;
    let missing = missing_forces(problem, &bodies, solution)?;
    let motions = held_motions(&problem.scene, problem.finest(), &bodies.about, &solution.displacement, &problem.session);
    let Discretisation { scene, spaces, mean_forces, .. } = &mut *problem;
    for (number, hold) in scene.means.iter().enumerate() {
        mean_forces[number].iter_mut().zip(missing[number]).for_each(|(sum, force)| *sum += force);
        let Some(space) = spaces.last_mut() else { continue };
        for anchor in &hold.anchors {
            let moved =
                hold.held.iter().zip(&motions[number]).map(|(held, q)| *q * bodies.moved(number, &held.mode, anchor.place));
            space.constraints.move_anchor(&space.numbering, anchor, moved.sum());
        }
    }
    Ok(())
}

/// What balances each body, a force and its moment about the middle, from `(B R)ᵀ λ - Rᵀ f` of the modes that are held.
/// **Collective**
fn missing_forces(problem: &Discretisation, bodies: &HeldBodies, solution: &Solution) -> Result<Vec<Motion>, SystemError> {
    let (scene, space, coupling) = (&problem.scene, problem.finest(), &problem.coupling);
    let loads = nodal_forces(problem)?;
    let mut sums = vec![[0.0; 3]; scene.means.len()];
    let mut add = |hold: usize, x: Point, force: Point| {
        for (sum, held) in sums[hold].iter_mut().zip(&scene.means[hold].held) {
            *sum += force.dot(&bodies.moved(hold, &held.mode, x));
        }
    };
    bodies.nodes.iter().for_each(|&(node, hold, x)| add(hold, x, -loads.point(node)));
    let of_body = holds_of_bodies(scene);
    for row in coupling.own(0..coupling.owners.len(), problem.session.rank()) {
        for coupled in &coupling.rows[row] {
            if let Some(hold) = of_body[coupled.body] {
                add(hold, coupled.node.place(&scene.mesh, &space.numbering), solution.multipliers[row] * coupled.value);
            }
        }
    }
    problem.session.sum(sums.as_flattened_mut());
    Ok(sums.iter().enumerate().map(|(hold, pushed)| bodies.resultant(scene, hold, pushed)).collect())
}
