//! Forces and moments of contact on either body.

use crate::contact::Configuration;
use crate::discretisation::{Contact, Discretisation, Solution};
use crate::geometry::{Point, cross};
use crate::mesh::EdgeNode;

/// Resultants of one contact, from each body's own integrals.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ContactForce {
    /// `∫λ ds` (force per thickness).
    pub force: f64,
    /// Force on body 1 and on body 2.
    pub resultants: [Point; 2],
    /// Their moments about the origin.
    pub moments: [f64; 2],
}

impl ContactForce {
    /// What the forces of a contact are measured by: along a curve, as around a shaft with a keyway, or an axis of revolution, they may
    /// cancel.
    pub fn size(&self, contact: &Contact) -> f64 {
        let resultant = self.resultants[1].norm();
        let cancels = !contact.boundary.is_straight() || contact.boundary.is_round();
        if cancels { resultant.max(self.force.abs()) } else { resultant }
    }
}

/// Force, resultants and moments of each contact. **Collective**
pub fn contact_forces(problem: &Discretisation, solution: &Solution) -> Vec<ContactForce> {
    let of_rank = |contact: &Contact| {
        let ContactForce { force, resultants: [a, b], moments } = contact_force(problem, contact, solution);
        [force, a.x, a.y, b.x, b.y, moments[0], moments[1]]
    };
    let mut sums: Vec<[f64; 7]> = problem.contacts.iter().map(of_rank).collect();
    problem.session.sum(sums.as_flattened_mut());
    let whole = |[force, ax, ay, bx, by, first, second]: [f64; 7]| ContactForce {
        force,
        resultants: [Point::new(ax, ay), Point::new(bx, by)],
        moments: [first, second],
    };
    sums.into_iter().map(whole).collect()
}

/// The part of one contact that the multipliers of this rank have.
fn contact_force(problem: &Discretisation, contact: &Contact, solution: &Solution) -> ContactForce {
    let mut sum = ContactForce::default();
    let (mesh, space) = (&problem.scene.mesh, problem.finest());
    let moves = contact.pair.configuration == Configuration::Deformed;
    // A side that is drawn apart from Γ_C will lie there.
    let shifts = contact.known.meeting.as_ref().map_or([Point::zeros(); 2], |meeting| meeting.shifts);
    let place = |node: EdgeNode| {
        let x = node.place(mesh, &space.numbering);
        if moves { x + problem.motion.at(node, mesh, space) } else { x }
    };
    for i in problem.coupling.own(contact.range(), problem.session.rank()) {
        let lambda = solution.multipliers[i];
        sum.force += lambda * contact.multipliers.integral(i - contact.first);
        for coupled in &problem.coupling.rows[i] {
            let (k, force) = (coupled.side as usize, -lambda * coupled.value);
            sum.resultants[k] += mesh.plane.resultant(force);
            sum.moments[k] += cross(place(coupled.node) + shifts[k], force);
        }
    }
    sum
}
