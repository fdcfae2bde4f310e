//! The runs of a study, each a process of its own.
//!
//! In comes a plan, out come runs that have [ended](ended), kept or made. `record.rs` tells what a run is made of, `folder/` has
//! the places of results with their records, `execution.rs` makes a run, `progress.rs` says where the study is. A run stands if it
//! is of the same program, inputs and ranks; what is half done is never taken for a result.

pub(super) mod ended;
pub(super) mod execution;
pub(super) mod folder;
pub(super) mod progress;
pub(super) mod record;
