//! One mesh: one contact boundary after the other, until everything stands.
//!
//! On finer meshes a boundary stands as soon as it would move by less than the mesh is exact for. On `cases/hertz` with 48, 189
//! and 753 thousand unknowns the finest mesh then takes one or two boundaries, and 8, 5 and 3 iterations in all, instead of 4 to
//! 6 boundaries and 14 to 22 iterations. The force is the same to 2e-5, the largest pressure to 7e-6, the half width to 6e-4,
//! 3e-5 and 7e-5.
//!
//! Solves go to 1e-5 until a boundary stands or is nearly there, and then to the tolerance. Going to the tolerance at once took
//! 88 cycles instead of 47 on `bearing`, 31 instead of 23 on `chain_5`, and 21 instead of 14 on `hertz`.

use crate::discretisation::{
    BoundaryMotion, Contact, Discretisation, Form, Solution, SystemError, bilateral, load, nodal_forces, settle,
};
use crate::multigrid::{Elastic, Interpolation, interpolations};
use crate::petsc::options;
use crate::procedure::boundary::{BoundaryStep, Following, NextBoundary, carried, standing, start_from};
use crate::procedure::ending::{Ending, Failure, Standing};
use crate::procedure::sets::{ContactLoop, LoopOutcome, LoopPosition, Pass};
use crate::procedure::settings::{Event, Procedure, Work};
use crate::system::{Preconditioning, SaddlePoint, Start, System, Tolerance};
use std::rc::Rc;

/// Relative residual of solves on boundaries that are still on their way.
const ON_THE_WAY: f64 = 1e-5;

/// Change of the displacement, relative to its norm, from which on a boundary that still moves is solved for to the tolerance: ten
/// times what solves on the way leave. A pin in three leaves finds no rest on four of nine meshes without this rule, on one with a
/// tenth of this share, and on none with it.
const STILL: f64 = 10.0 * ON_THE_WAY;

/// Share of its length by which a boundary moves when it is nearly there.
const NEARLY: f64 = 1e-2;

/// How one mesh is solved.
pub struct OneMesh<'p> {
    pub procedure: &'p Procedure<'p>,
    /// How far its last solve goes.
    pub tolerance: Tolerance,
    /// Whether it is the mesh of the case: the others are reported when they are solved.
    pub is_last: bool,
    /// Whether its active set was hard to find on the coarser mesh.
    pub is_hard: bool,
}

/// What was found on one mesh.
pub struct OnMesh {
    pub solution: Solution,
    pub ending: Ending,
    /// What solved it, in words.
    pub solver: String,
    pub history: MeshHistory,
}

impl OnMesh {
    /// Nothing moves, and no unilateral contact is closed.
    fn at_rest(problem: &Discretisation, preconditioning: Preconditioning) -> Self {
        let nothing = Solution::nothing(problem.finest(), &bilateral(&problem.contacts));
        Self {
            solution: Solution { residual: 0.0, plain_residual: 0.0, ..nothing },
            ending: Ending::Converged(Standing::Residual),
            solver: "none".into(),
            history: MeshHistory { passes: Vec::new(), boundaries: Vec::new(), ascended: false, preconditioning },
        }
    }
}

/// What no contact boundary changes.
struct Bodies {
    /// The bodies without contact; only where boundaries follow the solution, otherwise the system holds them.
    elastic: Option<Elastic>,
    interpolations: Rc<[Interpolation]>,
}

/// What was done on a mesh so far, and what it took.
pub struct MeshHistory {
    pub passes: Vec<Pass>,
    pub boundaries: Vec<BoundaryStep>,
    /// Whether an active set was found by rising energy only.
    pub ascended: bool,
    /// The preconditioner that it needed.
    pub preconditioning: Preconditioning,
}

/// What follows from the solves on one boundary.
enum After {
    /// Everything is done.
    Ended(Ending),
    /// The bodies have moved, and so must the boundary.
    Moved {
        contacts: Vec<Contact>,
        motion: BoundaryMotion,
        start: Start,
        /// Whether it is nearly where it was.
        is_near: bool,
    },
}

impl OneMesh<'_> {
    /// Solves, once or for one contact boundary after the other. A start comes from the programme or a mesh before, and
    /// its boundaries are settled. What nothing loads, moves or presses is not solved: it stays as it is drawn. **Collective**
    pub fn solve(
        &self,
        problem: &mut Discretisation,
        start: Option<Start>,
        preconditioning: Preconditioning,
    ) -> Result<OnMesh, SystemError> {
        if !problem.scene.is_driven(&problem.finest().numbering) {
            return Ok(OnMesh::at_rest(problem, preconditioning));
        }
        let bodies = self.bodies(problem)?;
        if problem.follows() {
            return self.follow(problem, &bodies, start, preconditioning);
        }
        self.begin(None);
        let mut system = self.system(problem, &bodies, preconditioning)?;
        let first = LoopPosition { boundary: 1, passes: 0, is_near: false, is_hard: self.is_hard };
        let LoopOutcome { solution, ending, passes, ascended } = self.sets(&mut system, start, self.tolerance, first)?;
        let solution = self.finished(&mut system, solution, &ending, ascended)?;
        let history = MeshHistory { passes, boundaries: Vec::new(), ascended, preconditioning: system.preconditioning() };
        let solver = system.solver_name().to_string();
        drop(system);
        settle(problem, &solution)?;
        Ok(OnMesh { solution, ending, solver, history })
    }

    /// Solves, lets the boundaries follow, and solves again, until everything stands. **Collective**
    fn follow(
        &self,
        problem: &mut Discretisation,
        bodies: &Bodies,
        mut start: Option<Start>,
        preconditioning: Preconditioning,
    ) -> Result<OnMesh, SystemError> {
        let exact = self.tolerance.residual().min(ON_THE_WAY);
        let mut following = Following::new(problem, exact, start.is_some(), self.is_last, self.procedure.accuracy);
        self.begin(Some(following.tolerances()));
        let mut history = MeshHistory { passes: Vec::new(), boundaries: Vec::new(), ascended: false, preconditioning };
        let mut is_last = false;
        loop {
            let system = self.system(problem, bodies, history.preconditioning)?;
            let (solution, solver, after) = self.on_boundary(system, start.take(), is_last, &mut following, &mut history)?;
            match after {
                After::Ended(ending) => {
                    problem.contacts.iter_mut().zip(following.found).for_each(|(contact, ends)| contact.found = Some(ends));
                    settle(problem, &solution)?;
                    return Ok(OnMesh { solution, ending, solver, history });
                }
                After::Moved { contacts, motion, start: next, is_near } => {
                    let _stage = self.procedure.observer.enter(Work::Contact);
                    problem.replace(contacts, motion)?;
                    (start, is_last) = (Some(next), is_near);
                }
            }
        }
    }

    /// The system of a solution once more, for other right-hand sides. **Collective**
    pub fn system_again<'a>(
        &self,
        problem: &'a Discretisation,
        active: &[bool],
        preconditioning: Preconditioning,
    ) -> Result<System<'a>, SystemError> {
        let mut system = self.system(problem, &self.bodies(problem)?, preconditioning)?;
        system.set_active(active)?;
        Ok(system)
    }

    fn begin(&self, follows: Option<[f64; 2]>) {
        if self.is_last {
            self.procedure.observer.observe(Event::Begin(follows));
        }
    }

    /// Assembles and sets up what all contact boundaries share. **Collective**
    fn bodies(&self, problem: &Discretisation) -> Result<Bodies, SystemError> {
        let Procedure { choice, observer, .. } = self.procedure;
        let mut bodies = Bodies { elastic: None, interpolations: Rc::new([]) };
        if problem.follows() {
            let _stage = observer.enter(Work::Assembly);
            let load = load(problem, &nodal_forces(problem)?);
            bodies.elastic = Some(Elastic::alone(problem, load, choice.form())?);
        }
        if choice.form() == Form::Augmented {
            let _stage = observer.enter(Work::SetUp);
            bodies.interpolations = interpolations(problem).into();
        }
        Ok(bodies)
    }

    /// Assembles and sets up the system of the contact boundaries as they are. **Collective**
    fn system<'a>(
        &self,
        problem: &'a Discretisation,
        bodies: &Bodies,
        preconditioning: Preconditioning,
    ) -> Result<System<'a>, SystemError> {
        let Procedure { choice, session, observer, .. } = self.procedure;
        let blocks = {
            let _stage = observer.enter(Work::Assembly);
            match &bodies.elastic {
                Some(elastic) => SaddlePoint::around(problem, elastic, choice.form())?,
                None => {
                    let load = load(problem, &nodal_forces(problem)?);
                    SaddlePoint::new(problem, load, choice.form())?
                }
            }
        };
        let _stage = observer.enter(Work::SetUp);
        let system = System::new(problem, blocks, &bodies.interpolations, *choice, preconditioning)?;
        // Coarser meshes may have no use for what the mesh of the case asks for.
        let unused = if self.is_last { options::unused(session)? } else { Vec::new() };
        if unused.is_empty() { Ok(system) } else { Err(SystemError::UnusedOptions(unused)) }
    }

    /// Solves for one active set after the other. **Collective**
    fn sets(
        &self,
        system: &mut System,
        start: Option<Start>,
        tolerance: Tolerance,
        position: LoopPosition,
    ) -> Result<LoopOutcome, SystemError> {
        let observer = self.procedure.observer;
        let _stage = observer.enter(Work::Solve);
        let all = system.active().len();
        ContactLoop::begin(system, start, tolerance, position)?.solve(|pass| {
            if self.is_last {
                observer.observe(Event::Passed(pass, all));
            }
        })
    }

    /// A solution with what else the last system tells, if it is wanted: the inf-sup constants of its contacts. **Collective**
    fn finished(
        &self,
        system: &mut System,
        mut solution: Solution,
        ending: &Ending,
        ascended: bool,
    ) -> Result<Solution, SystemError> {
        let _stage = self.procedure.observer.enter(Work::Solve);
        if self.is_last && self.procedure.wants_inf_sup(system.problem(), ascended || !ending.is_converged()) {
            solution.inf_sup = system.inf_sup()?;
        }
        Ok(solution)
    }

    /// The solves on one boundary of those that follow: on the way, unless the solve is the last one, and again as the last one if
    /// everything stands. The solution, what solved it, in words, and what follows. **Collective**
    fn on_boundary(
        &self,
        mut system: System,
        mut start: Option<Start>,
        is_last: bool,
        following: &mut Following,
        history: &mut MeshHistory,
    ) -> Result<(Solution, String, After), SystemError> {
        let exact = following.tolerance;
        let mut is_last = is_last || exact >= ON_THE_WAY;
        loop {
            let tolerance = Tolerance::Residual(if is_last { exact } else { ON_THE_WAY });
            let boundary = history.boundaries.len() + 1;
            let position = LoopPosition { boundary, passes: history.passes.len(), is_near: is_last, is_hard: self.is_hard };
            let LoopOutcome { solution, ending, passes, ascended } = self.sets(&mut system, start.take(), tolerance, position)?;
            history.passes.extend(passes);
            let after = match ending {
                Ending::NotConverged(_) => After::Ended(ending),
                Ending::Converged(standing) => {
                    match self.next(system.problem(), &solution, standing, is_last, following, history)? {
                        Some(after) => after,
                        None => {
                            // The boundary is right, but it was found with a solve on the way.
                            (start, is_last) = (Some(start_from(&solution)), true);
                            continue;
                        }
                    }
                }
            };
            let solution = match &after {
                After::Ended(ending) => self.finished(&mut system, solution, ending, ascended)?,
                After::Moved { .. } => solution,
            };
            history.ascended |= ascended;
            history.preconditioning = system.preconditioning();
            return Ok((solution, system.solver_name().to_string(), after));
        }
    }

    /// What follows from a solution; nothing if it is to be solved once more, as the last one. **Collective**
    fn next(
        &self,
        problem: &Discretisation,
        solution: &Solution,
        within: Standing,
        is_last: bool,
        following: &mut Following,
        history: &mut MeshHistory,
    ) -> Result<Option<After>, SystemError> {
        let observer = self.procedure.observer;
        let followed = {
            let _stage = observer.enter(Work::Contact);
            following.next(problem, solution, history.boundaries.len() + 1)
        };
        let (step, next) = match followed {
            Ok(followed) => followed,
            Err(SystemError::Case(words)) => {
                return Ok(Some(After::Ended(Ending::NotConverged(Failure::BoundaryLost(words)))));
            }
            Err(error) => return Err(error),
        };
        if matches!(next, NextBoundary::Stands(_)) && !is_last {
            return Ok(None);
        }
        if self.is_last {
            observer.observe(Event::Placed(&step));
        }
        // A contact may be so small beside all that moves that a solve on the way leaves it as it was, and its ends stray.
        let is_near = step.moved.is_some_and(|way| way < NEARLY) || step.du.is_some_and(|du| du < STILL);
        history.boundaries.push(step);
        Ok(Some(match next {
            NextBoundary::Stands(way) => {
                After::Ended(Ending::Converged(standing(&problem.contacts, &history.boundaries, way, within)))
            }
            NextBoundary::GivenUp(failure) => After::Ended(Ending::NotConverged(failure)),
            NextBoundary::Again(contacts, motion) => {
                let start = carried(&problem.contacts, &contacts, solution);
                After::Moved { contacts, motion, start, is_near }
            }
        }))
    }
}
