//! The solution procedure: on one adapted mesh after the other, if an accuracy is asked for; on each of them on coarser
//! refinements first, on each of these one contact boundary after the other, and on each boundary one active set after the
//! other.
//!
//! | loop | file | ends when |
//! |---|---|---|
//! | adapted meshes | `adapting.rs` with `mesh_sequence.rs` | all goals are reached, or a limit is |
//! | refinements | `meshes.rs` | the mesh of the case is solved |
//! | boundaries | `boundaries.rs` with `following.rs` | boundary, displacement and set stand |
//! | active sets | `contact_loop.rs` | the set stands, and the residual is below its tolerance |

mod across;
mod adapting;
mod at_rest;
mod begun;
mod boundaries;
mod by_forces;
mod change;
mod coarse_solution;
mod contact_loop;
mod contact_state;
mod duals;
mod end_estimate;
mod ending;
mod energy_norm;
mod estimate;
mod first_set;
mod following;
mod foreseen;
mod goal_errors;
mod load_step;
mod marking;
mod mesh_sequence;
mod meshes;
mod observer;
mod pass;
mod predecessor;
mod residual_scale;
mod settings;
mod solved;
mod unsettled;
mod wide_contact;
mod zone_estimate;

pub use at_rest::AtRest;
pub use ending::{Ending, Failure, Standing};
pub use estimate::Estimate;
pub use following::BoundaryStep;
pub use observer::{Event, Observer, Work};
pub use pass::Pass;
pub use settings::Procedure;
pub use solved::{CoarseSolve, Solved};
pub use zone_estimate::{ZoneDifference, ZoneEstimate};
