//! A table as CSV, JSON and Markdown.

use serde::{Serialize, Serializer};
use serde_json::Value;

use crate::output::{csv_line, quoted};
use crate::study::table::lines::Line;
use crate::study::table::repeats::condensed;
use crate::study::table::rows::{Column, ColumnKind, Table};

/// Comma-separated values: names of the columns, then one line per run. What is not known is empty.
pub fn csv(table: &Table) -> String {
    let header = table.columns.iter().map(|column| quoted(&column.name)).collect();
    let rows = table.rows.iter().map(|row| row.iter().map(|value| quoted(&plain(value))).collect());
    [header].into_iter().chain(rows).map(|cells: Vec<String>| csv_line(&cells)).collect()
}

/// An object with the rows as a list of objects, whose keys are the names of the columns, and the lines of the figure.
pub fn json(table: &Table, lines: &[Line]) -> String {
    let Table { study, machines, blas, errors, time, columns, rows, .. } = table;
    let rows = rows.iter().map(|cells| Row { columns, cells }).collect();
    let (error, names) = (errors.first(), columns.iter().map(|column| column.name.as_str()).collect());
    let mezha = env!("CARGO_PKG_VERSION");
    let whole = WholeStudy { mezha, study, machines, blas, error, errors, time, columns: names, rows, lines };
    serde_json::to_string_pretty(&whole).expect("tables of JSON values are JSON") + "\n"
}

/// The table for people, of one with a row per run: names of the columns, with units, and one row for all repeats of a run. Main columns
/// that are not empty, results to four digits, reasons at the end and not of good runs.
pub fn readable(table: &Table) -> (Vec<String>, Vec<Vec<String>>) {
    let table = condensed(table);
    let reason = table.place("reason").expect("a column of every table");
    let cell = |row: usize, column: usize| match (table.columns[column].kind, &table.rows[row][column]) {
        _ if column == reason && table.good[row] => String::new(),
        (ColumnKind::Given, value) => plain(value),
        (_, value) => rounded(value) + &spread(&table, row, column),
    };
    let order = (0..table.columns.len()).filter(|&column| column != reason).chain([reason]);
    let main = order.filter(|&column| table.columns[column].kind != ColumnKind::Detail);
    let is_empty = |column: usize| (0..table.rows.len()).all(|row| cell(row, column).is_empty());
    let shown: Vec<usize> = main.filter(|&column| !is_empty(column)).collect();
    let header = shown.iter().map(|&column| table.units.of_place(&table.columns[column].name)).collect();
    (header, (0..table.rows.len()).map(|row| shown.iter().map(|&column| cell(row, column)).collect()).collect())
}

/// How many runs there are and where they were made, in sentences.
pub fn about(table: &Table) -> Vec<String> {
    let (runs, converged) = (table.rows.len(), table.converged(0..table.rows.len()).count());
    let mut words = vec![format!("{runs} runs, {converged} converged; mezha {}.", env!("CARGO_PKG_VERSION"))];
    words.push(format!("Made on {}; BLAS: {}.", table.machines.join("; "), table.blas.join("; ")));
    if table.machines.len() > 1 {
        words.push("Times of several machines do not compare.".into());
    }
    if let Some(path) = table.errors.first() {
        words.push(format!("The column error is {path}."));
    }
    if table.is_repeated() {
        words.push("Times are medians of the repeats that converged, with the smallest and the largest.".into());
    }
    words.push("All columns and digits stand in study.csv and study.json.".into());
    words
}

/// A page to read.
pub fn markdown(table: &Table) -> String {
    let (header, rows) = readable(table);
    let line = |cells: &Vec<String>| format!("| {} |\n", cells.iter().map(|cell| escape(cell)).collect::<Vec<_>>().join(" | "));
    format!(
        "# Study {}\n\n{}\n\n{}|{}\n{}",
        table.study,
        about(table).join(" "),
        line(&header),
        "---|".repeat(header.len()),
        rows.iter().map(line).collect::<String>()
    )
}

/// ` (smallest – largest)` where repeats differ.
fn spread(table: &Table, row: usize, column: usize) -> String {
    let of = |what: &str| table.place(&format!("{}.{what}", table.columns[column].name)).map(|at| &table.rows[row][at]);
    match (of("least"), of("most")) {
        (Some(least), Some(most)) if !least.is_null() && least != most => format!(" ({} – {})", rounded(least), rounded(most)),
        _ => String::new(),
    }
}

/// Everything that `study.json` holds.
#[derive(Serialize)]
struct WholeStudy<'a> {
    mezha: &'a str,
    study: &'a str,
    machines: &'a [String],
    blas: &'a [String],
    error: Option<&'a String>,
    errors: &'a [String],
    time: &'a str,
    columns: Vec<&'a str>,
    rows: Vec<Row<'a>>,
    lines: &'a [Line],
}

/// A row that keeps the order of the columns.
struct Row<'a> {
    columns: &'a [Column],
    cells: &'a [Value],
}

impl Serialize for Row<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.columns.iter().map(|column| &column.name).zip(self.cells))
    }
}

/// A value without the quotes of JSON; null is empty.
pub fn plain(value: &Value) -> String {
    match value {
        Value::Null => String::new(),
        Value::String(text) => text.clone(),
        other => other.to_string(),
    }
}

/// A value for people: four digits.
fn rounded(value: &Value) -> String {
    match value.as_f64() {
        Some(number) if value.is_f64() && number != 0.0 => match number.abs() {
            1e-2..1e4 => {
                let decimals = (3 - number.abs().log10().floor() as i32).max(0) as usize;
                format!("{number:.decimals$}")
            }
            _ => format!("{number:.3e}"),
        },
        Some(_) if value.is_f64() => "0".into(),
        _ => plain(value),
    }
}

/// Text that does not break a table of Markdown.
fn escape(text: &str) -> String {
    text.replace('\\', "\\\\").replace('|', "\\|").split_whitespace().collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::Units;
    use crate::study::runs::ended::RunStatus;
    use serde_json::json;

    fn table() -> Table {
        let row = |cells: Value| cells.as_array().unwrap().clone();
        Table {
            study: "hard".into(),
            errors: vec!["errors.energy".into()],
            time: "time_s.total".into(),
            columns: [
                ("case", ColumnKind::Given),
                ("repeat", ColumnKind::Detail),
                ("status", ColumnKind::Main),
                ("reason", ColumnKind::Main),
                ("error", ColumnKind::Main),
                ("contact.\"a,b\".trust", ColumnKind::Main),
                ("wall_s", ColumnKind::Detail),
            ]
            .map(|(name, kind)| Column::new(name, kind))
            .to_vec(),
            rows: vec![
                row(json!(["bars", 1, "converged", "residual", 0.1 + 0.2, null, 1.5])),
                row(json!(["bars, \"bent\"", 1, "failed", "a | b\nc", null, null, 2.5])),
            ],
            groups: vec![0..1, 1..2],
            good: vec![true, false],
            statuses: vec![RunStatus::Converged, RunStatus::Failed],
            machines: vec!["Great CPU, 2 cores, 24 GiB".into()],
            blas: vec!["OpenBLAS".into()],
            units: Units::default(),
        }
    }

    #[test]
    fn csv_is_quoted_and_exact() {
        let expected = concat!(
            "case,repeat,status,reason,error,\"contact.\"\"a,b\"\".trust\",wall_s\n",
            "bars,1,converged,residual,0.30000000000000004,,1.5\n",
            "\"bars, \"\"bent\"\"\",1,failed,\"a | b\nc\",,,2.5\n"
        );
        assert_eq!(csv(&table()), expected);
    }

    #[test]
    fn json_keeps_the_columns_in_order_and_null() {
        let text = json(&table(), &[]);
        let value: Value = serde_json::from_str(&text).unwrap();
        assert_eq!(value["rows"][0]["error"], json!(0.1 + 0.2));
        assert_eq!(value["rows"][1]["error"], Value::Null);
        assert_eq!((&value["error"], &value["study"]), (&json!("errors.energy"), &json!("hard")));
        let places: Vec<usize> = ["\"case\": ", "\"status\": ", "\"reason\": "].map(|key| text.find(key).unwrap()).to_vec();
        assert!(places.is_sorted());
    }

    #[test]
    fn markdown_is_a_page_to_read() {
        let text = markdown(&table());
        assert!(text.starts_with("# Study hard\n\n2 runs, 1 converged; mezha "), "{text}");
        assert!(text.contains("Made on Great CPU, 2 cores, 24 GiB; BLAS: OpenBLAS.") && !text.contains("medians"), "{text}");
        let lines: Vec<&str> = text.lines().skip_while(|line| !line.starts_with('|')).collect();
        let expected = [
            "| case | status | error | reason |",
            "|---|---|---|---|",
            "| bars | converged | 0.3000 |  |",
            "| bars, \"bent\" | failed |  | a \\| b c |",
        ];
        assert_eq!(lines, expected);
    }

    #[test]
    fn numbers_for_people_have_four_digits() {
        let table = [
            (json!(1234.56), "1235"),
            (json!(1.0), "1.000"),
            (json!(-0.012345), "-0.01235"),
            (json!(1e-9), "1.000e-9"),
            (json!(123456.0), "1.235e5"),
            (json!(0.0), "0"),
            (json!(123456), "123456"),
            (json!(true), "true"),
            (json!([1, 2]), "[1,2]"),
            (json!(null), ""),
        ];
        for (value, words) in table {
            assert_eq!(rounded(&value), words);
        }
    }

    /// The first run made three times, with different times.
    fn repeated() -> Table {
        let mut table = table();
        table
            .rows
            .splice(1..1, [1.0, 2.5].map(|time| table.rows[0].iter().take(6).cloned().chain([time.into()]).collect()).to_vec());
        (table.groups, table.good) = (vec![0..3, 3..4], vec![true, true, true, false]);
        table.statuses.splice(1..1, [RunStatus::Converged; 2]);
        table.columns[6].kind = ColumnKind::Main;
        crate::study::table::repeats::add_spreads(&mut table, &["wall_s"]);
        table
    }

    #[test]
    fn repeats_are_one_row_with_median_and_extremes() {
        let text = markdown(&repeated());
        assert!(text.contains("4 runs") && text.contains("Times are medians of the repeats that converged"), "{text}");
        assert!(text.contains("| bars | converged | 0.3000 | 1.500 (1.000 – 2.500) |  |\n"), "{text}");
        assert!(text.contains("| bars, \"bent\" | failed |  |  | a \\| b c |\n"), "{text}");
    }
}
