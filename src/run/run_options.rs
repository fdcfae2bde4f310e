//! What a run is told beside its case.

use crate::arguments::ShowProgress;
use crate::case::Inputs;
use std::path::PathBuf;
use std::time::Instant;

/// Where results go and what is printed.
#[derive(Clone, Debug)]
pub struct RunOptions {
    /// Folder of the results.
    pub out: PathBuf,
    /// What the run is to be made of; anything else is refused.
    pub inputs: Option<Inputs>,
    /// Replace a result that is there.
    pub force: bool,
    /// Print errors only.
    pub quiet: bool,
    /// When the run shows where it is.
    pub progress: ShowProgress,
    /// When the program started.
    pub started: Instant,
}
