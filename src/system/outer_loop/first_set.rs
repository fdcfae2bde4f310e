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
    let depth = penetration(problem, system, &start, session);
    let mut gap = vec![0.0; depth.len()];
    let mut active = vec![true; depth.len()];
    for contact in &problem.contacts {
        for i in contact.range() {
            gap[i] = -depth[i] / contact.multipliers.weight(i - contact.first);
            active[i] = contact.pair.law == Law::Bilateral || gap[i] <= CLOSED * contact.boundary.length();
        }
    }
    if !active.contains(&false) {
        return None;
    }
    if not_held(problem, &active).is_some() {
        few_that_hold(problem, &active, |i| -gap[i]).into_iter().for_each(|i| active[i] = true);
    }
    Some(active)
}
