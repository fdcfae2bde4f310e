//! The interpolation to a coarser level as the rows of one rank need it.

use super::level::Coarsening;
use crate::element::Block;
use crate::element::block::{product, transpose};
use crate::mesh::Lists;
use crate::multigrid::stiffness::{LatticeOperator, StoredRows};
use std::rc::Rc;

/// No place.
pub const NONE: u32 = u32::MAX;

/// The interpolation `P`. Fine nodes are counted from the first one of this rank, those of other ranks that rows here couple to come
/// behind these. Coarse ones are counted among those that are *known*: that some of these fine nodes take values from.
pub struct KnownStep {
    /// Where it leads.
    pub coarsening: Rc<Coarsening>,
    /// Numbers of the known coarse nodes, ascending.
    pub known: Vec<u32>,
    /// Fine nodes here.
    here: usize,
    /// Known coarse nodes, with their values, by fine nodes.
    rows: Lists<(u32, f64)>,
    /// Fine nodes here, with the values there, by known coarse nodes.
    supports: Lists<(u32, f64)>,
    /// The frame of each fine node, none for those in the axes of the plane that move freely.
    frame_of: Vec<u32>,
    frames: Vec<Block>,
}

impl KnownStep {
    /// Of the rows of a level.
    pub fn new(fine: &LatticeOperator, coarsening: &Rc<Coarsening>) -> Self {
        let here = fine.own.len();
        let nodes: Vec<usize> = fine.own.clone().chain(fine.far.iter().copied()).collect();
        let mut place = vec![NONE; coarsening.coarse.all.len()];
        nodes.iter().flat_map(|&node| coarsening.row(node)).for_each(|(number, _)| place[number as usize] = 0);
        let known: Vec<u32> = (0..place.len() as u32).filter(|&number| place[number as usize] != NONE).collect();
        known.iter().enumerate().for_each(|(at, &number)| place[number as usize] = at as u32);
        let place = &place;
        let of_node = |(at, &node)| coarsening.row(node).map(move |(number, value)| (at, (place[number as usize], value)));
        let couplings = nodes.iter().enumerate().flat_map(of_node);
        let rows = Lists::new(nodes.len(), couplings.clone());
        let of_here = couplings.take_while(|(at, _)| *at < here);
        let supports = Lists::new(known.len(), of_here.map(|(at, (known, value))| (known as usize, (at as u32, value))));
        let (mut frame_of, mut frames) = (vec![NONE; nodes.len()], Vec::new());
        for (at, &node) in nodes.iter().enumerate() {
            if let Some(frame) = coarsening.frame(node) {
                frame_of[at] = frames.len() as u32;
                frames.push(*frame);
            }
        }
        Self { coarsening: coarsening.clone(), known, here, rows, supports, frame_of, frames }
    }

    /// Whether some of these fine nodes here take values from each known coarse node.
    pub fn above(&self, rows: impl Iterator<Item = u32>) -> Vec<bool> {
        let mut is_above = vec![false; self.known.len()];
        rows.flat_map(|row| self.rows.of(row as usize)).for_each(|&(known, _)| is_above[known as usize] = true);
        is_above
    }

    /// Known coarse nodes that `Pᵀ A P` of the rows here has blocks of in the row of each one, ascending.
    pub fn columns(&self, fine: &StoredRows) -> Vec<Vec<u32>> {
        let mut seen = vec![NONE; self.known.len()];
        let of_row = |known: usize| {
            let mut columns = Vec::new();
            for (column, _) in self.supports.of(known).iter().flat_map(|&(row, _)| self.couplings(fine, row as usize)) {
                for &(other, _) in self.rows.of(column) {
                    if seen[other as usize] != known as u32 {
                        seen[other as usize] = known as u32;
                        columns.push(other);
                    }
                }
            }
            columns.sort_unstable();
            columns
        };
        (0..self.known.len()).map(of_row).collect()
    }

    /// Adds `Pᵀ A P` of the rows here to the row of a known coarse node, whose blocks have these places by known nodes.
    pub fn add_to_row(&self, known: usize, fine: &StoredRows, place: &[u32], sums: &mut [Block]) {
        pulp::Arch::new().dispatch(
            #[inline(always)]
            || {
                for &(row, weight) in self.supports.of(known) {
                    for (column, block) in self.couplings(fine, row as usize) {
                        let block = self.turned(row as usize, column, block);
                        for &(other, value) in self.rows.of(column) {
                            let (sum, factor) = (&mut sums[place[other as usize] as usize], weight * value);
                            (0..2).for_each(|a| (0..2).for_each(|b| sum[a][b] += factor * block[a][b]));
                        }
                    }
                }
            },
        );
    }

    #[inline(always)]
    fn couplings<'a>(&self, rows: &'a StoredRows, k: usize) -> impl Iterator<Item = (usize, &'a Block)> {
        let here = self.here;
        let far = rows.far.couplings(k).map(move |(column, block)| (here + column as usize, block));
        rows.near.couplings(k).map(|(column, block)| (column as usize, block)).chain(far)
    }

    /// `Fᵀ A F` of a coupling of two fine nodes with their frames.
    #[inline(always)]
    fn turned(&self, row: usize, column: usize, block: &Block) -> Block {
        let [of_row, of_column] = [row, column].map(|node| self.frame_of[node]);
        let mut block = *block;
        if of_column != NONE {
            block = product(&block, &self.frames[of_column as usize]);
        }
        if of_row != NONE {
            block = product(&transpose(&self.frames[of_row as usize]), &block);
        }
        block
    }
}
