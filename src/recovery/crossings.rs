//! Boundaries of different bodies between which the case has no contact, and which the solution puts into each other.

use crate::contact::{
    ClosePair, Configuration, CurveChoice, EndRule, GapChoice, Law, MultiplierSpace, Pair, Quadrature, SegmentRule, SmoothSide,
    Stabilise, close_pairs, penetration,
};
use crate::discretisation::{BoundaryMotion, Discretisation, Scene, Solution};
use crate::geometry::Point;
use crate::mesh::EdgeNode;

/// An overlap of less than this share of the largest displacement is not told: corners that pass along each other, rounding. None of the
/// cases of the project, and of 140 scenes that others drew only one that lacks a contact, has a larger one.
const TOLD: f64 = 1e-2;

/// Two boundaries without a contact that lie in each other.
#[derive(Clone, Debug, PartialEq)]
pub struct Crossing {
    /// Their names.
    pub between: [String; 2],
    /// The deepest place of one in the other (length).
    pub depth: f64,
    /// Where that is.
    pub place: Point,
}

/// All of them, where no node has `moved` by more (length). **Collective**
pub fn crossings(problem: &Discretisation, solution: &Solution, moved: f64) -> Vec<Crossing> {
    let (scene, space) = (&problem.scene, problem.finest());
    let taken: Vec<[String; 2]> = scene.pairs.iter().map(|pair| pair.between.clone()).collect();
    let is_in_reach = |pair: &ClosePair| pair.distance < 2.0 * moved;
    let close = if scene.bodies.len() > 1 { close_pairs(&scene.mesh, &taken) } else { Vec::new() };
    let pairs: Vec<Pair> = close.into_iter().filter(is_in_reach).map(|pair| undeclared(pair.between)).collect();
    if pairs.is_empty() {
        return Vec::new();
    }
    let scene = Scene { pairs, ..scene.clone() };
    let motion = BoundaryMotion::new(&scene, space, &solution.displacement, &problem.session);
    let displacement = |node: EdgeNode| motion.at(node, &scene.mesh, space);
    let crossing = |pair: &Pair| {
        let sides = SmoothSide::of_pair(&scene.mesh, &space.numbering, pair, &displacement);
        let found = penetration(&sides, pair, |_| 0.0);
        let is_told = found.depth > TOLD * moved;
        is_told.then(|| Crossing { between: pair.between.clone(), depth: found.depth, place: found.place })
    };
    scene.pairs.iter().filter_map(crossing).collect()
}

/// A contact of two boundaries as a case would have it that says nothing else, by the deformed bodies.
fn undeclared(between: [String; 2]) -> Pair {
    Pair {
        name: String::new(),
        between,
        curve: CurveChoice::Fit,
        gap: GapChoice::Geometry,
        space: MultiplierSpace::P1Discontinuous,
        segments: SegmentRule::Auto,
        law: Law::Unilateral,
        quadrature: Quadrature::Cut,
        stabilise: Stabilise::Auto,
        configuration: Configuration::Deformed,
        spans: None,
        grading: [1.0; 2],
        ends: EndRule::Free,
    }
}
