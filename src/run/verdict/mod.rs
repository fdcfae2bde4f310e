//! What a result is worth: whether its pressures can be trusted, whether its mesh can hold what the case says, and how far it is
//! from what is known.

pub(crate) mod exact;
pub(crate) mod expected;
pub(crate) mod points;
pub(crate) mod slivers;
pub(crate) mod true_errors;
pub(crate) mod trust;
pub(crate) mod turns;
pub(crate) mod unresolved;
pub(crate) mod zones;

pub use exact::{Errors, compare};
pub use slivers::slivers;
pub use true_errors::true_errors;
pub use turns::far_turns;
