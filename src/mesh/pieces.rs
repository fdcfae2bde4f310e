//! Pieces of a body: triangles that hang together by edges.

use super::{BodyPiece, MacroMesh, MeshError};

/// A body in more pieces than this is a mesh whose triangles share no nodes.
const MOST_PIECES: usize = 100;

impl MacroMesh {
    /// Finds the pieces of all bodies and gives each triangle the number of its own.
    ///
    /// # Errors
    /// If a body falls into very many, or two pieces have a node in common: it would be a hinge, and a point transmits no
    /// force in the plane.
    pub(super) fn find_pieces(&mut self) -> Result<(), MeshError> {
        let mut piece = vec![u32::MAX; self.triangles.len()];
        for start in 0..self.triangles.len() {
            if piece[start] != u32::MAX {
                continue;
            }
            let number = self.pieces.len() as u32;
            self.pieces.push(BodyPiece { body: self.triangles[start].body as usize, first: start as u32 });
            let mut open = vec![start];
            piece[start] = number;
            while let Some(triangle) = open.pop() {
                let beside = self.triangles[triangle].edges.iter().flat_map(|&edge| self.edges[edge as usize].triangles);
                for other in beside.flatten().map(|other| other as usize) {
                    if piece[other] == u32::MAX {
                        piece[other] = number;
                        open.push(other);
                    }
                }
            }
        }
        self.triangles.iter_mut().zip(&piece).for_each(|(triangle, &piece)| triangle.piece = piece);
        self.check_hinges()?;
        self.check_count()
    }

    fn check_hinges(&self) -> Result<(), MeshError> {
        let mut owner = vec![None; self.vertices.len()];
        for triangle in &self.triangles {
            for &vertex in &triangle.vertices {
                let piece = owner[vertex as usize].get_or_insert(triangle.piece);
                if *piece != triangle.piece {
                    let x = self.vertices[vertex as usize];
                    return Err(MeshError::unusable(
                        &self.file,
                        format!(
                            "two pieces of body \"{}\" hang together by nothing but the node at ({}, {}); a single node transmits no force in the plane: join them along an edge, or make them bodies with points of their own",
                            self.bodies[triangle.body as usize], x.x, x.y
                        ),
                    ));
                }
            }
        }
        Ok(())
    }

    fn check_count(&self) -> Result<(), MeshError> {
        for (body, name) in self.bodies.iter().enumerate() {
            let count = self.pieces.iter().filter(|piece| piece.body == body).count();
            if count > MOST_PIECES {
                return Err(MeshError::unusable(
                    &self.file,
                    format!(
                        "body \"{name}\" falls into {count} pieces that share no edges; if its nodes are doubled, merge them (`Coherence Mesh;` in Gmsh)"
                    ),
                ));
            }
        }
        Ok(())
    }

    /// Piece of a boundary edge.
    pub fn piece_beside(&self, edge: u32) -> usize {
        self.triangles[self.beside(edge).0 as usize].piece as usize
    }

    /// Words for a piece: its body, and where it is if the body has others.
    pub fn name_of_piece(&self, piece: usize) -> String {
        let BodyPiece { body, first } = self.pieces[piece];
        let name = &self.bodies[body];
        if self.pieces.iter().filter(|piece| piece.body == body).count() == 1 {
            return format!("body {name}");
        }
        let corners = self.triangles[first as usize].vertices.map(|vertex| self.vertices[vertex as usize]);
        let x = (corners[0] + corners[1] + corners[2]) / 3.0;
        format!("the piece of body {name} around ({:.6}, {:.6}), which shares no edge with the rest of the body,", x.x, x.y)
    }
}
