//! What sliding does to contact pressures of the linear theory.

use crate::contact::{Configuration, SmoothSide, sliding};
use crate::mesh::EdgeNode;
use crate::petsc::Session;
use crate::system::{BoundaryMotion, Contact, Discretisation, Solution, is_needed};

/// Sliding along a curved contact, and what it spoils.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlidingError {
    /// Way of the bodies along each other, as a share of the length that presses.
    pub slip: f64,
    /// Estimated relative error of `∫λ ds`: what the gap that is left out does, by twice the strain energy; zero where
    /// equilibrium sets the force.
    pub force: f64,
    /// Estimated relative error of λ: what an uneven gap of this size takes in pressure on a half-plane.
    pub pressure: f64,
}

/// For each contact what its sliding spoils; nothing where it is straight, or where the normals follow the deformed bodies.
/// `energy` is the strain energy of all bodies. **Collective**
pub fn sliding_errors(
    problem: &Discretisation,
    solution: &Solution,
    energy: f64,
    session: &Session,
) -> Vec<Option<SlidingError>> {
    let concerned = |contact: &Contact| {
        contact.pair.configuration == Configuration::Reference
            && contact.known.meeting.is_some()
            && !contact.boundary.is_straight()
    };
    if !problem.contacts.iter().any(concerned) {
        return vec![None; problem.contacts.len()];
    }
    let (mesh, space) = (&problem.scene.mesh, problem.finest());
    let motion = BoundaryMotion::new(problem, &solution.displacement, session);
    let displacement = |node: EdgeNode| motion.at(node, mesh, space);
    let one = |contact: &Contact| {
        let meeting = contact.known.meeting.as_ref().filter(|_| concerned(contact))?;
        let sides = SmoothSide::of_pair(mesh, &space.numbering, &contact.pair, &displacement);
        let lambda = &solution.multipliers[contact.range()];
        let found = sliding(meeting.sides(&sides), &contact.boundary, &contact.multipliers, lambda);
        let knots = contact.boundary.knots();
        let ends_inside = knots[0] > contact.limits[0] && knots[knots.len() - 1] < contact.limits[1];
        let uneven = if ends_inside { found.bend } else { found.deviation };
        (found.force > 0.0 && energy > 0.0).then(|| SlidingError {
            slip: found.slip / found.length,
            force: if is_needed(problem, &solution.active, contact) { 0.0 } else { found.work.abs() / (2.0 * energy) },
            // On a half-plane a gap that varies by e over the half length a takes the pressure E* e/a; E* is about E_c/2.
            pressure: contact.modulus * uneven / found.force,
        })
    };
    problem.contacts.iter().map(one).collect()
}
