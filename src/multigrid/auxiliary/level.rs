//! Levels of functions on quadtrees below the nodes of a mesh: who owns which, and their values on the next finer level.

use super::tree::{Tree, Vertex};
use crate::element::Block;
use crate::element::block::IDENTITY;
use crate::geometry::{AXES, Point};
use crate::mesh::middle_of_group;
use rustc_hash::FxHashMap;
use std::collections::BTreeMap;
use std::ops::Range;

/// A component of a coarse node is left out if the squares of its values at all finer nodes add up to no more than this.
const NOTHING: f64 = 1e-8;

/// A node of a level: of the mesh, or a vertex of a tree.
#[derive(Clone, Debug)]
pub struct LevelNode {
    /// Its body.
    pub body: usize,
    /// Where (units of the trees).
    pub at: [f64; 2],
    /// Directions of its two components.
    pub axes: [Point; 2],
    /// Which of them move.
    pub is_free: [bool; 2],
}

impl LevelNode {
    /// What it takes over of a motion: rows are its components.
    fn frame(&self) -> Block {
        [0, 1].map(|k| if self.is_free[k] { [self.axes[k].x, self.axes[k].y] } else { [0.0; 2] })
    }

    fn is_plain(&self) -> bool {
        self.is_free == [true; 2] && self.axes == AXES
    }
}

/// The nodes of a level, rank after rank.
#[derive(Clone, Debug)]
pub struct LevelNodes {
    /// All nodes.
    pub all: Vec<LevelNode>,
    /// First node of each rank, and the end.
    pub first: Vec<usize>,
}

impl LevelNodes {
    /// Nodes of a rank.
    pub fn own(&self, rank: usize) -> Range<usize> {
        self.first[rank]..self.first[rank + 1]
    }

    /// The rank of a node.
    pub fn owner(&self, node: usize) -> usize {
        self.first.partition_point(|&first| first <= node) - 1
    }

    /// Gives all nodes of each `group` ranks with consecutive numbers to the middle one.
    pub fn bring_together(&mut self, group: usize) {
        let ranks = self.first.len() - 1;
        for rank in 1..ranks {
            let begin = rank / group * group;
            let has_had_all = rank > middle_of_group(rank, group, ranks);
            self.first[rank] = self.first[if has_had_all { (begin + group).min(ranks) } else { begin }];
        }
    }
}

/// A level and the next coarser one.
pub struct Coarsening {
    /// The coarse nodes.
    pub coarse: LevelNodes,
    /// Coarse nodes with their values at finer ones, in compressed rows.
    columns: Vec<u32>,
    values: Vec<f64>,
    offsets: Vec<u32>,
    /// Finer nodes whose components are turned, or do not move: what they take over of a motion.
    frames: BTreeMap<u32, Block>,
}

impl Coarsening {
    /// From nodes to the functions of the trees, one for each body. A function belongs to the rank of the first node that
    /// it is not zero at, and has its number in the order of these. Nodes that do not move at all take nothing over.
    pub fn new(fine: &LevelNodes, trees: &[Tree]) -> Self {
        let mut numbers: FxHashMap<(usize, Vertex), u32> = FxHashMap::default();
        let mut coarse = LevelNodes { all: Vec::new(), first: vec![0] };
        let (mut columns, mut all_values, mut offsets) = (Vec::new(), Vec::with_capacity(4 * fine.all.len()), vec![0]);
        let mut values = Vec::new();
        for ends in fine.first.windows(2) {
            for node in &fine.all[ends[0]..ends[1]] {
                if node.is_free != [false; 2] {
                    trees[node.body].function_values(node.at, &mut values);
                }
                for (vertex, value) in values.drain(..) {
                    let number = *numbers.entry((node.body, vertex)).or_insert_with(|| {
                        let at = vertex.map(f64::from);
                        coarse.all.push(LevelNode { body: node.body, at, axes: AXES, is_free: [true; 2] });
                        coarse.all.len() as u32 - 1
                    });
                    columns.push(number);
                    all_values.push(value);
                }
                offsets.push(columns.len() as u32);
            }
            coarse.first.push(coarse.all.len());
        }
        let turned = fine.all.iter().enumerate().filter(|(_, node)| !node.is_plain());
        let frames = turned.map(|(at, node)| (at as u32, node.frame())).collect();
        let mut coarsening = Self { coarse, columns, values: all_values, offsets, frames };
        coarsening.leave_out(fine);
        coarsening
    }

    /// Functions that are not zero at a finer node, with their values there.
    pub fn row(&self, node: usize) -> impl Iterator<Item = (u32, f64)> + Clone {
        let places = self.offsets[node] as usize..self.offsets[node + 1] as usize;
        self.columns[places.clone()].iter().copied().zip(self.values[places].iter().copied())
    }

    /// What a finer node takes over of a motion, if that is not all of it in the axes of the plane.
    pub fn frame(&self, node: usize) -> Option<&Block> {
        self.frames.get(&(node as u32))
    }

    /// What finer node `node` takes over of coarse node `parent`, whose function is 1 there, if that is not all of it.
    pub fn turned(&self, node: usize, parent: u32) -> Option<Block> {
        let (frame, free) = (self.frame(node), self.coarse.all[parent as usize].is_free);
        if frame.is_none() && free == [true; 2] {
            return None;
        }
        let frame = frame.copied().unwrap_or(IDENTITY);
        Some(frame.map(|row| [0, 1].map(|k| if free[k] { row[k] } else { 0.0 })))
    }

    /// Leaves components of the coarse nodes out that move no unknown of the finer level. A function of which only a small
    /// part lies in its body is kept: without it the level would not contain linear motions up to the boundary.
    fn leave_out(&mut self, fine: &LevelNodes) {
        let mut squares = vec![[0.0; 2]; self.coarse.all.len()];
        for at in 0..fine.all.len() {
            let frame = self.frame(at).copied().unwrap_or(IDENTITY);
            for (number, value) in self.row(at) {
                for axis in frame {
                    (0..2).for_each(|k| squares[number as usize][k] += (value * axis[k]).powi(2));
                }
            }
        }
        for (node, squares) in self.coarse.all.iter_mut().zip(squares) {
            node.is_free = squares.map(|sum| sum > NOTHING);
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
            let axes = [Point::new(cos, sin), Point::new(-sin, cos)];
            all.push(LevelNode { body, at: [64.0 * s * s, 32.0 * t], axes, is_free: fixed.map(|is_fixed| !is_fixed) });
        }
        LevelNodes { all, first: vec![0, 300, 700, 1200] }
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
            // Functions beside what is held may be without a component.
            let is_whole = |number: u32| coarsening.coarse.all[number as usize].is_free == [true; 2];
            let free: Vec<usize> =
                (0..fine.all.len()).filter(|&at| coarsening.row(at).all(|(number, _)| is_whole(number))).collect();
            assert!(2 * free.len() > fine.all.len());
            for (at, node) in free.into_iter().map(|at| (at, &fine.all[at])) {
                let mut taken = [0.0; 2];
                for (number, value) in coarsening.row(at) {
                    let (motion, frame) = (motion(&coarsening.coarse.all[number as usize]), coarsening.turned(at, number));
                    let own = frame.map_or([motion.x, motion.y], |rows| rows.map(|[x, y]| x * motion.x + y * motion.y));
                    (0..2).for_each(|k| taken[k] += value * own[k]);
                }
                for k in 0..2 {
                    let own = if node.is_free[k] { node.axes[k].dot(&motion(node)) } else { 0.0 };
                    assert!((taken[k] - own).abs() < 1e-8, "{node:?}: {taken:?}");
                }
            }
        }
    }

    #[test]
    fn every_function_moves_something_and_lies_on_the_rank_of_the_first_node_there() {
        for (fine, coarsening) in coarsenings() {
            let mut first = vec![usize::MAX; coarsening.coarse.all.len()];
            for at in (0..fine.all.len()).rev() {
                coarsening.row(at).for_each(|(number, _)| first[number as usize] = at);
            }
            for (number, &at) in first.iter().enumerate() {
                assert!(at < usize::MAX && fine.owner(at) == coarsening.coarse.owner(number), "{number}");
            }
        }
    }

    #[test]
    fn one_of_each_group_of_ranks_has_what_all_of_them_had() {
        let start = LevelNodes { all: Vec::new(), first: vec![0, 3, 4, 9, 11, 12] };
        for (group, first) in
            [(1, [0, 3, 4, 9, 11, 12]), (2, [0, 4, 4, 11, 11, 12]), (4, [0, 0, 11, 11, 11, 12]), (8, [0, 0, 0, 0, 12, 12])]
        {
            let mut nodes = start.clone();
            nodes.bring_together(group);
            assert_eq!(nodes.first, first, "{group} ranks");
        }
    }

    #[test]
    fn bodies_share_no_function() {
        for (fine, coarsening) in coarsenings() {
            for (at, node) in fine.all.iter().enumerate() {
                assert!(coarsening.row(at).all(|(number, _)| coarsening.coarse.all[number as usize].body == node.body));
            }
        }
    }
}
