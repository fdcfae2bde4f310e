//! From a case to its result.

mod check;
mod exact;
mod fields;
mod report;
mod results;
mod scene;

pub use check::{check, info};

use crate::body;
use crate::case::Case;
use crate::contact::ActiveSet;
use crate::geometry::Point;
use crate::output::{OutputError, ResultFolder};
use crate::petsc::{self, Session, Stage};
use crate::system::{
    ContactLoop, Discretisation, Field, LinearSolver, SaddlePoint, Solution, SystemError, Verdict, bilateral, interpolation,
    spaces,
};
use report::Report;
use std::path::PathBuf;
use std::time::Instant;

/// How a run ended; becomes the exit code.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// Converged: 0.
    Converged,
    /// Not converged, a mechanism, or an expected value missed that must hold: 3.
    NotConverged,
}

/// Why there is no result.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RunError {
    /// The input cannot be used, on every rank alike: 2.
    #[error("{0}")]
    Input(String),
    /// PETSc, MPI or the disk failed, perhaps on this rank alone: 1.
    #[error("{0}")]
    Failed(String),
}

impl From<SystemError> for RunError {
    fn from(error: SystemError) -> Self {
        match error {
            SystemError::Case(words) => Self::Input(words),
            SystemError::Petsc(error) => Self::Failed(error.to_string()),
        }
    }
}

impl From<petsc::Error> for RunError {
    fn from(error: petsc::Error) -> Self {
        Self::Failed(error.to_string())
    }
}

impl From<OutputError> for RunError {
    fn from(error: OutputError) -> Self {
        match error {
            OutputError::Io { .. } | OutputError::Length { .. } | OutputError::Figure { .. } => Self::Failed(error.to_string()),
            refused => Self::Input(refused.to_string()),
        }
    }
}

/// Where results go and what is printed.
#[derive(Clone, Debug)]
pub struct RunOptions {
    /// Folder of the results.
    pub out: PathBuf,
    /// Replace a result that is there.
    pub force: bool,
    /// Print errors only.
    pub quiet: bool,
    /// When the program started.
    pub started: Instant,
}

/// Stages of a run, as the summary times them.
pub(crate) struct Stages {
    pub mesh: Stage,
    pub assemble: Stage,
    pub contact: Stage,
    pub setup: Stage,
    pub solve: Stage,
    pub output: Stage,
}

impl Stages {
    fn new(session: &Session) -> Result<Self, RunError> {
        let stage = |name| Stage::new(session, name);
        Ok(Self {
            mesh: stage("mesh")?,
            assemble: stage("assemble")?,
            contact: stage("contact")?,
            setup: stage("setup")?,
            solve: stage("solve")?,
            output: stage("output")?,
        })
    }
}

/// Solves a case and writes its results. **Collective**
///
/// # Errors
/// [`RunError`] if there is no result at all; nothing is left on the disk then.
pub fn run(case: &Case, options: &RunOptions, session: &Session) -> Result<Outcome, RunError> {
    let stages = Stages::new(session)?;
    let report = Report::new(case, options, session);
    let folder = claim_folder(options, session)?;
    report.start(case);
    let problem = set_up(case, &stages, session)?;
    report.sizes(&problem);
    let (solution, solver_name) = solve(case, &problem, &stages, &report, session)?;
    let outcome = results::write(case, options, &problem, &solution, &solver_name, &stages, &report, folder, session)?;
    Ok(outcome)
}

/// The folder of the results: made by rank 0, known to all. **Collective**
fn claim_folder(options: &RunOptions, session: &Session) -> Result<Option<ResultFolder>, RunError> {
    let folder = if session.rank() == 0 { ResultFolder::create(&options.out, options.force).map(Some) } else { Ok(None) };
    let refused = folder.as_ref().err().map(|error| error.to_string());
    match session.agree(refused.map_or(Ok(()), Err)) {
        Ok(()) => Ok(folder?),
        Err(words) => Err(RunError::Input(words)),
    }
}

/// Reads the mesh, spreads it, and couples the contacts. **Collective**
fn set_up(case: &Case, stages: &Stages, session: &Session) -> Result<Discretisation, RunError> {
    let (scene, spaces) = {
        let _stage = stages.mesh.enter();
        let mesh = session.agree(scene::read_mesh(case)).map_err(RunError::Input)?;
        let scene = scene::spread(case, mesh, session)?;
        let spaces = spaces(&scene, session.rank())?;
        (scene, spaces)
    };
    let _stage = stages.contact.enter();
    Ok(Discretisation::new(scene, spaces, session)?)
}

/// Assembles and solves. A body that nothing holds is found before anything is assembled. **Collective**
fn solve(
    case: &Case,
    problem: &Discretisation,
    stages: &Stages,
    report: &Report,
    session: &Session,
) -> Result<(Solution, String), RunError> {
    let contact_loop = ContactLoop { problem, session };
    let mut set = ActiveSet::new(bilateral(&problem.contacts));
    if let Some(mechanism) = contact_loop.mechanism(set.active()) {
        let words = contact_loop.not_held(&mechanism, true);
        return Ok((Solution::nothing(Verdict::NotConverged(words), problem.finest(), set.active()), "none".into()));
    }
    let mut system = {
        let _stage = stages.assemble.enter();
        let load = nodal_load(problem, session)?;
        SaddlePoint::new(problem, load, set.active(), case.solver.choice.form(), session)?
    };
    let mut solver = {
        let _stage = stages.setup.enter();
        let steps = problem.spaces.windows(2).map(|pair| interpolation(&problem.scene, &pair[1], &pair[0], session));
        LinearSolver::new(&system, &steps.collect::<Result<Vec<_>, _>>()?, case.solver.choice, session)?
    };
    let unused = solver.unused_options()?;
    if !unused.is_empty() {
        return Err(RunError::Input(format!("PETSc options that nothing has used: {}; check their spelling", unused.join(", "))));
    }
    let _stage = stages.solve.enter();
    let count = problem.multiplier_count();
    let solution =
        contact_loop.solve(&mut system, &mut solver, &mut set, case.solver.tolerance, |step| report.step(step, count))?;
    Ok((solution, solver.name))
}

/// Nodal forces of this rank's unknowns, in the nodes' frames, zero where displacement is prescribed. **Collective**
fn nodal_load(problem: &Discretisation, session: &Session) -> Result<Vec<f64>, RunError> {
    let (scene, space) = (&problem.scene, problem.finest());
    let mut forces = Field::<2>::zeros(problem, session);
    let applied = body::applied_forces(
        &scene.mesh,
        &scene.partition,
        session.rank(),
        &space.numbering,
        &scene.bodies,
        &scene.loads,
        |node, force| {
            let sum = forces.at_mut(node);
            sum[0] += force.x;
            sum[1] += force.y;
        },
    );
    session.agree(applied.map_err(SystemError::from)).map_err(RunError::Input)?;
    let forces = forces.sum(session)?;
    let frame = |(node, [x, y]): (usize, &[f64; 2])| {
        let force = space.free(node, Point::new(*x, *y));
        [force.x, force.y]
    };
    Ok(space.own.clone().zip(forces.own()).flat_map(frame).collect())
}
