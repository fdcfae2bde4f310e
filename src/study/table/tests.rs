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
    let at =
        table.columns.iter().position(|other| other.name == column).unwrap_or_else(|| panic!("{column}: {:?}", table.columns));
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
