//! The result folder: what a run leaves behind, from plain numbers to files.
//!
//! | file | written by |
//! |---|---|
//! | `summary.json` | [`Summary::write`] |
//! | `contacts.csv` | [`contacts_table`] |
//! | `contact_NAME.csv` | [`contact_table`] |
//! | `fields.vtu`, or `fields.pvtu` and its pieces; `contact_NAME.vtu` | [`vtk`] |
//! | `pressure_NAME.svg`, `gap_NAME.svg`, `displacement_NAME.svg`, `deformed.svg`, `field_sigma_1.svg`, `deformed_NAME_1.svg`, `accuracy.svg`, `steps.svg` | [`plot`] |
//! | `report.html` | [`report`] |
//! | `steps.csv` | [`steps_table`] |
//! | `case.toml`, `case.msh`: the case as it was run, and its mesh, if that is not large | `run` |
//! | `fields.pvd`, `contact_NAME.pvd`: the files of each load step, which lie in `steps/0001` and so on | [`vtk`] |
//!
//! All of it goes through a [`ResultFolder`], which appears under its name only when it is whole.
//! Nothing here communicates: in parallel every rank writes its own piece of the fields, and rank 0 the rest.

mod clock;
mod data;
mod error;
mod folder;
pub mod markup;
pub mod plot;
pub mod report;
pub mod summary;
mod units;

pub use clock::clock;
pub use data::{CONTACTS, SIGNS, contact_table, contacts_table, csv_line, quoted, steps_table, vtk, write_text};
pub use error::{OutputError, RunError};
pub use folder::{ResultFolder, entries, recover, remove_if_there};
pub use summary::{Summary, machine, whole_machine};
pub use units::{Unit, Units};
