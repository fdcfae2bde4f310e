//! Meshes made of the triangles of others: edges are found again, with their shapes and their boundaries.

use crate::geometry::Point;
use crate::mesh::boundaries::Boundary;
use crate::mesh::curve_piece::CurvePiece;
use crate::mesh::macro_mesh::{BodyPiece, MacroMesh, MacroTriangle};

impl MacroMesh {
    /// The bodies of this mesh without its triangles, to be given others: [`MacroMesh::add_part`], then [`MacroMesh::divide_edges`].
    pub(super) fn without_triangles(&self, vertices: Vec<Point>) -> Self {
        Self {
            file: self.file.clone(),
            vertices,
            ratios: self.ratios.clone(),
            bodies: self.bodies.clone(),
            parts: self.parts.clone(),
            pieces: self.pieces.iter().map(|piece| BodyPiece { first: u32::MAX, ..piece.clone() }).collect(),
            points: self.points.clone(),
            has_midsides: self.has_midsides,
            plane: self.plane,
            ..Self::default()
        }
    }

    /// Adds a triangle of the same part and piece as one of the mesh before.
    pub(super) fn add_part(&mut self, vertices: [u32; 3], before: &MacroTriangle) {
        let triangle = self.triangles.len() as u32;
        let piece = &mut self.pieces[before.piece as usize];
        piece.first = piece.first.min(triangle);
        self.triangles.push(MacroTriangle { vertices, ..before.clone() });
    }

    /// Finds the edges and gives them the shapes, and the boundaries, of the edges that they are parts of; `divided` tells the
    /// vertex that divides an edge, and at which fraction of it.
    pub(super) fn divide_edges(self, before: &Self, divided: impl Fn(usize) -> Option<(u32, f64)>) -> Self {
        let mut mesh = self;
        let (edges, _) = mesh.connect();
        let find = |mesh: &MacroMesh, ends| edges.between(&mesh.triangles, ends).expect("parts of edges are edges");
        let mut bend = |ends: [u32; 2], shape: CurvePiece| {
            let edge = find(&mesh, ends);
            mesh.edges[edge as usize].bend(ends, shape.curve, shape.range);
        };
        for (edge, known) in before.edges.iter().enumerate() {
            let Some(shape) = &known.shape else { continue };
            let [a, b] = known.vertices;
            match divided(edge) {
                None => bend([a, b], (**shape).clone()),
                Some((middle, t)) => {
                    let [from, to] = shape.range;
                    let at = shape.parameter(t);
                    bend([a, middle], CurvePiece { range: [from, at], ..(**shape).clone() });
                    bend([middle, b], CurvePiece { range: [at, to], ..(**shape).clone() });
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
        [mesh.boundaries, mesh.interfaces] =
            [&before.boundaries, &before.interfaces].map(|all| all.iter().map(&divided_curve).collect());
        mesh
    }
}
