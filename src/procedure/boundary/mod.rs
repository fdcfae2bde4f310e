//! Contact boundaries that follow the solution, from one fit to the next.

mod carried;
mod ends;
mod following;
mod rest;

pub use carried::{by_place, carried, start_from};
pub use following::{Following, NextBoundary};
pub use rest::{BoundaryStep, standing};
