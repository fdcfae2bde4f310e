//! The line that says where a run is: on a terminal, and nowhere else.

use std::path::Path;
use std::process::{Command, Stdio};

/// Refined so far that it takes some seconds: the line begins after the first one.
const LONG: &str =
    "run cases/bars_inclined/even.toml --set mesh.refine=7 --set exact.must_hold=false --set output.fields=false --force";

/// A command with the environment that mpirun wants.
fn command(program: &str) -> Command {
    let mut command = Command::new(program);
    command.current_dir(env!("CARGO_MANIFEST_DIR")).stdin(Stdio::null()).env("TERM", "xterm");
    for name in ["OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "OMP_NUM_THREADS", "OMPI_MCA_mpi_yield_when_idle"] {
        command.env(name, "1");
    }
    command
}

/// What a shell command puts on a terminal, by `script` of util-linux.
fn on_a_terminal(line: &str, folder: &Path) -> String {
    let typescript = folder.join("typescript");
    let ended = command("script").args(["-qec", line]).arg(&typescript).output().expect("`script` starts");
    let said = std::fs::read(&typescript).expect("a typescript");
    let said = String::from_utf8_lossy(&said).into_owned();
    assert!(ended.status.success(), "{said}");
    said
}

#[test]
fn a_terminal_shows_where_a_run_is() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let run = format!("{} {LONG} --out {}", env!("CARGO_BIN_EXE_mezha"), folder.path().join("result").display());
    for line in [run.clone(), format!("mpirun -n 2 --oversubscribe --bind-to none {run}")] {
        let said = on_a_terminal(&line, folder.path());
        let lines = said.split("\r\u{1b}[K").skip(1);
        let lines: Vec<&str> = lines.map(|rest| rest.split(['\r', '\n']).next().unwrap_or_default()).collect();
        let told = lines.iter().filter(|line| line.starts_with("0:") || line.starts_with("1:")).count();
        assert!(told > 0, "{line}: {said}");
        // mpirun brings messages and the line on ways of their own, so that a message may come before the line is wiped.
        let is_alone = !line.starts_with("mpirun");
        let are_short = lines.iter().filter(|line| line.starts_with(char::is_numeric)).all(|line| line.chars().count() < 80);
        assert!(!is_alone || are_short, "{said}");
        // What is printed stands on lines of its own.
        let stands = ["\nmezha: converged", "\u{1b}[Kmezha: converged"].iter().any(|words| said.contains(words));
        assert!((!is_alone || stands) && said.contains("residual "), "{said}");
    }
}

/// The window is asked for its size: on a narrow one the line does not wrap.
#[test]
fn a_narrow_terminal_gets_a_short_line() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let run = format!("{} {LONG} --out {}", env!("CARGO_BIN_EXE_mezha"), folder.path().join("result").display());
    for run in [run.clone(), format!("mpirun -n 1 {run}")] {
        let said = on_a_terminal(&format!("stty cols 30; {run}"), folder.path());
        let lines = said.split("\r\u{1b}[K").map(|rest| rest.split(['\r', '\n', '\u{1b}']).next().unwrap_or_default());
        let lengths: Vec<usize> = lines.filter(|line| line.starts_with("0:")).map(|line| line.chars().count()).collect();
        let are_short = run.starts_with("mpirun") || lengths.iter().all(|length| *length <= 29);
        assert!(lengths.contains(&29) && are_short, "{lengths:?}: {said}");
    }
}

#[test]
fn a_pipe_gets_nothing_unless_it_asks() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for (more, is_told) in [("", false), ("--progress always", true)] {
        let mut run = command(env!("CARGO_BIN_EXE_mezha"));
        run.args(LONG.split(' ')).args(more.split_whitespace()).arg("--out").arg(folder.path().join("result"));
        let ended = run.output().expect("mezha starts");
        assert!(ended.status.success());
        let [output, errors] = [ended.stdout, ended.stderr].map(|bytes| String::from_utf8_lossy(&bytes).into_owned());
        assert!(!output.contains('\u{1b}') && output.contains("\nmezha: converged"), "{output}");
        assert_eq!(errors.contains("\r\u{1b}[K0:0"), is_told, "{errors}");
        assert!(is_told || errors.is_empty(), "{errors}");
    }
}
