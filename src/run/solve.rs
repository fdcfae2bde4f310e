//! The solve of a run: on coarser meshes first, so that active sets, boundaries and errors are known; then on the mesh
//! of the case.

use super::{Run, RunError};
use crate::contact::{ActiveSet, Pair};
use crate::output::summary::CoarseSolve;
use crate::petsc::Matrix;
use crate::system::{
    CoarseSolution, ContactLoop, Difference, Discretisation, Elastic, Estimate, Form, LinearSolver, OuterStep, Rung, SaddlePoint,
    Solution, SolverChoice, Start, Tolerance, Verdict, bilateral, inf_sup, interpolations, load, nodal_forces, not_held,
};
use std::rc::Rc;

/// Displacement unknowns up to which a solve that failed, or whose active set was hard to find, is looked into.
const LARGE_INF_SUP: usize = 200_000;

/// Displacement unknowns up to which the inf-sup constants take less than a tenth of a run.
const CHEAP_INF_SUP: usize = 10_000;

/// Refinements that are solved before the case's own.
const COARSER: usize = 2;

/// Relative residual of the solves on coarser meshes: below any discretisation error there.
const COARSE: f64 = 1e-6;

/// What no contact boundary changes.
pub(super) struct Lasting {
    /// The bodies without contact; only where boundaries follow the solution, otherwise the system holds them.
    elastic: Option<Elastic>,
    interpolations: Rc<[Matrix]>,
}

/// The system of one boundary, with what solves it.
pub(super) struct Prepared {
    pub system: SaddlePoint,
    pub solver: LinearSolver,
}

/// Where a solve begins: this rank's displacements, pressures and states of all multipliers.
pub(super) struct Begin {
    pub displacement: Vec<f64>,
    pub multipliers: Vec<f64>,
    pub active: Vec<bool>,
}

/// How a solve is made: number of the boundary, passes made before, relative residual to reach, whether it is heard of.
#[derive(Clone, Copy)]
pub(super) struct Pass {
    pub boundary: usize,
    pub passes: usize,
    pub tolerance: Tolerance,
    pub heard: bool,
}

/// A run solved.
pub(super) struct Solved {
    pub solution: Solution,
    /// What solved it, in words.
    pub solver: String,
    pub estimate: Estimate,
    /// Coarser meshes that were solved first.
    pub coarse: Vec<CoarseSolve>,
}

impl Run<'_> {
    /// Solves; a body that nothing holds is found before anything is assembled. **Collective**
    pub(super) fn solve(&self, problem: &mut Discretisation) -> Result<Solved, RunError> {
        let all = vec![true; problem.multiplier_count()];
        if let Some(words) = not_held(problem, &all) {
            let solution = Solution::nothing(Verdict::NotConverged(words), problem.finest(), &all);
            return Ok(Solved { solution, solver: "none".into(), estimate: Estimate::default(), coarse: Vec::new() });
        }
        let first = self.first_rung(problem);
        let mut solves = Vec::new();
        let (coarse, mut differences) = self.coarser_meshes(problem, &mut solves)?;
        let begin = self.refine(problem, coarse.as_ref())?;
        let tolerance = self.case.solver.tolerance;
        let tolerance = if begin.is_some() { tolerance } else { Tolerance::Residual(tolerance.residual()) };
        let rung = coarse.as_ref().map_or(first, |coarse| coarse.rung.max(first));
        let (mut solution, prepared) = self.solve_mesh(problem, begin, rung, tolerance, true)?;
        if let Some(coarse) = &coarse {
            let _stage = self.stages.output.enter();
            differences.push(Difference::new(problem, &solution, coarse, self.session)?);
        }
        self.measure_inf_sup(problem, &prepared.system, &mut solution)?;
        let estimate = Estimate::new(&differences, problem.scene.order, solution.residual);
        Ok(Solved { solution, solver: prepared.solver.name, estimate, coarse: solves })
    }

    /// Where the ladder begins; what `name = "auto"` comes to is said with its reason.
    fn first_rung(&self, problem: &Discretisation) -> Rung {
        let scene = &problem.scene;
        if self.case.solver.choice != SolverChoice::Auto {
            return Rung::of(scene.refine + 1, &scene.mesh.ratios);
        }
        let (rung, reason) = Rung::first(scene.refine + 1, &scene.mesh.ratios, problem.unknown_count());
        self.report.say(&format!("solver: {reason}"));
        rung
    }

    /// Solutions on coarser meshes, as far as they can be had: the last one, and how they differ. **Collective**
    fn coarser_meshes(
        &self,
        problem: &mut Discretisation,
        solves: &mut Vec<CoarseSolve>,
    ) -> Result<(Option<CoarseSolution>, Vec<Difference>), RunError> {
        let target = problem.scene.refine;
        let (mut found, mut differences) = (None, Vec::new());
        for refine in target.saturating_sub(COARSER)..target {
            match self.coarse_mesh(problem, refine, found.take(), solves) {
                Ok((coarse, difference)) => {
                    found = coarse;
                    differences.extend(difference);
                }
                // The mesh is too coarse for the scene; the case's own may do.
                Err(RunError::Key(_)) => differences.clear(),
                Err(error) => return Err(error),
            }
        }
        Ok((found, differences))
    }

    /// The solution on one coarser mesh, if there is one. **Collective**
    fn coarse_mesh(
        &self,
        problem: &mut Discretisation,
        refine: usize,
        coarser: Option<CoarseSolution>,
        solves: &mut Vec<CoarseSolve>,
    ) -> Result<(Option<CoarseSolution>, Option<Difference>), RunError> {
        let begin = {
            let _stage = self.stages.contact.enter();
            let pairs: Vec<Pair> = self.case.contacts.iter().map(|pair| pair.coarser(self.case.mesh.refine - refine)).collect();
            let start = problem.refine_to(refine, pairs, coarser.as_ref(), self.session)?;
            self.begin(problem, coarser.as_ref(), start)
        };
        let least = Rung::of(refine + 1, &problem.scene.mesh.ratios);
        let rung = coarser.as_ref().map_or(least, |coarser| coarser.rung.max(least));
        let tolerance = Tolerance::Residual(self.case.solver.tolerance.residual().max(COARSE));
        let (solution, prepared) = self.solve_mesh(problem, begin, rung, tolerance, false)?;
        let iterations = solution.steps.iter().map(|step| step.krylov_iterations).collect();
        solves.push(CoarseSolve { refine, unknowns: problem.unknown_count(), iterations });
        self.report.coarse(refine, problem, &solution);
        if matches!(solution.verdict, Verdict::NotConverged(_)) {
            return Ok((None, None));
        }
        let difference = match &coarser {
            Some(coarser) => Some(Difference::new(problem, &solution, coarser, self.session)?),
            None => None,
        };
        Ok((Some(CoarseSolution::new(problem, solution, prepared.solver.rung, self.session)?), difference))
    }

    /// Goes to the mesh of the case. **Collective**
    fn refine(&self, problem: &mut Discretisation, coarse: Option<&CoarseSolution>) -> Result<Option<Begin>, RunError> {
        let target = self.case.mesh.refine;
        if target == problem.scene.refine && coarse.is_none() {
            return Ok(None);
        }
        let _stage = self.stages.contact.enter();
        let start = problem.refine_to(target, self.case.contacts.clone(), coarse, self.session)?;
        Ok(self.begin(problem, coarse, start))
    }

    fn begin(&self, problem: &Discretisation, coarse: Option<&CoarseSolution>, start: Option<Vec<f64>>) -> Option<Begin> {
        let (multipliers, active) = coarse?.multipliers(&problem.contacts);
        Some(Begin { displacement: start?, multipliers, active })
    }

    /// Solves on the mesh at hand, once or for one contact boundary after the other. **Collective**
    fn solve_mesh(
        &self,
        problem: &mut Discretisation,
        begin: Option<Begin>,
        rung: Rung,
        tolerance: Tolerance,
        heard: bool,
    ) -> Result<(Solution, Prepared), RunError> {
        let form = self.case.solver.choice.form();
        let mut lasting = Lasting { elastic: None, interpolations: Rc::new([]) };
        if problem.follows() {
            let _stage = self.stages.assemble.enter();
            lasting.elastic = Some(Elastic::alone(problem, self.load(problem)?, form, self.session)?);
        }
        if form == Form::Augmented {
            let _stage = self.stages.setup.enter();
            lasting.interpolations = interpolations(problem, self.session)?.into();
        }
        let pass = Pass { boundary: 1, passes: 0, tolerance, heard };
        if problem.follows() {
            return self.follow(problem, &lasting, begin, rung, pass);
        }
        if heard {
            self.report.head();
        }
        let mut prepared = self.prepare(problem, &lasting, rung)?;
        let solution = self.solve_on(problem, &mut prepared, begin, pass)?;
        Ok((solution, prepared))
    }

    fn load(&self, problem: &Discretisation) -> Result<Vec<f64>, RunError> {
        Ok(load(problem, &nodal_forces(problem, self.session)?))
    }

    /// Sets up system and solver for the contact boundaries as they are, on a rung of the ladder. **Collective**
    pub(super) fn prepare(&self, problem: &Discretisation, lasting: &Lasting, rung: Rung) -> Result<Prepared, RunError> {
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
    pub(super) fn solve_on(
        &self,
        problem: &Discretisation,
        prepared: &mut Prepared,
        begin: Option<Begin>,
        Pass { boundary, passes, tolerance, heard }: Pass,
    ) -> Result<Solution, RunError> {
        let _stage = self.stages.solve.enter();
        let mut set = ActiveSet::new(bilateral(&problem.contacts));
        if let Some(begin) = &begin {
            set = set.starting_from(&begin.active);
        }
        let start = begin.as_ref().map(|begin| Start { displacement: &begin.displacement, multipliers: &begin.multipliers });
        let contact_loop = ContactLoop { problem, session: self.session, boundary, passes, tolerance };
        let report = |step: &OuterStep| {
            if heard {
                self.report.step(step, problem.multiplier_count())
            }
        };
        Ok(contact_loop.solve(&mut prepared.system, &mut prepared.solver, &mut set, start, report)?)
    }

    /// The inf-sup constants, where they are cheap, asked for, or may tell why a solve has failed or an active set was hard to find. **Collective**
    fn measure_inf_sup(&self, problem: &Discretisation, system: &SaddlePoint, solution: &mut Solution) -> Result<(), RunError> {
        // Too many multipliers are one reason why a set is hard to find.
        let hard = solution.ascended || matches!(solution.verdict, Verdict::NotConverged(_));
        let hard = hard && problem.unknown_count() <= LARGE_INF_SUP;
        let cheap = problem.unknown_count() <= CHEAP_INF_SUP;
        let possible = self.case.solver.choice.form() == Form::Augmented && !problem.contacts.is_empty();
        if possible && self.case.solver.inf_sup.unwrap_or(cheap || hard) {
            let _stage = self.stages.solve.enter();
            solution.inf_sup = inf_sup(system, &problem.contacts, &solution.active, self.session)?;
        }
        Ok(())
    }
}
