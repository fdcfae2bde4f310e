//! Energies, reactions, and the balances of forces, moments and energy.

use super::contact_forces::{ContactForce, contact_forces};
use super::node_sums::{ForceSum, NodeSums};
use crate::body::Motion;
use crate::discretisation::{
    Contact, Discretisation, Field, Solution, SpringForces, SystemError, internal_forces, rigid_motions,
};
use crate::element::Plane;
use crate::geometry::{Point, cross};
use crate::recovery::heat::heat_energies;

/// Forces on a body below this share of those on another are what a solve leaves: nothing acts on it.
const UNLOADED: f64 = 1e-6;

/// Work below this share of the largest is none: gaps measured where bodies touch are rounding.
const ROUNDING: f64 = 1e-12;

/// Energies and balances of a solution.
#[derive(Clone, Debug, PartialEq)]
pub struct Balance {
    /// Strain energy of each body, `½∫σ:ε`.
    pub strain: Vec<f64>,
    /// The same of each part of the bodies, in the order of the mesh.
    pub strain_of_parts: Vec<f64>,
    /// Strain energy in all, from the stationary value of the Lagrangian: its algebraic error is the square of that of `u` and
    /// `λ`. Nothing where loads act together with gaps or prescribed displacements, a jump term is added, or springs act.
    pub stationary: Option<f64>,
    /// `f·u + r·u_D`.
    pub external_work: f64,
    /// Resultants of each contact.
    pub contacts: Vec<ContactForce>,
    /// Energy in elastic supports, `½∫k u²`; nothing if there are none.
    pub springs: Option<f64>,
    /// Force of each support on the bodies (per thickness), those of elastic ones and then those of mean motions after the others.
    pub reactions: Vec<Point>,
    /// For each body `Σ u × r` over the reactions of curved guides: these do not go with the body (per thickness).
    pub guided: Vec<f64>,
    /// Moment of each hold of a mean motion about the middle of its body (per thickness).
    pub mean_moments: Vec<f64>,
    /// Force of each rigid set on the bodies, and its moment about the reference point (per thickness).
    pub rigid: Vec<[f64; 3]>,
    /// Motion of each rigid set.
    pub motions: Vec<Motion>,
    /// Sum of the magnitudes of all forces on bodies: loads and reactions of their nodes, contact (per thickness).
    pub forces: f64,
    /// Largest `|F₁ + F₂| / |F₂|`; along a curve, where `F₂` may vanish, by `∫λ ds` if that is larger.
    pub force: Option<f64>,
    /// Largest `|M₁ + M₂|` by the same force and the length of Γ_C, about the middle of Γ_C; nothing in bodies of revolution, which cannot turn.
    pub moment: Option<f64>,
    /// `|2U + 2S - (f·u + r·u_D - λᵀc - λᵀCλ)|`, `S` being the energy in springs, over the largest of the terms.
    pub energy: Option<f64>,
    /// Largest `|loads + reactions + contact|` of a body over the sum of magnitudes of these.
    pub bodies: Option<f64>,
}

/// Integrates energies and reactions of a solution. **Collective**
///
/// # Errors
/// [`SystemError`] from PETSc or an inverted triangle.
pub fn balance(problem: &Discretisation, solution: &Solution, u: &Field<2>) -> Result<Balance, SystemError> {
    let Discretisation { contacts, coupling, .. } = problem;
    let (mut strain_of_parts, internal) = internal_forces(problem, u)?;
    problem.session.sum(&mut strain_of_parts);
    let heat = heat_energies(problem, u)?;
    strain_of_parts.iter_mut().zip(&heat).for_each(|(strain, heat)| *strain += heat.kept - heat.work);
    // By how much the work of loads and supports exceeds that of stresses on elastic strains.
    let grown: f64 = heat.iter().map(|heat| heat.work - 2.0 * heat.kept).sum();
    let mut strain = vec![0.0; problem.scene.bodies.len()];
    let of_parts = problem.scene.mesh.parts.iter().zip(&strain_of_parts);
    of_parts.for_each(|(part, energy)| strain[part.body as usize] += energy);
    let springs = SpringForces::new(problem, u);
    let NodeSums { work, bodies, mut reactions, rigid, guided } =
        NodeSums::new(problem, solution, u, [&internal, &springs.nodes])?;
    reactions.extend(springs.reactions);
    reactions.extend(problem.mean_forces.iter().map(|&[x, y, _]| Point::new(x, y)));
    let plane = problem.scene.mesh.plane;
    let reactions = reactions.into_iter().map(|force| plane.resultant(force)).collect();
    let rigid = rigid.into_iter().map(|force| plane.resultant_with_moment(force)).collect();
    let has_springs = !problem.scene.springs.is_empty();
    let forces = contact_forces(problem, solution);
    let lambda_gap: f64 = solution.multipliers.iter().zip(&coupling.gap).map(|(lambda, gap)| lambda * gap).sum();
    let gaps: f64 = solution.multipliers.iter().zip(&coupling.gap).map(|(lambda, gap)| (lambda * gap).abs()).sum();
    let jumped: f64 = problem
        .jumps()
        .map(|jump| jump.weight * (solution.multipliers[jump.rows[0]] - solution.multipliers[jump.rows[1]]).powi(2))
        .sum();
    let pushed: f64 = heat.iter().map(|heat| heat.work).sum();
    let (total, external) = (strain.iter().sum::<f64>(), work.loads + work.supports - pushed);
    let largest =
        [2.0 * (total + springs.energy), work.loads, work.supports, lambda_gap].into_iter().map(f64::abs).fold(0.0, f64::max);
    let worst = |ratio: &dyn Fn(&Contact, &ContactForce) -> f64| {
        contacts.iter().zip(&forces).map(|(contact, force)| ratio(contact, force)).filter(|v| v.is_finite()).reduce(f64::max)
    };
    Ok(Balance {
        external_work: external,
        force: worst(&|contact, force| (force.resultants[0] + force.resultants[1]).norm() / force.size(contact)),
        moment: worst(&|contact, force| unbalanced_moment(plane, contact, force)),
        energy: (largest > 0.0)
            .then(|| (2.0 * (total + springs.energy) - (external - lambda_gap - jumped - grown)).abs() / largest),
        springs: has_springs.then_some(springs.energy),
        stationary: if has_springs || problem.scene.is_heated() || jumped > ROUNDING * largest {
            None
        } else {
            work.stationary(total, lambda_gap, gaps > ROUNDING * largest)
        },
        bodies: body_balance(plane, contacts, &forces, &bodies),
        guided,
        strain,
        strain_of_parts,
        reactions,
        mean_moments: problem.mean_forces.iter().map(|&[_, _, moment]| moment).collect(),
        rigid,
        motions: rigid_motions(problem, &solution.displacement),
        forces: magnitudes(contacts, &forces, &bodies),
        contacts: forces,
    })
}

/// `|M₁ + M₂| / (|F₂| length)` of a contact, about the middle of Γ_C; no number in a body of revolution, which cannot turn.
fn unbalanced_moment(plane: Plane, contact: &Contact, force: &ContactForce) -> f64 {
    if plane == Plane::Revolution {
        return f64::NAN;
    }
    let length = contact.boundary.length();
    let middle = contact.boundary.point(contact.boundary.parameter_at(0.5 * length));
    let sum = force.moments[0] + force.moments[1] - cross(middle, force.resultants[0] + force.resultants[1]);
    sum.abs() / (force.size(contact) * length)
}

/// Sum of the magnitudes of the forces on all bodies.
fn magnitudes(contacts: &[Contact], forces: &[ContactForce], outer: &[ForceSum]) -> f64 {
    let pressed: f64 = contacts.iter().zip(forces).map(|(contact, force)| 2.0 * force.size(contact)).sum();
    pressed + outer.iter().map(|sum| sum.magnitudes).sum::<f64>()
}

/// Largest sum of loads, reactions and contact forces on a body, along the axis alone in a body of revolution, over the sum of
/// their magnitudes.
fn body_balance(plane: Plane, contacts: &[Contact], forces: &[ContactForce], outer: &[ForceSum]) -> Option<f64> {
    let sum = |(body, &outer): (usize, &ForceSum)| {
        let mut all = outer;
        for (contact, force) in contacts.iter().zip(forces) {
            for k in (0..2).filter(|&k| contact.bodies[k] == body) {
                all.add(force.resultants[k]);
                all.magnitudes += force.size(contact) - force.resultants[1].norm();
            }
        }
        (plane.resultant(all.force).norm(), all.magnitudes)
    };
    let all: Vec<(f64, f64)> = outer.iter().enumerate().map(sum).collect();
    let largest = all.iter().map(|(_, magnitudes)| *magnitudes).fold(0.0, f64::max);
    let acts = |&(_, magnitudes): &(f64, f64)| magnitudes > UNLOADED * largest;
    all.into_iter().filter(acts).map(|(sum, magnitudes)| sum / magnitudes).filter(|v| v.is_finite()).reduce(f64::max)
}
