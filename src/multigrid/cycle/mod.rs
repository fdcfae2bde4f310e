//! The multigrid F-cycle of mezha's own: it works on even macro triangles and stored rows directly. The coarsest level has
//! a factor on one rank.
//!
//! Levels with few unknowns have been brought together on fewer ranks, the small ones on one: from the first of these downwards
//! nothing is sent, and the other ranks wait, unless there are rigid motions to be found, or steps of CG have sums of all ranks. Where
//! an option of the user's asks for another preconditioner, it is one of PETSc's on a matrix of all rows (`system/solver`).

mod border;
mod coarsest;
mod conjugate_steps;
mod level;
mod sparse_factor;

use crate::multigrid::interpolation::Interpolation;
use crate::multigrid::sparse::{add_multiple, sparse};
use crate::multigrid::stiffness::{LatticeOperator, SweepHalves};
use crate::petsc::{Action, Result, Session, Vector};
use border::LevelBorder;
pub use border::{Border, scaled_inverse};
use coarsest::Coarsest;
use level::CycleLevel;
use std::cell::RefCell;
use std::mem::take;
use std::rc::Rc;

/// Full multigrid: on each level, from the coarsest one up, a V-cycle with one Gauss-Seidel sweep before and one after the coarse
/// correction, from what the coarser level has found. Sweeps are symmetric; before the coarse corrections of levels below the
/// finest one they go forward alone where not all rows are stored, or from zero: that saves a quarter of the sweeps there and costs
/// one iteration in a hundred.
pub struct Cycle {
    session: Session,
    coarsest: Coarsest,
    /// Those that are swept, the coarsest first.
    levels: Vec<CycleLevel>,
    /// Unknowns beside the displacements, if there are any.
    border: Option<LevelBorder>,
    /// A residual, of one level at a time.
    r: Vec<[f64; 2]>,
}

impl Cycle {
    /// On the rows of levels, the coarsest first, with the interpolations between them; smoothed by a sweep, or by so many steps
    /// of CG. **Collective**
    pub fn new<'a>(
        mut levels: impl Iterator<Item = &'a Rc<LatticeOperator>>,
        interpolations: &[Interpolation],
        steps: usize,
        session: &Session,
    ) -> Result<Self> {
        let lowest = levels.next().expect("a coarsest level");
        let coarsest = Coarsest::new(lowest, session)?;
        let level = |(rows, step): (&Rc<LatticeOperator>, &Interpolation)| {
            CycleLevel::new(rows.clone(), step.nodes.clone(), steps, session)
        };
        let mut levels: Vec<CycleLevel> = levels.zip(interpolations).map(level).collect();
        let most = levels.iter().map(|level| level.nodes).max();
        let last = levels.pop().expect("a level that is swept");
        levels = levels.into_iter().map(CycleLevel::with_vectors).collect();
        levels.push(last);
        Ok(Self { session: session.clone(), coarsest, levels, border: None, r: vec![[0.0; 2]; most.unwrap_or(0)] })
    }

    /// Takes over the values of the stiffness, which have changed. **Collective**
    pub fn refresh(&mut self) -> Result<()> {
        self.levels.iter_mut().for_each(CycleLevel::refresh);
        self.coarsest.refresh(&self.session)
    }

    /// Takes over unknowns beside the displacements, for the present values of the stiffness. **Collective**
    pub fn set_border(&mut self, border: Border) {
        if border.columns.is_empty() {
            self.border = None;
            return;
        }
        let top = self.levels.len() - 1;
        let (mut lower, mut below, mut responses) = (vec![Vec::new(); top], Vec::new(), Vec::new());
        for column in &border.columns {
            let mut forces = take(&mut self.r);
            forces.fill([0.0; 2]);
            add_multiple(column, 1.0, forces.as_flattened_mut());
            self.restrict(&forces[..self.levels[top].nodes]);
            self.r = forces;
            lower.iter_mut().zip(&self.levels).for_each(|(columns, level)| columns.push(sparse(level.b.as_flattened())));
            below.push(sparse(self.coarsest.b.as_flattened()));
            self.coarsest.solve();
            responses.push(self.coarsest.x.as_flattened().to_vec());
        }
        self.border = Some(LevelBorder::new(border, lower, below, responses, &self.session));
    }

    /// Restricts forces to all levels below the finest one. **Collective**
    fn restrict(&mut self, forces: &[[f64; 2]]) {
        let Self { coarsest, levels, .. } = self;
        let top = levels.len() - 1;
        for l in (0..=top).rev() {
            let (below, level) = levels.split_at_mut(l);
            let own = take(&mut level[0].b);
            let forces = if l == top { forces } else { &own };
            level[0].restrict(forces, below.last_mut().map_or(&mut coarsest.b, |below| &mut below.b));
            level[0].b = own;
        }
    }

    /// `x` of `[x; p] = M⁻¹ [b; g]` for the unknowns of this rank, with the unknowns `p` of a border if there is one; without the
    /// border if `g` is empty. `b` is not what it was then. **Collective**
    pub fn apply(&mut self, b: &mut [f64], g: &[f64], x: &mut [f64]) {
        let (b, x) = (b.as_chunks_mut().0, x.as_chunks_mut().0);
        self.restrict(b);
        let Self { coarsest, levels, border, r, .. } = self;
        let top = levels.len() - 1;
        let mut descent = Descent { coarsest, border: border.as_ref().filter(|_| !g.is_empty()), r };
        let mut p = descent.solve_below(g);
        for l in 0..top {
            let (mut b, mut x) = (take(&mut levels[l].b), take(&mut levels[l].x));
            descent.begin(&mut levels[..=l], SweepHalves::Forward, (g, &mut p), &mut b, &mut x);
            (levels[l].b, levels[l].x) = (b, x);
        }
        descent.begin(levels, SweepHalves::Both, (g, &mut p), b, x);
    }
}

/// What V-cycles share, beside the levels.
struct Descent<'a> {
    coarsest: &'a mut Coarsest,
    border: Option<&'a LevelBorder>,
    r: &'a mut [[f64; 2]],
}

impl Descent<'_> {
    /// Solves on the coarsest level, with a right-hand side of the border; what was found of that. **Collective**
    fn solve_below(&mut self, g: &[f64]) -> Vec<f64> {
        self.coarsest.solve();
        self.border.map_or_else(Vec::new, |border| border.solve(g, self.coarsest.x.as_flattened_mut()))
    }

    /// A V-cycle from what the next coarser level has found. **Collective**
    fn begin(
        &mut self,
        levels: &mut [CycleLevel],
        before: SweepHalves,
        (g, p): (&[f64], &mut [f64]),
        b: &mut [[f64; 2]],
        x: &mut [[f64; 2]],
    ) {
        let (level, below) = levels.split_last_mut().expect("a level");
        level.begin(below.last().map_or(&self.coarsest.x, |below| &below.x), x);
        if let Some(border) = self.border {
            border.subtract(below.len(), p, b);
        }
        level.relax(before, b, x);
        let mut left = g.to_vec();
        self.border.iter().for_each(|border| border.subtract_corner(p, &mut left));
        let change = self.correct(levels, &left, b, x);
        p.iter_mut().zip(change).for_each(|(p, change)| *p += change);
    }

    /// What follows the first sweep of a V-cycle on the last of these levels and those below; what is found of the border.
    /// **Collective**
    fn correct(&mut self, levels: &mut [CycleLevel], g: &[f64], b: &mut [[f64; 2]], x: &mut [[f64; 2]]) -> Vec<f64> {
        let (level, below) = levels.split_last_mut().expect("a level");
        let left = self.border.map_or_else(Vec::new, |border| border.left(below.len(), g, x));
        let p = if below.is_empty() {
            level.restrict_residual(b, x, self.r, &mut self.coarsest.b);
            let p = self.solve_below(&left);
            level.correct(&self.coarsest.x, x);
            p
        } else {
            let last = below.len() - 1;
            level.restrict_residual(b, x, self.r, &mut below[last].b);
            let (mut next, mut correction) = (take(&mut below[last].b), take(&mut below[last].x));
            below[last].relax_from_zero(&next, &mut correction);
            let p = self.correct(below, &left, &mut next, &mut correction);
            (below[last].b, below[last].x) = (next, correction);
            level.correct(&below[last].x, x);
            p
        };
        if let Some(border) = self.border {
            border.subtract(below.len(), &p, b);
        }
        level.relax(SweepHalves::Both, b, x);
        p
    }
}

/// As PETSc's preconditioner.
impl Action for Rc<RefCell<Cycle>> {
    fn apply(&self, x: &Vector, y: &mut Vector) -> Result<()> {
        self.borrow_mut().apply(&mut x.values().to_vec(), &[], &mut y.values_mut());
        Ok(())
    }
}
