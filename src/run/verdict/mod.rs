//! What a result is worth.
//!
//! In comes a summary with all its figures, beside the case and the solution it is of; out come words and errors, and the trust of
//! each contact. `limits` has every number that a figure is held against. A solution may be none (`no_result`), one of something
//! else than the case says (`unresolved`), with pressures to be trusted or not (`trust`), and near or far from what is known
//! (`exact`, `true_errors`). Nothing here prints, and nothing changes a digit of a result.

pub(crate) mod exact;
pub(crate) mod limits;
pub(crate) mod no_result;
pub(crate) mod true_errors;
pub(crate) mod trust;
pub(crate) mod unresolved;
pub(crate) mod warnings;
