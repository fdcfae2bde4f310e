//! True shapes of macro edges, and the smooth map of a macro triangle that follows them.

use crate::element::Plane;
use crate::geometry::{Coordinates, Curve, Point, Rounded};
use crate::mesh::MeshError;
use crate::mesh::curve_piece::CurvePiece;
use crate::mesh::macro_mesh::MacroMesh;
use nalgebra::Matrix2;
use std::sync::Arc;

/// Points so close to a macro triangle (barycentric) count as inside.
const NEAR: f64 = 1e-8;

impl MacroMesh {
    /// Gives the edges of the named boundaries, and of curves between parts, the shape of a curve and moves their vertices onto it.
    ///
    /// # Errors
    /// If a boundary does not exist, or a vertex is farther from the curve than a tenth of its edge.
    pub fn bend(&mut self, geometry: &str, boundaries: &[String], curve: &Curve) -> Result<(), MeshError> {
        let curve = Arc::new(curve.clone());
        for name in boundaries {
            let Some(boundary) = self.boundaries.named(name).or_else(|| self.interfaces.named(name)) else {
                let known = self.physical_curves().into_iter().chain(&self.interfaces);
                let known = known.map(|b| format!("\"{}\"", b.name)).collect::<Vec<_>>().join(", ");
                return Err(
                    self.unusable(format!("has no physical curve \"{name}\", which [geometry.{geometry}] names; it has {known}"))
                );
            };
            for edge in boundary.edges.clone() {
                self.bend_edge(geometry, edge, &curve)?;
            }
        }
        Ok(())
    }

    fn bend_edge(&mut self, geometry: &str, edge: u32, curve: &Arc<Curve>) -> Result<(), MeshError> {
        let ends = self.edges[edge as usize].vertices;
        let length = self.edge_length(edge);
        let range = self.range_on(curve, ends);
        for (vertex, t) in ends.into_iter().zip(range) {
            let here = self.vertices[vertex as usize];
            let there = self.kept_on_axis(here, curve.point(t));
            let distance = (here - there).norm();
            let [first, last] = curve.range();
            let beyond = (first - t).max(t - last) > 1e-6 * (last - first).abs() && curve.period().is_none();
            if distance > 0.1 * length || !distance.is_finite() || beyond {
                let far = match (distance.is_finite(), distance > 0.1 * length) {
                    (false, _) => "has no nearest point on".into(),
                    (_, true) => format!("lies {distance:.3e} from"),
                    _ => format!("lies beyond the range of t, from {} to {}, of", Rounded(first), Rounded(last)),
                };
                return Err(self.unusable(format!(
                    "the node {} {far} [geometry.{geometry}] (nearest at t = {}); correct the formula, its range of t, or the mesh",
                    Coordinates(here),
                    Rounded(t)
                )));
            }
            if distance > 1e-14 * (here.norm() + length) {
                self.vertices[vertex as usize] = there;
                self.bounds.take();
            }
        }
        self.edges[edge as usize].shape = (!curve.is_line()).then(|| Box::new(CurvePiece { curve: curve.clone(), range }));
        Ok(())
    }

    /// Parameters of a curve where it is nearest to two vertices; of a closed one no farther apart than half of it.
    pub(super) fn range_on(&self, curve: &Curve, ends: [u32; 2]) -> [f64; 2] {
        let [from, to] = ends.map(|vertex| curve.nearest(self.vertices[vertex as usize]));
        let near = |period: f64| from + (to - from + 0.5 * period).rem_euclid(period) - 0.5 * period;
        [from, curve.period().map_or(to, near)]
    }

    /// Whether an edge of the macro triangle is bent, so that its triangles differ from one another.
    pub fn is_curved(&self, triangle: usize) -> bool {
        self.triangles[triangle].edges.iter().any(|&edge| self.edges[edge as usize].shape.is_some())
    }

    /// Whether the small triangles of a macro triangle have few stiffnesses, which repeat: it is straight, and no body of
    /// revolution, whose rings differ by their radius.
    pub fn repeats(&self, triangle: usize) -> bool {
        self.plane != Plane::Revolution && !self.is_curved(triangle)
    }

    /// Position of the point with barycentric coordinates `(1 - xi - eta, xi, eta)` of a macro triangle.
    ///
    /// The displacement of each bent edge is carried into the triangle by the blending of Szabó and Babuška,
    /// Finite Element Analysis (1991), section 6.2: smooth, exact on the edges, so that nodes of every level are points of
    /// one map.
    pub fn position(&self, triangle: usize, xi: f64, eta: f64) -> Point {
        let macro_triangle = &self.triangles[triangle];
        let weights = [1.0 - xi - eta, xi, eta];
        let corners = macro_triangle.vertices.map(|vertex| self.vertices[vertex as usize]);
        let mut x = corners[0] * weights[0] + corners[1] * weights[1] + corners[2] * weights[2];
        for k in 0..3 {
            let Some(shape) = &self.edges[macro_triangle.edges[k] as usize].shape else { continue };
            let (a, b) = (weights[k], weights[(k + 1) % 3]);
            let t = 0.5 * (1.0 + b - a);
            // Beside a vertex t may round to it, though neither weight is zero.
            if a * b <= 0.0 || t * (1.0 - t) <= 0.0 {
                continue;
            }
            let straight = corners[k] * (1.0 - t) + corners[(k + 1) % 3] * t;
            let along = if macro_triangle.forward[k] { t } else { 1.0 - t };
            x += (shape.point(along) - straight) * (a * b / (t * (1.0 - t)));
        }
        x
    }

    /// Reference coordinates `(xi, eta)` of a point in a macro triangle by Newton's method on its map; nothing if the
    /// point lies outside.
    pub fn locate(&self, triangle: usize, x: Point) -> Option<Point> {
        self.locate_near(triangle, x, NEAR)
    }

    /// Reference coordinates `(xi, eta)` of a point in a macro triangle by Newton's method on its map; points outside count as inside
    /// up to the distance `near` (barycentric), and nothing is found of those beyond.
    pub fn locate_near(&self, triangle: usize, x: Point, near: f64) -> Option<Point> {
        let [a, b, c] = self.corners(triangle);
        let size = (b - a).norm().max((c - a).norm()).max((c - b).norm());
        if (x - (a + b + c) / 3.0).norm() > 1.5 * size {
            return None;
        }
        let straight = Matrix2::from_columns(&[b - a, c - a]).try_inverse()?;
        let mut at = straight * (x - a);
        if self.is_curved(triangle) {
            for _ in 0..30 {
                let step = straight * (x - self.position(triangle, at.x, at.y));
                at += step;
                if step.norm() < 1e-14 {
                    break;
                }
            }
        }
        let inside = at.x >= -near && at.y >= -near && at.x + at.y <= 1.0 + near;
        inside.then_some(at)
    }

    /// Position at the fraction `t` of a macro edge from its first vertex.
    pub fn edge_position(&self, edge: u32, t: f64) -> Point {
        let macro_edge = &self.edges[edge as usize];
        let [a, b] = macro_edge.vertices.map(|vertex| self.vertices[vertex as usize]);
        match &macro_edge.shape {
            Some(shape) if t > 0.0 && t < 1.0 => shape.point(t),
            _ => a * (1.0 - t) + b * t,
        }
    }

    /// Derivative of the position on a macro edge by the fraction `t` from its first vertex (length).
    pub fn edge_slope(&self, edge: u32, t: f64) -> Point {
        let macro_edge = &self.edges[edge as usize];
        let [a, b] = macro_edge.vertices.map(|vertex| self.vertices[vertex as usize]);
        match &macro_edge.shape {
            Some(shape) => shape.curve.derivative(shape.parameter(t)) * (shape.range[1] - shape.range[0]),
            None => b - a,
        }
    }

    /// Unit outward normal of a boundary edge at the fraction `t` from its first vertex; from the true shape where it has one.
    pub fn edge_normal(&self, edge: u32, t: f64) -> Point {
        let macro_edge = &self.edges[edge as usize];
        let (triangle, side) = self.beside(edge);
        let [a, b] = macro_edge.vertices.map(|vertex| self.vertices[vertex as usize]);
        let chord = b - a;
        let tangent = match &macro_edge.shape {
            Some(shape) => {
                let tangent = shape.curve.tangent(shape.parameter(t));
                tangent * tangent.dot(&chord).signum()
            }
            None => chord.normalize(),
        };
        let outward = crate::geometry::turn_right(tangent);
        if self.triangles[triangle as usize].forward[side] { outward } else { -outward }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::samples::two_blocks;

    fn bent() -> (MacroMesh, Curve) {
        let mut mesh = two_blocks();
        let circle = Curve::Circle { centre: [1.0, -2.0], radius: 10f64.sqrt() };
        mesh.bend("arc", &["lower.seam".into()], &circle).expect("the ends lie on it");
        (mesh, circle)
    }

    #[test]
    fn the_map_follows_the_curve_on_its_edge_and_is_straight_on_the_others() {
        let (mesh, circle) = bent();
        let edge = mesh.boundary("lower.seam").expect("it has one").edges[0];
        let (triangle, side) = mesh.beside(edge);
        for k in 0..=8 {
            let (i, j) = crate::mesh::lattice::side_node(8, side, k);
            let x = mesh.position(triangle as usize, i as f64 / 8.0, j as f64 / 8.0);
            assert!((x - circle.point(circle.nearest(x))).norm() < 1e-14);
            let (i, j) = crate::mesh::lattice::side_node(8, (side + 1) % 3, k);
            let (a, b) = (
                mesh.triangles[triangle as usize].vertices[(side + 1) % 3],
                mesh.triangles[triangle as usize].vertices[(side + 2) % 3],
            );
            let t = k as f64 / 8.0;
            let straight = mesh.vertices[a as usize] * (1.0 - t) + mesh.vertices[b as usize] * t;
            assert!((mesh.position(triangle as usize, i as f64 / 8.0, j as f64 / 8.0) - straight).norm() < 1e-14);
        }
    }

    /// Reference coordinates that miss a vertex by less than rounding, as Newton's method finds them.
    #[test]
    fn places_beside_a_vertex_are_beside_it() {
        let (mesh, _) = bent();
        let edge = mesh.boundary("lower.seam").expect("it has one").edges[0];
        let triangle = mesh.beside(edge).0 as usize;
        let corners = mesh.corners(triangle);
        let tiny = 7e-17;
        for (at, corner) in [([1.0, -tiny], 1), ([tiny, tiny], 0), ([-tiny, 1.0], 2), ([tiny, 1.0], 2), ([1.0, tiny], 1)] {
            let x = mesh.position(triangle, at[0], at[1]);
            assert!((x - corners[corner]).norm() < 1e-14, "{at:?}: {x}");
        }
    }

    #[test]
    fn normals_point_out_of_the_body() {
        let (mesh, _) = bent();
        let seam = mesh.boundary("lower.seam").expect("it has one").edges[0];
        let bottom = mesh.boundary("bottom").expect("it has one").edges[0];
        assert!(mesh.edge_normal(seam, 0.3).y > 0.9);
        assert!((mesh.edge_normal(bottom, 0.3) - Point::new(0.0, -1.0)).norm() < 1e-15);
    }

    #[test]
    fn a_mesh_far_from_its_geometry_is_refused_with_the_node() {
        let circle = Curve::Circle { centre: [1.0, -2.0], radius: 2.0 };
        let words = two_blocks().bend("arc", &["top".into()], &circle).unwrap_err().to_string();
        assert!(words.contains("geometry.arc") && words.contains("(0.9, 2)"), "{words}");
    }
}
