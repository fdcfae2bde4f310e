//! Bodies whose mean motion is held.
//!
//! A body that nothing drives along some rigid motion is held there without a place where it is held: its mean shift, or its mean
//! turn, is prescribed. Vertices hold it while the system is solved, its *anchors*; the whole body is moved rigidly to where its
//! mean is as it was asked for, and a force that is spread all over it balances what drives it, so that the anchors carry nothing.

use crate::geometry::{Point, cross};
use crate::mesh::MacroMesh;
use std::collections::HashSet;

/// A mean turn is held by vertices that are at least this share of the largest distance from the middle.
const FAR: f64 = 0.5;

/// A body whose mean motion is held.
#[derive(Clone, Debug, PartialEq)]
pub struct MeanHold {
    /// Name of the support in the case file.
    pub name: String,
    /// Name of the body.
    pub body: String,
    /// Its mean shift along x and y (length), and its mean turn (radians); free where nothing is given.
    pub mean: [Option<f64>; 3],
}

/// A vertex that is held along an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Anchor {
    /// The macro vertex.
    pub vertex: u32,
    /// Where it is.
    pub place: Point,
    /// 0 along x, 1 along y.
    pub axis: usize,
}

impl MeanHold {
    /// Components of the motion whose mean is held.
    pub fn held(&self) -> impl Iterator<Item = usize> + use<> {
        let mean = self.mean;
        (0..3).filter(move |&k| mean[k].is_some())
    }

    /// Middle of the body, by its macro triangles.
    pub fn middle(&self, mesh: &MacroMesh) -> Point {
        let (mut area, mut moment) = (0.0, Point::zeros());
        for triangle in mesh.triangles.iter().filter(|triangle| mesh.bodies[triangle.body as usize] == self.body) {
            let [a, b, c] = triangle.vertices.map(|vertex| mesh.vertices[vertex as usize]);
            let double = cross(b - a, c - a);
            area += double;
            moment += double * (a + b + c) / 3.0;
        }
        moment / area
    }

    /// Largest distance of a vertex from the middle.
    pub fn reach(&self, mesh: &MacroMesh) -> f64 {
        let middle = self.middle(mesh);
        let distances = self.vertices(mesh).into_iter().map(|(vertex, _)| (mesh.vertices[vertex as usize] - middle).norm());
        distances.fold(f64::MIN_POSITIVE, f64::max)
    }

    /// One anchor for each component that is held, in their order: near the middle for shifts, far from it for a turn, and
    /// rather within the body than on its boundary. Nothing if the body has too few vertices.
    pub fn anchors(&self, mesh: &MacroMesh) -> Option<Vec<Anchor>> {
        let about = self.middle(mesh);
        let vertices = self.vertices(mesh);
        let distance = |vertex: &u32| (mesh.vertices[*vertex as usize] - about).norm();
        let largest = self.reach(mesh);
        let inner_first = |a: &(u32, bool), b: &(u32, bool)| a.1.cmp(&b.1);
        let near = vertices.iter().min_by(|a, b| inner_first(a, b).then(distance(&a.0).total_cmp(&distance(&b.0))))?.0;
        let others = vertices.iter().filter(|(vertex, _)| *vertex != near && distance(vertex) >= FAR * largest);
        let far = others.min_by(|a, b| inner_first(a, b).then(distance(&b.0).total_cmp(&distance(&a.0))))?.0;
        let arm = mesh.vertices[far as usize] - mesh.vertices[near as usize];
        let across = if arm.x.abs() > arm.y.abs() { 1 } else { 0 };
        let anchor = |vertex: u32, axis| Anchor { vertex, place: mesh.vertices[vertex as usize], axis };
        Some(self.held().map(|k| if k == 2 { anchor(far, across) } else { anchor(near, k) }).collect())
    }

    /// Vertices of the body, and whether each is on the boundary; in ascending order.
    fn vertices(&self, mesh: &MacroMesh) -> Vec<(u32, bool)> {
        let own = mesh.triangles.iter().filter(|triangle| mesh.bodies[triangle.body as usize] == self.body);
        let mut seen = HashSet::new();
        let mut once: HashSet<u32> = HashSet::new();
        for triangle in own {
            seen.extend(triangle.vertices);
            for edge in triangle.edges {
                if !once.insert(edge) {
                    once.remove(&edge);
                }
            }
        }
        let outer: HashSet<u32> = once.into_iter().flat_map(|edge| mesh.edges[edge as usize].vertices).collect();
        let mut all: Vec<(u32, bool)> = seen.into_iter().map(|vertex| (vertex, outer.contains(&vertex))).collect();
        all.sort_unstable();
        all
    }
}

/// Displacement at a point of component `k` of a rigid motion: shifts along x and y, and the turn about a point.
pub fn rigid_mode(about: Point, k: usize, x: Point) -> Point {
    let arm = x - about;
    [Point::new(1.0, 0.0), Point::new(0.0, 1.0), Point::new(-arm.y, arm.x)][k]
}
