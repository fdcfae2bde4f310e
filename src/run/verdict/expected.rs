//! What a case expects beside what was found, as the report shows it.

use crate::case::{BodyExact, Case, ContactExact, Expected, ExpectedAt, LambdaExact};
use crate::output::Summary;
use crate::output::plot::number_to;
use crate::output::report::ExpectedValue;

/// Digits of what is expected and of what was found.
const DIGITS: i32 = 7;

/// All expected values of a case; of load steps those of the last one.
pub fn expected_values(case: &Case, summary: &Summary) -> Vec<ExpectedValue> {
    let exact = case.steps.last().map_or(&case.exact, |last| &last.case.exact);
    // Errors have keys of their own in the summary.
    let words = |name: String, key: String, expected: String, tolerance: Option<f64>| {
        let error = summary.errors.get(&key).copied().flatten();
        ExpectedValue { name, expected, found: String::new(), error, tolerance }
    };
    let number = |name: String, key: String, expected: &Expected, found: Option<f64>| {
        let value = number_to(DIGITS, expected.value * case.thickness);
        let found = found.map_or(String::new(), |found| number_to(DIGITS, found));
        ExpectedValue { found, ..words(name, key, value, Some(expected.tolerance)) }
    };
    let energy = summary.energy.stationary.or(summary.energy.total);
    let of_energy = |expected: &Expected| number("strain energy".into(), "energy".into(), expected, energy);
    let mut all: Vec<ExpectedValue> = exact.energy.iter().map(of_energy).collect();
    for ContactExact { name, force, lambda } in &exact.contacts {
        let found = summary.contact.get(name).and_then(|contact| contact.force);
        all.extend(force.iter().map(|expected| number(format!("force of {name}"), format!("force_{name}"), expected, found)));
        all.extend(lambda.iter().map(|lambda| {
            let (expected, tolerance) = match lambda {
                LambdaExact::Points(ExpectedAt { at, value, tolerance }) => (points(at.len(), value), *tolerance),
                LambdaExact::Formula { formula, tolerance } => (formula.text().to_owned(), *tolerance),
            };
            words(format!("pressure of {name}"), format!("lambda_{name}"), expected, Some(tolerance))
        }));
    }
    for BodyExact { name, displacement, stress, u } in &exact.bodies {
        let [displaced, stressed] = ["displacement", "stress"].map(|what| format!("{what} of {name}"));
        all.extend(displacement.iter().map(|expected| {
            let places = format!("at {}", count(expected.at.len()));
            words(displaced.clone(), format!("displacement_{name}"), places, Some(expected.tolerance))
        }));
        all.extend(
            stress.iter().map(|_| words(stressed.clone(), format!("energy_norm_{name}"), "stress by formulas".into(), None)),
        );
        all.extend(u.iter().map(|_| words(displaced.clone(), format!("u_{name}"), "displacement by formulas".into(), None)));
    }
    all
}

fn points(places: usize, values: &[f64]) -> String {
    match values {
        [value] => format!("{} at a point", number_to(DIGITS, *value)),
        _ => format!("at {}", count(places)),
    }
}

fn count(points: usize) -> String {
    if points == 1 { "a point".into() } else { format!("{points} points") }
}
