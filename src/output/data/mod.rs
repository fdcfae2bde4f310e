//! The numbers of a result as files for other programs: tables of contacts, their points and load steps, and fields.

mod tables;
pub mod vtk;

pub use tables::{CONTACTS, contact_table, contacts_table, steps_table};

use super::error::OutputError;
use std::fs;
use std::path::Path;

/// The signs of a result, as its files state them in their header.
pub const SIGNS: [&str; 5] = [
    "n: unit normal of the contact boundary, from body 1 to body 2",
    "lambda: contact pressure, positive in compression",
    "gap: n . (x2 - x1) of the deformed bodies; open > 0, touching 0, penetration < 0",
    "un_i: n . u of body i, positive from body 1 to body 2",
    "sigma_i: n . sigma n on the trace of body i, tension positive: -lambda where the bodies press",
];

/// Writes a file; nothing is left of one for which there is no room.
///
/// # Errors
/// The operating system refuses.
pub fn write_text(path: &Path, text: &str) -> Result<(), OutputError> {
    fs::write(path, text).map_err(OutputError::unwritten(path))
}

/// A line of a table from its cells.
pub fn csv_line(cells: &[String]) -> String {
    cells.join(",") + "\n"
}

/// A text as a cell of a table: in quotes where it holds what parts cells.
pub fn quoted(text: &str) -> String {
    match text.contains([',', '"', '\n', '\r']) {
        true => format!("\"{}\"", text.replace('"', "\"\"")),
        false => text.into(),
    }
}
