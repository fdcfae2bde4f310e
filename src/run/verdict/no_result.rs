//! What makes a solution no result, whatever its residual and its active set say; and whether the forces that a run has found balance
//! each other.

use crate::case::Case;
use crate::output::Summary;
use crate::output::summary::{ContactSummary, listed};
use crate::run::verdict::limits::{BODY_BALANCE, Doubt, NOT_STRAINED, OUT_OF_BALANCE, PASSED_THROUGH, SIDE_BALANCE};
use crate::run::words::short;

/// Why values that are no numbers are no result.
pub const NO_NUMBERS: &str =
    "the solution goes beyond the numbers of a computer: correct the units of E, loads, displacements and coordinates";

/// Why a run has not converged though its solve has ended well; nothing if it may stand.
pub fn no_result(summary: &Summary, case: &Case) -> Option<String> {
    let unequal = || unequal_sides(summary);
    no_number(summary).or_else(|| not_in_balance(summary, case)).or_else(unequal).or_else(|| passed_through(summary))
}

/// Values that are no numbers.
fn no_number(summary: &Summary) -> Option<String> {
    let values = [summary.energy.total, summary.displacement_max];
    values.into_iter().flatten().any(|value| !value.is_finite()).then(|| NO_NUMBERS.into())
}

/// A body whose forces are far from balance.
fn not_in_balance(summary: &Summary, case: &Case) -> Option<String> {
    let off = out_of_balance(summary, case).filter(|off| *off > OUT_OF_BALANCE)?;
    Some(format!(
        "the forces on a body are out of balance by {} of their sum: a contact beside a mean motion that is held leaves the body free to move; hold it by a support, or leave out what contact holds already",
        short(off)
    ))
}

/// A contact whose forces on its two bodies are far from each other: one of them is not where its boundary is.
fn unequal_sides(summary: &Summary) -> Option<String> {
    let off = summary.balance.force.filter(|off| *off > OUT_OF_BALANCE)?;
    Some(format!(
        "the forces of a contact on its two bodies differ by {} of each other: the bodies do not face each other all along its boundary; give what does a name and a contact of its own",
        short(off)
    ))
}

/// Bodies that pass through each other where nothing presses, since no segment saw them meet.
fn passed_through(summary: &Summary) -> Option<String> {
    let is_passed = |contact: &ContactSummary| {
        // Bodies that just touch overlap by nothing but rounding, which is worth no force.
        let is_worth = contact.unresolved_force.is_some_and(|force| force > 0.0);
        let is_idle = contact.force == Some(0.0) && contact.closed.as_ref().is_some_and(Vec::is_empty);
        is_idle && is_worth && contact.missing.is_some_and(|missing| missing > PASSED_THROUGH)
    };
    let passed = summary.named(is_passed);
    (!passed.is_empty()).then(|| {
        let names = listed(&passed);
        format!("on contact {names} nothing presses, though the bodies overlap: its segments are too few or too long to see it")
    })
}

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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::summary::SupportSummary;
    use crate::run::verdict::trust::samples::case;

    #[test]
    fn values_that_are_no_numbers_are_no_result() {
        let told = |value| no_number(&Summary { displacement_max: Some(value), ..Summary::default() });
        assert_eq!(told(1e300), None);
        assert!([f64::INFINITY, f64::NAN].into_iter().all(|value| told(value).is_some_and(|words| words.contains("units"))));
    }

    #[test]
    fn bodies_far_out_of_balance_are_no_result_unless_nothing_is_strained() {
        let told = |bodies, energy| {
            let mut summary = Summary { displacement_max: Some(0.1), ..Summary::default() };
            summary.balance.bodies = Some(bodies);
            summary.support.insert("held".into(), SupportSummary { moment: Some(0.0), ..Default::default() });
            summary.energy.total = Some(energy);
            not_in_balance(&summary, &case(&[]))
        };
        assert_eq!((told(0.03, 1.0), told(0.5, 1e-20)), (None, None));
        assert!(told(0.5, 1.0).is_some_and(|words| words.contains("out of balance by 0.50")));
    }

    #[test]
    fn a_contact_that_presses_one_body_more_is_no_result() {
        let mut summary = Summary::default();
        summary.balance.force = Some(0.03);
        assert_eq!(no_result(&summary, &case(&[])), None);
        summary.balance.force = Some(0.43);
        assert!(no_result(&summary, &case(&[])).is_some_and(|words| words.contains("differ by 0.43")));
    }

    #[test]
    fn bodies_that_pass_through_each_other_are_no_result() {
        let words = |closed: Option<Vec<[f64; 2]>>, missing| {
            let (force, unresolved_force) = (Some(0.0), Some(0.1));
            let contact = ContactSummary { closed, missing, force, unresolved_force, ..ContactSummary::default() };
            passed_through(&Summary { contact: [("seam".to_string(), contact)].into(), ..Summary::default() })
        };
        assert!(words(Some(vec![]), Some(0.9)).is_some_and(|words| words.starts_with("on contact seam nothing presses")));
        assert_eq!(words(Some(vec![]), Some(1e-3)), None, "an overlap that the mesh explains");
        assert_eq!(words(Some(vec![]), None), None, "bodies apart");
        assert_eq!(words(Some(vec![[0.0, 0.1]]), Some(0.9)), None, "doubted, but something presses");
    }
}
