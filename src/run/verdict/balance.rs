//! Whether the forces that a run has found balance each other.

use crate::case::Case;
use crate::output::Summary;
use crate::run::verdict::limits::{BODY_BALANCE, Doubt, NOT_STRAINED, SIDE_BALANCE};

/// What tells that forces are out of balance: those on a body, or those of a contact on its two bodies. None is said where a force
/// is to be trusted.
pub fn balance_doubts(summary: &Summary, case: &Case) -> Vec<Doubt> {
    let body = BODY_BALANCE.judge(out_of_balance(summary, case), &[]);
    body.into_iter().chain(SIDE_BALANCE.judge(summary.balance.force, &[])).collect()
}

/// By how much the forces on a body are out of balance, where mean motions are held: what holds such a body while the system is
/// solved may carry what a contact should. Elsewhere supports carry all, and beside no strain these forces are rounding.
pub fn out_of_balance(summary: &Summary, case: &Case) -> Option<f64> {
    let holds = summary.support.values().any(|support| support.moment.is_some());
    summary.balance.bodies.filter(|_| holds && is_strained(summary, case))
}

/// Whether bodies are strained by more than rounding.
pub fn is_strained(summary: &Summary, case: &Case) -> bool {
    let young = case.bodies.iter().flat_map(|body| &body.parts).map(|part| part.material.young).fold(f64::INFINITY, f64::min);
    let moved = summary.displacement_max.zip(summary.energy.total);
    moved.is_none_or(|(moved, energy)| energy > NOT_STRAINED * young * moved * moved)
}
