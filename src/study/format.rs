//! A table as CSV, JSON and Markdown.

use serde::ser::{Serialize, SerializeStruct, Serializer};
use serde_json::Value;

use super::table::{Column, Kind, Table};

/// Comma-separated values: names of the columns, then one line per run. What is not known is empty.
pub fn csv(table: &Table) -> String {
    let line = |cells: Vec<String>| cells.join(",") + "\n";
    let header = line(table.columns.iter().map(|column| quote(&column.name)).collect());
    let rows = table.rows.iter().map(|row| line(row.iter().map(|value| quote(&plain(value))).collect()));
    header + &rows.collect::<String>()
}

/// An object with the rows as a list of objects, whose keys are the names of the columns.
pub fn json(table: &Table) -> String {
    serde_json::to_string_pretty(table).expect("a table of JSON values is JSON") + "\n"
}

/// A page to read: main columns that are not empty, results to four digits, reasons at the end and not of good runs.
pub fn markdown(table: &Table) -> String {
    let reason = table.columns.iter().position(|column| column.name == "reason").expect("a column of every table");
    let cell = |index: usize, column: usize| match (table.columns[column].kind, &table.rows[index][column]) {
        _ if column == reason && table.good[index] => String::new(),
        (Kind::Given, value) => escape(&plain(value)),
        (_, value) => escape(&rounded(value)),
    };
    let order = (0..table.columns.len()).filter(|&column| column != reason).chain([reason]);
    let main = order.filter(|&column| table.columns[column].kind != Kind::Detail);
    let shown: Vec<usize> = main.filter(|&column| (0..table.rows.len()).any(|index| !cell(index, column).is_empty())).collect();
    let line = |cells: Vec<String>| format!("| {} |\n", cells.join(" | "));
    let header = line(shown.iter().map(|&column| escape(&table.columns[column].name)).collect());
    let rows = (0..table.rows.len()).map(|index| line(shown.iter().map(|&column| cell(index, column)).collect()));
    let error = table.error.as_ref().map_or(String::new(), |path| format!(" The column error is `{path}`."));
    format!(
        "# Study {}\n\n{} runs, {} converged; mezha {}.{error} All columns and digits stand in study.csv and study.json.\n\n{header}|{}\n{}",
        table.study,
        table.rows.len(),
        table.converged,
        env!("CARGO_PKG_VERSION"),
        "---|".repeat(shown.len()),
        rows.collect::<String>()
    )
}

impl Serialize for Table {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let rows: Vec<Row> = self.rows.iter().map(|cells| Row { columns: &self.columns, cells }).collect();
        let mut object = serializer.serialize_struct("Table", 5)?;
        object.serialize_field("mezha", env!("CARGO_PKG_VERSION"))?;
        object.serialize_field("study", &self.study)?;
        object.serialize_field("error", &self.error)?;
        object.serialize_field("columns", &self.columns.iter().map(|column| &column.name).collect::<Vec<_>>())?;
        object.serialize_field("rows", &rows)?;
        object.end()
    }
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
fn plain(value: &Value) -> String {
    match value {
        Value::Null => String::new(),
        Value::String(text) => text.clone(),
        other => other.to_string(),
    }
}

/// A cell of RFC 4180.
fn quote(text: &str) -> String {
    if text.contains([',', '"', '\n', '\r']) { format!("\"{}\"", text.replace('"', "\"\"")) } else { text.into() }
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
    use serde_json::json;

    fn table() -> Table {
        let row = |cells: Value| cells.as_array().unwrap().clone();
        Table {
            study: "hard".into(),
            error: Some("errors.energy".into()),
            columns: [
                ("case", Kind::Given),
                ("status", Kind::Main),
                ("reason", Kind::Main),
                ("error", Kind::Main),
                ("contact.\"a,b\".trust", Kind::Main),
                ("wall_s", Kind::Detail),
            ]
            .map(|(name, kind)| Column::new(name, kind))
            .to_vec(),
            rows: vec![
                row(json!(["bars", "converged", "residual", 0.1 + 0.2, null, 1.5])),
                row(json!(["bars, \"bent\"", "failed", "a | b\nc", null, null, 2.5])),
            ],
            good: vec![true, false],
            converged: 1,
        }
    }

    #[test]
    fn csv_is_quoted_and_exact() {
        let expected = concat!(
            "case,status,reason,error,\"contact.\"\"a,b\"\".trust\",wall_s\n",
            "bars,converged,residual,0.30000000000000004,,1.5\n",
            "\"bars, \"\"bent\"\"\",failed,\"a | b\nc\",,,2.5\n"
        );
        assert_eq!(csv(&table()), expected);
    }

    #[test]
    fn json_keeps_the_columns_in_order_and_null() {
        let text = json(&table());
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
}
