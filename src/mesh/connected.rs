//! Meshes made of the triangles of others: edges are found again, with their shapes and their boundaries.

use super::edge_shape::EdgeShape;
use super::{BodyPiece, Boundary, MacroEdge, MacroMesh, MacroTriangle};
use crate::geometry::Point;
use std::collections::HashMap;

/// A mesh that is being connected.
pub(super) struct Connected {
    /// The mesh so far.
    pub mesh: MacroMesh,
    /// Edges by their ends, the smaller one first.
    known: HashMap<[u32; 2], u32>,
}

impl Connected {
    /// The bodies of a mesh without its triangles.
    pub fn new(before: &MacroMesh, vertices: Vec<Point>) -> Self {
        let mut ratios = before.ratios.clone();
        ratios.resize(vertices.len(), None);
        let pieces = before.pieces.iter().map(|piece| BodyPiece { first: u32::MAX, ..piece.clone() }).collect();
        let mesh = MacroMesh {
            file: before.file.clone(),
            vertices,
            ratios,
            triangles: Vec::new(),
            edges: Vec::new(),
            bodies: before.bodies.clone(),
            parts: before.parts.clone(),
            pieces,
            boundaries: Vec::new(),
            interfaces: Vec::new(),
            points: before.points.clone(),
            has_midsides: before.has_midsides,
        };
        Self { mesh, known: HashMap::new() }
    }

    /// Adds a triangle of the same part and piece as one of the mesh before.
    pub fn add(&mut self, vertices: [u32; 3], before: &MacroTriangle) {
        let triangle = self.mesh.triangles.len() as u32;
        let (mut edges, mut forward) = ([0; 3], [true; 3]);
        for k in 0..3 {
            let (a, b) = (vertices[k], vertices[(k + 1) % 3]);
            let count = self.mesh.edges.len() as u32;
            edges[k] = *self.known.entry([a.min(b), a.max(b)]).or_insert(count);
            if edges[k] == count {
                self.mesh.edges.push(MacroEdge { vertices: [a, b], triangles: [Some(triangle), None], shape: None });
            } else {
                self.mesh.edges[edges[k] as usize].triangles[1] = Some(triangle);
                forward[k] = false;
            }
        }
        let piece = &mut self.mesh.pieces[before.piece as usize];
        piece.first = piece.first.min(triangle);
        self.mesh.triangles.push(MacroTriangle { vertices, edges, forward, ..before.clone() });
    }

    /// Gives the edges the shapes, and the boundaries, of the edges that they are parts of; `divided` tells the vertex that
    /// divides an edge, and at which fraction of it.
    pub fn divide_edges(&mut self, before: &MacroMesh, divided: impl Fn(usize) -> Option<(u32, f64)>) {
        for (edge, known) in before.edges.iter().enumerate() {
            let Some(shape) = &known.shape else { continue };
            let [a, b] = known.vertices;
            match divided(edge) {
                None => self.bend([a, b], shape.clone()),
                Some((middle, t)) => {
                    let [from, to] = shape.range;
                    let at = shape.parameter(t);
                    self.bend([a, middle], EdgeShape { range: [from, at], ..shape.clone() });
                    self.bend([middle, b], EdgeShape { range: [at, to], ..shape.clone() });
                }
            }
        }
        let divided_curve = |curve: &Boundary| {
            let parts = curve.edges.iter().flat_map(|&edge| {
                let [a, b] = before.edges[edge as usize].vertices;
                match divided(edge as usize) {
                    None => vec![self.edge(a, b)],
                    Some((middle, _)) => vec![self.edge(a, middle), self.edge(middle, b)],
                }
            });
            Boundary { edges: parts.collect(), ..curve.clone() }
        };
        let [boundaries, interfaces] =
            [&before.boundaries, &before.interfaces].map(|all| all.iter().map(&divided_curve).collect());
        (self.mesh.boundaries, self.mesh.interfaces) = (boundaries, interfaces);
    }

    fn edge(&self, a: u32, b: u32) -> u32 {
        self.known[&[a.min(b), a.max(b)]]
    }

    /// Gives the edge between two vertices a shape that runs from the first to the second.
    fn bend(&mut self, [a, b]: [u32; 2], shape: EdgeShape) {
        let edge = self.edge(a, b);
        let edge = &mut self.mesh.edges[edge as usize];
        let [from, to] = shape.range;
        let range = if edge.vertices == [a, b] { [from, to] } else { [to, from] };
        edge.shape = Some(EdgeShape { range, ..shape });
    }
}
