//! The keys of case and study files: one table of their names, forms, ranges, units, defaults and meanings.
//!
//! Files are checked with it, the JSON Schema for editors and other programs is made of
//! it, and so are the tables of docs/case.md and docs/studies.md.
//!
//! The *form* of a file is what can be said of each key without another one, without names that the file or the mesh holds, and
//! which keys stand together: types, ranges, words, missing and unknown keys. What a formula says, whether a name is there, and
//! how values go together is for the readers.

mod acting;
mod asked;
#[cfg(test)]
mod asking;
mod check;
mod contact;
mod form;
mod json;
mod markdown;
mod scene;
mod study;
mod surface;

pub use form::{Absent, KeyForm, LONGEST_NAME, NO_FILE_NAME, TableForm};
pub use json::json;
pub use markdown::markdown;
pub use scene::CASE;
pub use study::STUDY;

/// Keys of a file that has not the form of the table, with words; none if the text is no TOML at all.
pub fn faults(table: &TableForm, text: &str) -> Option<Vec<(String, String)>> {
    toml::from_str(text).ok().map(|file| table.faults(&file))
}

#[cfg(test)]
pub use asking::{never_asked, note};

#[cfg(test)]
mod tests;
