//! The solve of a run: once, or for one contact boundary after the other.

use super::{Run, RunError};
use crate::contact::ActiveSet;
use crate::petsc::Matrix;
use crate::system::{
    ContactLoop, Discretisation, Elastic, Following, Form, LinearSolver, Onward, OuterStep, SaddlePoint, Solution, Start,
    Verdict, bilateral, carried, inf_sup, interpolations, load, nodal_forces, stands,
};

/// Displacement unknowns up to which a failed solve is looked into.
const LARGE_INF_SUP: usize = 200_000;

/// Displacement unknowns up to which the inf-sup constants take less than a tenth of a run.
const CHEAP_INF_SUP: usize = 10_000;

/// Relative residual of solves on boundaries that are still on their way.
const ON_THE_WAY: f64 = 1e-5;

/// What no contact boundary changes.
struct Lasting {
    /// The bodies without contact; only where boundaries follow the solution, otherwise the system holds them.
    elastic: Option<Elastic>,
    interpolations: Vec<Matrix>,
}

/// One boundary solved for, with what solved it.
struct Solved {
    solution: Solution,
    system: SaddlePoint,
    solver: String,
}

impl Run<'_> {
    /// Assembles and solves; the solution comes with what solved it, in words. A body that nothing holds is found
    /// before anything is assembled. **Collective**
    pub(super) fn solve(&self, problem: &mut Discretisation) -> Result<(Solution, String), RunError> {
        if let Some(nothing) = self.not_held(problem) {
            return Ok((nothing, "none".into()));
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
        let mut solved = if problem.follows() {
            self.follow(problem, &lasting)?
        } else {
            self.solve_once(problem, &lasting, None, self.case.solver.tolerance, (1, 0))?
        };
        self.measure_inf_sup(problem, &mut solved)?;
        Ok((solved.solution, solved.solver))
    }

    fn load(&self, problem: &Discretisation) -> Result<Vec<f64>, RunError> {
        Ok(load(problem, &nodal_forces(problem, self.session)?))
    }

    /// A body that supports and the whole of all contacts do not hold.
    fn not_held(&self, problem: &Discretisation) -> Option<Solution> {
        let all = vec![true; problem.multiplier_count()];
        let contact_loop = ContactLoop { problem, session: self.session, boundary: 1, passes: 0, tolerance: 0.0 };
        let mechanism = contact_loop.mechanism(&all)?;
        let words = contact_loop.not_held(&mechanism, true);
        Some(Solution::nothing(Verdict::NotConverged(words), problem.finest(), &all))
    }

    /// Solves for the contact boundaries as they are; `count` tells the number of the boundary and the passes before.
    /// **Collective**
    fn solve_once(
        &self,
        problem: &Discretisation,
        lasting: &Lasting,
        start: Option<(&Solution, Vec<f64>, Vec<bool>)>,
        tolerance: f64,
        (boundary, passes): (usize, usize),
    ) -> Result<Solved, RunError> {
        let choice = self.case.solver.choice;
        let mut system = {
            let _stage = self.stages.assemble.enter();
            match &lasting.elastic {
                Some(elastic) => SaddlePoint::around(problem, elastic, choice.form(), self.session)?,
                None => SaddlePoint::new(problem, self.load(problem)?, choice.form(), self.session)?,
            }
        };
        let mut solver = {
            let _stage = self.stages.setup.enter();
            LinearSolver::new(&system, &lasting.interpolations, choice, self.session)?
        };
        let unused = solver.unused_options()?;
        if !unused.is_empty() {
            let words = format!("PETSc options that nothing has used: {}; check their spelling", unused.join(", "));
            return Err(RunError::Input(words));
        }
        let _stage = self.stages.solve.enter();
        let mut set = ActiveSet::new(bilateral(&problem.contacts));
        if let Some((_, _, active)) = &start {
            set = set.starting_from(active);
        }
        let start = start.as_ref().map(|(before, multipliers, _)| Start { displacement: &before.displacement, multipliers });
        let contact_loop = ContactLoop { problem, session: self.session, boundary, passes, tolerance };
        let report = |step: &OuterStep| self.report.step(step, problem.multiplier_count());
        let solution = contact_loop.solve(&mut system, &mut solver, &mut set, start, report)?;
        Ok(Solved { solution, system, solver: solver.name })
    }

    /// Solves, lets the boundaries follow, and solves again, until everything stands; the last solve goes to the case's
    /// tolerance. **Collective**
    fn follow(&self, problem: &mut Discretisation, lasting: &Lasting) -> Result<Solved, RunError> {
        let exact = self.case.solver.tolerance;
        let mut following = Following::new(problem);
        let (mut passes, mut boundaries) = (Vec::new(), Vec::new());
        let mut start = None;
        let mut before: Option<Solved> = None;
        let mut tolerance = exact.max(ON_THE_WAY);
        loop {
            let begin =
                before.as_ref().zip(start.take()).map(|(solved, (multipliers, active))| (&solved.solution, multipliers, active));
            let mut solved = self.solve_once(problem, lasting, begin, tolerance, (following.number(), passes.len()))?;
            passes.append(&mut solved.solution.steps);
            let done = matches!(solved.solution.verdict, Verdict::NotConverged(_));
            let onward = if done {
                None
            } else {
                let _stage = self.stages.contact.enter();
                let (step, onward) = following.next(problem, &solved.solution, self.session)?;
                self.report.boundary(&step);
                tolerance = if step.moved.is_some_and(|way| way < 1e-2) { exact } else { exact.max(ON_THE_WAY) };
                boundaries.push(step);
                Some(onward)
            };
            match onward {
                Some(Onward::Again(contacts, motion)) => {
                    let _stage = self.stages.contact.enter();
                    start = carried(&problem.contacts, &contacts, &solved.solution);
                    problem.replace(contacts, motion, self.session)?;
                    before = Some(solved);
                    continue;
                }
                Some(Onward::Stands) => solved.solution.verdict = Verdict::Converged(stands(&boundaries)),
                Some(Onward::GivenUp(words)) => solved.solution.verdict = Verdict::NotConverged(words),
                None => {}
            }
            solved.solution.steps = passes;
            solved.solution.boundaries = boundaries;
            return Ok(solved);
        }
    }

    /// The inf-sup constants, where they are cheap, asked for, or may tell why a solve has failed. **Collective**
    fn measure_inf_sup(&self, problem: &Discretisation, solved: &mut Solved) -> Result<(), RunError> {
        let failed = matches!(solved.solution.verdict, Verdict::NotConverged(_)) && problem.unknown_count() <= LARGE_INF_SUP;
        let cheap = problem.unknown_count() <= CHEAP_INF_SUP;
        let possible = self.case.solver.choice.form() == Form::Augmented && !problem.contacts.is_empty();
        if possible && self.case.solver.inf_sup.unwrap_or(cheap || failed) {
            let _stage = self.stages.solve.enter();
            solved.solution.inf_sup = inf_sup(&solved.system, &problem.contacts, &solved.solution.active, self.session)?;
        }
        Ok(())
    }
}
