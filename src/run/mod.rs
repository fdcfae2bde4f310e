//! From a case to its result.

mod check;
mod corners;
mod exact;
mod fields;
mod input;
mod observe;
mod report;
mod results;
mod scene;
mod summarise;
mod trust;
mod unresolved;
mod zones;

pub use check::{Checked, check, info};
pub use input::read_case;

use crate::case::{Case, Inputs};
use crate::output::{OutputError, ResultFolder};
use crate::petsc::{self, Session, Stage};
use crate::system::{Scene, SystemError};
use report::Report;
use std::ffi::OsString;
use std::os::unix::ffi::OsStringExt;
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
    /// The same, in words that begin with a key; the caller puts the case file before them.
    #[error("{0}")]
    Key(String),
    /// Somebody has changed the input, or has put another result where this one belongs; on every rank alike: 1.
    #[error("{0}")]
    Overtaken(String),
    /// PETSc, MPI or the disk failed, perhaps on this rank alone: 1.
    #[error("{0}")]
    Failed(String),
}

impl RunError {
    /// The exit code.
    pub fn code(&self) -> i32 {
        match self {
            Self::Input(_) | Self::Key(_) => 2,
            Self::Overtaken(_) | Self::Failed(_) => 1,
        }
    }

    /// With the case file before words that begin with a key.
    fn in_case(self, case: &Case) -> Self {
        match self {
            Self::Key(words) => Self::Input(format!("{}: {words}", case.file.display())),
            error => error,
        }
    }
}

impl From<SystemError> for RunError {
    fn from(error: SystemError) -> Self {
        match error {
            SystemError::Case(words) => Self::Key(words),
            error @ SystemError::UnusedOptions(_) => Self::Input(error.to_string()),
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
    /// What the run is to be made of; anything else is refused.
    pub inputs: Option<Inputs>,
    /// Replace a result that is there.
    pub force: bool,
    /// Print errors only.
    pub quiet: bool,
    /// When the program started.
    pub started: Instant,
}

/// Stages of a run, as the summary times them.
struct Stages {
    mesh: Stage,
    assemble: Stage,
    contact: Stage,
    setup: Stage,
    solve: Stage,
    output: Stage,
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
    start(case, options, session).map_err(|error| error.in_case(case))
}

fn start(case: &Case, options: &RunOptions, session: &Session) -> Result<Outcome, RunError> {
    refuse_options(session)?;
    let (folder, files) = claim_folder(options, session)?;
    let report = Report::new(options, session);
    let run = Run { case, options, session, stages: Stages::new(session)?, report, files };
    run.report.start(case);
    let scene = run.read_scene()?;
    let solved = run.solve(scene)?;
    run.write(&solved, folder)
}

/// What the case says is not said again to PETSc.
fn refuse_options(session: &Session) -> Result<(), RunError> {
    for (name, remedy) in
        [("-ksp_rtol", "give `--set solver.tolerance=...`"), ("-ksp_max_it", "it is 300; a solve that needs more has failed")]
    {
        if petsc::options::get(session, name).is_some() {
            return Err(RunError::Input(format!("PETSc option {name} has no effect here: {remedy}")));
        }
    }
    Ok(())
}

/// The folder of the results, made by rank 0, and the place that all ranks write to until it is whole. **Collective**
fn claim_folder(options: &RunOptions, session: &Session) -> Result<(Option<ResultFolder>, PathBuf), RunError> {
    let mut folder = None;
    let create = || ResultFolder::create(&options.out, options.force).map(|made| place(folder.insert(made)));
    let place = session.share(create).map_err(RunError::Input)?;
    Ok((folder, OsString::from_vec(place).into()))
}

/// The temporary place of a folder, as it is sent.
fn place(folder: &ResultFolder) -> Vec<u8> {
    folder.temporary().as_os_str().as_encoded_bytes().to_vec()
}

/// A run on its way.
struct Run<'a> {
    case: &'a Case,
    options: &'a RunOptions,
    session: &'a Session,
    stages: Stages,
    report: Report,
    /// Where all ranks write their files to.
    files: PathBuf,
}

impl Run<'_> {
    /// Reads the mesh and spreads it. **Collective**
    fn read_scene(&self) -> Result<Scene, RunError> {
        let _stage = self.stages.mesh.enter();
        let mesh = input::read_mesh(self.case, self.options.inputs.as_ref(), self.session)?;
        scene::spread(self.case, mesh, self.session)
    }
}
