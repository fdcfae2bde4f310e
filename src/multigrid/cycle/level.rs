//! One level of the cycle: its rows, its vectors, and the way to the next coarser level.

use super::conjugate_steps::ConjugateSteps;
use crate::multigrid::interpolation::{InterpolationRoom, NodeInterpolation};
use crate::multigrid::stiffness::{LatticeOperator, SweepHalves, SweepRows};
use crate::petsc::Session;
use std::rc::Rc;

/// A level with the vectors of the cycle. A rank may have no nodes of it.
pub struct CycleLevel {
    /// Its rows.
    pub lattice: Rc<LatticeOperator>,
    /// Interpolation from the next coarser level.
    step: Rc<NodeInterpolation>,
    /// Its rows as sweeps read them, where all are stored.
    sweep_rows: Option<SweepRows>,
    /// What smooths in the place of one sweep, if anything does.
    steps: Option<ConjugateSteps>,
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
    /// With the interpolation from the next coarser level; smoothed by a sweep, or by so many steps of CG.
    pub fn new(lattice: Rc<LatticeOperator>, step: Rc<NodeInterpolation>, steps: usize, session: &Session) -> Self {
        let sweep_rows = lattice.sweep_rows();
        let is_fused = sweep_rows.is_none() && step.is_of(lattice.even.triangles.iter().map(|of| of.inner.clone()));
        let (nodes, far) = (lattice.node_count(), vec![[0.0; 2]; lattice.far.len()]);
        let (b, x, room) = (Vec::new(), Vec::new(), InterpolationRoom::default());
        let steps = (steps > 0).then(|| ConjugateSteps::new(steps, nodes, session));
        Self { lattice, step, sweep_rows, steps, is_fused, b, x, far, room, nodes }
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
            rows.refresh(&self.lattice.rows.borrow(), changed.into_iter().map(|k| k as usize));
        }
    }

    /// The residual `b - K x` behind a sweep of these `b` and `x`. **Collective**
    fn residual(&mut self, b: &[[f64; 2]], x: &[[f64; 2]], r: &mut [[f64; 2]]) {
        let Self { lattice, far, sweep_rows, .. } = self;
        let Some(rows) = sweep_rows else { return lattice.residual(b, x, r) };
        lattice.halo.fetch(x, far, || ());
        rows.residual(&lattice.rows.borrow(), b, x, far, r);
    }

    /// Restricts the residual `b - K x` behind a sweep of these `b` and `x` to the next coarser level; `r` has room for it.
    /// **Collective**
    pub fn restrict_residual(&mut self, b: &[[f64; 2]], x: &[[f64; 2]], r: &mut [[f64; 2]], below: &mut [[f64; 2]]) {
        let r = &mut r[..self.nodes];
        if let Some(steps) = &self.steps {
            return self.step.restrict(&steps.r, below, &mut self.room);
        }
        if !self.is_fused {
            self.residual(b, x, r);
            return self.restrict(r, below);
        }
        let Self { lattice, far, step, room, .. } = self;
        let stored = lattice.rows.borrow();
        let even = &lattice.even;
        lattice.halo.fetch(x, far, || ());
        stored.residual(0..stored.nodes.len(), b, x, far, r);
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

    /// A Gauss-Seidel sweep over the nodes here, symmetric where all rows are stored; those of other ranks stay as they are. Or steps
    /// of CG. **Collective**
    pub fn relax(&mut self, sweep: SweepHalves, b: &[[f64; 2]], x: &mut [[f64; 2]]) {
        if self.steps.is_some() {
            return self.smooth(false, b, x);
        }
        let Self { lattice, far, sweep_rows, .. } = self;
        let Some(rows) = sweep_rows else { return lattice.relax(sweep, b, x) };
        lattice.halo.fetch(x, far, || ());
        rows.relax(&lattice.rows.borrow(), b, x, far);
    }

    /// The forward half of a sweep from zero, whatever `x` holds. Or steps of CG. **Collective**
    pub fn relax_from_zero(&mut self, b: &[[f64; 2]], x: &mut [[f64; 2]]) {
        if self.steps.is_some() {
            return self.smooth(true, b, x);
        }
        let stored = self.lattice.rows.borrow();
        match &mut self.sweep_rows {
            Some(rows) => rows.relax_from_zero(&stored, b, x),
            None => self.lattice.lattice_rows(&stored).relax_from_zero(b, x),
        }
    }

    /// Steps of CG. **Collective**
    fn smooth(&mut self, from_zero: bool, b: &[[f64; 2]], x: &mut [[f64; 2]]) {
        // With steps of CG nothing else writes `far`: zeros.
        let Self { lattice, steps: Some(steps), far, sweep_rows, .. } = self else { return };
        let sweep = |r: &[[f64; 2]], z: &mut [[f64; 2]]| {
            let stored = lattice.rows.borrow();
            z.fill([0.0; 2]);
            match sweep_rows {
                Some(rows) => rows.relax(&stored, r, z, far),
                None => {
                    let rows = lattice.lattice_rows(&stored);
                    rows.begin_to_relax(r, z);
                    rows.end_to_relax(SweepHalves::Both, r, z, &[]);
                }
            }
        };
        steps.smooth(lattice, from_zero, sweep, b, x);
    }
}
