//! The set that a solve begins with when no solution is known.

use crate::contact::{ActiveSet, GapChoice, Law};
use crate::discretisation::{Contact, SystemError, few_that_hold, not_held, rigid_start};
use crate::system::{Start, System};

/// Gap, as a share of the length of Γ_C, that counts as closed: less than bodies are usually strained by.
const CLOSED: f64 = 1e-6;

/// Begins with the set of a start and what it takes to hold all bodies here, or, without one, with that of the programme, or where bodies
/// touch before they are strained: those few that are closed for no other reason than to hold a body. **Collective**
pub(crate) fn begin_with(system: &mut System, set: &mut ActiveSet, start: Option<Start>) -> Result<Vec<usize>, SystemError> {
    let Some(start) = start else {
        let of_programme = system.problem().first_set.clone().map(|first| (first, Vec::new()));
        let Some((first, few)) = of_programme.or_else(|| first_set(system)) else { return Ok(Vec::new()) };
        set.start_from(&first);
        system.set_active(set.active())?;
        return Ok(few);
    };
    set.start_from(&start.active);
    let mut carried = set.active().to_vec();
    let few = hold(system, &start.displacement, &mut carried);
    if !few.is_empty() {
        set.start_from(&carried);
    }
    system.begin(&Start { active: carried, ..start })?;
    Ok(few)
}

/// Whether contacts that are closed all along on one mesh will be so on the next: there is no gap, or they end where the
/// pressure does.
pub(crate) fn stays_closed(contacts: &[Contact]) -> bool {
    contacts.iter().all(|contact| contact.pair.has_free_ends() || matches!(contact.pair.gap, GapChoice::Closed))
}

/// Closed where the bodies touch, or penetrate, before they are strained: moved rigidly as their supports ask. If that does
/// not hold all bodies, where the gap is smallest, too; those few that hold are told. Nothing if there is no gap anywhere: then all is
/// closed. **Collective**
///
/// All closed at the start would draw bodies together along the whole of an open contact, and the forces of that are orders
/// above those of the loads: what they say of the next set is nothing.
fn first_set(system: &System) -> Option<(Vec<bool>, Vec<usize>)> {
    let problem = system.problem();
    let start = rigid_start(problem, system.session().rank()).unwrap_or_else(|| vec![0.0; problem.finest().local_unknowns()]);
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
    let few = hold(system, &start, &mut active);
    Some((active, few))
}

/// Mean gap over each multiplier (length). **Collective**
fn gaps(system: &System, displacement: &[f64]) -> Vec<f64> {
    let mut gap = system.penetration(displacement);
    for contact in &system.problem().contacts {
        contact.range().for_each(|i| gap[i] /= -contact.multipliers.integral(i - contact.first));
    }
    gap
}

/// Closes what has the smallest gap, with the bodies displaced, until all are held or all is closed: those few. **Collective**
fn hold(system: &System, displacement: &[f64], active: &mut [bool]) -> Vec<usize> {
    if not_held(system.problem(), active, system.session()).is_none() {
        return Vec::new();
    }
    let gap = gaps(system, displacement);
    let few = few_that_hold(system.problem(), active, |i| -gap[i], system.session());
    few.iter().for_each(|&i| active[i] = true);
    few
}
