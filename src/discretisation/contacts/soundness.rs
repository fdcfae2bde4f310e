//! What a look at a scene finds wrong before anything is solved: formulas without a value, triangles turned inside out.

use crate::body::{check_body_forces, check_folding, check_loads, varies};
use crate::contact::{GapChoice, declared_gap};
use crate::discretisation::contacts::contact::Contact;
use crate::discretisation::error::SystemError;
use crate::discretisation::scene::Scene;
use crate::mesh::{Level, Numbering};

/// Triangles that are looked at, at most: what only a finer mesh shows is told where it is assembled.
const MOST_LOOKED_AT: usize = 20_000;

/// Looks at the formulas of loads, body forces and gaps where they will be integrated, and at the triangles along bent boundaries.
/// The same on every rank.
///
/// # Errors
/// [`SystemError::Case`] with key, formula and point, or with the triangle.
pub fn check_soundness(scene: &Scene, numbering: &Numbering, contacts: &[Contact]) -> Result<(), SystemError> {
    let (mesh, parts) = (&scene.mesh, scene.parts());
    let curved = (0..mesh.triangles.len()).filter(|&triangle| mesh.is_curved(triangle)).count();
    check_folding(mesh, looked_at(scene, curved))?;
    check_loads(mesh, numbering, &scene.loads).map_err(SystemError::Case)?;
    let forced =
        (0..mesh.triangles.len()).filter(|&triangle| parts[mesh.triangles[triangle].part as usize].formulas().any(varies));
    let level = looked_at(scene, forced.clone().count());
    check_body_forces(mesh, forced, level, &parts).map_err(SystemError::Case)?;
    for contact in contacts {
        if let GapChoice::Formula(formula) = &contact.pair.gap {
            declared_gap(&contact.boundary, &contact.multipliers, formula)
                .map_err(|words| SystemError::Case(format!("contact.{}.gap: {words}", contact.pair.name)))?;
        }
    }
    Ok(())
}

/// The finest level of the scene's elements that has no more triangles in so many macro triangles than are looked at.
fn looked_at(scene: &Scene, count: usize) -> Level {
    let level = |refine: usize| Level { intervals: scene.order.degree() << refine, order: scene.order };
    let is_little = |level: &Level| count.saturating_mul(level.triangles_per_edge().pow(2)) <= MOST_LOOKED_AT;
    (0..=scene.refine).rev().map(level).find(is_little).unwrap_or(Level { intervals: scene.order.degree(), order: scene.order })
}
