//! A linear solver of one system, which follows its changes.

use super::direct::direct;
use super::field_split::{field_split, name};
use super::ladder::{DIRECT, Rung, climb, ladder};
use super::linear_solve::LinearSolve;
use super::options::chosen;
use super::preconditioning::Preconditioning;
use super::prepared::{Prepared, set_operators, set_plain_operators};
use crate::discretisation::{Form, SystemError};
use crate::multigrid::{Interpolation, LatticeOperator};
use crate::system::choice::SolverChoice;
use crate::system::saddle_point::SaddlePoint;
use std::rc::Rc;

/// A solver of one system.
pub struct LinearSolver {
    form: Form,
    interpolations: Rc<[Interpolation]>,
    /// The rung that it stands on, and those to come.
    rungs: Vec<Rung>,
    /// What the rung works with. One that a solve has just gone up to waits for the next solve: there may be none.
    prepared: Option<Prepared>,
    /// The solver and its preconditioning, in words.
    pub name: String,
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
    ) -> Result<Self, SystemError> {
        let form = choice.form();
        let first = if interpolations.is_empty() { Preconditioning::Factor } else { preconditioning };
        let unknowns = system.finest_stiffness().operator().size().0;
        let rungs = match form {
            Form::Augmented => ladder(first, unknowns, system.border.is_some(), chosen(&system.session)),
            Form::Plain => vec![DIRECT],
        };
        let interpolations = interpolations.clone();
        let mut solver = Self { form, interpolations, rungs, prepared: None, name: String::new() };
        solver.prepare(system)?;
        Ok(solver)
    }

    /// Takes over changed blocks. **Collective**
    pub fn refresh(&mut self, system: &SaddlePoint) -> Result<(), SystemError> {
        let rung = self.rung();
        let Some(Prepared { krylov, bordered, levels, .. }) = &mut self.prepared else { return Ok(()) };
        if let Some(bordered) = bordered {
            bordered.forget();
        }
        if self.form == Form::Plain {
            return set_plain_operators(krylov, system);
        }
        if let Some((auxiliary, cycle)) = levels {
            auxiliary.refresh(system.stiffness[0].lattice());
            cycle.borrow_mut().refresh()?;
        }
        set_operators(krylov, system, rung.preconditioning)
    }

    /// What the rung works with, set up if it is not. **Collective**
    pub(super) fn prepare(&mut self, system: &SaddlePoint) -> Result<&Prepared, SystemError> {
        let prepared = match self.prepared.take() {
            Some(prepared) => prepared,
            None => match self.form {
                Form::Augmented => field_split(system, &self.interpolations, self.rung())?,
                Form::Plain => direct(system)?,
            },
        };
        self.name.clone_from(&prepared.name);
        Ok(self.prepared.insert(prepared))
    }

    /// The rung that it stands on.
    pub(super) fn rung(&self) -> Rung {
        self.rungs[0]
    }

    /// Goes up to the rung for a solve that needs so many iterations on this one, if there is any, and notes it.
    pub(super) fn climb(&mut self, needed: f64, solve: &mut LinearSolve) -> bool {
        let Some(up) = climb(&self.rungs, needed) else { return false };
        let before = self.preconditioning();
        self.rungs.drain(..up);
        self.prepared = None;
        if self.preconditioning() == before {
            solve.fallback = Some(format!("{}, GMRES", self.name));
        } else {
            self.name = name(self.preconditioning());
            solve.fallback = Some(self.name.clone());
        }
        true
    }

    /// What preconditions the displacements, from the next solve on.
    pub fn preconditioning(&self) -> Preconditioning {
        self.rung().preconditioning
    }

    /// Rows of the auxiliary levels, coarsest first. **Collective**
    pub fn auxiliary_levels(&mut self, system: &SaddlePoint) -> Result<impl Iterator<Item = &Rc<LatticeOperator>>, SystemError> {
        Ok(self.prepare(system)?.levels.iter().flat_map(|(auxiliary, _)| auxiliary.iter()))
    }
}
