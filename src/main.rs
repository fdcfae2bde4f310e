//! The command `mezha`: arguments → case → run → exit code. Errors are printed and ranks ended here and nowhere else.

use clap::Parser;
use mezha::arguments::{Arguments, CaseArguments, Command, Run, Study};
use mezha::case::Case;
use mezha::petsc::Session;
use mezha::run::{self, Outcome, RunError, RunOptions};
use mezha::study::{self, StudyError};
use std::process::exit;
use std::time::Instant;

fn main() {
    let started = Instant::now();
    let arguments = Arguments::try_parse().unwrap_or_else(|error| {
        if is_first_rank() {
            let _ = error.print();
        }
        exit(error.exit_code())
    });
    let code = match arguments.command {
        Command::Run(arguments) => run_case(&arguments, started),
        Command::Check(arguments) => check_case(&arguments),
        Command::Study(arguments) => study(&arguments),
        Command::Info => info(),
    };
    exit(code)
}

/// The rank that mpirun has given to this process, known before MPI has started; None without mpirun.
fn given_rank() -> Option<String> {
    ["OMPI_COMM_WORLD_RANK", "PMI_RANK", "PMIX_RANK"].iter().find_map(|name| std::env::var(name).ok())
}

/// Whether this process speaks for all.
fn is_first_rank() -> bool {
    given_rank().is_none_or(|rank| rank == "0")
}

fn run_case(arguments: &Run, started: Instant) -> i32 {
    if let Some(word) = arguments.petsc_options.first().filter(|word| !word.starts_with('-')) {
        let words = format!("`{word}` after -- is not a PETSc option: their names begin with a minus");
        return if is_first_rank() { print(&RunError::Input(words)) } else { 2 };
    }
    let session = match Session::start(&[], &arguments.petsc_options) {
        Ok(session) => session,
        Err(error) => return print(&RunError::Failed(error.to_string())),
    };
    let outcome =
        session.agree(Case::read(&arguments.case.case, &arguments.case.overrides)).map_err(RunError::Input).and_then(|case| {
            let out = arguments.folder(&case.name);
            run::run(&case, &RunOptions { out, force: arguments.force, quiet: arguments.quiet, started }, &session)
        });
    match outcome {
        Ok(Outcome::Converged) => 0,
        Ok(Outcome::NotConverged) => 3,
        Err(error @ (RunError::Input(_) | RunError::Key(_))) => {
            let code = if session.rank() == 0 { print(&error) } else { 2 };
            session.barrier();
            code
        }
        Err(error) => {
            let code = print(&error);
            // The others may wait for this rank for ever.
            if session.size() > 1 { session.abort(code) } else { code }
        }
    }
}

fn check_case(arguments: &CaseArguments) -> i32 {
    if !is_first_rank() {
        return 0;
    }
    let checked = Case::read(&arguments.case, &arguments.overrides)
        .map_err(|error| RunError::Input(error.to_string()))
        .and_then(|case| run::check(&case));
    match checked {
        Ok(checked) => {
            println!("{}", checked.words);
            let loose = checked.not_held.inspect(|words| eprintln!("mezha: {words}"));
            if loose.is_some() { 3 } else { 0 }
        }
        Err(error) => print(&error),
    }
}

fn study(arguments: &Study) -> i32 {
    if given_rank().is_some() {
        if is_first_rank() {
            eprintln!(
                "mezha: a study starts its runs itself: start it without mpirun, and write ranks = [...] into the study file"
            );
        }
        return 2;
    }
    match study::run(&arguments.file, &arguments.overrides, &arguments.out, arguments.force) {
        Ok(()) => 0,
        Err(StudyError::Input(words)) => print(&RunError::Input(words)),
        Err(StudyError::Failed(words)) => print(&RunError::Failed(words)),
    }
}

fn info() -> i32 {
    match Session::start(&[], &[]) {
        Ok(session) => {
            if session.rank() == 0 {
                println!("{}", run::info(&session));
            }
            0
        }
        Err(error) => print(&RunError::Failed(error.to_string())),
    }
}

/// Prints an error and gives its exit code.
fn print(error: &RunError) -> i32 {
    eprintln!("mezha: {error}");
    match error {
        RunError::Input(_) | RunError::Key(_) => 2,
        RunError::Failed(_) => 1,
    }
}
