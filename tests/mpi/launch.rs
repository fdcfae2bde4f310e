//! Runs a test program on 1, 2 and 3 ranks: called by cargo it starts itself again under `mpirun`,
//! called by `mpirun` it runs its checks, in their order, in one session.

use mezha::petsc::Session;
use std::io::Write;
use std::path::PathBuf;
use std::process::{Command, ExitCode};
use std::time::Instant;

#[path = "../support/process.rs"]
mod process;

/// A function and its name.
pub type Named<F> = (&'static str, F);

/// Functions with their names: `named![gather_fetches_any_entry, matrix_in_blocks]`.
macro_rules! named {
    ($($function:ident),* $(,)?) => { &[$((stringify!($function), $function)),*] };
}
pub(crate) use named;

/// The checks of one test program.
pub struct Suite {
    /// Options that the session starts with: mezha's word by word, the user's each as `-name value`.
    pub options: (&'static [&'static str], &'static [&'static str]),
    /// Checks that run on every number of ranks, all of them inside one session. They fail by panicking.
    pub checks: &'static [Named<fn(&Session)>],
    /// Checks that run outside of MPI and start [`Suite::scenarios`].
    pub outside: &'static [Named<fn()>],
    /// What a process does that [`mpirun`] has started for a scenario.
    pub scenarios: &'static [Named<fn()>],
}

/// How a run ended.
pub struct Ended {
    /// Its exit code.
    pub code: Option<i32>,
    /// Standard output of all ranks.
    pub output: String,
    /// Standard error of all ranks.
    pub errors: String,
}

/// Prints what a PETSc object or memory block that was not given back looks like; nothing if there is none.
pub const LIST_LEAKS: &str = "-malloc_debug -malloc_dump -objects_dump";

const RANKS: [usize; 3] = [1, 2, 3];
const SCENARIO: &str = "MEZHA_TEST_SCENARIO";

impl Suite {
    /// Does what this process has been started for.
    pub fn run(&self) -> ExitCode {
        let words: Vec<String> = std::env::args().skip(1).filter(|word| !word.starts_with('-')).collect();
        if let Ok(name) = std::env::var(SCENARIO) {
            let (_, scenario) = self.scenarios.iter().find(|(other, _)| *other == name).expect("a known scenario");
            scenario();
            ExitCode::SUCCESS
        } else if std::env::var_os("OMPI_COMM_WORLD_SIZE").is_some() {
            self.check_inside(&words);
            ExitCode::SUCCESS
        } else if std::env::args().any(|word| word == "--list") {
            let names = self.checks.iter().map(|(name, _)| name).chain(self.outside.iter().map(|(name, _)| name));
            names.for_each(|name| println!("{name}: test"));
            ExitCode::SUCCESS
        } else {
            self.check_all(&words)
        }
    }

    /// Every check under `mpirun` on every number of ranks, then those outside.
    fn check_all(&self, words: &[String]) -> ExitCode {
        let start = Instant::now();
        let (mut passed, mut failed) = (0, 0);
        if self.checks.iter().any(|(name, _)| wanted(name, words)) {
            for ranks in RANKS {
                println!("\nrunning on {ranks} {}", if ranks == 1 { "rank" } else { "ranks" });
                let ended = mpirun(ranks, None, words, LIST_LEAKS);
                print!("{}{}", ended.output, ended.errors);
                passed += ended.output.lines().filter(|line| line.ends_with("... ok")).count();
                let (_, left) = ended.output.rsplit_once("... ok\n").unwrap_or_default();
                if ended.code != Some(0) || !left.is_empty() {
                    println!("FAILED on {ranks} ranks: exit code {:?}, output after the last check: {left:?}", ended.code);
                    failed += 1;
                }
            }
        }
        println!("\nrunning outside");
        for (name, check) in self.outside.iter().filter(|(name, _)| wanted(name, words)) {
            print!("test {name} ... ");
            let good = std::panic::catch_unwind(check).is_ok();
            println!("{}", if good { "ok" } else { "FAILED" });
            *(if good { &mut passed } else { &mut failed }) += 1;
        }
        let (word, seconds) = (if failed == 0 { "ok" } else { "FAILED" }, start.elapsed().as_secs_f64());
        println!("\ntest result: {word}. {passed} passed; {failed} failed; finished in {seconds:.2}s\n");
        if failed == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE }
    }

    /// The checks, on this rank of a run.
    fn check_inside(&self, words: &[String]) {
        let (defaults, user) = self.options;
        let user: Vec<String> = user.iter().flat_map(|option| option.split(' ')).map(String::from).collect();
        let session = Session::start(defaults, &user).expect("a session starts");
        let say = |text: String| {
            if session.rank() == 0 {
                print!("{text}");
                std::io::stdout().flush().expect("standard output is open");
            }
        };
        for (name, check) in self.checks.iter().filter(|(name, _)| wanted(name, words)) {
            say(format!("test {name} ... "));
            check(&session);
            session.any(true);
            say("ok\n".into());
        }
    }
}

/// Whether a check is asked for; all are, if no word is given.
fn wanted(name: &str, words: &[String]) -> bool {
    words.is_empty() || words.iter().any(|word| name.contains(word.as_str()))
}

/// Starts this program again on `ranks` ranks, for a scenario or for the checks, with PETSc's `options`.
///
/// # Panics
/// If it takes too long.
pub fn mpirun(ranks: usize, scenario: Option<&str>, words: &[String], options: &str) -> Ended {
    let mut command = Command::new("mpirun");
    command.args(["-n", &ranks.to_string()]);
    command.args(["--oversubscribe", "--bind-to", "none"]);
    command.arg(this_program()).args(words);
    finish(command, scenario, options)
}

/// Starts this program again for a scenario, without `mpirun`.
///
/// # Panics
/// If it takes too long.
#[allow(dead_code)] // Not every program has such a scenario.
pub fn alone(scenario: &str) -> Ended {
    finish(Command::new(this_program()), Some(scenario), "")
}

fn this_program() -> PathBuf {
    std::env::current_exe().expect("this program has a file")
}

/// Runs a command to its end.
fn finish(mut command: Command, scenario: Option<&str>, options: &str) -> Ended {
    command.env("PETSC_OPTIONS", options);
    if let Some(name) = scenario {
        command.env(SCENARIO, name);
    }
    let (code, output, errors) = process::finish(command);
    Ended { code, output, errors }
}
