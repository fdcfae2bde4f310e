//! The set that a solve begins with when no solution is known.

use crate::contact::Law;
use crate::discretisation::{few_that_hold, not_held, rigid_start};
use crate::system::System;

/// Gap, as a share of the length of Γ_C, that counts as closed: less than bodies are usually strained by.
const CLOSED: f64 = 1e-6;

/// Closed where the bodies touch, or penetrate, before they are strained: moved rigidly as their supports ask. If that does
/// not hold all bodies, where the gap is smallest, too. Nothing if there is no gap anywhere: then all is closed. **Collective**
///
/// All closed at the start would draw bodies together along the whole of an open contact, and the forces of that are orders
/// above those of the loads: what they say of the next set is nothing.
pub(crate) fn first_set(system: &System) -> Option<Vec<bool>> {
    let problem = system.problem();
    let start = rigid_start(problem, problem.session.rank()).unwrap_or_else(|| vec![0.0; problem.finest().local_unknowns()]);
    let gap = gaps(system, &start);
    let mut active = vec![true; gap.len()];
    for contact in &problem.contacts {
        for i in contact.range() {
            active[i] = contact.pair.law == Law::Bilateral || gap[i] <= CLOSED * contact.boundary.length();
        }
    }
    if !active.contains(&false) {
        return None;
    }
    hold(system, &start, &mut active);
    Some(active)
}

/// A set that a coarser mesh or another boundary has left, and what it takes to hold all bodies here: where the gap is
/// smallest, with the displacements carried over. **Collective**
pub(crate) fn carried_set(system: &System, carried: &[bool], displacement: &[f64]) -> Vec<bool> {
    let mut active = carried.to_vec();
    hold(system, displacement, &mut active);
    active
}

/// Mean gap over each multiplier (length). **Collective**
fn gaps(system: &System, displacement: &[f64]) -> Vec<f64> {
    let mut gap = system.penetration(displacement);
    for contact in &system.problem().contacts {
        contact.range().for_each(|i| gap[i] /= -contact.multipliers.integral(i - contact.first));
    }
    gap
}

/// Closes what has the smallest gap, with the bodies displaced, until all are held or all is closed. **Collective**
fn hold(system: &System, displacement: &[f64], active: &mut [bool]) {
    let problem = system.problem();
    if not_held(problem, active).is_some() {
        let gap = gaps(system, displacement);
        few_that_hold(problem, active, |i| -gap[i]).into_iter().for_each(|i| active[i] = true);
    }
}
