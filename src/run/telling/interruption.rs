//! Runs that a signal ends: Slurm's time limit, Ctrl-C, a terminal that is closed.
//!
//! A thread waits for signals, since the ranks may be anywhere in a library when one comes, each at another moment, and mpirun
//! kills them a second later. That of rank 0 writes what was reached until then; those of the others wait for this, and make sure
//! that all ends. What is known is kept as the run goes on, in `Unfinished`.

use super::progress;
use crate::accuracy::Adaptation;
use crate::case::Case;
use crate::output::report::{ReportPage, write_report};
use crate::output::summary::{Mesh, Status, StepSummary, Summary, Time, Unknowns};
use crate::output::{OutputError, ResultFolder, recover};
use crate::procedure::{Event, Work};
use crate::run::accuracy;
use crate::run::reading::origin::ResultOrigin;
use crate::run::run_options::RunOptions;
use crate::run::summary::whole::described;
use crate::run::words::doing;
use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM, SIGXFSZ};
use signal_hook::iterator::Signals;
use signal_hook::low_level::{exit, signal_name};
use std::fs;
use std::io::Write;
use std::panic;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

/// Within this time a signal that comes again is the same one: mpirun, `timeout` and a terminal may each send it.
const SAME: Duration = Duration::from_millis(500);
/// How long other ranks wait for rank 0 before they look whether it is dead, and how long before they end themselves; rank 0
/// itself waits so long for the end of a run whose result is written.
const LOOK: Duration = Duration::from_millis(300);
const PATIENCE: Duration = Duration::from_secs(2);

/// A file in the unfinished folder: some rank has failed, and the signals that follow are mpirun's.
const FAILED: &str = "failed";

/// What rank 0 would write if it were interrupted now. None before there is a folder, and from the end of the run on.
static UNFINISHED: Mutex<Option<Unfinished>> = Mutex::new(None);

/// The target, and where all ranks write their files to; known on every rank.
static PLACE: OnceLock<(PathBuf, PathBuf)> = OnceLock::new();

/// Whether the run is at its end, with a result or with an error: a signal has nothing to add.
static OVER: AtomicBool = AtomicBool::new(false);

/// A result on its way.
struct Unfinished {
    folder: ResultFolder,
    /// What it is made of, as far as it is known.
    origin: Arc<ResultOrigin>,
    summary: Summary,
    /// What the run is doing, in words that follow *while*.
    doing: &'static str,
    started: Instant,
    out: PathBuf,
    /// What was warned of.
    warnings: Vec<String>,
    /// Title of the case, if the run leaves a report.
    title: Option<String>,
}

/// From now on signals end this process in order; those that its parent has told it to ignore are ignored. Files that grow
/// beyond a limit (`ulimit -f`) are errors of their writers, and no end.
///
/// # Errors
/// The operating system refuses.
pub fn watch(is_first_rank: bool) -> std::io::Result<()> {
    let before = panic::take_hook();
    panic::set_hook(Box::new(move |panic| {
        abandon_alone();
        before(panic);
    }));
    let ignored = fs::read_to_string("/proc/self/status").map_or(0, |status| ignored(&status));
    let ends = [SIGINT, SIGTERM, SIGHUP].into_iter().filter(|signal| ignored & (1 << (signal - 1)) == 0);
    let mut signals = Signals::new(ends.chain([SIGXFSZ]))?;
    let wait = move || {
        let mut first: Option<Instant> = None;
        for signal in signals.forever().filter(|signal| *signal != SIGXFSZ) {
            match first {
                None => {
                    first = Some(Instant::now());
                    thread::spawn(move || end(signal, is_first_rank));
                }
                Some(first) if first.elapsed() > SAME => exit(1),
                Some(_) => {}
            }
        }
    };
    thread::Builder::new().name("signals".into()).spawn(wait).map(drop)
}

/// The set of signals that a process ignores, from its `/proc/self/status`: bit `n - 1` for signal `n`.
fn ignored(status: &str) -> u64 {
    let set = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    set.and_then(|set| u64::from_str_radix(set.trim(), 16).ok()).unwrap_or(0)
}

/// Ends this process, and all ranks with it.
fn end(signal: i32, is_first_rank: bool) -> ! {
    let name = signal_name(signal).unwrap_or("a signal");
    if is_first_rank {
        match lock().take() {
            Some(unfinished) => say(&unfinished.interrupt(name)),
            None if !OVER.load(Ordering::Relaxed) => say(&format!("interrupted by {name} before anything was begun")),
            // The result is written, or the words of an error are being said.
            None => thread::sleep(PATIENCE),
        }
        exit(1)
    }
    thread::sleep(LOOK);
    if let Some((out, _)) = PLACE.get() {
        recover(out);
    }
    thread::sleep(PATIENCE - LOOK);
    exit(1)
}

/// Ends this process without anything that is due at its end.
pub fn exit_at_once() -> ! {
    exit(1)
}

fn say(words: &str) {
    progress::end_at_once();
    let _ = std::io::stderr().write_all(format!("mezha: {words}\n").as_bytes());
}

/// The lock is never held where anything can fail that is not told otherwise.
fn lock() -> MutexGuard<'static, Option<Unfinished>> {
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Makes the folder of the results, and keeps it until [`finish`]: on rank 0 alone. A signal comes before or after. Returns the
/// place that all ranks write to until the folder is whole.
///
/// # Errors
/// Those of [`ResultFolder::create`].
pub fn begin(case: &Case, options: &RunOptions, origin: &ResultOrigin) -> Result<PathBuf, OutputError> {
    let mut unfinished = lock();
    let folder = ResultFolder::create(&options.out, options.force)?;
    let files = folder.temporary().to_path_buf();
    *unfinished = Some(Unfinished {
        folder,
        summary: Summary::new(&case.name, origin.provenance.ranks),
        origin: Arc::new(origin.clone()),
        doing: "reading the mesh",
        started: options.started,
        out: options.out.clone(),
        warnings: Vec::new(),
        title: case.output.fields.then(|| case.title.clone()),
    });
    Ok(files)
}

/// Every rank learns where results go, and where all write to until then.
pub fn keep_place(out: &Path, files: &Path) {
    let _ = PLACE.set((out.to_path_buf(), files.to_path_buf()));
}

fn keep(change: impl FnOnce(&mut Unfinished)) {
    if let Some(unfinished) = &mut *lock() {
        change(unfinished);
    }
}

/// Keeps what the result is made of.
pub fn keep_origin(origin: Arc<ResultOrigin>) {
    keep(|unfinished| unfinished.origin = origin);
}

/// Keeps what an event tells.
pub fn observe(event: &Event, case: &Case) {
    keep(|unfinished| unfinished.observe(event, case));
}

/// Keeps the load steps that are solved.
pub fn keep_steps(rows: &[StepSummary]) {
    keep(|unfinished| {
        unfinished.forget_passes();
        unfinished.summary.steps = Some(rows.to_vec());
    });
}

/// Keeps a warning, each once.
pub fn keep_warning(words: &str) {
    keep(|Unfinished { warnings, .. }| {
        if !warnings.iter().any(|other| other == words) {
            warnings.push(words.into());
        }
    });
}

/// Keeps what is worked on.
pub fn enter(work: Work) {
    keep(|unfinished| unfinished.doing = doing(work));
}

/// Puts a whole result in its place with `write`, on rank 0; on other ranks there is nothing to do. A signal comes before or
/// after.
///
/// # Errors
/// Those of `write`.
pub fn finish(write: impl FnOnce(ResultFolder, &[String]) -> Result<(), OutputError>) -> Result<(), OutputError> {
    let mut unfinished = lock();
    OVER.store(true, Ordering::Relaxed);
    unfinished.take().map_or(Ok(()), |unfinished| write(unfinished.folder, &unfinished.warnings))
}

/// The run is at its end: what is there of a result that is not in its place is removed.
pub fn abandon() {
    OVER.store(true, Ordering::Relaxed);
    // A panic may have come while the lock was held.
    drop(UNFINISHED.try_lock().ok().and_then(|mut unfinished| unfinished.take()));
}

/// As [`abandon`], on a rank that has failed alone: rank 0 learns that the signals that follow are no interruption.
pub fn abandon_alone() {
    abandon();
    if let Some((_, files)) = PLACE.get() {
        // Where the folder is no more, its maker knows already.
        let _ = fs::File::create_new(files.join(FAILED));
    }
}

impl Unfinished {
    fn observe(&mut self, event: &Event, case: &Case) {
        let summary = &mut self.summary;
        match event {
            Event::AtRest { scene, at_rest } => {
                summary.mesh = Mesh { order: Some(scene.order.degree() as u8), ..Mesh::default() };
                let multipliers: usize = at_rest.contacts.iter().map(|contact| contact.multipliers.count()).sum();
                summary.unknowns = Unknowns {
                    displacement: Some(2 * at_rest.numbering.node_count() as u64),
                    multiplier: Some(multipliers as u64),
                };
            }
            Event::Solver(_) | Event::Begin(_) | Event::Refinement { .. } => {}
            Event::Again { .. } => self.forget_passes(),
            Event::Coarse { solve, .. } => summary.solver.coarse.push((*solve).clone()),
            Event::Passed(pass, _) => {
                summary.outer.push((*pass).clone());
                summary.solver.iterations.push(pass.krylov_iterations);
                summary.solver.residual = Some(pass.residual);
            }
            Event::Placed(step) => summary.boundaries.push((*step).clone()),
            Event::Adapted { accuracy, mesh, solved, .. } => {
                *summary = described(std::mem::take(summary), case, solved);
                let one = Adaptation { meshes: vec![(*mesh).clone()], ..Adaptation::new((*accuracy).clone()) };
                summary.accuracy.get_or_insert_default().extend(accuracy::summarise(&one));
            }
        }
    }

    /// What was told of a load step that is over, or begins once more, is not of the next.
    fn forget_passes(&mut self) {
        let Summary { outer, boundaries, solver, .. } = &mut self.summary;
        outer.clear();
        boundaries.clear();
        solver.coarse.clear();
        solver.iterations.clear();
        solver.residual = None;
    }

    /// Makes what was reached the result, and gives the last words. If a rank has failed, there is none.
    fn interrupt(self, signal: &str) -> String {
        let Self { mut folder, origin, summary, doing, started, out, warnings, title } = self;
        if folder.path(FAILED).exists() {
            return format!("ended by {signal}, since another rank has failed");
        }
        if origin.provenance.mesh_hash.is_none() {
            // The mesh has not been read, so that there is no copy of it.
            folder.keep(Path::new(&origin.provenance.mesh_file));
        }
        let seconds = started.elapsed().as_secs_f64();
        let reached = reached(&summary);
        let reason = format!("interrupted by {signal} after {seconds:.1} s, while {doing}: {reached}");
        let (time_s, provenance) = (Time { total: Some(seconds), ..summary.time_s }, Some(origin.provenance.clone()));
        let summary = Summary { status: Status::Interrupted, reason: Some(reason.clone()), time_s, provenance, ..summary };
        let report = |title: &String| {
            let case = &origin.case;
            let page = ReportPage { title, summary: &summary, expected: &[], contacts: &[], warnings: &warnings, case };
            write_report(folder.temporary(), &page)
        };
        let written = folder
            .empty()
            .and_then(|()| origin.write(&folder))
            .and_then(|()| title.as_ref().map_or(Ok(()), report))
            .and_then(|()| folder.write_summary(&summary))
            .and_then(|()| folder.commit());
        match written {
            Ok(()) => format!("{reason}; summary.json in {} tells so", out.display()),
            Err(error) => format!("{reason}; {error}"),
        }
    }
}

/// How far a run has come that has no result.
fn reached(summary: &Summary) -> String {
    if let Some(steps) = &summary.steps {
        return format!("load steps solved: {}, and more are asked for", steps.len());
    }
    let meshes = summary.accuracy.as_ref().map_or(0, Vec::len);
    let passes = summary.outer.len();
    match (meshes, passes, summary.solver.coarse.len()) {
        (0, 0, 0) => "nothing is solved yet".into(),
        (0, 0, coarse) => format!("coarser meshes are solved ({coarse}), the mesh of the case is not"),
        (0, passes, _) => format!("active sets solved for: {passes}, and none is known to stand"),
        (meshes, ..) => format!("adapted meshes solved: {meshes}, and the accuracy is not reached"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ignored_signals_are_read() {
        let status = "SigBlk:\t0000000000000000\nSigIgn:\t0000000000000003\nSigCgt:\t0000000000000000\n";
        assert_eq!((ignored(status), ignored("")), (3, 0));
        assert_eq!((SIGHUP, SIGINT), (1, 2));
    }

    #[test]
    fn what_was_reached_is_told_with_the_signal() {
        let root = tempfile::tempdir().unwrap();
        let out = root.path().join("bars");
        let unfinished = || {
            let folder = ResultFolder::create(&out, true).unwrap();
            fs::write(folder.path("fields.vtu"), "half").unwrap();
            fs::create_dir_all(folder.path("steps/001")).unwrap();
            let mut summary = Summary::new("bars", 2);
            summary.solver.coarse.push(Default::default());
            Unfinished {
                folder,
                origin: Arc::default(),
                summary,
                doing: "solving",
                started: Instant::now(),
                out: out.clone(),
                warnings: vec!["a <warning>".into()],
                title: Some("Two <bars>".into()),
            }
        };
        let words = unfinished().interrupt("SIGTERM");
        assert!(words.starts_with("interrupted by SIGTERM after 0.0 s, while solving: coarser meshes are solved (1)"), "{words}");
        let written: serde_json::Value = serde_json::from_slice(&fs::read(out.join("summary.json")).unwrap()).unwrap();
        assert_eq!(written["status"], "interrupted");
        assert_eq!((written["outer"].as_array().unwrap().len(), fs::read_dir(&out).unwrap().count()), (0, 3));
        let page = fs::read_to_string(out.join("report.html")).unwrap();
        for words in ["Two &lt;bars&gt;", "Interrupted", "SIGTERM after 0.0 s", "a &lt;warning&gt;"] {
            assert!(page.contains(words), "{words}: {page}");
        }
        fs::remove_dir_all(&out).unwrap();
        let failed = unfinished();
        fs::write(failed.folder.path(FAILED), "").unwrap();
        assert!(failed.interrupt("SIGTERM").ends_with("another rank has failed"));
        assert_eq!(fs::read_dir(root.path()).unwrap().count(), 0, "no result, and no hidden folder");
    }
}
