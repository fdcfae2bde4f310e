//! Exact counts of the blocks in the rows of a stiffness, those that contact adds later among them.

use crate::system::Space;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

/// Nodes that contact couples to each node.
pub type ContactNeighbours = BTreeMap<usize, BTreeSet<usize>>;

/// Numbers of stored blocks per owned node.
pub(super) struct Counts<'a> {
    space: &'a Space,
    diagonal: Vec<i32>,
    off_diagonal: Vec<i32>,
    /// Columns of the rows that contact adds to, so that none is counted twice.
    contact: BTreeMap<usize, BTreeSet<usize>>,
}

impl<'a> Counts<'a> {
    /// Diagonal blocks alone.
    pub(super) fn new(space: &'a Space, contact: &ContactNeighbours) -> Self {
        let contact = contact.range(space.own.clone()).map(|(&node, others)| (node, others.clone())).collect();
        Self { space, diagonal: vec![1; space.own.len()], off_diagonal: vec![0; space.own.len()], contact }
    }

    /// Preallocates nothing for the rows of these nodes, counted from this rank's first.
    pub(super) fn leave_out(&mut self, nodes: Range<usize>) {
        self.diagonal[nodes].fill(0);
    }

    /// One more coupling of an owned node.
    pub(super) fn add(&mut self, row: usize, column: usize) {
        let at = row - self.space.own.start;
        if !self.contact.is_empty()
            && let Some(columns) = self.contact.get_mut(&row)
        {
            columns.insert(column);
            return;
        }
        if self.space.own.contains(&column) { self.diagonal[at] += 1 } else { self.off_diagonal[at] += 1 }
    }

    /// Blocks in each row: in this rank's own columns, and in others'.
    pub(super) fn finish(mut self) -> (Vec<i32>, Vec<i32>) {
        for (row, columns) in &self.contact {
            let at = row - self.space.own.start;
            let own = columns.iter().filter(|column| self.space.own.contains(column) && *column != row).count();
            let all = columns.iter().filter(|column| *column != row).count();
            self.diagonal[at] = 1 + own as i32;
            self.off_diagonal[at] = (all - own) as i32;
        }
        (self.diagonal, self.off_diagonal)
    }
}
