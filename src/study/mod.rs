//! A grid of runs, each a process of its own and a row of one table.

mod execution;
mod folder;
mod format;
mod plan;
mod summary_path;
mod table;

use std::path::Path;

use crate::case::CaseError;
use crate::output::OutputError;

use execution::{Ended, Execution, Status};
use plan::{Plan, PlannedRun};
use table::Table;

/// Why there is no table.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum StudyError {
    /// The study cannot be made as it stands: 2.
    #[error("{0}")]
    Input(String),
    /// The disk failed: 1.
    #[error("{0}")]
    Failed(String),
}

impl From<CaseError> for StudyError {
    fn from(error: CaseError) -> Self {
        Self::Input(error.to_string())
    }
}

impl From<OutputError> for StudyError {
    fn from(error: OutputError) -> Self {
        match error {
            OutputError::Io { .. } => Self::Failed(error.to_string()),
            refused => Self::Input(refused.to_string()),
        }
    }
}

/// Makes every run of a study, and a table of them in the folder `out`. A run that fails is a row too.
///
/// # Errors
/// [`StudyError`] if there is no table.
pub fn run(file: &Path, out: &Path, force: bool) -> Result<(), StudyError> {
    let plan = Plan::read(file)?;
    folder::claim(out, force)?;
    let execution = Execution::new(out, plan.timeout)?;
    println!("mezha {}: study {}, {}", env!("CARGO_PKG_VERSION"), plan.name, count(plan.runs.len(), "run"));
    let mut results = Vec::with_capacity(plan.runs.len());
    for (index, planned) in plan.runs.iter().enumerate() {
        let ended = execution.execute(planned, index + 1)?;
        println!("{}", progress(&plan, index, planned, &ended));
        results.push(ended);
    }
    folder::write_tables(out, &Table::new(&plan, &results))?;
    println!("mezha: {}; table in {}", verdict(&results), out.join("study.md").display());
    Ok(())
}

/// What is printed when a run has ended.
fn progress(plan: &Plan, index: usize, planned: &PlannedRun, ended: &Ended) -> String {
    let moved = plan.keys.iter().zip(&planned.values).map(|(key, value)| format!("{key}={value}"));
    let words: Vec<String> = [planned.case.clone()].into_iter().chain(planned.curve.clone()).chain(moved).collect();
    let (all, ranks, seconds) = (plan.runs.len(), count(planned.ranks, "rank"), ended.wall.as_secs_f64());
    let number = format!("{:>width$}/{all}", index + 1, width = all.to_string().len());
    let line = format!("{number}  {}  {ranks}  {seconds:.2} s  {}", words.join("  "), ended.status.words());
    if ended.is_good() { line } else { format!("{line}: {}", ended.reason) }
}

/// How many runs ended how, and the usual ending first.
fn verdict(results: &[Ended]) -> String {
    let of = |status: Status| results.iter().filter(|ended| ended.status == status).count();
    let counts = Status::ALL.map(|status| (status.words(), of(status)));
    let some = counts.iter().filter(|(words, number)| *number > 0 || *words == Status::Converged.words());
    let words: Vec<String> = some.map(|(words, number)| format!("{number} {}", words.replace('_', " "))).collect();
    format!("{}: {}", count(results.len(), "run"), words.join(", "))
}

/// `1 run`, `2 runs`
fn count(number: usize, thing: &str) -> String {
    if number == 1 { format!("1 {thing}") } else { format!("{number} {thing}s") }
}
