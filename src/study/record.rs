//! What a finished run was made of, so that another call knows it again.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;

use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::ended::{Ended, Status};
use super::plan::PlannedRun;
use crate::case::Case;
use crate::output::OutputError;

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
    pub status: Status,
    /// Why.
    pub reason: String,
    /// From its start to its end, in seconds.
    pub wall_s: f64,
    /// Seconds that it was given.
    pub timeout_s: f64,
    /// Where it was made.
    pub machine: String,
}

/// The program that makes the runs: this one.
#[derive(Clone, Debug)]
pub struct Program {
    /// Where it is.
    pub path: PathBuf,
    fingerprint: String,
}

impl Program {
    /// This program.
    ///
    /// # Errors
    /// The operating system does not say where it is, or does not let it be read.
    pub fn this() -> Result<Self, OutputError> {
        let path = std::env::current_exe().map_err(OutputError::io("find", Path::new("mezha")))?;
        let bytes = fs::read(&path).map_err(OutputError::io("read", &path))?;
        Ok(Self { path, fingerprint: fingerprint(&[&bytes]) })
    }

    /// What a run of this program is made of.
    pub fn identity(&self, run: &PlannedRun) -> Identity {
        let case = fs::read(&run.file).unwrap_or_default();
        let mesh = Case::read(&run.file, &run.overrides).ok().and_then(|case| fs::read(case.mesh.file).ok()).unwrap_or_default();
        let mut overrides = run.overrides.clone();
        overrides.sort();
        let options = std::env::var("PETSC_OPTIONS").unwrap_or_default();
        let input = fingerprint(&[&case, overrides.join("\n").as_bytes(), &mesh, options.as_bytes()]);
        let mezha = env!("CARGO_PKG_VERSION").into();
        Identity { mezha, program: self.fingerprint.clone(), input, ranks: run.ranks, repeat: run.repeat }
    }
}

impl Record {
    /// What is known of a run that has just ended.
    pub fn new(study: &str, run: &PlannedRun, identity: &Identity, timeout: Duration, ended: &Ended) -> Self {
        Self {
            study: study.into(),
            what: what(run),
            identity: identity.clone(),
            status: ended.status,
            reason: ended.reason.clone(),
            wall_s: ended.wall.as_secs_f64(),
            timeout_s: timeout.as_secs_f64(),
            machine: ended.machine.clone(),
        }
    }

    /// The run as it ended, with its summary; None if it has to be made again: it failed, it was given less time, or its result
    /// is gone.
    pub fn ended(&self, summary: Value, timeout: Duration, result: &str) -> Option<Ended> {
        let stands = match self.status {
            Status::Converged | Status::NotConverged => !summary.is_null(),
            Status::Refused => true,
            Status::Timeout => self.timeout_s >= timeout.as_secs_f64(),
            Status::Failed => false,
        };
        let result = if summary.is_null() { String::new() } else { result.into() };
        stands.then(|| Ended {
            status: self.status,
            reason: self.reason.clone(),
            summary,
            wall: Duration::from_secs_f64(self.wall_s.max(0.0)),
            result,
            machine: self.machine.clone(),
        })
    }
}

/// Case file and overrides, in words.
pub fn what(run: &PlannedRun) -> String {
    let overrides = run.overrides.iter().map(|text| format!(" --set {text}"));
    format!("{}{}", run.file.display(), overrides.collect::<String>())
}

/// The 64-bit hash of Fowler, Noll and Vo (FNV-1a) of some texts and their lengths, in hexadecimal digits.
fn fingerprint(texts: &[&[u8]]) -> String {
    let lengths: Vec<[u8; 8]> = texts.iter().map(|text| (text.len() as u64).to_le_bytes()).collect();
    let bytes = lengths.iter().flatten().chain(texts.iter().copied().flatten());
    let hash = bytes.fold(0xcbf2_9ce4_8422_2325_u64, |hash, &byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3));
    format!("{hash:016x}")
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
        let program = Program { path: PathBuf::new(), fingerprint: "a".into() };
        let plain = run(folder.path(), &["mesh.refine=1", "mesh.order=2"]);
        let first = program.identity(&plain);
        assert_eq!(program.identity(&PlannedRun { curve: Some("renamed".into()), ..plain.clone() }), first);
        assert_eq!(program.identity(&run(folder.path(), &["mesh.order=2", "mesh.refine=1"])), first, "another order");
        let others = [
            program.identity(&run(folder.path(), &["mesh.refine=2", "mesh.order=2"])),
            program.identity(&run(folder.path(), &["mesh.refine=1", "mesh.order=2", "mesh.file=\"b.msh\""])),
            program.identity(&PlannedRun { ranks: 2, ..plain.clone() }),
            program.identity(&PlannedRun { repeat: 2, ..plain.clone() }),
            Program { fingerprint: "b".into(), ..program.clone() }.identity(&plain),
        ];
        assert!(others.iter().all(|other| *other != first));
        write("a.msh", "a mesh, corrected");
        assert_ne!(program.identity(&plain), first);
        write("a.msh", "a mesh");
        assert_eq!(program.identity(&plain), first);
        write("case.toml", &case.replace("0.3", "0.2"));
        assert_ne!(program.identity(&plain), first);
    }

    #[test]
    fn fingerprints_tell_texts_apart() {
        assert_eq!(fingerprint(&[]), "cbf29ce484222325");
        assert_ne!(fingerprint(&[b"ab", b"c"]), fingerprint(&[b"a", b"bc"]));
        assert_ne!(fingerprint(&[b""]), fingerprint(&[b"", b""]));
    }

    #[test]
    fn a_record_stands_if_making_it_again_would_say_the_same() {
        let identity = Identity { mezha: "1".into(), program: "2".into(), input: "3".into(), ranks: 2, repeat: 1 };
        let record = |status| Record {
            study: "hard".into(),
            what: "bars".into(),
            identity: identity.clone(),
            status,
            reason: "why".into(),
            wall_s: 1.5,
            timeout_s: 10.0,
            machine: "here".into(),
        };
        let (summary, short, long) = (json!({ "status": "converged" }), Duration::from_secs(10), Duration::from_secs(11));
        let stands = |status, summary: &Value, timeout| record(status).ended(summary.clone(), timeout, "runs/001").is_some();
        assert!(stands(Status::Converged, &summary, long) && !stands(Status::Converged, &Value::Null, long));
        assert!(stands(Status::NotConverged, &summary, long) && !stands(Status::NotConverged, &Value::Null, long));
        assert!(stands(Status::Refused, &Value::Null, long));
        assert!(stands(Status::Timeout, &Value::Null, short) && !stands(Status::Timeout, &Value::Null, long));
        assert!(!stands(Status::Failed, &summary, short));
        let text = serde_json::to_string(&record(Status::NotConverged)).unwrap();
        assert!(text.contains("\"not_converged\"") && text.contains("\"input\":\"3\""), "{text}");
        assert_eq!(serde_json::from_str::<Record>(&text).unwrap(), record(Status::NotConverged));
    }
}
