//! The commands that solve nothing: `mezha check`, `new`, `info`.
//!
//! In comes a case file, or a mesh alone; out come words, a figure, and TOML to paste. Nothing here writes a result, and only
//! `info` needs more than one process.

mod check;
mod drawing;
mod first_case;
mod info;
mod node_circle;
mod tools;

pub(crate) mod proposals;

pub use check::{Checked, check, check_file};
pub use drawing::draw_case;
pub use first_case::{FirstCase, first_case, path_from};
pub use info::{info, version};
