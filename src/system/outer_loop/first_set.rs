//! The set that a solve begins with when no solution is known.

use super::contact_state::penetration;
use crate::contact::Law;
use crate::petsc::Session;
use crate::system::{Discretisation, SaddlePoint, few_that_hold, not_held, rigid_start};

/// Gap, as a share of the length of Γ_C, that counts as closed: less than bodies are usually strained by.
const CLOSED: f64 = 1e-6;

/// Closed where the bodies touch, or penetrate, before they are strained: moved rigidly as their supports ask. If that does
/// not hold all bodies, where the gap is smallest, too. Nothing if there is no gap anywhere: then all is closed. **Collective**
///
/// All closed at the start would draw bodies together along the whole of an open contact, and the forces of that are orders
/// above those of the loads: what they say of the next set is nothing.
pub(super) fn first_set(problem: &Discretisation, system: &SaddlePoint, session: &Session) -> Option<Vec<bool>> {
    let start = rigid_start(problem, session.rank()).unwrap_or_else(|| vec![0.0; problem.finest().local_unknowns()]);
    let gap = gaps(problem, system, &start, session);
    let mut active = vec![true; gap.len()];
    for contact in &problem.contacts {
        for i in contact.range() {
            active[i] = contact.pair.law == Law::Bilateral || gap[i] <= CLOSED * contact.boundary.length();
        }
    }
    if !active.contains(&false) {
        return None;
    }
    hold(problem, &gap, &mut active);
    Some(active)
}

/// A set that a coarser mesh or another boundary has left, and what it takes to hold all bodies here: where the gap is
/// smallest, with the displacements carried over. **Collective**
pub(super) fn carried_set(
    problem: &Discretisation,
    system: &SaddlePoint,
    carried: &[bool],
    displacement: &[f64],
    session: &Session,
) -> Vec<bool> {
    let gap = gaps(problem, system, displacement, session);
    let mut active = carried.to_vec();
    hold(problem, &gap, &mut active);
    active
}

/// Mean gap over each multiplier (length). **Collective**
fn gaps(problem: &Discretisation, system: &SaddlePoint, displacement: &[f64], session: &Session) -> Vec<f64> {
    let mut gap = penetration(problem, system, displacement, session);
    for contact in &problem.contacts {
        contact.range().for_each(|i| gap[i] /= -contact.multipliers.weight(i - contact.first));
    }
    gap
}

/// Closes what has the smallest gap until all bodies are held, or all is closed.
fn hold(problem: &Discretisation, gap: &[f64], active: &mut [bool]) {
    if not_held(problem, active).is_some() {
        few_that_hold(problem, active, |i| -gap[i]).into_iter().for_each(|i| active[i] = true);
    }
}
