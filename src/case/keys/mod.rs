//! The language that tables of keys are written in, and how a file is read with them.
//!
//! In come a table of TOML and the table of its keys; out come typed values, and in a log everything that is wrong, and the
//! defaults that were used. A key is declared once, in the room of its section, as a constant such as `YOUNG: Key<f64>`, and
//! `section.required(YOUNG)` reads it.
//!
//! - The form of a key says what may stand there without any other key and without names of the file or the mesh: types, ranges,
//!   words. It is checked in one place, before the value is read.
//! - A key that is not in the table of its section cannot be asked for: that panics. A key that no reader asks for fails a test.
//! - Problems come in the order in which readers ask. What the readers let pass, the table of keys still refuses.

mod check;
mod declaring;
mod form;
pub mod section;
pub mod values;

pub use declaring::*;
pub use form::*;
pub use section::Section;
#[cfg(test)]
pub use tests::{never_asked, tables};
pub use values::FromValue;

#[cfg(test)]
mod tests;
