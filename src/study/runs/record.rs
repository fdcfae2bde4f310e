//! What a finished run was made of, so that another call knows it again.

use std::env::var_os;
use std::fs;
use std::os::unix::fs::MetadataExt;
use std::path::{Path, PathBuf};
use std::time::Duration;

use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::ended::{Ended, RunStatus};
use crate::case::{Case, Inputs, fingerprint};
use crate::output::OutputError;
use crate::study::plan::planned::PlannedRun;

/// Everything that a run depends on: two runs with the same identity are the same run.
#[derive(Clone, Debug, Deserialize, PartialEq, Eq, Serialize)]
pub struct Identity {
    /// Version of mezha.
    pub mezha: String,
    /// Fingerprint of the program itself: a version under development has many.
    pub program: String,
    /// Fingerprint of case, overrides, mesh, and options for PETSc in the environment.
    pub input: String,
    /// Number of ranks.
    pub ranks: usize,
    /// Which of the repeats this is.
    pub repeat: usize,
}

/// A finished run, as it lies beside its result.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct Record {
    /// Name of the study.
    pub study: String,
    /// Case file and overrides, in words.
    pub what: String,
    /// What it was made of.
    #[serde(flatten)]
    pub identity: Identity,
    /// How it ended.
    #[serde(flatten)]
    pub ended: Ended,
}

/// The program that makes the runs, this one, and what PETSc reads for each of them.
#[derive(Clone, Debug)]
pub struct Program {
    /// Where it is.
    pub path: PathBuf,
    fingerprint: String,
    file: FileState,
    options: String,
}

/// What tells a file from the one that replaces it: device, inode, length, time of the last change.
type FileState = Option<[i64; 5]>;

impl Program {
    /// This program.
    ///
    /// # Errors
    /// The operating system does not say where it is, or does not let it be read.
    pub fn this() -> Result<Self, OutputError> {
        let path = std::env::current_exe().map_err(OutputError::io("find", Path::new("mezha")))?;
        let bytes = fs::read(&path).map_err(OutputError::io("read", &path))?;
        Ok(Self { fingerprint: fingerprint(&[&bytes]), file: file_state(&path), options: petsc_options(), path })
    }

    /// Why runs are no longer made by the program that has begun the study, or with its options; None if they are.
    pub fn change(&self) -> Option<String> {
        if file_state(&self.path) != self.file {
            return Some(format!("{} was replaced after the study had begun; make the study again", self.path.display()));
        }
        let words = "an options file of PETSc (.petscrc) was changed after the study had begun; make the study again";
        (petsc_options() != self.options).then(|| words.into())
    }

    /// What a run of this program is made of, with these inputs.
    pub fn identity(&self, run: &PlannedRun, inputs: &Inputs) -> Identity {
        let mut overrides = run.overrides.clone();
        overrides.sort();
        let overrides = overrides.join("\n");
        let input = fingerprint(&[&inputs.case, &overrides, &inputs.mesh, &self.options].map(|text| text.as_bytes()));
        let mezha = env!("CARGO_PKG_VERSION").into();
        Identity { mezha, program: self.fingerprint.clone(), input, ranks: run.ranks, repeat: run.repeat }
    }
}

impl Record {
    /// The run as it ended, with its summary; None if it has to be made again: it failed, it was given less time, or its result
    /// is gone.
    pub fn kept(&self, summary: Value, timeout: Duration, result: &str) -> Option<Ended> {
        let stands = match self.ended.status {
            RunStatus::Timeout => self.ended.timeout_s >= timeout.as_secs_f64(),
            RunStatus::Failed => false,
            status => status == RunStatus::Refused || !summary.is_null(),
        };
        let result = if summary.is_null() { String::new() } else { result.into() };
        stands.then(|| Ended { summary, result, ..self.ended.clone() })
    }
}

/// What the case file and the mesh of a run are now. The run itself compares it with what it reads.
pub fn inputs(run: &PlannedRun) -> Inputs {
    let case = fs::read(&run.file).unwrap_or_default();
    let text = String::from_utf8(case.clone()).ok();
    let parsed = text.and_then(|text| Case::parse(&text, &run.file, &run.overrides).ok());
    Inputs::of(&case, &parsed.and_then(|case| fs::read(case.mesh.file).ok()).unwrap_or_default())
}

/// Fingerprint of what PETSc reads for every run: two variables of the environment, and files of options.
fn petsc_options() -> String {
    let variables = ["PETSC_OPTIONS", "PETSC_OPTIONS_YAML"].map(|name| var_os(name).unwrap_or_default().into_encoded_bytes());
    let files = [PathBuf::from(var_os("HOME").unwrap_or_default()).join(".petscrc"), ".petscrc".into(), "petscrc".into()];
    let files = files.map(|file| fs::read(file).unwrap_or_default());
    fingerprint(&variables.iter().chain(&files).map(Vec::as_slice).collect::<Vec<_>>())
}

fn file_state(path: &Path) -> FileState {
    let data = fs::metadata(path).ok()?;
    Some([data.dev() as i64, data.ino() as i64, data.len() as i64, data.mtime(), data.mtime_nsec()])
}

/// Case file and overrides, in words.
pub fn what(run: &PlannedRun) -> String {
    let overrides = run.overrides.iter().map(|text| format!(" --set {text}"));
    format!("{}{}", run.file.display(), overrides.collect::<String>())
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn run(folder: &Path, overrides: &[&str]) -> PlannedRun {
        PlannedRun {
            file: folder.join("case.toml"),
            case: "bars".into(),
            title: String::new(),
            curve: None,
            ranks: 1,
            repeat: 1,
            values: Vec::new(),
            overrides: overrides.iter().map(|text| (*text).to_owned()).collect(),
        }
    }

    #[test]
    fn whatever_a_run_depends_on_changes_its_identity() {
        let folder = tempfile::tempdir().unwrap();
        let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
        let case = "mesh.file = 'a.msh'\n[body.a]\nyoung = 1\npoisson = 0.3\n";
        write("case.toml", case);
        write("a.msh", "a mesh");
        write("b.msh", "another mesh");
        let program = Program { path: PathBuf::new(), fingerprint: "a".into(), file: None, options: String::new() };
        let identity = |run: &PlannedRun| program.identity(run, &inputs(run));
        let plain = run(folder.path(), &["mesh.refine=1", "mesh.order=2"]);
        let first = identity(&plain);
        assert_eq!(identity(&PlannedRun { curve: Some("renamed".into()), ..plain.clone() }), first);
        assert_eq!(identity(&run(folder.path(), &["mesh.order=2", "mesh.refine=1"])), first, "another order");
        let others = [
            identity(&run(folder.path(), &["mesh.refine=2", "mesh.order=2"])),
            identity(&run(folder.path(), &["mesh.refine=1", "mesh.order=2", "mesh.file=\"b.msh\""])),
            identity(&PlannedRun { ranks: 2, ..plain.clone() }),
            identity(&PlannedRun { repeat: 2, ..plain.clone() }),
            Program { fingerprint: "b".into(), ..program.clone() }.identity(&plain, &inputs(&plain)),
            Program { options: "-ksp_view".into(), ..program.clone() }.identity(&plain, &inputs(&plain)),
        ];
        assert!(others.iter().all(|other| *other != first));
        write("a.msh", "a mesh, corrected");
        assert_ne!(identity(&plain), first);
        write("a.msh", "a mesh");
        assert_eq!(identity(&plain), first);
        write("case.toml", &case.replace("0.3", "0.2"));
        assert_ne!(identity(&plain), first);
    }

    #[test]
    fn a_program_that_is_replaced_is_another() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("mezha");
        fs::write(&path, "one").unwrap();
        let program =
            Program { file: file_state(&path), path: path.clone(), fingerprint: String::new(), options: petsc_options() };
        assert_eq!(program.change(), None);
        fs::write(folder.path().join("new"), "two").unwrap();
        fs::rename(folder.path().join("new"), &path).unwrap();
        assert!(program.change().unwrap().contains("was replaced after the study had begun"));
        let program = Program { file: file_state(&path), options: String::new(), ..program };
        assert!(program.change().unwrap().contains(".petscrc"));
    }

    #[test]
    fn a_record_stands_if_making_it_again_would_say_the_same() {
        let identity = Identity { mezha: "1".into(), program: "2".into(), input: "3".into(), ranks: 2, repeat: 1 };
        let ended = |status| Ended {
            status,
            reason: "why".into(),
            wall_s: 1.5,
            timeout_s: 10.0,
            machine: "here".into(),
            summary: Value::Null,
            result: String::new(),
        };
        let record =
            |status| Record { study: "hard".into(), what: "bars".into(), identity: identity.clone(), ended: ended(status) };
        let (summary, short, long) = (json!({ "status": "converged" }), Duration::from_secs(10), Duration::from_secs(11));
        let stands = |status, summary: &Value, timeout| record(status).kept(summary.clone(), timeout, "runs/001").is_some();
        assert!(stands(RunStatus::Converged, &summary, long) && !stands(RunStatus::Converged, &Value::Null, long));
        assert!(stands(RunStatus::NotConverged, &summary, long) && !stands(RunStatus::NotConverged, &Value::Null, long));
        assert!(stands(RunStatus::Refused, &Value::Null, long));
        assert!(stands(RunStatus::Timeout, &Value::Null, short) && !stands(RunStatus::Timeout, &Value::Null, long));
        assert!(!stands(RunStatus::Failed, &summary, short));
        let text = serde_json::to_string(&record(RunStatus::NotConverged)).unwrap();
        assert!(text.contains("\"not_converged\"") && text.contains("\"input\":\"3\""), "{text}");
        assert_eq!(serde_json::from_str::<Record>(&text).unwrap(), record(RunStatus::NotConverged));
    }
}
