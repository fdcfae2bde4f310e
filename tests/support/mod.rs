//! What the tests of the whole program share: [`Run`] starts it under `mpirun` and reads its results back, [`mesh`] writes
//! meshes for it.

#![allow(dead_code)] // Each test program uses a part of it.

pub mod mesh;
pub mod process;

use serde_json::Value;
use std::fmt::Display;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// The numbers of ranks that everything must hold on.
pub const RANKS: [usize; 3] = [1, 2, 3];

/// All pairs of a displacement order and a multiplier space.
pub const PAIRS: [(usize, &str); 6] =
    [(1, "p0"), (1, "p1-discontinuous"), (1, "p1-continuous"), (2, "p0"), (2, "p1-discontinuous"), (2, "p1-continuous")];

/// Whether everything is run that must hold, as by `ci/test --long`: `ALL_RANKS` is set.
pub fn is_long() -> bool {
    std::env::var_os("ALL_RANKS").is_some()
}

/// Numbers of ranks for run `at` of many that are alike: two, and in turn one or three; all of [`RANKS`] if [`is_long`].
pub fn ranks_in_turn(at: usize) -> Vec<usize> {
    RANKS.into_iter().filter(|ranks| is_long() || *ranks == 2 || *ranks == [1, 3][at % 2]).collect()
}

/// All of [`PAIRS`] on [`ranks_in_turn`].
pub fn pairs_on_ranks() -> impl Iterator<Item = (usize, &'static str, usize)> {
    let pairs = PAIRS.into_iter().enumerate();
    pairs.flat_map(|(at, (order, space))| ranks_in_turn(at).into_iter().map(move |ranks| (order, space, ranks)))
}

/// A run of `mezha run`, to be started.
#[derive(Clone)]
pub struct Run {
    file: PathBuf,
    ranks: Option<usize>,
    words: Vec<String>,
    petsc: Vec<String>,
    has_grace: bool,
    patience: Duration,
}

/// How a run ended, with its result folder while this lives.
pub struct Ended {
    /// Its exit code.
    pub code: Option<i32>,
    /// Standard output of all ranks.
    pub output: String,
    /// Standard error of all ranks.
    pub errors: String,
    /// How long it took.
    pub time: Duration,
    /// The folder it was told to write to.
    pub out: PathBuf,
    folder: TempDir,
}

/// One line of `contact_NAME.csv`.
#[derive(Clone, Copy, Debug, Default)]
pub struct TracePoint {
    pub s: f64,
    pub x: [f64; 2],
    pub lambda: f64,
    pub gap: f64,
    pub un: [f64; 2],
    pub sigma: [f64; 2],
}

impl Run {
    /// A case of the project: the name of its folder, or a file in `cases`.
    pub fn case(name: &str) -> Self {
        let cases = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases");
        Self::file(&if name.ends_with(".toml") { cases.join(name) } else { cases.join(name).join("case.toml") })
    }

    /// Any case file.
    pub fn file(file: &Path) -> Self {
        Self {
            file: file.to_path_buf(),
            ranks: Some(1),
            words: Vec::new(),
            petsc: Vec::new(),
            has_grace: false,
            patience: process::PATIENCE,
        }
    }

    /// On so many ranks.
    pub fn ranks(mut self, ranks: usize) -> Self {
        self.ranks = Some(ranks);
        self
    }

    /// Without `mpirun`.
    pub fn alone(mut self) -> Self {
        self.ranks = None;
        self
    }

    /// Leaves its ranks the second that mpirun leaves them by default to clear away what they have begun.
    pub fn with_grace(mut self) -> Self {
        self.has_grace = true;
        self
    }

    /// Ends it after this time at the latest.
    pub fn within(mut self, patience: Duration) -> Self {
        self.patience = patience;
        self
    }

    /// Overrides a key of the case.
    pub fn set(self, key: &str, value: impl Display) -> Self {
        self.word("--set").word(&format!("{key}={value}"))
    }

    /// Adds a word to the command line.
    pub fn word(mut self, word: &str) -> Self {
        self.words.push(word.into());
        self
    }

    /// Adds PETSc options, separated by blanks.
    pub fn petsc(mut self, options: &str) -> Self {
        self.petsc.extend(options.split(' ').map(String::from));
        self
    }

    /// Runs to its end, into a folder of its own.
    pub fn ended(self) -> Ended {
        let folder = tempfile::tempdir().expect("a temporary folder");
        self.ended_in(folder)
    }

    /// Runs to its end, into `result` of that folder.
    pub fn ended_in(self, folder: TempDir) -> Ended {
        let out = folder.path().join("result");
        let mut words = vec!["run".into(), self.file.display().to_string()];
        words.extend(["--out".into(), out.display().to_string()]);
        words.extend(self.words);
        if !self.petsc.is_empty() {
            words.push("--".into());
            words.extend(self.petsc);
        }
        let start = Instant::now();
        let mut command = command_in(Path::new("."), self.ranks, &words);
        if self.has_grace {
            command.envs(process::GRACE.map(|name| (name, "1")));
        }
        let (code, output, errors) = process::finish_within(command, self.patience);
        Ended { code, output, errors, time: start.elapsed(), out, folder }
    }

    /// Runs to its end: solved, on whatever mesh; one that is too coarse for the scene is said to be.
    pub fn solved(self) -> Ended {
        let ended = self.ended();
        assert!(["converged", "unresolved"].iter().any(|status| ended.value("/status") == *status), "{}", ended.said());
        ended
    }

    /// Runs to its end, which must be exit code 0.
    pub fn converged(self) -> Ended {
        let ended = self.ended();
        assert_eq!(ended.code, Some(0), "{}", ended.said());
        ended
    }
}

impl Ended {
    /// Everything it printed.
    pub fn said(&self) -> String {
        format!("{}{}", self.output, self.errors)
    }

    /// The folder itself, for a second run.
    pub fn into_folder(self) -> TempDir {
        self.folder
    }

    /// Everything in the folder that it was started in; empty after a run that left no result.
    pub fn left_behind(&self) -> Vec<String> {
        names_in(self.folder.path())
    }

    /// The whole `summary.json`.
    pub fn summary(&self) -> Value {
        let file = self.out.join("summary.json");
        let text = std::fs::read_to_string(&file).unwrap_or_else(|error| panic!("{file:?}: {error}\n{}", self.said()));
        serde_json::from_str(&text).expect("summary.json is JSON")
    }

    /// A value of the summary by its path, as in `/energy/total`.
    pub fn value(&self, path: &str) -> Value {
        let summary = self.summary();
        summary.pointer(path).unwrap_or_else(|| panic!("summary.json has no {path}: {summary:#}")).clone()
    }

    /// A number of the summary by its path.
    pub fn number(&self, path: &str) -> f64 {
        self.value(path).as_f64().unwrap_or_else(|| panic!("{path} is no number: {}", self.value(path)))
    }

    /// Krylov iterations of all linear solves.
    pub fn iterations(&self) -> u64 {
        self.value("/solver/iterations").as_array().expect("a list").iter().filter_map(Value::as_u64).sum()
    }

    /// The trace along a contact boundary.
    pub fn trace(&self, contact: &str) -> Vec<TracePoint> {
        let text = std::fs::read_to_string(self.out.join(format!("contact_{contact}.csv"))).expect("a contact table");
        let mut lines = text.lines().skip_while(|line| line.starts_with('#'));
        assert_eq!(lines.next(), Some("s,x,y,nx,ny,lambda,gap,un_1,un_2,sigma_1,sigma_2"));
        let point = |line: &str| {
            let v: Vec<f64> = line.split(',').map(|number| number.parse().expect("a number")).collect();
            TracePoint { s: v[0], x: [v[1], v[2]], lambda: v[5], gap: v[6], un: [v[7], v[8]], sigma: [v[9], v[10]] }
        };
        lines.map(point).collect()
    }
}

/// Sorted names of what is in a folder.
pub fn names_in(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).expect("a folder");
    let mut names: Vec<String> = entries.map(|e| e.expect("an entry").file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

/// Largest difference of two lists of numbers, relative to the largest of the second.
pub fn difference(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    let size = b.iter().fold(0.0, |size: f64, v| size.max(v.abs()));
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / size
}

/// Runs mezha with these words, under `mpirun` unless `ranks` is `None`: exit code, standard output, standard error.
///
/// # Panics
/// If it takes too long.
pub fn mezha<S: AsRef<str>>(ranks: Option<usize>, words: &[S]) -> (Option<i32>, String, String) {
    let mut words: Vec<String> = words.iter().map(|word| word.as_ref().into()).collect();
    // The figure of a check goes where it is cleaned away.
    let folder = tempfile::tempdir().expect("a temporary folder");
    if words.first().is_some_and(|word| word == "check") {
        words.extend(["--draw".into(), folder.path().join("scene.svg").display().to_string()]);
    }
    mezha_in(Path::new("."), ranks, &words)
}

/// Runs mezha in a folder with these words, under `mpirun` unless `ranks` is `None`: exit code, standard output, standard error.
///
/// # Panics
/// If it takes too long.
pub fn mezha_in<S: AsRef<str>>(folder: &Path, ranks: Option<usize>, words: &[S]) -> (Option<i32>, String, String) {
    process::finish(command_in(folder, ranks, words))
}

/// The command that [`mezha_in`] runs.
fn command_in<S: AsRef<str>>(folder: &Path, ranks: Option<usize>, words: &[S]) -> Command {
    let mut command = Command::new("mpirun");
    match ranks {
        Some(ranks) => {
            command.args(["-n", &ranks.to_string(), "--oversubscribe", "--bind-to", "none"]).arg(env!("CARGO_BIN_EXE_mezha"))
        }
        None => {
            command = Command::new(env!("CARGO_BIN_EXE_mezha"));
            &mut command
        }
    };
    command.args(words.iter().map(S::as_ref)).env("PETSC_OPTIONS", "").current_dir(folder);
    command
}

/// Meets an exact value to 1e-9 of a size.
pub fn close(found: f64, wanted: f64, size: f64, words: &str) {
    assert!((found - wanted).abs() <= 1e-9 * size, "{words}: {found} instead of {wanted}");
}

/// Both components of a vector of the summary.
pub fn numbers(ended: &Ended, pointer: &str) -> [f64; 2] {
    [0, 1].map(|k| ended.number(&format!("{pointer}/{k}")))
}

/// Runs a case with P1 and P2, on 1, 2 and 3 ranks, and checks each result; the words name it.
pub fn with_both_orders(mesh: &mesh::Mesh, case: &str, check: impl Fn(&str, Ended)) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = mesh::write_scene(folder.path(), &mesh.text(), case);
    for (order, ranks) in [(1, 1), (1, 3), (2, 1), (2, 2), (2, 3)] {
        let ended = Run::file(&file).ranks(ranks).set("mesh.order", order).converged();
        check(&format!("P{order}, {ranks} ranks"), ended);
    }
}
