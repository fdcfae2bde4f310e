//! Contact boundaries that follow the solution, from one fit to the next.

mod ends;
mod following;
mod rest;

pub use following::{Following, NextBoundary, carried, start_from};
pub use rest::{BoundaryStep, standing};
