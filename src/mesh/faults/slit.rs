//! Slits: edges of one body that lie on each other without being one.

use crate::geometry::{Disc, Point, overlapping_discs};
use crate::mesh::macro_mesh::MacroMesh;

/// Ends that are nearer to each other than this share of their edge lie at one place.
const SAME: f64 = 1e-6;

/// Pairs of edges of one body that lie on each other: a slit in it, or nodes that were not merged.
#[derive(Clone, Debug, PartialEq)]
pub struct Slit {
    /// Index of the body.
    pub body: usize,
    /// Pairs of edges.
    pub pairs: usize,
    /// The middle of the first of them.
    pub place: Point,
}

impl MacroMesh {
    /// What of each body is cut open though it is drawn closed; bodies without that are left out.
    pub fn slits(&self) -> Vec<Slit> {
        self.outer_edges().iter().enumerate().filter_map(|(body, edges)| self.slit_of(body, edges)).collect()
    }

    /// Edges on the outline of each body.
    pub(crate) fn outer_edges(&self) -> Vec<Vec<u32>> {
        let mut outer = vec![Vec::new(); self.bodies.len()];
        for edge in (0..self.edges.len() as u32).filter(|&edge| self.is_outer(edge)) {
            outer[self.body_beside(edge)].push(edge);
        }
        outer
    }

    fn slit_of(&self, body: usize, edges: &[u32]) -> Option<Slit> {
        let ends: Vec<[Point; 2]> = edges.iter().map(|&edge| self.edge_ends(edge)).collect();
        let disc = |[a, b]: &[Point; 2]| Disc { middle: 0.5 * (a + b), radius: 0.5 * SAME * (b - a).norm() };
        let discs: Vec<Disc> = ends.iter().map(disc).collect();
        let same = |[a, b]: [Point; 2], [c, d]: [Point; 2]| {
            let near = SAME * (b - a).norm();
            let apart = |one: Point, other: Point| (one - other).norm();
            apart(a, c).max(apart(b, d)).min(apart(a, d).max(apart(b, c))) <= near
        };
        let (mut pairs, mut first) = (0, None::<usize>);
        overlapping_discs(&discs, &discs, |one, other| {
            if one < other && same(ends[one], ends[other]) {
                pairs += 1;
                first = Some(first.map_or(one, |first| first.min(one)));
            }
        });
        first.map(|first| Slit { body, pairs, place: discs[first].middle })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::samples::{slit_block, two_blocks};

    #[test]
    fn edges_of_one_body_that_lie_on_each_other_are_a_slit_and_those_of_two_are_none() {
        assert_eq!(two_blocks().slits(), [], "the seam lies between two bodies");
        assert_eq!(slit_block().slits(), [Slit { body: 0, pairs: 2, place: Point::new(0.5, 1.0) }]);
    }
}
