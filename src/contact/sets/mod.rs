//! Active sets: the primal-dual rule, and what takes its place where sets come back.

mod active_set;
mod ascent;

pub use active_set::{ActiveSet, SetChange};
pub use ascent::SetSolution;
