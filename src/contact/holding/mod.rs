//! How contact holds bodies: rigid motions that it resists, and the quadratic programme of its forces.

mod block_factor;
mod mechanism;
mod programme;

pub use mechanism::changed_forces::changed_forces;
pub use mechanism::{Condition, Extent, Mechanism, Touch, describe_motion, find_mechanism, needed_contacts, tidy};
pub use programme::{Programme, ProgrammeOutcome, added_up};
