//! Curves, formulas and intervals of the plane; no mesh.

mod curve;
mod formula;

pub use curve::Curve;
pub use formula::{Formula, FormulaError};
