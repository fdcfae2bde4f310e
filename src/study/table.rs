//! The runs of a study as rows.

use std::collections::BTreeSet;

use serde_json::Value;

use super::execution::{Ended, Status};
use super::plan::{Plan, PlannedRun};
use super::summary_path::SummaryPath;

/// Figures of each contact.
const CONTACT: [&str; 4] = ["force", "inf_sup", "oscillation", "trust"];

/// One row per run; what is not known is null.
#[derive(Clone, Debug)]
pub struct Table {
    /// Name of the study.
    pub study: String,
    /// Where the error axis stands in `summary.json`.
    pub error: Option<String>,
    /// Names of the columns.
    pub columns: Vec<String>,
    /// As many values as columns each.
    pub rows: Vec<Vec<Value>>,
    /// Number of runs that converged.
    pub converged: usize,
}

impl Table {
    /// Puts the results of all runs side by side, in the order of the plan.
    pub fn new(plan: &Plan, results: &[Ended]) -> Self {
        let mut columns: Vec<String> = ["case", "curve", "ranks", "repeat"].map(String::from).to_vec();
        columns.extend(plan.keys.iter().cloned());
        columns.extend(
            ["status", "reason", "unknowns", "multipliers", "krylov_iterations", "outer_iterations", "wall_s", "error"]
                .map(String::from),
        );
        let paths = summary_columns(plan, results);
        columns.extend(paths.iter().map(|path| path.text.clone()));
        columns.push("result".into());
        let row = |(planned, ended): (&PlannedRun, &Ended)| {
            let mut cells = of_plan(planned);
            cells.extend(of_result(plan, ended));
            cells.extend(paths.iter().map(|path| path.of(&ended.summary)));
            cells.push(text(&ended.result));
            cells
        };
        Self {
            study: plan.name.clone(),
            error: plan.error.as_ref().map(|path| path.text.clone()),
            columns,
            rows: plan.runs.iter().zip(results).map(row).collect(),
            converged: results.iter().filter(|ended| ended.status == Status::Converged).count(),
        }
    }
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
        plan.error.as_ref().map_or(Value::Null, |path| path.of(summary)),
    ]
}

/// Places in `summary.json` that have a column: those that every study has, errors, balances and contacts that any of the
/// results has, and those that the study asks for.
fn summary_columns(plan: &Plan, results: &[Ended]) -> Vec<SummaryPath> {
    let mut paths: Vec<SummaryPath> =
        [["time_s", "solve"], ["time_s", "total"], ["memory_mib", "max_rank"], ["memory_mib", "sum"], ["energy", "U"]]
            .iter()
            .map(|names| SummaryPath::new(names))
            .collect();
    for table in ["errors", "balance"] {
        paths.extend(names(results, table).iter().map(|name| SummaryPath::new(&[table, name])));
    }
    for contact in names(results, "contact") {
        paths.extend(CONTACT.map(|figure| SummaryPath::new(&["contact", contact, figure])));
    }
    for path in &plan.columns {
        if !paths.contains(path) {
            paths.push(path.clone());
        }
    }
    paths
}

/// Names that any result has in a table of its summary.
fn names<'a>(results: &'a [Ended], table: &str) -> BTreeSet<&'a str> {
    let tables = results.iter().filter_map(|ended| ended.summary[table].as_object());
    tables.flat_map(|table| table.keys()).map(String::as_str).collect()
}

/// Null if empty.
fn text(words: &str) -> Value {
    if words.is_empty() { Value::Null } else { words.into() }
}

#[cfg(test)]
mod tests;
