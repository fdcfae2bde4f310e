//! What is told while a run lives, and what is left of one that is ended.
//!
//! In come events of the solution procedure, and what is worked on; out come lines on the terminal (`report.rs`), one that is
//! rewritten in place (`progress.rs`), times of stages, and after a signal a result that says how far the run came
//! (`interruption.rs`). Rank 0 alone speaks. Nothing here asks other ranks, and no digit of a result depends on it.

pub mod interruption;
pub(super) mod progress;
pub(super) mod report;
