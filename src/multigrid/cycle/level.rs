//! One level of the cycle: its rows, its vectors, and the way to the next coarser level.

use crate::multigrid::interpolation::{InterpolationRoom, NodeInterpolation};
use crate::multigrid::stiffness::{LatticeOperator, SweepHalves, SweepRows};
use crate::petsc::{Halo, Session};
use std::rc::Rc;

/// A level with the vectors of the cycle. A rank may have no nodes of it.
pub struct CycleLevel {
    /// Its rows.
    pub lattice: Rc<LatticeOperator>,
    /// Brings values of other ranks; `None` on one rank.
    halo: Option<Rc<Halo>>,
    /// Interpolation from the next coarser level.
    step: Rc<NodeInterpolation>,
    /// Its rows as sweeps read them, where all are stored.
    sweep_rows: Option<SweepRows>,
    /// Whether residuals inside of even macro triangles are restricted where they are made.
    is_fused: bool,
    /// Right-hand side and solution, but for the finest level, which works on those that it is given.
    pub b: Vec<[f64; 2]>,
    pub x: Vec<[f64; 2]>,
    far: Vec<[f64; 2]>,
    room: InterpolationRoom,
    /// Nodes of this rank.
    pub nodes: usize,
}

impl CycleLevel {
    /// With the interpolation from the next coarser level.
    pub fn new(lattice: Rc<LatticeOperator>, step: Rc<NodeInterpolation>, session: &Session) -> Self {
        let halo = (session.size() > 1).then(|| lattice.halo().clone());
        let sweep_rows = lattice.sweep_rows();
        let is_fused = sweep_rows.is_none() && step.is_of(lattice.even().triangles.iter().map(|of| of.inner.clone()));
        let (nodes, far) = (lattice.node_count(), vec![[0.0; 2]; lattice.far_count()]);
        let (b, x, room) = (Vec::new(), Vec::new(), InterpolationRoom::default());
        Self { lattice, halo, step, sweep_rows, is_fused, b, x, far, room, nodes }
    }

    /// Makes the vectors of a level below the finest.
    pub fn with_vectors(mut self) -> Self {
        self.b = vec![[0.0; 2]; self.nodes];
        self.x = self.b.clone();
        self
    }

    /// Takes over the values of the rows, some of which have changed.
    pub fn refresh(&mut self) {
        let changed = self.lattice.take_changed_rows();
        if let Some(rows) = &mut self.sweep_rows {
            rows.refresh(&self.lattice.rows().borrow(), changed.into_iter().map(|k| k as usize));
        }
    }

    /// The residual `b - K x` behind a sweep of these `b` and `x`. **Collective**
    pub fn residual(&mut self, b: &[[f64; 2]], x: &[[f64; 2]], r: &mut [[f64; 2]]) {
        let Self { lattice, halo, far, sweep_rows, .. } = self;
        let stored = lattice.rows().borrow();
        let rows = lattice.lattice_rows(&stored);
        let inside = |r: &mut [[f64; 2]]| {
            if sweep_rows.is_none() {
                rows.residual_inside(true, b, x, r)
            }
        };
        match halo {
            Some(halo) => halo.fetch(x, far, || inside(r)),
            None => inside(r),
        }
        match sweep_rows {
            Some(sweep_rows) => sweep_rows.residual(&stored, b, x, far, r),
            None => rows.residual_in_others(b, x, far, r),
        }
    }

    /// Restricts the residual `b - K x` behind a sweep of these `b` and `x` to the next coarser level; `r` has room for it.
    /// **Collective**
    pub fn restrict_residual(&mut self, b: &[[f64; 2]], x: &[[f64; 2]], r: &mut [[f64; 2]], below: &mut [[f64; 2]]) {
        let r = &mut r[..self.nodes];
        if !self.is_fused {
            self.residual(b, x, r);
            return self.restrict(r, below);
        }
        let Self { lattice, halo, far, step, room, .. } = self;
        let stored = lattice.rows().borrow();
        let (even, rows) = (lattice.even(), lattice.lattice_rows(&stored));
        match halo {
            Some(halo) => halo.fetch(x, far, || rows.residual_inside(false, b, x, r)),
            None => rows.residual_inside(false, b, x, r),
        }
        stored.residual(0..stored.nodes().len(), b, x, far, r);
        step.restrict_from(even.groups(), |k, own| even.residual_of(k, b, x, far, own), r, below, room);
    }

    /// Restricts forces to the next coarser level. **Collective**
    pub fn restrict(&mut self, fine: &[[f64; 2]], below: &mut [[f64; 2]]) {
        self.step.restrict(fine, below, &mut self.room);
    }

    /// Takes what the next coarser level has found. **Collective**
    pub fn begin(&mut self, below: &[[f64; 2]], x: &mut [[f64; 2]]) {
        self.step.prolong::<false>(below, x, &mut self.room);
    }

    /// Adds what the next coarser level has found. **Collective**
    pub fn correct(&mut self, below: &[[f64; 2]], x: &mut [[f64; 2]]) {
        self.step.prolong::<true>(below, x, &mut self.room);
    }

    /// A Gauss-Seidel sweep over the nodes here, symmetric where all rows are stored; those of other ranks stay as they are.
    /// **Collective**
    pub fn relax(&mut self, sweep: SweepHalves, b: &[[f64; 2]], x: &mut [[f64; 2]]) {
        let Self { lattice, halo, far, sweep_rows, .. } = self;
        let stored = lattice.rows().borrow();
        if let Some(rows) = sweep_rows {
            if let Some(halo) = halo {
                halo.fetch(x, far, || ());
            }
            return rows.relax(&stored, b, x, far);
        }
        let rows = lattice.lattice_rows(&stored);
        match halo {
            Some(halo) => halo.fetch_before(x, far, |x| rows.begin_to_relax(b, x)),
            None => rows.begin_to_relax(b, x),
        }
        rows.end_to_relax(sweep, b, x, far);
    }

    /// The forward half of a sweep from zero, whatever `x` holds.
    pub fn relax_from_zero(&mut self, b: &[[f64; 2]], x: &mut [[f64; 2]]) {
        let stored = self.lattice.rows().borrow();
        match &mut self.sweep_rows {
            Some(rows) => rows.relax_from_zero(&stored, b, x),
            None => self.lattice.lattice_rows(&stored).relax_from_zero(b, x),
        }
    }
}
