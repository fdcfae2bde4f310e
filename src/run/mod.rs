//! From a case to its result.
//!
//! In comes a checked case, out comes a folder with its result, and a [`Status`] that becomes the exit code. `reading` makes a scene
//! of the files, `result` has it solved and writes the folder, with what `summary` and `verdict` say of the solution; `telling` is
//! what is printed on the way, and what a signal leaves. `checking` has the commands that solve nothing, `accuracy` what is said of
//! an accuracy, `memory` whether there is enough of it. How the program solves is none of its business: it names twelve items of
//! the floors that do.
//!
//! # Errors, and the end of ranks
//!
//! - Rank 0 alone reads files; `Session::share` sends their bytes to all (or its error), and each rank works on the same ones.
//!   Ranks with other words on their command line than rank 0 do not start.
//! - Bad input is found as early as it can be and on all ranks alike: each rank checks for itself, `Session::agree` makes one
//!   outcome of it, rank 0 prints, all end with 2. Nothing is left on the disk. A rank with such an error waits for the others by
//!   `Session::meet`; if they do not come within seconds, it speaks and ends them.
//! - A failure of PETSc comes back as an `Err` with its deepest message. A linear solver that gives up is a verdict, not an
//!   error: PETSc returns 0 for it, so the reason is always read.
//! - An error that one rank alone has, and a panic on any rank (by a hook), is printed and ends all with `MPI_Abort`; until
//!   then nothing of PETSc's is given back, since that can take all ranks (a factor of MUMPS). PETSc's signal handler is off.
//! - A signal that ends a run (SIGTERM, SIGINT, SIGHUP) may come to any rank at any moment, and mpirun kills all ranks a second
//!   later: too short for an agreement in mid-solve. So nothing is agreed on. Each rank has a thread that waits for signals. That
//!   of rank 0 owns what is known so far and the unfinished folder, behind a lock: it writes `summary.json` with `status`
//!   `interrupted`, gives the folder its name and ends the process, which ends all others; a result that is being put in its
//!   place first is left to be. Other ranks wait for that, clear away what a dead rank 0 has left, and end. A rank that has
//!   failed leaves a file `failed` in the hidden folder before it ends all: the SIGTERM that rank 0 gets from mpirun then is no
//!   interruption, and the folder goes.
//! - The same command on as many ranks gives the same digits: sums over ranks have a fixed order, and the partition one seed.
//!   What several ranks know of one node its owner adds up in the order of the ranks (`Session::add_to_owners`), not in that of
//!   the messages. The exception is a factor that several ranks make together (MUMPS: `solver.name = "direct"`, the last fallback
//!   of `fieldsplit` and inf-sup constants, above 10 000 unknowns): contributions are added as their messages come, which MUMPS
//!   cannot change, and runs differ in the last digits (1e-15 of the energy). A factor by each rank for itself would not (`--
//!   -pc_type redundant -redundant_pc_type cholesky -redundant_pc_factor_mat_solver_type mumps`); it takes 1.7 times the time to
//!   set up and 1.7 times the memory of each rank at 264 thousand unknowns on 2 ranks, and more on more of them. Up to 10 000
//!   unknowns it is taken.
//! - A result holds what made it (`run/reading/origin.rs`): `provenance` in its summary, the resolved case, and the bytes of the mesh
//!   that rank 0 has read, up to 4 MiB. A case that lies beside a summary with its own hash is a repeat: another mesh is refused,
//!   and what else differs is said. What is told of host, date and command stands in `provenance` alone, so that summaries
//!   compare without it. The hash is SHA-256 because people have `sha256sum`; the 64 bits of `fingerprint` go on telling a study
//!   its own runs.
//! - The line that says where a run is (`run/telling/progress.rs`) is written by a thread of rank 0, which reads what the run notes:
//!   the work that begins, events of the procedure, and by a monitor of PETSc's the residual of each iteration. So it lives on in
//!   the longest assembly, asks nothing of other ranks, and changes no digit. Whatever else is printed takes the line away first,
//!   under one lock. Under mpirun standard error is a pipe: the terminal is looked for where mpirun's own leads to, in /proc.
//! - Not converged, a mechanism, or a missed value that must hold: exit code 3, with a `summary.json` that says why.
//! - `Session::end`, or dropping the last `Session`, ends PETSc, then MPI. Every wrapper holds one. PETSc may fail at its start
//!   or its end on one rank alone, where it opens the file of an option: that rank speaks and ends all, for MPI's own end would
//!   wait for ranks that PETSc has left in the middle. A failure at the end is exit code 1 though the result stands: something
//!   that was asked for is missing. Where PETSc ends the process itself (`-help intro`), the exit code is 1 too.
//! - A result is written to a folder with a name of its own (host, process, random number) beside the target, which rank 0
//!   makes and tells the others. At the end it takes the target's name in one step: `rename` onto nothing or an empty folder, an
//!   exchange (`renameat2`) with the result that stood there at the start; two steps where the file system has no exchange.
//!   Whoever finds another result there than at the start is told, and ends with 1; where the folder refuses what a result cannot
//!   do without, the result goes to the working directory, or to that for temporary files. What a killed run leaves is removed by the
//!   next one into that target if its maker is known to be dead: same host, no such process, no lock on the folder. Elsewhere it
//!   stays.
//! - A study gives each run the fingerprints of its case file and mesh (`--inputs`); a run that reads others ends with 1, and
//!   so its row says that it failed. The study itself looks whether its program and PETSc's option files are still what they
//!   were.

mod accuracy;
mod checking;
mod memory;
mod outcome;
mod reading;
mod result;
mod run_options;
mod summary;
mod telling;
mod verdict;
mod words;

pub use checking::{Checked, FirstCase, check, check_file, draw_case, first_case, info, path_from, version};
pub use outcome::out_of_memory_remedy;
pub use reading::read_case;
pub use run_options::RunOptions;
pub use telling::interruption;

use crate::case::Case;
use crate::discretisation::Scene;
use crate::output::RunError;
use crate::output::summary::Status;
use crate::petsc::Session;
use reading::options::refuse_options;
use reading::origin::{self, ResultOrigin};
use std::cell::RefCell;
use std::ffi::OsString;
use std::os::unix::ffi::OsStringExt;
use std::path::PathBuf;
use std::rc::Rc;
use std::sync::Arc;
use telling::progress;
use telling::report::{Report, Stages};

/// Solves a case and writes its results. **Collective**
///
/// # Errors
/// [`RunError`] if there is no result at all; nothing is left on the disk then.
pub fn run(case: &Case, options: &RunOptions, session: &Session) -> Result<Status, RunError> {
    let started = start(case, options, session);
    progress::end();
    started.map_err(|error| {
        interruption::abandon();
        error.in_case(case)
    })
}

fn start(case: &Case, options: &RunOptions, session: &Session) -> Result<Status, RunError> {
    refuse_options(session)?;
    let origin = ResultOrigin::new(case, session);
    let files = claim_folder(case, options, &origin, session)?;
    progress::begin(options.progress, session.rank() == 0, options.quiet, options.started);
    let (report, origin) = (Report::new(case, options, session), Arc::new(origin));
    let stages = Rc::new(Stages::new(session)?);
    report.start(case);
    verdict::warnings::before::far_turns(case).iter().for_each(|words| report.warn(words));
    let mut run = Run { case, options, session, stages, report, files, origin, draws: true, true_errors: RefCell::default() };
    let scene = run.read_scene()?;
    if !case.steps.is_empty() {
        return run.finish(run.solve_steps(&scene)?, &scene.mesh);
    }
    let solved = run.solve(scene, None)?;
    let summary = run.summarise(&solved)?;
    run.finish(summary, &solved.problem.scene.mesh)
}

/// The folder of the results, made by rank 0: the place that all ranks write to until it is whole. **Collective**
fn claim_folder(case: &Case, options: &RunOptions, origin: &ResultOrigin, session: &Session) -> Result<PathBuf, RunError> {
    let create = || interruption::begin(case, options, origin).map(|files| files.into_os_string().into_vec());
    let files = PathBuf::from(OsString::from_vec(session.share(create).map_err(RunError::Input)?));
    interruption::keep_place(&options.out, &files);
    Ok(files)
}

/// A run on its way.
#[derive(Clone)]
struct Run<'a> {
    case: &'a Case,
    options: &'a RunOptions,
    session: &'a Session,
    stages: Rc<Stages>,
    report: Report,
    /// Where all ranks write their files to.
    files: PathBuf,
    /// What the result is made of.
    origin: Arc<ResultOrigin>,
    /// Whether figures are drawn of it: not of every load step.
    draws: bool,
    /// On each mesh that was adapted, the true error of each goal as far as the case tells it.
    true_errors: RefCell<Vec<Vec<Option<f64>>>>,
}

impl Run<'_> {
    /// Reads the mesh and spreads it. A case that lies beside its own result is told to repeat it, and must have its mesh. **Collective**
    fn read_scene(&mut self) -> Result<Scene, RunError> {
        let Self { case, options, session, stages, report, origin, .. } = self;
        let _stage = stages.mesh.enter();
        let bytes = reading::input::share_mesh(case, options.inputs.as_ref(), session)?;
        if session.rank() == 0 {
            Arc::make_mut(origin).add_mesh(case, bytes.clone(), &options.out);
        }
        let before = if session.rank() == 0 { origin::result_before(case, &bytes) } else { Ok(None) };
        if let Some(before) = session.agree(before).map_err(RunError::Input)? {
            report.repeats(&origin.provenance, &before, case);
        }
        interruption::keep_origin(origin.clone());
        let mesh = session.agree(reading::scene::read_mesh(case, &bytes)).map_err(RunError::Input)?;
        verdict::warnings::before::slits(&mesh).iter().for_each(|words| report.warn(words));
        reading::scene::spread(case, mesh, session)
    }
}
