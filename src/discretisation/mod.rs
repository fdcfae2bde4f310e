//! A scene cut into unknowns, on its ranks and on every level of refinement: all that a system is assembled from.
//!
//! A [`Scene`] (mesh, bodies, loads, contacts) comes in. Out go a [`Discretisation`], with a [`Space`] of displacements for
//! each level, the [`Contact`]s with their segments and multipliers, and their [`Coupling`] to the bodies; the forces that
//! loads, springs and stresses make at the nodes; and what supports and contact leave free to move.
//!
//! In reading order: `scene.rs`, `space.rs`, `contacts/`, `field.rs`, `held_bodies.rs`, `levels.rs`; then `displacement.rs`,
//! `elements.rs`, `forces/`, `motions/`.
//!
//! - Invariant: no rank asks another about the mesh; each computes the numbers of the nodes of all others.
//! - Invariant: body 1 and body 2 of a contact never meet. Each is coupled to Γ_C alone.
//! - Invariant: nothing here knows a solver. Matrices begin with [`crate::multigrid`].

mod acting;
mod contacts;
mod displacement;
mod elements;
mod error;
mod field;
mod forces;
mod form;
mod held_bodies;
mod levels;
mod motions;
#[cfg(test)]
pub(crate) mod samples;
mod scene;
mod solution;
mod space;

pub use acting::BY_ROUNDING;
pub use contacts::{
    BoundaryMotion, Contact, ContactPressure, Coupled, Coupling, beside, bilateral, check_soundness, coupled_here,
    refused_contacts, widest,
};
pub use elements::{Element, EvenTriangle};
pub use error::{SystemError, agreed};
pub use field::Field;
pub use forces::{SpringForces, internal_forces, load, local_strain_energy, nodal_forces};
pub use form::Form;
pub use held_bodies::{HeldBodies, held_motions, holds_of_bodies};
pub use levels::{Discretisation, SMALL, WithoutContact, finest_numbering, node_count, ranks_in_group, spaces};
pub use motions::{
    Freedom, HeldLoad, LooseMotion, adrift, few_that_hold, forces_without_holds, free_motion_if_closed, needed_contacts,
    not_held, not_held_if_closed, rigid_motions, rigid_start, settle,
};
pub use scene::{Scene, spread};
pub use solution::Solution;
pub use space::Space;
