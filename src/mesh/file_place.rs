//! Where in a mesh file something stands.

use std::fmt::{Display, Formatter, Result};

/// A place in a mesh file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FilePlace {
    /// A line of a text, from 1.
    Line(usize),
    /// This number of bytes from the beginning of a binary file.
    Byte(usize),
}

impl Display for FilePlace {
    fn fmt(&self, to: &mut Formatter<'_>) -> Result {
        match self {
            Self::Line(line) => write!(to, "line {line}"),
            Self::Byte(byte) => write!(to, "byte {byte}"),
        }
    }
}
