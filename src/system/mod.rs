//! The saddle-point system: it alone builds matrices and solvers.
//!
//! A [`Scene`] becomes a [`Discretisation`]: [`Space`]s (one per multigrid level), [`Contact`]s and their [`Coupling`].
//! From it come the blocks of the [`SaddlePoint`], a [`LinearSolver`] for them, and the [`ContactLoop`] over active
//! sets. What the solution means on the bodies is in [`recovery`].

mod auxiliary;
mod boundary_motion;
mod choice;
mod contact;
mod coupling;
mod discretisation;
mod error;
mod field;
mod interpolation;
mod nodal_force;
mod outer_loop;
pub mod recovery;
mod saddle_point;
mod scene;
mod solver;
mod space;
mod stiffness;
mod user_options;

pub use boundary_motion::BoundaryMotion;
pub use choice::{Form, SolverChoice, Tolerance};
pub use contact::Contact;
pub use coupling::{Coupled, Coupling, bilateral};
pub use discretisation::{Discretisation, spaces};
pub use error::SystemError;
pub use field::Field;
pub use interpolation::interpolations;
pub use nodal_force::{load, nodal_forces};
pub use outer_loop::{
    BoundaryStep, CoarseSolution, ContactLoop, Difference, Estimate, Following, Onward, OuterStep, Solution, Start, Verdict,
    ZoneEstimate, carried, few_that_hold, is_needed, not_held, not_held_if_closed, rigid_start, stands,
};
pub use saddle_point::{CouplingRows, MultiplierBlocks, SaddlePoint, SchurPattern};
pub use scene::Scene;
pub use solver::{Ending, LinearSolve, LinearSolver, Rung, inf_sup};
pub use space::Space;
pub use stiffness::Elastic;
