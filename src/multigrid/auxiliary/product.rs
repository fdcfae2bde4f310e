//! The Galerkin product `Pᵀ A P` of stored rows, row by row of the coarse level.
//!
//! A rank multiplies the rows of its own fine nodes. What these add to coarse rows of other ranks is sent there, the same blocks each time: what
//! has arrived last is kept, so that after a change of some fine rows only the coarse rows above these are made again.

use super::level::Coarsening;
use crate::element::Block;
use crate::multigrid::stiffness::{LatticeOperator, Part, StoredRows};
use crate::petsc::{Result, Session};
use std::rc::Rc;

/// Added to the diagonal, relative to it. Two functions that reach the same single node of their body, and no other, are
/// multiples of each other: without the shift the operator would be singular, and a factor of it would meet a zero pivot.
const SHIFT: f64 = 1e-9;

/// No place.
const NONE: u32 = u32::MAX;

/// A list of entries for each of some nodes.
#[derive(Default)]
struct Lists<T> {
    starts: Vec<u32>,
    entries: Vec<T>,
}

impl<T: Copy + Default> Lists<T> {
    /// From pairs of a list and an entry, in the order of the pairs within each list.
    fn new(count: usize, pairs: impl Iterator<Item = (usize, T)> + Clone) -> Self {
        let mut starts = vec![0; count + 1];
        pairs.clone().for_each(|(list, _)| starts[list + 1] += 1);
        (0..count).for_each(|list| starts[list + 1] += starts[list]);
        let mut next = starts.clone();
        let mut entries = vec![T::default(); starts[count] as usize];
        pairs.for_each(|(list, entry)| {
            entries[next[list] as usize] = entry;
            next[list] += 1;
        });
        Self { starts, entries }
    }

    #[inline(always)]
    fn of(&self, list: usize) -> &[T] {
        &self.entries[self.starts[list] as usize..self.starts[list + 1] as usize]
    }
}

/// The interpolation `P` as the rows of a rank need it. Fine nodes are counted from the first one here, those of other ranks behind
/// these; coarse ones are counted among those that are *known*: that some of these fine nodes take values from.
struct Step {
    coarsening: Rc<Coarsening>,
    /// Numbers of the known coarse nodes, ascending.
    known: Vec<u32>,
    /// Known coarse nodes, with their values, by fine nodes.
    rows: Lists<(u32, f64)>,
    /// Fine nodes here, with the values there, by known coarse nodes.
    supports: Lists<(u32, f64)>,
    /// The frame of each fine node, none for those in the axes of the plane that move freely.
    frame_of: Vec<u32>,
    frames: Vec<Block>,
}

impl Step {
    fn new(fine: &LatticeOperator, coarsening: &Rc<Coarsening>) -> Self {
        let nodes: Vec<usize> = fine.own.clone().chain(fine.far.iter().copied()).collect();
        let mut place = vec![NONE; coarsening.coarse.all.len()];
        nodes.iter().flat_map(|&node| coarsening.row(node)).for_each(|(number, _)| place[number as usize] = 0);
        let known: Vec<u32> = (0..place.len() as u32).filter(|&number| place[number as usize] != NONE).collect();
        known.iter().enumerate().for_each(|(at, &number)| place[number as usize] = at as u32);
        let place = &place;
        let couplings = nodes.iter().enumerate().flat_map(|(at, &node)| {
            coarsening.row(node).map(move |(number, value)| (at, (place[number as usize], value)))
        });
        let rows = Lists::new(nodes.len(), couplings.clone());
        let here = couplings.take_while(|(at, _)| *at < fine.own.len()).map(|(at, (known, value))| (known as usize, (at as u32, value)));
        let supports = Lists::new(known.len(), here);
        let (mut frame_of, mut frames) = (vec![NONE; nodes.len()], Vec::new());
        for (at, &node) in nodes.iter().enumerate() {
            if let Some(frame) = coarsening.frame(node) {
                frame_of[at] = frames.len() as u32;
                frames.push(*frame);
            }
        }
        Self { coarsening: coarsening.clone(), known, rows, supports, frame_of, frames }
    }

    /// Known coarse nodes that the product has blocks of in the row of another one, ascending; `seen` has not seen this row.
    fn columns(&self, known: usize, fine: &StoredRows, own: usize, seen: &mut [u32]) -> Vec<u32> {
        let mut columns = Vec::new();
        for &(row, _) in self.supports.of(known) {
            for (column, _) in couplings(fine, row as usize, own) {
                for &(other, _) in self.rows.of(column) {
                    if seen[other as usize] != known as u32 {
                        seen[other as usize] = known as u32;
                        columns.push(other);
                    }
                }
            }
        }
        columns.sort_unstable();
        columns
    }

    /// Adds the products of the fine rows here to the row of a known coarse node, whose blocks have these places by known nodes.
    fn add_to_row(&self, known: usize, fine: &StoredRows, own: usize, place: &[u32], sums: &mut [Block]) {
        pulp::Arch::new().dispatch(
            #[inline(always)]
            || {
                for &(row, weight) in self.supports.of(known) {
                    for (column, block) in couplings(fine, row as usize, own) {
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

    /// `Fᵀ A F` of a coupling of two fine nodes with their frames.
    #[inline(always)]
    fn turned(&self, row: usize, column: usize, block: &Block) -> Block {
        let [of_row, of_column] = [row, column].map(|node| self.frame_of[node]);
        let mut block = *block;
        if of_column != NONE {
            let frame = self.frames[of_column as usize];
            block = block.map(|a| [0, 1].map(|k| a[0] * frame[0][k] + a[1] * frame[1][k]));
        }
        if of_row != NONE {
            let frame = self.frames[of_row as usize];
            block = [0, 1].map(|k| [0, 1].map(|b| frame[0][k] * block[0][b] + frame[1][k] * block[1][b]));
        }
        block
    }
}

/// The couplings of a stored row, the columns of other ranks behind the `own` ones of this rank.
#[inline(always)]
fn couplings(rows: &StoredRows, k: usize, own: usize) -> impl Iterator<Item = (usize, &Block)> {
    let far = rows.far.couplings(k).map(move |(column, block)| (own + column as usize, block));
    rows.near.couplings(k).map(|(column, block)| (column as usize, block)).chain(far)
}

/// A row of another rank, to which rows here add.
struct ForeignRow {
    known: u32,
    /// Known nodes of its blocks.
    columns: Vec<u32>,
    /// Its first block among all that are sent.
    first: usize,
}

/// How the product of a level is made, again and again.
pub struct GalerkinProduct {
    session: Session,
    step: Step,
    /// Coarse nodes here.
    own: std::ops::Range<usize>,
    /// Coarse nodes of other ranks that rows here couple to.
    far: Vec<usize>,
    foreign: Vec<ForeignRow>,
    /// What is sent to the owners of these rows, and the rank that each block goes to.
    sent: Vec<Block>,
    ranks: Vec<usize>,
    /// What has arrived, and by rows here: places in the row of blocks that have arrived.
    arrived: Vec<f64>,
    places: Lists<(u32, u32)>,
}

impl GalerkinProduct {
    /// Of a level all of whose rows are stored; with the product, whose pattern this is. **Collective**
    pub fn new(fine: &LatticeOperator, coarsening: &Rc<Coarsening>, session: &Session) -> Result<(Self, LatticeOperator)> {
        let (step, rows) = (Step::new(fine, coarsening), fine.rows().borrow());
        let (own, nodes) = (coarsening.coarse.own(session.rank()), fine.own.len());
        let mut pattern = vec![Vec::new(); own.len()];
        let (mut foreign, mut pairs, mut ranks) = (Vec::new(), Vec::new(), Vec::new());
        let mut seen = vec![NONE; step.known.len()];
        for known in (0..step.known.len()).filter(|&known| !step.supports.of(known).is_empty()) {
            let (number, columns) = (step.known[known], step.columns(known, &rows, nodes, &mut seen));
            let numbers = columns.iter().map(|&column| step.known[column as usize]);
            if own.contains(&(number as usize)) {
                pattern[number as usize - own.start] = numbers.collect();
                continue;
            }
            let first = ranks.len();
            numbers.for_each(|column| pairs.extend([number, column]));
            ranks.resize(first + columns.len(), coarsening.coarse.owner(number as usize));
            foreign.push(ForeignRow { known: known as u32, columns, first });
        }
        let arriving = session.send_to(&ranks, &pairs, 2);
        let arriving: Vec<(usize, u32)> = arriving.as_chunks().0.iter().map(|&[row, column]| (row as usize - own.start, column)).collect();
        arriving.iter().for_each(|&(row, column)| pattern[row].push(column));
        for columns in &mut pattern {
            columns.sort_unstable();
            columns.dedup();
        }
        let (product, far) = zeros(&pattern, &own);
        let place = |(at, (row, column)): (usize, &(usize, u32))| {
            let numbers = own.start as u32..own.end as u32;
            let place = match numbers.contains(column) {
                true => product.near.columns[product.near.row(*row)].partition_point(|&other| other < column - numbers.start),
                false => {
                    let behind = product.near.row(*row).len();
                    behind + product.far.columns[product.far.row(*row)].partition_point(|&other| far[other as usize] < *column as usize)
                }
            };
            (*row, (place as u32, at as u32))
        };
        let places = Lists::new(own.len(), arriving.iter().enumerate().map(place));
        let (sent, arrived) = (vec![[[0.0; 2]; 2]; ranks.len()], vec![0.0; 4 * arriving.len()]);
        let lattice = LatticeOperator::of_rows(product, &own, far.clone(), session)?;
        Ok((Self { session: session.clone(), step, own, far, foreign, sent, ranks, arrived, places }, lattice))
    }

    /// Makes those rows of the product again that some rows of the level above have a part in; which ones. **Collective**
    pub fn refresh(&mut self, fine: &LatticeOperator, changed: impl Iterator<Item = u32>, product: &LatticeOperator) -> Vec<u32> {
        let (rows, nodes) = (fine.rows().borrow(), fine.own.len());
        let (step, own) = (&self.step, &self.own);
        let mut is_changed = vec![false; step.known.len()];
        changed.flat_map(|row| step.rows.of(row as usize)).for_each(|&(known, _)| is_changed[known as usize] = true);
        let mut place = vec![NONE; step.known.len()];
        for ForeignRow { known, columns, first } in self.foreign.iter().filter(|row| is_changed[row.known as usize]) {
            columns.iter().enumerate().for_each(|(at, &column)| place[column as usize] = at as u32);
            let sums = &mut self.sent[*first..][..columns.len()];
            sums.fill([[0.0; 2]; 2]);
            step.add_to_row(*known as usize, &rows, nodes, &place, sums);
        }
        let mut known_of = vec![NONE; own.len()];
        let here = |number: &u32| own.contains(&(*number as usize));
        let known_here = step.known.iter().enumerate().filter(|(_, number)| here(number));
        known_here.for_each(|(known, &number)| known_of[number as usize - own.start] = known as u32);
        let known_of_far: Vec<u32> =
            self.far.iter().map(|&number| step.known.binary_search(&(number as u32)).map_or(NONE, |known| known as u32)).collect();
        let arrived = match self.session.size() {
            1 => Vec::new(),
            _ => self.session.send_to(&self.ranks, self.sent.as_flattened().as_flattened(), 4),
        };
        let before = std::mem::replace(&mut self.arrived, arrived);
        let block = |values: &[f64], at: u32| values[4 * at as usize..][..4].to_vec();
        let mut made = Vec::new();
        let mut product = product.rows().borrow_mut();
        for k in 0..own.len() {
            let (known, arrived) = (known_of[k], self.places.of(k));
            let has_others = arrived.iter().any(|&(_, at)| block(&before, at) != block(&self.arrived, at));
            if !has_others && (known == NONE || !is_changed[known as usize]) {
                continue;
            }
            made.push(k as u32);
        }
        let mut sums = Vec::new();
        for &k in &made {
            let k = k as usize;
            let (near, far) = (product.near.row(k), product.far.row(k));
            sums.clear();
            sums.resize(near.len() + far.len(), [[0.0; 2]; 2]);
            let columns = product.near.columns[near].iter().map(|&column| known_of[column as usize]);
            let columns = columns.chain(product.far.columns[far].iter().map(|&column| known_of_far[column as usize]));
            if known_of[k] != NONE {
                for (at, column) in columns.enumerate().filter(|(_, column)| *column != NONE) {
                    place[column as usize] = at as u32;
                }
                step.add_to_row(known_of[k] as usize, &rows, nodes, &place, &mut sums);
            }
            for &(to, at) in self.places.of(k) {
                let values = &self.arrived[4 * at as usize..][..4];
                (0..4).for_each(|entry| sums[to as usize][entry / 2][entry % 2] += values[entry]);
            }
            self.close(k, &mut sums, &product);
            product.set_row(k, &sums);
        }
        made
    }

    /// Leaves components out that do not move, and shifts the diagonal.
    fn close(&self, k: usize, sums: &mut [Block], product: &StoredRows) {
        let is_free = |number: usize| self.step.coarsening.coarse.all[number].is_free;
        let (near, far) = (product.near.row(k), product.far.row(k));
        let count = near.len();
        let own = is_free(self.own.start + k);
        let diagonal = product.near.columns[near.clone()].partition_point(|&column| (column as usize) < k);
        let trace = sums[diagonal][0][0] + sums[diagonal][1][1];
        for (at, sum) in sums.iter_mut().enumerate() {
            let other = match at < count {
                true => self.own.start + product.near.columns[near.start + at] as usize,
                false => self.far[product.far.columns[far.start + at - count] as usize],
            };
            let other = is_free(other);
            for (a, b) in [(0, 0), (0, 1), (1, 0), (1, 1)].into_iter().filter(|&(a, b)| !own[a] || !other[b]) {
                sum[a][b] = 0.0;
            }
        }
        for (a, is_free) in own.into_iter().enumerate() {
            let entry = &mut sums[diagonal][a][a];
            *entry = if is_free { (1.0 + SHIFT) * *entry } else { trace };
        }
    }
}

/// Rows of zeros with these columns, and those columns of other ranks, ascending.
fn zeros(pattern: &[Vec<u32>], own: &std::ops::Range<usize>) -> (StoredRows, Vec<usize>) {
    let is_near = |column: &u32| own.contains(&(*column as usize));
    let mut far: Vec<u32> = pattern.iter().flatten().copied().filter(|column| !is_near(column)).collect();
    far.sort_unstable();
    far.dedup();
    let near = Part::zeros(pattern.iter().map(|columns| columns.iter().filter(|c| is_near(c)).map(|&c| c - own.start as u32)));
    let place = |column: &u32| far.binary_search(column).expect("it is among them") as u32;
    let others = Part::zeros(pattern.iter().map(|columns| columns.iter().filter(|c| !is_near(c)).map(place)));
    (StoredRows::zeros(near, others), far.into_iter().map(|column| column as usize).collect())
}
