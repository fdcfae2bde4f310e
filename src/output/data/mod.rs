//! The numbers of a result as files for other programs: tables of contacts, their points and load steps, and fields.

mod tables;
pub mod vtk;

pub use tables::{CONTACTS, write_contact, write_contacts, write_steps};

/// The signs of a result, as its files state them in their header.
pub const SIGNS: [&str; 5] = [
    "n: unit normal of the contact boundary, from body 1 to body 2",
    "lambda: contact pressure, positive in compression",
    "gap: n . (x2 - x1) of the deformed bodies; open > 0, touching 0, penetration < 0",
    "un_i: n . u of body i, positive from body 1 to body 2",
    "sigma_i: n . sigma n on the trace of body i, tension positive: -lambda where the bodies press",
];

/// A text as a cell of a table: in quotes where it holds what parts cells.
pub fn quoted(text: &str) -> String {
    match text.contains([',', '"', '\n', '\r']) {
        true => format!("\"{}\"", text.replace('"', "\"\"")),
        false => text.into(),
    }
}
