//! The multigrid F-cycle of mezha's own, in double or single precision: it works on strips and stored rows directly, and
//! on nothing of PETSc's but the factor of the coarsest level.
//!
//! Levels with few unknowns are brought together on every rank by one sum, and each rank goes on with them for itself: below
//! there are no messages. Where options of the user's ask for another smoother, cycle or coarse solver, and where solves
//! fall back on stronger smoothers, PETSc's own multigrid stands in its place ([`super::solver`]).

mod coarsest;
mod level;

use super::SystemError;
use super::interpolation::{GATHERED, Interpolation, NodeInterpolation};
use super::stiffness::{Precision, Stiffness};
use crate::petsc::{Action, Datum, Result, Session, Vector};
use coarsest::Coarsest;
use level::Level;
use std::cell::RefCell;
use std::rc::Rc;

/// Full multigrid: on each level, from the coarsest one up, a V-cycle with one symmetric Gauss-Seidel sweep before and one
/// after the coarse correction, from what the coarser level has found.
pub struct FullCycle<T> {
    coarsest: Coarsest,
    /// The coarsest first; that one has no sweeps.
    levels: Vec<Level<T>>,
    session: Session,
}

impl<T: Precision + Datum> FullCycle<T> {
    /// On the levels of a stiffness; `None` if some are not made of strips and stored rows, or there is but one.
    /// **Collective**
    pub fn new(
        stiffness: &[Stiffness],
        interpolations: &[Interpolation],
        session: &Session,
    ) -> std::result::Result<Option<Self>, SystemError> {
        let rows: Vec<_> = stiffness.iter().map(|stiffness| stiffness.lattice().clone()).collect();
        let steps: Option<Vec<Rc<NodeInterpolation>>> = interpolations.iter().map(|step| step.nodes.clone()).collect();
        let Some(steps) = steps else { return Ok(None) };
        if rows.len() < 2 || steps.len() + 1 != rows.len() {
            return Ok(None);
        }
        let coarsest = Coarsest::new(&rows[0], session)?;
        let steps = std::iter::once(None).chain(steps.into_iter().map(Some));
        let gathered: Vec<bool> =
            rows.iter().map(|rows| 2 * session.gather_counts(rows.node_count()).iter().sum::<usize>() <= GATHERED).collect();
        let below = |l: usize| gathered[l.saturating_sub(1)];
        let levels = rows.into_iter().zip(steps).enumerate();
        let levels = levels.map(|(l, (rows, step))| Level::new(rows, step, [gathered[l], below(l)], session)).collect();
        Ok(Some(Self { coarsest, levels, session: session.clone() }))
    }

    /// Takes over the values of the stiffness, which have changed. **Collective**
    pub fn refresh(&mut self, session: &Session) -> std::result::Result<(), SystemError> {
        self.coarsest.refresh(&self.levels[0].lattice, session)?;
        self.levels.iter_mut().for_each(|level| level.refresh(session));
        Ok(())
    }

    /// `x = M⁻¹ b` for the nodes of this rank. **Collective**
    fn apply(&mut self, b: &[[f64; 2]], x: &mut [[f64; 2]]) -> Result<()> {
        let top = self.levels.len() - 1;
        self.levels[top].set(b, &self.session);
        for l in (1..=top).rev() {
            let (below, level) = self.levels.split_at_mut(l);
            level[0].restrict_right_hand_side(&mut below[l - 1]);
        }
        self.coarsest.solve(&mut self.levels[0])?;
        for l in 1..=top {
            let (below, level) = self.levels.split_at_mut(l);
            level[0].begin(&below[l - 1]);
            self.v_cycle(l, false)?;
        }
        self.levels[top].get(x);
        Ok(())
    }

    /// A V-cycle on level `l` and those below, from its `x` or from zero. **Collective**
    fn v_cycle(&mut self, l: usize, from_zero: bool) -> Result<()> {
        if l == 0 {
            return self.coarsest.solve(&mut self.levels[0]);
        }
        let (below, level) = self.levels.split_at_mut(l);
        level[0].relax(from_zero);
        level[0].restrict_residual(&mut below[l - 1]);
        self.v_cycle(l - 1, true)?;
        let (below, level) = self.levels.split_at_mut(l);
        level[0].correct(&below[l - 1]);
        level[0].relax(false);
        Ok(())
    }
}

/// The cycle as PETSc's preconditioner.
pub struct CycleAction<T>(pub Rc<RefCell<FullCycle<T>>>);

impl<T: Precision + Datum> Action for CycleAction<T> {
    fn apply(&self, x: &Vector, y: &mut Vector) -> Result<()> {
        let (b, mut x) = (x.values(), y.values_mut());
        self.0.borrow_mut().apply(b.as_chunks().0, x.as_chunks_mut().0)
    }
}
