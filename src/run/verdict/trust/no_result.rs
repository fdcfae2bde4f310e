//! What makes a solution no result.

use super::balance::out_of_balance;
use crate::case::Case;
use crate::output::Summary;
use crate::output::summary::{ContactSummary, listed};
use crate::run::report::short;

/// Why values that are no numbers are no result.
pub const NO_NUMBERS: &str =
    "the solution goes beyond the numbers of a computer: correct the units of E, loads, displacements and coordinates";

/// Sum of all forces on a body, as a share of their magnitudes, beyond which there is no result.
const MOST_OUT_OF_BALANCE: f64 = 0.1;

/// Overlap of bodies between which nothing presses, relative to the displacements, that is no result any more.
const MOST_PASSED: f64 = 0.05;

/// What makes a run one that has not converged, whatever its residual and its active set say; nothing if it may stand.
pub fn no_result(summary: &Summary, case: &Case) -> Option<String> {
    no_number(summary).or_else(|| not_in_balance(summary, case)).or_else(|| passed_through(summary))
}

/// What makes a run one that has not converged, whatever its residual says: values that are no numbers.
pub fn no_number(summary: &Summary) -> Option<String> {
    let values = [summary.energy.total, summary.displacement_max];
    values.into_iter().flatten().any(|value| !value.is_finite()).then(|| NO_NUMBERS.into())
}

/// What makes a run one that has not converged, whatever its residual says: a body whose forces are far from balance.
pub fn not_in_balance(summary: &Summary, case: &Case) -> Option<String> {
    let off = out_of_balance(summary, case).filter(|off| *off > MOST_OUT_OF_BALANCE)?;
    Some(format!(
        "the forces on a body are out of balance by {} of their sum: a contact beside a mean motion that is held leaves the body free to move; hold it by a support, or leave out what contact holds already",
        short(off)
    ))
}

/// What makes a run one that has not converged, whatever its active set says: bodies that pass through each other where nothing
/// presses, since no segment saw them meet.
pub fn passed_through(summary: &Summary) -> Option<String> {
    let is_passed = |contact: &ContactSummary| {
        // Bodies that just touch overlap by nothing but rounding, which is worth no force.
        let is_worth = contact.unresolved_force.is_some_and(|force| force > 0.0);
        let is_idle = contact.force == Some(0.0) && contact.closed.as_ref().is_some_and(Vec::is_empty);
        is_idle && is_worth && contact.missing.is_some_and(|missing| missing > MOST_PASSED)
    };
    let passed = summary.named(is_passed);
    (!passed.is_empty()).then(|| {
        let names = listed(&passed);
        format!("on contact {names} nothing presses, though the bodies overlap: its segments are too few or too long to see it")
    })
}
