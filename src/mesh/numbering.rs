//! (level, node) -> number, in closed form.

use super::lattice::{self, Place};
use super::partition::Home;
use super::{MacroMesh, Partition};
use crate::element::Order;
use std::ops::Range;
use std::rc::Rc;

/// One level of refinement: a lattice and the elements on it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Level {
    /// Lattice intervals per macro edge; for P2 two per triangle.
    pub intervals: usize,
    /// Elements.
    pub order: Order,
}

impl Level {
    /// Triangles along a macro edge.
    pub fn triangles_per_edge(&self) -> usize {
        self.intervals / self.order.degree()
    }
}

/// The levels of a mesh refined `refine` times, coarsest first. Below P2 comes P1 on the same triangles, whose nodes
/// are the corners; the macro mesh itself is the coarsest.
pub fn levels(order: Order, refine: usize) -> Vec<Level> {
    let mut levels: Vec<Level> = (0..=refine).map(|r| Level { intervals: 1 << r, order: Order::P1 }).collect();
    if order == Order::P2 {
        levels.push(Level { intervals: 2 << refine, order });
    }
    levels
}

/// Numbers of the nodes of one level. Each rank has one contiguous range; in it, macro entities follow in the order
/// of the [`Partition`], and inside a macro triangle the lattice rows are contiguous.
#[derive(Clone, Debug)]
pub struct Numbering {
    /// The level that is numbered.
    pub level: Level,
    first: Vec<usize>,
    partition: Rc<Partition>,
}

impl Numbering {
    /// Numbers a level.
    pub fn new(level: Level, partition: &Rc<Partition>) -> Self {
        let mut first = vec![0];
        for &[vertices, edges, triangles] in &partition.counts {
            let count = vertices as usize
                + edges as usize * (level.intervals - 1)
                + triangles as usize * lattice::inner_count(level.intervals);
            first.push(first[first.len() - 1] + count);
        }
        Self { level, first, partition: partition.clone() }
    }

    /// Number of nodes over all ranks.
    pub fn node_count(&self) -> usize {
        self.first[self.first.len() - 1]
    }

    /// Numbers of the nodes that a rank owns.
    pub fn range(&self, rank: usize) -> Range<usize> {
        self.first[rank]..self.first[rank + 1]
    }

    fn start(&self, home: Home) -> usize {
        let n = self.level.intervals;
        self.first[home.rank as usize]
            + home.vertices_before as usize
            + home.edges_before as usize * (n - 1)
            + home.triangles_before as usize * lattice::inner_count(n)
    }

    /// Number of a macro vertex.
    pub fn vertex(&self, vertex: u32) -> usize {
        self.start(self.partition.vertices[vertex as usize])
    }

    /// Number of the node `position` intervals from the first vertex of a macro edge; both ends included.
    pub fn edge_node(&self, mesh: &MacroMesh, edge: u32, position: usize) -> usize {
        match position {
            0 => self.vertex(mesh.edges[edge as usize].vertices[0]),
            p if p == self.level.intervals => self.vertex(mesh.edges[edge as usize].vertices[1]),
            p => self.start(self.partition.edges[edge as usize]) + p - 1,
        }
    }

    /// Numbers of one macro triangle's nodes.
    pub fn triangle(&self, mesh: &MacroMesh, triangle: usize) -> TriangleNumbers {
        let macro_triangle = &mesh.triangles[triangle];
        TriangleNumbers {
            n: self.level.intervals,
            corners: macro_triangle.vertices.map(|vertex| self.vertex(vertex)),
            sides: macro_triangle.edges.map(|edge| self.start(self.partition.edges[edge as usize])),
            forward: macro_triangle.forward,
            inside: self.start(self.partition.triangles[triangle]),
        }
    }
}

/// Numbers of the nodes of one macro triangle.
#[derive(Clone, Copy, Debug)]
pub struct TriangleNumbers {
    n: usize,
    corners: [usize; 3],
    sides: [usize; 3],
    forward: [bool; 3],
    inside: usize,
}

impl TriangleNumbers {
    /// Number of lattice node `(i, j)`.
    #[inline]
    pub fn node(&self, i: usize, j: usize) -> usize {
        match lattice::place(self.n, i, j) {
            Place::Inside(index) => self.inside + index,
            Place::Corner(corner) => self.corners[corner],
            Place::Side { side, position } if self.forward[side] => self.sides[side] + position - 1,
            Place::Side { side, position } => self.sides[side] + self.n - position - 1,
        }
    }
}
