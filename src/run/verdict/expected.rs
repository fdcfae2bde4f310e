//! What a case expects beside what was found, as the report shows it.

use crate::case::{BodyExact, Case, ContactExact, Expected, LambdaExact};
use crate::output::Summary;
use crate::output::plot::number_to;
use crate::output::report::ExpectedValue;

/// Digits of what is expected and of what was found.
const DIGITS: i32 = 7;

/// All expected values of a case; of load steps those of the last one.
pub fn expected_values(case: &Case, summary: &Summary) -> Vec<ExpectedValue> {
    let exact = case.steps.last().map_or(&case.exact, |last| &last.case.exact);
    let told = Told { summary, thickness: case.thickness };
    let found = summary.energy.stationary.or(summary.energy.total);
    let energy = exact.energy.as_ref().map(|expected| told.number("strain energy".into(), expected, found, "energy".into()));
    let contacts = exact.contacts.iter().flat_map(|contact| told.contact(contact));
    energy.into_iter().chain(contacts).chain(exact.bodies.iter().flat_map(|body| told.body(body))).collect()
}

/// A summary that tells what was found and the errors.
struct Told<'a> {
    summary: &'a Summary,
    thickness: f64,
}

impl Told<'_> {
    /// A value without a number to be found; `key` is that of its error in the summary.
    fn words(&self, name: String, expected: String, tolerance: Option<f64>, key: String) -> ExpectedValue {
        let error = self.summary.errors.get(&key).copied().flatten();
        ExpectedValue { name, expected, found: String::new(), error, tolerance }
    }

    /// A force or an energy.
    fn number(&self, name: String, expected: &Expected, found: Option<f64>, key: String) -> ExpectedValue {
        let words = number_to(DIGITS, expected.value * self.thickness);
        let found = found.map_or(String::new(), |found| number_to(DIGITS, found));
        ExpectedValue { found, ..self.words(name, words, Some(expected.tolerance), key) }
    }

    fn contact(&self, ContactExact { name, force, lambda }: &ContactExact) -> Vec<ExpectedValue> {
        let force = force.as_ref().map(|expected| {
            let found = self.summary.contact.get(name).and_then(|contact| contact.force);
            self.number(format!("force of {name}"), expected, found, format!("force_{name}"))
        });
        let lambda = lambda.as_ref().map(|lambda| {
            let (expected, tolerance) = match lambda {
                LambdaExact::Points { at, value, tolerance } => (points(at.len(), value), *tolerance),
                LambdaExact::Formula { formula, tolerance } => (formula.text().to_owned(), *tolerance),
            };
            self.words(format!("pressure of {name}"), expected, Some(tolerance), format!("lambda_{name}"))
        });
        force.into_iter().chain(lambda).collect()
    }

    fn body(&self, BodyExact { name, displacement, stress, u }: &BodyExact) -> Vec<ExpectedValue> {
        let displacement = displacement.as_ref().map(|expected| {
            let words = format!("at {}", count(expected.at.len()));
            self.words(format!("displacement of {name}"), words, Some(expected.tolerance), format!("displacement_{name}"))
        });
        let stress = stress
            .as_ref()
            .map(|_| self.words(format!("stress of {name}"), "stress by formulas".into(), None, format!("energy_norm_{name}")));
        let u = u
            .as_ref()
            .map(|_| self.words(format!("displacement of {name}"), "displacement by formulas".into(), None, format!("u_{name}")));
        displacement.into_iter().chain(stress).chain(u).collect()
    }
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
