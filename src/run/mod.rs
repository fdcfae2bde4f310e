//! From a case to its result.

mod accuracy;
mod check;
mod drawing;
mod exact;
mod expected;
mod fields;
mod figures;
mod first_case;
mod forecast;
mod info;
mod input;
pub mod interruption;
mod known;
mod means;
mod memory;
mod observe;
mod origin;
mod outcome;
mod points;
mod progress;
mod proposals;
mod report;
mod results;
mod run_options;
mod scene;
mod slits;
mod slivers;
mod stages;
mod steps;
mod summarise;
mod true_errors;
mod trust;
mod turns;
mod unresolved;
mod zones;

pub use check::{Checked, check, check_file};
pub use drawing::draw_case;
pub use first_case::{FirstCase, first_case, path_from};
pub use forecast::remedy as out_of_memory_remedy;
pub use info::{info, version};
pub use input::read_case;
pub use outcome::{Outcome, RunError};
pub use run_options::RunOptions;

use crate::case::Case;
use crate::petsc::{self, Session};
use crate::system::Scene;
use origin::ResultOrigin;
use report::Report;
use stages::Stages;
use std::cell::RefCell;
use std::ffi::OsString;
use std::os::unix::ffi::OsStringExt;
use std::path::PathBuf;
use std::rc::Rc;
use std::sync::Arc;

/// Solves a case and writes its results. **Collective**
///
/// # Errors
/// [`RunError`] if there is no result at all; nothing is left on the disk then.
pub fn run(case: &Case, options: &RunOptions, session: &Session) -> Result<Outcome, RunError> {
    let started = start(case, options, session);
    progress::end();
    started.map_err(|error| {
        interruption::abandon();
        error.in_case(case)
    })
}

fn start(case: &Case, options: &RunOptions, session: &Session) -> Result<Outcome, RunError> {
    refuse_options(session)?;
    let origin = ResultOrigin::new(case, session);
    let files = claim_folder(case, options, &origin, session)?;
    progress::begin(options.progress, session.rank() == 0, options.quiet, options.started);
    let report = Report::new(case, options, session);
    let stages = Rc::new(Stages::new(session)?);
    report.start(case);
    turns::far_turns(case).iter().for_each(|words| report.warn(words));
    let (scene, origin) = read_scene(case, options, origin, &stages, &report, session)?;
    let run = Run { case, options, session, stages, report, files, origin, draws: true, true_errors: RefCell::default() };
    if !case.steps.is_empty() {
        return run.finish(run.solve_steps(&scene)?, &scene.mesh);
    }
    let solved = run.solve(scene, None)?;
    let summary = run.summarise(&solved)?;
    run.finish(summary, &solved.problem.scene.mesh)
}

/// Outer methods that the systems can be solved with; what else PETSc has wants another side, norm or start.
const METHODS: [&str; 16] = [
    "gmres",
    "fgmres",
    "lgmres",
    "dgmres",
    "pgmres",
    "pipefgmres",
    "gcr",
    "bcgs",
    "fbcgs",
    "fbcgsr",
    "bcgsl",
    "pipebcgs",
    "qmrcgs",
    "tfqmr",
    "tcqmr",
    "cgs",
];

/// What the case says is not said again to PETSc, and what would end in one of its crashes is not said at all.
fn refuse_options(session: &Session) -> Result<(), RunError> {
    const REFUSED: [(&str, &str); 4] = [
        ("-ksp_rtol", "has no effect here: give `--set solver.tolerance=...`"),
        ("-ksp_max_it", "has no effect here: it is 300; a solve that needs more has failed"),
        ("-fieldsplit_u_pc_mg_levels", "cannot be: the levels are those of the mesh; give `--set mesh.refine=...`"),
        ("-fp_trap", "cannot be: infinite values are looked at where they arise, and are no errors"),
    ];
    if let Some((name, why)) = REFUSED.iter().find(|(name, _)| petsc::options::get(session, name).is_some()) {
        return Err(RunError::Input(format!("PETSc option {name} {why}")));
    }
    match petsc::options::get(session, "-ksp_type").filter(|method| !METHODS.contains(&method.to_lowercase().as_str())) {
        None => Ok(()),
        Some(method) => Err(RunError::Input(format!(
            "PETSc option -ksp_type {method}: the outer method is one that takes a nonsymmetric preconditioner from the right and an initial guess: {}",
            METHODS.join(", ")
        ))),
    }
}

/// The folder of the results, made by rank 0: the place that all ranks write to until it is whole. **Collective**
fn claim_folder(case: &Case, options: &RunOptions, origin: &ResultOrigin, session: &Session) -> Result<PathBuf, RunError> {
    let create = || interruption::begin(case, options, origin).map(|files| files.into_os_string().into_vec());
    let files = PathBuf::from(OsString::from_vec(session.share(create).map_err(RunError::Input)?));
    interruption::keep_place(&options.out, &files);
    Ok(files)
}

/// A run on its way.
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

/// Reads the mesh and spreads it. A case that lies beside its own result is told to repeat it, and must have its mesh. **Collective**
fn read_scene(
    case: &Case,
    options: &RunOptions,
    origin: ResultOrigin,
    stages: &Stages,
    report: &Report,
    session: &Session,
) -> Result<(Scene, Arc<ResultOrigin>), RunError> {
    let _stage = stages.mesh.enter();
    let bytes = input::share_mesh(case, options.inputs.as_ref(), session)?;
    let origin = if session.rank() == 0 { origin.with_mesh(case, bytes.clone(), &options.out) } else { origin };
    let before = if session.rank() == 0 { origin::result_before(case, &bytes) } else { Ok(None) };
    let before = session.agree(before).map_err(RunError::Input)?;
    if let Some(before) = before {
        report.repeats(&origin.provenance, &before, case);
    }
    let origin = Arc::new(origin);
    interruption::keep_origin(origin.clone());
    let mesh = input::parse_mesh(case, &bytes, session)?;
    slits::slits(&mesh).iter().for_each(|words| report.warn(words));
    Ok((scene::spread(case, mesh, session)?, origin))
}
