//! What the runs of a study say together: numbers, without a form.
//!
//! In come a plan and its ended runs, out come rows of a table (`rows.rs`), with repeats put together (`repeats.rs`), and lines of a
//! diagram (`lines.rs`) with the laws and fronts that their points follow (`fit.rs`). A run that has not converged is a row, and no
//! point of a line.

pub(super) mod fit;
pub(super) mod lines;
pub(super) mod repeats;
pub(super) mod rows;
