//! What acts on the bodies of a case: supports, loads and rigid tools.
//!
//! In come the tables `[support]`, `[load]` and `[rigid]`; out come prescribed displacements, springs, mean motions, loads on curves
//! and at points, and what moves as a rigid body, each with the name of its table. One table is one of these kinds. Names of bodies
//! are checked against the case, names of curves against the mesh, later and elsewhere.

pub mod load;
pub mod mean;
mod motion;
pub mod rigid;
pub mod spot;
mod springs;
pub mod support;
