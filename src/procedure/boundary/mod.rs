//! Contact boundaries that follow the solution, from one fit to the next.

mod following;

pub use following::{BoundaryStep, Following, NextBoundary, carried, standing, start_from};
