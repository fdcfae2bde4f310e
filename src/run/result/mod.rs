//! From a scene to a result folder, all of it methods of [`Run`](super::Run), which all ranks call.
//!
//! In comes a scene, or one for each load step (`steps.rs`). `solve.rs` gives it to the procedure, `evaluate.rs` makes a summary of
//! the solution, with its status and its reason, `files.rs`, `fields.rs` and `figures.rs` what lies beside it. Rank 0 alone
//! writes, but for the fields; what fails there is an error of all ranks alike.

mod evaluate;
mod fields;
mod figures;
mod files;
mod solve;
mod steps;
