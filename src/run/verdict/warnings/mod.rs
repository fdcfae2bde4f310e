//! What is warned of: pure functions from a case, a mesh or a solution to sentences, which the run prints.

pub(crate) mod apart;
pub(crate) mod idle;
pub(crate) mod parts;
pub(crate) mod points;
pub(crate) mod segments;
pub(crate) mod slits;
pub(crate) mod slivers;
pub(crate) mod turns;
