//! Triangles that a bent boundary turns inside out.

use super::node_positions::NodePositions;
use crate::element::{BadJacobian, Order, check_map};
use crate::mesh::{Level, MacroMesh, lattice};

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
