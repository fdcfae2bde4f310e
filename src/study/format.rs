//! A table as CSV, JSON and Markdown.

use serde::ser::{Serialize, SerializeStruct, Serializer};
use serde_json::Value;

use super::lines::Line;
use super::repeats::condensed;
use super::table::{Column, ColumnKind, Table};

/// Comma-separated values: names of the columns, then one line per run. What is not known is empty.
pub fn csv(table: &Table) -> String {
    let line = |cells: Vec<String>| cells.join(",") + "\n";
    let header = line(table.columns.iter().map(|column| quote(&column.name)).collect());
    let rows = table.rows.iter().map(|row| line(row.iter().map(|value| quote(&plain(value))).collect()));
    header + &rows.collect::<String>()
}

/// An object with the rows as a list of objects, whose keys are the names of the columns, and the lines of the figure.
pub fn json(table: &Table, lines: &[Line]) -> String {
    serde_json::to_string_pretty(&WholeStudy { table, lines }).expect("tables of JSON values are JSON") + "\n"
}

/// The table for people: repeats in one row, main columns that are not empty, results to four digits, reasons at the end and
/// not of good runs.
pub struct Readable {
    /// Names of the columns.
    pub header: Vec<String>,
    /// One row for all repeats of a run.
    pub rows: Vec<Vec<String>>,
}

impl Readable {
    /// Reads a table with one row per run.
    pub fn new(table: &Table) -> Self {
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
        Self {
            header: shown.iter().map(|&column| table.columns[column].name.clone()).collect(),
            rows: (0..table.rows.len()).map(|row| shown.iter().map(|&column| cell(row, column)).collect()).collect(),
        }
    }
}

/// How many runs there are and where they were made, in sentences.
pub fn about(table: &Table) -> Vec<String> {
    let (runs, converged) = (table.rows.len(), table.converged);
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
    let readable = Readable::new(table);
    let line = |cells: &Vec<String>| format!("| {} |\n", cells.iter().map(|cell| escape(cell)).collect::<Vec<_>>().join(" | "));
    format!(
        "# Study {}\n\n{}\n\n{}|{}\n{}",
        table.study,
        about(table).join(" "),
        line(&readable.header),
        "---|".repeat(readable.header.len()),
        readable.rows.iter().map(line).collect::<String>()
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
struct WholeStudy<'a> {
    table: &'a Table,
    lines: &'a [Line],
}

impl Serialize for WholeStudy<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let table = self.table;
        let rows: Vec<Row> = table.rows.iter().map(|cells| Row { columns: &table.columns, cells }).collect();
        let mut object = serializer.serialize_struct("Study", 10)?;
        object.serialize_field("mezha", env!("CARGO_PKG_VERSION"))?;
        object.serialize_field("study", &table.study)?;
        object.serialize_field("machines", &table.machines)?;
        object.serialize_field("blas", &table.blas)?;
        object.serialize_field("error", &table.errors.first())?;
        object.serialize_field("errors", &table.errors)?;
        object.serialize_field("time", &table.time)?;
        object.serialize_field("columns", &table.columns.iter().map(|column| &column.name).collect::<Vec<_>>())?;
        object.serialize_field("rows", &rows)?;
        object.serialize_field("lines", &self.lines)?;
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
mod tests;
