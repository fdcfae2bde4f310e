//! The loop over load steps: each begins with the one before (at rest, where boundaries follow the bodies), is judged by itself,
//! and kept as a row.

use crate::case::LoadStep;
use crate::discretisation::Scene;
use crate::output::summary::{Status, StepSummary, Summary};
use crate::output::{CONTACTS, OutputError, RunError, plot, steps_table, vtk, write_text};
use crate::procedure::{Procedure, Solved};
use crate::run::Run;
use crate::run::reading::checks::check_pressures;
use crate::run::reading::scene;
use crate::run::telling::interruption;
use crate::run::words::{title, units};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// The folder within a result that holds the files of each step.
const FOLDER: &str = "steps";

impl Run<'_> {
    /// Solves all load steps on the mesh of a scene. The summary is that of the last one, with all others beside it; it is
    /// converged if all of them are. **Collective**
    ///
    /// # Errors
    /// [`RunError`] if there is no result of a step at all.
    pub(in crate::run) fn solve_steps(&self, scene: &Scene) -> Result<Summary, RunError> {
        // What cannot be used is told before anything is solved.
        for step in &self.case.steps {
            let looked = Procedure::look(&scene::of_step(step, scene), self.session.rank());
            let at_rest = looked.map_err(|error| RunError::from(error).in_step(step))?;
            check_pressures(&step.case, &at_rest.contacts).map_err(|words| RunError::Key(words).in_step(step))?;
        }
        let mut before: Option<Solved> = None;
        let mut rows = Vec::new();
        let mut last = None;
        for step in &self.case.steps {
            let started = Instant::now();
            let run = self.of_step(step)?;
            let solved = run.solve(scene::of_step(step, scene), before.as_ref()).map_err(|error| error.in_step(step))?;
            let summary = run.summarise(&solved).map_err(|error| error.in_step(step))?;
            let [seconds] = self.session.max([started.elapsed().as_secs_f64()]);
            rows.push(StepSummary::new(step.number, &step.factors, &summary, seconds));
            if summary.status != Status::Converged {
                let how = if summary.status == Status::Unresolved { "resolved" } else { "converged" };
                let reason = summary.reason.as_deref().unwrap_or_default();
                self.report.say(&format!("step {}: NOT {how}: {reason}", step.number));
            }
            interruption::keep_steps(&rows);
            // What has not converged is no place to begin at.
            before = if solved.ending.is_converged() { Some(solved) } else { before };
            last = Some(summary);
        }
        let (status, reason) = self.verdict(&rows);
        self.on_first(|| self.write_series(&rows))?;
        Ok(Summary { status, reason: Some(reason), steps: Some(rows), ..last.expect("a case with steps has a last one") })
    }

    /// The run of one step: its files lie in a folder of their own, those of the last one where they always do. **Collective**
    fn of_step(&self, step: &LoadStep) -> Result<Run<'_>, RunError> {
        let own = self.files.join(folder(step.number));
        let text = self.origin.case_inside(&step.case, 2);
        let make = || make_folder(&self.files, &own).and_then(|()| std::fs::write(own.join("case.toml"), text));
        self.on_first(|| make().map_err(OutputError::io("write to", &own)))?;
        let is_last = step.number == step.count;
        Ok(Run {
            case: &self.case.steps[step.number - 1].case,
            report: self.report.of_step(step),
            files: if is_last { self.files.clone() } else { own },
            draws: is_last,
            true_errors: Default::default(),
            ..self.clone()
        })
    }

    /// The verdict on all steps: that of the first one that has not converged, if there is one, else that of the last.
    fn verdict(&self, rows: &[StepSummary]) -> (Status, String) {
        let failed: Vec<usize> = (0..rows.len()).filter(|&at| rows[at].status != Status::Converged).collect();
        let reason = |at: usize| rows[at].reason.as_deref().unwrap_or_default();
        match failed[..] {
            [] => {
                let count = rows.len();
                (Status::Converged, format!("all {count} steps have converged; of the last one: {}", reason(count - 1)))
            }
            [first, ..] => {
                let others = match failed.len() - 1 {
                    0 => String::new(),
                    1 => "; another step has not converged, too".into(),
                    more => format!("; {more} other steps have not converged, too"),
                };
                (rows[first].status, format!("{}: {}{others}", self.case.steps[first].words(), reason(first)))
            }
        }
    }

    /// Writes what tells all steps: the table, the figure, and the series of fields and contacts.
    fn write_series(&self, rows: &[StepSummary]) -> Result<(), OutputError> {
        let files = &self.files;
        self.spare(write_text(&files.join("steps.csv"), &steps_table(rows)));
        let count = rows.len();
        let names: Vec<&String> = self.case.contacts.iter().map(|pair| &pair.name).collect();
        let last = files.join(folder(count));
        let tables = names.iter().map(|name| format!("contact_{name}.csv")).chain([CONTACTS.to_owned()]);
        for table in tables.filter(|table| files.join(table).exists()) {
            let copied = std::fs::copy(files.join(&table), last.join(&table)).map(|_| ());
            self.spare(copied.map_err(OutputError::unwritten(&last.join(&table))));
        }
        if !self.case.output.fields {
            return Ok(());
        }
        if rows.iter().any(|row| !row.contact.is_empty()) {
            self.spare(plot::write_step_figure(&files.join("steps.svg"), title(self.case), rows, &units(self.case)));
        }
        let fields = if self.session.size() == 1 { "fields.vtu" } else { "fields.pvtu" };
        write_all(files, "fields.pvd", fields, count)?;
        names.iter().try_for_each(|name| write_all(files, &format!("contact_{name}.pvd"), &format!("contact_{name}.vtu"), count))
    }
}

/// Makes the folder of a step. That of the result must be there: a signal may have ended the run, and taken it away.
fn make_folder(files: &Path, own: &Path) -> std::io::Result<()> {
    match std::fs::create_dir(files.join(FOLDER)) {
        Err(error) if error.kind() != std::io::ErrorKind::AlreadyExists => Err(error),
        _ => std::fs::create_dir(own),
    }
}

/// The folder of a step within a result.
fn folder(number: usize) -> PathBuf {
    Path::new(FOLDER).join(format!("{number:04}"))
}

/// Writes the series of one file over all steps; its times are their numbers. Steps that could not be solved have no file.
fn write_all(files: &Path, series: &str, file: &str, count: usize) -> Result<(), OutputError> {
    let path = |number: usize| if number == count { PathBuf::from(file) } else { folder(number).join(file) };
    let found = (1..=count).map(|number| (number, path(number))).filter(|(_, path)| files.join(path).exists());
    let all: Vec<(f64, String)> = found.map(|(number, path)| (number as f64, path.to_string_lossy().into_owned())).collect();
    if all.is_empty() { Ok(()) } else { vtk::write_series(&files.join(series), &all) }
}
