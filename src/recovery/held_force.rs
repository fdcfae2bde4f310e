//! Forces that held mean motions take from contact.

use super::balance::Balance;
use crate::body::MeanHold;
use crate::discretisation::{Discretisation, Freedom, HeldLoad, Solution, are_resisted};
use crate::geometry::Point;
use crate::petsc::Session;

/// Forces of a hold by the largest force of a contact that they change, and of these by all forces, that are as good as none.
const NOTHING: f64 = 1e-4;

/// For each contact the largest force of a hold that contact could carry, moments by the reach of the body, by the largest force of all
/// contacts that would change then: on that body, and on others that are free and hang on it by contact. A hold that moves its body
/// presses it. **Collective**
pub fn held_forces(problem: &Discretisation, solution: &Solution, balance: &Balance, session: &Session) -> Vec<f64> {
    let (scene, contacts) = (&problem.scene, &problem.contacts);
    let mut shares = vec![0.0_f64; contacts.len()];
    if scene.means.is_empty() {
        return shares;
    }
    let is_free: Vec<bool> = Freedom::of_bodies(scene).iter().map(Option::is_some).collect();
    let changed = |hold: &MeanHold| changed_by(hold, problem, &is_free);
    let largest =
        |contacts: &[usize]| contacts.iter().map(|&at| balance.contacts[at].force).fold(NOTHING * balance.forces, f64::max);
    let reactions = balance.reactions.iter().skip(scene.supports.len() + scene.springs.len());
    let found = scene.means.iter().zip(reactions.zip(&balance.mean_moments));
    let at_rest = found.filter(|(hold, _)| hold.held.iter().all(|held| held.value == 0.0));
    let loads = at_rest.flat_map(|(hold, (&force, &moment))| {
        [HeldLoad { hold, force, moment: 0.0 }, HeldLoad { hold, force: Point::zeros(), moment }]
    });
    let size = |load: &HeldLoad| load.force.norm() + load.moment.abs() / load.hold.reach;
    let counts = |load: &HeldLoad| size(load) > NOTHING * largest(&changed(load.hold));
    let driven: Vec<HeldLoad> = loads.filter(|load| size(load) > NOTHING * NOTHING * balance.forces).filter(counts).collect();
    for (load, _) in driven.iter().zip(are_resisted(problem, &solution.active, &driven, session)).filter(|(_, taken)| *taken) {
        let changed = changed(load.hold);
        let share = size(load) / largest(&changed).max(size(load));
        changed.into_iter().for_each(|at| shares[at] = shares[at].max(share));
    }
    shares
}

/// The contacts of a held body, and of all free ones that hang on it by contact.
fn changed_by(hold: &MeanHold, problem: &Discretisation, is_free: &[bool]) -> Vec<usize> {
    let (mesh, contacts) = (&problem.scene.mesh, &problem.contacts);
    let mut hangs: Vec<bool> = mesh.bodies.iter().map(|body| *body == hold.body).collect();
    loop {
        let joined = contacts.iter().filter(|contact| contact.bodies.iter().any(|&body| hangs[body]));
        let Some(next) = joined.flat_map(|contact| contact.bodies).find(|&body| is_free[body] && !hangs[body]) else { break };
        hangs[next] = true;
    }
    (0..contacts.len()).filter(|&at| contacts[at].bodies.iter().any(|&body| hangs[body])).collect()
}
