//! A solution against the exact or reference values of its case, and what a case expects beside what was found, as the report
//! shows it.

use crate::case::{BodyExact, Case, ContactExact, Expected, ExpectedAt, LambdaExact};
use crate::geometry::Point;
use crate::mesh::Region;
use crate::output::plot::number_to;
use crate::output::report::ExpectedValue;
use crate::output::{RunError, Summary};
use crate::recovery::Evaluation;
use crate::run::outcome::outside;
use crate::run::reading::checks::has_values;
use std::collections::BTreeMap;

/// Relative errors by name, and words for each that misses its tolerance.
#[derive(Default)]
pub struct Errors {
    /// As the summary names them.
    pub values: BTreeMap<String, Option<f64>>,
    /// Values outside their tolerance.
    pub missed: Vec<String>,
}

impl Errors {
    fn add(&mut self, name: String, error: f64, tolerance: Option<f64>) {
        if let Some(tolerance) = tolerance.filter(|&tolerance| error.is_nan() || error > tolerance) {
            self.missed.push(format!("{name}: relative error {error:.2e}, tolerance {tolerance:.0e}"));
        } else if !error.is_finite() {
            self.missed
                .push(format!("{name}: the error is no number; what is expected is zero all over, or has no value somewhere"));
        }
        self.values.insert(name, Some(error));
    }

    /// What cannot be compared.
    fn unknown(&mut self, name: String, words: &str) {
        self.missed.push(format!("{name}: {words}"));
        self.values.insert(name, None);
    }
}

/// Compares everything that `[exact]` lists. **Collective**
///
/// # Errors
/// [`RunError`] from PETSc or an inverted triangle.
pub fn compare(case: &Case, found: &Evaluation) -> Result<Errors, RunError> {
    let Evaluation { problem, balance, .. } = found;
    let mut errors = Errors::default();
    if let Some(energy) = &case.exact.energy {
        let found = balance.stationary.unwrap_or_else(|| balance.strain.iter().sum());
        errors.add("energy".into(), (found / energy.value - 1.0).abs(), Some(energy.tolerance));
    }
    for exact in &case.exact.contacts {
        let at = problem.contacts.iter().position(|contact| contact.pair.name == exact.name).expect("checked names");
        let pressure = found.pressure(at);
        if let Some(force) = &exact.force {
            let found = balance.contacts[at].force;
            errors.add(format!("force_{}", exact.name), (found / force.value - 1.0).abs(), Some(force.tolerance));
        }
        let (error, tolerance) = match &exact.lambda {
            None => continue,
            Some(LambdaExact::Formula { formula, tolerance }) => {
                if let Err(words) = has_values(formula, &problem.contacts[at].boundary) {
                    errors.unknown(format!("lambda_{}", exact.name), &words);
                    continue;
                }
                (pressure.error(formula), *tolerance)
            }
            Some(LambdaExact::Points(ExpectedAt { at, value, tolerance })) => {
                let one = |(x, value): (&[f64; 2], &f64)| (pressure.at_foot(Point::new(x[0], x[1])) / value - 1.0).abs();
                (at.iter().zip(value).map(one).fold(0.0, larger), *tolerance)
            }
        };
        errors.add(format!("lambda_{}", exact.name), error, Some(tolerance));
    }
    compare_bodies(case, found, &mut errors)?;
    Ok(errors)
}

fn compare_bodies(case: &Case, found: &Evaluation, errors: &mut Errors) -> Result<(), RunError> {
    for exact in &case.exact.bodies {
        let region = found.problem.scene.mesh.region(&exact.name).expect("checked names");
        let size = found.moved;
        if let Some(displacement) = &exact.displacement {
            let mut worst: f64 = 0.0;
            for (x, value) in displacement.at.iter().zip(&displacement.value) {
                let probed = found.probe(region, Point::new(x[0], x[1]))?.ok_or_else(|| outside(*x))?;
                let off = (probed.displacement - Point::new(value[0], value[1])).norm();
                // Where nothing moves a displacement of zero is right.
                worst = larger(worst, if off == 0.0 { 0.0 } else { off / size });
            }
            errors.add(format!("displacement_{}", exact.name), worst, Some(displacement.tolerance));
        }
        if let Some(stress) = &exact.stress {
            let [difference, whole] = found.energy_error(region, stress)?;
            errors.add(format!("energy_norm_{}", exact.name), (difference / whole).sqrt(), None);
        }
        if let Some(formulas) = &exact.u {
            match displacement_error(found, region, formulas) {
                Ok(error) => errors.add(format!("u_{}", exact.name), error, None),
                Err(words) => errors.unknown(format!("u_{}", exact.name), &words),
            }
        }
    }
    Ok(())
}

/// The larger of two numbers; none if one of them is none.
fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) }
}

/// Root mean square error of the nodal displacements of a body or a part of one, relative to their root mean square. **Collective**
///
/// # Errors
/// Words on a node where a formula has no value, the same on every rank.
fn displacement_error(
    Evaluation { problem, u, session, .. }: &Evaluation,
    region: Region,
    exact: &[crate::geometry::Formula; 2],
) -> Result<f64, String> {
    let (mesh, numbering) = (&problem.scene.mesh, &problem.finest().numbering);
    let (mut sums, mut outcome) = ([0.0; 2], Ok(()));
    let own = problem.scene.partition.triangles_of(session.rank()).iter().map(|&triangle| triangle as usize);
    let own = own.filter(|&triangle| region.holds(&mesh.triangles[triangle]));
    for (triangle, at, node) in numbering.nodes_of(mesh, own) {
        let x = mesh.node_position(triangle, numbering.level, at);
        let wanted = Point::new(exact[0].value(&[x.x, x.y]), exact[1].value(&[x.x, x.y]));
        if outcome.is_ok() && !wanted.iter().all(|component| component.is_finite()) {
            outcome = exact.iter().try_for_each(|formula| formula.finite_value(x).map(|_| ()));
        }
        sums[0] += (u.point(node) - wanted).norm_squared();
        sums[1] += wanted.norm_squared();
    }
    session.agree(outcome)?;
    session.sum(&mut sums);
    Ok((sums[0] / sums[1]).sqrt())
}

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
        let value = |what: &str, key: &str, expected: String, tolerance: Option<f64>| {
            words(format!("{what} of {name}"), format!("{key}_{name}"), expected, tolerance)
        };
        let at_places = |all: &ExpectedAt<_>| value("displacement", "displacement", places(all.at.len()), Some(all.tolerance));
        all.extend(displacement.iter().map(at_places));
        all.extend(stress.iter().map(|_| value("stress", "energy_norm", "stress by formulas".into(), None)));
        all.extend(u.iter().map(|_| value("displacement", "u", "displacement by formulas".into(), None)));
    }
    all
}

fn points(count: usize, values: &[f64]) -> String {
    match values {
        [value] => format!("{} at a point", number_to(DIGITS, *value)),
        _ => places(count),
    }
}

fn places(count: usize) -> String {
    if count == 1 { "at a point".into() } else { format!("at {count} points") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_error_that_is_no_number_or_above_its_tolerance_misses_it() {
        let mut errors = Errors::default();
        for (name, error, tolerance) in [
            ("none", 0.5, None),
            ("below", 0.009, Some(0.01)),
            ("at", 0.01, Some(0.01)),
            ("above", 0.011, Some(0.01)),
            ("nan", f64::NAN, Some(0.01)),
            ("nothing", f64::INFINITY, None),
        ] {
            errors.add(name.into(), error, tolerance);
        }
        assert_eq!(errors.values.len(), 6);
        assert!(larger(0.0, f64::NAN).is_nan() && larger(f64::NAN, 1.0).is_nan() && larger(1.0, 2.0) == 2.0);
        let names: Vec<&str> = errors.missed.iter().filter_map(|words| words.split(':').next()).collect();
        assert_eq!(names, ["above", "nan", "nothing"]);
    }
}
