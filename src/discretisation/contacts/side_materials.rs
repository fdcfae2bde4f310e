//! What the two sides of a contact are made of.
//!
//! E_c is that beside each segment, in the augmentation, in the scale of the multipliers, in the jump term and in what overlaps
//! are worth. One E_c for a whole contact took 108 iterations instead of fewer than 20 on two columns with E of 1 : 1000
//! (`cases/patch_columns`).

use crate::contact::ContactBoundary;
use crate::discretisation::scene::Scene;
use crate::mesh::{BoundaryEdge, EdgeNode, Level};
use std::collections::HashSet;

/// Places nearer than this share of Γ_C are one.
const SAME: f64 = 1e-9;

/// Young's moduli of the parts beside both boundaries of a contact; most boundaries have one part.
pub struct SideMaterials<'s> {
    scene: &'s Scene,
    /// The softest and the hardest part beside each boundary.
    extremes: [[usize; 2]; 2],
    /// The softest part beside each boundary.
    pub softest: [usize; 2],
    /// Vertices of either boundary at which an edge between two materials of the body ends.
    joints: HashSet<u32>,
}

impl<'s> SideMaterials<'s> {
    /// Of the macro edges of both boundaries.
    pub fn new(scene: &'s Scene, sides: &[Vec<u32>; 2]) -> Self {
        let mesh = &scene.mesh;
        let extremes = sides.each_ref().map(|edges| {
            let mut parts: Vec<usize> =
                edges.iter().map(|&edge| mesh.triangles[mesh.beside(edge).0 as usize].part as usize).collect();
            parts.dedup();
            parts.sort_by(|&a, &b| scene.young_of(a).total_cmp(&scene.young_of(b)));
            [parts[0], parts[parts.len() - 1]]
        });
        let joints = sides.iter().flat_map(|edges| joints(scene, edges)).collect();
        Self { scene, extremes, softest: extremes.map(|[softest, _]| softest), joints }
    }

    /// Parameters of Γ_C at which edges between two materials of a body end.
    pub fn joints(&self, boundary: &ContactBoundary, edges: &[Vec<BoundaryEdge>; 2], level: Level) -> Vec<f64> {
        let is_joint = |node: EdgeNode| node.vertex(&self.scene.mesh, level).is_some_and(|vertex| self.joints.contains(&vertex));
        let ends = edges.iter().flatten().flat_map(|edge| [0, 1].map(|end| (edge.nodes[end], edge.points[end])));
        let [first, last] = boundary.ends();
        let near = SAME * (last - first);
        let feet = ends.filter(|(node, _)| is_joint(*node)).map(|(_, place)| boundary.foot(place));
        let mut feet: Vec<f64> = feet.filter(|foot| (first - near..=last + near).contains(foot)).collect();
        feet.sort_by(f64::total_cmp);
        feet.dedup_by(|a, b| *a - *b < near);
        feet
    }

    /// The moduli by which the softer body is told, whose edges rule the length of the segments. Where one body is softer here
    /// and the other one there they are equal: then both rule.
    pub fn ruling(&self) -> [f64; 2] {
        let [[a, b], [c, d]] = self.extremes.map(|parts| parts.map(|part| self.scene.young_of(part)));
        if a <= d && c <= b { [a.min(c); 2] } else { [a, c] }
    }

    /// `E_c = 2/(1/E₁ + 1/E₂)` beside each segment (stress), by the softest part of each body there.
    pub fn moduli(&self, boundary: &ContactBoundary, edges: &[Vec<BoundaryEdge>; 2]) -> Vec<f64> {
        let sides = [0, 1].map(|k| self.of_side(k, boundary, &edges[k]));
        sides[0].iter().zip(&sides[1]).map(|(first, second)| 2.0 / (1.0 / first + 1.0 / second)).collect()
    }

    /// Modulus of one body beside each segment; its smallest one where a segment sees no edge of it.
    fn of_side(&self, side: usize, boundary: &ContactBoundary, edges: &[BoundaryEdge]) -> Vec<f64> {
        let [least, most] = self.extremes[side].map(|part| self.scene.young_of(part));
        if least == most {
            return vec![least; boundary.segments()];
        }
        let knots = boundary.knots();
        let mut found = vec![f64::INFINITY; boundary.segments()];
        for edge in edges {
            let young = self.scene.young_of(self.scene.mesh.triangles[edge.triangle].part as usize);
            let feet = boundary.feet([edge.points[0], edge.points[1]]);
            let inner = [0.99 * feet[0] + 0.01 * feet[1], 0.01 * feet[0] + 0.99 * feet[1]];
            if inner[1] < knots[0] || inner[0] > knots[knots.len() - 1] {
                continue;
            }
            let [first, last] = inner.map(|t| boundary.locate(t).0);
            found[first..=last].iter_mut().for_each(|known| *known = known.min(young));
        }
        found.into_iter().map(|young| if young.is_finite() { young } else { least }).collect()
    }
}

/// Vertices of macro edges of a boundary at which an edge between two materials ends.
fn joints(scene: &Scene, edges: &[u32]) -> Vec<u32> {
    let mesh = &scene.mesh;
    let Some(body) = edges.first().map(|&edge| mesh.body_beside(edge)).filter(|&body| scene.bodies[body].has_parts()) else {
        return Vec::new();
    };
    debug_assert!(edges.iter().all(|&edge| mesh.body_beside(edge) == body), "a side of a contact is of one body");
    let ends = edges.iter().flat_map(|&edge| mesh.edges[edge as usize].vertices.map(|vertex| (edge, vertex)));
    ends.filter(|&(edge, vertex)| is_joint(scene, edge, vertex)).map(|(_, vertex)| vertex).collect()
}

/// Whether the material changes on the way around a vertex, from a boundary edge through all triangles there.
fn is_joint(scene: &Scene, mut edge: u32, vertex: u32) -> bool {
    let mesh = &scene.mesh;
    let mut at = mesh.beside(edge).0 as usize;
    loop {
        let triangle = &mesh.triangles[at];
        let ends_there = |other: &u32| *other != edge && mesh.edges[*other as usize].vertices.contains(&vertex);
        let Some(next) = triangle.edges.into_iter().find(ends_there) else { return false };
        let Some(other) = mesh.across(at as u32, next) else { return false };
        let [here, there] = [triangle.part, mesh.triangles[other as usize].part];
        if here != there && !scene.part(here as usize).is_alike(scene.part(there as usize)) {
            return true;
        }
        (edge, at) = (next, other as usize);
    }
}
