//! Levels of functions on quadtrees below the nodes of a mesh: who owns which, and their values on the next finer level.

use super::tree::{Tree, Vertex};
use crate::geometry::Point;
use crate::mesh::middle_of_group;
use std::collections::HashMap;
use std::ops::Range;

/// A component of a coarse node is left out if the squares of its values at all finer nodes add up to no more than this.
const NOTHING: f64 = 1e-8;

/// The axes of most nodes.
pub const AXES: [Point; 2] = [Point::new(1.0, 0.0), Point::new(0.0, 1.0)];

/// A node of a level: of the mesh, or a vertex of a tree.
#[derive(Clone, Debug)]
pub struct LevelNode {
    /// Its body.
    pub body: usize,
    /// Where (units of the trees).
    pub at: [f64; 2],
    /// Directions of its two components.
    pub axes: [Point; 2],
    /// Numbers of its unknowns; none where nothing moves.
    pub unknowns: [Option<usize>; 2],
}

impl LevelNode {
    /// Its unknowns with their directions.
    pub fn components(&self) -> impl Iterator<Item = (usize, Point)> {
        [0, 1].into_iter().filter_map(|k| Some((self.unknowns[k]?, self.axes[k])))
    }
}

/// The nodes of a level, in the order of their unknowns.
#[derive(Clone, Debug)]
pub struct LevelNodes {
    /// All nodes.
    pub all: Vec<LevelNode>,
    /// First node of each rank, and the end.
    pub first: Vec<usize>,
    /// First unknown of each rank, and the end.
    pub unknowns: Vec<usize>,
}

impl LevelNodes {
    /// Unknowns of a rank.
    pub fn own(&self, rank: usize) -> Range<usize> {
        self.unknowns[rank]..self.unknowns[rank + 1]
    }

    /// Gives all nodes of each `group` ranks with consecutive numbers to the middle one.
    pub fn bring_together(&mut self, group: usize) {
        let ranks = self.first.len() - 1;
        for starts in [&mut self.first, &mut self.unknowns] {
            for rank in 1..ranks {
                let begin = rank / group * group;
                let has_had_all = rank > middle_of_group(rank, group, ranks);
                starts[rank] = starts[if has_had_all { (begin + group).min(ranks) } else { begin }];
            }
        }
    }

    /// Unknowns of all ranks.
    pub fn count(&self) -> usize {
        self.unknowns[self.unknowns.len() - 1]
    }
}

/// A level and the next coarser one.
pub struct Coarsening {
    /// The coarse nodes.
    pub coarse: LevelNodes,
    /// Coarse nodes with their values at finer ones, in compressed rows.
    entries: Vec<(u32, f64)>,
    offsets: Vec<usize>,
}

impl Coarsening {
    /// From nodes to the functions of the trees, one for each body. A function belongs to the rank of the first node that
    /// it is not zero at, and has its number in the order of these.
    pub fn new(fine: &LevelNodes, trees: &[Tree]) -> Self {
        let mut numbers: HashMap<(usize, Vertex), u32> = HashMap::new();
        let mut coarse = LevelNodes { all: Vec::new(), first: vec![0], unknowns: vec![0] };
        let (mut entries, mut offsets) = (Vec::with_capacity(4 * fine.all.len()), vec![0]);
        for ends in fine.first.windows(2) {
            for node in &fine.all[ends[0]..ends[1]] {
                for (vertex, value) in trees[node.body].function_values(node.at) {
                    let number = *numbers.entry((node.body, vertex)).or_insert_with(|| {
                        let at = vertex.map(f64::from);
                        coarse.all.push(LevelNode { body: node.body, at, axes: AXES, unknowns: [None; 2] });
                        coarse.all.len() as u32 - 1
                    });
                    entries.push((number, value));
                }
                offsets.push(entries.len());
            }
            coarse.first.push(coarse.all.len());
        }
        let mut coarsening = Self { coarse, entries, offsets };
        coarsening.number(fine);
        coarsening
    }

    /// Coarse unknowns that move a component of a finer node, each with its weight: the function's value there, times the cosine
    /// between the two directions.
    pub fn row(&self, node: usize, axis: Point) -> impl Iterator<Item = (usize, f64)> {
        self.values(node).iter().flat_map(move |&(number, value)| {
            let components = self.coarse.all[number as usize].components();
            components
                .map(move |(unknown, direction)| (unknown, value * axis.dot(&direction)))
                .filter(|(_, weight)| *weight != 0.0)
        })
    }

    fn values(&self, node: usize) -> &[(u32, f64)] {
        &self.entries[self.offsets[node]..self.offsets[node + 1]]
    }

    /// Numbers the components of the coarse nodes that move some unknown of the finer level. A function of which only a small
    /// part lies in its body is kept, too: without it the level would not contain linear motions up to the boundary.
    fn number(&mut self, fine: &LevelNodes) {
        let mut squares = vec![[0.0; 2]; self.coarse.all.len()];
        for (at, node) in fine.all.iter().enumerate() {
            for (_, axis) in node.components() {
                for &(number, value) in self.values(at) {
                    let [x, y] = &mut squares[number as usize];
                    (*x, *y) = (*x + (value * axis.x).powi(2), *y + (value * axis.y).powi(2));
                }
            }
        }
        let mut next = 0;
        let LevelNodes { all, first, unknowns } = &mut self.coarse;
        for ends in first.windows(2) {
            for (node, squares) in all[ends[0]..ends[1]].iter_mut().zip(&squares[ends[0]..ends[1]]) {
                for k in (0..2).filter(|&k| squares[k] > NOTHING) {
                    node.unknowns[k] = Some(next);
                    next += 1;
                }
            }
            unknowns.push(next);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::tree::{Roots, WantedWidth};
    use super::*;

    const ROOTS: Roots = Roots { count: [2, 1], depth: 5 };

    /// Two bodies on one grid, finer towards a corner, dealt to three ranks; some nodes of the left side are held, in turned
    /// axes or altogether.
    fn nodes() -> LevelNodes {
        let mut all = Vec::new();
        for k in 0..1200_u32 {
            let (s, t) = (f64::from(k % 40) / 39.0, f64::from(k / 40) / 29.0);
            let (sin, cos) = if s == 0.0 { 0.4f64.sin_cos() } else { (0.0, 1.0) };
            let body = usize::from(t > 0.5);
            let fixed = [s == 0.0, s == 0.0 && body == 1];
            let unknowns = [0, 1].map(|c| (!fixed[c]).then_some(2 * k as usize + c));
            all.push(LevelNode {
                body,
                at: [64.0 * s * s, 32.0 * t],
                axes: [Point::new(cos, sin), Point::new(-sin, cos)],
                unknowns,
            });
        }
        LevelNodes { all, first: vec![0, 300, 700, 1200], unknowns: vec![0, 600, 1400, 2400] }
    }

    fn trees() -> Vec<Tree> {
        let tree = |body| {
            let nodes = nodes().all.into_iter().filter(|node| node.body == body);
            let mut widths: Vec<WantedWidth> =
                nodes.map(|node| WantedWidth { at: node.at, width: (1.0 + 0.1 * node.at[0]).ln() }).collect();
            Tree::around(ROOTS, &mut widths)
        };
        vec![tree(0), tree(1)]
    }

    /// Every level, each with the step to the next coarser one.
    fn coarsenings() -> Vec<(LevelNodes, Coarsening)> {
        let (mut fine, mut trees, mut coarsenings) = (nodes(), trees(), Vec::new());
        loop {
            let coarsening = Coarsening::new(&fine, &trees);
            let coarse = coarsening.coarse.clone();
            coarsenings.push((fine, coarsening));
            let Some(coarser) = trees.iter().map(Tree::coarser).collect::<Option<Vec<_>>>() else { return coarsenings };
            (fine, trees) = (coarse, coarser);
        }
    }

    #[test]
    fn linear_motions_come_down_to_the_mesh_unchanged() {
        let motion =
            |node: &LevelNode| Point::new(0.3 + 0.02 * node.at[0] - 0.05 * node.at[1], 0.01 * node.at[0] + node.body as f64);
        let coarsenings = coarsenings();
        assert!(coarsenings.len() > 3);
        for (fine, coarsening) in coarsenings {
            let nodes = coarsening.coarse.all.iter().flat_map(|node| node.components().map(move |component| (component, node)));
            let values: HashMap<usize, f64> = nodes.map(|((unknown, axis), node)| (unknown, axis.dot(&motion(node)))).collect();
            // Functions beside what is held may be without a component.
            let whole = |(number, _): &(u32, f64)| coarsening.coarse.all[*number as usize].components().count() == 2;
            let free: Vec<usize> = (0..fine.all.len()).filter(|&at| coarsening.values(at).iter().all(whole)).collect();
            assert!(2 * free.len() > fine.all.len());
            for at in free {
                for (_, axis) in fine.all[at].components() {
                    let value: f64 = coarsening.row(at, axis).map(|(unknown, weight)| weight * values[&unknown]).sum();
                    assert!((value - axis.dot(&motion(&fine.all[at]))).abs() < 1e-8, "{:?}", fine.all[at]);
                }
            }
        }
    }

    #[test]
    fn unknowns_are_numbered_through_by_rank_and_all_move_something() {
        for (fine, coarsening) in coarsenings() {
            let numbers: Vec<usize> =
                coarsening.coarse.all.iter().flat_map(|node| node.components().map(|(unknown, _)| unknown)).collect();
            assert_eq!(numbers, (0..coarsening.coarse.count()).collect::<Vec<_>>());
            let mut first = vec![usize::MAX; numbers.len()];
            for (at, node) in fine.all.iter().enumerate() {
                for (_, axis) in node.components() {
                    coarsening.row(at, axis).for_each(|(unknown, _)| first[unknown] = first[unknown].min(at));
                }
            }
            let rank = |ends: &[usize], at: usize| ends.partition_point(|&end| end <= at);
            for (unknown, &at) in first.iter().enumerate() {
                assert!(at < usize::MAX && rank(&fine.first, at) >= rank(&coarsening.coarse.unknowns, unknown), "{unknown}");
            }
        }
    }

    #[test]
    fn one_of_each_group_of_ranks_has_what_all_of_them_had() {
        let start = LevelNodes { all: Vec::new(), first: vec![0, 3, 4, 9, 11, 12], unknowns: vec![0, 5, 8, 17, 20, 24] };
        for (group, first, unknowns) in [
            (1, [0, 3, 4, 9, 11, 12], [0, 5, 8, 17, 20, 24]),
            (2, [0, 4, 4, 11, 11, 12], [0, 8, 8, 20, 20, 24]),
            (4, [0, 0, 11, 11, 11, 12], [0, 0, 20, 20, 20, 24]),
            (8, [0, 0, 0, 0, 12, 12], [0, 0, 0, 0, 24, 24]),
        ] {
            let mut nodes = start.clone();
            nodes.bring_together(group);
            assert_eq!((nodes.first, nodes.unknowns), (first.to_vec(), unknowns.to_vec()), "{group} ranks");
        }
    }

    #[test]
    fn bodies_share_no_function() {
        for (fine, coarsening) in coarsenings() {
            for (at, node) in fine.all.iter().enumerate() {
                assert!(
                    coarsening.values(at).iter().all(|(number, _)| coarsening.coarse.all[*number as usize].body == node.body)
                );
            }
        }
    }
}
