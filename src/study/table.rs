//! The runs of a study as rows.

use std::collections::BTreeSet;
use std::ops::Range;

use serde_json::Value;

use super::ended::{Ended, RunStatus};
use super::plan::{Plan, PlannedRun};
use super::summary_path::SummaryPath;

/// Figures of each contact.
const CONTACT: [&str; 4] = ["force", "inf_sup", "oscillation", "trust"];

/// One row per run; what is not known is null.
#[derive(Clone, Debug, Default)]
pub struct Table {
    /// Name of the study.
    pub study: String,
    /// Where the errors stand in `summary.json`; the first one is the column `error`.
    pub errors: Vec<String>,
    /// Where the time axis does.
    pub time: String,
    /// What the values of a row are.
    pub columns: Vec<Column>,
    /// As many values as columns each.
    pub rows: Vec<Vec<Value>>,
    /// Rows of repeats of one run.
    pub groups: Vec<Range<usize>>,
    /// For each row, whether its reason goes without saying.
    pub good: Vec<bool>,
    /// Number of runs that converged.
    pub converged: usize,
    /// Where the runs were made, each machine once.
    pub machines: Vec<String>,
    /// The BLAS that they used, each once.
    pub blas: Vec<String>,
}

/// A column of the table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Column {
    /// Name of the column: a word, a key of the case, or a place in `summary.json`.
    pub name: String,
    /// What it is for a reader.
    pub kind: ColumnKind,
}

/// What a column is for a reader.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ColumnKind {
    /// What the study has asked for, in its own words.
    Given,
    /// A result that everybody wants to see.
    Main,
    /// A result for programs, and for those who look closer.
    Detail,
}

impl Column {
    /// A column of this name.
    pub fn new(name: &str, kind: ColumnKind) -> Self {
        Self { name: name.into(), kind }
    }
}

impl Table {
    /// Puts the results of all runs side by side, in the order of the plan.
    pub fn new(plan: &Plan, results: &[Ended]) -> Self {
        let places = places(plan, results);
        let row = |(planned, ended): (&PlannedRun, &Ended)| {
            let mut cells = of_plan(planned);
            cells.extend(of_result(plan, ended));
            cells.extend(places.iter().map(|(place, _)| place.of(&ended.summary)));
            cells.push(text(&ended.result));
            cells
        };
        Self {
            study: plan.name.clone(),
            errors: plan.errors.iter().map(|path| path.text.clone()).collect(),
            time: plan.time.text.clone(),
            columns: columns(plan, &places),
            rows: plan.runs.iter().zip(results).map(row).collect(),
            groups: plan.groups(),
            good: results.iter().map(Ended::is_good).collect(),
            converged: results.iter().filter(|ended| ended.status == RunStatus::Converged).count(),
            machines: once(results.iter().map(|ended| ended.machine.as_str())),
            blas: once(results.iter().filter_map(|ended| ended.summary["solver"]["blas"].as_str())),
        }
    }

    /// Whether any run is made more than once.
    pub fn is_repeated(&self) -> bool {
        self.groups.iter().any(|group| group.len() > 1)
    }

    /// Where a column of this name stands in a row.
    pub fn place(&self, name: &str) -> Option<usize> {
        self.columns.iter().position(|column| column.name == name)
    }

    /// How the run of a row ended.
    pub fn status(&self, row: usize) -> &str {
        self.place("status").and_then(|at| self.rows[row][at].as_str()).unwrap_or_default()
    }

    /// Whether the run of a row converged.
    pub fn is_converged(&self, row: usize) -> bool {
        self.status(row) == RunStatus::Converged.words()
    }
}

/// All columns; in the order of [`of_plan`], [`of_result`], the places in `summary.json`, and the folder of the result.
fn columns(plan: &Plan, places: &[(SummaryPath, ColumnKind)]) -> Vec<Column> {
    let repeated = plan.runs.iter().any(|run| run.repeat > 1);
    let column = |&(name, kind): &(&str, ColumnKind)| Column::new(name, kind);
    let (given, main, detail) = (ColumnKind::Given, ColumnKind::Main, ColumnKind::Detail);
    let of_plan = [("case", given), ("curve", given), ("ranks", given), ("repeat", if repeated { given } else { detail })];
    let of_result = [
        ("status", main),
        ("reason", main),
        ("unknowns", main),
        ("multipliers", main),
        ("krylov_iterations", main),
        ("outer_iterations", main),
        ("wall_s", detail),
        ("error", main),
    ];
    let keys = plan.keys.iter().map(|key| Column::new(key, given));
    let places = places.iter().map(|(place, kind)| Column::new(&place.text, *kind));
    let result = Column::new("result", detail);
    of_plan.iter().map(column).chain(keys).chain(of_result.iter().map(column)).chain(places).chain([result]).collect()
}

/// What the study says of a run.
fn of_plan(planned: &PlannedRun) -> Vec<Value> {
    let curve = planned.curve.as_deref().map_or(Value::Null, text);
    let values = planned.values.iter().map(|value| serde_json::to_value(value).unwrap_or_default());
    [text(&planned.case), curve, planned.ranks.into(), planned.repeat.into()].into_iter().chain(values).collect()
}

/// What became of it, in the columns that are no places in `summary.json`.
fn of_result(plan: &Plan, ended: &Ended) -> [Value; 8] {
    let summary = &ended.summary;
    let krylov = summary["solver"]["iterations"].as_array().map(|list| list.iter().filter_map(Value::as_u64).sum::<u64>());
    let outer = summary["outer"].as_array().map(Vec::len);
    [
        ended.status.words().into(),
        text(&ended.reason),
        summary["unknowns"]["displacement"].clone(),
        summary["unknowns"]["multiplier"].clone(),
        krylov.into(),
        outer.into(),
        ended.wall.as_secs_f64().into(),
        plan.errors.first().map_or(Value::Null, |path| path.of(summary)),
    ]
}

/// Places in `summary.json` that have a column: those that every study has, errors, balances and contacts that any of the
/// results has, and those that the study asks for.
fn places(plan: &Plan, results: &[Ended]) -> Vec<(SummaryPath, ColumnKind)> {
    let (main, detail) = (ColumnKind::Main, ColumnKind::Detail);
    let mut places = vec![
        (SummaryPath::new(&["time_s", "solve"]), main),
        (SummaryPath::new(&["time_s", "total"]), main),
        (SummaryPath::new(&["memory_mib", "max_rank"]), detail),
        (SummaryPath::new(&["memory_mib", "sum"]), detail),
        (SummaryPath::new(&["energy", "total"]), detail),
    ];
    for table in ["errors", "balance"] {
        places.extend(names(results, table).iter().map(|name| (SummaryPath::new(&[table, name]), detail)));
    }
    for contact in names(results, "contact") {
        places.extend(CONTACT.map(|figure| (SummaryPath::new(&["contact", contact, figure]), main)));
    }
    for path in plan.errors.iter().skip(1).chain([&plan.time]).chain(&plan.columns) {
        match places.iter_mut().find(|(place, _)| place == path) {
            Some((_, kind)) => *kind = main,
            None => places.push((path.clone(), main)),
        }
    }
    places
}

/// Names that any result has in a table of its summary.
fn names<'a>(results: &'a [Ended], table: &str) -> BTreeSet<&'a str> {
    let tables = results.iter().filter_map(|ended| ended.summary[table].as_object());
    tables.flat_map(|table| table.keys()).map(String::as_str).collect()
}

/// Words in their order, each once, and no empty ones.
fn once<'a>(words: impl Iterator<Item = &'a str>) -> Vec<String> {
    let mut found: Vec<String> = Vec::new();
    for word in words.filter(|word| !word.is_empty()) {
        if !found.iter().any(|other| other == word) {
            found.push(word.into());
        }
    }
    found
}

/// Null if empty.
fn text(words: &str) -> Value {
    if words.is_empty() { Value::Null } else { words.into() }
}

#[cfg(test)]
mod tests;
