//! What mends a pressure that is too inexact, in the terms of its case.

use crate::case::Case;
use crate::contact::{Pair, Quadrature, SegmentRule};
use crate::element::Order;
use crate::run::verdict::limits::{P1_STIFF, Remedy};

/// What mends a pressure whose bodies are too coarse for it.
pub const FINER: &str = "refine the mesh where contact is";

/// What mends it where the mesh makes itself.
const LESS_ERROR: &str =
    "let the mesh become finer where contact is: ask for a smaller error, of pressure too, or allow more unknowns";

/// What keeps it from becoming better there, however fine the mesh is.
const CUT: &str = "take quadrature = \"cut\"";

impl Remedy {
    /// The words for a contact. `pair` is as it was solved: on a mesh that makes itself the segments are the program's own.
    pub fn words(self, pair: &Pair, case: &Case) -> &'static str {
        match self {
            Self::Words(words) => words,
            Self::MoreSegments if pair.segments != SegmentRule::Auto => {
                "take more segments (\"auto\" takes as many as the mesh bears), or refine the mesh where contact is"
            }
            Self::Finer | Self::MoreSegments if case.accuracy.is_none() => FINER,
            Self::Finer | Self::MoreSegments if pair.quadrature == Quadrature::Cut => LESS_ERROR,
            Self::Finer | Self::MoreSegments => CUT,
            Self::Stability => stability(pair, case),
        }
    }
}

/// What mends a space too rich for the displacements; P1 has locked before its multipliers are too many.
fn stability(pair: &Pair, case: &Case) -> &'static str {
    let mut parts = case.bodies.iter().flat_map(|body| &body.parts);
    let locked = case.mesh.order == Order::P1 && parts.any(|part| part.material.poisson_in_plane() > P1_STIFF);
    match (locked, pair.segments == SegmentRule::Auto) {
        (true, _) => "take mesh.order = 2: P1 triangles lock",
        (_, true) => "take stabilise = true, another multiplier space, or refine the mesh",
        _ => "take fewer segments (\"auto\" is safe), stabilise = true, or another multiplier space",
    }
}
