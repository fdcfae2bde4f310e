//! Signals that end a run or a study in order, and what they leave.

use crate::support::names_in;
use crate::support::process::ENVIRONMENT;
use rustix::process::{Pid, Signal, kill_process};
use serde_json::Value;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// A run that was told to end has ended after that.
const SOON: Duration = Duration::from_secs(10);

/// `mezha` with these words in a folder, under `mpirun` if there are ranks.
fn start(folder: &Path, ranks: Option<usize>, line: &str) -> Child {
    let mezha = env!("CARGO_BIN_EXE_mezha");
    // A shell that runs the tests in the background has told them to ignore SIGINT.
    let mut command = Command::new("env");
    command.arg("--default-signal=INT");
    match ranks {
        Some(ranks) => command.args(["mpirun", "-n", &ranks.to_string(), "--oversubscribe", "--bind-to", "none", mezha]),
        None => command.arg(mezha),
    };
    command.args(line.split_whitespace()).current_dir(folder).envs(ENVIRONMENT);
    command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::piped());
    command.spawn().expect("mezha starts")
}

/// A run that takes a while.
fn long_run(out: &str) -> String {
    let file = format!("{}/cases/bars_inclined/even.toml", env!("CARGO_MANIFEST_DIR"));
    let settings = "--set contact.seam.segments=auto --set exact.must_hold=false --set mesh.refine=7";
    format!("run {file} --out {out} {settings}")
}

fn wait_until(is_so: impl Fn() -> bool) {
    let start = Instant::now();
    while !is_so() {
        assert!(start.elapsed() < Duration::from_secs(60), "it never comes");
        std::thread::sleep(Duration::from_millis(5));
    }
}

/// The exit code of a child that is to end soon, and what it said on standard error.
fn end(child: Child) -> (Option<i32>, String) {
    let start = Instant::now();
    let ended = child.wait_with_output().expect("a child ends");
    assert!(start.elapsed() < SOON);
    (ended.status.code(), String::from_utf8_lossy(&ended.stderr).into_owned())
}

/// Processes whose parent this is, in order.
fn children(parent: u32) -> Vec<Pid> {
    let entries = std::fs::read_dir("/proc").expect("/proc").flatten();
    let numbers = entries.filter_map(|entry| entry.file_name().to_str()?.parse::<i32>().ok());
    let is_child = |number: &i32| {
        let stat = std::fs::read_to_string(format!("/proc/{number}/stat")).unwrap_or_default();
        stat.rsplit_once(')').and_then(|(_, rest)| rest.split_whitespace().nth(1)) == Some(&parent.to_string())
    };
    let mut found: Vec<i32> = numbers.filter(is_child).collect();
    found.sort_unstable();
    found.into_iter().filter_map(Pid::from_raw).collect()
}

/// Whether this `mpirun` is that of Open MPI 5: it hands on nothing of what its programs say after a signal to itself, and leaves
/// them no time to clear away what a killed rank 0 has begun. The next run does that.
fn is_abrupt() -> bool {
    !mezha::petsc::versions::mpi().starts_with("Open MPI v4")
}

/// The summary of an interrupted run, alone in its folder with its case, and with its mesh if that was read.
fn interrupted(out: &Path) -> Value {
    let text = std::fs::read_to_string(out.join("summary.json")).expect("a summary");
    let summary: Value = serde_json::from_str(&text).expect("JSON");
    assert_eq!(summary["status"], "interrupted", "{text}");
    assert!(summary["contact"].as_object().is_some_and(|contacts| contacts.is_empty()) && summary["energy"]["total"].is_null());
    let provenance = &summary["provenance"];
    let names = ["case.msh", "case.toml", "report.html", "summary.json"];
    assert_eq!(names_in(out), names[usize::from(provenance["mesh_hash"].is_null())..]);
    assert!(provenance["case_hash"].as_str().is_some_and(|hash| hash.len() == 64) && provenance["date"].is_string(), "{text}");
    assert!(summary["time_s"]["total"].as_f64().is_some_and(|seconds| seconds > 0.0));
    summary
}

#[test]
fn a_run_that_a_signal_ends_tells_what_was_reached() {
    for (ranks, signal, name) in [
        (None, Signal::TERM, "SIGTERM"),
        (None, Signal::INT, "SIGINT"),
        (Some(1), Signal::TERM, "SIGTERM"),
        (Some(2), Signal::INT, "SIGTERM"),
    ] {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let child = start(folder.path(), ranks, &long_run("result"));
        wait_until(|| !names_in(folder.path()).is_empty());
        std::thread::sleep(Duration::from_millis(300));
        kill_process(Pid::from_child(&child), signal).expect("a child can be told to end");
        let (code, errors) = end(child);
        assert_eq!((code, names_in(folder.path())), (Some(1), vec!["result".into()]), "{ranks:?} {name}: {errors}");
        let summary = interrupted(&folder.path().join("result"));
        let reason = summary["reason"].as_str().expect("a reason");
        assert!(reason.starts_with(&format!("interrupted by {name} after ")), "{ranks:?}: {reason}");
        if ranks.is_none() || !is_abrupt() {
            assert!(errors.contains(&format!("mezha: {reason}")), "{errors}");
            assert_eq!(errors.matches("mezha: ").count(), 1, "{errors}");
        }
    }
}

/// Whichever rank is told, all end; a rank that is killed is no result either. An older result is replaced by the truth.
#[test]
fn a_signal_to_one_rank_ends_all() {
    for (rank, signal, code, left) in
        [(0, Signal::TERM, 1, 1), (1, Signal::TERM, 1, 1), (0, Signal::KILL, 137, 0), (1, Signal::KILL, 137, 1)]
    {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let child = start(folder.path(), Some(2), &long_run("result"));
        wait_until(|| !names_in(folder.path()).is_empty() && children(child.id()).len() == 2);
        std::thread::sleep(Duration::from_millis(300));
        kill_process(children(child.id())[rank], signal).expect("a rank can be told to end");
        let (found, errors) = end(child);
        let mut names = names_in(folder.path());
        names.retain(|name| !(is_abrupt() && name.starts_with(".result.")));
        assert_eq!((found, names.len()), (Some(code), left), "rank {rank}: {errors}");
        if left > 0 {
            interrupted(&folder.path().join("result"));
        }
    }
}

#[test]
fn an_older_result_does_not_pass_for_that_of_an_interrupted_run() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let out = folder.path().join("result");
    std::fs::create_dir(&out).expect("a folder");
    let summary = r#"{"mezha": "0.1.0", "status": "converged", "files": ["fields.vtu", "summary.json"]}"#;
    for (name, text) in [("summary.json", summary), ("fields.vtu", "old"), ("notes.md", "mine")] {
        std::fs::write(out.join(name), text).expect("a file");
    }
    let child = start(folder.path(), None, &format!("{} --force", long_run("result")));
    wait_until(|| names_in(folder.path()).len() == 2);
    kill_process(Pid::from_child(&child), Signal::TERM).expect("a child can be told to end");
    let (code, errors) = end(child);
    // The mesh is there if it was read before the signal came.
    let left: Vec<String> = names_in(&out).into_iter().filter(|name| name != "case.msh").collect();
    assert_eq!(
        (code, left),
        (Some(1), ["case.toml", "notes.md", "report.html", "summary.json"].map(String::from).to_vec()),
        "{errors}"
    );
    assert!(std::fs::read_to_string(out.join("summary.json")).expect("a summary").contains("interrupted"));
}

/// A study ends with the run that it makes, keeps those before, and says how it goes on.
#[test]
fn a_study_that_a_signal_ends_keeps_what_is_made() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let case = format!("{}/cases/bars_inclined/even.toml", env!("CARGO_MANIFEST_DIR"));
    let text = format!(
        "cases = [\"{case}\"]\nranks = [1]\nrepeat = 1\nerror = \"estimate.energy\"\n[grid]\n\"mesh.refine\" = [0, 8]\n\"contact.seam.segments\" = [\"auto\"]\n\"exact.must_hold\" = [false]\n"
    );
    std::fs::write(folder.path().join("study.toml"), text).expect("a file");
    let child = start(folder.path(), None, "study study.toml --out grid");
    wait_until(|| all_names(folder.path()).iter().any(|name| name.starts_with(".002.")));
    kill_process(Pid::from_child(&child), Signal::TERM).expect("a child can be told to end");
    let (code, errors) = end(child);
    assert_eq!(code, Some(1), "{errors}");
    assert!(errors.contains("mezha: interrupted by SIGTERM in run 2 of 2; the runs before are kept"), "{errors}");
    let hidden = all_names(&folder.path().join("grid")).into_iter().filter(|name| name.ends_with(".partial")).count();
    assert_eq!(hidden, 0);
}

/// Somebody takes the folder away that a run writes to: the result goes to the working directory, and is named.
#[test]
fn a_result_whose_folder_is_gone_finds_another_one() {
    for ranks in [None, Some(2)] {
        let folder = tempfile::tempdir().expect("a temporary folder");
        // It is not interrupted, so that it need not be long: only longer than it takes to see its folder.
        let line = long_run("out/result").replace("refine=7", "refine=6") + " --set output.fields=false";
        let child = start(folder.path(), ranks, &line);
        wait_until(|| all_names(folder.path()).iter().any(|name| name.starts_with(".result.")));
        std::fs::remove_dir_all(folder.path().join("out")).expect("a folder that can be removed");
        let ended = child.wait_with_output().expect("a child ends");
        let (code, errors) = (ended.status.code(), String::from_utf8_lossy(&ended.stderr).into_owned());
        assert!(code == Some(1) && errors.contains("not lost: the result is in `mezha-result-"), "{code:?}: {errors}");
        let names = names_in(folder.path());
        let place = folder.path().join(names.iter().find(|name| name.starts_with("mezha-result-")).expect("a result"));
        let summary = std::fs::read_to_string(place.join("summary.json")).expect("a summary");
        assert!(summary.contains("\"status\": \"converged\"") && place.join("contacts.csv").is_file(), "{summary}");
        assert_eq!(names.len(), 1, "{names:?}");
    }
}

fn all_names(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let of = |entry: std::fs::DirEntry| {
        let mut names = if entry.path().is_dir() { all_names(&entry.path()) } else { Vec::new() };
        names.push(entry.file_name().to_string_lossy().into_owned());
        names
    };
    entries.flat_map(of).collect()
}
