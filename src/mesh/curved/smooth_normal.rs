//! Normals of boundaries that are exact where a rigid motion can slide a body along itself: on lines and circles.
//!
//! The spline through the nodes of a circle is no circle: it would resist, a little, a disc that turns about its centre.
//! So the normal of a polygon comes from the circles through three nodes in a row, which lie on the circle if the nodes do.

use crate::geometry::{Point, cross, turn_right};
use crate::mesh::curve_piece::CurvePiece;
use crate::mesh::macro_mesh::MacroMesh;
use std::collections::HashMap;

/// A point of a smooth boundary.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SmoothPoint {
    /// Where it lies (length).
    pub place: Point,
    /// Outward unit normal.
    pub normal: Point,
    /// By how much the normal is uncertain (radians): the difference of the two circles that it is taken from.
    pub doubt: f64,
}

/// The normals of a set of boundary edges: from the declared geometry where there is one, along a straight stretch its
/// own, otherwise between the circles through an edge and its neighbours before and behind.
#[derive(Clone, Debug, Default)]
pub struct SmoothNormals {
    /// Signed curvatures of the two circles of each edge, positive where the body bulges.
    curvatures: HashMap<u32, [f64; 2]>,
}

impl SmoothNormals {
    /// Of a set of boundary edges; they are neighbours where they meet without a corner.
    pub fn new(mesh: &MacroMesh, edges: &[u32]) -> Self {
        let starts: HashMap<u32, u32> = edges.iter().map(|&edge| (mesh.directed(edge)[0], edge)).collect();
        let next = |edge: u32| starts.get(&mesh.directed(edge)[1]).copied().filter(|&other| mesh.goes_on(edge, other));
        let mut curvatures: HashMap<u32, [Option<f64>; 2]> = HashMap::new();
        for &edge in edges.iter().filter(|&&edge| is_undeclared(mesh, edge)) {
            let Some(other) = next(edge) else { continue };
            let [a, b] = mesh.directed(edge).map(|vertex| mesh.vertices[vertex as usize]);
            let c = mesh.vertices[mesh.directed(other)[1] as usize];
            let sides = (b - a).norm() * (c - b).norm() * (c - a).norm();
            let curvature = 2.0 * cross(b - a, c - b) / sides;
            curvatures.entry(edge).or_default()[1] = Some(curvature);
            curvatures.entry(other).or_default()[0] = Some(curvature);
        }
        let both = |[before, behind]: [Option<f64>; 2]| [before.or(behind).unwrap_or(0.0), behind.or(before).unwrap_or(0.0)];
        Self { curvatures: curvatures.into_iter().map(|(edge, of)| (edge, both(of))).collect() }
    }

    /// The point at the fraction `t` of an edge from its first vertex.
    pub fn at(&self, mesh: &MacroMesh, edge: u32, t: f64) -> SmoothPoint {
        let exact = SmoothPoint { place: mesh.edge_position(edge, t), normal: mesh.edge_normal(edge, t), doubt: 0.0 };
        let Some(curvatures) = self.curvatures.get(&edge).filter(|_| is_undeclared(mesh, edge)) else { return exact };
        let ends = mesh.directed(edge);
        let t = if ends == mesh.edges[edge as usize].vertices { t } else { 1.0 - t };
        let [a, b] = ends.map(|vertex| mesh.vertices[vertex as usize]);
        let [first, second] = curvatures.map(|curvature| on_arc(a, b, curvature, t));
        SmoothPoint {
            place: (1.0 - t) * first.0 + t * second.0,
            normal: ((1.0 - t) * first.1 + t * second.1).normalize(),
            doubt: (first.1 - second.1).norm(),
        }
    }
}

/// Whether nobody has declared the shape of an edge: it is a chord, or bent onto a spline through vertices.
fn is_undeclared(mesh: &MacroMesh, edge: u32) -> bool {
    mesh.edges[edge as usize].shape.as_ref().is_none_or(CurvePiece::is_spline)
}

impl MacroMesh {
    /// The two vertices of a boundary edge, with the body on the left.
    pub(crate) fn directed(&self, edge: u32) -> [u32; 2] {
        let (triangle, side) = self.beside(edge);
        let corners = self.triangles[triangle as usize].vertices;
        [corners[side], corners[(side + 1) % 3]]
    }
}

/// Place and outward normal on the circle over the chord from `a` to `b`, with the body on its left, on the ray from the
/// centre through the fraction `t` of the chord.
fn on_arc(a: Point, b: Point, curvature: f64, t: f64) -> (Point, Point) {
    let length = (b - a).norm();
    let along = (b - a) / length;
    let s = (t - 0.5) * length;
    let flat = (1.0 - (0.5 * curvature * length).powi(2)).max(f64::EPSILON).sqrt();
    let normal = (turn_right(along) + along * (curvature * s / flat)).normalize();
    let under = 0.25 * length * length - s * s;
    let height = curvature * under / (1.0 + (1.0 - curvature * curvature * under).max(0.0).sqrt());
    (a + t * (b - a) + height * normal, normal)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_point_on_an_arc_is_seen_from_the_centre_along_the_normal() {
        let (centre, radius) = (Point::new(0.3, -2.0), 1.7);
        let at = |angle: f64| centre + radius * Point::new(angle.cos(), angle.sin());
        for (from, to, inside) in [(0.2, 0.5, 1.0), (0.5, 0.2, -1.0)] {
            for t in [0.0, 0.3, 0.9] {
                let (place, normal) = on_arc(at(from), at(to), inside / radius, t);
                assert!(((place - centre).norm() - radius).abs() < 1e-14);
                assert!((place - centre - inside * radius * normal).norm() < 1e-14);
            }
        }
    }
}
