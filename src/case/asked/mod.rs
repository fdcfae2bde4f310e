//! What is asked of a case: how it is solved and how accurately, in which steps, what is written, and what is known of the result.
//!
//! In come the tables `[solver]`, `[accuracy]`, `[steps]`, `[output]`, `[probe]` and `[exact]`; out come choices of the solver, goals
//! for the mesh, factors of load steps, points, and expected values. Each of them is checked against the contacts and bodies that the
//! file names, whether or not these could be read.

pub mod accuracy;
pub mod exact;
pub mod output;
pub mod solver;
pub mod steps;
