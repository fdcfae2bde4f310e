//! The multigrid F-cycle of mezha's own: it works on strips and stored rows directly, and
//! on nothing of PETSc's but what solves on the coarsest level.
//!
//! Levels with few unknowns have been brought together on fewer ranks, the small ones on one: from the first of these downwards
//! nothing is sent, unless there are auxiliary levels, and the other ranks wait. Where options of the user's ask for another
//! smoother, cycle or coarse solver, and where solves fall back on stronger smoothers, PETSc's own multigrid stands in its place
//! (`system/solver`).

mod coarsest;
mod level;

use crate::discretisation::SMALL;
use crate::discretisation::SystemError;
use crate::multigrid::interpolation::{Interpolation, NodeInterpolation};
use crate::multigrid::stiffness::{Stiffness, SweepHalves};
use crate::petsc::{Action, MultigridCycle, MultigridLevel, Result, Session, Vector};
use coarsest::Coarsest;
use level::CycleLevel;
use std::cell::RefCell;
use std::mem::take;
use std::rc::Rc;

/// Full multigrid: on each level, from the coarsest one up, a V-cycle with one Gauss-Seidel sweep before and one after the coarse
/// correction, from what the coarser level has found. Sweeps are symmetric; before the coarse corrections of levels below the
/// finest one they go forward alone where not all rows are stored, or from zero: that saves a quarter of the sweeps there and costs
/// one iteration in a hundred.
pub struct FullCycle {
    coarsest: Coarsest,
    /// Those that are swept, the coarsest first.
    levels: Vec<CycleLevel>,
    /// A residual, of one level at a time.
    r: Vec<[f64; 2]>,
}

impl FullCycle {
    /// On the levels of a stiffness; `levels` are those of PETSc's multigrid, with auxiliary ones below these. `None` if there is
    /// nothing to sweep, if options want entries of interpolations, or if the coarsest level is large and has no auxiliary ones.
    /// **Collective**
    fn new(
        stiffness: &[Stiffness],
        interpolations: &Rc<[Interpolation]>,
        levels: &[MultigridLevel],
        session: &Session,
    ) -> std::result::Result<Option<Self>, SystemError> {
        let rows: Vec<_> = stiffness.iter().map(|stiffness| stiffness.lattice().clone()).collect();
        let below = interpolations.len() + 1 - rows.len();
        let steps: Option<Vec<Rc<NodeInterpolation>>> = interpolations[below..].iter().map(|step| step.nodes.clone()).collect();
        let Some(steps) = steps.filter(|_| !interpolations.is_empty()) else { return Ok(None) };
        let steps = std::iter::once(None).chain(steps.into_iter().map(Some));
        let mut levels_of_rows = rows.into_iter().zip(steps);
        let coarsest = if below > 0 {
            Coarsest::auxiliary(&levels[..below], interpolations, session)?
        } else if interpolations[0].matrix.size().1 > SMALL {
            // So many bodies that no auxiliary level is smaller: PETSc's multigrid has a factor that all ranks make together.
            return Ok(None);
        } else {
            let (lattice, _) = levels_of_rows.next().expect("a coarsest level");
            Coarsest::factor(lattice, session)?
        };
        let mut levels: Vec<CycleLevel> = levels_of_rows.map(|(rows, step)| CycleLevel::new(rows, step, session)).collect();
        let most = levels.iter().map(|level| level.nodes).max();
        let last = levels.pop().expect("a level that is swept");
        levels = levels.into_iter().map(CycleLevel::with_vectors).collect();
        levels.push(last);
        Ok(Some(Self { coarsest, levels, r: vec![[0.0; 2]; most.unwrap_or(0)] }))
    }

    /// Takes over the values of the stiffness, which have changed. **Collective**
    fn refresh(&mut self, session: &Session) -> std::result::Result<(), SystemError> {
        self.levels.iter_mut().for_each(CycleLevel::refresh);
        Ok(self.coarsest.refresh(session)?)
    }

    /// `x = M⁻¹ b` for the nodes of this rank. **Collective**
    fn apply(&mut self, b: &[[f64; 2]], x: &mut [[f64; 2]]) -> Result<()> {
        let Self { coarsest, levels, r } = self;
        let top = levels.len() - 1;
        for l in (0..=top).rev() {
            let (below, level) = levels.split_at_mut(l);
            let own = take(&mut level[0].b);
            let forces = if l == top { b } else { &own };
            match below.last_mut() {
                Some(below) => level[0].restrict(forces, &mut below.b),
                None => coarsest.restrict(&mut level[0], forces)?,
            }
            level[0].b = own;
        }
        coarsest.solve(MultigridCycle::Full)?;
        for l in 0..top {
            let (b, mut x) = (take(&mut levels[l].b), take(&mut levels[l].x));
            begin(&mut levels[..=l], coarsest, SweepHalves::Forward, &b, &mut x, r)?;
            (levels[l].b, levels[l].x) = (b, x);
        }
        begin(levels, coarsest, SweepHalves::Both, b, x, r)
    }
}

/// A V-cycle from what the next coarser level has found. **Collective**
fn begin(
    levels: &mut [CycleLevel],
    coarsest: &mut Coarsest,
    before: SweepHalves,
    b: &[[f64; 2]],
    x: &mut [[f64; 2]],
    r: &mut [[f64; 2]],
) -> Result<()> {
    let (level, below) = levels.split_last_mut().expect("a level");
    match below.last() {
        Some(below) => level.begin(&below.x, x),
        None => coarsest.prolong::<false>(level, x)?,
    }
    level.relax(before, b, x);
    correct(levels, coarsest, b, x, r)
}

/// What follows the first sweep of a V-cycle on the last of these levels and those below. **Collective**
fn correct(
    levels: &mut [CycleLevel],
    coarsest: &mut Coarsest,
    b: &[[f64; 2]],
    x: &mut [[f64; 2]],
    r: &mut [[f64; 2]],
) -> Result<()> {
    let (level, below) = levels.split_last_mut().expect("a level");
    if below.is_empty() {
        coarsest.restrict_residual(level, [b, x], r)?;
        coarsest.solve(MultigridCycle::V)?;
        coarsest.prolong::<true>(level, x)?;
    } else {
        let last = below.len() - 1;
        level.restrict_residual(b, x, r, &mut below[last].b);
        let (next, mut correction) = (take(&mut below[last].b), take(&mut below[last].x));
        below[last].relax_from_zero(&next, &mut correction);
        correct(below, coarsest, &next, &mut correction, r)?;
        (below[last].b, below[last].x) = (next, correction);
        level.correct(&below[last].x, x);
    }
    level.relax(SweepHalves::Both, b, x);
    Ok(())
}

/// A cycle, shared with the preconditioner of PETSc's that it stands behind.
#[derive(Clone)]
pub struct Cycle(Rc<RefCell<FullCycle>>);

impl Cycle {
    /// On the levels of a system; `None` where there is no `FullCycle`. **Collective**
    pub fn new(
        stiffness: &[Stiffness],
        interpolations: &Rc<[Interpolation]>,
        levels: &[MultigridLevel],
        session: &Session,
    ) -> std::result::Result<Option<Self>, SystemError> {
        let cycle = FullCycle::new(stiffness, interpolations, levels, session)?;
        Ok(cycle.map(|cycle| Self(Rc::new(RefCell::new(cycle)))))
    }

    /// `x = M⁻¹ b` for the unknowns of this rank. **Collective**
    pub fn apply(&self, b: &[f64], x: &mut [f64]) -> Result<()> {
        self.0.borrow_mut().apply(b.as_chunks().0, x.as_chunks_mut().0)
    }

    /// What PETSc's preconditioner does.
    pub fn action(&self) -> Box<dyn Action> {
        Box::new(CycleAction(self.clone()))
    }

    /// Takes over the values of the stiffness, which have changed. **Collective**
    pub fn refresh(&self, session: &Session) -> std::result::Result<(), SystemError> {
        self.0.borrow_mut().refresh(session)
    }
}

/// The cycle as PETSc's preconditioner.
struct CycleAction(Cycle);

impl Action for CycleAction {
    fn apply(&self, x: &Vector, y: &mut Vector) -> Result<()> {
        self.0.apply(&x.values(), &mut y.values_mut())
    }
}
