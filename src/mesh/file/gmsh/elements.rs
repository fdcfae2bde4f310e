//! Elements of a mesh file: corners, midside nodes, quadrangles split in two.

use super::cursor::Cursor;
use super::groups::{Entity, Groups};
use crate::geometry::{Point, cross};
use crate::mesh::MeshError;
use crate::mesh::raw_mesh::{RawMesh, RawTriangle};

/// Diagonals whose triangles have the same smallest angle up to this share are alike: the first corner decides.
const ALIKE: f64 = 1e-9;

/// No element has more nodes.
const MOST_NODES: usize = 9;

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
    /// Tags of the nodes and their vertices, ascending from [`Elements::end_nodes`] on.
    nodes: Vec<(i64, u32)>,
    /// Whether the tags are those of the first node and the next ones, in the order of the vertices: in most files.
    are_consecutive: bool,
    /// What they have come to.
    pub mesh: RawMesh,
    /// The physical group of the last element that had but one, or none, and the number of its names.
    last: Option<(Option<Entity>, u32)>,
}

impl Elements {
    /// Adds a node. `cursor` is just behind it.
    pub fn add_node(&mut self, cursor: &Cursor, tag: i64, x: [f64; 3]) -> Result<(), MeshError> {
        if x.iter().any(|value| !value.is_finite()) {
            return Err(cursor.error(format!("node {tag} has a coordinate that is not a finite number")));
        }
        if x[2].abs() > 1e-12 * (x[0].abs() + x[1].abs() + 1.0) {
            let z = crate::geometry::Rounded(x[2]);
            return Err(cursor.error(format!("node {tag} has z = {z}; the mesh must lie in the plane z = 0")));
        }
        self.nodes.push((tag, self.mesh.vertices.len() as u32));
        self.mesh.vertices.push(Point::new(x[0], x[1]));
        Ok(())
    }

    /// Sorts the nodes; of two with one tag the later one has it.
    pub fn end_nodes(&mut self) {
        self.nodes.sort_unstable();
        self.nodes.dedup_by(|later, kept| {
            let is_same = later.0 == kept.0;
            kept.1 = if is_same { later.1 } else { kept.1 };
            is_same
        });
        let first = self.nodes.first().map_or(0, |node| node.0);
        let is_next = |(&(tag, vertex), at): (&(i64, u32), u32)| tag.checked_sub(first) == Some(at.into()) && vertex == at;
        self.are_consecutive = self.nodes.iter().zip(0..).all(is_next);
    }

    /// The vertex of a tag.
    fn vertex(&self, tag: i64) -> Option<u32> {
        if self.are_consecutive {
            let place = tag.checked_sub(self.nodes.first()?.0)?;
            return u32::try_from(place).ok().filter(|&place| (place as usize) < self.nodes.len());
        }
        self.nodes.binary_search_by_key(&tag, |node| node.0).ok().map(|place| self.nodes[place].1)
    }

    /// The number of the names of physical groups that elements have, for [`Elements::add`].
    pub fn names(&mut self, names: Vec<String>) -> u32 {
        self.mesh.number_of(names)
    }

    /// The number of the name of one physical group, or of none, for [`Elements::add`]. Elements of a group follow each other.
    pub fn names_of_group(&mut self, groups: &Groups, group: Option<Entity>) -> u32 {
        if let Some((_, number)) = self.last.filter(|(last, _)| *last == group) {
            return number;
        }
        let number = self.names(group.map(|group| groups.name(group)).into_iter().collect());
        self.last = Some((group, number));
        number
    }

    /// Adds an element of physical groups by the tags of its nodes.
    pub fn add(&mut self, cursor: &Cursor, kind: ElementKind, tags: &[i64], names: u32) -> Result<(), MeshError> {
        let mut nodes = [0; MOST_NODES];
        for (node, &tag) in nodes.iter_mut().zip(&tags[..kind.nodes]) {
            *node = self.vertex(tag).ok_or_else(|| cursor.error(format!("node {tag} is not among the $Nodes")))?;
        }
        let (corners, place) = (&nodes[..kind.corners], cursor.place());
        match *corners {
            [a, b] => {
                let names = &self.mesh.names[names as usize];
                self.mesh.lines.extend(names.iter().map(|name| (name.clone(), [a, b], place)));
            }
            [a, b, c] => self.mesh.triangles.push(RawTriangle { corners: [a, b, c], names, place }),
            [a, b, c, d] => {
                let halves = self.halves([a, b, c, d]);
                self.mesh.triangles.extend(halves.map(|corners| RawTriangle { corners, names, place }));
            }
            _ => {}
        }
        if kind.nodes > kind.corners {
            let sides = if kind.corners == 2 { 1 } else { kind.corners };
            for k in 0..sides {
                let (a, b) = (corners[k], corners[(k + 1) % kind.corners]);
                let middle = self.mesh.vertices[nodes[kind.corners + k] as usize];
                self.mesh.midsides.push(([a.min(b), a.max(b)], middle));
            }
        }
        Ok(())
    }

    /// For formats that repeat an element for each of its physical groups: the first of the triangles with the same corners gets
    /// the names of all.
    pub fn join_repeated(&mut self) {
        let sorted = |(at, triangle): (usize, &RawTriangle)| {
            let mut corners = triangle.corners;
            corners.sort_unstable();
            (corners, at)
        };
        let mut order: Vec<_> = self.mesh.triangles.iter().enumerate().map(sorted).collect();
        order.sort_unstable();
        let mut is_repeated = vec![false; order.len()];
        for alike in order.chunk_by(|a, b| a.0 == b.0).filter(|alike| alike.len() > 1) {
            let names_of = |(_, at): &([u32; 3], usize)| &self.mesh.names[self.mesh.triangles[*at].names as usize];
            let mut names = names_of(&alike[0]).clone();
            for other in &alike[1..] {
                if names_of(other).iter().all(|name| !names.contains(name)) {
                    names.extend_from_slice(names_of(other));
                    is_repeated[other.1] = true;
                }
            }
            self.mesh.triangles[alike[0].1].names = self.mesh.number_of(names);
        }
        let mut is_repeated = is_repeated.into_iter();
        self.mesh.triangles.retain(|_| is_repeated.next() != Some(true));
    }

    /// A quadrangle as two triangles: by the diagonal that makes the smallest angle of both larger.
    fn halves(&self, [a, b, c, d]: [u32; 4]) -> [[u32; 3]; 2] {
        let (first, second) = ([[a, b, c], [a, c, d]], [[a, b, d], [b, c, d]]);
        let x = |corner: u32| self.mesh.vertices[corner as usize];
        let sign = cross(x(c) - x(a), x(d) - x(b)).signum();
        let smallest = |[p, q, r]: [u32; 3]| {
            let sides = [x(q) - x(p), x(r) - x(q), x(p) - x(r)];
            // Negative where the triangle is turned over, as beside a corner that points inwards.
            let angle = |k: usize| (sign * cross(sides[k], -sides[(k + 2) % 3])).atan2(-sides[k].dot(&sides[(k + 2) % 3]));
            (0..3).map(angle).fold(f64::INFINITY, f64::min)
        };
        let quality = |halves: [[u32; 3]; 2]| smallest(halves[0]).min(smallest(halves[1]));
        if quality(second) > quality(first) + ALIKE { second } else { first }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn halves(corners: [[f64; 2]; 4]) -> [[u32; 3]; 2] {
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
