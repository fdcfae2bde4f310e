//! Meshes made of the triangles of others: edges are found again, with their shapes and their boundaries.

use crate::geometry::Point;
use crate::mesh::edge_shape::EdgeShape;
use crate::mesh::macro_mesh::{BodyPiece, Boundary, MacroMesh, MacroTriangle};

/// A mesh that is being connected.
pub(crate) struct Connected {
    /// The mesh so far, without edges.
    pub mesh: MacroMesh,
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
            plane: before.plane,
        };
        Self { mesh }
    }

    /// Adds a triangle of the same part and piece as one of the mesh before.
    pub fn add(&mut self, vertices: [u32; 3], before: &MacroTriangle) {
        let triangle = self.mesh.triangles.len() as u32;
        let piece = &mut self.mesh.pieces[before.piece as usize];
        piece.first = piece.first.min(triangle);
        self.mesh.triangles.push(MacroTriangle { vertices, ..before.clone() });
    }

    /// Finds the edges and gives them the shapes, and the boundaries, of the edges that they are parts of; `divided` tells the
    /// vertex that divides an edge, and at which fraction of it.
    pub fn divide_edges(self, before: &MacroMesh, divided: impl Fn(usize) -> Option<(u32, f64)>) -> MacroMesh {
        let mut mesh = self.mesh;
        let (edges, _) = mesh.connect();
        let find = |mesh: &MacroMesh, ends| edges.between(&mesh.triangles, ends).expect("parts of edges are edges");
        let mut bend = |ends: [u32; 2], shape: EdgeShape| {
            let edge = find(&mesh, ends);
            mesh.edges[edge as usize].bend(ends, shape.curve, shape.range);
        };
        for (edge, known) in before.edges.iter().enumerate() {
            let Some(shape) = &known.shape else { continue };
            let [a, b] = known.vertices;
            match divided(edge) {
                None => bend([a, b], shape.clone()),
                Some((middle, t)) => {
                    let [from, to] = shape.range;
                    let at = shape.parameter(t);
                    bend([a, middle], EdgeShape { range: [from, at], ..shape.clone() });
                    bend([middle, b], EdgeShape { range: [at, to], ..shape.clone() });
                }
            }
        }
        let divided_curve = |curve: &Boundary| {
            let parts = curve.edges.iter().flat_map(|&edge| {
                let [a, b] = before.edges[edge as usize].vertices;
                match divided(edge as usize) {
                    None => vec![find(&mesh, [a, b])],
                    Some((middle, _)) => vec![find(&mesh, [a, middle]), find(&mesh, [middle, b])],
                }
            });
            Boundary { edges: parts.collect(), ..curve.clone() }
        };
        let [boundaries, interfaces] =
            [&before.boundaries, &before.interfaces].map(|all| all.iter().map(&divided_curve).collect());
        (mesh.boundaries, mesh.interfaces) = (boundaries, interfaces);
        mesh
    }
}
