//! How a run ends.

use crate::case::{Case, LoadStep};
use crate::discretisation::SystemError;
use crate::output::RunError;
use crate::petsc;
use std::fmt::Display;
use std::sync::atomic::{AtomicU64, Ordering};

/// What a run was forecast to take of memory on all ranks (bytes), for words where it runs out all the same; 0 if nothing was
/// forecast.
static FORECAST: AtomicU64 = AtomicU64::new(0);

impl RunError {
    /// With the load step before words that begin with a key.
    pub(super) fn in_step(self, step: &LoadStep) -> Self {
        self.behind(step.words(), Self::Key)
    }

    /// With the case file before words that begin with a key.
    pub(super) fn in_case(self, case: &Case) -> Self {
        self.behind(case.file.display(), Self::Input)
    }

    /// With something before words that begin with a key.
    fn behind(self, place: impl Display, made: impl Fn(String) -> Self) -> Self {
        match self {
            Self::Key(words) => made(format!("{place}: {words}")),
            error => error,
        }
    }
}

/// Keeps a forecast of memory (bytes).
pub(super) fn keep_forecast(bytes: f64) {
    FORECAST.store(bytes as u64, Ordering::Relaxed);
}

/// What helps where memory has run out, behind words that begin with *memory*.
pub fn out_of_memory_remedy() -> String {
    let forecast = FORECAST.load(Ordering::Relaxed) as f64;
    let forecast =
        if forecast > 0.0 { format!("; {} were forecast for all ranks together", size(forecast)) } else { String::new() };
    format!("{forecast}; refine less, leave more to the run (ulimit, job, other programs), or take more machines")
}

/// A size as people say it.
pub(super) fn size(bytes: f64) -> String {
    if bytes < 1e9 { format!("{:.0} MB", 1e-6 * bytes) } else { format!("{:.1} GB", 1e-9 * bytes) }
}

/// A point that no triangle of its body holds any more: on the mesh of the file it lay on the edge.
pub(super) fn outside([x, y]: [f64; 2]) -> RunError {
    RunError::Key(format!("the point [{x}, {y}] lies outside its body; move it inside"))
}

impl From<SystemError> for RunError {
    fn from(error: SystemError) -> Self {
        match error {
            SystemError::Case(words) => Self::Key(words),
            error @ SystemError::UnusedOptions(_) => Self::Input(error.to_string()),
            SystemError::Petsc(error) => error.into(),
        }
    }
}

impl From<petsc::Error> for RunError {
    fn from(error: petsc::Error) -> Self {
        let remedy = if matches!(error, petsc::Error::OutOfMemory { .. }) { out_of_memory_remedy() } else { String::new() };
        Self::Failed(format!("{error}{remedy}"))
    }
}
