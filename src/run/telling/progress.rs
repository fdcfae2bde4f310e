//! A line on a terminal that says where a long run is, rewritten in place; in a log, a pipe or a file, a line each minute.
//!
//! A thread of rank 0 writes it to standard error; the run itself only notes what it does. So there is a sign of life in the
//! longest assembly, and no digit depends on it.

use crate::accuracy::Adaptation;
use crate::arguments::ShowProgress;
use crate::output::clock;
use crate::petsc::{SolveAtWork, solve_at_work};
use crate::procedure::{Event, Work};
use crate::run::accuracy;
use rustix::fs::{Mode, OFlags};
use std::fs::File;
use std::io::{IsTerminal, Write, stderr};
use std::os::fd::AsFd;
use std::path::PathBuf;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

/// How often the line is written. A run that ends before shows nothing.
const PULSE: Duration = Duration::from_millis(500);
const FIRST: Duration = Duration::from_secs(1);

/// How often a log has a line: a job of hours has hundreds.
const IN_LOG: Duration = Duration::from_secs(60);

/// Columns of a terminal that does not tell how many it has.
const COLUMNS: usize = 80;

/// What takes a line off a terminal.
const ERASE: &str = "\r\x1b[K";

/// Where a run is.
#[derive(Clone, Debug, Default)]
struct RunPlace {
    /// What is done, a part of the procedure or (none) the writing of files, and since when.
    doing: Option<(Option<Work>, Instant)>,
    /// Load step, and how many there are.
    step: Option<(usize, usize)>,
    /// The meshes that were adapted so far.
    adaptation: Option<Adaptation>,
    /// Number of the mesh that is worked on, from the second on.
    mesh: Option<usize>,
    /// Refinement that is solved, and that of the case.
    refine: Option<(usize, usize)>,
    boundary: Option<usize>,
    set: Option<usize>,
}

/// A line that is shown while this is there.
struct ProgressLine {
    started: Instant,
    /// Where it is read, if that is known.
    terminal: Option<File>,
    place: RunPlace,
    visible: bool,
    /// Whether each line stays, one below the other.
    is_log: bool,
}

static LINE: Mutex<Option<ProgressLine>> = Mutex::new(None);

fn lock() -> MutexGuard<'static, Option<ProgressLine>> {
    LINE.lock().unwrap_or_else(PoisonError::into_inner)
}

/// From now on, on rank 0, the line is shown if it is wanted: on a terminal, or as lines of a log where there is none.
pub fn begin(show: ShowProgress, is_first: bool, quiet: bool, started: Instant) {
    if !is_first || show == ShowProgress::Never || quiet && show != ShowProgress::Always {
        return;
    }
    let terminal = terminal();
    let is_read = terminal.is_some() && std::env::var_os("TERM").is_none_or(|term| term != "dumb");
    let is_log = show != ShowProgress::Always && !is_read;
    let [first, pulse] = if is_log { [IN_LOG; 2] } else { [FIRST, PULSE] };
    *lock() = Some(ProgressLine { started, terminal, place: RunPlace::default(), visible: false, is_log });
    // Without a thread there is no line, and no harm.
    let _ = thread::Builder::new().name("progress".into()).spawn(move || {
        thread::sleep(first);
        while draw() {
            thread::sleep(pulse);
        }
    });
}

/// The terminal that standard error ends at: this process's, or under mpirun, which hands it on through a pipe, that of mpirun. On
/// another host than mpirun's nobody can know.
fn terminal() -> Option<File> {
    if stderr().is_terminal() {
        return stderr().as_fd().try_clone_to_owned().ok().map(File::from);
    }
    let parent = rustix::process::getppid().map(|parent| PathBuf::from(format!("/proc/{parent}")))?;
    let program = std::fs::read_to_string(parent.join("comm")).unwrap_or_default();
    let is_mpirun = ["mpirun", "mpiexec", "orterun", "prterun"].contains(&program.trim());
    let open = || rustix::fs::open(parent.join("fd/2"), OFlags::WRONLY | OFlags::NOCTTY | OFlags::CLOEXEC, Mode::empty());
    if is_mpirun { open().ok().map(File::from).filter(File::is_terminal) } else { None }
}

/// Writes the line; false if there is none any more.
fn draw() -> bool {
    let mut line = lock();
    let Some(line) = &mut *line else { return false };
    let words = words(&line.place, solve_at_work(), line.started.elapsed());
    if line.is_log {
        return write(&format!("mezha: {words}\n"));
    }
    // A line that wraps could not be rewritten, and one that fills its row wraps on some terminals.
    let cut: String = words.chars().take(line.columns() - 1).collect();
    line.visible = write(&format!("{ERASE}{cut}"));
    true
}

/// Whether somebody reads it.
fn write(text: &str) -> bool {
    let mut stderr = stderr();
    stderr.write_all(text.as_bytes()).and_then(|()| stderr.flush()).is_ok()
}

/// Prints something else, with the line out of the way.
pub fn aside<T>(print: impl FnOnce() -> T) -> T {
    let mut line = lock();
    if let Some(line) = line.as_mut() {
        line.erase();
        return print();
    }
    // A reader that does not read holds up the printing, and nobody else.
    drop(line);
    print()
}

/// The line goes, and does not come back.
pub fn end() {
    if let Some(mut line) = lock().take() {
        line.erase();
    }
}

/// The same from a thread that must not wait.
pub fn end_at_once() {
    if let Some(mut line) = LINE.try_lock().ok().and_then(|mut line| line.take()) {
        line.erase();
    }
}

fn note(change: impl FnOnce(&mut RunPlace)) {
    if let Some(line) = &mut *lock() {
        change(&mut line.place);
    }
}

/// Notes what is worked on.
pub fn enter(work: Work) {
    note(|place| place.doing = Some((Some(work), Instant::now())));
}

/// Notes that files are written.
pub fn write_files() {
    note(|place| place.doing = Some((None, Instant::now())));
}

/// Notes the load step.
pub fn step(number: usize, count: usize) {
    note(|place| *place = RunPlace { step: Some((number, count)), ..RunPlace::default() });
}

/// Notes what has happened.
pub fn observe(event: &Event) {
    note(|place| place.observe(event));
}

impl ProgressLine {
    /// Columns of the terminal now: its window may have another size than before.
    fn columns(&self) -> usize {
        let size = self.terminal.as_ref().and_then(|terminal| rustix::termios::tcgetwinsize(terminal).ok());
        size.map(|size| usize::from(size.ws_col)).filter(|columns| *columns > 0).unwrap_or(COLUMNS)
    }

    fn erase(&mut self) {
        if self.visible {
            self.visible = false;
            write(ERASE);
        }
    }
}

impl RunPlace {
    fn observe(&mut self, event: &Event) {
        match event {
            Event::Refinement { refine, last } => {
                self.refine = Some((*refine, *last));
                self.mesh = self.adaptation.as_ref().map(|adaptation| adaptation.meshes.len() + 1);
            }
            Event::Coarse { .. } => (self.boundary, self.set) = (None, None),
            Event::Begin(_) => (self.boundary, self.set) = (None, Some(1)),
            Event::Passed(pass, _) => self.set = Some(pass.iteration + 1),
            Event::Placed(step) => self.boundary = Some(step.iteration + 1),
            Event::Adapted { accuracy, mesh, .. } => {
                let adaptation = self.adaptation.get_or_insert_with(|| Adaptation::new((*accuracy).clone()));
                adaptation.meshes.push((*mesh).clone());
            }
            Event::AtRest { .. } | Event::Solver(_) | Event::Again { .. } => {}
        }
    }
}

/// The goal of the last mesh that is farthest from what is asked, with its estimate, and what it would take by the last three.
fn expected(adaptation: &Adaptation) -> Option<String> {
    let goals = adaptation.accuracy.goals.iter().zip(&adaptation.meshes.last()?.errors).enumerate();
    let known = goals.filter_map(|(place, (goal, error))| Some((place, goal, (*error)?)));
    let (place, goal, error) = known.max_by(|a, b| (a.2 / a.1.tolerance).total_cmp(&(b.2 / b.1.tolerance)))?;
    let needed = accuracy::would_take(adaptation, place).unwrap_or_default();
    Some(format!("{} {error:.1e} of {:.0e}{needed}", accuracy::name(&goal.quantity), goal.tolerance))
}

/// What the line says.
fn words(place: &RunPlace, solve: Option<SolveAtWork>, elapsed: Duration) -> String {
    let mut words = vec![clock(elapsed)];
    words.extend(place.step.map(|(number, count)| format!("step {number} of {count}")));
    words.extend(place.mesh.map(|number| format!("mesh {number}")));
    words.extend(place.adaptation.as_ref().and_then(expected));
    words.extend(place.refine.filter(|(_, last)| *last > 0).map(|(now, last)| format!("refine {now} of {last}")));
    // What is looked at is over, and the numbers are those of the next.
    if !matches!(place.doing, Some((None | Some(Work::Recovery), _))) {
        words.extend(place.boundary.map(|number| format!("boundary {number}")));
        words.extend(place.set.map(|number| format!("set {number}")));
    }
    match (place.doing, solve) {
        (Some((Some(Work::Solve), _)), Some(solve)) if solve.iterations > 0 => words.push(solving(&solve)),
        (Some((doing, since)), _) => {
            let doing = doing.map_or("writing results", crate::run::words::doing);
            words.push(format!("{doing} ({} s)", since.elapsed().as_secs()));
        }
        (None, _) => words.push("reading".into()),
    }
    words.join(", ")
}

/// A solve at work: iterations, residual, goal, and the time left if the logarithm of the residual goes on falling as it fell. Below
/// the goal nothing tells how long more it takes.
fn solving(solve: &SolveAtWork) -> String {
    let SolveAtWork { iterations, residual, tolerance, .. } = solve;
    if residual <= tolerance {
        return format!("iteration {iterations}: residual {residual:.1e}, below {tolerance:.0e}");
    }
    let left = time_left(solve, solve.started.elapsed().as_secs_f64());
    let left = left.map_or(String::new(), |seconds| format!(", {} left", clock(Duration::from_secs_f64(seconds))));
    format!("iteration {iterations}: residual {residual:.1e} to {tolerance:.0e}{left}")
}

/// Seconds that a solve still takes, by the model that the logarithm of its residual falls evenly in time.
fn time_left(solve: &SolveAtWork, seconds: f64) -> Option<f64> {
    let fallen = (solve.first / solve.residual).ln();
    let to_fall = (solve.residual / solve.tolerance).ln();
    let is_known = solve.iterations >= 2 && fallen > 0.0 && to_fall > 0.0 && to_fall.is_finite();
    is_known.then(|| (to_fall * seconds / fallen).min(1e6))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::accuracy::{Accuracy, AdaptedMesh, Goal, Quantity};

    fn solve(iterations: usize, first: f64, residual: f64) -> SolveAtWork {
        SolveAtWork { started: Instant::now(), iterations, first, residual, tolerance: 1e-8, norm: 1.0 }
    }

    #[test]
    fn the_time_left_is_that_of_a_logarithm_that_falls_evenly() {
        let left = |iterations, first, residual| time_left(&solve(iterations, first, residual), 10.0);
        assert!((left(5, 1.0, 1e-2).unwrap() - 30.0).abs() < 1e-9);
        assert_eq!((left(5, 1.0, 1e-9), left(1, 1.0, 1e-2), left(5, 1.0, 2.0)), (None, None, None));
        assert_eq!((left(5, f64::NAN, f64::NAN), left(5, 1.0, 0.0)), (None, None));
    }

    #[test]
    fn a_line_tells_the_place_and_fits() {
        let doing = Some((Some(Work::Solve), Instant::now()));
        let place = RunPlace { doing, refine: Some((7, 8)), set: Some(2), ..RunPlace::default() };
        let line = words(&place, Some(solve(12, 1.0, 3.1e-5)), Duration::from_secs(62));
        assert_eq!(line, "1:02, refine 7 of 8, set 2, iteration 12: residual 3.1e-5 to 1e-8, 0:00 left");
        assert!(line.len() < COLUMNS);
        let line = words(&place, Some(solve(13, 1.0, 3.1e-9)), Duration::from_secs(63));
        assert_eq!(line, "1:03, refine 7 of 8, set 2, iteration 13: residual 3.1e-9, below 1e-8");
        assert_eq!(words(&RunPlace::default(), None, Duration::ZERO), "0:00, reading");
        let step = RunPlace { step: Some((2, 6)), doing: Some((Some(Work::Assembly), Instant::now())), ..RunPlace::default() };
        assert_eq!(words(&step, None, Duration::from_secs(3600)), "1:00:00, step 2 of 6, assembling (0 s)");
        let written = RunPlace { doing: Some((None, Instant::now())), ..place };
        assert_eq!(words(&written, None, Duration::from_secs(64)), "1:04, refine 7 of 8, writing results (0 s)");
    }

    /// A mesh is the second from when it is begun on, not while the files of the first one are written.
    #[test]
    fn a_mesh_that_is_adapted_has_its_number_and_what_is_expected() {
        let goal = Goal { quantity: Quantity::Energy, tolerance: 1e-3 };
        let accuracy = Accuracy { goals: vec![goal], most_unknowns: None, most_seconds: None };
        let mut place = RunPlace::default();
        let told = |place: &RunPlace| words(place, None, Duration::ZERO);
        for (number, error) in [(1, 8e-3), (2, 4e-3), (3, 2e-3)] {
            let mesh = AdaptedMesh {
                number,
                macro_triangles: 8,
                refine: 0,
                unknowns: 1000 << number,
                cycles: Vec::new(),
                errors: vec![Some(error)],
                true_errors: Vec::new(),
                seconds: 0.0,
            };
            let adaptation = place.adaptation.get_or_insert_with(|| Adaptation::new(accuracy.clone()));
            adaptation.meshes.push(mesh);
            assert!(!told(&place).contains(&format!("mesh {}", number + 1)));
            place.observe(&Event::Refinement { refine: 0, last: 0 });
            assert!(told(&place).starts_with(&format!("0:00, mesh {}, energy", number + 1)), "{}", told(&place));
        }
        assert!(told(&place).contains("energy 2.0e-3 of 1e-3, which would take some 16 000 unknowns"), "{}", told(&place));
    }

    #[test]
    fn the_refinement_is_told_from_the_first_mesh_on() {
        let mut place = RunPlace::default();
        for (refine, told) in [(0, "refine 0 of 3"), (1, "refine 1 of 3"), (3, "refine 3 of 3")] {
            place.observe(&Event::Refinement { refine, last: 3 });
            assert_eq!(words(&place, None, Duration::ZERO), format!("0:00, {told}, reading"));
            place.observe(&Event::Coarse { solve: &Default::default(), active: &[], passes: &[], converged: true });
        }
        place.observe(&Event::Refinement { refine: 0, last: 0 });
        assert_eq!(words(&place, None, Duration::ZERO), "0:00, reading");
    }
}
