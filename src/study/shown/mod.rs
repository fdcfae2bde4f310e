//! Tables and lines of a study as texts.
//!
//! In come rows and lines, out come the texts of `study.csv`, `.json` and `.md` (`format.rs`), of the figures (`figure.rs`), and of
//! the page that holds them (`page.rs`). Nothing here writes a file.

pub(super) mod figure;
pub(super) mod format;
pub(super) mod page;
