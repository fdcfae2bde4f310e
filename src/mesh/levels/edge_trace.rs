//! The small edges of a boundary at one level.

use crate::element::Order;
use crate::geometry::{Point, turn_right};
use crate::mesh::lattice;
use crate::mesh::levels::numbering::{Level, Numbering};
use crate::mesh::macro_mesh::MacroMesh;

/// A node on a macro edge: `position` intervals from the edge's first vertex.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct EdgeNode {
    /// Macro edge.
    pub edge: u32,
    /// Intervals from its first vertex, from 0 to the level's intervals.
    pub position: u32,
}

impl EdgeNode {
    /// All nodes of a macro edge at a level, from its first vertex to its second.
    pub fn along(edge: u32, level: Level) -> impl Iterator<Item = Self> {
        (0..=level.intervals as u32).map(move |position| Self { edge, position })
    }

    /// The two nodes of the next coarser level that it lies between, and the weights that make it of them; the same one
    /// twice where that level has it.
    pub fn parents(self, mesh: &MacroMesh, level: Level) -> [(Self, f64); 2] {
        let half = self.position / 2;
        let [a, b] = mesh.edges[self.edge as usize].vertices.map(|vertex| mesh.ratios.get(&vertex).copied());
        let ratio = |position: u32| match position {
            0 => a,
            p if 2 * p as usize == level.intervals => b,
            _ => None,
        };
        let positions = [half, half + self.position % 2];
        let weights = level.parent_weights(positions.map(ratio));
        std::array::from_fn(|k| (Self { position: positions[k], ..self }, weights[k]))
    }

    /// Number of the node.
    pub fn number(self, mesh: &MacroMesh, numbering: &Numbering) -> usize {
        numbering.edge_node(mesh, self.edge, self.position as usize)
    }

    /// The vertex that it lies at; nothing between both.
    pub fn vertex(self, mesh: &MacroMesh, level: Level) -> Option<u32> {
        let vertices = mesh.edges[self.edge as usize].vertices;
        match self.position as usize {
            0 => Some(vertices[0]),
            last if last == level.intervals => Some(vertices[1]),
            _ => None,
        }
    }

    /// Undeformed position of the node (length).
    pub fn place(self, mesh: &MacroMesh, numbering: &Numbering) -> Point {
        mesh.edge_position(self.edge, self.fraction(mesh, numbering))
    }

    /// The fraction of its macro edge, from the first vertex, at which it lies.
    pub fn fraction(self, mesh: &MacroMesh, numbering: &Numbering) -> f64 {
        mesh.edge_fraction(self.edge, numbering.level, self.position)
    }
}

/// One element edge on the boundary of a body, directed so that the body lies on its left.
#[derive(Clone, Debug)]
pub struct BoundaryEdge {
    /// Nodes of the edge: both ends, and for P2 the node between them.
    pub nodes: Vec<EdgeNode>,
    /// Positions of the nodes in the configuration that contact is modelled in.
    pub points: Vec<Point>,
    /// Undeformed positions of the nodes.
    pub places: Vec<Point>,
    /// Whether it is straight.
    pub straight: bool,
    /// Macro triangle beside it.
    pub triangle: usize,
    /// Triangle of that macro triangle's lattice beside it.
    pub beside: lattice::Triangle,
    /// Which edge of both triangles it is.
    side: usize,
}

impl BoundaryEdge {
    /// The element edges of a macro edge at a level, in the direction that keeps the body on the left.
    pub fn all_of(mesh: &MacroMesh, edge: u32, numbering: &Numbering) -> Vec<Self> {
        let (triangle, side) = mesh.beside(edge);
        let forward = mesh.triangles[triangle as usize].forward[side];
        let n = numbering.level.intervals;
        let step = numbering.level.order.degree();
        let straight = mesh.edges[edge as usize].shape.is_none();
        let node = |p: usize| EdgeNode { edge, position: if forward { p } else { n - p } as u32 };
        let one = |k: usize| {
            let nodes: Vec<EdgeNode> = match numbering.level.order {
                Order::P1 => vec![node(k), node(k + 1)],
                Order::P2 => vec![node(k * step), node(k * step + 2), node(k * step + 1)],
            };
            let places: Vec<Point> = nodes.iter().map(|node| node.place(mesh, numbering)).collect();
            let last = n - step;
            let (i, j) = match side {
                0 => (k * step, 0),
                1 => (last - k * step, k * step),
                _ => (0, last - k * step),
            };
            let beside = lattice::Triangle::at(i, j, numbering.level.order);
            Self { nodes, points: places.clone(), places, straight, triangle: triangle as usize, beside, side }
        };
        (0..n / step).map(one).collect()
    }

    /// The edge as it lies after a displacement of its nodes. With a node in the middle it is bent then.
    pub fn moved(mut self, displacement: impl Fn(EdgeNode) -> Point) -> Self {
        for (point, (&node, place)) in self.points.iter_mut().zip(self.nodes.iter().zip(&self.places)) {
            *point = place + displacement(node);
        }
        self.straight &= self.nodes.len() == 2;
        self
    }

    /// Normal of the chord out of the body (not of length one).
    pub fn outward(&self) -> Point {
        turn_right(self.points[1] - self.points[0])
    }

    /// Barycentric coordinates in the triangle beside it, at the fraction `t` of the edge.
    pub fn barycentric(&self, t: f64) -> [f64; 3] {
        let mut l = [0.0; 3];
        l[self.side] = 1.0 - t;
        l[(self.side + 1) % 3] = t;
        l
    }

    /// Length of the chord.
    pub fn length(&self) -> f64 {
        (self.points[1] - self.points[0]).norm()
    }
}
