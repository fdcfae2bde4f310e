//! What mean motions are held against, and what contact would make of it.

use super::held::{FIRM, Restraints, conditions_with, spring_conditions};
use crate::body::MeanHold;
use crate::contact;
use crate::discretisation::levels::Discretisation;
use crate::geometry::{Point, cross};

/// What a mean motion is held against.
pub struct HeldLoad<'a> {
    /// The hold.
    pub hold: &'a MeanHold,
    /// Force per thickness.
    pub force: Point,
    /// Moment about the middle of the body (force).
    pub moment: f64,
}

/// For each force that a mean motion is held against what the forces of all contacts would change by without that hold, and the sums of
/// all that would press more or less there: nothing if the other supports and closed contact do not resist it. **Collective**
pub fn forces_without_holds(problem: &Discretisation, active: &[bool], loads: &[HeldLoad]) -> Vec<Option<Vec<[f64; 2]>>> {
    if loads.is_empty() {
        return Vec::new();
    }
    let (scene, extents) = (&problem.scene, problem.scene.extents());
    let touches = Restraints::of(problem).touches(&extents, active);
    let springs = spring_conditions(scene, &extents, FIRM);
    let changed = |HeldLoad { hold, force, moment }: &HeldLoad| {
        let piece = scene.mesh.pieces.iter().position(|piece| scene.mesh.bodies[piece.body] == hold.body)?;
        let mut others = conditions_with(scene, &extents, |other| other.name != hold.name);
        others.extend(&springs);
        let moment = moment + cross(hold.middle - extents[piece].middle, *force);
        let push = [force.x, force.y, moment / extents[piece].radius].map(|held| -held);
        contact::changed_forces(&extents, &others, &touches, (piece, push))
    };
    loads.iter().map(changed).collect()
}
