//! Discretisation errors, estimated from the solutions on successive refinements.
//!
//! On nested meshes Galerkin's orthogonality gives `e_(l-1)² = e_l² + D_l²` for the errors `e_l = |u - u_l|` and the
//! difference `D_l = |u_l - u_(l-1)|` in the energy norm. If errors fall by the factor `√q` with each refinement, `q = (D_l/D_(l-1))²` and
//! `e_l² = D_l² q/(1 - q)`: no order has to be known, so that corners are seen.

use crate::geometry::{Point, gauss_points};
use crate::petsc::Session;
use crate::system::recovery::strain_energy;
use crate::system::{CoarseSolution, Contact, Discretisation, Field, Solution, SystemError};

/// Share of the length in contact that counts as its middle.
const MIDDLE: f64 = 0.6;

/// Factors by which squares of errors fall, at least and at most: outside of these the meshes are too coarse to tell.
const FACTORS: [f64; 2] = [1.0 / 80.0, 0.75];

/// How a solution differs from that on the mesh before.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// Square of the relative energy norm.
    energy: f64,
    /// Relative difference of `∫λ ds`, for each contact; signs cancel, so that errors themselves add up.
    force: Vec<f64>,
    /// Square of the relative L2 difference of λ in the middle of each contact.
    pressure: Vec<f64>,
}

/// Estimated relative errors; nothing where there is not enough to tell.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Estimate {
    /// In the energy norm.
    pub energy: Option<f64>,
    /// Of `∫λ ds`, for each contact.
    pub force: Vec<Option<f64>>,
    /// Of λ in the middle of each contact, root mean square.
    pub pressure: Vec<Option<f64>>,
}

impl Difference {
    /// Compares a solution with the one before. **Collective**
    pub fn new(
        problem: &Discretisation,
        solution: &Solution,
        coarse: &CoarseSolution,
        session: &Session,
    ) -> Result<Self, SystemError> {
        let mut apart = coarse.displacement(problem, session.rank());
        apart.iter_mut().zip(&solution.displacement).for_each(|(before, now)| *before = now - *before);
        let whole = strain_energy(problem, &Field::displacement(problem, &solution.displacement, session)?, session)?;
        let apart = strain_energy(problem, &Field::displacement(problem, &apart, session)?, session)?;
        let (mut force, mut pressure) = (Vec::new(), Vec::new());
        for (at, (contact, before)) in problem.contacts.iter().zip(coarse.forces()).enumerate() {
            let lambda = &solution.multipliers[contact.range()];
            let now: f64 = lambda.iter().enumerate().map(|(i, value)| value * contact.multipliers.weight(i)).sum();
            force.push(((now - before) / now).abs());
            pressure.push(pressure_difference(contact, lambda, |x| coarse.pressure(at, x)));
        }
        Ok(Self { energy: apart.iter().sum::<f64>() / whole.iter().sum::<f64>(), force, pressure })
    }
}

/// Square of the relative L2 difference between λ and what it was before, in the middle of the part that carries any; not a
/// number where nothing does.
fn pressure_difference(contact: &Contact, lambda: &[f64], before: impl Fn(Point) -> f64) -> f64 {
    let knots = contact.boundary.knots();
    let arcs = contact.boundary.arcs();
    let carries = |k: &usize| contact.multipliers.value(lambda, *k, 0.5) != 0.0;
    let carrying: Vec<usize> = (0..knots.len() - 1).filter(carries).collect();
    let [Some(&first), Some(&last)] = [carrying.first(), carrying.last()] else { return f64::NAN };
    let (start, length) = (arcs[first], arcs[last + 1] - arcs[first]);
    let mut sums = [0.0; 2];
    for k in carrying {
        let middle = ((0.5 * (arcs[k] + arcs[k + 1]) - start) / length - 0.5).abs();
        let ends = [knots[k], knots[k + 1]];
        for (z, weight) in gauss_points(3).iter().filter(|_| middle <= 0.5 * MIDDLE) {
            let here = contact.multipliers.value(lambda, k, *z);
            let there = before(contact.boundary.point(ends[0] + z * (ends[1] - ends[0])));
            sums[0] += weight * (arcs[k + 1] - arcs[k]) * (here - there).powi(2);
            sums[1] += weight * (arcs[k + 1] - arcs[k]) * here * here;
        }
    }
    sums[0] / sums[1]
}

impl Estimate {
    /// From the differences between successive meshes, the coarsest first; three meshes make two.
    pub fn new(differences: &[Difference]) -> Self {
        let [.., before, last] = differences else { return Self::default() };
        let root = |square: Option<f64>| square.map(f64::sqrt);
        let contacts = 0..last.force.len();
        Self {
            energy: root(left(before.energy, last.energy)),
            force: contacts.clone().map(|k| left(before.force[k], last.force[k])).collect(),
            pressure: contacts.map(|k| root(left(before.pressure[k], last.pressure[k]))).collect(),
        }
    }
}

/// What is left of an additive error, from two successive differences of it; nothing if they do not fall, or are none.
fn left(before: f64, last: f64) -> Option<f64> {
    if last > before || last < 0.0 {
        return None;
    }
    let factor = (last / before).clamp(FACTORS[0], FACTORS[1]);
    let rest = last * factor / (1.0 - factor);
    rest.is_finite().then_some(rest)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn difference(square: f64) -> Difference {
        Difference { energy: square, force: vec![square.sqrt()], pressure: vec![square] }
    }

    #[test]
    fn errors_that_fall_by_one_factor_are_found_whatever_it_is() {
        for factor in [0.04, 0.25, 0.6] {
            // Errors 1, q, q² in the square; differences of squares.
            let squares = [1.0, factor, factor * factor];
            let differences = [difference(squares[0] - squares[1]), difference(squares[1] - squares[2])];
            let found = Estimate::new(&differences);
            assert!((found.energy.expect("two differences") / factor - 1.0).abs() < 1e-12);
            assert!((found.pressure[0].expect("two differences") / factor - 1.0).abs() < 1e-12);
        }
        assert_eq!(Estimate::new(&[difference(1.0)]).energy, None);
    }
}
