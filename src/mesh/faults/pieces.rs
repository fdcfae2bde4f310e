//! Pieces of a body: triangles that hang together by edges.

use crate::geometry::{Coordinates, Disc, Point, overlapping_discs};
use crate::mesh::MeshError;
use crate::mesh::macro_mesh::{BodyPiece, MacroMesh};

/// A body in more pieces than this is a mesh whose triangles share no nodes.
const MOST_PIECES: usize = 100;

/// Edges that lie on each other to this share of their length do so by intent.
const SAME: f64 = 1e-6;

impl MacroMesh {
    /// Finds the pieces of all bodies and gives each triangle the number of its own.
    ///
    /// # Errors
    /// If a body falls into very many, or two pieces have a node in common: it would be a hinge, and a point transmits no
    /// force in the plane.
    pub(crate) fn find_pieces(&mut self) -> Result<(), MeshError> {
        // Each triangle leads to one of its piece before it, the first one to itself.
        let mut before: Vec<u32> = (0..self.triangles.len() as u32).collect();
        for edge in &self.edges {
            if let [Some(a), Some(b)] = edge.triangles.map(|beside| beside.map(|triangle| first_of(&mut before, triangle))) {
                before[a.max(b) as usize] = a.min(b);
            }
        }
        for triangle in 0..self.triangles.len() {
            let first = first_of(&mut before, triangle as u32) as usize;
            if first == triangle {
                self.triangles[triangle].piece = self.pieces.len() as u32;
                self.pieces.push(BodyPiece { body: self.triangles[triangle].body as usize, first: first as u32 });
            } else {
                self.triangles[triangle].piece = self.triangles[first].piece;
            }
        }
        self.check_hinges()?;
        self.check_count()
    }

    fn check_hinges(&self) -> Result<(), MeshError> {
        let Some((x, _, triangle)) = self.shared_vertex(|triangle| triangle.piece) else { return Ok(()) };
        Err(self.unusable(format!(
            "two pieces of body \"{}\" hang together by nothing but the node at {}; a single node transmits no force in the plane: join them along an edge, or make them bodies with points of their own",
            self.bodies[triangle.body as usize],
            Coordinates(x)
        )))
    }

    fn check_count(&self) -> Result<(), MeshError> {
        let mut counts = vec![0; self.bodies.len()];
        self.pieces.iter().for_each(|piece| counts[piece.body] += 1);
        for (name, count) in self.bodies.iter().zip(counts) {
            if count > MOST_PIECES {
                return Err(self.unusable(format!(
                    "body \"{name}\" falls into {count} pieces that share no edges; if its nodes are doubled, merge them (`Coherence Mesh;` in Gmsh)"
                )));
            }
        }
        Ok(())
    }

    /// Parts of a body that touch must share the nodes there: nothing else joins them, and a body has no contact with itself.
    ///
    /// # Errors
    /// Words with both parts and the place.
    pub(crate) fn check_parts_are_joined(&self) -> Result<(), MeshError> {
        let mut parts = vec![0; self.bodies.len()];
        self.parts.iter().for_each(|part| parts[part.body as usize] += 1);
        for (body, edges) in self.outer_edges().iter().enumerate().filter(|(body, _)| parts[*body] > 1) {
            let ends = |at: usize| self.edge_ends(edges[at]);
            let disc = |at: usize| Disc { middle: 0.5 * (ends(at)[0] + ends(at)[1]), radius: 0.5 * self.edge_length(edges[at]) };
            let discs: Vec<Disc> = (0..edges.len()).map(disc).collect();
            let beside = |at: usize| &self.triangles[self.beside(edges[at]).0 as usize];
            let mut touching = None;
            overlapping_discs(&discs, &discs, |a, b| {
                let [first, second] = [beside(a), beside(b)];
                if first.part != second.part && first.piece != second.piece && lie_on_each_other(ends(a), ends(b)) {
                    touching.get_or_insert((first.part.min(second.part), first.part.max(second.part), discs[a].middle));
                }
            });
            if let Some((first, second, x)) = touching {
                let names = [first, second].map(|part| &self.parts[part as usize].name);
                return Err(self.unusable(format!(
                    "parts \"{}\" and \"{}\" of body \"{}\" touch near {} and share no nodes there, so nothing joins them; give them the same lines (`Coherence;` in Gmsh), or make them bodies with a contact between",
                    names[0],
                    names[1],
                    self.bodies[body],
                    Coordinates(x)
                )));
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
        let corners = self.corners(first as usize);
        let x = (corners[0] + corners[1] + corners[2]) / 3.0;
        format!("the piece of body {name} around ({:.6}, {:.6}), which shares no edge with the rest of the body,", x.x, x.y)
    }
}

/// The first triangle that a triangle leads to, by ways that are halved for those who come later.
fn first_of(before: &mut [u32], mut triangle: u32) -> u32 {
    while before[triangle as usize] != triangle {
        let next = before[before[triangle as usize] as usize];
        before[triangle as usize] = next;
        triangle = next;
    }
    triangle
}

/// Whether two straight edges have a stretch in common.
fn lie_on_each_other(a: [Point; 2], b: [Point; 2]) -> bool {
    let length = (b[1] - b[0]).norm();
    let along = (b[1] - b[0]) / length;
    let least = SAME * length.max((a[1] - a[0]).norm());
    let seen = a.map(|x| along.dot(&(x - b[0])));
    let off = a.map(|x| (x - b[0] - along.dot(&(x - b[0])) * along).norm());
    off[0].max(off[1]) <= least && seen[0].max(seen[1]).min(length) - seen[0].min(seen[1]).max(0.0) > 1e3 * least
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::file::parse_gmsh;
    use crate::mesh::raw_mesh::RawMesh;
    use crate::mesh::refined::BisectedMesh;
    use crate::mesh::samples::two_parts;
    use std::path::Path;

    fn build(raw: RawMesh) -> Result<MacroMesh, String> {
        MacroMesh::build(raw, Path::new("square.msh")).map_err(|error| error.to_string())
    }

    #[test]
    fn parts_keep_their_triangles_and_their_line_when_halved_and_written() {
        let raw = two_parts();
        let joined = raw.joined.clone();
        let mut bisected = BisectedMesh::new(build(raw).expect("two parts of one body"));
        for times in 0..3 {
            let mesh = &bisected.mesh;
            assert_eq!((mesh.bodies.join(" "), mesh.pieces.len()), ("whole".to_string(), 1));
            let [core, film] = ["core", "film"].map(|name| mesh.region(name).expect("a part"));
            for triangle in &mesh.triangles {
                let middle = triangle.vertices.map(|vertex| mesh.vertices[vertex as usize]).iter().sum::<Point>() / 3.0;
                assert_eq!([core.holds(triangle), film.holds(triangle)], [middle.x > middle.y, middle.x < middle.y]);
                assert!(mesh.region("whole").expect("a body").holds(triangle));
            }
            let between: Vec<u32> = (0..mesh.edges.len() as u32).filter(|&edge| mesh.is_interface(edge)).collect();
            let mut named = mesh.interfaces[0].edges.clone();
            named.sort_unstable();
            assert!(named == between && named.len() == 1 << times, "{named:?} instead of {between:?}");
            let again = parse_gmsh(mesh.to_gmsh().as_bytes(), Path::new("again.msh"), joined.clone()).expect("our own");
            let content = |mesh: &MacroMesh| format!("{:?}", (&mesh.triangles, &mesh.parts, &mesh.boundaries, &mesh.interfaces));
            assert_eq!(content(&again), content(mesh));
            bisected = bisected.refined(0..mesh.triangles.len() as u32);
        }
    }

    #[test]
    fn bodies_stay_apart_and_parts_that_touch_are_joined() {
        let words = build(RawMesh { joined: Default::default(), ..two_parts() }).expect_err("two bodies");
        assert!(words.contains("\"core\" and \"film\" share the node") && words.contains("part.\"film\""), "{words}");
        let mut raw = two_parts();
        raw.add_line("bond", [0, 1]);
        assert!(build(raw).expect_err("a name for two kinds of lines").contains("name them apart"));
        let mut raw = two_parts();
        raw.lines.clear();
        let apart = |raw: &mut RawMesh, by: f64| {
            let moved = [0, 2, 3].map(|vertex| raw.vertices[vertex] + Point::new(-by, by));
            raw.vertices.truncate(3);
            raw.vertices.extend(moved);
            raw.triangles[1].corners = [3, 4, 5];
        };
        apart(&mut raw, 0.0);
        let words = build(raw).expect_err("nothing joins them");
        assert!(words.contains("\"core\" and \"film\" of body \"whole\" touch near (0.5, 0.5)"), "{words}");
        let mut raw = two_parts();
        raw.lines.clear();
        apart(&mut raw, 0.1);
        assert_eq!(build(raw).expect("two pieces").pieces.len(), 2);
    }
}
