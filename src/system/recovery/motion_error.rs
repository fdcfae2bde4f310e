//! What finite motions do to contact pressures of the linear theory.

use super::Deformation;
use crate::contact::{Configuration, FiniteMotion, GapError, SmoothSide, Turn, finite_motion};
use crate::mesh::EdgeNode;
use crate::petsc::Session;
use crate::system::{BoundaryMotion, Contact, Discretisation, Solution, is_needed};

/// Sliding and turning of the two bodies in a contact, and what they spoil.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MotionError {
    /// Way of the bodies along each other, as a share of the length that presses; of curved fits on undeformed bodies.
    pub slip: Option<f64>,
    /// Estimated relative error of force or pressure by sliding and turning together; of such fits too.
    pub slip_error: Option<f64>,
    /// The part of it that comes from turning; for all contacts.
    pub rotation_error: f64,
}

/// For each contact what motions spoil; nothing where no body is strained. `energy` is the strain energy of each body.
/// **Collective**
pub fn motion_errors(
    problem: &Discretisation,
    solution: &Solution,
    energy: &[f64],
    bodies: &[Deformation],
    session: &Session,
) -> Vec<Option<MotionError>> {
    let follows = |contact: &Contact| {
        contact.pair.configuration == Configuration::Reference
            && contact.known.meeting.is_some()
            && !contact.boundary.is_straight()
    };
    if !problem.contacts.iter().any(follows) {
        return problem.contacts.iter().map(|contact| one(problem, solution, contact, energy, bodies, None)).collect();
    }
    let (mesh, space) = (&problem.scene.mesh, problem.finest());
    let motion = BoundaryMotion::new(&problem.scene, space, &solution.displacement, session);
    let displacement = |node: EdgeNode| motion.at(node, mesh, space);
    let with_sides = |contact: &Contact| {
        let meeting = contact.known.meeting.as_ref().filter(|_| follows(contact));
        let sides = meeting.map(|_| SmoothSide::of_pair(mesh, &space.numbering, &contact.pair, &displacement));
        let sides = meeting.zip(sides.as_ref()).map(|(meeting, sides)| meeting.sides(sides));
        one(problem, solution, contact, energy, bodies, sides)
    };
    problem.contacts.iter().map(with_sides).collect()
}

fn one(
    problem: &Discretisation,
    solution: &Solution,
    contact: &Contact,
    energy: &[f64],
    bodies: &[Deformation],
    sides: Option<[&SmoothSide; 2]>,
) -> Option<MotionError> {
    let turns = contact.bodies.map(|body| Turn { angle: bodies[body].rotation, middle: bodies[body].middle });
    let found = finite_motion(sides, turns, &contact.boundary, &contact.multipliers, &solution.multipliers[contact.range()]);
    let energy: f64 = contact.bodies.iter().map(|&body| energy[body]).sum();
    let growth: f64 = contact.bodies.iter().map(|&body| bodies[body].growth).sum();
    if found.force <= 0.0 || energy <= 0.0 {
        return None;
    }
    let needed = is_needed(problem, &solution.active, contact);
    let error = |gap: &GapError| {
        // By how much the energy, and so the force where displacements set it, is off.
        let force = if needed { 0.0 } else { (growth - gap.work).abs() / (2.0 * energy) };
        force.max(pressure_error(contact, &found, gap))
    };
    Some(MotionError {
        slip: sides.map(|_| found.slip / found.length),
        slip_error: sides.map(|_| error(&found.whole)),
        rotation_error: error(&found.turning),
    })
}

/// Relative error of λ by an uneven gap that is left out. On a half-plane a gap that varies by e over the half length a takes
/// the pressure E* e/a; E* is about E_c/2.
fn pressure_error(contact: &Contact, found: &FiniteMotion, gap: &GapError) -> f64 {
    let knots = contact.boundary.knots();
    let ends_inside = knots[0] > contact.limits[0] && knots[knots.len() - 1] < contact.limits[1];
    contact.modulus * if ends_inside { gap.bend } else { gap.deviation } / found.force
}
