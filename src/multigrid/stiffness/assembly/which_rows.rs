//! Which rows are stored.

use super::{Assembly, AssemblyPart};
use crate::element::{BadJacobian, Order};
use crate::mesh::lattice;
use crate::multigrid::stiffness::straight_triangles::{CornerBlocks, StraightTriangles};
use crate::multigrid::stiffness::sweep_rows::holds_evenly;
use std::ops::Range;

impl Assembly<'_> {
    /// Nodes of this rank that do not lie inside of whole macro triangles, ascending.
    pub(super) fn stored_nodes(&self) -> Vec<u32> {
        let whole = self.parts.iter().filter(|part| part.is_whole);
        let mut whole: Vec<_> = whole.map(|part| self.inner_nodes(part)).collect();
        whole.sort_unstable_by_key(|nodes| nodes.start);
        let count = self.space.own.len();
        let mut nodes = Vec::with_capacity(count - whole.iter().map(|nodes| nodes.len()).sum::<usize>());
        let starts = std::iter::once(0).chain(whole.iter().map(|nodes| nodes.end));
        for (start, end) in starts.zip(whole.iter().map(|nodes| nodes.start).chain([count])) {
            nodes.extend(start as u32..end as u32);
        }
        nodes
    }

    /// Whether the row of each node is stored where macro triangles are single triangles of P2: that is not needed where all triangles
    /// around it are straight, with free nodes of this rank alone, and where it lies on no boundary: contact may be there. Springs may be
    /// so stiff that sweeps want all rows in double precision.
    pub(super) fn stored_rows(&self) -> Vec<bool> {
        let (mesh, level, own) = (&self.scene.mesh, self.space.numbering.level, &self.space.own);
        let is_possible = level.order == Order::P2 && level.is_one_triangle() && self.scene.springs.is_empty();
        let mut is_stored = vec![!is_possible; self.nodes.len()];
        let is_even: Vec<bool> = self.scene.laws().iter().map(holds_evenly).collect();
        for part in self.parts.iter().filter(|_| is_possible) {
            let (nodes, triangle) = (part.numbers.of_one::<6>(), &mesh.triangles[part.triangle]);
            let is_free = |node: &usize| own.contains(node) && self.space.constraints.get(*node).is_none();
            let is_plain = part.is_straight && is_even[triangle.part as usize] && nodes.iter().all(is_free);
            let is_outer = triangle.edges.map(|edge| mesh.is_outer(edge));
            let is_outer = |a: usize| is_outer[a % 3] || a < 3 && is_outer[(a + 2) % 3];
            let stored = nodes.iter().enumerate().filter(|(a, node)| own.contains(node) && (!is_plain || is_outer(*a)));
            stored.for_each(|(_, node)| is_stored[node - own.start] = true);
        }
        is_stored
    }

    /// A macro triangle that is one straight triangle of P2, among those that have nodes without stored rows if it has some.
    pub(super) fn straight(&self, part: &AssemblyPart, all: &mut StraightTriangles) -> Result<CornerBlocks, BadJacobian> {
        let (own, triangle) = (&self.space.own, part.triangle);
        let nodes = part.numbers.of_one::<6>();
        let is_needed = nodes.iter().any(|node| own.contains(node) && !self.is_stored[node - own.start]);
        let nodes = is_needed.then(|| nodes.map(|node| (node - own.start) as u32));
        all.couplings(&self.scene.mesh.corners(triangle), self.scene.mesh.triangles[triangle].part, nodes)
    }

    /// The inner nodes of a macro triangle of this rank's, counted from the first node of the rank.
    pub(super) fn inner_nodes(&self, part: &AssemblyPart) -> Range<usize> {
        let n = self.space.numbering.level.intervals;
        let start = if n < 3 { 0 } else { part.numbers.node(1, 1) - self.space.own.start };
        start..start + lattice::inner_count(n)
    }
}
