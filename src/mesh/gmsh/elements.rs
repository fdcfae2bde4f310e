//! Elements of a mesh file: corners, midside nodes, quadrangles split in two.

use super::super::macro_mesh::RawMesh;
use super::super::{FilePlace, MeshError};
use super::cursor::Cursor;
use crate::geometry::{Point, cross};
use std::collections::HashMap;

/// Diagonals whose triangles have the same smallest angle up to this share are alike: the first corner decides.
const ALIKE: f64 = 1e-9;

/// What a Gmsh element type is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct ElementKind {
    /// Dimension of the element.
    pub dimension: usize,
    /// Corners; as many midside nodes may follow (one of a line), and a node in the middle.
    corners: usize,
    /// All of its nodes.
    pub nodes: usize,
}

impl ElementKind {
    /// The element of a number of Gmsh's.
    ///
    /// # Errors
    /// Words for one that is not read.
    pub fn of(number: i64) -> Result<Self, String> {
        let (dimension, corners, nodes) = match number {
            15 => (0, 1, 1),
            1 => (1, 2, 2),
            8 => (1, 2, 3),
            2 => (2, 3, 3),
            9 => (2, 3, 6),
            3 => (2, 4, 4),
            16 => (2, 4, 8),
            10 => (2, 4, 9),
            _ => return Err(refused(number)),
        };
        Ok(Self { dimension, corners, nodes })
    }
}

fn refused(number: i64) -> String {
    let (what, remedy) = match number {
        4..=7 | 11..=14 | 17..=19 | 29..=34 => ("volume elements", "mesh the plane scene with `gmsh -2`"),
        20..=28 | 36..=70 => ("elements of order 3 or higher", "mesh with `gmsh -2 -order 2`, or `-order 1`"),
        _ => ("elements of another kind", "mesh with triangles or quadrangles of order 1 or 2"),
    };
    format!("holds {what} (Gmsh element type {number}); {remedy}")
}

/// Nodes and elements that have been read so far.
#[derive(Default)]
pub(super) struct Elements {
    nodes: HashMap<i64, usize>,
    mesh: RawMesh,
    /// Where each triangle is, by its corners, if the same one may come again with another name.
    known: HashMap<[usize; 3], usize>,
}

impl Elements {
    /// Everything, for the mesh to be made of it.
    pub fn into_mesh(self) -> RawMesh {
        self.mesh
    }

    /// Adds a node. `cursor` is just behind it.
    pub fn add_node(&mut self, cursor: &Cursor, tag: i64, x: [f64; 3]) -> Result<(), MeshError> {
        if x.iter().any(|value| !value.is_finite()) {
            return Err(cursor.error(format!("node {tag} has a coordinate that is not a finite number")));
        }
        if x[2].abs() > 1e-12 * (x[0].abs() + x[1].abs() + 1.0) {
            let z = crate::geometry::Rounded(x[2]);
            return Err(cursor.error(format!("node {tag} has z = {z}; the mesh must lie in the plane z = 0")));
        }
        self.nodes.insert(tag, self.mesh.vertices.len());
        self.mesh.vertices.push(Point::new(x[0], x[1]));
        Ok(())
    }

    /// Adds an element of the physical groups `names` by the tags of its nodes.
    pub fn add(&mut self, cursor: &Cursor, kind: ElementKind, tags: &[i64], names: &[String]) -> Result<(), MeshError> {
        let find = |tag| self.nodes.get(tag).copied();
        let mut nodes = [0; 9];
        for (node, tag) in nodes.iter_mut().zip(&tags[..kind.nodes]) {
            *node = find(tag).ok_or_else(|| cursor.error(format!("node {tag} is not among the $Nodes")))?;
        }
        let (corners, place) = (&nodes[..kind.corners], cursor.place());
        match *corners {
            [a, b] => self.mesh.lines.extend(names.iter().map(|name| (name.clone(), [a, b], place))),
            [a, b, c] => self.add_triangle([a, b, c], names, place),
            [a, b, c, d] => {
                for corners in self.halves([a, b, c, d]) {
                    self.add_triangle(corners, names, place);
                }
            }
            _ => {}
        }
        if kind.nodes > kind.corners {
            let sides = if kind.corners == 2 { 1 } else { kind.corners };
            for k in 0..sides {
                let (a, b) = (corners[k], corners[(k + 1) % kind.corners]);
                self.mesh.midsides.insert([a.min(b), a.max(b)], self.mesh.vertices[nodes[kind.corners + k]]);
            }
        }
        Ok(())
    }

    fn add_triangle(&mut self, corners: [usize; 3], names: &[String], place: FilePlace) {
        self.mesh.triangles.push((corners, names.to_vec(), place));
    }

    /// The same for formats that repeat an element for each of its physical groups: the names of a triangle are those of all.
    pub fn add_repeated(&mut self, cursor: &Cursor, kind: ElementKind, tags: &[i64], names: &[String]) -> Result<(), MeshError> {
        let first = self.mesh.triangles.len();
        self.add(cursor, kind, tags, names)?;
        let added: Vec<_> = self.mesh.triangles.drain(first..).collect();
        for (corners, names, place) in added {
            let mut sorted = corners;
            sorted.sort_unstable();
            let at = *self.known.entry(sorted).or_insert(self.mesh.triangles.len());
            match self.mesh.triangles.get_mut(at) {
                Some((_, known, _)) if names.iter().all(|name| !known.contains(name)) => known.extend(names),
                _ => self.mesh.triangles.push((corners, names, place)),
            }
        }
        Ok(())
    }

    /// A quadrangle as two triangles: by the diagonal that makes the smallest angle of both larger.
    fn halves(&self, [a, b, c, d]: [usize; 4]) -> [[usize; 3]; 2] {
        let (first, second) = ([[a, b, c], [a, c, d]], [[a, b, d], [b, c, d]]);
        let x = |corner: usize| self.mesh.vertices[corner];
        let sign = cross(x(c) - x(a), x(d) - x(b)).signum();
        let smallest = |[p, q, r]: [usize; 3]| {
            let sides = [x(q) - x(p), x(r) - x(q), x(p) - x(r)];
            // Negative where the triangle is turned over, as beside a corner that points inwards.
            let angle = |k: usize| (sign * cross(sides[k], -sides[(k + 2) % 3])).atan2(-sides[k].dot(&sides[(k + 2) % 3]));
            (0..3).map(angle).fold(f64::INFINITY, f64::min)
        };
        let quality = |halves: [[usize; 3]; 2]| smallest(halves[0]).min(smallest(halves[1]));
        if quality(second) > quality(first) + ALIKE { second } else { first }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn halves(corners: [[f64; 2]; 4]) -> [[usize; 3]; 2] {
        let vertices = corners.map(Point::from).to_vec();
        let elements = Elements { mesh: RawMesh { vertices, ..Default::default() }, ..Default::default() };
        elements.halves([0, 1, 2, 3])
    }

    #[test]
    fn quadrangles_are_split_where_the_triangles_are_better() {
        let (first, second) = ([[0, 1, 2], [0, 2, 3]], [[0, 1, 3], [1, 2, 3]]);
        assert_eq!(halves([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]), first, "a square: the first corner decides");
        assert_eq!(halves([[0.0, 0.0], [1.0, 0.0], [2.0, 1.0], [1.0, 1.0]]), second, "the shorter diagonal");
        assert_eq!(halves([[0.0, 0.0], [1.0, 1.0], [1.0, 2.0], [0.0, 1.0]]), second);
        assert_eq!(halves([[0.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 1.5]]), second);
        assert_eq!(halves([[0.0, 1.5], [0.0, 1.0], [1.0, 1.0], [1.0, 2.0]]), first, "the same from another corner");
        // A corner that points inwards: one diagonal lies outside.
        assert_eq!(halves([[0.0, 0.0], [2.0, 0.0], [0.4, 0.4], [0.0, 2.0]]), first);
        assert_eq!(halves([[2.0, 0.0], [0.4, 0.4], [0.0, 2.0], [0.0, 0.0]]), second);
        // Clockwise ones, too.
        assert_eq!(halves([[0.0, 2.0], [0.4, 0.4], [2.0, 0.0], [0.0, 0.0]]), second);
    }
}
