//! Whether the forces that a run has found balance each other.

use super::doubt::Doubt;
use crate::case::Case;
use crate::output::Summary;
use crate::run::report::short;

/// Largest sum of all forces on a body, as a share of their magnitudes, beside which a force is trusted.
const MOST_UNBALANCED_BODY: f64 = 0.01;

/// Largest difference of the forces on both bodies, relative: the pressure is off by as much at least.
const MOST_UNBALANCED: f64 = 0.01;

/// Strain energy, by that of the softest body strained by the largest displacement over its length, below which bodies have moved
/// and not strained.
const NOT_STRAINED: f64 = 1e-12;

/// What tells that forces are out of balance: those on a body, or those of a contact on its two bodies.
pub fn balance_doubts(summary: &Summary, case: &Case) -> Vec<Doubt> {
    let body = out_of_balance(summary, case).filter(|off| *off > MOST_UNBALANCED_BODY).map(|off| Doubt {
        cause: "the forces on a body are out of balance",
        figure: format!("the forces on a body are out of balance by {}, at most {MOST_UNBALANCED_BODY} wanted", short(off)),
        remedy: "take a smaller solver.tolerance, or correct what holds the bodies",
    });
    let sides = summary.balance.force.filter(|_| !is_balanced(summary)).map(|off| Doubt {
        cause: "forces on the two bodies differ",
        figure: format!("forces on the two bodies differ by {}, at most {MOST_UNBALANCED} wanted", short(off)),
        remedy: "see lost_points: the bodies must face each other all along the boundary",
    });
    body.into_iter().chain(sides).collect()
}

/// Whether all forces balance as far as a force that is to be trusted asks for.
pub fn is_in_balance(summary: &Summary, case: &Case) -> bool {
    is_balanced(summary) && out_of_balance(summary, case).is_none_or(|off| off <= MOST_UNBALANCED_BODY)
}

fn is_balanced(summary: &Summary) -> bool {
    summary.balance.force.is_none_or(|off| off <= MOST_UNBALANCED)
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
