//! What a run was forecast to take of memory, for words where it runs out all the same.

use std::sync::atomic::{AtomicU64, Ordering};

/// On all ranks (bytes); 0 if nothing was forecast.
static FORECAST: AtomicU64 = AtomicU64::new(0);

/// Keeps the forecast (bytes).
pub fn keep(bytes: f64) {
    FORECAST.store(bytes as u64, Ordering::Relaxed);
}

/// What helps where memory has run out, behind words that begin with *memory*.
pub fn remedy() -> String {
    let forecast = FORECAST.load(Ordering::Relaxed) as f64;
    let forecast =
        if forecast > 0.0 { format!("; {} were forecast for all ranks together", size(forecast)) } else { String::new() };
    format!("{forecast}; refine less, leave more to the run (ulimit, job, other programs), or take more machines")
}

/// A size as people say it.
pub fn size(bytes: f64) -> String {
    if bytes < 1e9 { format!("{:.0} MB", 1e-6 * bytes) } else { format!("{:.1} GB", 1e-9 * bytes) }
}
