//! Nodal forces of all loads.

use super::mean_motion::mean_weights;
use super::{Discretisation, Field, SystemError};
use crate::body::{Applied, applied_forces};
use crate::geometry::Point;
use crate::petsc::Session;

/// Forces of loads and body forces, and of what holds mean motions, at the nodes, in global axes. **Collective**
///
/// # Errors
/// [`SystemError::Case`] if a triangle is turned inside out.
pub fn nodal_forces(problem: &Discretisation, session: &Session) -> Result<Field<2>, SystemError> {
    let (scene, numbering) = (&problem.scene, &problem.finest().numbering);
    let mut forces = Field::<2>::zeros(problem, session);
    let add = |node, force: Point| {
        let sum = forces.at_mut(node);
        sum[0] += force.x;
        sum[1] += force.y;
    };
    let rank = session.rank();
    let applied = Applied { parts: &scene.parts(), loads: &scene.loads, point_loads: &scene.point_loads };
    let added = applied_forces(&scene.mesh, &scene.partition, rank, numbering, &applied, add);
    session.agree(added.map_err(SystemError::from)).map_err(SystemError::Case)?;
    let bad = forces.own().iter().flatten().any(|force| !force.is_finite());
    if session.any(bad) {
        let words = "load or body_force: a formula has no finite value somewhere on its boundary or body; correct it";
        return Err(SystemError::Case(words.into()));
    }
    let mut forces = forces.sum(session)?;
    for (hold, held) in problem.scene.means.iter().zip(&problem.mean_forces) {
        for k in hold.held().filter(|&k| held[k] != 0.0) {
            let weights = mean_weights(problem, hold, k, session)?;
            forces.subtract(&weights.map(|weight| weight.map(|component| -held[k] * component)));
        }
    }
    Ok(forces)
}

/// Nodal forces as the right-hand side wants them: this rank's unknowns in the nodes' frames, zero where displacement
/// is prescribed.
pub fn load(problem: &Discretisation, forces: &Field<2>) -> Vec<f64> {
    let space = problem.finest();
    let free = |(node, [x, y]): (usize, &[f64; 2])| <[f64; 2]>::from(space.free_part(node, Point::new(*x, *y)));
    space.own.clone().zip(forces.own()).flat_map(free).collect()
}
