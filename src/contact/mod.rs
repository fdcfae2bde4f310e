//! Everything on the contact boundary; no PETSc.

mod pair;

pub use pair::{CurveChoice, GapChoice, Law, MultiplierSpace, Pair, SegmentRule};
