//! Forces that held mean motions take from contact.

use super::balance::Balance;
use crate::body::MeanHold;
use crate::discretisation::{Contact, Discretisation, HeldLoad, Solution, forces_without_holds};
use crate::geometry::Point;

/// Share of all forces below which a force of a hold, or what it changes, is none.
const NOTHING: f64 = 1e-6;

/// Share of the largest force on a body below which a moment that holds its turn is what a mesh makes of a balance: seven discs in a
/// groove have 1e-4, which narrow contacts would take by 6e-3 of their forces.
const FAINT: f64 = 1e-3;

/// Share of what changes that must press more: of a roller that is held against rolling off a wall a twentieth does, on the floor.
const CLOSES: f64 = 0.1;

/// Share of a force that must be left where nothing presses more: of a taper none is, but for what its ends make of it.
const LEFT: f64 = 0.1;

/// For each contact by how much its force would change if contact carried what a mean motion is held against, by that force: forces and
/// moments each by themselves. A hold that moves its body presses it. **Collective**
pub fn held_forces(problem: &Discretisation, solution: &Solution, balance: &Balance) -> Vec<f64> {
    let scene = &problem.scene;
    let reactions = balance.reactions.iter().skip(scene.supports.len() + scene.springs.len());
    let found = scene.means.iter().zip(reactions.zip(&balance.mean_moments));
    let at_rest = found.filter(|(hold, _): &(&MeanHold, _)| hold.held.iter().all(|held| held.value == 0.0));
    let loads = at_rest.flat_map(|(hold, (&force, &moment))| {
        [HeldLoad { hold, force, moment: 0.0 }, HeldLoad { hold, force: Point::zeros(), moment }]
    });
    let counts = |size: f64| size > NOTHING * balance.forces;
    let is_on = |contact: &Contact, hold: &MeanHold| contact.bodies.iter().any(|&body| scene.mesh.bodies[body] == hold.body);
    let largest = |hold: &MeanHold| {
        let own = problem.contacts.iter().zip(&balance.contacts).filter(|(contact, _)| is_on(contact, hold));
        own.map(|(_, found)| found.force).fold(0.0, f64::max)
    };
    let size = |load: &HeldLoad| load.force.norm() + load.moment.abs() / load.hold.reach;
    let is_driven = |load: &HeldLoad| counts(size(load)) && (load.moment == 0.0 || size(load) > FAINT * largest(load.hold));
    let driven: Vec<HeldLoad> = loads.filter(is_driven).collect();
    let mut shares = vec![0.0_f64; problem.contacts.len()];
    for changes in forces_without_holds(problem, &solution.active, &driven).into_iter().flatten() {
        let counting = changes.iter().zip(&balance.contacts).filter(|([_, size], _)| counts(*size));
        if !could_carry(&counting.map(|(change, own)| (*change, own.force)).collect::<Vec<_>>()) {
            continue;
        }
        for ((share, [_, size]), own) in
            shares.iter_mut().zip(&changes).zip(&balance.contacts).filter(|((_, [_, size]), _)| counts(*size))
        {
            *share = share.max(size / own.force.abs().max(*size));
        }
    }
    shares
}

/// Whether contact could carry what changes it so, by the change of each force with the sum of all that presses more or less, and the
/// force itself: something presses more, or enough is left everywhere, and no contact carries a couple that is larger than its force. A
/// taper that is held against sliding off presses nowhere without its hold; a narrow contact does not keep a stop from turning.
fn could_carry(contacts: &[([f64; 2], f64)]) -> bool {
    let is_couple = |([sum, size], own): &([f64; 2], f64)| 0.5 * (size - sum.abs()) > *own;
    if contacts.iter().any(is_couple) {
        return false;
    }
    let closing: f64 = contacts.iter().map(|([sum, size], _)| 0.5 * (size + sum)).sum();
    let all: f64 = contacts.iter().map(|([_, size], _)| size).sum();
    closing > CLOSES * all || contacts.iter().all(|([sum, _], own)| own + sum >= LEFT * own)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn contact_could_carry_what_presses_more_or_leaves_enough() {
        assert!(could_carry(&[([67.0, 67.0], 222.0), ([-67.0, 67.0], 222.0)]), "a roller between two flanks");
        assert!(could_carry(&[([-21.3, 21.3], 41.3)]), "a block that is held against a wall, too");
        assert!(!could_carry(&[([-95.0, 95.0], 95.6)]), "a taper that is held against sliding off");
        assert!(!could_carry(&[([0.0, 0.45], 78.5), ([-3.9, 3.9], 1.2)]), "a roller that is held against rolling off a wall");
        assert!(!could_carry(&[([-0.81, 13.47], 0.81)]), "a stop beside the middle of which a strip presses");
        assert!(could_carry(&[([-0.81, 2.0], 0.81)]), "a stop of a width that may carry its moment");
    }
}
