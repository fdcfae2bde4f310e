//! Edges of triangles, found by sorting their sides.

use super::lists::Lists;
use super::macro_mesh::{MacroEdge, MacroMesh, MacroTriangle};

/// The sides of all triangles by the lower of their ends, ascending: the higher end, and the side, three times its triangle and which of
/// its sides.
pub(super) struct Edges(Lists<(u32, u32)>);

impl MacroMesh {
    /// Finds the edges of all triangles and numbers them in the order in which the triangles name them. Tells the first triangle
    /// that lies on the same side of an edge as one before it, if any does.
    pub(super) fn connect(&mut self) -> (Edges, Option<usize>) {
        let edges = Edges::new(self.vertices.len(), &self.triangles);
        // The first side of each edge, in the place of its number.
        let firsts = edges.0.iter().flat_map(|sides| {
            let alike = sides.chunk_by(|a, b| a.0 == b.0);
            alike.flat_map(|alike| alike.iter().map(|&(_, side)| (side, alike[0].1)))
        });
        firsts.for_each(|(side, first)| self.triangles[side as usize / 3].edges[side as usize % 3] = first);
        self.edges = Vec::with_capacity(edges.0.entries().len() / 2 + self.vertices.len());
        let mut overlapping = None;
        for side in 0..edges.0.entries().len() {
            let (triangle, k) = (side / 3, side % 3);
            let MacroTriangle { vertices, edges, .. } = self.triangles[triangle];
            let ends = [vertices[k], vertices[(k + 1) % 3]];
            let first = edges[k] as usize;
            let mut edge = self.edges.len() as u32;
            if first == side {
                self.edges.push(MacroEdge { vertices: ends, triangles: [Some(triangle as u32), None], shape: None });
            } else {
                edge = self.triangles[first / 3].edges[first % 3];
                let there = &mut self.edges[edge as usize];
                if there.triangles[1].is_some() || there.vertices[0] == ends[0] {
                    overlapping.get_or_insert(triangle);
                }
                there.triangles[1] = Some(triangle as u32);
            }
            self.triangles[triangle].edges[k] = edge;
            self.triangles[triangle].forward[k] = first == side;
        }
        (edges, overlapping)
    }
}

impl Edges {
    fn new(vertices: usize, triangles: &[MacroTriangle]) -> Self {
        let ends = triangles.iter().flat_map(|t| (0..3).map(|k| [t.vertices[k], t.vertices[(k + 1) % 3]]));
        let by_lower = ends.zip(0..).map(|([a, b], side)| (a.min(b) as usize, (a.max(b), side)));
        let mut sides = Lists::new(vertices, by_lower);
        sides.sort();
        Self(sides)
    }

    /// The edge between two vertices of the triangles that have been connected.
    pub fn between(&self, triangles: &[MacroTriangle], [a, b]: [u32; 2]) -> Option<u32> {
        let (low, high) = (a.min(b) as usize, a.max(b));
        let sides = (low < self.0.count()).then(|| self.0.of(low))?;
        let (_, side) = *sides.get(sides.partition_point(|side| side.0 < high)).filter(|side| side.0 == high)?;
        Some(triangles[side as usize / 3].edges[side as usize % 3])
    }
}

#[cfg(test)]
mod tests {
    use super::super::samples::fan;
    use super::*;

    #[test]
    fn edges_are_found_between_their_ends_and_nowhere_else() {
        let mesh = fan(9);
        let edges = Edges::new(mesh.vertices.len(), &mesh.triangles);
        assert_eq!(mesh.edges.len(), 18);
        for a in 0..=10 {
            for b in (0..=10).filter(|&b| b != a) {
                let known = mesh.edges.iter().position(|edge| edge.vertices == [a, b] || edge.vertices == [b, a]);
                assert_eq!(edges.between(&mesh.triangles, [a, b]), known.map(|edge| edge as u32), "{a} to {b}");
            }
        }
    }
}
