//! Rows of `B` on every level, in the nodes' frames: `B_l = B_{l+1} P_{l+1}`, without any matrix product.

use crate::contact::DiagonalBlock;
use crate::geometry::Point;
use crate::mesh::{EdgeNode, MacroMesh};
use crate::system::{Coupling, Space};
use std::collections::{BTreeMap, BTreeSet};

/// Rows of `B` at one level: for each multiplier, node numbers with their two entries. Columns of prescribed
/// components are zero. The same on every rank.
#[derive(Clone, Debug)]
pub struct CouplingRows {
    rows: Vec<Vec<(usize, Point)>>,
}

/// Entries of one row at one level: by node number the node, which finds its parents on the next coarser level, and its entry.
type NodeEntries = BTreeMap<usize, (EdgeNode, Point)>;

impl CouplingRows {
    /// Rows of every level of `spaces` (coarsest first); the finest are those of `coupling`, the others follow by the
    /// transposed interpolation, each level dropping its own prescribed components.
    pub fn of_levels(mesh: &MacroMesh, coupling: &Coupling, spaces: &[Space]) -> Vec<Self> {
        let finest = &spaces[spaces.len() - 1];
        let mut rows: Vec<NodeEntries> = coupling
            .rows
            .iter()
            .map(|row| {
                let mut nodes = NodeEntries::new();
                for coupled in row {
                    let number = coupled.node.number(mesh, &finest.numbering);
                    nodes.entry(number).or_insert((coupled.node, Point::zeros())).1 += coupled.value;
                }
                nodes.iter_mut().for_each(|(&number, (_, value))| *value = finest.free_part(number, *value));
                nodes
            })
            .collect();
        let mut levels = vec![Self::from_nodes(&rows)];
        for pair in spaces.windows(2).rev() {
            let (coarse, fine) = (&pair[0], &pair[1]);
            rows = rows.iter().map(|nodes| restrict(mesh, nodes, fine, coarse)).collect();
            levels.push(Self::from_nodes(&rows));
        }
        levels.reverse();
        levels
    }

    fn from_nodes(rows: &[NodeEntries]) -> Self {
        let row = |nodes: &NodeEntries| nodes.iter().map(|(&number, &(_, value))| (number, value)).collect();
        Self { rows: rows.iter().map(row).collect() }
    }

    /// Entries of one multiplier, by ascending node number.
    pub fn row(&self, multiplier: usize) -> &[(usize, Point)] {
        &self.rows[multiplier]
    }

    /// Number of multipliers.
    pub fn count(&self) -> usize {
        self.rows.len()
    }

    /// Nodes coupled to each node by `BᵀDB`, whatever the active set; `groups` are the multipliers that `D` couples.
    pub fn neighbours(&self, groups: &[Vec<usize>]) -> BTreeMap<usize, BTreeSet<usize>> {
        let mut neighbours: BTreeMap<usize, BTreeSet<usize>> = BTreeMap::new();
        for group in groups {
            let nodes: BTreeSet<usize> = group.iter().flat_map(|&i| self.rows[i].iter().map(|&(node, _)| node)).collect();
            for &node in &nodes {
                neighbours.entry(node).or_default().extend(&nodes);
            }
        }
        neighbours
    }

    /// Hands the 2 x 2 blocks of `Bᵀ D B` to `add(row node, column node, block row by row)`.
    pub fn weighted_square(&self, weights: &[DiagonalBlock], mut add: impl FnMut(usize, usize, [f64; 4])) {
        for block in weights {
            for (p, &i) in block.rows.iter().enumerate() {
                for (q, &j) in block.rows.iter().enumerate() {
                    for &(a, left) in &self.rows[i] {
                        for &(b, right) in &self.rows[j] {
                            let d = block.values[p][q];
                            add(a, b, [d * left.x * right.x, d * left.x * right.y, d * left.y * right.x, d * left.y * right.y]);
                        }
                    }
                }
            }
        }
    }
}

/// One level down: each node hands its entries to its parents, by their weights.
fn restrict(mesh: &MacroMesh, nodes: &NodeEntries, fine: &Space, coarse: &Space) -> NodeEntries {
    let mut sums = NodeEntries::new();
    for (&number, &(node, value)) in nodes {
        let global = fine.to_global(number, value);
        for (parent, weight) in node.parents(mesh, fine.numbering.level) {
            let number = parent.number(mesh, &coarse.numbering);
            sums.entry(number).or_insert((parent, Point::zeros())).1 += weight * global;
        }
    }
    sums.iter_mut().for_each(|(&number, (_, value))| *value = coarse.free_part(number, *value));
    sums
}
