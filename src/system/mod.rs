//! The saddle-point system of one contact boundary: its blocks for one active set, and what solves it.
//!
//! A [`crate::discretisation::Discretisation`] and its `K` come in. Out go a [`SaddlePoint`], the MatNest of one active set,
//! and a [`System`], which holds it together with its [`LinearSolver`] (fieldsplit/Schur or direct) and the unknowns, and is
//! solved for one active set after the other.
//!
//! In reading order: `saddle_point/`, `rigid_border.rs` (rigid motions that are unknowns), `solver/`, `contact_system.rs`;
//! `choice.rs` is what a case asks of a solver, `need.rs` how much memory a run will take.
//!
//! - Invariant: the blocks of a system belong to one active set. [`System`] alone changes them, with the right-hand side and
//!   the solver.
//! - Invariant: an approximate preconditioner changes iterations, never the solution: residuals are those of the system itself.

mod choice;
mod contact_system;
mod need;
mod rigid_border;
mod saddle_point;
mod solver;

pub use choice::{SolverChoice, Tolerance};
pub use contact_system::{Start, System};
pub use need::{memory_need, memory_of_macro_mesh};
pub use rigid_border::RigidBorder;
pub use saddle_point::SaddlePoint;
pub use solver::{LinearEnding, LinearSolve, LinearSolver, MOST_ROUNDING, Preconditioning, Residual};
