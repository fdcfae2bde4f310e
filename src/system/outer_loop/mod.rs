//! Around the linear solve: active sets, contact boundaries that follow the bodies, and what one mesh tells the next.

mod coarse_solution;
mod contact_loop;
mod contact_state;
mod estimate;
mod first_set;
mod following;
mod held;
mod rigid_start;
mod solution;
mod unsettled;
mod zone_estimate;

pub use coarse_solution::CoarseSolution;
pub use contact_loop::{ContactLoop, OuterStep, Start};
pub use estimate::{Difference, Estimate};
pub use following::{BoundaryStep, Following, Onward, carried, stands};
pub use held::{few_that_hold, is_needed, not_held, not_held_if_closed};
pub use rigid_start::rigid_start;
pub use solution::{Solution, Verdict};
pub use zone_estimate::{ZoneDifference, ZoneEstimate};
