//! What residuals are measured by, and how far the last solve goes.
//!
//! A body 1e5 times stiffer than the other that its support presses down would have a right-hand side of its own modulus, beside
//! which no force of contact is large. The way of a rigid tool, taken as strain of the edges that it meets, is hundreds of times
//! larger than the nodal forces. A body that only contact holds is not moved along in this measure: where a prescribed
//! displacement carries it by 1e4 times what the loads strain (example 1, table lifted by 1), at 1e-8 the energy is off by 4e-7
//! and ∫λ ds by 1.5e-4.
//!
//! `"discretisation"` on `bars_inclined`, `rings` and `beam` (P1 with `p0`, P2 with `p1-discontinuous`) takes 4 to 8 iterations
//! instead of 9 to 13, and changes the error of λ by less than 5 %; only where λ is good to six digits (`rings` with P2) it
//! becomes 2.5e-5 instead of 1.4e-5. Solves to 1e-5 are at the accuracy of the discretisation (prototype, 264 thousand unknowns,
//! 6 iterations).

use crate::discretisation::{SystemError, rigid_start};
use crate::system::{System, Tolerance};

/// Relative residual of the solves inside the loop: enough to find the right set.
pub(crate) const LOOSE: f64 = 1e-4;

/// Share of the right-hand side that the residual is measured by, at least: beyond it lies rounding.
const LEAST_SHARE: f64 = 1e-8;

/// Residual relative to the whole right-hand side that small forces ask for, at least.
const LEAST_RESIDUAL: f64 = 1e-13;

/// Share of the residual of a start from a coarser mesh that solves as far as the discretisation does.
const FROM_START: f64 = 2e-4;

/// Relative residual that is small enough for any discretisation error.
const SMALL: f64 = 1e-10;

/// Share of the right-hand side that asks for strain. Displacements prescribed to a stiff body are forces of its own
/// modulus there, however little they strain it: beside them the forces of contact with a soft one are small, and a
/// residual relative to all of it says nothing of these. So the part that moves the bodies rigidly does not count.
/// **Collective**
pub(crate) fn share(system: &System) -> Result<f64, SystemError> {
    let Some(displacement) = rigid_start(system.problem(), system.problem().session.rank()) else { return Ok(1.0) };
    let share = system.residual_of_displacement(&displacement)?.relative();
    Ok(if share > 0.0 { share.clamp(LEAST_SHARE, 1.0) } else { 1.0 })
}

/// The same where a rigid tool or plate acts, or heat, once the forces are known: they are small beside the right-hand side, which would
/// close all the way that a tool goes by strain within one element, or keep all of a body from growing. `share` is what it was before,
/// `residual` the relative one that is wanted. **Collective**
pub(crate) fn share_of_forces(system: &System, share: f64, residual: f64) -> Result<f64, SystemError> {
    let scene = &system.problem().scene;
    if scene.rigid.is_empty() && !scene.is_heated() {
        return Ok(share);
    }
    let ([loads, pressed], whole) = (system.force_norms()?, system.residual()?.whole);
    // Where displacements are prescribed the load is one that would strain what they move rigidly; that of heat strains nothing by itself.
    let forces = if share < 1.0 || scene.is_heated() { pressed } else { loads + pressed };
    if forces == 0.0 || whole == 0.0 {
        return Ok(share);
    }
    Ok((forces / whole).max(LEAST_RESIDUAL / residual).min(share))
}

/// Relative residual that the last solve is to reach. A start from a coarser mesh is off by the discretisation error of
/// that mesh; this share of its residual leaves less than a tenth of this mesh's, in λ too. **Collective**
pub(crate) fn last_residual(system: &System, tolerance: Tolerance) -> Result<f64, SystemError> {
    match tolerance {
        Tolerance::Residual(residual) => Ok(residual),
        Tolerance::Discretisation => Ok((FROM_START * system.residual()?.relative()).clamp(SMALL, LOOSE)),
    }
}
