//! What mends a pressure that is too inexact, in the terms of its case.

use crate::case::Case;
use crate::contact::{Pair, Quadrature, SegmentRule};
use crate::element::Order;
use crate::run::verdict::limits::{P1_STIFF, Remedy};

/// What mends it where the mesh makes itself.
const LESS_ERROR: &str = "ask for a smaller error, of pressure too, or allow more unknowns";

/// What makes λ exact where it is not so on any mesh.
pub const CUT: &str = "take quadrature = \"cut\"";

impl Remedy {
    /// The words for a contact. `pair` is as it was solved: on a mesh that makes itself the segments are the program's own.
    pub fn words(self, pair: &Pair, case: &Case) -> String {
        let finer = finer_mesh(case, 1, "pressure");
        match self {
            Self::Words(words) => words.into(),
            Self::MoreSegments if pair.segments != SegmentRule::Auto => {
                format!("take more segments (\"auto\" takes as many as the mesh bears), or {finer}")
            }
            Self::Finer | Self::MoreSegments if case.accuracy.is_none() => finer,
            Self::Finer | Self::MoreSegments if pair.quadrature == Quadrature::Cut => LESS_ERROR.into(),
            Self::Finer | Self::MoreSegments => CUT.into(),
            Self::Stability => stability(pair, case).into(),
        }
    }
}

/// What makes a mesh finer that does not make itself: so many refinements more, or a goal. Steps and an accuracy exclude each other.
pub fn finer_mesh(case: &Case, times: usize, goal: &str) -> String {
    let adapted = if case.steps.is_empty() {
        format!("a mesh that is adapted, by [accuracy] with {goal} = 1e-2")
    } else {
        format!("as mesh.file the adapted.msh of a run with --set steps={{}} --set accuracy.{goal}=1e-2")
    };
    format!("take mesh.refine = {}, or {adapted}", case.mesh.refine + times)
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
