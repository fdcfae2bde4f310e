//! What a run is made of, read and brought together.
//!
//! In come the files of a case and of its mesh, and options of the user; out comes a scene whose macro triangles are spread over the
//! ranks, with its origin. All names are resolved, and what cannot be solved is refused with file, key, value and remedy: on every
//! rank alike, since rank 0 alone reads and all work on its bytes.

pub(crate) mod checks;
pub(crate) mod input;
mod names;
pub(crate) mod options;
pub(crate) mod origin;
pub(crate) mod scene;

pub use input::read_case;
