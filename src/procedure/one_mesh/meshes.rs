//! The loop over meshes: coarser ones first, so that active sets, boundaries and errors are known; then that of the case.

use crate::discretisation::{Discretisation, Scene, SystemError};
use crate::procedure::at_rest::AtRest;
use crate::procedure::coarse_solution::CoarseSolution;
use crate::procedure::ending::{Ending, Failure};
use crate::procedure::estimates::{Difference, Estimate};
use crate::procedure::one_mesh::begun::Begun;
use crate::procedure::one_mesh::boundaries::{MeshHistory, OnMesh, OneMesh};
use crate::procedure::predecessor::Predecessor;
use crate::procedure::settings::{Event, Procedure, Work};
use crate::procedure::solved::{CoarseSolve, Solved};
use crate::system::{Preconditioning, SolverChoice, Start, Tolerance};

/// Refinements that are solved before the case's own.
pub const COARSER: usize = 2;

/// Relative residual of the solves on coarser meshes: below any discretisation error there.
const COARSE: f64 = 1e-6;

/// The same where boundaries follow: their ends are felt in the third digit of it.
const COARSE_FOR_BOUNDARIES: f64 = 1e-8;

/// The same where an accuracy is asked for: differences between the meshes are what it is told by.
const COARSE_FOR_ACCURACY: f64 = 1e-8;

/// What is known before the mesh of the case is solved.
struct Coarser<'p> {
    /// The preconditioner to begin with.
    first: Preconditioning,
    /// What is to be said of it, before the first solve.
    words: Option<String>,
    /// The solution on the adapted mesh before, if there is any.
    predecessor: Option<&'p Predecessor<'p>>,
    /// The solution on the last refinement, if there is any.
    found: Option<CoarseSolution>,
    differences: Vec<Difference>,
    solves: Vec<CoarseSolve>,
}

impl Coarser<'_> {
    /// The preconditioner that was needed on the mesh `before`, or on the adapted one before, and whether the active set was hard to
    /// find there.
    fn needed(&self, before: Option<&CoarseSolution>) -> (Preconditioning, bool) {
        let before = before.map(|before| &before.contact).or(self.predecessor.map(|before| &before.contact));
        before.map_or((Preconditioning::Sweep, false), |before| (before.preconditioning, before.is_hard))
    }
}

impl Procedure<'_> {
    /// Solves a scene: on the mesh of the case, or on one that is adapted to an accuracy. On the mesh of the case it may begin with
    /// what was found `before`, in the load step before. **Collective**
    ///
    /// # Errors
    /// [`SystemError`] if the scene cannot be solved at all; everything else is an [`Ending`].
    pub fn solve(&self, scene: Scene, before: Option<&Solved>) -> Result<Solved, SystemError> {
        match (self.accuracy, before) {
            (Some(accuracy), _) => self.adapt(scene, accuracy),
            (None, Some(before)) => self.solve_after(scene, before),
            (None, None) => self.solve_on_mesh(scene, None),
        }
    }

    /// Solves a scene on its mesh, from the solution on an adapted mesh before, if there is any. A body that nothing holds is
    /// found before anything is assembled. **Collective**
    ///
    /// # Errors
    /// As [`Procedure::solve`].
    pub(crate) fn solve_on_mesh(&self, scene: Scene, predecessor: Option<&Predecessor>) -> Result<Solved, SystemError> {
        let at_rest = {
            let _stage = self.observer.enter(Work::Contact);
            Self::look(&scene, self.session.rank())?
        };
        self.observer.observe(Event::AtRest { scene: &scene, at_rest: &at_rest });
        let (first, words) = self.first_solver(&scene, 2 * at_rest.numbering.node_count());
        let mut coarser = Coarser { first, words, predecessor, found: None, differences: Vec::new(), solves: Vec::new() };
        let take_up = |refine: usize| self.observer.observe(Event::Refinement { refine, last: scene.refine });
        let coarser_meshes = if scene.is_driven(&at_rest.numbering) { COARSER.min(scene.refine) } else { 0 };
        for times in (1..=coarser_meshes).rev() {
            take_up(scene.refine - times);
            match self.coarse_mesh(scene.coarser(times), &mut coarser) {
                // The mesh is too coarse for the scene; the case's own may do.
                Err(SystemError::Case(_)) => coarser.differences.clear(),
                outcome => outcome?,
            }
        }
        take_up(scene.refine);
        match self.begun_from(scene, coarser.found.as_ref(), coarser.predecessor)? {
            Begun::Ready(problem, start) => self.solve_last(*problem, start, coarser),
            Begun::Free(problem, words) => {
                Ok(Solved::nothing(*problem, Ending::NotConverged(Failure::NotHeld(words)), coarser.solves))
            }
        }
    }

    /// Looks at a scene: one that is not sound is refused before anything is solved.
    ///
    /// # Errors
    /// [`SystemError::Case`] in words.
    pub fn look(scene: &Scene, rank: usize) -> Result<AtRest, SystemError> {
        AtRest::new(scene, rank)
    }

    /// What the choice of the case comes to; what "auto" does is said with its reason.
    fn first_solver(&self, scene: &Scene, unknowns: usize) -> (Preconditioning, Option<String>) {
        if self.choice != SolverChoice::Auto {
            return (Preconditioning::of(scene, scene.refine), None);
        }
        let (preconditioning, words) = Preconditioning::first(scene, unknowns);
        (preconditioning, Some(words))
    }

    /// Solves a coarser mesh, if it holds the bodies, and keeps what it tells. **Collective**
    fn coarse_mesh(&self, scene: Scene, coarser: &mut Coarser) -> Result<(), SystemError> {
        let (refine, before) = (scene.refine, coarser.found.take());
        // Of a body that is free the finest mesh, which begins in the same way, says it.
        let Begun::Ready(mut problem, start) = self.begun_from(scene, before.as_ref(), coarser.predecessor)? else {
            return Ok(());
        };
        self.say(coarser);
        let (needed, is_hard) = coarser.needed(before.as_ref());
        let preconditioning = needed.max(Preconditioning::of(&problem.scene, refine));
        let tolerance = Tolerance::Residual(self.tolerance.residual().max(if self.accuracy.is_some() {
            COARSE_FOR_ACCURACY
        } else if problem.follows() {
            COARSE_FOR_BOUNDARIES
        } else {
            COARSE
        }));
        let found =
            OneMesh { procedure: self, tolerance, is_last: false, is_hard }.solve(&mut problem, start, preconditioning)?;
        let (unknowns, converged) = (problem.unknown_count(), found.ending.is_converged());
        let MeshHistory { passes, ascended, preconditioning, .. } = &found.history;
        let iterations = passes.iter().map(|pass| pass.krylov_iterations).collect();
        let solve = CoarseSolve { refine, unknowns, iterations };
        let active = &found.solution.active;
        self.observer.observe(Event::Coarse { solve: &solve, active, passes, converged });
        coarser.solves.push(solve);
        if converged {
            let _stage = self.observer.enter(Work::Recovery);
            if let Some(before) = &before {
                coarser.differences.push(Difference::new(&problem, &found.solution, before, self.accuracy)?);
            }
            let needed = (*preconditioning, is_hard || *ascended);
            coarser.found = Some(CoarseSolution::new(*problem, found.solution, needed)?);
        }
        Ok(())
    }

    /// A mesh with what is known of it: from the coarser one, from the adapted one before, or else from the programme. **Collective**
    fn begun_from(
        &self,
        scene: Scene,
        coarse: Option<&CoarseSolution>,
        predecessor: Option<&Predecessor>,
    ) -> Result<Begun, SystemError> {
        let _stage = self.observer.enter(Work::Contact);
        let known = match coarse {
            Some(coarse) => Some(coarse.refined(scene.clone(), self.session)?),
            None => self.begun_by_predecessor(&scene, predecessor)?,
        };
        match known {
            Some((problem, start)) => Ok(Begun::Ready(Box::new(problem), Some(start))),
            None => self.begun(scene),
        }
    }

    /// A mesh with what the adapted mesh before says of it, if that can be had. **Collective**
    fn begun_by_predecessor(
        &self,
        scene: &Scene,
        predecessor: Option<&Predecessor>,
    ) -> Result<Option<(Discretisation, Start)>, SystemError> {
        match predecessor.map(|predecessor| predecessor.start_on(scene.clone())) {
            Some(Ok(found)) => Ok(Some(found)),
            // Where a boundary lay there, it cannot here.
            None | Some(Err(SystemError::Case(_))) => Ok(None),
            Some(Err(error)) => Err(error),
        }
    }

    /// Solves the mesh of the case. **Collective**
    fn solve_last(&self, mut problem: Discretisation, start: Option<Start>, mut coarser: Coarser) -> Result<Solved, SystemError> {
        self.say(&mut coarser);
        let (needed, is_hard) = coarser.needed(coarser.found.as_ref());
        let preconditioning = needed.max(coarser.first);
        let Coarser { found: coarse, mut differences, solves, predecessor, .. } = coarser;
        let tolerance = if start.is_some() { self.tolerance } else { Tolerance::Residual(self.tolerance.residual()) };
        let found = OneMesh { procedure: self, tolerance, is_last: true, is_hard }.solve(&mut problem, start, preconditioning)?;
        if let Some(coarse) = &coarse {
            let _stage = self.observer.enter(Work::Recovery);
            differences.push(Difference::new(&problem, &found.solution, coarse, self.accuracy)?);
        }
        let shares_left = match (predecessor, differences.as_slice()) {
            (Some(before), [one]) => before.shares_left(&problem, &found.solution, &one.of_triangles)?,
            _ => Vec::new(),
        };
        let sum = |own: f64| self.session.sum([own])[0];
        let estimate = Estimate::new(&differences, shares_left, problem.scene.order, found.solution.residual, sum);
        let OnMesh { solution, ending, solver, history } = found;
        let ending = self.with_cause(ending, &problem.scene);
        let MeshHistory { passes, boundaries, ascended, preconditioning } = history;
        Ok(Solved {
            problem,
            solution,
            ending,
            passes,
            boundaries,
            solver,
            preconditioning,
            is_hard: is_hard || ascended,
            estimate,
            coarse_stress: coarse.as_ref().map(|coarse| coarse.largest.clone()),
            coarse: solves,
            before: coarse.filter(|_| self.accuracy.is_some()),
            adaptation: None,
        })
    }

    /// An ending that names the loads that drive a body off all its contacts, where they are why the contact conditions are not met, or
    /// why a solve came to nothing.
    fn with_cause(&self, ending: Ending, scene: &Scene) -> Ending {
        let Ending::NotConverged(Failure::ConditionsViolated(_) | Failure::LinearSolver { .. }) = &ending else { return ending };
        match Self::driven_off(&scene.on_one_rank(), self.accuracy, 1) {
            Some(words) => Ending::NotConverged(Failure::NotHeld(words)),
            None => ending,
        }
    }

    fn say(&self, coarser: &mut Coarser) {
        if let Some(words) = coarser.words.take() {
            self.observer.observe(Event::Solver(&words));
        }
    }
}
