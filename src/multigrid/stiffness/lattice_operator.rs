//! The stiffness of a level, its rows stored, or those of even macro triangles: what PETSc's solvers see of it.

use super::assembly::Assembled;
use super::couplings::Couplings;
use super::even_triangles::EvenTriangles;
use super::lattice_rows::LatticeRows;
use super::stored_rows::{BlockColumn, BlockPlace, StoredRows};
use super::straight_triangles::StraightTriangles;
use super::sweep_order::{SweepHalves, SweepOrder};
use super::sweep_rows::SweepRows;
use super::{ContactNeighbours, RowPlaces};
use crate::element::Block;
use crate::petsc::{Halo, Operator, Result, Session, Vector};
use std::cell::RefCell;
use std::ops::Range;
use std::rc::Rc;

/// Stored rows and even macro triangles together.
pub struct LatticeOperator {
    /// The nodes of this rank.
    pub(crate) own: Range<usize>,
    /// Inner nodes of each macro triangle whose inner rows are stored, ascending.
    inside: Rc<[Range<usize>]>,
    /// The even macro triangles.
    pub even: Rc<EvenTriangles>,
    /// Straight triangles whose nodes have no stored rows.
    straight: Rc<StraightTriangles>,
    /// The stored rows.
    pub rows: Rc<RefCell<StoredRows>>,
    /// Stored rows with other values since somebody took them, each perhaps several times.
    changed: RefCell<Vec<u32>>,
    /// Columns of other ranks, ascending.
    pub far: Vec<usize>,
    /// Couplings that are not stored.
    not_stored: f64,
    /// What brings the values of the columns of other ranks.
    pub halo: Rc<Halo>,
    order: SweepOrder,
    /// Whether it is a Galerkin product, of functions that may be nearly multiples of each other.
    is_product: bool,
}

impl LatticeOperator {
    /// From the rows of the nodes of this rank. **Collective**
    pub fn new(Assembled { rows, far, inside, even, straight }: Assembled, own: &Range<usize>, session: &Session) -> Self {
        let in_even = even.couplings.iter().zip(&even.triangles).map(|(couplings, triangle)| {
            let all: usize = couplings.iter().flat_map(|couplings| [0, 1].map(|k| couplings.of(k).len())).sum();
            (triangle.inner.len() * all) as f64 / (2 * couplings.len()) as f64
        });
        let not_stored = in_even.sum::<f64>() + straight.coupling_count() as f64;
        Self {
            order: SweepOrder::new(&rows, &inside),
            halo: Rc::new(Halo::new(session, own, &far)),
            rows: Rc::new(RefCell::new(rows)),
            own: own.clone(),
            inside,
            even,
            straight,
            changed: RefCell::default(),
            far,
            not_stored,
            is_product: false,
        }
    }

    /// Of the rows of a Galerkin product, those of all nodes of this rank. **Collective**
    pub fn of_product(rows: StoredRows, own: &Range<usize>, far: Vec<usize>, session: &Session) -> Self {
        let stored = Assembled { rows, far, inside: Rc::default(), even: Rc::default(), straight: Rc::default() };
        Self { is_product: true, ..Self::new(stored, own, session) }
    }

    /// A copy with places for the couplings of a contact boundary; even macro triangles are the same. **Collective**
    pub fn with_places(&self, contact: &ContactNeighbours, session: &Session) -> Self {
        let (rows, far) = self.rows.borrow().with_places(contact, &self.own, &self.far);
        let moved: Vec<u32> = self.far.iter().map(|node| far.binary_search(node).expect("it is among them") as u32).collect();
        let even = if far.len() == self.far.len() { self.even.clone() } else { Rc::new(self.even.moved(self.own.len(), &moved)) };
        let (inside, straight) = (self.inside.clone(), self.straight.clone());
        Self::new(Assembled { rows, far, inside, even, straight }, &self.own, session)
    }

    /// Shows where the couplings of a node, one of this rank's, with others lie, and gives its stored row.
    ///
    /// # Panics
    /// If there is no place for one: rows of contact have places.
    pub fn places(&self, row: usize, columns: impl Iterator<Item = usize>, mut show: impl FnMut(BlockPlace)) -> u32 {
        let rows = self.rows.borrow();
        let k = rows.place(row - self.own.start).expect("rows of contact are stored");
        columns.for_each(|column| show(rows.block_place(k, BlockColumn::of(column, &self.own, &self.far))));
        k as u32
    }

    /// Adds blocks to a row at their places, and inverts its diagonal block again if that is asked for.
    pub fn add_to_row(&self, places: RowPlaces, blocks: &[Block]) {
        let mut rows = self.rows.borrow_mut();
        for (place, block) in places.blocks.iter().zip(blocks) {
            rows.add_at(*place, block);
        }
        if places.is_last {
            rows.invert(places.stored as usize);
        }
        drop(rows);
        self.note_changed(std::iter::once(places.stored));
    }

    /// Takes note of stored rows with other values.
    pub fn note_changed(&self, rows: impl Iterator<Item = u32>) {
        let mut changed = self.changed.borrow_mut();
        changed.extend(rows);
        // Nobody takes those of a level that is not swept by rows of its own.
        if changed.len() > 2 * self.rows.borrow().nodes.len() {
            changed.sort_unstable();
            changed.dedup();
        }
    }

    /// The stored rows that have other values since they were taken last, ascending.
    pub fn changed_rows(&self) -> Vec<u32> {
        let mut changed = self.changed.borrow_mut();
        changed.sort_unstable();
        changed.dedup();
        changed.clone()
    }

    /// Takes them.
    pub fn take_changed_rows(&self) -> Vec<u32> {
        let changed = self.changed_rows();
        self.changed.borrow_mut().clear();
        changed
    }

    /// The rows as sweeps read them, if all of this rank's are stored.
    pub fn sweep_rows(&self) -> Option<SweepRows> {
        let rows = self.rows.borrow();
        if rows.nodes.len() < self.own.len() { None } else { SweepRows::new(&rows, &self.straight, !self.is_product) }
    }

    /// All rows: those of even macro triangles with the `stored` ones.
    pub fn lattice_rows<'a>(&'a self, stored: &'a StoredRows) -> LatticeRows<'a> {
        LatticeRows { even: &self.even, stored, order: &self.order }
    }

    /// Nodes of this rank.
    pub fn node_count(&self) -> usize {
        self.own.len()
    }

    /// Shows the couplings of rows that are not stored, in one part or several, with nodes by their numbers.
    pub fn each_row(&self, mut show: impl FnMut(usize, &[(usize, Block)])) {
        let mut row = Vec::new();
        let near = self.own.len();
        self.even.each_row(|node, couplings| {
            let number = |at: usize| if at < near { self.own.start + at } else { self.far[at - near] };
            row.clear();
            row.extend(couplings.iter().map(|&(at, block)| (number(at), block)));
            show(node, &row);
        });
        let number = |at: usize| self.own.start + at;
        self.straight.each_coupling(&self.rows.borrow(), |row, column, block| show(row, &[(number(column), block)]));
    }

    /// `r = b - K x`, where sweeps have no rows of their own. **Collective**
    pub fn residual(&self, b: &[[f64; 2]], x: &[[f64; 2]], r: &mut [[f64; 2]]) {
        assert!(self.straight.is_empty(), "sweeps have rows of their own");
        let (stored, mut far) = (self.rows.borrow(), vec![[0.0; 2]; self.far.len()]);
        self.halo.fetch(x, &mut far, || self.even.residual(true, b, x, &[], r));
        self.even.residual(false, b, x, &far, r);
        stored.residual(0..stored.nodes.len(), b, x, &far, r);
    }

    /// A Gauss-Seidel sweep over the nodes here, those of other ranks staying as they are. **Collective**
    pub fn relax(&self, sweep: SweepHalves, b: &[[f64; 2]], x: &mut [[f64; 2]]) {
        let (stored, mut far) = (self.rows.borrow(), vec![[0.0; 2]; self.far.len()]);
        let rows = self.lattice_rows(&stored);
        self.halo.fetch_before(x, &mut far, |x| rows.begin_to_relax(b, x));
        rows.end_to_relax(sweep, b, x, &far);
    }

    /// `y = K x`. **Collective**
    pub fn multiply(&self, x: &[[f64; 2]], y: &mut [[f64; 2]]) {
        let (stored, mut far) = (self.rows.borrow(), vec![[0.0; 2]; self.far.len()]);
        self.halo.fetch(x, &mut far, || {
            self.straight.multiply(x, y);
            self.even.multiply(true, x, &[], y);
        });
        self.even.multiply(false, x, &far, y);
        stored.multiply(0..stored.nodes.len(), x, &far, y);
    }
}

impl Operator for Rc<LatticeOperator> {
    fn multiply(&self, x: &Vector, y: &mut Vector) -> Result<()> {
        LatticeOperator::multiply(self, x.values().as_chunks().0, y.values_mut().as_chunks_mut().0);
        Ok(())
    }

    fn norm_infinity(&self) -> Result<f64> {
        let rows = self.rows.borrow();
        let mut sums = vec![[0.0; 2]; if self.straight.is_empty() { 0 } else { self.own.len() }];
        self.straight.each_coupling(&rows, |row, _, block| {
            (0..2).for_each(|a| sums[row][a] += block[a][0].abs() + block[a][1].abs());
        });
        let stored = sums.as_flattened().iter().copied().fold(rows.norm_infinity(), f64::max);
        let all = self.even.couplings.iter().flatten();
        Ok(all.map(Couplings::norm_infinity).fold(stored, f64::max))
    }

    fn work(&self) -> f64 {
        8.0 * (self.rows.borrow().block_count() as f64 + self.not_stored)
    }
}
