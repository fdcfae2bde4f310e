//! The Galerkin product `Pᵀ A P` of stored rows, row by row of the coarse level.
//!
//! A rank multiplies the rows of its own fine nodes. What these add to coarse rows of other ranks is sent there, the same blocks each
//! time: what has arrived last is kept, so that after a change of some fine rows only the coarse rows above these are made again.

use super::known_step::{KnownStep, NONE};
use super::level::Coarsening;
use crate::element::Block;
use crate::mesh::{Lists, each_once};
use crate::multigrid::stiffness::{LatticeOperator, Part, StoredRows};
use crate::petsc::Session;
use std::ops::Range;
use std::rc::Rc;

/// Added to the diagonal, relative to it. Two functions that reach the same single node of their body, and no other, are
/// multiples of each other: without the shift the operator would be singular, and a factor of it would meet a zero pivot.
const SHIFT: f64 = 1e-9;

/// A row of another rank, to which rows here add.
struct ForeignRow {
    known: usize,
    /// Known nodes of its blocks.
    columns: Vec<u32>,
    /// Its first block among all that are sent.
    first: usize,
}

/// How the product of a level is made, again and again.
pub struct GalerkinProduct {
    session: Session,
    step: KnownStep,
    /// Coarse nodes here, and those of other ranks that rows here couple to.
    own: Range<usize>,
    far: Vec<usize>,
    /// The same among the known ones.
    known_here: Vec<u32>,
    known_far: Vec<u32>,
    foreign: Vec<ForeignRow>,
    /// What is sent to the owners of these rows, and the rank that each block goes to.
    sent: Vec<Block>,
    ranks: Vec<usize>,
    /// What has arrived, and by rows here: places in the row, with the blocks that belong there.
    arrived: Vec<f64>,
    places: Lists<(u32, u32)>,
}

impl GalerkinProduct {
    /// Of a level all of whose rows are stored; with room for the product, whose pattern this is. **Collective**
    pub fn new(fine: &LatticeOperator, coarsening: &Rc<Coarsening>, session: &Session) -> (Self, LatticeOperator) {
        let step = KnownStep::new(fine, coarsening);
        let own = coarsening.coarse.own(session.rank());
        let mut pattern = vec![Vec::new(); own.len()];
        let (mut foreign, mut pairs, mut ranks) = (Vec::new(), Vec::new(), Vec::new());
        let rows = step.columns(&fine.rows.borrow()).into_iter().enumerate();
        for (known, columns) in rows.filter(|(_, columns)| !columns.is_empty()) {
            let number = step.known[known];
            let numbers = columns.iter().map(|&column| step.known[column as usize]);
            if own.contains(&(number as usize)) {
                pattern[number as usize - own.start] = numbers.collect();
                continue;
            }
            let first = ranks.len();
            numbers.for_each(|column| pairs.extend([number, column]));
            ranks.resize(first + columns.len(), coarsening.coarse.owner(number as usize));
            foreign.push(ForeignRow { known, columns, first });
        }
        let pairs = session.send_to(&ranks, &pairs, 2);
        let arriving: Vec<(usize, u32)> =
            pairs.as_chunks().0.iter().map(|&[row, column]| (row as usize - own.start, column)).collect();
        arriving.iter().for_each(|&(row, column)| pattern[row].push(column));
        let pattern: Vec<Vec<u32>> = pattern.into_iter().map(each_once).collect();
        let (product, far) = zeros(&pattern, &own);
        let place =
            |(at, &(row, column)): (usize, &(usize, u32))| (row, (place_in_row(&product, row, column, &own, &far), at as u32));
        let places = Lists::new(own.len(), arriving.iter().enumerate().map(place));
        let known = |number: usize| step.known.binary_search(&(number as u32)).map_or(NONE, |known| known as u32);
        let (known_here, known_far) = (own.clone().map(known).collect(), far.iter().map(|&number| known(number)).collect());
        let (sent, arrived) = (vec![[[0.0; 2]; 2]; ranks.len()], vec![0.0; 4 * arriving.len()]);
        let lattice = LatticeOperator::of_product(product, &own, far.clone(), session);
        let session = session.clone();
        (Self { session, step, own, far, known_here, known_far, foreign, sent, ranks, arrived, places }, lattice)
    }

    /// Makes those rows of the product again that some rows of the level above have a part in; which ones. **Collective**
    pub fn refresh(&mut self, fine: &LatticeOperator, changed: impl Iterator<Item = u32>, product: &LatticeOperator) -> Vec<u32> {
        let (fine, mut product) = (fine.rows.borrow(), product.rows.borrow_mut());
        let (is_changed, mut place) = (self.step.above(changed), vec![NONE; self.step.known.len()]);
        for ForeignRow { known, columns, first } in self.foreign.iter().filter(|row| is_changed[row.known]) {
            columns.iter().zip(0..).for_each(|(&column, at)| place[column as usize] = at);
            let sums = &mut self.sent[*first..][..columns.len()];
            sums.fill([[0.0; 2]; 2]);
            self.step.add_to_row(*known, &fine, &place, sums);
        }
        let has_new = self.exchange();
        let is_above = |k: &usize| self.known_here[*k] != NONE && is_changed[self.known_here[*k] as usize];
        let made: Vec<usize> = (0..self.own.len()).filter(|k| has_new[*k] || is_above(k)).collect();
        let mut sums = Vec::new();
        for &k in &made {
            self.sum_row(k, &fine, &product, &mut place, &mut sums);
            self.close(k, &mut sums, &product);
            product.set_row(k, &sums);
        }
        made.into_iter().map(|k| k as u32).collect()
    }

    /// Sends what belongs to rows of other ranks; whether other blocks than before have arrived for each row here. **Collective**
    fn exchange(&mut self) -> Vec<bool> {
        if self.session.size() == 1 {
            return vec![false; self.own.len()];
        }
        let arrived = self.session.send_to(&self.ranks, self.sent.as_flattened().as_flattened(), 4);
        let before = std::mem::replace(&mut self.arrived, arrived);
        let is_new =
            |&(_, at): &(u32, u32)| before.as_chunks::<4>().0[at as usize] != self.arrived.as_chunks::<4>().0[at as usize];
        (0..self.own.len()).map(|k| self.places.of(k).iter().any(is_new)).collect()
    }

    /// The blocks of a row here: what rows of this rank add, then what has arrived.
    fn sum_row(&self, k: usize, fine: &StoredRows, product: &StoredRows, place: &mut [u32], sums: &mut Vec<Block>) {
        let [near, far] = [&product.near, &product.far].map(|part| &part.columns[part.row(k)]);
        sums.clear();
        sums.resize(near.len() + far.len(), [[0.0; 2]; 2]);
        if self.known_here[k] != NONE {
            let near = near.iter().map(|&column| self.known_here[column as usize]);
            let known = near.chain(far.iter().map(|&column| self.known_far[column as usize]));
            known.zip(0..).filter(|(known, _)| *known != NONE).for_each(|(known, at)| place[known as usize] = at);
            self.step.add_to_row(self.known_here[k] as usize, fine, place, sums);
        }
        for &(to, at) in self.places.of(k) {
            let block = self.arrived.as_chunks::<4>().0[at as usize];
            (0..4).for_each(|entry| sums[to as usize][entry / 2][entry % 2] += block[entry]);
        }
    }

    /// Leaves components out that do not move, and shifts the diagonal.
    fn close(&self, k: usize, sums: &mut [Block], product: &StoredRows) {
        let is_free = |number: usize| self.step.coarsening.coarse.all[number].is_free;
        let [near, far] = [&product.near, &product.far].map(|part| &part.columns[part.row(k)]);
        let own = is_free(self.own.start + k);
        let diagonal = near.partition_point(|&column| (column as usize) < k);
        let trace = sums[diagonal][0][0] + sums[diagonal][1][1];
        let near = near.iter().map(|&column| self.own.start + column as usize);
        let columns = near.chain(far.iter().map(|&column| self.far[column as usize]));
        for (sum, other) in sums.iter_mut().zip(columns.map(is_free)) {
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

/// The place of a coarse node among the columns of a row, those of other ranks behind those here.
fn place_in_row(rows: &StoredRows, row: usize, column: u32, own: &Range<usize>, far: &[usize]) -> u32 {
    let [near, others] = [&rows.near, &rows.far].map(|part| &part.columns[part.row(row)]);
    let place = match own.contains(&(column as usize)) {
        true => near.partition_point(|&other| other < column - own.start as u32),
        false => near.len() + others.partition_point(|&other| far[other as usize] < column as usize),
    };
    place as u32
}

/// Rows of zeros with these columns, and those columns of other ranks, ascending.
fn zeros(pattern: &[Vec<u32>], own: &Range<usize>) -> (StoredRows, Vec<usize>) {
    let is_near = |column: &u32| own.contains(&(*column as usize));
    let far = each_once(pattern.iter().flatten().copied().filter(|column| !is_near(column)));
    let near = Part::zeros(pattern.iter().map(|columns| columns.iter().filter(|c| is_near(c)).map(|&c| c - own.start as u32)));
    let place = |column: &u32| far.binary_search(column).expect("it is among them") as u32;
    let others = Part::zeros(pattern.iter().map(|columns| columns.iter().filter(|c| !is_near(c)).map(place)));
    (StoredRows::zeros(near, others), far.into_iter().map(|column| column as usize).collect())
}
