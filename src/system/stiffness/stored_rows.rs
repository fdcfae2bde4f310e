//! The rows of a stiffness that are stored, as blocks of two by two.

use super::strips::{inverse, subtract};
use crate::element::Block;
use crate::system::space::Components;
use std::cell::Cell;
use std::ops::Range;

/// Rows of some nodes of this rank. Columns count the nodes of this rank from 0; those of others have places in a list of
/// their own.
#[derive(Clone, Default)]
pub struct StoredRows {
    /// The nodes, ascending, counted from this rank's first.
    pub(in crate::system) nodes: Vec<u32>,
    /// Inverses of the diagonal blocks.
    pub(in crate::system) inverses: Vec<Block>,
    /// Columns of this rank.
    pub(in crate::system) near: Part,
    /// Columns of other ranks.
    pub(in crate::system) far: Part,
}

/// One part of all rows: that of row `k` lies in `starts[k]..starts[k + 1]`, its columns ascending.
#[derive(Clone)]
pub struct Part {
    pub(in crate::system) starts: Vec<u32>,
    pub(in crate::system) columns: Vec<u32>,
    pub(in crate::system) blocks: Vec<Block>,
}

/// A column of the stored rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BlockColumn {
    /// A node of this rank, counted from its first.
    Near(u32),
    /// A place in the list of nodes of other ranks.
    Far(u32),
}

impl BlockColumn {
    /// The column of a node of any rank, `far` being the list, ascending.
    ///
    /// # Panics
    /// If neither this rank nor the list has the node.
    #[inline]
    pub fn of(node: usize, own: &Range<usize>, far: &[usize]) -> Self {
        match own.contains(&node) {
            true => Self::Near((node - own.start) as u32),
            false => Self::Far(far.binary_search(&node).expect("a known column") as u32),
        }
    }
}

impl Default for Part {
    fn default() -> Self {
        Self { starts: vec![0], columns: Vec::new(), blocks: Vec::new() }
    }
}

impl Part {
    /// Places of row `k`.
    #[inline]
    pub fn row(&self, k: usize) -> Range<usize> {
        self.starts[k] as usize..self.starts[k + 1] as usize
    }

    /// Couplings of row `k`.
    pub fn couplings(&self, k: usize) -> impl Iterator<Item = (u32, &Block)> {
        self.columns[self.row(k)].iter().copied().zip(&self.blocks[self.row(k)])
    }

    /// The block of row `k` in a column.
    ///
    /// # Panics
    /// If the row has no such column.
    #[inline]
    fn at(&self, k: usize, column: u32) -> usize {
        let row = self.row(k);
        row.start + self.columns[row].binary_search(&column).expect("the pattern of a stiffness stays")
    }

    /// `sum - Σ K x` of a row, in two parts that do not wait for each other.
    #[inline(always)]
    fn subtract(&self, k: usize, sum: Components, x: impl Fn(usize) -> Components) -> Components {
        let range = self.starts[k] as usize..self.starts[k + 1] as usize;
        let (columns, blocks) = (self.columns[range.clone()].as_chunks::<2>(), self.blocks[range].as_chunks::<2>());
        let (mut sum, mut other) = (sum, [0.0; 2]);
        for (columns, blocks) in columns.0.iter().zip(blocks.0) {
            subtract(&mut sum, &blocks[0], x(columns[0] as usize));
            subtract(&mut other, &blocks[1], x(columns[1] as usize));
        }
        if let ([column], [block]) = (columns.1, blocks.1) {
            subtract(&mut sum, block, x(*column as usize));
        }
        [sum[0] + other[0], sum[1] + other[1]]
    }
}

impl StoredRows {
    /// Adds a block to row `k`. Its inverse is that of before until [`StoredRows::invert`].
    ///
    /// # Panics
    /// If the row has no such column.
    #[inline]
    pub fn add(&mut self, k: usize, column: BlockColumn, block: &Block) {
        let (part, column) = match column {
            BlockColumn::Near(column) => (&mut self.near, column),
            BlockColumn::Far(column) => (&mut self.far, column),
        };
        let at = part.at(k, column);
        let sum = &mut part.blocks[at];
        *sum = [0, 1].map(|a| [0, 1].map(|b| sum[a][b] + block[a][b]));
    }

    /// The row of a node, if it is stored; the node is counted from this rank's first.
    pub fn place(&self, node: usize) -> Option<usize> {
        place(&self.nodes, node)
    }

    /// Inverts the diagonal block of row `k`.
    ///
    /// # Panics
    /// If it has no inverse: that of a stiffness has one.
    pub fn invert(&mut self, k: usize) {
        self.inverses[k] = inverse(self.diagonal(k)).expect("a stiffness has a diagonal");
    }

    /// The diagonal block of row `k`.
    pub fn diagonal(&self, k: usize) -> &Block {
        &self.near.blocks[self.near.at(k, self.nodes[k])]
    }

    /// Largest sum of magnitudes in a row.
    pub fn norm_infinity(&self) -> f64 {
        let of_row = |k: usize, a: usize| -> f64 {
            self.near.couplings(k).chain(self.far.couplings(k)).map(|(_, block)| block[a][0].abs() + block[a][1].abs()).sum()
        };
        (0..self.nodes.len()).map(|k| of_row(k, 0).max(of_row(k, 1))).fold(0.0, f64::max)
    }

    /// Blocks in all rows.
    pub fn block_count(&self) -> usize {
        self.near.blocks.len() + self.far.blocks.len()
    }

    /// `y = K x` in these rows, `far` the values of the columns of other ranks.
    pub fn multiply(&self, x: &[Components], far: &[Components], y: &mut [Components]) {
        self.each(x, far, |node, sum| y[node] = sum.map(|v| -v));
    }

    /// `r = b - K x` in these rows.
    pub fn residual(&self, b: &[Components], x: &[Components], far: &[Components], r: &mut [Components]) {
        self.each(x, far, |node, sum| r[node] = [b[node][0] + sum[0], b[node][1] + sum[1]]);
    }

    /// Shows `-K x` row by row.
    fn each(&self, x: &[Components], far: &[Components], mut show: impl FnMut(usize, Components)) {
        for (k, &node) in self.nodes.iter().enumerate() {
            let sum = self.near.subtract(k, [0.0; 2], |column| x[column]);
            show(node as usize, self.far.subtract(k, sum, |column| far[column]));
        }
    }

    /// Relaxes the nodes in their order, `far` staying as it is.
    pub fn forward(&self, b: &[Components], x: &[Cell<Components>], far: &[Components]) {
        (0..self.nodes.len()).for_each(|k| self.relax(k, b, x, far));
    }

    /// The same in the opposite order.
    pub fn backward(&self, b: &[Components], x: &[Cell<Components>], far: &[Components]) {
        (0..self.nodes.len()).rev().for_each(|k| self.relax(k, b, x, far));
    }

    #[inline(always)]
    fn relax(&self, k: usize, b: &[Components], x: &[Cell<Components>], far: &[Components]) {
        let node = self.nodes[k] as usize;
        let mut sum = self.near.subtract(k, b[node], |column| x[column].get());
        if !far.is_empty() {
            sum = self.far.subtract(k, sum, |column| far[column]);
        }
        let [u, v] = x[node].get();
        let inverse = &self.inverses[k];
        x[node].set([u + inverse[0][0] * sum[0] + inverse[0][1] * sum[1], v + inverse[1][0] * sum[0] + inverse[1][1] * sum[1]]);
    }
}

/// Place of a node among ascending ones.
#[inline]
pub fn place(nodes: &[u32], node: usize) -> Option<usize> {
    let is_it = |at: &usize| nodes.get(*at) == Some(&(node as u32));
    // Where none is missing before it, its place is its number.
    Some(node).filter(is_it).or_else(|| nodes.binary_search(&(node as u32)).ok())
}
