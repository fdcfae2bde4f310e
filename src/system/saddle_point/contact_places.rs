//! `Bᵀ D B` of one level, added to its stiffness where the couplings of contact lie.

use super::coupling_rows::CouplingRows;
use crate::contact::DiagonalBlock;
use crate::discretisation::SystemError;
use crate::element::Block;
use crate::multigrid::{BlockPlace, RowPlaces, Stiffness};
use std::ops::Range;

/// Where the couplings of each group of multipliers lie among the rows of a stiffness. The search for them takes longer than a
/// change of the active set, which finds them here.
pub struct ContactPlaces {
    /// For each group the first of its rows, and the end: a row for each node of this rank among those of the group.
    starts: Vec<u32>,
    rows: Vec<ContactRow>,
    places: Vec<BlockPlace>,
}

/// A node of this rank in a group.
struct ContactRow {
    /// Place among the nodes of the group.
    at: u32,
    /// Its row in the stiffness.
    stored: u32,
    /// Where the places of its couplings begin, one for each node of the group.
    first: u32,
    /// Whether the next group has it, too.
    is_in_next: bool,
}

impl ContactPlaces {
    /// Of the rows of `B`, the groups of multipliers that `D` couples, and the nodes of this rank.
    ///
    /// # Panics
    /// If the stiffness has no place for one of the couplings.
    pub fn new(rows: &CouplingRows, groups: &[Range<usize>], own: &Range<usize>, stiffness: &Stiffness) -> Self {
        let mut found = Self { starts: vec![0], rows: Vec::new(), places: Vec::new() };
        for group in groups {
            let nodes = rows.row(group.start);
            for (at, (node, _)) in nodes.iter().enumerate().filter(|(_, (node, _))| own.contains(node)) {
                let first = found.places.len() as u32;
                let columns = nodes.iter().map(|(column, _)| *column);
                let stored = stiffness.lattice().places(*node, columns, |place| found.places.push(place));
                found.rows.push(ContactRow { at: at as u32, stored, first, is_in_next: false });
            }
            found.starts.push(found.rows.len() as u32);
        }
        for bounds in found.starts.windows(3) {
            let (here, next) = found.rows[bounds[0] as usize..bounds[2] as usize].split_at_mut((bounds[1] - bounds[0]) as usize);
            here.iter_mut().for_each(|row| row.is_in_next = next.iter().any(|other| other.stored == row.stored));
        }
        found.rows.shrink_to_fit();
        found.places.shrink_to_fit();
        found
    }

    /// Adds `Bᵀ D B` for blocks of `D`, each with the group of its multipliers. **Collective**
    pub fn add(
        &self,
        rows: &CouplingRows,
        weights: &[(usize, DiagonalBlock)],
        stiffness: &mut Stiffness,
    ) -> Result<(), SystemError> {
        let mut blocks = Vec::new();
        for (k, (group, block)) in weights.iter().enumerate() {
            let next_follows = weights.get(k + 1).is_some_and(|(next, _)| *next == group + 1);
            self.add_block(rows, *group, block, next_follows, &mut blocks, stiffness);
        }
        stiffness.assemble()
    }

    /// The same for one block, whether or not that of the next group follows; `blocks` is room to work in.
    fn add_block(
        &self,
        rows: &CouplingRows,
        group: usize,
        weights: &DiagonalBlock,
        next_follows: bool,
        blocks: &mut Vec<Block>,
        stiffness: &mut Stiffness,
    ) {
        let nodes = rows.row(weights.rows.start);
        for row in &self.rows[self.starts[group] as usize..self.starts[group + 1] as usize] {
            let at = row.at as usize;
            blocks.clear();
            blocks.resize(nodes.len(), [[0.0; 2]; 2]);
            for (p, i) in weights.rows.clone().enumerate() {
                let left = rows.row(i)[at].1;
                for (q, j) in weights.rows.clone().enumerate() {
                    let weighted = weights.values[p][q] * left;
                    for (block, (_, right)) in blocks.iter_mut().zip(rows.row(j)) {
                        for a in 0..2 {
                            block[a][0] += weighted[a] * right.x;
                            block[a][1] += weighted[a] * right.y;
                        }
                    }
                }
            }
            let places = &self.places[row.first as usize..][..nodes.len()];
            // More is added to what the next group has: its diagonal block is inverted then.
            let is_last = !(next_follows && row.is_in_next);
            stiffness.add_to_row(RowPlaces { stored: row.stored, is_last, blocks: places }, blocks);
        }
    }
}
