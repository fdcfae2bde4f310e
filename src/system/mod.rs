//! The saddle-point system: it alone builds matrices and solvers.
//!
//! A [`Scene`] becomes a [`Discretisation`]: [`Space`]s (one per multigrid level), [`Contact`]s and their [`Coupling`].
//! From it come the blocks of a [`SaddlePoint`], and with a [`LinearSolver`] a [`System`], which is solved for one active set
//! after the other. The [`Procedure`] does so, on one contact boundary after the other and one mesh after the other. What a
//! solution means on the bodies is in [`recovery`].

mod auxiliary;
mod boundary_motion;
mod choice;
mod contact;
mod contact_pressure;
mod contact_system;
mod coupling;
mod cycle;
mod discretisation;
mod error;
mod field;
mod form;
mod free_motion;
mod held;
mod held_bodies;
mod internal_forces;
mod interpolation;
mod level_ranks;
mod mean_force;
mod need;
mod nodal_force;
mod procedure;
mod programme;
mod reach;
pub mod recovery;
mod rigid_border;
mod rigid_motion;
mod rigid_start;
mod saddle_point;
#[cfg(test)]
pub(crate) mod samples;
mod scene;
mod side_materials;
mod solution;
mod solver;
mod soundness;
mod space;
mod springs;
mod stiffness;
mod triangle_lattice;
mod user_options;

pub use boundary_motion::BoundaryMotion;
pub use choice::{SolverChoice, Tolerance};
pub use contact::Contact;
pub use contact_pressure::ContactPressure;
pub use contact_system::{Start, System};
pub use coupling::{Coupled, Coupling, bilateral, coupled_here};
pub use discretisation::{Discretisation, finest_numbering, node_count, spaces};
pub use error::SystemError;
pub use field::Field;
pub use form::Form;
pub use held::{few_that_hold, free_motion_if_closed, needed_contacts, not_held, not_held_if_closed};
pub use internal_forces::local_strain_energy;
pub use interpolation::{Interpolation, interpolations};
use need::{memory_need, memory_of_macro_mesh};
pub use nodal_force::{load, nodal_forces};
pub use procedure::{
    AtRest, BoundaryStep, CoarseSolve, Ending, Estimate, Event, Failure, Observer, Pass, Procedure, Solved, Standing, Work,
    ZoneDifference, ZoneEstimate,
};
pub use programme::{Prediction, Predictor};
use reach::{beside, widest};
pub use rigid_border::RigidBorder;
pub use rigid_motion::{rigid_motions, settle};
pub use rigid_start::rigid_start;
pub use saddle_point::{BorderBlocks, BorderUnknown, SaddlePoint, SchurPattern};
pub use scene::{Scene, spread};
pub use solution::Solution;
pub use solver::{LinearEnding, LinearSolve, LinearSolver, Preconditioning, Residual, inf_sup};
pub use soundness::check_soundness;
pub use space::Space;
pub use stiffness::Elastic;
