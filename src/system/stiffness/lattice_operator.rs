//! The stiffness of a level, its rows stored or in strips: what PETSc's solvers see of it.

use super::ContactNeighbours;
use super::stored_rows::{BlockColumn, StoredRows};
use super::strips::{Stencil, StripNodes};
use crate::element::Block;
use crate::petsc::{Gather, Operator, Result, Session, Vector};
use crate::system::space::Components;
use std::cell::{Cell, RefCell};
use std::ops::Range;
use std::rc::Rc;

/// Strips of this rank, with what they have in common.
#[derive(Default)]
pub struct Strips {
    /// Couplings; few strips have their own.
    pub stencils: Vec<Box<dyn Stencil>>,
    /// The nodes of each strip, and which stencil it has.
    pub nodes: Vec<(StripNodes, usize)>,
}

/// Stored rows and strips together.
pub struct LatticeOperator {
    /// The nodes of this rank.
    pub(in crate::system) own: Range<usize>,
    pub(in crate::system) strips: Rc<Strips>,
    pub(in crate::system) rows: RefCell<StoredRows>,
    /// Columns of other ranks, ascending.
    pub(in crate::system) far: Vec<usize>,
    /// Couplings of all nodes in strips.
    in_strips: f64,
    /// What fetches the values of the columns of other ranks; nothing on one rank.
    gather: Option<RefCell<Gather>>,
}

impl LatticeOperator {
    /// From the stored rows and the others; `far` are the columns of other ranks. **Collective**
    pub fn new(rows: StoredRows, own: &Range<usize>, far: Vec<usize>, strips: &Rc<Strips>, session: &Session) -> Result<Self> {
        let gather = match session.size() {
            1 => None,
            _ => {
                let wanted: Vec<i32> = far.iter().flat_map(|&node| [2 * node as i32, 2 * node as i32 + 1]).collect();
                Some(RefCell::new(Gather::new(&Vector::new(session, 2 * own.len())?, &wanted)?))
            }
        };
        let couplings = |&(nodes, stencil): &(StripNodes, usize)| {
            let [even, odd] = strips.stencils[stencil].couplings(nodes.width).map(|kind| kind.len());
            0.5 * (nodes.count * (even + odd)) as f64
        };
        let in_strips = strips.nodes.iter().map(couplings).sum();
        Ok(Self { own: own.clone(), strips: strips.clone(), rows: RefCell::new(rows), far, in_strips, gather })
    }

    /// A copy with places for the couplings of a contact boundary; the strips are the same. **Collective**
    pub fn with_places(&self, contact: &ContactNeighbours, session: &Session) -> Result<Self> {
        let (rows, far) = self.rows.borrow().with_places(contact, &self.own, &self.far);
        Self::new(rows, &self.own, far, &self.strips, session)
    }

    /// Adds a block to the couplings of two nodes, the row being one of this rank's. Holds after
    /// [`LatticeOperator::assemble`].
    ///
    /// # Panics
    /// If there is no place for it: rows of contact have places.
    pub fn add_block(&self, row: usize, column: usize, block: &Block) {
        let mut rows = self.rows.borrow_mut();
        let k = rows.place(row - self.own.start).expect("rows of contact are stored");
        rows.add(k, BlockColumn::of(column, &self.own, &self.far), block);
    }

    /// Makes blocks hold that were added to the rows of these nodes.
    pub fn assemble(&self, changed: impl Iterator<Item = usize>) {
        let mut rows = self.rows.borrow_mut();
        for row in changed {
            let k = rows.place(row - self.own.start).expect("rows of contact are stored");
            rows.invert(k);
        }
    }

    /// Shows the rows of all nodes in strips: couplings as distances in node numbers.
    pub fn each_row(&self, mut show: impl FnMut(usize, &[(isize, Block)])) {
        for (nodes, stencil) in self.each_strip() {
            let kinds = stencil.couplings(nodes.width);
            (0..nodes.count).for_each(|k| show(nodes.first + k, &kinds[k % 2]));
        }
    }

    fn each_strip(&self) -> impl DoubleEndedIterator<Item = (StripNodes, &dyn Stencil)> {
        self.strips.nodes.iter().map(|&(nodes, stencil)| (nodes, self.strips.stencils[stencil].as_ref()))
    }

    /// Calls `with` with the values of other ranks' nodes that the stored rows want. **Collective**
    fn with_far<T>(&self, x: &Vector, with: impl FnOnce(&[Components]) -> T) -> Result<T> {
        Ok(match &self.gather {
            Some(gather) => with(gather.borrow_mut().read(x)?.as_chunks().0),
            None => with(&[]),
        })
    }
}

impl Operator for Rc<LatticeOperator> {
    fn multiply(&self, x: &Vector, y: &mut Vector) -> Result<()> {
        self.with_far(x, |far| {
            let (x, mut y) = (x.values(), y.values_mut());
            let (x, y) = (x.as_chunks().0, y.as_chunks_mut().0);
            self.rows.borrow().multiply(x, far, y);
            self.each_strip().for_each(|(nodes, stencil)| stencil.multiply(nodes, x, &mut y[nodes.range()]));
        })
    }

    fn residual(&self, b: &Vector, x: &Vector, r: &mut Vector) -> Result<()> {
        self.with_far(x, |far| {
            let (b, x, mut r) = (b.values(), x.values(), r.values_mut());
            let (b, x, r) = (b.as_chunks().0, x.as_chunks().0, r.as_chunks_mut().0);
            self.rows.borrow().residual(b, x, far, r);
            self.each_strip().for_each(|(nodes, stencil)| stencil.residual(nodes, &b[nodes.range()], x, &mut r[nodes.range()]));
        })
    }

    fn relax(&self, b: &Vector, x: &mut Vector, from_zero: bool) -> Result<()> {
        let sweep = |far: &[Components], b: &Vector, x: &mut Vector| {
            let (b, mut x) = (b.values(), x.values_mut());
            let (b, x) = (b.as_chunks().0, Cell::from_mut(x.as_chunks_mut().0).as_slice_of_cells());
            let rows = self.rows.borrow();
            rows.forward(b, x, far);
            self.each_strip().for_each(|(nodes, stencil)| stencil.forward(nodes, &b[nodes.range()], x));
            self.each_strip().rev().for_each(|(nodes, stencil)| stencil.backward(nodes, &b[nodes.range()], x));
            rows.backward(b, x, far);
        };
        if from_zero {
            x.set(0.0)?;
            sweep(&[], b, x);
            return Ok(());
        }
        match &self.gather {
            Some(gather) => sweep(gather.borrow_mut().read(x)?.as_chunks().0, b, x),
            None => sweep(&[], b, x),
        }
        Ok(())
    }

    fn diagonal(&self, diagonal: &mut Vector) -> Result<()> {
        let mut values = diagonal.values_mut();
        let pairs = values.as_chunks_mut::<2>().0;
        let rows = self.rows.borrow();
        for (k, &node) in rows.nodes.iter().enumerate() {
            let block = rows.diagonal(k);
            pairs[node as usize] = [block[0][0], block[1][1]];
        }
        self.each_row(|node, couplings| pairs[node] = [couplings[0].1[0][0], couplings[0].1[1][1]]);
        Ok(())
    }

    fn norm_infinity(&self) -> Result<f64> {
        let stored = self.rows.borrow().norm_infinity();
        Ok(self.strips.stencils.iter().map(|stencil| stencil.norm_infinity()).fold(stored, f64::max))
    }

    fn work(&self) -> f64 {
        8.0 * (self.rows.borrow().block_count() as f64 + self.in_strips)
    }
}
