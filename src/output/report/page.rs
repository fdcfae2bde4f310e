//! What a page is made of, its tables and what stands in their cells.

use crate::output::markup::{NOT_TRUSTED, TRUSTED, UNKNOWN, UNTOLD, paragraph, table};
use crate::output::plot::{grouped, number_text, number_to};
use crate::output::summary::Summary;
use std::collections::BTreeSet;

/// What a report tells of, beside the figures in the folder of the result.
#[derive(Clone, Copy, Debug)]
pub struct ReportPage<'a> {
    /// Title of the case; may be empty.
    pub title: &'a str,
    /// All numbers.
    pub summary: &'a Summary,
    /// The values that the case expects.
    pub expected: &'a [ExpectedValue],
    /// Names of contacts, each with those of both bodies.
    pub contacts: &'a [(String, [String; 2])],
    /// What was warned of.
    pub warnings: &'a [String],
    /// The case as it ran.
    pub case: &'a str,
}

impl<'a> ReportPage<'a> {
    /// The contacts that are told one by one.
    pub fn told(&self) -> impl Iterator<Item = &'a (String, [String; 2])> {
        let told: BTreeSet<&str> = self.summary.told().into_iter().collect();
        self.contacts.iter().filter(move |(name, _)| told.contains(name.as_str()))
    }

    /// Names of both bodies of a contact.
    pub fn bodies(&self, contact: &str) -> [&'a str; 2] {
        let bodies = self.contacts.iter().find(|(name, _)| name == contact).map(|(_, bodies)| bodies);
        bodies.map_or(["body 1", "body 2"], |bodies| bodies.each_ref().map(String::as_str))
    }
}

/// Rows of a table at most; of more the first and the last are shown.
const MOST_ROWS: usize = 60;
const FIRST_ROWS: usize = 10;

/// A table of the first and the last rows, with a word on those between.
pub fn long_table(header: &[&str], rows: Vec<Vec<String>>, place: &str) -> String {
    if rows.len() <= MOST_ROWS {
        return table(header, &rows);
    }
    let left = rows.len() - MOST_ROWS;
    let last = rows.len() - (MOST_ROWS - FIRST_ROWS);
    let dots = std::iter::once(vec!["…".to_owned(); header.len()]);
    let shown: Vec<Vec<String>> = rows[..FIRST_ROWS].iter().cloned().chain(dots).chain(rows[last..].iter().cloned()).collect();
    table(header, &shown) + &paragraph(&format!("{left} rows are left out here; all of them stand in {place}."))
}

/// A column of a table: its head, and its cell in the row of a thing.
pub type TableColumn<'a, T> = (&'a str, &'a dyn Fn(&T) -> String);

/// The table of these columns with a row for each thing; of many the first and the last rows, where all of them stand in a `place`.
pub fn table_of<T>(columns: &[TableColumn<T>], things: impl Iterator<Item = T>, place: Option<&str>) -> String {
    let row = |thing: T| columns.iter().map(|(_, cell)| cell(&thing)).collect();
    let header: Vec<&str> = columns.iter().map(|(head, _)| *head).collect();
    let rows: Vec<Vec<String>> = things.map(row).collect();
    if let Some(place) = place { long_table(&header, rows, place) } else { table(&header, &rows) }
}

/// A number for a cell, with four digits.
pub fn number(number: Option<f64>) -> String {
    known(number, number_text)
}

/// A number of the solution itself for a cell.
pub fn exact(number: Option<f64>) -> String {
    known(number, |number| number_to(6, number))
}

fn known(number: Option<f64>, text: impl Fn(f64) -> String) -> String {
    number.filter(|number| number.is_finite()).map_or(UNKNOWN.into(), text)
}

/// A count in groups of three digits, which stand on one line.
pub fn count(number: usize) -> String {
    grouped(number).replace(' ', "\u{a0}")
}

/// Whether something can be trusted, in words that have a colour.
pub fn trust_word(trust: Option<bool>) -> String {
    match trust {
        Some(true) => TRUSTED,
        Some(false) => NOT_TRUSTED,
        None => UNTOLD,
    }
    .into()
}

/// A value that a case expects.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ExpectedValue {
    /// Of what.
    pub name: String,
    /// What is expected, in words or as a number.
    pub expected: String,
    /// The same as found; empty where it is no single number.
    pub found: String,
    /// The relative error; None if it is not known.
    pub error: Option<f64>,
    /// The largest error that is allowed; None if any is.
    pub tolerance: Option<f64>,
}
