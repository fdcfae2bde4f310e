//! Where points that the case names lie in a mesh.

use super::macro_mesh::{MacroMesh, Spot};
use crate::geometry::Point;

/// Points so close to a vertex, or to an edge on the boundary, by the length of the edges there, are moved onto it.
const NEAR: f64 = 1e-3;

/// Where a point lies in a piece of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Located {
    /// On a vertex.
    Vertex(u32),
    /// On an edge of the boundary, at a fraction of it from its first vertex.
    Edge(u32, f64),
    /// In a triangle.
    Triangle(u32),
}

impl MacroMesh {
    /// Smallest box around all vertices of each piece: lower left and upper right corner. It is found once.
    pub fn bounds(&self) -> &[[Point; 2]] {
        self.bounds.get_or_init(|| {
            let mut bounds = vec![[Point::repeat(f64::INFINITY), Point::repeat(f64::NEG_INFINITY)]; self.pieces.len()];
            for triangle in &self.triangles {
                let [low, high] = &mut bounds[triangle.piece as usize];
                for &vertex in &triangle.vertices {
                    let x = self.vertices[vertex as usize];
                    (*low, *high) = (low.inf(&x), high.sup(&x));
                }
            }
            bounds
        })
    }

    /// The triangles of each body.
    pub fn triangles_by_body(&self) -> Vec<Vec<usize>> {
        let mut of_bodies = vec![Vec::new(); self.bodies.len()];
        self.triangles.iter().enumerate().for_each(|(at, triangle)| of_bodies[triangle.body as usize].push(at));
        of_bodies
    }

    /// The vertex at a point that the case names; nothing if the mesh was not made for it.
    pub fn vertex_at(&self, spot: &Spot) -> Option<u32> {
        self.points.iter().find(|point| point.spot == *spot).map(|point| point.vertex)
    }

    /// A triangle beside a vertex: the first one.
    pub fn triangle_at(&self, vertex: u32) -> Option<u32> {
        self.triangles.iter().position(|triangle| triangle.vertices.contains(&vertex)).map(|triangle| triangle as u32)
    }

    /// The one piece of a body that a point lies in.
    ///
    /// # Errors
    /// Words, if it lies in none, or in several.
    pub fn piece_at(&self, spot: &Spot, is_body: impl Fn(&str) -> bool + Copy) -> Result<usize, String> {
        let x = Point::from(spot.place);
        let is_meant = |name: &str| is_body(name) && spot.body.as_ref().is_none_or(|body| body == name);
        let named = |piece: &usize| is_meant(&self.bodies[self.pieces[*piece].body]);
        let all: Vec<usize> = (0..self.pieces.len()).filter(named).filter(|&piece| self.place_in(piece, x).is_some()).collect();
        let body = |piece: usize| self.bodies[self.pieces[piece].body].as_str();
        match all[..] {
            [piece] => Ok(piece),
            [] => Err(self.outside(spot, is_meant)),
            [first, .., last] if body(first) == body(last) => Err(format!(
                "lies on two pieces of body \"{}\", which nothing tells apart; take a point of one of them",
                body(first)
            )),
            [first, .., last] => {
                let (one, other) = (body(first), body(last));
                Err(format!("lies on body \"{one}\" and on body \"{other}\"; write body = \"{one}\" beside it, or the other one"))
            }
        }
    }

    /// Words for a point outside.
    fn outside(&self, spot: &Spot, is_meant: impl Fn(&str) -> bool) -> String {
        let x = Point::from(spot.place);
        let vertices = self.triangles.iter().filter(|triangle| is_meant(&self.bodies[triangle.body as usize]));
        let vertices = vertices.flat_map(|triangle| triangle.vertices.map(|vertex| (triangle.body, vertex)));
        let place = |vertex: u32| self.vertices[vertex as usize];
        let nearest = vertices.min_by(|(_, a), (_, b)| (place(*a) - x).norm().total_cmp(&(place(*b) - x).norm()));
        let of = spot.body.as_ref().map_or("every body".to_string(), |body| format!("body \"{body}\""));
        let nearest = nearest.map_or(String::new(), |(body, vertex)| {
            let at = place(vertex);
            format!("; the nearest vertex is [{}, {}] of body \"{}\"", at.x, at.y, self.bodies[body as usize])
        });
        format!("lies outside {of}{nearest}")
    }

    /// Where a point lies in a piece; nothing if it lies outside.
    pub(super) fn place_in(&self, piece: usize, x: Point) -> Option<Located> {
        let own = |triangle: &usize| self.triangles[*triangle].piece as usize == piece;
        let near: Vec<usize> = (0..self.triangles.len()).filter(own).filter(|&triangle| self.is_near(triangle, x)).collect();
        let edges = || near.iter().flat_map(|&triangle| self.triangles[triangle].edges);
        let on_vertex = edges().find_map(|edge| {
            let ends = self.edges[edge as usize].vertices.into_iter();
            ends.into_iter().find(|&vertex| (self.vertices[vertex as usize] - x).norm() <= NEAR * self.edge_length(edge))
        });
        let on_edge = || {
            let outer = edges().filter(|&edge| self.is_outer(edge));
            outer.into_iter().find_map(|edge| Some(Located::Edge(edge, self.fraction_of(edge, x)?)))
        };
        let inside = || near.iter().find(|&&triangle| self.locate(triangle, x).is_some()).map(|&k| Located::Triangle(k as u32));
        on_vertex.map(Located::Vertex).or_else(on_edge).or_else(inside)
    }

    /// Whether a point may lie in a macro triangle, or on its sides.
    fn is_near(&self, triangle: usize, x: Point) -> bool {
        let corners = self.corners(triangle);
        let size = self.triangles[triangle].edges.map(|edge| self.edge_length(edge)).into_iter().fold(0.0, f64::max);
        corners.iter().any(|corner| (x - corner).norm() <= 1.5 * size)
    }

    /// Fraction of an edge at which a point lies on it; nothing if it does not.
    fn fraction_of(&self, edge: u32, x: Point) -> Option<f64> {
        let [a, b] = self.edge_ends(edge);
        let t = match &self.edges[edge as usize].shape {
            None => (x - a).dot(&(b - a)) / (b - a).norm_squared(),
            Some(shape) => {
                let ([from, to], nearest) = (shape.range, shape.curve.nearest(x));
                let turns = shape.curve.period().map_or(0.0, |period| ((0.5 * (from + to) - nearest) / period).round() * period);
                (nearest + turns - from) / (to - from)
            }
        };
        let is_on = t > 0.0 && t < 1.0 && (self.edge_position(edge, t) - x).norm() <= NEAR * self.edge_length(edge);
        is_on.then_some(t)
    }
}
