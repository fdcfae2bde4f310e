//! What a solution means on the bodies: energies, reactions, stresses, traces on Γ_C, values at points, errors.

mod balance;
mod cell_energies;
mod corners;
mod deformation;
mod error_norm;
mod evaluation;
mod motion_error;
mod overlaps;
mod penetrations;
mod probe;
mod stress;
mod traces;
mod zone_ends;
mod zone_errors;

pub use balance::{Balance, ContactForce};
pub use cell_energies::cell_energies;
pub use corners::Corners;
pub use deformation::Deformation;
pub use evaluation::Evaluation;
pub use motion_error::MotionError;
pub use probe::{Probed, holding, probe, shapes_at, stress_around, stress_forces};
pub use stress::NodalStress;
pub use traces::{TracePoint, trace_points};
pub use zone_errors::{ZoneErrors, zone_errors};
