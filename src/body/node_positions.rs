//! Where the nodes of a macro triangle lie.

use crate::element::{BadJacobian, Order, check_map};
use crate::geometry::Point;
use crate::mesh::{Level, MacroMesh, lattice};

/// Positions of lattice nodes of a macro triangle at a level.
pub fn positions<const N: usize>(mesh: &MacroMesh, triangle: usize, level: Level, nodes: &[(usize, usize); N]) -> [Point; N] {
    nodes.map(|node| mesh.node_position(triangle, level, node))
}

/// Positions of the nodes of a macro triangle that is a single triangle: its corners, then its midsides.
pub fn positions_of_one<const N: usize>(mesh: &MacroMesh, triangle: usize, level: Level) -> [Point; N] {
    if mesh.is_curved(triangle) {
        return positions(mesh, triangle, level, &lattice::Triangle::at(0, 0, level.order).nodes());
    }
    with_midsides(mesh.corners(triangle))
}

/// Nodes of a straight triangle: its corners, and for P2 the midsides of (01), (12), (20).
pub fn with_midsides<const N: usize>(corners: [Point; 3]) -> [Point; N] {
    std::array::from_fn(|a| if a < 3 { corners[a] } else { 0.5 * (corners[a - 3] + corners[(a - 2) % 3]) })
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

/// Looks at the triangles of a level in every bent macro triangle.
///
/// # Errors
/// [`BadJacobian`] of the first that is turned inside out.
pub fn check_folding(mesh: &MacroMesh, level: Level) -> Result<(), BadJacobian> {
    for triangle in (0..mesh.triangles.len()).filter(|&triangle| mesh.is_curved(triangle)) {
        let all = NodePositions::new(mesh, triangle, level);
        for small in lattice::triangles(level.intervals, level.order) {
            match level.order {
                Order::P1 => check_map(&all.of(&small.nodes::<3>()))?,
                Order::P2 => check_map(&all.of(&small.nodes::<6>()))?,
            }
        }
    }
    Ok(())
}
