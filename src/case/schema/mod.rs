//! The keys of case and study files: one table of their names, forms, ranges, units, defaults and meanings.
//!
//! In come the tables of keys of all sections; out come the tables of whole files, and the JSON Schema for editors and other
//! programs. The program reads files with the same tables, and a test writes those of docs/case.md and docs/studies.md.
//!
//! The *form* of a file is what can be said of each key without another one, without names that the file or the mesh holds, and
//! which keys stand together: types, ranges, words, missing and unknown keys. What a formula says, whether a name is there, and
//! how values go together is for the readers.

pub(crate) mod case;
mod json;
pub(crate) mod study;

pub use crate::case::keys::TableForm;
pub use case::CASE;
pub use json::json;
pub use study::STUDY;

#[cfg(test)]
pub use crate::case::keys::never_asked;

#[cfg(test)]
mod tests;
