//! Room in a matrix for what is added to it later: exact counts of blocks.

use crate::petsc::{Matrix, Session};
use crate::system::{Space, SystemError};
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

/// Nodes that contact couples to each node.
pub type ContactNeighbours = BTreeMap<usize, BTreeSet<usize>>;

/// A matrix of zeros at the couplings of contact alone. **Collective**
pub fn contact_room(space: &Space, contact: &ContactNeighbours, session: &Session) -> Result<Matrix, SystemError> {
    let counts = Counts::new(space, contact);
    let (mut diagonal, off_diagonal) = counts.finish();
    let untouched = |at: usize| !contact.contains_key(&(space.own.start + at));
    diagonal.iter_mut().enumerate().filter(|(at, _)| untouched(*at)).for_each(|(_, count)| *count = 0);
    let mut matrix = Matrix::aij(session, space.local_unknowns(), space.local_unknowns(), 2, &diagonal, &off_diagonal)?;
    fill_room(&mut matrix, space, contact)?;
    matrix.assemble()?;
    Ok(matrix)
}

/// Explicit zeros, which keep the room.
pub(super) fn fill_room(matrix: &mut Matrix, space: &Space, contact: &ContactNeighbours) -> Result<(), SystemError> {
    for (&row, columns) in contact.range(space.own.clone()) {
        for &column in columns {
            matrix.add_blocks(&[row as i32], &[column as i32], &[0.0; 4])?;
        }
    }
    Ok(())
}

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

    /// No room for the rows of these nodes, counted from this rank's first.
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
