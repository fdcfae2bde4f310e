//! Where in a mesh file something stands.

/// A place in a mesh file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum FilePlace {
    /// A line of a text, from 1.
    #[error("line {0}")]
    Line(usize),
    /// This number of bytes from the beginning of a binary file.
    #[error("byte {0}")]
    Byte(usize),
}
