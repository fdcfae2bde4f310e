//! Errors of the goals of an accuracy, where the case knows the truth: to be held against the estimates.

use crate::accuracy::{Goal, ProbePoint, Quantity};
use crate::case::{BodyExact, Case, ContactExact, LambdaExact};
use crate::discretisation::SystemError;
use crate::geometry::Point;
use crate::mesh::{Region, Surface};
use crate::procedure::Solved;
use crate::recovery::Evaluation;

/// The true relative error of each goal; nothing where `[exact]` does not tell it, or nothing was solved. **Collective**
///
/// # Errors
/// [`SystemError`] from PETSc or an inverted triangle.
pub fn true_errors(case: &Case, goals: &[Goal], solved: &Solved) -> Result<Vec<Option<f64>>, SystemError> {
    if !solved.is_solved() || !goals.iter().any(|goal| is_told(case, &goal.quantity)) {
        return Ok(vec![None; goals.len()]);
    }
    let found = Evaluation::new(&solved.problem, &solved.solution)?;
    goals.iter().map(|goal| Ok(error(case, &goal.quantity, &found)?.filter(|error| error.is_finite()))).collect()
}

/// Whether `[exact]` says anything of a quantity.
fn is_told(case: &Case, quantity: &Quantity) -> bool {
    match quantity {
        Quantity::Energy => case.exact.energy.is_some() || case.exact.bodies.iter().any(|body| body.stress.is_some()),
        Quantity::Force(name) | Quantity::Pressure(name) | Quantity::Peak(name) | Quantity::Ends(name) => {
            of_contact(case, name).is_some()
        }
        Quantity::Displacement(probe) | Quantity::Stress(probe) => of_body(case, &probe.body).is_some(),
    }
}

fn of_contact<'a>(case: &'a Case, name: &str) -> Option<&'a ContactExact> {
    case.exact.contacts.iter().find(|exact| exact.name == name)
}

fn of_body<'a>(case: &'a Case, name: &str) -> Option<&'a BodyExact> {
    case.exact.bodies.iter().find(|exact| exact.name == name)
}

/// Of one goal. **Collective**
fn error(case: &Case, quantity: &Quantity, found: &Evaluation) -> Result<Option<f64>, SystemError> {
    let contact = |name: &str| found.problem.contacts.iter().position(|contact| contact.pair.name == name);
    let formula = |name: &str| match of_contact(case, name).and_then(|exact| exact.lambda.as_ref()) {
        Some(LambdaExact::Formula { formula, .. }) => Some(formula),
        _ => None,
    };
    Ok(match quantity {
        Quantity::Energy => energy_error(case, found)?,
        Quantity::Force(name) => {
            let exact = of_contact(case, name).and_then(|exact| exact.force);
            contact(name).zip(exact).map(|(at, force)| (found.balance.contacts[at].force / force.value - 1.0).abs())
        }
        Quantity::Pressure(name) => {
            contact(name).zip(formula(name)).and_then(|(at, exact)| found.pressure(at).middle_error(exact))
        }
        Quantity::Peak(name) => contact(name).zip(formula(name)).map(|(at, exact)| found.pressure(at).peak_error(exact)),
        // A pressure as a formula does not say where it ends.
        Quantity::Ends(_) => None,
        Quantity::Displacement(probe) => probe_errors(case, found, probe)?[0],
        Quantity::Stress(probe) => probe_errors(case, found, probe)?[1],
    })
}

/// In the energy norm: by the stresses of all bodies, or of all their parts; else by the energy, from which that of an approximation differs by the
/// square of its error where loads alone, or gaps and supports alone, do work. **Collective**
fn energy_error(case: &Case, found: &Evaluation) -> Result<Option<f64>, SystemError> {
    let mesh = &found.problem.scene.mesh;
    let stress = |name: &String| of_body(case, name)?.stress.as_ref();
    let of_part = |(at, part): (usize, &Surface)| Some((Region::Part(at as u32), stress(&part.name)?));
    let of_one = |(at, name): (usize, &String)| {
        let own = mesh.parts.iter().enumerate().filter(|(_, part)| part.body as usize == at);
        stress(name).map(|stress| vec![(Region::Body(at as u32), stress)]).or_else(|| own.map(of_part).collect())
    };
    let stresses: Option<Vec<Vec<_>>> = mesh.bodies.iter().enumerate().map(of_one).collect();
    let Some(stresses) = stresses else {
        let exact = case.exact.energy.zip(found.balance.stationary);
        return Ok(exact.map(|(exact, energy)| (energy / exact.value - 1.0).abs().sqrt()));
    };
    let mut sums = [0.0; 2];
    for (region, stress) in stresses.into_iter().flatten() {
        let parts = found.energy_error(region, stress)?;
        sums.iter_mut().zip(parts).for_each(|(sum, part)| *sum += part);
    }
    Ok(Some((sums[0] / sums[1]).sqrt()))
}

/// Of displacement and stress at a point, by their own size. **Collective**
fn probe_errors(case: &Case, found: &Evaluation, probe: &ProbePoint) -> Result<[Option<f64>; 2], SystemError> {
    let at = found.problem.scene.mesh.region(&probe.body);
    let (Some(exact), Some(at)) = (of_body(case, &probe.body), at) else { return Ok([None; 2]) };
    let x = [probe.point.x, probe.point.y];
    let listed = exact.displacement.as_ref().and_then(|all| all.at.iter().zip(&all.value).find(|(point, _)| **point == x));
    let displacement = exact.u.as_ref().map(|u| u.each_ref().map(|part| part.value(&x))).or(listed.map(|(_, value)| *value));
    let stress = exact.stress.as_ref().map(|stress| stress.each_ref().map(|part| part.value(&x)));
    let Some(probed) = found.probe(at, probe.point)? else { return Ok([None; 2]) };
    let size = |stress: [f64; 4]| case.plane.stress_product(stress, stress).sqrt();
    Ok([
        displacement.map(|[x, y]| (probed.displacement - Point::new(x, y)).norm() / x.hypot(y)),
        stress.map(|exact| size([0, 1, 2, 3].map(|k: usize| probed.stress[k] - exact[k])) / size(exact)),
    ])
}
