//! A command run to its end, with both its outputs, and not for ever.

use rustix::process::{Pid, Signal, kill_process};
use std::io::Read;
use std::process::{Child, Command, Stdio};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// The longest that a command may take.
pub const PATIENCE: Duration = Duration::from_secs(300);

/// Root may run `mpirun`; ranks that wait leave the processor to others.
pub const ENVIRONMENT: [(&str, &str); 5] = [
    ("OMPI_ALLOW_RUN_AS_ROOT", "1"),
    ("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1"),
    ("OMPI_MCA_mpi_yield_when_idle", "1"),
    ("OMP_NUM_THREADS", "1"),
    ("OPENBLAS_NUM_THREADS", "1"),
];

/// How many seconds mpirun leaves to the other ranks after one has ended with an error, before it kills them (Open MPI 4, and 5).
/// Its default of 1 costs one to two seconds for each run that is refused.
pub const GRACE: [&str; 2] = ["OMPI_MCA_odls_base_sigkill_timeout", "PRTE_MCA_odls_base_sigkill_timeout"];

/// Exit code, standard output and standard error of a command, without standard input, in a session folder of its own:
/// runs at the same time must not clear away each other's. Without a [`GRACE`] of its own there is none.
///
/// # Panics
/// If it takes too long.
pub fn finish(command: Command) -> (Option<i32>, String, String) {
    finish_within(command, PATIENCE)
}

/// The same within a time of its own.
///
/// # Panics
/// If it takes longer.
pub fn finish_within(mut command: Command, patience: Duration) -> (Option<i32>, String, String) {
    let sessions = tempfile::tempdir().expect("a temporary folder");
    command.envs(ENVIRONMENT);
    // Of Open MPI 4, and of 5.
    for name in ["OMPI_MCA_orte_tmpdir_base", "PRTE_MCA_prte_tmpdir_base"] {
        command.env(name, sessions.path());
    }
    for name in GRACE {
        if !command.get_envs().any(|(given, _)| given == name) {
            command.env(name, "0");
        }
    }
    command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().expect("mpirun starts (Debian: apt-get install openmpi-bin)");
    let output = reader(child.stdout.take().expect("piped"));
    let errors = reader(child.stderr.take().expect("piped"));
    let code = wait(&mut child, patience);
    let text = |thread: JoinHandle<String>| thread.join().expect("a reader ends");
    let (output, errors) = (text(output), text(errors));
    assert!(code.is_some(), "{command:?} was ended after {patience:?}:\n{output}{errors}");
    (code, output, errors)
}

fn reader(mut pipe: impl Read + Send + 'static) -> JoinHandle<String> {
    std::thread::spawn(move || {
        let mut bytes = Vec::new();
        pipe.read_to_end(&mut bytes).expect("a pipe can be read");
        // Open MPI 5 ends its own words with a zero byte, which may stand before a line of ours.
        String::from_utf8_lossy(&bytes).replace('\0', "")
    })
}

/// Exit code; `None` if the command was told to end because it took too long.
fn wait(child: &mut Child, patience: Duration) -> Option<i32> {
    let start = Instant::now();
    while start.elapsed() < patience {
        if let Some(status) = child.try_wait().expect("a child can be waited for") {
            return Some(status.code().unwrap_or(-1));
        }
        std::thread::sleep(Duration::from_millis(5));
    }
    // The polite signal: mpirun passes it on to the ranks.
    kill_process(Pid::from_child(child), Signal::TERM).expect("a child can be told to end");
    child.wait().expect("a child can be waited for");
    None
}
