//! A grid of runs, each a process of its own and a row of one table; finished runs are kept, and made again only if they would
//! differ.
//!
//! In comes a study file, out comes a folder with all results, tables, figures and a page. The file becomes a checked `plan`, its runs
//! are made in `runs`, put side by side in `table`, and become texts in `shown`. A study solves nothing itself: what it knows of a
//! run is its exit code and its `summary.json`.

mod plan;
mod runs;
mod shown;
mod table;

use std::path::Path;

use crate::output::RunError;
use crate::output::plot::{diagrams, named_diagrams};

pub use plan::Plan;

use plan::planned::PlannedRun;
use runs::ended::Ended;
use runs::execution::Execution;
use runs::folder::{Folder, ResultPlace, Wanted};
use runs::progress::Progress;
use runs::record::{Program, Record, inputs, what};
use shown::page::Figures;
use shown::{figure, format, page};
use table::repeats::with_spreads;
use table::rows::Table;

/// Makes every run of a study that has not been made yet, and tables and figures of all in the folder `out`. A run that fails is a
/// row too. `overrides` are `KEY=VALUE` for keys of the study; with `force` all runs are made anew. Tells
/// whether any run has a result.
///
/// # Errors
/// [`RunError`] if there is no table.
pub fn run(file: &Path, overrides: &[String], out: &Path, force: bool) -> Result<bool, RunError> {
    let plan = Plan::read(file, overrides).map_err(|error| RunError::Input(error.to_string()))?;
    let program = Program::this()?;
    let folder = Folder::open(out, &plan.name, force)?;
    let want = |run: &PlannedRun| {
        let inputs = inputs(run);
        Wanted { identity: program.identity(run, &inputs), what: what(run), inputs }
    };
    let wanted: Vec<Wanted> = plan.runs.iter().map(want).collect();
    let places = folder.places(&wanted, plan.timeout);
    let progress = Progress::start(&plan, &places);
    let results = make(&plan, &program, &folder, &wanted, places, &progress)?;
    let lines = table::lines::lines(&plan, &results);
    let table = with_spreads(Table::new(&plan, &results), &plan);
    let figures = Figures {
        asked: figure::asked_diagrams(&table, &plan.figure),
        first: figure::first_diagrams(&plan, &lines),
        all: figure::all_diagrams(&plan, &lines),
    };
    let mut texts = vec![
        ("study.csv", format::csv(&table)),
        ("study.json", format::json(&table, &lines)),
        ("study.md", format::markdown(&table)),
        ("report.html", page::html(&table, &lines, &figures)),
    ];
    let svg = [named_diagrams(&figures.asked), named_diagrams(&figures.first), diagrams(&figures.all)];
    let named = ["study_figure.svg", "study.svg", "study_all.svg"].into_iter().zip(svg);
    texts.extend(named.filter_map(|(name, text)| Some((name, text?))));
    folder.write_tables(&texts)?;
    progress.end(&plan, &results, !figures.asked.is_empty(), &out.join("report.html"));
    Ok(results.iter().any(Ended::has_result))
}

/// Makes the runs that are not kept, one after the other, and records each as it ends.
fn make(
    plan: &Plan,
    program: &Program,
    folder: &Folder,
    wanted: &[Wanted],
    places: Vec<ResultPlace>,
    progress: &Progress,
) -> Result<Vec<Ended>, RunError> {
    if places.iter().any(|place| place.kept.is_none()) {
        folder.remove_tables()?;
    }
    let execution = Execution::new(program, folder, plan.timeout)
        .map_err(|error| RunError::Failed(format!("cannot wait for signals: {error}")))?;
    let mut results = Vec::with_capacity(plan.runs.len());
    for (index, place) in places.into_iter().enumerate() {
        let planned = &plan.runs[index];
        results.push(match place.kept {
            Some(kept) => kept,
            None => {
                folder.clear(place.number)?;
                progress.begin(index, planned);
                let ended = execution.execute(planned, &wanted[index].inputs, place.number)?;
                if let Some(signal) = execution.interrupted() {
                    folder.clear(place.number)?;
                    progress.interrupted();
                    return Err(RunError::Failed(format!(
                        "interrupted by {signal} in run {} of {}; the runs before are kept, and the same command goes on from there",
                        index + 1,
                        plan.runs.len()
                    )));
                }
                progress.ended(&ended);
                let Wanted { identity, what, .. } = wanted[index].clone();
                let record = Record { study: plan.name.clone(), what, identity, ended };
                folder.keep(place.number, &record)?;
                record.ended
            }
        });
    }
    Ok(results)
}
