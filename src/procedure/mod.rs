//! The solution procedure: on one adapted mesh after the other, if an accuracy is asked for; on each of them on coarser
//! refinements first, on each of these one contact boundary after the other, and on each boundary one active set after the
//! other. A [`crate::discretisation::Scene`] and a [`Procedure`] come in, a [`Solved`] with a typed [`Ending`] goes out; an
//! [`Observer`] is told of the way.
//!
//! | loop | file | ends when |
//! |---|---|---|
//! | adapted meshes | `adapting.rs` with `sequence/` | all goals are reached, or a limit is |
//! | refinements | `one_mesh/meshes.rs` | the mesh of the case is solved |
//! | boundaries | `one_mesh/boundaries.rs` with `boundary/` | boundary, displacement and set stand |
//! | active sets | `sets/contact_loop.rs` | the set stands, and the residual is below its tolerance |
//!
//! In reading order: `settings.rs`, `adapting.rs`, then the rooms in the order of this table, `estimates/` at last.
//!
//! - Invariant: a coarser mesh that cannot be solved gives no information, which is no error.
//! - Invariant: how it ended is an [`Ending`], never an error; errors are of the case, of PETSc or of MPI.

mod adapting;
mod at_rest;
mod boundary;
mod coarse_solution;
mod ending;
mod estimates;
mod goal_errors;
mod load_step;
mod one_mesh;
mod predecessor;
mod sequence;
mod sets;
mod settings;
mod solved;

pub use at_rest::AtRest;
pub use boundary::BoundaryStep;
pub use ending::{Ending, Failure, MOVES, Standing};
pub use estimates::{Estimate, ZoneDifference, ZoneEstimate};
pub use sets::Pass;
pub use settings::{Event, Observer, Procedure, Work};
pub use solved::{CoarseSolve, Solved};
