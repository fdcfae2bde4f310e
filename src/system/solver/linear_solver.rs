//! A linear solver that is ready for one system, and follows its changes.

use super::bordered::Bordered;
use super::fallback::Preconditioning;
use super::operators::{below, set_operators};
use crate::discretisation::{Form, SystemError};
use crate::multigrid::{Cycle, GalerkinLevels, Interpolation};
use crate::petsc::{self, Krylov, Matrix, ReplacedAction, Session};
use crate::system::choice::SolverChoice;
use crate::system::saddle_point::SaddlePoint;
use std::rc::Rc;

/// Unknowns of the displacement above which BiCGStab takes the place of GMRES: it has nine vectors instead of fifteen for
/// ten iterations, so that fewer are cleared and added. To 1e-8 that saves a tenth of a solve at a million unknowns. On smaller
/// systems it saves less, and GMRES may end after every cycle.
pub const MANY: usize = 500_000;

/// A solver, ready for one system.
pub struct LinearSolver {
    pub(super) krylov: Krylov,
    /// What does the work of PETSc's fieldsplit, where no option asks for more, or stands around its preconditioner.
    pub(super) _replaced: Option<ReplacedAction>,
    /// What knows of rigid motions that are eliminated, if there are any.
    pub(super) bordered: Option<Rc<Bordered>>,
    pub(super) session: Session,
    pub(super) form: Form,
    /// The converted system of the direct solver.
    pub(super) converted: Option<Matrix>,
    pub(super) interpolations: Rc<[Interpolation]>,
    pub(super) auxiliary: GalerkinLevels,
    /// The cycle, if it is mezha's own.
    pub(super) cycle: Option<Cycle>,
    /// Whether BiCGStab stands in the place of GMRES, to save memory and time. What it cannot solve GMRES gets.
    pub(super) is_short: bool,
    /// What preconditions the displacement block, from the next solve on.
    pub preconditioning: Preconditioning,
    /// The solver and its preconditioning, in words.
    pub name: String,
    /// Whether it is set up. A stronger one that a solve falls back on waits for the next solve: there may be none.
    pub(super) is_set_up: bool,
}

impl LinearSolver {
    /// Sets a solver up, with a preconditioning to begin with; `interpolations[l]` leads from level `l` to level `l + 1`,
    /// where auxiliary levels come before those of the system (the direct solver wants none). A system of one level is
    /// factorised.
    /// **Collective**
    pub fn new(
        system: &SaddlePoint,
        interpolations: &Rc<[Interpolation]>,
        choice: SolverChoice,
        preconditioning: Preconditioning,
        session: &Session,
    ) -> Result<Self, SystemError> {
        match choice.form() {
            Form::Augmented => Self::field_split(system, interpolations.clone(), preconditioning, MANY, session),
            Form::Plain => Self::direct(system, session),
        }
    }

    /// Takes over changed blocks. **Collective**
    pub fn refresh(&mut self, system: &SaddlePoint) -> Result<(), SystemError> {
        if let Some(bordered) = &self.bordered {
            bordered.forget();
        }
        if self.form == Form::Plain {
            let mut converted = system.nest.convert_aij()?;
            converted.set_symmetric(true)?;
            let product = if system.border.is_some() { &system.product } else { &converted };
            self.krylov.set_operators(product, &converted)?;
            self.converted = Some(converted);
        } else if !self.is_set_up {
            self.set_up(system)?;
        } else {
            self.auxiliary.refresh(system.stiffness[0].operator(), &below(&self.interpolations, system))?;
            if let Some(cycle) = &self.cycle {
                cycle.refresh(&self.session)?;
            }
            set_operators(&self.krylov, system, self.preconditioning, &self.session)?;
        }
        Ok(())
    }

    /// Sets the preconditioning up that a solve has fallen back on. **Collective**
    pub(super) fn set_up(&mut self, system: &SaddlePoint) -> Result<(), SystemError> {
        let many = if self.is_short { MANY } else { usize::MAX };
        let interpolations = self.interpolations.clone();
        *self = Self::field_split(system, interpolations, self.preconditioning, many, &self.session)?;
        Ok(())
    }

    /// Operators of the auxiliary levels, coarsest first.
    pub fn auxiliary_operators(&self) -> impl Iterator<Item = &Matrix> {
        self.auxiliary.iter()
    }

    /// Options that the user gave and no object of this solver has asked for.
    pub fn unused_options(&self) -> Result<Vec<String>, SystemError> {
        Ok(petsc::options::unused(&self.session)?)
    }
}
