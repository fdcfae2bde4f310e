//! Rigid sets whose motion is unknown: tools that carry a force, plates that press.
//!
//! The nodes of such a set are prescribed, by a motion `q` that follows from its balance. Beside the blocks `A x = b` of
//! displacements and multipliers stands a border,
//!
//! ```text
//! [ A   T ] [x]   [b]        T = [ K R ]        R: displacements of the set's nodes by each free component of its motion
//! [ Tᵀ  D ] [q] = [h]            [ B R ]        D = Rᵀ K R,   h = F + Rᵀ (f - K u_D)
//! ```
//! `R` moves all of a tool, so that `K R = 0`: its border is that of the gaps alone. The border
//! is eliminated: `(D - Tᵀ A⁻¹ T) q = h - Tᵀ A⁻¹ b`, with one solve for each free component and active set. `A` is that
//! of sets at rest, so that nothing in its solver has to know of them.

mod border;
mod motion;

pub use border::RigidBorder;
pub use motion::{rigid_motions, settle};
