//! Random assemblies: bodies that hold each other, and what statics alone knows of them.

mod case;
mod judge;
mod pile;
mod round;
mod statics;

pub use judge::{is_small, many};
