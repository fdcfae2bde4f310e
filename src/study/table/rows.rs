//! The runs of a study as rows.

use std::collections::BTreeSet;
use std::ops::Range;

use serde_json::Value;

use crate::study::plan::Plan;
use crate::study::plan::planned::PlannedRun;
use crate::study::plan::summary_path::SummaryPath;
use crate::study::runs::ended::{Ended, RunStatus};

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
        let (columns, cells): (Vec<Column>, Vec<CellOf>) = columns(plan, results).into_iter().unzip();
        let row = |(run, ended): (&PlannedRun, &Ended)| cells.iter().map(|cell| cell(run, ended)).collect();
        Self {
            study: plan.name.clone(),
            errors: plan.errors.iter().map(|path| path.text.clone()).collect(),
            time: plan.time.text.clone(),
            rows: plan.runs.iter().zip(results).map(row).collect(),
            groups: plan.groups(),
            good: results.iter().map(Ended::is_good).collect(),
            converged: results.iter().filter(|ended| ended.status == RunStatus::Converged).count(),
            machines: once(results.iter().map(|ended| ended.machine.as_str())),
            blas: once(results.iter().filter_map(|ended| ended.summary["solver"]["blas"].as_str())),
            columns,
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

/// What stands in a column for a run.
type CellOf<'a> = Box<dyn Fn(&PlannedRun, &Ended) -> Value + 'a>;

/// A column by its name and kind, and what stands in it for a run, as it is planned or as it ended.
type NamedCell<T> = (&'static str, ColumnKind, fn(&T) -> Value);

/// All columns, each with its cells: what the study says of a run, what became of it, places in its summary, and its folder.
fn columns<'a>(plan: &'a Plan, results: &[Ended]) -> Vec<(Column, CellOf<'a>)> {
    let (given, main, detail) = (ColumnKind::Given, ColumnKind::Main, ColumnKind::Detail);
    let repeat = if plan.runs.iter().any(|run| run.repeat > 1) { given } else { detail };
    let of_plan: [NamedCell<PlannedRun>; 4] = [
        ("case", given, |run| text(&run.case)),
        ("curve", given, |run| run.curve.as_deref().map_or(Value::Null, text)),
        ("ranks", given, |run| run.ranks.into()),
        ("repeat", repeat, |run| run.repeat.into()),
    ];
    let of_result: [NamedCell<Ended>; 7] = [
        ("status", main, |ended| ended.status.words().into()),
        ("reason", main, |ended| text(&ended.reason)),
        ("unknowns", main, |ended| ended.summary["unknowns"]["displacement"].clone()),
        ("multipliers", main, |ended| ended.summary["unknowns"]["multiplier"].clone()),
        ("krylov_iterations", main, |ended| krylov_iterations(&ended.summary).into()),
        ("outer_iterations", main, |ended| ended.summary["outer"].as_array().map(Vec::len).into()),
        ("wall_s", detail, |ended| ended.wall.as_secs_f64().into()),
    ];
    let of_plan =
        of_plan.map(|(name, kind, cell)| (Column::new(name, kind), Box::new(move |run: &_, _: &_| cell(run)) as CellOf));
    let keys = plan.keys.iter().enumerate().map(|(at, key)| {
        let cell = move |run: &PlannedRun, _: &_| serde_json::to_value(&run.values[at]).unwrap_or_default();
        (Column::new(key, given), Box::new(cell) as CellOf)
    });
    let of_result =
        of_result.map(|(name, kind, cell)| (Column::new(name, kind), Box::new(move |_: &_, ended: &_| cell(ended)) as CellOf));
    let error = |_: &_, ended: &Ended| plan.errors.first().map_or(Value::Null, |path| path.of(&ended.summary));
    let places = places(plan, results).into_iter().map(|(place, kind)| {
        let column = Column::new(&place.text, kind);
        (column, Box::new(move |_: &_, ended: &Ended| place.of(&ended.summary)) as CellOf)
    });
    let result = |_: &_, ended: &Ended| text(&ended.result);
    let error = (Column::new("error", main), Box::new(error) as CellOf);
    let result = (Column::new("result", detail), Box::new(result) as CellOf);
    of_plan.into_iter().chain(keys).chain(of_result).chain([error]).chain(places).chain([result]).collect()
}

/// Of all linear solves.
fn krylov_iterations(summary: &Value) -> Option<u64> {
    summary["solver"]["iterations"].as_array().map(|list| list.iter().filter_map(Value::as_u64).sum())
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
pub fn once<'a>(words: impl Iterator<Item = &'a str>) -> Vec<String> {
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
mod tests {
    use std::time::Duration;

    use serde_json::json;

    use super::*;

    /// Two runs of a grid over `mesh.refine`.
    fn plan() -> Plan {
        let run = |refine: i64| PlannedRun {
            file: "bars.toml".into(),
            case: "bars".into(),
            title: String::new(),
            curve: Some("P1/P0".into()),
            ranks: 2,
            repeat: 1,
            values: vec![Some(refine.into())],
            overrides: Vec::new(),
        };
        Plan {
            name: "bars".into(),
            keys: vec!["mesh.refine".into()],
            errors: vec![SummaryPath::parse("errors.energy").unwrap()],
            time: SummaryPath::parse("time_s.total").unwrap(),
            along: vec!["mesh.refine".into()],
            columns: ["errors.energy", "probe.tip.u.1"].map(|path| SummaryPath::parse(path).unwrap()).to_vec(),
            figure: Vec::new(),
            timeout: Duration::from_secs(1),
            runs: vec![run(1), run(2)],
        }
    }

    fn ended(status: RunStatus, summary: Value) -> Ended {
        Ended {
            status,
            reason: "why".into(),
            summary,
            wall: Duration::from_millis(500),
            result: String::new(),
            machine: "here".into(),
        }
    }

    fn summary() -> Value {
        json!({
            "unknowns": { "displacement": 100, "multiplier": 8 },
            "solver": { "iterations": [12, 7] },
            "outer": [{}, {}],
            "errors": { "energy": 1e-3, "force_seam": 2e-9 },
            "balance": { "force": 1e-12, "moment": null },
            "contact": { "seam": { "force": 6.0, "trust": true, "inf_sup": null }, "a.b": { "force": 1.0 } },
            "probe": { "tip": { "u": [3, 4] } },
            "time_s": { "solve": 0.25 },
            "energy": { "total": 2.5 },
        })
    }

    fn cell(table: &Table, row: usize, column: &str) -> Value {
        let at = table
            .columns
            .iter()
            .position(|other| other.name == column)
            .unwrap_or_else(|| panic!("{column}: {:?}", table.columns));
        table.rows[row][at].clone()
    }

    #[test]
    fn a_result_is_a_row() {
        let table = Table::new(&plan(), &[ended(RunStatus::Converged, summary()), ended(RunStatus::Failed, Value::Null)]);
        let expected = [
            ("case", json!("bars")),
            ("curve", json!("P1/P0")),
            ("ranks", json!(2)),
            ("mesh.refine", json!(1)),
            ("status", json!("converged")),
            ("reason", json!("why")),
            ("unknowns", json!(100)),
            ("multipliers", json!(8)),
            ("krylov_iterations", json!(19)),
            ("outer_iterations", json!(2)),
            ("wall_s", json!(0.5)),
            ("error", json!(1e-3)),
            ("errors.energy", json!(1e-3)),
            ("errors.force_seam", json!(2e-9)),
            ("balance.force", json!(1e-12)),
            ("balance.moment", Value::Null),
            ("contact.seam.force", json!(6.0)),
            ("contact.seam.trust", json!(true)),
            ("contact.seam.inf_sup", Value::Null),
            ("contact.seam.oscillation", Value::Null),
            ("contact.\"a.b\".force", json!(1.0)),
            ("probe.tip.u.1", json!(4)),
            ("time_s.solve", json!(0.25)),
            ("time_s.total", Value::Null),
            ("energy.total", json!(2.5)),
        ];
        for (column, value) in expected {
            assert_eq!(cell(&table, 0, column), value, "{column}");
        }
        assert_eq!(table.converged, 1);
    }

    #[test]
    fn a_run_without_a_result_has_its_plan_and_its_reason() {
        let table = Table::new(&plan(), &[ended(RunStatus::Converged, summary()), ended(RunStatus::Timeout, Value::Null)]);
        let known = ["case", "curve", "ranks", "repeat", "mesh.refine", "status", "reason", "wall_s"];
        for (column, value) in table.columns.iter().zip(&table.rows[1]) {
            assert_eq!(value.is_null(), !known.contains(&column.name.as_str()), "{column:?}");
        }
        assert_eq!(cell(&table, 1, "status"), json!("timeout"));
        assert_eq!(cell(&table, 1, "mesh.refine"), json!(2));
    }

    #[test]
    fn every_column_stands_once_and_every_row_is_whole() {
        let table = Table::new(&plan(), &[ended(RunStatus::Converged, summary()), ended(RunStatus::Failed, Value::Null)]);
        let mut columns: Vec<&str> = table.columns.iter().map(|column| column.name.as_str()).collect();
        columns.sort();
        columns.dedup();
        assert_eq!(columns.len(), table.columns.len());
        assert!(table.rows.iter().all(|row| row.len() == table.columns.len()));
    }
}
