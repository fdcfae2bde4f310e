//! What mends a pressure that is too inexact, in the terms of its case.

use crate::case::{Case, MOST_REFINE};
use crate::contact::{Pair, Quadrature, SegmentRule, Stabilise};
use crate::element::Order;
use crate::run::verdict::limits::{P1_STIFF, Remedy};

/// What mends it where the mesh makes itself.
const LESS_ERROR: &str = "ask for a smaller error, of pressure too, or allow more unknowns";

/// What makes λ exact where it is not so on any mesh.
pub const CUT: &str = "take quadrature = \"cut\"";

/// A contact whose pressure is to be mended.
#[derive(Clone, Copy)]
pub struct Mended<'a> {
    /// As it was solved: on a mesh that makes itself the segments are the program's own.
    pub pair: &'a Pair,
    pub case: &'a Case,
    /// Refinements that help it, and every other one.
    pub refinements: usize,
}

impl Mended<'_> {
    /// What a remedy is here, in words.
    pub fn by(&self, remedy: Remedy) -> String {
        let Self { pair, case, refinements } = *self;
        let finer = finer_mesh(case, refinements, "pressure");
        match remedy {
            Remedy::Words(words) => words.into(),
            Remedy::MoreSegments if pair.segments != SegmentRule::Auto => {
                format!("take more segments (\"auto\" takes as many as the mesh bears), or {finer}")
            }
            Remedy::Finer | Remedy::MoreSegments if case.accuracy.is_none() => finer,
            Remedy::Finer | Remedy::MoreSegments if pair.quadrature == Quadrature::Cut => LESS_ERROR.into(),
            Remedy::Finer | Remedy::MoreSegments => CUT.into(),
            Remedy::Stability => stability(pair, case).into(),
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
    let refine = case.mesh.refine + times;
    if refine > MOST_REFINE { format!("take {adapted}") } else { format!("take mesh.refine = {refine}, or {adapted}") }
}

/// What mends a space too rich for the displacements; P1 has locked before its multipliers are too many.
fn stability(pair: &Pair, case: &Case) -> &'static str {
    let mut parts = case.bodies.iter().flat_map(|body| &body.parts);
    let locked = case.mesh.order == Order::P1 && parts.any(|part| part.material.poisson_in_plane() > P1_STIFF);
    match (locked, pair.segments == SegmentRule::Auto) {
        (true, _) => "take mesh.order = 2: P1 triangles lock",
        _ if pair.stabilise == Stabilise::On => "take another multiplier space, or refine the mesh",
        (_, true) => "take stabilise = true, another multiplier space, or refine the mesh",
        _ => "take fewer segments (\"auto\" is safe), stabilise = true, or another multiplier space",
    }
}
