//! What mends a pressure that is too inexact.

use crate::case::Case;
use crate::contact::{Pair, Quadrature, SegmentRule};

/// What mends a pressure whose bodies are too coarse for it.
pub const FINER: &str = "refine the mesh where contact is";

/// The same where the mesh makes itself.
const LESS_ERROR: &str =
    "let the mesh become finer where contact is: ask for a smaller error, of pressure too, or allow more unknowns";

/// What keeps it from becoming better there, however fine the mesh is.
const CUT: &str = "take quadrature = \"cut\"";

/// What mends a pressure of a mesh that makes itself, instead of a finer one.
pub fn on_order(remedy: &'static str, pair: &Pair, case: &Case) -> &'static str {
    match remedy {
        FINER if case.accuracy.is_some() && pair.quadrature == Quadrature::Cut => LESS_ERROR,
        FINER if case.accuracy.is_some() => CUT,
        _ => remedy,
    }
}

/// What makes segments shorter.
pub fn more_segments(pair: &Pair) -> &'static str {
    match pair.segments {
        SegmentRule::Auto => FINER,
        _ => "take more segments (\"auto\" takes as many as the mesh bears), or refine the mesh where contact is",
    }
}
