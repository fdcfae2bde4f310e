//! Solutions compared in the energy norm: how far they are from each other, and what that tells of the error on the next adapted mesh.
//!
//! Displacements are compared and no stress is recovered, so that nothing is smeared where materials meet. Estimate by true
//! relative error in the energy norm: `rings` and `beam`, exact stresses, `refine` 2 to 4, 0.83 to 1.10; `bars_inclined`, from
//! U, with `segments = "auto"`, 1.09 (P1) and 1.20 (P2) on the even mesh, 1.06 and 1.17 on the graded one, and 1.7 with P2 and
//! the list of segments of `case.toml`, which fits badly when it is thinned. In `bars_parabola` U is no measure: too soft a
//! contact and too stiff bodies cancel in it (1.4e-6 of U, P2), while the estimate is 1.6e-2 and an independent program found
//! 1.4e-2 on about such a mesh.

use crate::discretisation::{Discretisation, Field, Solution, SystemError, local_strain_energy};
use crate::recovery::heat_energies;

/// Squares of the share of a difference that may be left, at least and at most: q/(1 - q), where squares fall by the q of a smooth
/// solution of P2, 1/16, and by 3/4.
const SHARES_LEFT: [f64; 2] = [1.0 / 15.0, 3.0];

/// Share of the square of the difference on the mesh before that must have gone, for what went with it to tell of the rest: one
/// that is halved once loses 1 - √½ where a refinement halves it, as at a sharp corner, one that is not refined only what its neighbours change.
const LEAST_GONE: f64 = 0.3;

/// Share of the energy of heated bodies that are kept from growing by which errors are measured where less is stored: their stresses
/// are then below a hundredth of those. A tenth of it would ask for stresses to a third of that, and an energy that is nothing but error
/// would be resolved for ever.
const LEAST_KEPT: f64 = 1e-4;

/// Share of the energy that must be left without the triangles at forces on points, for the rest to tell anything.
const LEAST_LEFT: f64 = 0.05;

/// Square of the share of a difference that is left on a macro triangle, from one adapted mesh to the next. By Galerkin's orthogonality
/// the error e of the mesh before has the square `|u - u_before|² + e_now²`; with e = s D on both meshes, `s² = |u - u_before|²/(D_before² - D²)`.
pub(crate) fn share_left(apart: f64, before: f64, now: f64) -> Option<f64> {
    let is_enough = before - now > LEAST_GONE * before;
    is_enough.then(|| (apart / (before - now)).clamp(SHARES_LEFT[0], SHARES_LEFT[1]))
}

/// A part of a whole; none where both are nothing, as on a contact that stays open.
pub(crate) fn share(part: f64, whole: f64) -> f64 {
    if part == 0.0 { 0.0 } else { part / whole }
}

/// Strain energies of macro triangles of this rank. Forces at points make one without limit, which says nothing of what is farther away:
/// it is left out.
pub(crate) fn without_points(problem: &Discretisation, parts: Vec<f64>) -> Vec<f64> {
    let left_out = problem.scene.has_point_load(problem.session.rank());
    parts.into_iter().zip(left_out).map(|(part, is_out)| if is_out { 0.0 } else { part }).collect()
}

/// Strain energy without that at forces on points; not a number if too little is left to tell anything. Where heat strains next
/// to nothing, a small share of what it would store if bodies could not grow. **Collective**
pub(crate) fn whole_energy(problem: &Discretisation, u: &Field<2>) -> Result<f64, SystemError> {
    let parts = local_strain_energy(problem, u)?;
    let all = parts.iter().sum();
    let [all, left] = problem.session.sum([all, without_points(problem, parts).iter().sum()]);
    let heat = heat_energies(problem, u)?;
    let [work, kept] = heat.iter().fold([0.0; 2], |[work, kept], heat| [work + heat.work, kept + heat.kept]);
    let elastic = left - work + kept;
    let whole = elastic.max(LEAST_KEPT * kept);
    Ok(if left > LEAST_LEFT * all || all == 0.0 { whole } else { f64::NAN })
}

/// Square of the difference of a solution from another displacement in the relative energy norm, on each macro triangle of this rank, in
/// the rank's order. **Collective**
pub(crate) fn energy_apart(problem: &Discretisation, solution: &Solution, mut other: Vec<f64>) -> Result<Vec<f64>, SystemError> {
    other.iter_mut().zip(&solution.displacement).for_each(|(other, now)| *other = now - *other);
    let [u, apart] = [&solution.displacement, &other].map(|values| Field::displacement(problem, values));
    let whole = whole_energy(problem, &u)?;
    let parts = without_points(problem, local_strain_energy(problem, &apart)?);
    Ok(parts.into_iter().map(|part| share(part, whole)).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of the errors 3 and 1 on two adapted meshes the differences from a coarser solution were twice as large, or two thirds of them.
    #[test]
    fn what_is_left_of_one_difference_is_what_was_left_on_the_mesh_before() {
        for share in [0.5f64, 1.5] {
            let [before, now] = [3.0, 1.0].map(|error: f64| (error / share).powi(2));
            let found = share_left(9.0 - 1.0, before, now).expect("much has gone");
            assert!((found - share * share).abs() < 1e-12, "{share}: {found}");
        }
        assert_eq!(share_left(1.0, 1.0, 0.9), None, "next to nothing has gone");
        assert_eq!(share_left(100.0, 1.0, 0.0), Some(SHARES_LEFT[1]));
    }
}
