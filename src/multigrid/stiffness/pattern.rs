//! Which blocks the stored rows have.

use super::ContactNeighbours;
use super::stored_rows::{Part, StoredRows};
use crate::mesh::each_once;
use std::ops::Range;

/// Columns of rows, each perhaps several times, before they are sorted. Nodes have their numbers among all ranks.
pub struct RowColumns {
    /// Where the columns of each row begin.
    starts: Vec<usize>,
    /// Where the next column of each row goes.
    ends: Vec<usize>,
    /// A mesh has fewer than 2³² nodes: PETSc counts its unknowns by 31 bits, or there is no memory for them.
    columns: Vec<u32>,
}

impl RowColumns {
    /// Room for so many columns in each row.
    pub fn new(counts: &[u32]) -> Self {
        let mut all = 0;
        let mut starts = Vec::with_capacity(counts.len());
        for &count in counts {
            starts.push(all);
            all += count as usize;
        }
        Self { ends: starts.clone(), starts, columns: vec![0; all] }
    }

    /// One more column of row `k`.
    ///
    /// # Panics
    /// If there is no room in the last row.
    #[inline]
    pub fn push(&mut self, k: usize, column: usize) {
        self.columns[self.ends[k]] = column as u32;
        self.ends[k] += 1;
    }

    /// Rows of these nodes with zeros at their couplings, each once and ascending, and the nodes of other ranks among the
    /// columns and these others; `own` are the nodes of this rank. Some rows have no blocks.
    pub fn into_rows(
        mut self,
        nodes: Vec<u32>,
        own: &Range<usize>,
        others: impl Iterator<Item = usize>,
        is_stored: impl Fn(usize) -> bool + Copy,
    ) -> (StoredRows, Vec<usize>) {
        let mut far: Vec<usize> = others.filter(|node| !own.contains(node)).collect();
        // What is left of each row moves to the front of all columns.
        let mut at = 0;
        for k in 0..nodes.len() {
            let (start, end) = (self.starts[k], self.ends[k]);
            self.columns[start..end].sort_unstable();
            self.starts[k] = at;
            for from in start..end {
                let column = self.columns[from];
                if at == self.starts[k] || self.columns[at - 1] != column {
                    self.columns[at] = column;
                    at += 1;
                }
            }
            self.ends[k] = at;
            far.extend(
                self.columns[self.starts[k]..at].iter().map(|&column| column as usize).filter(|column| !own.contains(column)),
            );
        }
        let far = each_once(far);
        let near = self.part(|column| own.contains(&column).then(|| (column - own.start) as u32), is_stored);
        let place_there = |column| match own.contains(&column) {
            true => None,
            false => Some(far.binary_search(&column).expect("a column of another rank") as u32),
        };
        let others = self.part(place_there, is_stored);
        let mut count = 0;
        let inverse_of = (0..nodes.len()).map(|k| {
            count += u32::from(is_stored(k));
            count.saturating_sub(1)
        });
        let inverse_of = inverse_of.collect();
        let inverses = vec![[[0.0; 2]; 2]; count as usize];
        (StoredRows { nodes, inverses, inverse_of, near, far: others }, far)
    }

    /// The columns that `place` has a place for, in their order, with zeros.
    fn part(&self, place: impl Fn(usize) -> Option<u32>, is_stored: impl Fn(usize) -> bool) -> Part {
        let count = self.starts.iter().zip(&self.ends).flat_map(|(&start, &end)| &self.columns[start..end]);
        let count = count.filter(|column| place(**column as usize).is_some()).count();
        let (mut starts, mut columns) = (Vec::with_capacity(self.starts.len() + 1), Vec::with_capacity(count));
        starts.push(0);
        for (&start, &end) in self.starts.iter().zip(&self.ends) {
            columns.extend(self.columns[start..end].iter().filter_map(|&column| place(column as usize)));
            starts.push(columns.len() as u32);
        }
        Part::of_columns(starts, columns, is_stored)
    }
}

impl StoredRows {
    /// A copy with places for the couplings of contact, and its nodes of other ranks; `far` are those of this one. Rows that
    /// contact does not touch have the blocks of these.
    pub fn with_places(&self, contact: &ContactNeighbours, own: &Range<usize>, far: &[usize]) -> (Self, Vec<usize>) {
        let rows = || contact.range(own.clone());
        let wanted = rows().flat_map(|(_, columns)| columns).filter(|column| !own.contains(column));
        let all = each_once(far.iter().chain(wanted).copied());
        let moved: Vec<u32> = far.iter().map(|node| all.binary_search(node).expect("it is among all") as u32).collect();
        let of = |is_near: bool| {
            let wanted = rows().map(|(row, columns)| {
                let k = self.place(row - own.start).expect("rows of contact are stored");
                let columns = columns.iter().filter(|column| own.contains(column) == is_near);
                let place = |&column: &usize| match is_near {
                    true => (column - own.start) as u32,
                    false => all.binary_search(&column).expect("it is among all") as u32,
                };
                (k, columns.map(place).collect())
            });
            wanted.collect::<Vec<(usize, Vec<u32>)>>()
        };
        let near = self.near.widened(&of(true));
        let mut other = self.far.clone();
        other.columns.iter_mut().for_each(|column| *column = moved[*column as usize]);
        let other = other.widened(&of(false));
        let mut inverses = Vec::with_capacity(self.inverses.len() + rows().count());
        inverses.extend_from_slice(&self.inverses);
        let mut inverse_of = self.inverse_of.clone();
        for k in rows().filter_map(|(row, _)| self.place(row - own.start)) {
            inverses.push(*self.inverse(k));
            inverse_of[k] = inverses.len() as u32 - 1;
        }
        (Self { nodes: self.nodes.clone(), inverses, inverse_of, near, far: other }, all)
    }
}

impl Part {
    /// A copy with zeros in these columns of some rows (both ascending), where there is nothing yet. These rows have blocks of
    /// their own.
    fn widened(&self, wanted: &[(usize, Vec<u32>)]) -> Self {
        let most_new: usize = wanted.iter().map(|(_, columns)| columns.len()).sum();
        let most_blocks = most_new + wanted.iter().map(|(k, _)| self.row(*k).len()).sum::<usize>();
        let mut blocks = Vec::with_capacity(self.blocks.len() + most_blocks);
        blocks.extend_from_slice(&self.blocks);
        let mut wide = Self {
            starts: Vec::with_capacity(self.starts.len()),
            columns: Vec::with_capacity(self.columns.len() + most_new),
            firsts: Vec::with_capacity(self.firsts.len()),
            kept: self.kept.clone(),
            blocks,
        };
        wide.starts.push(0);
        let mut next = 0;
        for (k, columns) in wanted {
            wide.copy(self, next..*k);
            wide.firsts.push(wide.count() as u32);
            let mut columns = columns.as_slice();
            for (column, block) in self.couplings(*k) {
                let before = columns.partition_point(|&wanted| wanted < column);
                columns[..before].iter().for_each(|&wanted| wide.push(wanted, [[0.0; 2]; 2]));
                wide.push(column, *block);
                columns = &columns[before + usize::from(columns.get(before) == Some(&column))..];
            }
            columns.iter().for_each(|&wanted| wide.push(wanted, [[0.0; 2]; 2]));
            wide.starts.push(wide.columns.len() as u32);
            next = k + 1;
        }
        wide.copy(self, next..self.starts.len() - 1);
        wide
    }

    /// Appends rows of another one, which has the same blocks.
    fn copy(&mut self, other: &Self, rows: Range<usize>) {
        let places = other.starts[rows.start] as usize..other.starts[rows.end] as usize;
        let (first, now) = (other.starts[rows.start], self.columns.len() as u32);
        self.starts.extend(other.starts[rows.start + 1..=rows.end].iter().map(|end| end - first + now));
        self.columns.extend_from_slice(&other.columns[places]);
        self.firsts.extend_from_slice(&other.firsts[rows]);
    }

    fn push(&mut self, column: u32, block: crate::element::Block) {
        self.columns.push(column);
        self.blocks.push(block);
    }
}

#[cfg(test)]
mod tests {
    use super::super::stored_rows::BlockColumn;
    use super::*;
    use std::rc::Rc;

    /// Three rows along a line, each coupled to those beside it, and the first to a node of another rank.
    fn rows() -> StoredRows {
        let mut columns = RowColumns::new(&[3, 3, 2]);
        for (row, column) in [(0, 10), (0, 11), (0, 3), (1, 10), (1, 11), (1, 12), (2, 11), (2, 12)] {
            columns.push(row, column);
        }
        let (mut rows, far) = columns.into_rows(vec![0, 1, 2], &(10..13), std::iter::empty(), |_| true);
        assert_eq!(far, [3]);
        for k in 0..3 {
            rows.add(k, BlockColumn::Near(k as u32), &[[2.0 + k as f64, 0.0], [0.0, 1.0]]);
            rows.invert(k);
        }
        rows
    }

    fn blocks(rows: &StoredRows, k: usize) -> Vec<(u32, crate::element::Block)> {
        rows.near.couplings(k).chain(rows.far.couplings(k)).map(|(column, block)| (column, *block)).collect()
    }

    #[test]
    fn copies_with_places_for_contact_have_the_blocks_of_the_bodies_in_common() {
        let contact = ContactNeighbours::from([(10, [10, 12, 5].into()), (12, [10, 12].into())]);
        let mut kept = rows();
        kept.keep();
        let [(alone, _), (mut common, far)] = [&rows(), &kept].map(|rows| rows.with_places(&contact, &(10..13), &[3]));
        assert!(Rc::ptr_eq(&common.near.kept, &kept.near.kept) && common.near.blocks.len() == 3 + 3);
        assert_eq!(far, [3, 5]);
        for k in 0..3 {
            assert_eq!(blocks(&common, k), blocks(&alone, k));
            assert_eq!(common.inverse(k), alone.inverse(k));
        }
        // What contact adds is in this copy alone, also to columns of other ranks.
        common.add(0, BlockColumn::Near(0), &[[1.0; 2]; 2]);
        common.add(0, BlockColumn::Far(1), &[[7.0; 2]; 2]);
        common.invert(0);
        assert_eq!(common.diagonal(0), &[[3.0, 1.0], [1.0, 2.0]]);
        assert_eq!(blocks(&common, 0).last(), Some(&(1, [[7.0; 2]; 2])));
        assert_eq!(kept.diagonal(0), &[[2.0, 0.0], [0.0, 1.0]]);
        assert_ne!(common.inverse(0), kept.inverse(0));
    }
}
