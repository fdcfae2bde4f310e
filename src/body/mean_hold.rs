//! Bodies whose mean motion is held.
//!
//! A body that nothing drives along some rigid motion is held there without a place where it is held: its mean shift, or its mean
//! turn, is prescribed. Vertices hold it while the system is solved, its *anchors*; the whole body is moved rigidly to where its
//! mean is as it was asked for, and a force that is spread all over it balances what drives it, so that the anchors carry nothing.

use super::rigid::{Motion, rigid_displacement};
use crate::geometry::{AXES, Point, cross};
use crate::mesh::MacroMesh;
use nalgebra::DMatrix;
use std::collections::HashSet;

/// A vertex within a body holds its turn if it resists it by this share of what the best one on its boundary does.
const ENOUGH: f64 = 0.5;

/// Directions closer than this (radians) are one: a thousandth of a shift across them would have to be told from nothing.
const SAME: f64 = 1e-3;

/// A body whose mean motion is held, on one mesh of it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MeanHold {
    /// Name of the support in the case file.
    pub name: String,
    /// Name of the body.
    pub body: String,
    /// What is held of its motion: no mode twice, and no more than two shifts.
    pub held: Vec<HeldMode>,
    /// Middle of the body, by its macro triangles.
    pub middle: Point,
    /// Largest distance of a vertex from the middle.
    pub reach: f64,
    /// Where it is held while the system is solved; nothing if the vertices cannot hold its turn.
    pub anchors: Vec<Anchor>,
}

/// A rigid mode of a body whose mean is held.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeldMode {
    /// Key of the mode in the case file, as `ux` or `angle`.
    pub key: &'static str,
    /// Shifts along x and y, and the turn about the middle of the body: a shift by one (length), or a turn by one (radian).
    pub mode: Motion,
    /// How far the body moves along it in the mean (length, or radians).
    pub value: f64,
}

impl HeldMode {
    /// Whether it is the turn.
    pub fn is_turn(&self) -> bool {
        self.mode[2] != 0.0
    }

    /// The direction of a shift.
    pub fn direction(&self) -> Point {
        Point::new(self.mode[0], self.mode[1])
    }
}

/// A vertex that is held along a direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Anchor {
    /// The macro vertex.
    pub vertex: u32,
    /// Where it is.
    pub place: Point,
    /// The direction, a unit vector.
    pub direction: Point,
}

impl MeanHold {
    /// Words for modes that follow from each other; nothing if there are none.
    pub fn redundant(&self) -> Option<String> {
        let shifts: Vec<&HeldMode> = self.held.iter().filter(|held| !held.is_turn()).collect();
        let pairs = (0..shifts.len()).flat_map(|k| (0..k).map(move |other| [other, k]));
        let mut pairs = pairs.map(|pair| pair.map(|k| shifts[k]));
        if let Some([a, b]) = pairs.find(|[a, b]| cross(a.direction(), b.direction()).abs() < SAME) {
            return Some(format!("{} and {} hold one shift of \"{}\" twice; leave one of them out", a.key, b.key, self.body));
        }
        let [a, b, c] = shifts[..] else { return None };
        let all = format!("{}, {} and {} are three shifts of \"{}\"", a.key, b.key, c.key, self.body);
        Some(format!("{all}, of which two tell the third; leave one of them out"))
    }

    /// The support of a body of a mesh, which holds no motion yet.
    pub fn of_body(name: &str, body: &str, mesh: &MacroMesh) -> Self {
        Self { name: name.into(), body: body.into(), ..Self::default() }.on(mesh)
    }

    /// The same hold of the body on another mesh of it, with the modes as they are.
    pub fn on(&self, mesh: &MacroMesh) -> Self {
        let triangles = self.triangles(mesh);
        let (middle, vertices) = (middle(mesh, &triangles), vertices(mesh, &triangles));
        let distances = vertices.iter().map(|(vertex, _)| (mesh.vertices[*vertex as usize] - middle).norm());
        let reach = distances.fold(f64::MIN_POSITIVE, f64::max);
        Self { middle, reach, anchors: self.anchors(mesh, middle, &vertices).unwrap_or_default(), ..self.clone() }
    }

    /// Macro triangles of the body, which is of one piece, in ascending order: one beside the other, so that none of other bodies
    /// is looked at.
    fn triangles(&self, mesh: &MacroMesh) -> Vec<usize> {
        let pieces = mesh.pieces.iter().filter(|piece| mesh.bodies[piece.body] == self.body);
        let mut open: Vec<usize> = pieces.map(|piece| piece.first as usize).collect();
        let mut found: HashSet<usize> = open.iter().copied().collect();
        while let Some(triangle) = open.pop() {
            let beside = mesh.triangles[triangle].edges.iter().flat_map(|&edge| mesh.edges[edge as usize].triangles);
            open.extend(beside.flatten().map(|other| other as usize).filter(|&other| found.insert(other)));
        }
        let mut found: Vec<usize> = found.into_iter().collect();
        found.sort_unstable();
        found
    }

    /// As many anchors as modes that are held, so that none of them is free: near the middle for shifts, along the only one, or
    /// both axes; for a turn where it is resisted beside these; and rather within the body than on its boundary. Nothing if no vertex
    /// resists the turn.
    fn anchors(&self, mesh: &MacroMesh, about: Point, vertices: &[(u32, bool)]) -> Option<Vec<Anchor>> {
        let distance = |vertex: &u32| (mesh.vertices[*vertex as usize] - about).norm();
        let inner_first = |a: &(u32, bool), b: &(u32, bool)| a.1.cmp(&b.1);
        let near = vertices.iter().min_by(|a, b| inner_first(a, b).then(distance(&a.0).total_cmp(&distance(&b.0))))?.0;
        let anchor = |vertex: u32, direction| Anchor { vertex, place: mesh.vertices[vertex as usize], direction };
        let shifts: Vec<Point> = self.held.iter().filter(|held| !held.is_turn()).map(HeldMode::direction).collect();
        let shifts = if shifts.len() == 2 { AXES.to_vec() } else { shifts };
        let mut anchors: Vec<Anchor> = shifts.into_iter().map(|direction| anchor(near, direction)).collect();
        if anchors.len() == self.held.len() {
            return Some(anchors);
        }
        let resistance = |last: &Anchor| {
            let held = |i: usize, j: usize| {
                let anchor = anchors.get(i).unwrap_or(last);
                rigid_displacement(about, &self.held[j].mode, anchor.place).dot(&anchor.direction)
            };
            DMatrix::from_fn(self.held.len(), self.held.len(), held).determinant().abs()
        };
        let candidates = vertices.iter().flat_map(|&(vertex, outer)| AXES.map(|axis| (outer, anchor(vertex, axis))));
        let candidates: Vec<(bool, Anchor, f64)> = candidates.map(|(outer, last)| (outer, last, resistance(&last))).collect();
        let most = candidates.iter().map(|candidate| candidate.2).fold(0.0, f64::max);
        let enough = candidates.into_iter().filter(|candidate| candidate.2 > 0.0 && candidate.2 >= ENOUGH * most);
        let last = enough.min_by(|a, b| a.0.cmp(&b.0).then(b.2.total_cmp(&a.2)))?.1;
        anchors.push(last);
        Some(anchors)
    }
}

/// Middle of macro triangles.
fn middle(mesh: &MacroMesh, triangles: &[usize]) -> Point {
    let (mut area, mut moment) = (0.0, Point::zeros());
    for &triangle in triangles {
        let [a, b, c] = mesh.corners(triangle);
        let double = cross(b - a, c - a);
        area += double;
        moment += double * (a + b + c) / 3.0;
    }
    moment / area
}

/// Vertices of macro triangles, and whether each is on their boundary; in ascending order.
fn vertices(mesh: &MacroMesh, triangles: &[usize]) -> Vec<(u32, bool)> {
    let mut seen = HashSet::new();
    let mut once: HashSet<u32> = HashSet::new();
    for triangle in triangles.iter().map(|&triangle| &mesh.triangles[triangle]) {
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
