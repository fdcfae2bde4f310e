//! One level of the cycle: its rows, its vectors, and the way to the next coarser level.

use crate::petsc::{Datum, Halo, Session};
use crate::system::interpolation::NodeInterpolation;
use crate::system::stiffness::{LatticeOperator, LatticeRows, Precision, StoredRows, Strips};
use std::cell::RefCell;
use std::ops::Range;
use std::rc::Rc;

/// A level with the vectors of the cycle. One with few unknowns is on every rank as a whole.
pub struct Level<T> {
    /// Where its values come from.
    pub lattice: Rc<LatticeOperator>,
    rows: Rows<T>,
    /// Brings values of other ranks; none where all nodes are here.
    halo: Option<Rc<Halo>>,
    /// Interpolation from the next coarser level.
    step: Option<Rc<NodeInterpolation>>,
    /// Ranks whose sums come together on the next coarser level, which is on every rank; none if this one is, too.
    session: Option<Session>,
    /// Right-hand side, solution, residual.
    pub b: Vec<[T; 2]>,
    pub x: Vec<[T; 2]>,
    r: Vec<[T; 2]>,
    far: Vec<[T; 2]>,
}

/// The rows that are worked on.
enum Rows<T> {
    /// Those of this rank.
    Own { strips: Rc<Strips<T>>, stored: Rc<RefCell<StoredRows<T>>> },
    /// Those of all ranks.
    All(StoredRows<T>),
}

impl<T: Precision + Datum> Level<T> {
    /// `gathered` says whether this level and the next coarser one are on every rank as a whole. **Collective**
    pub fn new(
        lattice: Rc<LatticeOperator>,
        step: Option<Rc<NodeInterpolation>>,
        gathered: [bool; 2],
        session: &Session,
    ) -> Self {
        let alone = session.size() == 1;
        let (rows, halo, nodes, far) = if gathered[0] && !alone {
            let all = lattice.gathered(session);
            let nodes = all.nodes().len();
            (Rows::All(all.converted()), None, nodes, 0)
        } else {
            let rows = Rows::Own { strips: T::strips(lattice.strips()), stored: T::stored(lattice.rows()) };
            (rows, (!alone).then(|| lattice.halo().clone()), lattice.node_count(), lattice.far_count())
        };
        let session = (gathered[1] && !gathered[0] && !alone).then(|| session.clone());
        let vector = |nodes: usize| vec![[T::default(); 2]; nodes];
        Self { lattice, rows, halo, step, session, b: vector(nodes), x: vector(nodes), r: vector(nodes), far: vector(far) }
    }

    /// Takes over changed values. **Collective**
    pub fn refresh(&mut self, session: &Session) {
        match &mut self.rows {
            Rows::Own { stored, .. } => T::refresh(self.lattice.rows(), stored),
            Rows::All(rows) => *rows = self.lattice.gathered(session).converted(),
        }
    }

    /// Sets the right-hand side, from that of this rank's nodes. **Collective**
    pub fn set(&mut self, b: &[[f64; 2]], session: &Session) {
        let own = self.own_nodes();
        self.b[own].iter_mut().zip(b).for_each(|(to, from)| *to = from.map(T::of));
        if let Rows::All(_) = self.rows {
            let others = self.lattice.own.clone();
            self.b[..others.start].fill([T::default(); 2]);
            self.b[others.end..].fill([T::default(); 2]);
            session.add_up(self.b.as_flattened_mut());
        }
    }

    /// Gives the solution at this rank's nodes.
    pub fn get(&self, x: &mut [[f64; 2]]) {
        x.iter_mut().zip(&self.x[self.own_nodes()]).for_each(|(to, from)| *to = from.map(T::double));
    }

    /// Places of this rank's nodes.
    fn own_nodes(&self) -> Range<usize> {
        match self.rows {
            Rows::Own { .. } => 0..self.x.len(),
            Rows::All(_) => self.lattice.own.clone(),
        }
    }

    /// The right-hand side of the next coarser level from this one's. **Collective**
    pub fn restrict_right_hand_side(&self, below: &mut Self) {
        self.restrict(&self.b, below);
    }

    /// The same from this one's residual. **Collective**
    pub fn restrict_residual(&mut self, below: &mut Self) {
        let Self { lattice, rows, halo, b, x, r, far, .. } = self;
        match rows {
            Rows::All(rows) => rows.residual(0..rows.nodes().len(), b, x, far, r),
            Rows::Own { strips, stored } => {
                let stored = stored.borrow();
                let rows = LatticeRows { strips, stored: &*stored, order: lattice.order() };
                match halo {
                    Some(halo) => halo.fetch(x, far, || rows.residual_in_strips(b, x, r)),
                    None => rows.residual_in_strips(b, x, r),
                }
                stored.residual(0..stored.nodes().len(), b, x, far, r);
            }
        }
        self.restrict(&self.r, below);
    }

    fn restrict(&self, fine: &[[T; 2]], below: &mut Self) {
        self.step().restrict(fine, &mut below.b);
        if let Some(session) = &self.session {
            session.add_up(below.b.as_flattened_mut());
        }
    }

    /// Begins with what the next coarser level has found. **Collective**
    pub fn begin(&mut self, below: &Self) {
        self.x.fill([T::default(); 2]);
        self.correct(below);
    }

    /// Adds what the next coarser level has found. **Collective**
    pub fn correct(&mut self, below: &Self) {
        let step = self.step.as_ref().expect("a way up");
        step.prolong(&below.x, &mut self.x);
    }

    /// A symmetric Gauss-Seidel sweep over the nodes here, from `x` or from zero; those of other ranks stay as they are.
    /// **Collective**
    pub fn relax(&mut self, from_zero: bool) {
        let Self { lattice, rows, halo, b, x, far, .. } = self;
        let mut elsewhere: &[[T; 2]] = &[];
        if from_zero {
            x.fill([T::default(); 2]);
        } else if let Some(halo) = halo {
            halo.fetch(x, far, || ());
            elsewhere = far;
        }
        match rows {
            Rows::All(rows) => {
                rows.forward(0..rows.nodes().len(), b, x, elsewhere);
                rows.backward(0..rows.nodes().len(), b, x, elsewhere);
            }
            Rows::Own { strips, stored } => {
                LatticeRows { strips, stored: &*stored.borrow(), order: lattice.order() }.relax(b, x, elsewhere);
            }
        }
    }

    fn step(&self) -> &NodeInterpolation {
        self.step.as_ref().expect("a way down")
    }
}
