//! The discrete inf-sup constant of a contact.
//!
//! It has no dimension, and is right for floating bodies, too. With an inexact inverse of `K_γ` the figure would be that of the
//! preconditioner; hence the factor, and hence the limit to few unknowns.

use super::options::{FACTOR, FIELD_SPLIT, Options, redundant_factor};
use crate::discretisation::{Contact, SystemError};
use crate::petsc::{Krylov, options};
use crate::system::saddle_point::SaddlePoint;

/// Accuracy and length of the solve that shows the constant.
const TOLERANCE: f64 = 1e-6;
const MOST_ITERATIONS: usize = 60;

/// Above this eigenvalue the constant is so large that the figure would be rounding.
const MOST_EIGENVALUE: f64 = 0.9999;

/// What begins the names of its own options.
const PREFIX: &str = "inf_sup_";
/// Its own options beside the recipe of the solver, with a factor of `K + BᵀDB` for the displacements.
const OWN: Options = &[("-ksp_type", "gmres"), ("-fieldsplit_lambda_pc_type", "redundant")];

/// Discrete inf-sup constants, `β² = g / (α (1 - g))` with `g` the smallest eigenvalue of `D (B K_γ⁻¹ Bᵀ)` over the
/// active multipliers of the contact. With an exact `K_γ⁻¹` the preconditioned system has no other eigenvalues but 1,
/// so the Ritz values of one solve with an erratic right-hand side on those multipliers show it. The cost is a
/// factorisation of `K_γ`. Nothing beside a jump term, which makes up for a small constant. **Collective**
///
/// # Errors
/// PETSc's own.
pub fn inf_sup(system: &SaddlePoint, contacts: &[Contact]) -> Result<Vec<Option<f64>>, SystemError> {
    // Where each rank makes the factor for itself, the constant has the same digits in each run.
    for (name, value) in FIELD_SPLIT.iter().chain(OWN).chain(FACTOR).chain(redundant_factor(system)) {
        options::set_default(&system.session, &name.replacen('-', &format!("-{PREFIX}"), 1), value)?;
    }
    let krylov = Krylov::new(&system.session, PREFIX)?;
    krylov.keep_eigenvalues()?;
    let stored = system.stored_nest()?;
    let nest = stored.as_ref().unwrap_or(&system.nest);
    krylov.set_operators(nest, nest)?;
    let [u, lambda] = system.nest.nest_index_sets()?;
    krylov.preconditioner().field_split_schur(&[("u", &u), ("lambda", &lambda)], &system.multipliers.schur)?;
    krylov.set_from_options()?;
    krylov.set_tolerance(TOLERANCE, MOST_ITERATIONS)?;
    contacts.iter().map(|contact| of_contact(&krylov, system, contact)).collect()
}

fn of_contact(krylov: &Krylov, system: &SaddlePoint, contact: &Contact) -> Result<Option<f64>, SystemError> {
    let active = system.active();
    if !contact.jumps.is_empty() || !contact.range().any(|i| active[i]) {
        return Ok(None);
    }
    let (mut x, mut b) = system.nest.create_vectors()?;
    let unknowns = b.local_len() - system.multipliers.own.len();
    let own = system.multipliers.own.iter().enumerate();
    for (at, &i) in own.filter(|(_, i)| contact.range().contains(i) && active[**i]) {
        // A fixed erratic sequence, the same for every number of ranks.
        b.values_mut()[unknowns + at] = (12.9898 * (i + 1) as f64).sin().mul_add(43758.5453, 0.5).rem_euclid(1.0) - 0.5;
    }
    let solved = krylov.solve_allowing(&b, &mut x)?;
    let ritz = krylov.eigenvalues(solved.iterations)?;
    let smallest = ritz.first().copied().filter(|g| *g < MOST_EIGENVALUE);
    Ok(smallest.map(|g| (g.max(0.0) / (contact.multipliers.alpha * (1.0 - g))).sqrt()))
}
