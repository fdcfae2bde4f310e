//! Macro meshes with a vertex at a point that the case names, so that it is a node of every level.
//!
//! A point that is no vertex becomes one by the insertion of Bowyer and Watson (Comput. J. 24, 1981): the triangles whose
//! circumcircles hold it give way to triangles between it and the sides of what they leave. Where that makes an angle that is
//! too small, because the point lies near a vertex or near the boundary, the triangles around it are bisected first, as in
//! [`BisectedMesh`], until they are as small as that distance.

use crate::geometry::{Point, cross};
use crate::mesh::located::Located;
use crate::mesh::macro_mesh::{MacroMesh, MacroTriangle, NamedPoint, Spot, smallest_angle};
use crate::mesh::refined::bisection::BisectedMesh;
use std::collections::HashSet;

/// The smallest angle (radians, 20 degrees) that is good enough, whatever the mesh has.
const GOOD: f64 = 20.0 * std::f64::consts::PI / 180.0;

/// Share of the smallest angle around that is good enough, too.
const SHARE: f64 = 0.7;

/// How often the triangles around a point are bisected at most: down to the distance from a vertex at which it counts as one.
const ROUNDS: usize = 12;

/// Sagittas of a bent edge that a new vertex must lie away from its chord.
const SAGITTAS: f64 = 3.0;

impl MacroMesh {
    /// Makes a point that the case names a vertex, of one of the bodies that `is_body` tells.
    ///
    /// # Errors
    /// Words, if it lies in no body, or in several.
    pub fn add_point(&mut self, spot: &Spot, is_body: impl Fn(&str) -> bool + Copy) -> Result<(), String> {
        if self.vertex_at(spot).is_some() {
            return Ok(());
        }
        let piece = self.piece_at(spot, is_body)?;
        let vertex = self.make_vertex(piece, Point::from(spot.place)).ok_or_else(|| {
            "no mesh with a vertex there has decent triangles; draw a point there in the mesh, or take a point nearby".to_string()
        })?;
        self.points.push(NamedPoint { spot: spot.clone(), vertex });
        Ok(())
    }

    /// The vertex at a point of a piece, which is made if there is none.
    fn make_vertex(&mut self, piece: usize, mut x: Point) -> Option<u32> {
        if let Some(Located::Edge(edge, t)) = self.place_in(piece, x) {
            x = self.edge_position(edge, t);
        }
        let mut bisected = BisectedMesh::new(self.clone());
        let mut best: Option<Insertion> = None;
        let mut wanted = None;
        for _ in 0..=ROUNDS {
            let mesh = &bisected.mesh;
            let Some(place) = mesh.place_in(piece, x) else { break };
            if let Located::Vertex(vertex) = place {
                if bisected.mesh.vertices.len() > self.vertices.len() {
                    *self = bisected.mesh;
                }
                return Some(vertex);
            }
            let around = mesh.triangles_around(place);
            let before = || around.iter().map(|&triangle| mesh.smallest_angle(triangle as usize)).fold(GOOD / SHARE, f64::min);
            let wanted = *wanted.get_or_insert_with(|| SHARE * before());
            let found = [true, false].map(|grows| mesh.inserted(place, x, grows));
            let [grown, plain] = found;
            let found = if grown.angle >= plain.angle { grown } else { plain };
            if best.as_ref().is_none_or(|best| found.angle > best.angle) {
                best = Some(found);
            }
            if best.as_ref().is_some_and(|best| best.angle >= wanted) {
                break;
            }
            bisected = bisected.refined(around.into_iter());
        }
        let best = best.filter(|best| best.angle > 0.0)?;
        *self = best.mesh;
        Some(self.vertices.len() as u32 - 1)
    }

    /// The triangles that a place belongs to.
    fn triangles_around(&self, place: Located) -> Vec<u32> {
        match place {
            Located::Vertex(vertex) => self.triangle_at(vertex).into_iter().collect(),
            Located::Edge(edge, _) => vec![self.beside(edge).0],
            Located::Triangle(triangle) => vec![triangle],
        }
    }

    /// The mesh with a vertex at a place, which takes the triangles around whose circumcircles hold it, or not.
    fn inserted(&self, place: Located, x: Point, grows: bool) -> Insertion {
        let split = if let Located::Edge(edge, t) = place { Some((edge, t)) } else { None };
        let mut cavity = self.triangles_around(place);
        let named: HashSet<u32> = self.boundaries.iter().flat_map(|boundary| boundary.edges.iter().copied()).collect();
        let mut at = 0;
        while grows && at < cavity.len() {
            for edge in self.triangles[cavity[at] as usize].edges {
                let beside = self
                    .across(cavity[at], edge)
                    .filter(|other| !cavity.contains(other) && !named.contains(&edge) && !self.is_interface(edge));
                cavity.extend(beside.filter(|&other| self.circle_holds(other, x)));
            }
            at += 1;
        }
        let new = self.vertices.len() as u32;
        let mut next = self.without_triangles(self.vertices.iter().copied().chain([x]).collect());
        let mut angle = f64::INFINITY;
        for (triangle, known) in self.triangles.iter().enumerate() {
            if !cavity.contains(&(triangle as u32)) {
                next.add_part(known.vertices, known);
                continue;
            }
            for k in 0..3 {
                let edge = known.edges[k];
                let is_inner = self.across(triangle as u32, edge).is_some_and(|other| cavity.contains(&other));
                if is_inner || split.is_some_and(|(split, _)| split == edge) {
                    continue;
                }
                let corners = [new, known.vertices[k], known.vertices[(k + 1) % 3]];
                angle = angle.min(self.new_angle(edge, corners.map(|corner| next.vertices[corner as usize])));
                next.add_part(corners, known);
            }
        }
        let mesh = next.divide_edges(self, |edge| split.filter(|(split, _)| *split as usize == edge).map(|(_, t)| (new, t)));
        Insertion { mesh, angle }
    }

    /// The triangle on the other side of an edge.
    pub fn across(&self, triangle: u32, edge: u32) -> Option<u32> {
        self.edges[edge as usize].triangles.into_iter().flatten().find(|&other| other != triangle)
    }

    /// Whether the circumcircle of a triangle holds a point.
    fn circle_holds(&self, triangle: u32, x: Point) -> bool {
        let MacroTriangle { vertices, edges, .. } = &self.triangles[triangle as usize];
        let [a, b, c] = vertices.map(|vertex| self.vertices[vertex as usize] - x);
        let size = edges.map(|edge| self.edge_length(edge)).into_iter().fold(0.0, f64::max);
        let inside = a.norm_squared() * cross(b, c) + b.norm_squared() * cross(c, a) + c.norm_squared() * cross(a, b);
        inside > 1e-9 * size.powi(4)
    }

    /// Smallest angle of a new triangle (radians) by its corners, the new one first; zero if it is turned round, or lies too
    /// near the arc of a bent edge.
    fn new_angle(&self, edge: u32, corners: [Point; 3]) -> f64 {
        let [x, a, b] = corners;
        let height = cross(b - a, x - a) / (b - a).norm();
        let sagitta = (self.edge_position(edge, 0.5) - 0.5 * (a + b)).norm();
        if height <= SAGITTAS * sagitta {
            return 0.0;
        }
        smallest_angle(corners)
    }
}

/// A mesh with one vertex more.
struct Insertion {
    mesh: MacroMesh,
    /// The smallest angle around the new vertex (radians).
    angle: f64,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Curve;
    use crate::mesh::samples::two_blocks;

    fn spot(x: f64, y: f64, body: Option<&str>) -> Spot {
        Spot { place: [x, y], body: body.map(str::to_string) }
    }

    fn whole(mesh: &MacroMesh) -> f64 {
        let corners = mesh.triangles.iter().map(|triangle| triangle.vertices.map(|v| mesh.vertices[v as usize]));
        corners.map(|[a, b, c]| 0.5 * cross(b - a, c - a)).sum()
    }

    #[test]
    fn any_point_becomes_a_vertex_of_a_decent_mesh() {
        let before = two_blocks();
        let least = (0..before.triangles.len()).map(|k| before.smallest_angle(k)).fold(f64::INFINITY, f64::min);
        for [x, y] in
            [[0.4, 0.3], [1.0, 0.5], [0.003, 0.5], [1.9, 1.93], [0.7, 0.0], [0.01, 0.008], [1.3, 2.0], [1.99, 0.0], [0.9, 1.004]]
        {
            let mut mesh = before.clone();
            mesh.add_point(&spot(x, y, None), |_| true).expect("a point of a body");
            let vertex = mesh.vertex_at(&spot(x, y, None)).expect("it was made");
            assert!((mesh.vertices[vertex as usize] - Point::new(x, y)).norm() < 1e-12);
            assert!((whole(&mesh) - 4.0).abs() < 1e-12, "({x}, {y})");
            let smallest = (0..mesh.triangles.len()).map(|k| mesh.smallest_angle(k)).fold(f64::INFINITY, f64::min);
            assert!(smallest > 0.3 * least.min(GOOD), "({x}, {y}): {} degrees", smallest.to_degrees());
            for boundary in &before.boundaries {
                let length = |mesh: &MacroMesh| -> f64 {
                    let edges = &mesh.boundary(&boundary.name).expect("it stays").edges;
                    edges.iter().map(|&edge| mesh.edge_length(edge)).sum()
                };
                assert!((length(&mesh) - length(&before)).abs() < 1e-12);
            }
            assert!(mesh.pieces.iter().all(|piece| mesh.triangles[piece.first as usize].body as usize == piece.body));
        }
    }

    #[test]
    fn a_vertex_stays_one_and_a_point_very_near_is_it() {
        let mut mesh = two_blocks();
        let count = mesh.vertices.len();
        for place in [spot(0.0, 0.0, None), spot(1e-6, 0.0, None)] {
            mesh.add_point(&place, |_| true).expect("a corner");
            assert_eq!(mesh.vertices[mesh.vertex_at(&place).expect("made") as usize], Point::zeros());
        }
        assert_eq!(mesh.vertices.len(), count);
        mesh.add_point(&spot(0.5, 0.4, None), |_| true).expect("inside");
        let bisected = BisectedMesh::new(mesh.clone()).refined(0..mesh.triangles.len() as u32).mesh;
        let vertex = bisected.vertex_at(&spot(0.5, 0.4, None)).expect("it stays");
        assert_eq!(bisected.vertices[vertex as usize], Point::new(0.5, 0.4));
    }

    #[test]
    fn a_point_of_a_bent_edge_lies_on_its_curve() {
        let mut mesh = two_blocks();
        let circle = Curve::Circle { centre: [1.0, -2.0], radius: 10f64.sqrt() };
        mesh.bend("arc", &["lower.seam".into()], &circle).expect("the ends lie on it");
        let x = circle.point(circle.nearest(Point::new(0.5, 1.1)));
        let place = spot(x.x, x.y, Some("lower"));
        mesh.add_point(&place, |_| true).expect("a point of the arc");
        let vertex = mesh.vertex_at(&place).expect("made");
        assert!((mesh.vertices[vertex as usize] - x).norm() < 1e-12);
        let seam = mesh.boundary("lower.seam").expect("named").edges.clone();
        assert!(seam.len() > 1 && seam.iter().all(|&edge| mesh.edges[edge as usize].shape.is_some()));
        for &edge in &seam {
            let middle = mesh.edge_position(edge, 0.5);
            assert!((middle - circle.point(circle.nearest(middle))).norm() < 1e-12);
        }
    }

    #[test]
    fn a_point_of_no_body_or_of_two_is_refused() {
        let words = |x, y, body| two_blocks().add_point(&spot(x, y, body), |_| true).expect_err("refused");
        assert!(
            words(3.0, 0.5, None).contains("outside every body; the nearest vertex is [2, 0]")
                || words(3.0, 0.5, None).contains("[2, 1]")
        );
        assert!(words(0.5, 1.5, Some("lower")).contains("outside body \"lower\""));
        assert!(words(0.0, 1.0, None).contains("write body = "), "{}", words(0.0, 1.0, None));
        assert!(two_blocks().add_point(&spot(0.0, 1.0, Some("upper")), |_| true).is_ok());
        assert!(two_blocks().add_point(&spot(0.0, 1.0, None), |body| body == "upper").is_ok(), "the other one cannot be meant");
    }
}
