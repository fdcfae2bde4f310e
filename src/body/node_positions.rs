//! Where the nodes of a macro triangle lie.

use crate::geometry::Point;
use crate::mesh::{Level, MacroMesh, lattice};

/// Positions of lattice nodes of a macro triangle at a level.
pub fn positions<const N: usize>(mesh: &MacroMesh, triangle: usize, level: Level, nodes: &[(usize, usize); N]) -> [Point; N] {
    nodes.map(|node| mesh.node_position(triangle, level, node))
}

/// Positions of all its nodes: each is worked out once, though six triangles meet there.
pub struct NodePositions {
    n: usize,
    all: Vec<Point>,
}

impl NodePositions {
    /// Of a macro triangle at a level.
    pub fn new(mesh: &MacroMesh, triangle: usize, level: Level) -> Self {
        let n = level.intervals;
        Self { n, all: lattice::nodes(n).map(|node| mesh.node_position(triangle, level, node)).collect() }
    }

    /// Of some nodes.
    #[inline]
    pub fn of<const N: usize>(&self, nodes: &[(usize, usize); N]) -> [Point; N] {
        nodes.map(|(i, j)| self.all[lattice::index(self.n, i, j)])
    }
}
