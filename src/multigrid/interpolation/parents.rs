//! Fine nodes with their coarse parents, and what they take over of these.

use crate::discretisation::{Scene, Space};
use crate::element::Block;
use crate::element::block::IDENTITY;
use crate::mesh::lattice::{self, Place};
use std::collections::HashMap;
use std::ops::Range;

/// What a fine node takes over of a coarse one.
#[derive(Clone, Copy)]
pub struct Parentage {
    /// The fine node.
    pub node: usize,
    /// The coarse one.
    pub parent: usize,
    /// Its share.
    pub weight: f64,
    /// What the fine node would take over of all of it, in their frames; none if these are the axes of the plane, in which both move
    /// freely.
    pub turned: Option<Block>,
}

impl Parentage {
    /// Of the whole of it, times the share.
    pub fn block(&self) -> Block {
        self.turned.unwrap_or(IDENTITY).map(|row| row.map(|value| self.weight * value))
    }
}

/// Weights of the parents of most nodes.
const EVEN: [f64; 2] = [0.5; 2];

/// Fine nodes of a rank with their coarse parents, each node once.
pub struct NodeParents {
    nodes: Vec<[usize; 3]>,
    /// Weights of the parents, for the few nodes that are not in their middle.
    graded: HashMap<usize, [f64; 2]>,
}

impl NodeParents {
    /// Without the places `left_out` of each row of the lattice of a macro triangle.
    pub fn new(scene: &Scene, fine: &Space, coarse: &Space, rank: usize, left_out: impl Fn(u32, usize) -> Range<usize>) -> Self {
        let n = fine.numbering.level.intervals;
        let mut seen = vec![false; fine.own.len()];
        let mut rows = Self { nodes: Vec::new(), graded: HashMap::new() };
        for &triangle in fine.numbering.partition.triangles_of(rank) {
            let numbers = fine.numbering.triangle(&scene.mesh, triangle as usize);
            let below = coarse.numbering.triangle(&scene.mesh, triangle as usize);
            let rest = (0..=n).flat_map(|j| {
                let out = left_out(triangle, j);
                (0..out.start).chain(out.end..=n - j).map(move |i| (i, j))
            });
            for (i, j) in rest {
                let node = numbers.node(i, j);
                if !matches!(lattice::place(n, i, j), Place::Inside(_)) {
                    if !fine.own.contains(&node) || seen[node - fine.own.start] {
                        continue;
                    }
                    seen[node - fine.own.start] = true;
                    let weights = scene.mesh.parent_weights(triangle as usize, fine.numbering.level, (i, j));
                    if weights != EVEN {
                        rows.graded.insert(node, weights);
                    }
                }
                let [a, b] = lattice::parents(i, j).map(|(i, j)| below.node(i, j));
                rows.nodes.push([node, a, b]);
            }
        }
        rows
    }

    /// Weights of the parents of a node.
    pub fn weights(&self, node: usize) -> [f64; 2] {
        self.graded.get(&node).copied().unwrap_or(EVEN)
    }

    /// Nodes with their parents.
    pub fn iter(&self) -> impl Iterator<Item = (usize, [usize; 2])> + Clone {
        self.nodes.iter().map(|&[node, a, b]| (node, [a, b]))
    }
}
