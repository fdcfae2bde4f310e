//! Macro meshes that are refined where it is asked for, by newest vertex bisection.
//!
//! Each macro triangle has one side that it is halved at: the longest one in the file, the one across from the newest vertex
//! after that, so that all descendants of a triangle are of four shapes at most (Sewell 1972; Mitchell 1988). Slivers would
//! stay slivers that way: they are halved at their longest sides until they are none (Rivara, Int. J. Numer. Meth. Engng. 20,
//! 1984). What is halved is halved for both triangles beside it, so that the mesh stays conforming; new vertices of a bent side
//! lie on its curve.

use crate::geometry::Point;
use crate::mesh::macro_mesh::{MacroMesh, MacroTriangle};
use crate::mesh::refined::origin::Origin;

/// A side that is so many times shorter than the longest one of its triangle is halved after that one only.
const SLENDER: f64 = 3.0;

/// The side across from the newest vertex is that much shorter than the longest one in slivers alone: with sides a < b < c,
/// halved at c, the part at a is as long as c/2, and so a < c/3.
const SHORT: f64 = SLENDER / 2.0;

/// Lengths that differ by less than this share of them are taken for equal.
const EQUAL: f64 = 1e-9;

/// A macro mesh whose triangles know where they are halved.
#[derive(Clone, Debug)]
pub struct BisectedMesh {
    /// The mesh.
    pub mesh: MacroMesh,
    /// The side that each triangle is halved at: 0, 1 or 2.
    sides: Vec<usize>,
    /// Where each triangle lies in the mesh that this one began with.
    pub origins: Vec<Origin>,
}

/// A part of a triangle: its corners, the newest one first.
#[derive(Clone, Copy)]
struct TrianglePart([u32; 3]);

impl BisectedMesh {
    /// A mesh of a file: its triangles are halved at their longest sides first.
    pub fn new(mesh: MacroMesh) -> Self {
        let side = |triangle: &MacroTriangle| longest(triangle.edges.map(|edge| mesh.edge_length(edge)));
        let sides = mesh.triangles.iter().map(side).collect();
        let origins = (0..mesh.triangles.len()).map(Origin::whole).collect();
        Self { mesh, sides, origins }
    }

    /// This mesh as one that refinement begins with: each triangle is its own origin, and is halved next where it would be anyway.
    pub fn as_first(&self) -> Self {
        let origins = (0..self.mesh.triangles.len()).map(Origin::whole).collect();
        Self { mesh: self.mesh.clone(), sides: self.sides.clone(), origins }
    }

    /// The mesh with all sides of the marked triangles halved, but for the short ones of slivers.
    pub fn refined(&self, marked: impl Iterator<Item = u32>) -> Self {
        let halved = self.halved(marked);
        let mut vertices = self.mesh.vertices.clone();
        let mut middles = vec![None; self.mesh.edges.len()];
        for edge in (0..self.mesh.edges.len()).filter(|&edge| halved[edge]) {
            middles[edge] = Some(vertices.len() as u32);
            vertices.push(self.mesh.edge_position(edge as u32, 0.5));
        }
        let mut next = self.mesh.without_triangles(vertices);
        let (mut sides, mut origins) = (Vec::new(), Vec::new());
        for (triangle, known) in self.mesh.triangles.iter().enumerate() {
            for (part, side) in self.parts(triangle, &middles) {
                sides.push(side.unwrap_or_else(|| part.side(&next.vertices)));
                origins.push(self.part(triangle, &middles, part.0).within(&self.origins));
                next.add_part(part.0, known);
            }
        }
        let mesh = next.divide_edges(&self.mesh, |edge| Some((middles[edge]?, 0.5)));
        Self { mesh, sides, origins }
    }

    /// Where a part of a triangle lies in it, from its corners: those of the triangle, and middles of its edges.
    fn part(&self, triangle: usize, middles: &[Option<u32>], corners: [u32; 3]) -> Origin {
        let MacroTriangle { vertices, edges, .. } = &self.mesh.triangles[triangle];
        let whole = Origin::whole(triangle).corners;
        let place = |vertex: u32| {
            (0..3).fold([0.0; 3], |found, k| {
                if vertices[k] == vertex {
                    whole[k]
                } else if middles[edges[k] as usize] == Some(vertex) {
                    std::array::from_fn(|l| 0.5 * (whole[k][l] + whole[(k + 1) % 3][l]))
                } else {
                    found
                }
            })
        };
        Origin { triangle: triangle as u32, corners: corners.map(place) }
    }

    /// Which edges are halved: those of the marked triangles that are not too short, and as many as it takes that every triangle
    /// that has a halved edge is halved at its own side.
    fn halved(&self, marked: impl Iterator<Item = u32>) -> Vec<bool> {
        let mut halved = vec![false; self.mesh.edges.len()];
        let mut waiting: Vec<u32> = marked.flat_map(|triangle| self.long_edges(triangle as usize)).collect();
        while let Some(edge) = waiting.pop() {
            if std::mem::replace(&mut halved[edge as usize], true) {
                continue;
            }
            for triangle in self.mesh.edges[edge as usize].triangles.into_iter().flatten() {
                waiting.extend(self.halved_together(triangle as usize));
            }
        }
        halved
    }

    /// The edges of a triangle that are halved as soon as one of them is: its own side, and both long ones of a needle. One alone
    /// would leave a triangle with an angle of nearly π, and large errors (Babuška, Aziz, SIAM J. Numer. Anal. 13, 1976).
    fn halved_together(&self, triangle: usize) -> Vec<u32> {
        let long: Vec<u32> = self.long_edges(triangle).collect();
        if long.len() == 2 { long } else { vec![self.mesh.triangles[triangle].edges[self.sides[triangle]]] }
    }

    /// The edges of a triangle, without those that are short beside the longest one.
    fn long_edges(&self, triangle: usize) -> impl Iterator<Item = u32> {
        let edges = self.mesh.triangles[triangle].edges;
        let lengths = edges.map(|edge| self.mesh.edge_length(edge));
        let least = lengths[longest(lengths)] / SLENDER * (1.0 - EQUAL);
        edges.into_iter().zip(lengths).filter(move |(_, length)| *length >= least).map(|(edge, _)| edge)
    }

    /// The parts of a triangle by the middles of its edges, each with the side that it is halved at next if it is no new one.
    fn parts(&self, triangle: usize, middles: &[Option<u32>]) -> Vec<(TrianglePart, Option<usize>)> {
        let MacroTriangle { vertices, edges, .. } = &self.mesh.triangles[triangle];
        let side = self.sides[triangle];
        let Some(middle) = middles[edges[side] as usize] else {
            return vec![(TrianglePart(*vertices), Some(side))];
        };
        // Corners in order from the newest one: the side lies across from it.
        let turned = [(side + 2) % 3, side, (side + 1) % 3];
        let whole = TrianglePart(turned.map(|k| vertices[k]));
        let halves = whole.halves(middle);
        // The halves are halved at the sides between the newest corner and the two others.
        let theirs = [edges[(side + 2) % 3], edges[(side + 1) % 3]].map(|edge| middles[edge as usize]);
        let parts = halves.into_iter().zip(theirs).flat_map(|(half, middle)| match middle {
            Some(middle) => half.halves(middle).to_vec(),
            None => vec![half],
        });
        parts.map(|part| (part, None)).collect()
    }
}

impl TrianglePart {
    /// Both halves by the middle of the side across from the newest corner; the middle is their newest corner.
    fn halves(self, middle: u32) -> [Self; 2] {
        let Self([a, b, c]) = self;
        [Self([middle, a, b]), Self([middle, c, a])]
    }

    /// The side that it is halved at: across from the newest corner, or the longest one if that is much longer.
    fn side(self, vertices: &[Point]) -> usize {
        let corners = self.0.map(|corner| vertices[corner as usize]);
        let lengths = [0, 1, 2].map(|k| (corners[(k + 1) % 3] - corners[k]).norm());
        let longest = longest(lengths);
        if lengths[longest] > SHORT * (1.0 + EQUAL) * lengths[1] { longest } else { 1 }
    }
}

/// The longest of three sides. Sides of one length are told by their number: rounding decides nothing.
fn longest(lengths: [f64; 3]) -> usize {
    (1..3).fold(0, |best, k| if lengths[k] > lengths[best] * (1.0 + EQUAL) { k } else { best })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Curve, cross};
    use crate::mesh::samples;
    use crate::mesh::samples::two_blocks;
    use std::collections::HashSet;

    fn area(mesh: &MacroMesh, triangle: &MacroTriangle) -> f64 {
        let [a, b, c] = triangle.vertices.map(|vertex| mesh.vertices[vertex as usize]);
        0.5 * cross(b - a, c - a)
    }

    /// Halves the triangles that hold a point, again and again.
    fn towards(point: Point, times: usize) -> Vec<BisectedMesh> {
        let mut all = vec![BisectedMesh::new(two_blocks())];
        for _ in 0..times {
            let last = &all[all.len() - 1];
            let near = (0..last.mesh.triangles.len()).filter(|&k| last.mesh.locate(k, point).is_some());
            let marked: Vec<u32> = near.map(|k| k as u32).collect();
            all.push(last.refined(marked.into_iter()));
        }
        all
    }

    #[test]
    fn meshes_stay_conforming_and_keep_their_area_bodies_and_boundaries() {
        for mesh in towards(Point::new(0.0, 1.0), 12).iter().map(|bisected| &bisected.mesh) {
            let whole: f64 = mesh.triangles.iter().map(|triangle| area(mesh, triangle)).sum();
            assert!((whole - 4.0).abs() < 1e-12, "{whole}");
            assert!(mesh.triangles.iter().all(|triangle| area(mesh, triangle) > 0.0));
            for (k, edge) in mesh.edges.iter().enumerate() {
                for triangle in edge.triangles.into_iter().flatten() {
                    assert!(mesh.triangles[triangle as usize].edges.contains(&(k as u32)));
                }
            }
            // No vertex lies inside an edge: all edges with one triangle are on the outline.
            let inner = mesh.edges.iter().filter(|edge| edge.triangles[1].is_none()).map(|edge| {
                let [a, b] = edge.vertices.map(|v| mesh.vertices[v as usize]);
                let on = |x: f64, v: [f64; 2]| v.iter().any(|v| (x - v).abs() < 1e-12);
                (a.x == b.x && on(a.x, [0.0, 2.0])) || (a.y == b.y && on(a.y, [0.0, 2.0]) || a.y == 1.0)
            });
            assert!(inner.into_iter().all(|on| on));
            for boundary in &mesh.boundaries {
                let length: f64 = boundary.edges.iter().map(|&edge| mesh.edge_length(edge)).sum();
                let first = two_blocks();
                let before: f64 =
                    first.boundary(&boundary.name).expect("named").edges.iter().map(|&edge| first.edge_length(edge)).sum();
                assert!((length - before).abs() < 1e-12, "{}", boundary.name);
            }
            for piece in &mesh.pieces {
                assert_eq!(mesh.triangles[piece.first as usize].body as usize, piece.body);
            }
        }
    }

    #[test]
    fn every_part_knows_where_it_lies() {
        let all = towards(Point::new(0.9, 1.0), 4);
        for (before, after) in all.iter().map(|_| &all[0]).zip(&all[1..]) {
            let mut areas = vec![0.0; before.mesh.triangles.len()];
            for (triangle, origin) in after.mesh.triangles.iter().zip(&after.origins) {
                areas[origin.triangle as usize] += origin.area();
                let whole = before.mesh.triangles[origin.triangle as usize].vertices;
                for (vertex, l) in triangle.vertices.iter().zip(origin.corners) {
                    let at = (0..3).fold(Point::zeros(), |sum, k| sum + l[k] * before.mesh.vertices[whole[k] as usize]);
                    assert!((after.mesh.vertices[*vertex as usize] - at).norm() < 1e-14);
                }
            }
            assert!(areas.iter().all(|area| (area - 1.0).abs() < 1e-14));
        }
    }

    #[test]
    fn triangles_are_of_few_shapes_however_often_they_are_halved() {
        let all = towards(Point::new(0.0, 1.0), 20);
        let angles = |mesh: &MacroMesh| -> HashSet<i64> {
            let mut found = HashSet::new();
            for triangle in &mesh.triangles {
                let x = triangle.vertices.map(|vertex| mesh.vertices[vertex as usize]);
                for k in 0..3 {
                    let angle = (x[(k + 1) % 3] - x[k]).angle(&(x[(k + 2) % 3] - x[k]));
                    found.insert((angle * 1e6).round() as i64);
                }
            }
            found
        };
        let mesh = &all[20].mesh;
        let first = all[0].mesh.triangles.len();
        assert!(angles(mesh).len() <= 12 * first, "four shapes of three angles for each triangle");
        assert!(mesh.triangles.len() < 40 * 20, "{} triangles: refinement stays local", mesh.triangles.len());
        let smallest = mesh.triangles.iter().map(|triangle| area(mesh, triangle)).fold(f64::INFINITY, f64::min);
        assert!(smallest < 1e-9);
    }

    /// Columns that are thirty times as high as wide.
    #[test]
    fn needles_become_good_triangles() {
        let columns = 12;
        let mesh = samples::columns(columns, 30.0);
        let mut all = vec![BisectedMesh::new(mesh)];
        for _ in 0..8 {
            let last = &all[all.len() - 1];
            let near = (0..last.mesh.triangles.len()).filter(|&k| last.mesh.locate(k, Point::new(0.0, 0.0)).is_some());
            all.push(last.refined(near.map(|k| k as u32)));
        }
        let angles = |mesh: &MacroMesh, triangle: &MacroTriangle| {
            let x = triangle.vertices.map(|vertex| mesh.vertices[vertex as usize]);
            [0, 1, 2].map(|k| (x[(k + 1) % 3] - x[k]).angle(&(x[(k + 2) % 3] - x[k])).to_degrees())
        };
        for bisected in &all {
            let mesh = &bisected.mesh;
            let largest = mesh.triangles.iter().flat_map(|triangle| angles(mesh, triangle)).fold(0.0, f64::max);
            assert!(largest < 145.0, "{largest} degrees");
        }
        let mesh = &all[8].mesh;
        let (corner, _) =
            mesh.triangles.iter().enumerate().find(|(k, _)| mesh.locate(*k, Point::new(0.0, 0.0)).is_some()).expect("inside");
        let smallest = angles(mesh, &mesh.triangles[corner]).into_iter().fold(f64::INFINITY, f64::min);
        println!("{} triangles, the smallest angle in the corner is {smallest:.1} degrees", mesh.triangles.len());
        assert!(smallest > 10.0, "{smallest} degrees in the corner");
    }

    #[test]
    fn all_sides_of_a_marked_triangle_are_halved() {
        let before = &towards(Point::new(0.9, 1.0), 2)[2];
        let after = before.refined([0, 3].into_iter());
        let is_new = |vertex: u32| vertex as usize >= before.mesh.vertices.len();
        for marked in [0, 3] {
            let corners = before.mesh.triangles[marked].vertices.map(|vertex| before.mesh.vertices[vertex as usize]);
            let middles: Vec<Point> = (0..3).map(|k| 0.5 * (corners[k] + corners[(k + 1) % 3])).collect();
            for middle in middles {
                let found = (0..after.mesh.vertices.len() as u32).filter(|&v| is_new(v));
                assert_eq!(found.filter(|&v| (after.mesh.vertices[v as usize] - middle).norm() < 1e-14).count(), 1);
            }
        }
        // Two triangles are quartered, their neighbours halved at least.
        assert!(after.mesh.triangles.len() >= before.mesh.triangles.len() + 6);
        assert_eq!(before.refined(std::iter::empty()).mesh.triangles.len(), before.mesh.triangles.len());
    }

    #[test]
    fn new_vertices_lie_on_the_curve_of_a_bent_side() {
        let mut mesh = two_blocks();
        let circle = Curve::Circle { centre: [1.0, -2.0], radius: 10f64.sqrt() };
        mesh.bend("arc", &["lower.seam".into()], &circle).expect("the ends lie on it");
        let mut bisected = BisectedMesh::new(mesh);
        for _ in 0..3 {
            let all = 0..bisected.mesh.triangles.len() as u32;
            bisected = bisected.refined(all);
        }
        let edges = &bisected.mesh.boundary("lower.seam").expect("named").edges;
        assert_eq!(edges.len(), 8);
        for &edge in edges {
            for t in [0.0, 0.3, 1.0] {
                let x = bisected.mesh.edge_position(edge, t);
                assert!((x - circle.point(circle.nearest(x))).norm() < 1e-14, "{x}");
            }
            let [a, b] = bisected.mesh.edges[edge as usize].vertices.map(|v| bisected.mesh.vertices[v as usize]);
            assert!((bisected.mesh.edge_position(edge, 1e-9) - a).norm() < 1e-8);
            assert!((bisected.mesh.edge_position(edge, 1.0 - 1e-9) - b).norm() < 1e-8);
        }
    }
}
