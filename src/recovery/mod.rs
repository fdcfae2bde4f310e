//! What a solution means on the bodies: energies, reactions, stresses, traces on Γ_C, values at points, errors.
//!
//! A solution of a [`crate::discretisation::Discretisation`] comes in; numbers go out, the same on all ranks. Nothing here knows how
//! it was found.
//!
//! `energy.stationary` takes in the square of the algebraic error alone. Example 1, `graded.toml`, 58 372 unknowns, relative to
//! 1e-11:
//!
//! | `solver.tolerance` | 1e-3 | 1e-4 | 1e-5 | 1e-6 |
//! |---|---|---|---|---|
//! | `total` | 2.6e-8 | 1.4e-9 | 2.9e-11 | 1e-12 |
//! | `stationary` | 8.1e-9 | 3.1e-11 | 4e-13 | < 1e-13 |
//! | iterations on the finest mesh | 2 | 4 | 6 | 8 |
//!
//! At 3844 to 231 428 unknowns a tolerance of 1e-4 keeps the errors of U at 1e-11 (8.5e-6 to 7.1e-9) to within 0.3 %, in 4
//! iterations instead of 16, and λ but for a fifth of its error.

mod balance;
mod cell_energies;
mod contact_forces;
mod corners;
mod crossings;
mod cut_off;
mod deformation;
mod direction_error;
mod end_slip;
mod error_norm;
mod evaluation;
mod heat;
mod held_force;
mod motion_error;
mod node_sums;
mod overlaps;
mod probe;
mod shape_error;
mod singular_places;
mod slant;
mod stress;
mod stress_peaks;
mod traces;
mod zone_ends;
mod zone_errors;
mod zone_width;

pub use balance::Balance;
pub use cell_energies::cell_energies;
pub use contact_forces::ContactForce;
pub use corners::Corners;
pub use cut_off::smooth_joints;
pub use deformation::Deformation;
pub use evaluation::Evaluation;
pub use heat::{HeatEnergy, heat_energies};
pub use motion_error::MotionError;
pub use overlaps::{missing_beyond, penetration_of, unresolved_force};
pub use probe::{Probed, Probing, holding, probe, shapes_at, stress_around, stress_forces};
pub use singular_places::unbounded_at;
pub use stress::NodalStress;
pub use stress_peaks::{StressPeak, largest_stresses};
pub use traces::{TracePoint, trace_points};
pub use zone_errors::{ZoneErrors, zone_errors};
