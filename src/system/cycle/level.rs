//! One level of the cycle: its rows, its vectors, and the way to the next coarser level.

use crate::petsc::{Datum, Halo, Session};
use crate::system::interpolation::NodeInterpolation;
use crate::system::stiffness::{LatticeOperator, LatticeRows, Precision, StoredRows, Strips};
use std::cell::RefCell;
use std::rc::Rc;

/// A level with the vectors of the cycle. One with few unknowns is on every rank as a whole.
pub struct CycleLevel<T> {
    /// Where its values come from.
    pub lattice: Rc<LatticeOperator>,
    rows: LevelRows<T>,
    /// Brings values of other ranks; none where all nodes are here.
    halo: Option<Rc<Halo>>,
    /// Interpolation from the next coarser level.
    step: Option<Rc<NodeInterpolation>>,
    /// Ranks whose sums come together on the next coarser level, which is on every rank; none if this one is, too.
    session: Option<Session>,
    /// Right-hand side and solution, but for the finest level, which works on those that it is given.
    pub b: Vec<[T; 2]>,
    pub x: Vec<[T; 2]>,
    far: Vec<[T; 2]>,
    /// Nodes that are here.
    pub nodes: usize,
}

/// The rows that are worked on.
enum LevelRows<T> {
    /// Those of this rank.
    Own { strips: Rc<Strips<T>>, stored: Rc<RefCell<StoredRows<T>>> },
    /// Those of all ranks.
    All(Box<StoredRows<T>>),
}

impl<T: Precision + Datum> CycleLevel<T> {
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
            (LevelRows::All(Box::new(all.converted())), None, nodes, 0)
        } else {
            let rows = LevelRows::Own { strips: T::strips(lattice.strips()), stored: T::stored(lattice.rows()) };
            (rows, (!alone).then(|| lattice.halo().clone()), lattice.node_count(), lattice.far_count())
        };
        let session = (gathered[1] && !gathered[0] && !alone).then(|| session.clone());
        Self { lattice, rows, halo, step, session, b: Vec::new(), x: Vec::new(), far: vec![[T::default(); 2]; far], nodes }
    }

    /// Makes its vectors.
    pub fn with_vectors(mut self) -> Self {
        self.b = vec![[T::default(); 2]; self.nodes];
        self.x = self.b.clone();
        self
    }

    /// Takes over changed values. **Collective**
    pub fn refresh(&mut self, session: &Session) {
        match &mut self.rows {
            LevelRows::Own { stored, .. } => T::refresh(self.lattice.rows(), stored),
            LevelRows::All(rows) => **rows = self.lattice.gathered(session).converted(),
        }
    }

    /// Restricts the residual `b - K x` to the next coarser level; `r` has room for it. **Collective**
    pub fn restrict_residual(&mut self, b: &[[T; 2]], x: &[[T; 2]], r: &mut [[T; 2]], below: &mut [[T; 2]]) {
        let Self { lattice, rows, halo, far, nodes, .. } = self;
        let r = &mut r[..*nodes];
        match rows {
            LevelRows::All(rows) => rows.residual(0..rows.nodes().len(), b, x, far, r),
            LevelRows::Own { strips, stored } => {
                let stored = stored.borrow();
                let rows = LatticeRows { strips, stored: &*stored, order: lattice.order() };
                match halo {
                    Some(halo) => halo.fetch(x, far, || rows.residual_in_strips(b, x, r)),
                    None => rows.residual_in_strips(b, x, r),
                }
                stored.residual(0..stored.nodes().len(), b, x, far, r);
            }
        }
        self.restrict(r, below);
    }

    /// Restricts forces to the next coarser level. **Collective**
    pub fn restrict(&self, fine: &[[T; 2]], below: &mut [[T; 2]]) {
        self.step.as_ref().expect("a way down").restrict(fine, below);
        if let Some(session) = &self.session {
            session.add_up(below.as_flattened_mut());
        }
    }

    /// Adds what the next coarser level has found. **Collective**
    pub fn correct(&mut self, below: &[[T; 2]], x: &mut [[T; 2]]) {
        self.step.as_ref().expect("a way up").prolong(below, x);
    }

    /// A symmetric Gauss-Seidel sweep over the nodes here, from `x` or from zero; those of other ranks stay as they are.
    /// **Collective**
    pub fn relax(&mut self, b: &[[T; 2]], x: &mut [[T; 2]], from_zero: bool) {
        let Self { lattice, rows, halo, far, .. } = self;
        let mut elsewhere: &[[T; 2]] = &[];
        if from_zero {
            x.fill([T::default(); 2]);
        } else if let Some(halo) = halo {
            halo.fetch(x, far, || ());
            elsewhere = far;
        }
        match rows {
            LevelRows::All(rows) => {
                rows.forward(0..rows.nodes().len(), b, x, elsewhere);
                rows.backward(0..rows.nodes().len(), b, x, elsewhere);
            }
            LevelRows::Own { strips, stored } => {
                LatticeRows { strips, stored: &*stored.borrow(), order: lattice.order() }.relax(b, x, elsewhere);
            }
        }
    }
}
