//! The result folder: what a run leaves behind, from plain numbers to files.
//!
//! | file | written by |
//! |---|---|
//! | `summary.json` | [`Summary::write`] |
//! | `contacts.csv` | [`write_contacts`] |
//! | `contact_NAME.csv` | [`write_contact`] |
//! | `fields.vtu`, or `fields.pvtu` and its pieces; `contact_NAME.vtu` | [`vtk`] |
//! | `pressure_NAME.svg`, `gap_NAME.svg`, `displacement_NAME.svg`, `deformed.svg`, `deformed_NAME_1.svg`, `accuracy.svg`, `steps.svg` | [`plot`] |
//! | `report.html` | [`report`] |
//! | `steps.csv` | [`write_steps`] |
//! | `case.toml`, `case.msh`: the case as it was run, and its mesh, if that is not large | `run` |
//! | `fields.pvd`, `contact_NAME.pvd`: the files of each load step, which lie in `steps/0001` and so on | [`vtk`] |
//!
//! All of it goes through a [`ResultFolder`], which appears under its name only when it is whole.
//! Nothing here communicates: in parallel every rank writes its own piece of the fields, and rank 0 the rest.

mod clock;
mod contacts;
mod csv;
mod entries;
mod error;
mod folder;
mod leftover;
mod machine;
pub mod markup;
mod own_files;
pub mod plot;
pub mod report;
mod steps;
pub mod summary;
pub mod vtk;

pub use clock::clock;
pub use contacts::{CONTACTS, write_contacts};
pub use csv::{ContactPoint, write_contact};
pub use entries::{entries, remove_if_there};
pub use error::OutputError;
pub use folder::ResultFolder;
pub use leftover::recover;
pub use machine::{machine, whole_machine};
pub use steps::write_steps;
pub use summary::Summary;

/// A text as a cell of a table: in quotes where it holds what parts cells.
pub fn quoted(text: &str) -> String {
    if text.contains([',', '"', '\n', '\r']) { format!("\"{}\"", text.replace('"', "\"\"")) } else { text.into() }
}

/// A number as a cell of a table; nothing stands there if it is not known, or not finite.
fn number_cell(number: Option<f64>) -> String {
    number.filter(|number| number.is_finite()).map_or(String::new(), |number| format!("{number:?}"))
}

/// The signs of a result, as its files state them in their header.
pub const SIGNS: [&str; 5] = [
    "n: unit normal of the contact boundary, from body 1 to body 2",
    "lambda: contact pressure, positive in compression",
    "gap: n . (x2 - x1) of the deformed bodies; open > 0, touching 0, penetration < 0",
    "un_i: n . u of body i, positive from body 1 to body 2",
    "sigma_i: n . sigma n on the trace of body i, tension positive: -lambda where the bodies press",
];
