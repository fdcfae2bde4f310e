//! The command `mezha`: arguments → case → run → exit code. Errors are printed and ranks ended here and nowhere else.

use clap::Parser;
use clap::error::ErrorKind as UsageKind;
use mezha::arguments::{Arguments, CheckArguments, Command, FileKind, RunArguments, Study, nearest_command};
use mezha::case::{Inputs, schema};
use mezha::output::RunError;
use mezha::output::summary::Status;
use mezha::petsc::{
    self, Session, TellingAllocator, end_all_ranks, errors_are_final, share_memory_among_threads, when_memory_is_refused,
};
use mezha::run::{self, RunOptions, interruption};
use mezha::study;
use rustix::process::{Resource, getrlimit};
use std::io::{ErrorKind, Write, stderr, stdout};
use std::path::Path;
use std::process::exit;
use std::thread::sleep;
use std::time::{Duration, Instant};

/// How long a rank with an error waits for the others to come to the same one.
const PATIENCE: Duration = Duration::from_secs(5);
/// How long other ranks leave the word to rank 0, where they cannot tell whether it has the same to say: the first that ends
/// with an error makes mpirun end all others.
const PAUSE: Duration = Duration::from_secs(1);

/// Bytes of the stack that MPI takes: 64 kB overflow.
const LEAST_STACK: u64 = 128 << 10;
/// Bytes of the files by which the ranks of a host share their memory: with 4 MB Open MPI ends by a signal, with less it may wait for
/// ever, with 8 it starts.
const LEAST_FILE: u64 = 8 << 20;

#[global_allocator]
static ALLOCATOR: TellingAllocator = TellingAllocator;

fn main() {
    let started = Instant::now();
    if let Some(words) = too_small_a_limit() {
        exit(print_once(&RunError::Failed(words)));
    }
    share_memory_among_threads();
    let arguments = Arguments::try_parse().unwrap_or_else(|error| exit(usage(&error)));
    let code = match arguments.command {
        Command::Run(arguments) => run_case(&arguments, started),
        Command::Check(arguments) => on_first_rank(|| check_case(&arguments)),
        Command::New { mesh } => on_first_rank(|| new_case(&mesh)),
        Command::Study(arguments) => study(&arguments),
        Command::Schema { kind } => on_first_rank(|| print_schema(kind)),
        Command::Info => info(),
    };
    exit(code)
}

/// Words for a limit of the shell's under which the libraries overflow, or wait for ever, before they could say so.
fn too_small_a_limit() -> Option<String> {
    let is_below = |limit, least| getrlimit(limit).current.filter(|bytes| *bytes < least);
    let stack = is_below(Resource::Stack, LEAST_STACK).map(|bytes| ("stack", "s", bytes, LEAST_STACK));
    let of_mpi = || given_rank().and_then(|_| is_below(Resource::Fsize, LEAST_FILE));
    let (what, letter, bytes, least) = stack.or_else(|| of_mpi().map(|bytes| ("files of MPI", "f", bytes, LEAST_FILE)))?;
    Some(format!(
        "the {what} may have {bytes} bytes here, and {least} at least are wanted: say ulimit -{letter} unlimited in the shell that starts it"
    ))
}

/// Prints help, or what is wrong with the command line, and gives the exit code.
fn usage(error: &clap::Error) -> i32 {
    let code = error.exit_code();
    let session = if code == 0 { take_part() } else { Ok(None) };
    match (session, is_first_rank()) {
        (Err(code), _) => return code,
        (_, true) => {
            match error.kind() {
                UsageKind::DisplayVersion => return say(&run::version()),
                // mpirun gives its ranks terminals of its own, wherever their words go in the end: no colours there.
                _ if given_rank().is_some() && !error.use_stderr() => drop(write!(stdout(), "{}", error.render())),
                _ if given_rank().is_some() => drop(write!(stderr(), "{}", error.render())),
                _ => drop(error.print()),
            }
            if let Some(name) = nearest_command(error) {
                let _ = writeln!(stderr(), "  tip: did you mean `mezha {name}`?");
            }
        }
        (_, false) => sleep(if code == 0 { Duration::ZERO } else { PAUSE }),
    }
    code
}

/// Under mpirun every rank takes part in MPI, even where rank 0 alone has work: the others might wait for it for ever.
fn take_part() -> Result<Option<Session>, i32> {
    given_rank().map(|_| Session::start(&[], &[]).map_err(cannot_start)).transpose()
}

/// Work that rank 0 does alone, and its exit code.
fn on_first_rank(work: impl FnOnce() -> i32) -> i32 {
    match take_part() {
        Err(code) => code,
        Ok(Some(session)) if session.rank() > 0 => 0,
        Ok(_session) => work(),
    }
}

/// The rank that mpirun has given to this process, known before MPI has started; None without mpirun. Where something else has
/// set only one of the two, this process is alone.
fn given_rank() -> Option<String> {
    const GIVEN: [(&str, &str); 3] =
        [("OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE"), ("PMI_RANK", "PMI_SIZE"), ("PMIX_RANK", "PMIX_NAMESPACE")];
    GIVEN.iter().find_map(|(rank, size)| std::env::var_os(size).and_then(|_| std::env::var(rank).ok()))
}

/// Whether this process speaks for all.
fn is_first_rank() -> bool {
    given_rank().is_none_or(|rank| rank == "0")
}

fn run_case(arguments: &RunArguments, started: Instant) -> i32 {
    if let Some(word) = arguments.stray_word() {
        let words = format!("`{word}` after -- is not a PETSc option: their names begin with a minus and a letter");
        return print_once(&RunError::Input(words));
    }
    if let Err(error) = interruption::watch(is_first_rank()) {
        return print_once(&RunError::Failed(format!("cannot wait for signals: {error}")));
    }
    errors_are_final();
    when_memory_is_refused(end_without_memory);
    let session = match Session::start(&[], &arguments.petsc_options) {
        Ok(session) => session,
        Err(error) => return cannot_start(error),
    };
    let solved = solve(arguments, started, &session);
    interruption::abandon();
    match solved {
        Ok(status) => end(session, status),
        Err(RunError::Failed(words)) => {
            interruption::abandon_alone();
            let code = print(&RunError::Failed(words));
            // The others may wait for this rank for ever.
            if session.size() > 1 { session.abort(code) } else { code }
        }
        Err(alike) => {
            let all_know = session.meet(PATIENCE);
            let code = if session.rank() == 0 || !all_know { print(&alike) } else { alike.code() };
            // The first rank that ends makes mpirun end the others: not before rank 0 has spoken.
            if all_know && session.meet(PATIENCE) { code } else { session.abort(code) }
        }
    }
}

/// Reads the case and solves it. **Collective**
fn solve(arguments: &RunArguments, started: Instant, session: &Session) -> Result<Status, RunError> {
    let (case, overrides) = (&arguments.case.file(), &arguments.case.overrides);
    let inputs = arguments.inputs.as_deref().map(Inputs::parse).transpose();
    let inputs = inputs.map_err(|words| RunError::Input(format!("--inputs: {words}")))?;
    let case = run::read_case(case, overrides, inputs.as_ref(), session)?;
    let out = arguments.folder(&case.name);
    let RunArguments { force, quiet, progress, .. } = *arguments;
    run::run(&case, &RunOptions { out, inputs, force, quiet, progress, started }, session)
}

/// Ends PETSc and MPI after a run whose result is written. **Collective**
fn end(session: Session, status: Status) -> i32 {
    match session.end() {
        Ok(()) => match status {
            Status::Converged => 0,
            Status::NotConverged | Status::Unresolved | Status::Interrupted => 3,
        },
        Err(error) => {
            let words = "the result is written and whole, but what PETSc was asked to say at its end is not";
            end_alone(&RunError::Failed(format!("{error}; {words}")))
        }
    }
}

/// Rust has not got so many bytes, perhaps on this rank alone: the run ends here and now.
fn end_without_memory(bytes: usize) {
    print(&RunError::Failed(format!("memory: {bytes} bytes more could not be got{}", run::out_of_memory_remedy())));
    interruption::abandon_alone();
    end_all_ranks(1);
    interruption::exit_at_once();
}

/// PETSc has failed at its start, perhaps on this rank alone, or the ranks disagree on what to start.
fn cannot_start(error: petsc::Error) -> i32 {
    if matches!(error, petsc::Error::UnequalWords { .. }) {
        return print_once(&RunError::Input(error.to_string()));
    }
    end_alone(&RunError::Failed(error.to_string()))
}

/// Ends all ranks for an error of the libraries' start or end, which this rank may have alone; if all have it, rank 0 speaks.
fn end_alone(error: &RunError) -> i32 {
    interruption::abandon_alone();
    if !is_first_rank() {
        sleep(PAUSE);
    }
    let code = print(error);
    end_all_ranks(code);
    code
}

fn check_case(arguments: &CheckArguments) -> i32 {
    let (file, overrides) = (&arguments.case.file(), &arguments.case.overrides);
    let checked = run::check_file(file, overrides);
    let drawn = run::draw_case(file, overrides, checked.as_ref().map(|checked| &checked.read), |name| arguments.figure(name));
    let code = match checked {
        Ok(checked) => match (say(&checked.words), checked.not_held) {
            (0, not_held) => {
                // A reader that has gone away is no reason for another exit code.
                let words = checked.warnings.iter().map(|words| format!("warning: {words}")).chain(not_held.clone());
                words.for_each(|words| tell(&words));
                if !checked.proposals.is_empty() {
                    say(&checked.proposals);
                }
                if not_held.is_some() { 3 } else { 0 }
            }
            (code, _) => code,
        },
        Err(error) => print(&error),
    };
    match drawn {
        // Words of errors stand alone on standard error, and what is asked for on standard output.
        Ok(Some(figure)) if code == 0 || code == 3 => drop(say(&format!("figure: {}", figure.display()))),
        Ok(Some(figure)) => tell(&format!("the figure {} shows what could be read", figure.display())),
        Ok(None) => {}
        Err(error) if arguments.draw.is_some() && code == 0 => return print(&error),
        Err(error) => tell(&format!("warning: {error}")),
    }
    code
}

/// Says something beside the result. A reader that has gone away is no reason for another exit code.
fn tell(words: &str) {
    let _ = stderr().write_all(format!("mezha: {words}\n").as_bytes());
}

fn new_case(mesh: &Path) -> i32 {
    // Where the case is written to, if that is a file.
    let output = std::fs::read_link("/proc/self/fd/1").ok().filter(|path| path.is_file());
    let named = run::path_from(output.as_deref().and_then(Path::parent), mesh);
    match run::first_case(mesh, &named) {
        Ok(first) => {
            first.remarks.iter().for_each(|words| tell(&format!("warning: {words}")));
            say(first.text.trim_end())
        }
        Err(error) => print(&error),
    }
}

fn print_schema(kind: FileKind) -> i32 {
    say(&schema::json(match kind {
        FileKind::Case => &schema::CASE,
        FileKind::Study => &schema::STUDY,
    }))
}

fn study(arguments: &Study) -> i32 {
    if given_rank().is_some() {
        let words = "a study starts its runs itself: start it without mpirun, and write ranks = [...] into the study file";
        return print_once(&RunError::Input(words.into()));
    }
    match study::run(&arguments.file(), &arguments.overrides, &arguments.out, arguments.force) {
        Ok(true) => 0,
        Ok(false) => 3,
        Err(error) => print(&error),
    }
}

fn info() -> i32 {
    let session = match Session::start(&[], &[]) {
        Ok(session) => session,
        Err(error) => return cannot_start(error),
    };
    let code = if session.rank() == 0 { say(&run::info(&session)) } else { 0 };
    match session.end() {
        Ok(()) => code,
        Err(error) => cannot_start(error),
    }
}

/// Prints what was asked for, and gives the exit code. A reader that has gone away wants no more.
fn say(words: &str) -> i32 {
    match writeln!(stdout(), "{words}").and_then(|()| stdout().flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            print(&RunError::Failed(format!("cannot write to standard output: {error}")))
        }
        _ => 0,
    }
}

/// Prints an error that all ranks have, outside of MPI, on rank 0 alone, and gives its exit code.
fn print_once(error: &RunError) -> i32 {
    if is_first_rank() {
        return print(error);
    }
    sleep(PAUSE);
    error.code()
}

/// Prints an error and gives its exit code, which matters more than whether anybody can read the words.
fn print(error: &RunError) -> i32 {
    // In one piece: other ranks may speak at the same time.
    let _ = stderr().write_all(format!("mezha: {error}\n").as_bytes());
    error.code()
}
