//! What is warned of: pure functions from a case, a mesh or a solution to sentences, which the run prints.

pub(crate) mod after;
pub(crate) mod before;
pub(crate) mod loose;
