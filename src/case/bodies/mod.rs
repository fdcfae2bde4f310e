//! Bodies of a case: mesh, materials, weight and true shapes.
//!
//! In come the tables `[mesh]`, `[body]`, `[gravity]` and `[geometry]`; out come what is read of the mesh, bodies with their parts and
//! forces, and curves. What is bad is in the log, and something that may be drawn and named stands in its place.

pub mod body;
pub mod geometry;
pub mod gravity;
pub mod mesh;
pub mod revolution;
