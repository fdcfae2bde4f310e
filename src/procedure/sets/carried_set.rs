//! The set that a solve begins with where a coarser mesh or another boundary has left one.

use crate::discretisation::{few_that_hold, not_held};
use crate::system::System;

/// What was `carried` over, and what it takes to hold all bodies here: closed where the mean gap (length) of the bodies, displaced by
/// what was carried over, is smallest. The idle rollers of a bearing come apart from both rings on a finer mesh. **Collective**
pub(crate) fn carried_set(system: &System, carried: &[bool], displacement: &[f64]) -> Vec<bool> {
    let problem = system.problem();
    let mut active = carried.to_vec();
    if not_held(problem, &active).is_some() {
        let mut penetration = system.penetration(displacement);
        for contact in &problem.contacts {
            contact.range().for_each(|i| penetration[i] /= contact.multipliers.integral(i - contact.first));
        }
        few_that_hold(problem, &active, |i| penetration[i]).into_iter().for_each(|i| active[i] = true);
    }
    active
}
