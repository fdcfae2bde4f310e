//! Repeats of a run put together: medians, and how far the repeats lie apart.

use std::ops::Range;

use serde::Serialize;
use serde_json::Value;

use super::rows::{Column, ColumnKind, Table};
use crate::study::plan::Plan;

/// What repeats say of one number.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Spread {
    /// Half of the values are at most this, half at least; the mean of both middle ones if their number is even.
    pub median: f64,
    /// The smallest.
    pub least: f64,
    /// The largest.
    pub most: f64,
}

impl Spread {
    /// Of at least one value.
    pub fn of(mut values: Vec<f64>) -> Option<Self> {
        values.sort_by(f64::total_cmp);
        let (least, most) = (*values.first()?, *values.last()?);
        let (low, high) = (values[(values.len() - 1) / 2], values[values.len() / 2]);
        Some(Self { median: 0.5 * (low + high), least, most })
    }
}

/// A table with the spreads of its times, if runs are repeated.
pub fn with_spreads(mut table: Table, plan: &Plan) -> Table {
    if table.is_repeated() {
        let mut timed = vec!["wall_s", "time_s.solve", "time_s.total"];
        if !timed.contains(&plan.time.text.as_str()) {
            timed.push(&plan.time.text);
        }
        add_spreads(&mut table, &timed);
    }
    table
}

/// Beside each of these columns come `.median`, `.least` and `.most` of the repeats that converged, the same in all of them.
pub fn add_spreads(table: &mut Table, names: &[&str]) {
    for name in names {
        let Some(at) = table.place(name) else { continue };
        let mut spreads = vec![[Value::Null, Value::Null, Value::Null]; table.rows.len()];
        for group in table.groups.clone() {
            let values = table.converged(group.clone()).filter_map(|row| table.rows[row][at].as_f64());
            if let Some(spread) = Spread::of(values.collect()) {
                spreads[group].fill([spread.median, spread.least, spread.most].map(Value::from));
            }
        }
        for (row, spread) in table.rows.iter_mut().zip(spreads) {
            row.splice(at + 1..at + 1, spread);
        }
        let columns = ["median", "least", "most"].map(|of| Column::new(&format!("{name}.{of}"), ColumnKind::Detail));
        table.columns.splice(at + 1..at + 1, columns);
    }
}

/// One row for all repeats of a run: that of the first one that converged, with medians, and with the status and the reason of
/// the worst one. The column `repeat` says how many there are, and if not all converged, how many did.
pub fn condensed(table: &Table) -> Table {
    let worst = |group: &Range<usize>| {
        let severity = |row: &usize| (table.statuses[*row], usize::MAX - row);
        group.clone().max_by_key(severity).unwrap_or(group.start)
    };
    // Columns of the summary may have these names, too: the first ones are those of the run.
    let [status, reason, repeat] = ["status", "reason", "repeat"].map(|name| table.place(name));
    let row = |group: &Range<usize>| {
        let first = table.converged(group.clone()).next().unwrap_or(group.start);
        let mut cells = table.rows[first].clone();
        for (at, column) in table.columns.iter().enumerate() {
            let median = table.place(&format!("{}.median", column.name));
            match Some(at) {
                place if place == status || place == reason => cells[at] = table.rows[worst(group)][at].clone(),
                place if place == repeat => {
                    cells[at] = match (table.converged(group.clone()).count(), group.len()) {
                        (converged, all) if all == converged => all.into(),
                        (converged, all) => format!("{converged} of {all}").into(),
                    }
                }
                _ => median.into_iter().for_each(|median| cells[at] = table.rows[first][median].clone()),
            }
        }
        cells
    };
    Table {
        rows: table.groups.iter().map(row).collect(),
        statuses: table.groups.iter().map(|group| table.statuses[worst(group)]).collect(),
        good: table.groups.iter().map(|group| group.clone().all(|row| table.good[row])).collect(),
        groups: (0..table.groups.len()).map(|row| row..row + 1).collect(),
        ..table.clone()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::runs::ended::RunStatus::{Converged, Failed};
    use serde_json::json;

    #[test]
    fn medians_and_extremes() {
        let of = |values: &[f64]| Spread::of(values.to_vec()).map(|spread| [spread.least, spread.median, spread.most]);
        assert_eq!(of(&[]), None);
        assert_eq!(of(&[3.0]), Some([3.0, 3.0, 3.0]));
        assert_eq!(of(&[3.0, 1.0, 100.0]), Some([1.0, 3.0, 100.0]));
        assert_eq!(of(&[4.0, 1.0, 2.0, 100.0]), Some([1.0, 3.0, 100.0]));
    }

    /// Three repeats of one run, of which the second failed, and a single one that converged.
    fn table() -> Table {
        let columns = [
            ("case", ColumnKind::Given),
            ("repeat", ColumnKind::Given),
            ("status", ColumnKind::Main),
            ("reason", ColumnKind::Main),
        ];
        let columns = columns.into_iter().chain([("time_s.total", ColumnKind::Main), ("error", ColumnKind::Main)]);
        let row = |cells: Value| cells.as_array().unwrap().clone();
        Table {
            columns: columns.map(|(name, kind)| Column::new(name, kind)).collect(),
            rows: vec![
                row(json!(["bars", 1, "converged", "fine", 3.0, 0.1])),
                row(json!(["bars", 2, "failed", "killed", null, null])),
                row(json!(["bars", 3, "converged", "fine", 1.0, 0.1])),
                row(json!(["rings", 1, "converged", "fine", 7.0, 0.2])),
            ],
            groups: vec![0..3, 3..4],
            statuses: vec![Converged, Failed, Converged, Converged],
            good: vec![true, false, true, true],
            ..Table::default()
        }
    }

    #[test]
    fn spreads_stand_beside_each_repeat() {
        let mut table = table();
        add_spreads(&mut table, &["time_s.total", "nothing"]);
        let names: Vec<&str> = table.columns.iter().map(|column| column.name.as_str()).collect();
        assert_eq!(names[4..], ["time_s.total", "time_s.total.median", "time_s.total.least", "time_s.total.most", "error"]);
        for row in &table.rows[..3] {
            assert_eq!(row[5..8], [json!(2.0), json!(1.0), json!(3.0)]);
        }
        assert_eq!(table.rows[3][4..8], [json!(7.0), json!(7.0), json!(7.0), json!(7.0)]);
        assert_eq!(table.rows[1][4], Value::Null);
    }

    #[test]
    fn repeats_are_one_row_to_read() {
        let mut table = table();
        add_spreads(&mut table, &["time_s.total"]);
        let condensed = condensed(&table);
        assert_eq!(condensed.rows.len(), 2);
        assert_eq!(condensed.rows[0][..5], [json!("bars"), json!("2 of 3"), json!("failed"), json!("killed"), json!(2.0)]);
        assert_eq!(condensed.rows[0][8], json!(0.1), "numbers of a run that converged");
        assert_eq!(condensed.rows[1][..5], [json!("rings"), json!(1), json!("converged"), json!("fine"), json!(7.0)]);
        assert_eq!(condensed.good, [false, true]);
    }
}
