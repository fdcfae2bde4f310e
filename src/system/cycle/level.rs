//! One level of the cycle: its rows, its vectors, and the way to the next coarser level.

use crate::petsc::{Datum, Halo, Session};
use crate::system::interpolation::{InterpolationRoom, NodeInterpolation};
use crate::system::stiffness::{EvenTriangles, LatticeOperator, LatticeRows, Precision, StoredRows, Strips, SweepHalves};
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
    /// Whether residuals inside of even macro triangles are restricted where they are made.
    is_fused: bool,
    /// Ranks whose sums come together on the next coarser level, which is on every rank; none if this one is, too.
    session: Option<Session>,
    /// Right-hand side and solution, but for the finest level, which works on those that it is given.
    pub b: Vec<[T; 2]>,
    pub x: Vec<[T; 2]>,
    far: Vec<[T; 2]>,
    room: InterpolationRoom<T>,
    /// Nodes that are here.
    pub nodes: usize,
}

/// The rows that are worked on.
enum LevelRows<T> {
    /// Those of this rank.
    Own { strips: Rc<Strips<T>>, even: Rc<EvenTriangles<T>>, stored: Rc<RefCell<StoredRows<T>>> },
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
            let (strips, even) = (T::strips(lattice.strips()), T::even(lattice.even()));
            let rows = LevelRows::Own { strips, even, stored: T::stored(lattice.rows()) };
            (rows, (!alone).then(|| lattice.halo().clone()), lattice.node_count(), lattice.far_count())
        };
        let is_of_rows = |step: &Rc<NodeInterpolation>| step.is_of(lattice.even().triangles.iter().map(|of| of.inner.clone()));
        let is_fused = matches!(rows, LevelRows::Own { .. }) && step.as_ref().is_some_and(is_of_rows);
        let session = (gathered[1] && !gathered[0] && !alone).then(|| session.clone());
        let (b, x, far) = (Vec::new(), Vec::new(), vec![[T::default(); 2]; far]);
        Self { lattice, rows, halo, step, is_fused, session, b, x, far, room: InterpolationRoom::default(), nodes }
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
        let Self { lattice, rows, halo, far, nodes, step, is_fused, session, room, .. } = self;
        let (r, step) = (&mut r[..*nodes], step.as_ref().expect("a way down"));
        match rows {
            LevelRows::All(rows) => {
                rows.residual(0..rows.nodes().len(), b, x, far, r);
                step.restrict(r, below, room);
            }
            LevelRows::Own { strips, even, stored } => {
                let stored = stored.borrow();
                let rows = LatticeRows { strips, even, stored: &*stored, order: lattice.order() };
                match halo {
                    Some(halo) => halo.fetch(x, far, || rows.residual_inside(!*is_fused, b, x, r)),
                    None => rows.residual_inside(!*is_fused, b, x, r),
                }
                if *is_fused {
                    stored.residual(0..stored.nodes().len(), b, x, far, r);
                    step.restrict_from(even.groups(), |k, own| even.residual_of(k, b, x, far, own), r, below, room);
                } else {
                    rows.residual_in_others(b, x, far, r);
                    step.restrict(r, below, room);
                }
            }
        }
        if let Some(session) = session {
            session.add_up(below.as_flattened_mut());
        }
    }

    /// Restricts forces to the next coarser level. **Collective**
    pub fn restrict(&mut self, fine: &[[T; 2]], below: &mut [[T; 2]]) {
        self.step.as_ref().expect("a way down").restrict(fine, below, &mut self.room);
        if let Some(session) = &self.session {
            session.add_up(below.as_flattened_mut());
        }
    }

    /// Takes what the next coarser level has found. **Collective**
    pub fn begin(&mut self, below: &[[T; 2]], x: &mut [[T; 2]]) {
        self.step.as_ref().expect("a way up").prolong::<T, false>(below, x, &mut self.room);
    }

    /// Adds what the next coarser level has found. **Collective**
    pub fn correct(&mut self, below: &[[T; 2]], x: &mut [[T; 2]]) {
        self.step.as_ref().expect("a way up").prolong::<T, true>(below, x, &mut self.room);
    }

    /// A Gauss-Seidel sweep over the nodes here, from `x` or from zero; those of other ranks stay as they are. **Collective**
    pub fn relax(&mut self, sweep: SweepHalves, b: &[[T; 2]], x: &mut [[T; 2]], from_zero: bool) {
        let Self { lattice, rows, halo, far, .. } = self;
        if from_zero {
            x.fill([T::default(); 2]);
        }
        match rows {
            LevelRows::All(rows) => {
                let all = 0..rows.nodes().len();
                rows.forward(all.clone(), b, x, &[]);
                if sweep == SweepHalves::Both {
                    rows.backward(all, b, x, &[]);
                }
            }
            LevelRows::Own { strips, even, stored } => {
                let rows = LatticeRows { strips, even, stored: &*stored.borrow(), order: lattice.order() };
                match halo.as_ref().filter(|_| !from_zero) {
                    Some(halo) => halo.fetch_before(x, far, |x| rows.begin_to_relax(b, x)),
                    None => rows.begin_to_relax(b, x),
                }
                rows.end_to_relax(sweep, b, x, if from_zero { &[] } else { far });
            }
        }
    }
}
