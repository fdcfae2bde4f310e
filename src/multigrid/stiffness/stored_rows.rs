//! The rows of a stiffness that are stored, as blocks of two by two.

use crate::element::Block;
use crate::element::block::{add, inverse};
use faer::sparse::Triplet;
use rustc_hash::FxHashMap;
use std::ops::Range;
use std::rc::Rc;

/// Columns of a row in which a place is counted, not searched: a P2 corner where six triangles meet couples to 19 nodes.
/// It bounds the work on long rows of contact, and changes no result; values beside it were not timed.
const FEW: usize = 32;

/// Where the blocks of a row begin that has none: products of it go through its triangles.
const NOWHERE: u32 = u32::MAX;

/// Rows of some nodes of this rank. Columns count the nodes of this rank from 0; those of others have places in a list of
/// their own. Rows with the same couplings share them: along an edge of the macro mesh, or inside of a graded macro triangle, most are.
#[derive(Clone)]
pub struct StoredRows {
    /// The nodes, ascending, counted from this rank's first.
    pub nodes: Vec<u32>,
    /// Inverses of diagonal blocks of rows that have blocks.
    pub(crate) inverses: Vec<Block>,
    /// The inverse of each row.
    pub(crate) inverse_of: Vec<u32>,
    /// Columns of this rank.
    pub(crate) near: Part,
    /// Columns of other ranks.
    pub(crate) far: Part,
}

/// One part of all rows: the columns of row `k` are `starts[k]..starts[k + 1]`, ascending, and its blocks are as many from
/// `firsts[k]` on, counted through those that are `kept` and then the others. A row without blocks has the columns that
/// [`super::straight_triangles::StraightTriangles::each_row`] shows.
#[derive(Clone)]
pub struct Part {
    pub(crate) starts: Vec<u32>,
    pub(crate) columns: Vec<u32>,
    pub(crate) firsts: Vec<u32>,
    /// Blocks that all copies of these rows have in common: those of the bodies without contact.
    pub(crate) kept: Rc<Vec<Block>>,
    pub(crate) blocks: Vec<Block>,
}

/// A column of the stored rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BlockColumn {
    /// A node of this rank, counted from its first.
    Near(u32),
    /// A place in the list of nodes of other ranks.
    Far(u32),
}

/// Where a block lies: among those of columns of this rank, or behind these among those of other ranks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BlockPlace(u32);

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

impl Part {
    /// Zeros in these columns, ascending, of each row.
    pub fn zeros(rows: impl Iterator<Item = impl Iterator<Item = u32>>) -> Self {
        let (mut starts, mut columns) = (vec![0], Vec::new());
        for row in rows {
            columns.extend(row);
            starts.push(columns.len() as u32);
        }
        Self::of_columns(starts, columns, |_| true)
    }

    /// Zeros in these columns of some rows, one list after the other; `starts` are where those of each row begin.
    pub fn of_columns(starts: Vec<u32>, columns: Vec<u32>, is_stored: impl Fn(usize) -> bool) -> Self {
        let mut count = 0;
        let firsts = starts.windows(2).enumerate().map(|(k, ends)| {
            if !is_stored(k) {
                return NOWHERE;
            }
            count += ends[1] - ends[0];
            count - (ends[1] - ends[0])
        });
        let firsts = firsts.collect();
        // Pages that the system has cleared are copied when they are first added to: written now, they are touched once.
        let mut blocks = Vec::with_capacity(count as usize);
        blocks.resize(count as usize, [[0.0; 2]; 2]);
        Self { starts, columns, firsts, kept: Rc::default(), blocks }
    }

    /// Places of the columns of row `k`.
    #[inline]
    pub fn row(&self, k: usize) -> Range<usize> {
        self.starts[k] as usize..self.starts[k + 1] as usize
    }

    /// Whether each row has blocks of its own, which lie like its columns.
    pub fn is_unshared(&self) -> bool {
        self.kept.is_empty() && self.firsts.iter().zip(&self.starts).all(|(first, start)| first == start)
    }

    /// Couplings of row `k`.
    pub fn couplings(&self, k: usize) -> impl Iterator<Item = (u32, &Block)> {
        self.columns[self.row(k)].iter().copied().zip(self.blocks_of(k))
    }

    /// Blocks of row `k`.
    #[inline(always)]
    pub fn blocks_of(&self, k: usize) -> &[Block] {
        let first = self.firsts[k] as usize;
        let blocks = match first.checked_sub(self.kept.len()) {
            Some(first) => &self.blocks[first..],
            None => &self.kept[first..],
        };
        &blocks[..self.row(k).len()]
    }

    /// How many blocks there are.
    pub(super) fn count(&self) -> usize {
        self.kept.len() + self.blocks.len()
    }

    /// The blocks so far become those that copies have in common.
    fn keep(&mut self) {
        assert!(self.kept.is_empty(), "rows are kept once");
        self.kept = Rc::new(std::mem::take(&mut self.blocks));
    }

    /// The block of row `k` in a column.
    ///
    /// # Panics
    /// If the row has no such column.
    #[inline]
    fn at(&self, k: usize, column: u32) -> usize {
        let columns = &self.columns[self.row(k)];
        // Of few columns, counting takes no branch that is guessed wrong, and goes by several at once; rows of contact may be long.
        let place = match columns.len() {
            ..=FEW => columns.iter().map(|&other| u32::from(other < column)).sum::<u32>() as usize,
            _ => columns.partition_point(|&other| other < column),
        };
        assert!(columns.get(place) == Some(&column), "the pattern of a stiffness stays");
        self.firsts[k] as usize + place
    }
}

/// Blocks that are collected row by row: rows with the same ones share them.
#[derive(Default)]
struct SharedBlocks {
    known: FxHashMap<u64, u32>,
    blocks: Vec<Block>,
}

impl SharedBlocks {
    /// Where the blocks of a row begin among all; one that `keeps` its own shares them with none before it.
    fn place(&mut self, row: &[Block], keeps: bool) -> u32 {
        let next = self.blocks.len() as u32;
        let first = if keeps { next } else { *self.known.entry(fingerprint(row)).or_insert(next) };
        // Two rows with one fingerprint are told apart.
        let first = if self.blocks[first as usize..].starts_with(row) { first } else { next };
        if first == next {
            self.blocks.extend_from_slice(row);
        }
        first
    }

    /// The blocks, in no more memory than they need.
    fn into_blocks(mut self) -> Vec<Block> {
        self.blocks.shrink_to_fit();
        self.blocks
    }
}

impl Part {
    /// Shares the blocks of rows that have the same ones, but for those that are to keep their own.
    fn share(&mut self, keeps: &[bool]) {
        let mut shared = SharedBlocks::default();
        for (k, &keeps) in keeps.iter().enumerate() {
            self.firsts[k] = shared.place(self.blocks_of(k), keeps);
        }
        self.blocks = shared.into_blocks();
    }
}

/// A number that is the same for the same blocks.
fn fingerprint(blocks: &[Block]) -> u64 {
    let mix = |sum: u64, value: &f64| (sum.rotate_left(5) ^ value.to_bits()).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    // Zeros in different numbers are different: what is shared must not reach into the next row.
    blocks.as_flattened().as_flattened().iter().fold(blocks.len() as u64, mix)
}

impl StoredRows {
    /// Rows of all nodes of a rank, which share nothing.
    pub fn zeros(near: Part, far: Part) -> Self {
        let count = near.firsts.len() as u32;
        Self {
            nodes: (0..count).collect(),
            inverses: vec![[[0.0; 2]; 2]; count as usize],
            inverse_of: (0..count).collect(),
            near,
            far,
        }
    }

    /// The blocks so far are those that copies have in common. Nothing is added to them any more.
    pub fn keep(&mut self) {
        self.near.keep();
        self.far.keep();
    }

    /// Replaces the blocks of row `k`, which shares them with none: those of columns of this rank first.
    ///
    /// # Panics
    /// If copies have blocks in common.
    pub fn set_row(&mut self, k: usize, blocks: &[Block]) {
        assert!(self.near.kept.is_empty() && self.far.kept.is_empty(), "rows of a product are nobody else's");
        let (near, far) = blocks.split_at(self.near.row(k).len());
        self.near.blocks[self.near.firsts[k] as usize..][..near.len()].copy_from_slice(near);
        self.far.blocks[self.far.firsts[k] as usize..][..far.len()].copy_from_slice(far);
        self.invert(k);
    }

    /// Whether row `k` has blocks.
    #[inline(always)]
    pub fn is_stored(&self, k: usize) -> bool {
        self.near.firsts[k] != NOWHERE
    }

    /// Inverse of the diagonal block of row `k`.
    #[inline(always)]
    pub fn inverse(&self, k: usize) -> &Block {
        &self.inverses[self.inverse_of[k] as usize]
    }
}

impl StoredRows {
    /// Shares what rows have in common, but for rows of these nodes (counted from this rank's first, ascending): contact adds
    /// to them.
    pub fn share(&mut self, contact: impl Iterator<Item = usize>) {
        let mut keeps = vec![false; self.nodes.len()];
        contact.filter_map(|node| self.place(node)).for_each(|k| keeps[k] = true);
        self.near.share(&keeps);
        self.far.share(&keeps);
        let mut shared = SharedBlocks::default();
        for (k, keeps) in keeps.into_iter().enumerate() {
            self.inverse_of[k] = shared.place(&[*self.inverse(k)], keeps);
        }
        self.inverses = shared.into_blocks();
    }

    /// Entries on and below the diagonal of the matrix of single unknowns, if these rows are those of all nodes.
    pub fn lower_entries(&self) -> Vec<Triplet<u32, u32, f64>> {
        let mut entries = Vec::with_capacity(2 * self.near.columns.len() + 2 * self.nodes.len());
        for k in 0..self.nodes.len() as u32 {
            for (column, block) in self.near.couplings(k as usize).take_while(|(column, _)| *column <= k) {
                for (a, b) in [(0, 0), (1, 0), (0, 1), (1, 1)].into_iter().filter(|(a, b)| column < k || a >= b) {
                    entries.push(Triplet::new(2 * k + a, 2 * column + b, block[a as usize][b as usize]));
                }
            }
        }
        entries
    }

    /// Adds a block to row `k`, which shares its blocks with none. Its inverse is that of before until [`StoredRows::invert`].
    ///
    /// # Panics
    /// If the row has no such column.
    #[inline]
    pub fn add(&mut self, k: usize, column: BlockColumn, block: &Block) {
        self.add_at(self.block_place(k, column), block);
    }

    /// The place of a block of row `k`; it holds until rows are shared or kept.
    ///
    /// # Panics
    /// If the row has no such column.
    #[inline]
    pub fn block_place(&self, k: usize, column: BlockColumn) -> BlockPlace {
        match column {
            BlockColumn::Near(column) => BlockPlace(self.near.at(k, column) as u32),
            BlockColumn::Far(column) => BlockPlace((self.near.count() + self.far.at(k, column)) as u32),
        }
    }

    /// As [`StoredRows::add`], where the place is known.
    ///
    /// # Panics
    /// If copies have the block in common.
    #[inline]
    pub fn add_at(&mut self, BlockPlace(place): BlockPlace, block: &Block) {
        let (place, near) = (place as usize, self.near.count());
        let sum = match place.checked_sub(near) {
            None => &mut self.near.blocks[place - self.near.kept.len()],
            Some(place) => &mut self.far.blocks[place - self.far.kept.len()],
        };
        add(sum, block);
    }

    /// Whether row `k` has columns of other ranks.
    pub fn needs_far(&self, k: usize) -> bool {
        !self.far.row(k).is_empty()
    }

    /// The row of a node, if it is stored; the node is counted from this rank's first.
    pub fn place(&self, node: usize) -> Option<usize> {
        place(&self.nodes, node)
    }

    /// Inverts the diagonal block of row `k`.
    ///
    /// # Panics
    /// If it has no inverse: that of a stiffness has one.
    #[inline]
    pub fn invert(&mut self, k: usize) {
        let inverse = inverse(self.diagonal(k)).expect("a stiffness has a diagonal");
        self.inverses[self.inverse_of[k] as usize] = inverse;
    }

    /// The diagonal block of row `k`.
    pub fn diagonal(&self, k: usize) -> &Block {
        &self.near.blocks_of(k)[self.near.at(k, self.nodes[k]) - self.near.firsts[k] as usize]
    }

    /// Largest sum of magnitudes in a row that has blocks.
    pub fn norm_infinity(&self) -> f64 {
        let of_row = |k: usize, a: usize| -> f64 {
            self.near.couplings(k).chain(self.far.couplings(k)).map(|(_, block)| block[a][0].abs() + block[a][1].abs()).sum()
        };
        (0..self.nodes.len()).filter(|&k| self.is_stored(k)).map(|k| of_row(k, 0).max(of_row(k, 1))).fold(0.0, f64::max)
    }

    /// Blocks in all rows.
    pub fn block_count(&self) -> usize {
        let count = |part: &Part| (0..self.nodes.len()).filter(|&k| self.is_stored(k)).map(|k| part.row(k).len()).sum::<usize>();
        count(&self.near) + count(&self.far)
    }
}

/// Place of a node among ascending ones.
#[inline]
pub fn place(nodes: &[u32], node: usize) -> Option<usize> {
    let is_it = |at: &usize| nodes.get(*at) == Some(&(node as u32));
    // Where none is missing before it, its place is its number.
    Some(node).filter(is_it).or_else(|| nodes.binary_search(&(node as u32)).ok())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_of_zeros_share_nothing_with_rows_that_keep_their_own() {
        let zero = [[0.0; 2]; 2];
        // No coupling, two that contact will add to, and one.
        let mut part = Part {
            starts: vec![0, 0, 2, 3],
            columns: vec![0, 1, 0],
            firsts: vec![0, 0, 2],
            kept: Rc::default(),
            blocks: vec![zero; 3],
        };
        part.share(&[false, true, false]);
        let [_, kept, other] = [0, 1, 2].map(|k| part.firsts[k] as usize);
        assert!(other >= kept + 2 || other < kept, "the row from {other} on lies in the one from {kept} on");
        assert_eq!(part.blocks.len(), 3);
    }
}
