//! `mezha check` and `mezha new`: what a case says, drawn, and what it may lack.

pub(crate) mod check;
pub(crate) mod drawing;
pub(crate) mod first_case;
pub(crate) mod proposals;
pub(crate) mod slits;

pub use check::{Checked, check, check_file};
pub use drawing::draw_case;
pub use first_case::{FirstCase, first_case, path_from};
