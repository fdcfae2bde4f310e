//! The runs of a study as rows.

use std::collections::BTreeSet;
use std::ops::Range;

use serde::Deserialize;
use serde_json::Value;

use crate::output::Units;
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
    /// For each row, how its run ended.
    pub statuses: Vec<RunStatus>,
    /// For each row, whether its reason goes without saying.
    pub good: Vec<bool>,
    /// Where the runs were made, each machine once.
    pub machines: Vec<String>,
    /// The BLAS that they used, each once.
    pub blas: Vec<String>,
    /// The units that all results are in; none where they differ.
    pub units: Units,
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
        let is_repeated = plan.runs.iter().any(|run| run.repeat > 1);
        let all = plan.runs.iter().zip(results);
        let rows: Vec<Vec<NamedCell>> = all.map(|(run, ended)| cells(plan, &places, is_repeated, run, ended)).collect();
        let column = |(name, kind, _): &NamedCell| Column::new(name, *kind);
        Self {
            study: plan.name.clone(),
            errors: plan.errors.iter().map(|path| path.text.clone()).collect(),
            time: plan.time.text.clone(),
            columns: rows.first().into_iter().flatten().map(column).collect(),
            rows: rows.into_iter().map(|row| row.into_iter().map(|(.., value)| value).collect()).collect(),
            groups: plan.groups(),
            statuses: results.iter().map(|ended| ended.status).collect(),
            good: results.iter().map(Ended::is_good).collect(),
            machines: once(results.iter().map(|ended| ended.machine.as_str())),
            blas: once(results.iter().filter_map(|ended| ended.summary["solver"]["blas"].as_str())),
            units: common_units(results),
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

    /// Those of some rows whose runs converged.
    pub fn converged(&self, rows: Range<usize>) -> impl Iterator<Item = usize> {
        rows.filter(|&row| self.statuses[row] == RunStatus::Converged)
    }
}

/// The units of all runs that have a result, if they are the same.
fn common_units(results: &[Ended]) -> Units {
    let mut all = results.iter().filter(|ended| !ended.summary.is_null()).map(|ended| &ended.summary["units"]);
    let first = all.next().filter(|first| all.all(|other| other == *first));
    first.and_then(|units| Units::deserialize(units).ok()).unwrap_or_default()
}

/// A value of a row, with the name of its column and what that is for a reader.
type NamedCell<'a> = (&'a str, ColumnKind, Value);

/// The row of a run: what the study says of it, what became of it, places in its summary, and its folder.
fn cells<'a>(
    plan: &'a Plan,
    places: &'a [(SummaryPath, ColumnKind)],
    is_repeated: bool,
    run: &PlannedRun,
    ended: &Ended,
) -> Vec<NamedCell<'a>> {
    let (given, main, detail) = (ColumnKind::Given, ColumnKind::Main, ColumnKind::Detail);
    let Ended { summary, .. } = ended;
    let mut cells = vec![
        ("case", given, text(&run.case)),
        ("curve", given, run.curve.as_deref().map_or(Value::Null, text)),
        ("ranks", given, run.ranks.into()),
        ("repeat", if is_repeated { given } else { detail }, run.repeat.into()),
    ];
    let moved = plan.keys.iter().zip(&run.values);
    cells.extend(moved.map(|(key, value)| (key.as_str(), given, serde_json::to_value(value).unwrap_or_default())));
    cells.extend([
        ("status", main, ended.status.words().into()),
        ("reason", main, text(&ended.reason)),
        ("unknowns", main, summary["unknowns"]["displacement"].clone()),
        ("multipliers", main, summary["unknowns"]["multiplier"].clone()),
        ("krylov_iterations", main, krylov_iterations(summary).into()),
        ("outer_iterations", main, summary["outer"].as_array().map(Vec::len).into()),
        ("wall_s", detail, ended.wall_s.into()),
        ("error", main, plan.errors.first().map_or(Value::Null, |path| path.of(summary))),
    ]);
    cells.extend(places.iter().map(|(place, kind)| (place.text.as_str(), *kind, place.of(summary))));
    cells.push(("result", detail, text(&ended.result)));
    cells
}

/// Of all linear solves.
pub fn krylov_iterations(summary: &Value) -> Option<u64> {
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
            wall_s: 0.5,
            timeout_s: 1.0,
            machine: "here".into(),
            result: String::new(),
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
        assert_eq!(table.converged(0..2).collect::<Vec<_>>(), [0]);
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
