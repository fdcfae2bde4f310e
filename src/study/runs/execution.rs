//! One run as a process of its own: started, watched, and what became of it.

use std::ffi::OsString;
use std::fs::{self, File};
use std::io;
use std::num::NonZero;
use std::os::unix::process::ExitStatusExt;
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread::{available_parallelism, sleep};
use std::time::{Duration, Instant};

use rustix::process::{Pid, Signal, kill_process};
use serde_json::Value;
use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;
use signal_hook::low_level::signal_name;

use super::ended::{Ended, RunStatus};
use super::folder::{Folder, result_name};
use super::record::Program;
use crate::case::Inputs;
use crate::output::summary::read_summary;
use crate::output::{OutputError, machine};
use crate::study::plan::planned::PlannedRun;

/// How often it is asked whether a run has ended.
const PULSE: Duration = Duration::from_millis(20);
/// How long a run may take to end that was told to.
const GRACE: Duration = Duration::from_secs(10);
/// How mezha's own lines on standard error begin.
const OWN: &str = "mezha: ";

/// What all runs of a study have in common.
pub struct Execution<'a> {
    program: &'a Program,
    folder: &'a Folder,
    timeout: Duration,
    cores: usize,
    machine: String,
    /// Number of the signal that has told this program to end; 0 if none has.
    signal: Arc<AtomicUsize>,
}

/// How the wait for a child ended.
#[derive(Debug, PartialEq)]
enum Waited {
    /// The child has ended.
    Ended(ExitStatus),
    /// It took too long, and was ended.
    TimedOut,
    /// A signal has told this program to end, and the child was ended.
    Interrupted,
}

impl<'a> Execution<'a> {
    /// Runs of this program, with results in the folder of the study. From now on signals that would end this program end the
    /// run that is being made.
    ///
    /// # Errors
    /// The operating system refuses.
    pub fn new(program: &'a Program, folder: &'a Folder, timeout: Duration) -> io::Result<Self> {
        let signal = Arc::new(AtomicUsize::new(0));
        for number in [SIGINT, SIGTERM] {
            flag::register_usize(number, signal.clone(), number as usize)?;
        }
        Ok(Self { program, folder, timeout, cores: cores(), machine: machine(), signal })
    }

    /// Name of the signal that has told this program to end, if one has.
    pub fn interrupted(&self) -> Option<&'static str> {
        let number = self.signal.load(Ordering::Relaxed) as i32;
        (number != 0).then(|| signal_name(number).unwrap_or("a signal"))
    }

    /// Makes a run of these inputs, with its result under this number; one that finds others fails. What it says on standard error
    /// stays beside the result.
    ///
    /// # Errors
    /// The disk refuses; a run that fails is no error.
    pub fn execute(&self, run: &PlannedRun, inputs: &Inputs, number: usize) -> Result<Ended, OutputError> {
        let result = self.folder.result(number);
        let said = result.with_extension("stderr");
        let errors = File::create(&said).map_err(OutputError::io("write", &said))?;
        let mut command = self.command(run, inputs, &result);
        // The lock is an empty file: a run that outlives this program holds it.
        let nothing = self.folder.lock().map_or_else(Stdio::null, Stdio::from);
        command.stdin(nothing).stdout(Stdio::null()).stderr(errors);
        let start = Instant::now();
        let ending = command.spawn().and_then(|child| wait(child, self.timeout, &|| self.interrupted().is_some()));
        let wall_s = start.elapsed().as_secs_f64();
        let text = fs::read(&said).map_err(OutputError::io("read", &said))?;
        if text.is_empty() {
            fs::remove_file(&said).map_err(OutputError::io("remove", &said))?;
        }
        let change = self.program.change();
        let summary = if change.is_none() { read_summary(&result) } else { Value::Null };
        let (status, reason) = match ending {
            _ if change.is_some() => (RunStatus::Failed, change.unwrap_or_default()),
            Ok(Waited::Ended(ending)) => {
                let (status, reason) = judge(ending, &summary, &String::from_utf8_lossy(&text));
                let file = format!("{}: ", run.file.display());
                (status, reason.strip_prefix(&file).unwrap_or(&reason).to_owned())
            }
            Ok(Waited::Interrupted) => (RunStatus::Failed, "interrupted".into()),
            Ok(Waited::TimedOut) => {
                (RunStatus::Timeout, format!("not finished after {:?}; raise timeout in the study file", self.timeout))
            }
            Err(error) => (RunStatus::Failed, format!("cannot start {}: {error}", command.get_program().to_string_lossy())),
        };
        let result = if summary.is_null() { String::new() } else { result_name(number) };
        let timeout_s = self.timeout.as_secs_f64();
        Ok(Ended { status, reason, wall_s, timeout_s, machine: self.machine.clone(), summary, result })
    }

    /// `mezha run`, under mpirun if there are several ranks. More ranks than cores share them: those that wait give way.
    fn command(&self, run: &PlannedRun, inputs: &Inputs, result: &Path) -> Command {
        let mut command = if run.ranks == 1 {
            Command::new(&self.program.path)
        } else {
            let mut mpirun = Command::new("mpirun");
            mpirun.args(["-n", &run.ranks.to_string(), "--bind-to", "none"]);
            if run.ranks > self.cores {
                mpirun.arg("--oversubscribe").env("OMPI_MCA_mpi_yield_when_idle", "1");
            }
            mpirun.arg(&self.program.path);
            mpirun
        };
        let words =
            [OsString::from("run"), run.file.clone().into(), "--out".into(), result.into(), "--force".into(), "--quiet".into()];
        command.args(words).args(["--inputs", &inputs.word()]).args(run.overrides.iter().flat_map(|text| ["--set", text]));
        command
    }
}

/// How many ranks have a core of their own: tasks of a Slurm job, on all its nodes, or cores of this machine.
fn cores() -> usize {
    let tasks = std::env::var("SLURM_NTASKS").ok().and_then(|tasks| tasks.parse().ok());
    tasks.unwrap_or_else(|| available_parallelism().map_or(1, NonZero::get))
}

/// Waits for a child until it has taken too long, or is `unwanted`; then it is ended.
fn wait(mut child: Child, timeout: Duration, unwanted: &dyn Fn() -> bool) -> io::Result<Waited> {
    let ended = wait_for(&mut child, timeout, unwanted)?;
    // The child may have ended by the same signal.
    let why = if unwanted() { Waited::Interrupted } else { Waited::TimedOut };
    if let Some(status) = ended {
        return Ok(if unwanted() { why } else { Waited::Ended(status) });
    }
    // The polite signal first: mpirun passes it on to the ranks.
    let asked = kill_process(Pid::from_child(&child), Signal::TERM);
    if asked.is_err() || wait_for(&mut child, GRACE, &|| false)?.is_none() {
        child.kill()?;
        child.wait()?;
    }
    Ok(why)
}

fn wait_for(child: &mut Child, patience: Duration, unwanted: &dyn Fn() -> bool) -> io::Result<Option<ExitStatus>> {
    let start = Instant::now();
    loop {
        let status = child.try_wait()?;
        if status.is_some() || start.elapsed() > patience || unwanted() {
            return Ok(status);
        }
        sleep(PULSE);
    }
}

/// The ending of a run in the terms of the table.
fn judge(ending: ExitStatus, summary: &Value, said: &str) -> (RunStatus, String) {
    let reason = summary["reason"].as_str();
    let status = match ending.code() {
        Some(0) if summary["status"] == "converged" => RunStatus::Converged,
        Some(3) if summary["status"] == "not_converged" => RunStatus::NotConverged,
        Some(3) if summary["status"] == "unresolved" => RunStatus::Unresolved,
        Some(2) => RunStatus::Refused,
        _ => RunStatus::Failed,
    };
    let words = reason.filter(|_| status.is_solved()).map(str::to_owned).or_else(|| last_words(said));
    let how = || match (ending.code(), ending.signal()) {
        (Some(code @ (0 | 3)), _) => format!("exit code {code}, but summary.json does not say so"),
        (Some(code), _) => format!("exit code {code}, without a word"),
        (None, signal) => format!("ended by signal {}", signal.unwrap_or_default()),
    };
    (status, words.unwrap_or_else(how))
}

/// What a run said last: mezha's own words, else those of a library, else those of mpirun, which stand between rulers of dashes.
///
/// Open MPI 5 ends its own words with a zero byte, which may stand before a line of ours.
fn last_words(said: &str) -> Option<String> {
    let lines = || said.lines().map(|line| line.trim_matches(['\0', ' ', '\t'])).filter(|line| !line.is_empty());
    if let Some(own) = lines().filter_map(|line| line.strip_prefix(OWN)).next_back() {
        return Some(own.to_owned());
    }
    let is_ruler = |line: &str| line.chars().all(|c| c == '-');
    let (mut inside, mut outer, mut inner) = (false, None, None);
    for line in lines() {
        match (is_ruler(line), inside) {
            (true, _) => inside = !inside,
            (false, true) => inner = inner.or(Some(line)),
            (false, false) => outer = Some(line),
        }
    }
    outer.or(inner).map(str::to_owned)
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn ending(code: i32) -> ExitStatus {
        ExitStatus::from_raw(code << 8)
    }

    #[test]
    fn exit_codes_and_summary_must_agree() {
        let good = json!({ "status": "converged", "reason": "residual" });
        let bad = json!({ "status": "not_converged", "reason": "body upper can move" });
        let coarse = json!({ "status": "unresolved", "reason": "too narrow" });
        let table = [
            (ending(0), &good, "", RunStatus::Converged, "residual"),
            (ending(3), &bad, "mezha: NOT converged: body upper can move", RunStatus::NotConverged, "body upper can move"),
            (ending(3), &coarse, "mezha: NOT resolved: too narrow", RunStatus::Unresolved, "too narrow"),
            (ending(0), &coarse, "", RunStatus::Failed, "exit code 0, but summary.json does not say so"),
            (
                ending(2),
                &Value::Null,
                "mezha: a.toml: mesh.order = 7: must be 1 or 2",
                RunStatus::Refused,
                "a.toml: mesh.order = 7: must be 1 or 2",
            ),
            (ending(1), &Value::Null, "mezha: PETSc failed", RunStatus::Failed, "PETSc failed"),
            (ending(0), &Value::Null, "", RunStatus::Failed, "exit code 0, but summary.json does not say so"),
            (ending(0), &bad, "", RunStatus::Failed, "exit code 0, but summary.json does not say so"),
            (ending(139), &Value::Null, "", RunStatus::Failed, "exit code 139, without a word"),
            (ExitStatus::from_raw(9), &Value::Null, "", RunStatus::Failed, "ended by signal 9"),
        ];
        for (ending, summary, said, status, reason) in table {
            assert_eq!(judge(ending, summary, said), (status, reason.to_owned()), "{ending:?} {said}");
        }
    }

    #[test]
    fn the_chatter_of_mpirun_is_not_a_reason() {
        let chatter = "-----\nmpirun detected that one or more processes exited\n  Exit code: 2\n-----\n";
        assert_eq!(last_words(&format!("mezha: no mesh\n{chatter}")).unwrap(), "no mesh");
        assert_eq!(last_words(&format!("{chatter}\0mezha: no mesh\n")).unwrap(), "no mesh");
        assert_eq!(last_words(&format!("[0]PETSC ERROR: out of memory\n{chatter}")).unwrap(), "[0]PETSC ERROR: out of memory");
        assert_eq!(
            last_words("-----\nThere are not enough slots\nin the system\n-----\n").unwrap(),
            "There are not enough slots"
        );
        assert_eq!(last_words("\n"), None);
    }

    #[test]
    fn a_run_that_takes_too_long_is_ended() {
        let start = Instant::now();
        let child = Command::new("sleep").arg("60").spawn().unwrap();
        assert_eq!(wait(child, Duration::from_millis(50), &|| false).unwrap(), Waited::TimedOut);
        assert!(start.elapsed() < GRACE);
        let child = Command::new("sleep").arg("60").spawn().unwrap();
        assert_eq!(wait(child, Duration::from_secs(60), &|| true).unwrap(), Waited::Interrupted);
        assert!(start.elapsed() < GRACE);
        let child = Command::new("true").spawn().unwrap();
        assert_eq!(wait(child, GRACE, &|| false).unwrap(), Waited::Ended(ExitStatus::from_raw(0)));
    }
}
