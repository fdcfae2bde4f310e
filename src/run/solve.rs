//! The solve of a run: once, or for one contact boundary after the other.

use super::{Run, RunError};
use crate::contact::ActiveSet;
use crate::petsc::Matrix;
use crate::system::{
    ContactLoop, Discretisation, Elastic, Following, Form, LinearSolver, Onward, OuterStep, Rung, SaddlePoint, Solution, Start,
    Verdict, bilateral, carried, inf_sup, interpolations, load, nodal_forces, not_held, stands,
};

/// Displacement unknowns up to which a failed solve is looked into.
const LARGE_INF_SUP: usize = 200_000;

/// Displacement unknowns up to which the inf-sup constants take less than a tenth of a run.
const CHEAP_INF_SUP: usize = 10_000;

/// Relative residual of solves on boundaries that are still on their way.
const ON_THE_WAY: f64 = 1e-5;

/// Share of its length by which a boundary moves when it is nearly there.
const NEARLY: f64 = 1e-2;

/// What no contact boundary changes.
struct Lasting {
    /// The bodies without contact; only where boundaries follow the solution, otherwise the system holds them.
    elastic: Option<Elastic>,
    interpolations: Vec<Matrix>,
}

/// The system of one boundary, with what solves it.
struct Prepared {
    system: SaddlePoint,
    solver: LinearSolver,
}

/// Where a solve begins: a solution before, with pressures and states of today's multipliers.
struct Carried<'a> {
    before: &'a Solution,
    multipliers: Vec<f64>,
    active: Vec<bool>,
}

/// Number of the boundary, passes made before, and relative residual to reach.
#[derive(Clone, Copy)]
struct Pass {
    boundary: usize,
    passes: usize,
    tolerance: f64,
}

impl Run<'_> {
    /// Assembles and solves; the solution comes with what solved it, in words. A body that nothing holds is found
    /// before anything is assembled. **Collective**
    pub(super) fn solve(&self, problem: &mut Discretisation) -> Result<(Solution, String), RunError> {
        let all = vec![true; problem.multiplier_count()];
        if let Some(words) = not_held(problem, &all) {
            return Ok((Solution::nothing(Verdict::NotConverged(words), problem.finest(), &all), "none".into()));
        }
        let form = self.case.solver.choice.form();
        let mut lasting = Lasting { elastic: None, interpolations: Vec::new() };
        if problem.follows() {
            let _stage = self.stages.assemble.enter();
            lasting.elastic = Some(Elastic::alone(problem, self.load(problem)?, form, self.session)?);
        }
        if form == Form::Augmented {
            let _stage = self.stages.setup.enter();
            lasting.interpolations = interpolations(problem, self.session)?;
        }
        let (mut solution, prepared) = if problem.follows() {
            self.follow(problem, &lasting)?
        } else {
            let mut prepared = self.prepare(problem, &lasting, Rung::first(&problem.scene))?;
            let pass = Pass { boundary: 1, passes: 0, tolerance: self.case.solver.tolerance };
            (self.solve_on(problem, &mut prepared, None, pass)?, prepared)
        };
        self.measure_inf_sup(problem, &prepared.system, &mut solution)?;
        Ok((solution, prepared.solver.name))
    }

    fn load(&self, problem: &Discretisation) -> Result<Vec<f64>, RunError> {
        Ok(load(problem, &nodal_forces(problem, self.session)?))
    }

    /// Sets up system and solver for the contact boundaries as they are, on a rung of the ladder. **Collective**
    fn prepare(&self, problem: &Discretisation, lasting: &Lasting, rung: Rung) -> Result<Prepared, RunError> {
        let choice = self.case.solver.choice;
        let system = {
            let _stage = self.stages.assemble.enter();
            match &lasting.elastic {
                Some(elastic) => SaddlePoint::around(problem, elastic, choice.form(), self.session)?,
                None => SaddlePoint::new(problem, self.load(problem)?, choice.form(), self.session)?,
            }
        };
        let solver = {
            let _stage = self.stages.setup.enter();
            LinearSolver::new(&system, &lasting.interpolations, choice, rung, self.session)?
        };
        let unused = solver.unused_options()?;
        if !unused.is_empty() {
            let words = format!("PETSc options that nothing has used: {}; check their spelling", unused.join(", "));
            return Err(RunError::Input(words));
        }
        Ok(Prepared { system, solver })
    }

    /// Solves on boundaries that stay where they are. **Collective**
    fn solve_on(
        &self,
        problem: &Discretisation,
        prepared: &mut Prepared,
        carried: Option<Carried>,
        Pass { boundary, passes, tolerance }: Pass,
    ) -> Result<Solution, RunError> {
        let _stage = self.stages.solve.enter();
        let mut set = ActiveSet::new(bilateral(&problem.contacts));
        if let Some(carried) = &carried {
            set = set.starting_from(&carried.active);
        }
        let start =
            carried.as_ref().map(|from| Start { displacement: &from.before.displacement, multipliers: &from.multipliers });
        let contact_loop = ContactLoop { problem, session: self.session, boundary, passes, tolerance };
        let report = |step: &OuterStep| self.report.step(step, problem.multiplier_count());
        Ok(contact_loop.solve(&mut prepared.system, &mut prepared.solver, &mut set, start, report)?)
    }

    /// Solves, lets the boundaries follow, and solves again, until everything stands; the last solve goes to the case's
    /// tolerance. **Collective**
    fn follow(&self, problem: &mut Discretisation, lasting: &Lasting) -> Result<(Solution, Prepared), RunError> {
        let exact = self.case.solver.tolerance;
        let mut following = Following::new(problem, exact);
        let mut prepared = self.prepare(problem, lasting, Rung::first(&problem.scene))?;
        let mut pass = Pass { boundary: 1, passes: 0, tolerance: exact.max(ON_THE_WAY) };
        let mut solution = self.solve_on(problem, &mut prepared, None, pass)?;
        let (mut steps, mut boundaries) = (std::mem::take(&mut solution.steps), Vec::new());
        while let Verdict::Converged(_) = solution.verdict {
            let (step, onward) = {
                let _stage = self.stages.contact.enter();
                following.next(problem, &solution, pass.boundary, self.session)?
            };
            let near = step.moved.is_some_and(|way| way < NEARLY);
            pass.passes = steps.len();
            let next = match onward {
                Onward::Stands if pass.tolerance > exact => {
                    // The place is right, but it was found with a loose solve.
                    pass.tolerance = exact;
                    let (multipliers, active) = (solution.multipliers.clone(), solution.active.clone());
                    self.solve_on(problem, &mut prepared, Some(Carried { before: &solution, multipliers, active }), pass)?
                }
                Onward::Stands => {
                    self.report.boundary(&step);
                    boundaries.push(step);
                    solution.verdict = Verdict::Converged(stands(&boundaries));
                    break;
                }
                Onward::GivenUp(words) => {
                    self.report.boundary(&step);
                    boundaries.push(step);
                    solution.verdict = Verdict::NotConverged(words);
                    break;
                }
                Onward::Again(contacts, motion) => {
                    self.report.boundary(&step);
                    boundaries.push(step);
                    let carried = carried(&problem.contacts, &contacts, &solution);
                    {
                        let _stage = self.stages.contact.enter();
                        problem.replace(contacts, motion, self.session)?;
                    }
                    prepared = self.prepare(problem, lasting, prepared.solver.rung)?;
                    pass =
                        Pass { boundary: pass.boundary + 1, tolerance: if near { exact } else { exact.max(ON_THE_WAY) }, ..pass };
                    let carried = carried.map(|(multipliers, active)| Carried { before: &solution, multipliers, active });
                    self.solve_on(problem, &mut prepared, carried, pass)?
                }
            };
            solution = next;
            steps.append(&mut solution.steps);
        }
        (solution.steps, solution.boundaries) = (steps, boundaries);
        Ok((solution, prepared))
    }

    /// The inf-sup constants, where they are cheap, asked for, or may tell why a solve has failed. **Collective**
    fn measure_inf_sup(&self, problem: &Discretisation, system: &SaddlePoint, solution: &mut Solution) -> Result<(), RunError> {
        let failed = matches!(solution.verdict, Verdict::NotConverged(_)) && problem.unknown_count() <= LARGE_INF_SUP;
        let cheap = problem.unknown_count() <= CHEAP_INF_SUP;
        let possible = self.case.solver.choice.form() == Form::Augmented && !problem.contacts.is_empty();
        if possible && self.case.solver.inf_sup.unwrap_or(cheap || failed) {
            let _stage = self.stages.solve.enter();
            solution.inf_sup = inf_sup(system, &problem.contacts, &solution.active, self.session)?;
        }
        Ok(())
    }
}
