//! The stiffness `K` of the bodies on every level, and the multigrid cycle on these levels.
//!
//! A [`crate::discretisation::Discretisation`] comes in. Out go [`Elastic`], `K` on the finest level with its load, the
//! [`Interpolation`] between levels, and a [`Cycle`] that is the preconditioner of the displacements. Meshes that cannot be
//! coarsened by their own levels get auxiliary ones.
//!
//! In reading order: `stiffness/` (rows that need not be stored), `interpolation/`, `cycle/`, `auxiliary/`.
//!
//! - Invariant: a row of `K` is on the rank that owns its node; products ask other ranks for values at their nodes only.
//! - Invariant: sums have a fixed order. The same command on as many ranks gives the same digits.

mod auxiliary;
mod cycle;
mod interpolation;
mod sparse;
mod stiffness;
mod triangle_lattice;

pub use auxiliary::GalerkinLevels;
pub use cycle::{Border, Cycle, scaled_inverse};
pub use interpolation::{Interpolation, interpolations};
pub use sparse::{Sparse, add_multiple, dot};
pub use stiffness::{
    BlockPlace, ContactNeighbours, Elastic, LatticeOperator, RowPlaces, Stiffness, SweepHalves, takes_another_preconditioner,
};
