//! Nodal forces of all loads.

use crate::body::{Applied, applied_forces, body_forces, check_body_forces, check_loads};
use crate::discretisation::error::SystemError;
use crate::discretisation::field::Field;
use crate::discretisation::held_bodies::holds_of_bodies;
use crate::discretisation::levels::Discretisation;
use crate::discretisation::scene::Scene;
use crate::geometry::Point;
use crate::mesh::Numbering;

/// Forces of loads and body forces, and of what holds mean motions, at the nodes, in global axes. **Collective**
///
/// # Errors
/// [`SystemError::Case`] if a triangle is turned inside out, or a force has no finite value.
pub fn nodal_forces(problem: &Discretisation) -> Result<Field<2>, SystemError> {
    let mut forces = match problem.without_contact.applied.get() {
        Some(found) => found.clone(),
        None => {
            let found = applied(problem)?;
            // Those of loads alone are soon found again: their memory is free while the system is solved.
            if problem.scene.parts().iter().any(|part| part.is_loaded()) {
                _ = problem.without_contact.applied.set(found.clone());
            }
            found
        }
    };
    if problem.mean_forces.iter().flatten().any(|force| *force != 0.0) {
        forces.add(1.0, &mean_forces(problem)?);
    }
    Ok(forces)
}

/// Forces of loads and body forces. **Collective**
fn applied(problem: &Discretisation) -> Result<Field<2>, SystemError> {
    let (scene, numbering, session) = (&problem.scene, &problem.finest().numbering, &problem.session);
    let mut forces = Field::<2>::zeros(scene, problem.finest(), session);
    let add = |node, force| forces.add_at(node, force);
    let rank = session.rank();
    let applied = Applied { parts: &scene.parts(), loads: &scene.loads, point_loads: &scene.point_loads };
    let added = applied_forces(&scene.mesh, &scene.partition, rank, numbering, &applied, add);
    session.agree(added.map_err(SystemError::from))?;
    let bad = forces.own().iter().flatten().any(|force| !force.is_finite());
    if session.any(bad) {
        session.agree(find_bad_force(scene, numbering, rank))?;
        return Err(SystemError::Case("load or body_force: nodal forces are too large to be counted; make them smaller".into()));
    }
    Ok(forces.sum(session))
}

/// What holds mean motions, as nodal forces. **Collective**
fn mean_forces(problem: &Discretisation) -> Result<Field<2>, SystemError> {
    let (scene, numbering) = (&problem.scene, &problem.finest().numbering);
    let (bodies, of_body) = (problem.held_bodies()?, holds_of_bodies(scene));
    let mut forces = Field::<2>::zeros(scene, problem.finest(), &problem.session);
    for triangle in problem.own_triangles().iter().map(|&triangle| triangle as usize) {
        let Some(hold) = of_body[scene.mesh.triangles[triangle].body as usize] else { continue };
        let spread = bodies.spread(hold, &problem.mean_forces[hold]);
        let density = |points: &[Point; 6]| points.map(|x| bodies.moved(hold, &spread, x));
        // No triangle is turned inside out: the bodies have been measured.
        _ = body_forces(&scene.mesh, triangle, numbering, density, &mut |node, force| forces.add_at(node, force));
    }
    Ok(forces.sum(&problem.session))
}

/// The load or force on this rank's macro triangles that has no finite value.
fn find_bad_force(scene: &Scene, numbering: &Numbering, rank: usize) -> Result<(), String> {
    check_loads(&scene.mesh, numbering, &scene.loads)?;
    let own = scene.partition.triangles_of(rank).iter().map(|&triangle| triangle as usize);
    check_body_forces(&scene.mesh, own, numbering.level, &scene.parts())
}

/// Nodal forces as the right-hand side wants them: this rank's unknowns in the nodes' frames, zero where displacement
/// is prescribed.
pub fn load(problem: &Discretisation, forces: &Field<2>) -> Vec<f64> {
    let space = problem.finest();
    let free = |(node, [x, y]): (usize, &[f64; 2])| <[f64; 2]>::from(space.free_part(node, Point::new(*x, *y)));
    space.own.clone().zip(forces.own()).flat_map(free).collect()
}
