//! What a case expects beside what was found, as the report shows it.

use crate::case::{Case, Exact, Expected, LambdaExact};
use crate::output::Summary;
use crate::output::plot::number_to;
use crate::output::report::ExpectedValue;

/// Digits of what is expected and of what was found.
const DIGITS: i32 = 7;

/// All expected values of a case.
pub fn expected_values(case: &Case, summary: &Summary) -> Vec<ExpectedValue> {
    let of_last = case.steps.last().map_or(&case.exact, |last| &last.case.exact);
    let Exact { energy, contacts, bodies, .. } = of_last;
    let error = |key: String| summary.errors.get(&key).copied().flatten();
    let number = |expected: &Expected| number_to(DIGITS, expected.value * case.thickness);
    let text = |found: Option<f64>| found.map_or(String::new(), |found| number_to(DIGITS, found));
    let mut all = Vec::new();
    if let Some(expected) = energy {
        all.push(ExpectedValue {
            name: "strain energy".into(),
            expected: number(expected),
            found: text(summary.energy.stationary.or(summary.energy.total)),
            error: error("energy".into()),
            tolerance: Some(expected.tolerance),
        });
    }
    for contact in contacts {
        if let Some(expected) = &contact.force {
            all.push(ExpectedValue {
                name: format!("force of {}", contact.name),
                expected: number(expected),
                found: text(summary.contact.get(&contact.name).and_then(|contact| contact.force)),
                error: error(format!("force_{}", contact.name)),
                tolerance: Some(expected.tolerance),
            });
        }
        if let Some(lambda) = &contact.lambda {
            let (expected, tolerance) = match lambda {
                LambdaExact::Points { at, value, tolerance } => (points(at.len(), value), *tolerance),
                LambdaExact::Formula { formula, tolerance } => (formula.text().to_owned(), *tolerance),
            };
            all.push(ExpectedValue {
                name: format!("pressure of {}", contact.name),
                expected,
                found: String::new(),
                error: error(format!("lambda_{}", contact.name)),
                tolerance: Some(tolerance),
            });
        }
    }
    for body in bodies {
        let known = [
            (
                "displacement",
                body.displacement.as_ref().map(|expected| (format!("at {}", count(expected.at.len())), Some(expected.tolerance))),
            ),
            ("energy_norm", body.stress.as_ref().map(|_| ("stress by formulas".into(), None))),
            ("u", body.u.as_ref().map(|_| ("displacement by formulas".into(), None))),
        ];
        for (key, known) in known {
            if let Some((expected, tolerance)) = known {
                let name = if key == "energy_norm" { "stress" } else { "displacement" };
                all.push(ExpectedValue {
                    name: format!("{name} of {}", body.name),
                    expected,
                    found: String::new(),
                    error: error(format!("{key}_{}", body.name)),
                    tolerance,
                });
            }
        }
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
