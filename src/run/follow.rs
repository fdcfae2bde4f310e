//! One contact boundary after the other, until everything stands.

use super::solve::{Begin, Lasting, Pass, Prepared};
use super::{Run, RunError};
use crate::system::{Discretisation, Following, Onward, Rung, Solution, SystemError, Tolerance, Verdict, carried, stands};

/// Relative residual of solves on boundaries that are still on their way.
const ON_THE_WAY: f64 = 1e-5;

/// Share of its length by which a boundary moves when it is nearly there.
const NEARLY: f64 = 1e-2;

impl Run<'_> {
    /// Solves, lets the boundaries follow, and solves again, until everything stands; the last solve goes to the
    /// tolerance of `pass`. A beginning comes from a coarser mesh, whose boundaries are settled. **Collective**
    pub(super) fn follow(
        &self,
        problem: &mut Discretisation,
        lasting: &Lasting,
        begin: Option<Begin>,
        rung: Rung,
        pass: Pass,
    ) -> Result<(Solution, Prepared), RunError> {
        let exact = pass.tolerance.residual().min(ON_THE_WAY);
        let mut following = Following::new(problem, exact, begin.is_some());
        if pass.heard {
            self.report.follows(following.tolerances());
            self.report.head();
        }
        let mut prepared = self.prepare(problem, lasting, rung)?;
        let mut pass = Pass { tolerance: Tolerance::Residual(exact.max(ON_THE_WAY)), ..pass };
        let mut solution = self.solve_on(problem, &mut prepared, begin, pass)?;
        let (mut steps, mut boundaries) = (std::mem::take(&mut solution.steps), Vec::new());
        while let Verdict::Converged(_) = solution.verdict {
            let followed = {
                let _stage = self.stages.contact.enter();
                following.next(problem, &solution, pass.boundary, self.session)
            };
            let (step, onward) = match followed {
                Ok(followed) => followed,
                Err(SystemError::Case(words)) => {
                    solution.verdict = Verdict::NotConverged(words);
                    break;
                }
                Err(error) => return Err(error.into()),
            };
            pass.passes = steps.len();
            let again = if let Onward::Stands = &onward { pass.tolerance != Tolerance::Residual(exact) } else { false };
            if !again {
                if pass.heard {
                    self.report.boundary(&step);
                }
                boundaries.push(step.clone());
            }
            let next = match onward {
                Onward::Stands if again => {
                    // The place is right, but it was found with a loose solve.
                    pass.tolerance = Tolerance::Residual(exact);
                    let begin = from(&solution, Some((solution.multipliers.clone(), solution.active.clone())));
                    self.solve_on(problem, &mut prepared, begin, pass)?
                }
                Onward::Stands => {
                    solution.verdict = Verdict::Converged(stands(&boundaries));
                    break;
                }
                Onward::GivenUp(words) => {
                    solution.verdict = Verdict::NotConverged(words);
                    break;
                }
                Onward::Again(contacts, motion) => {
                    let begin = from(&solution, carried(&problem.contacts, &contacts, &solution));
                    {
                        let _stage = self.stages.contact.enter();
                        problem.replace(contacts, motion, self.session)?;
                    }
                    prepared = self.prepare(problem, lasting, prepared.solver.rung)?;
                    let near = step.moved.is_some_and(|way| way < NEARLY);
                    let tolerance = Tolerance::Residual(if near { exact } else { exact.max(ON_THE_WAY) });
                    pass = Pass { boundary: pass.boundary + 1, tolerance, ..pass };
                    self.solve_on(problem, &mut prepared, begin, pass)?
                }
            };
            solution = next;
            steps.append(&mut solution.steps);
        }
        (solution.steps, solution.boundaries) = (steps, boundaries);
        Ok((solution, prepared))
    }
}

/// A beginning from a solution, if its multipliers can be carried over.
fn from(solution: &Solution, multipliers: Option<(Vec<f64>, Vec<bool>)>) -> Option<Begin> {
    let (multipliers, active) = multipliers?;
    Some(Begin { displacement: solution.displacement.clone(), multipliers, active })
}
