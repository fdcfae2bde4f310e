//! What a result is made of: provenance, the case as it is run, and its mesh. With these a result folder repeats its run.

use super::RunError;
use crate::case::{Case, sha256};
use crate::origin::{COMMIT, COMPILER};
use crate::output::summary::Provenance;
use crate::output::{OutputError, ResultFolder, Summary, whole_machine};
use crate::petsc::{Session, options, versions};
use rustix::system::uname;
use std::path::Path;
use std::time::SystemTime;

/// The mesh of a case, in the folder of its result.
const MESH: &str = "case.msh";

/// Size of a mesh file (bytes) above which a result names it and holds no copy: macro meshes are small, and studies have many
/// results.
const MOST_COPIED: usize = 4 << 20;

/// Hosts that are told by name.
const MOST_HOSTS: usize = 8;

/// What a result is made of.
#[derive(Clone, Debug, Default)]
pub struct ResultOrigin {
    /// As the summary tells it.
    pub provenance: Provenance,
    /// The resolved case, as it is written beside the summary.
    case: String,
    /// Bytes of the mesh, if they are copied; on rank 0.
    mesh: Option<Vec<u8>>,
}

impl ResultOrigin {
    /// What is known before the mesh is read. **Collective**
    pub fn new(case: &Case, session: &Session) -> Self {
        let petsc_options = options::of_user(session).join(" ");
        let provenance = Provenance {
            commit: known(COMMIT),
            petsc: versions::petsc(),
            mpi: versions::mpi(),
            blas: versions::blas(),
            compiler: known(COMPILER),
            command: command(session.size()),
            directory: std::env::current_dir().map_or_else(|_| String::new(), |folder| folder.display().to_string()),
            petsc_options,
            case_hash: sha256(case.resolved_with_mesh(MESH).as_bytes()),
            mesh_hash: None,
            mesh_file: std::path::absolute(&case.mesh.file).unwrap_or_else(|_| case.mesh.file.clone()).display().to_string(),
            host: hosts(session),
            cpu: whole_machine(),
            ranks: session.size(),
            date: humantime::format_rfc3339_seconds(SystemTime::now()).to_string(),
        };
        Self { provenance, case: case.resolved(), mesh: None }
    }

    /// The resolved case, as it is written beside the summary.
    pub fn case(&self) -> &str {
        &self.case
    }

    /// The same with the bytes of the mesh file, on rank 0.
    pub fn with_mesh(mut self, case: &Case, bytes: Vec<u8>) -> Self {
        self.provenance.mesh_hash = Some(sha256(&bytes));
        if bytes.len() <= MOST_COPIED {
            self.case = case.resolved_with_mesh(MESH);
            self.mesh = Some(bytes);
        }
        self
    }

    /// The case of a load step, as it is written to a folder so many levels inside that of the result.
    pub fn case_inside(&self, step: &Case, levels: usize) -> String {
        match &self.mesh {
            Some(_) => step.resolved_with_mesh(&format!("{}{MESH}", "../".repeat(levels))),
            None => step.resolved(),
        }
    }

    /// What made the result that lies beside a case file, if that file is in a result folder and still the same; on rank 0.
    pub fn before(&self, case: &Case) -> Option<Provenance> {
        let summary = case.file.with_file_name("summary.json");
        let before = Summary::read(&summary).ok()?.provenance?;
        (before.case_hash == self.provenance.case_hash).then_some(before)
    }

    /// Refuses another mesh than that of the result beside an unchanged case.
    ///
    /// # Errors
    /// [`RunError::Input`] with both hashes and the remedy.
    pub fn refuse_other_mesh(&self, case: &Case, before: &Provenance) -> Result<(), RunError> {
        match (&self.provenance.mesh_hash, &before.mesh_hash) {
            (Some(now), Some(then)) if now != then => Err(RunError::Input(format!(
                "{}: mesh.file = {}: the mesh has changed since the result beside the case was made (SHA-256 {then} then, {now} now), so that the run cannot be repeated; put the old mesh back, or copy case.toml and the mesh to a folder of their own to run the new one",
                case.file.display(),
                case.mesh.file.display()
            ))),
            _ => Ok(()),
        }
    }

    /// Writes the case and, unless it is large, its mesh.
    ///
    /// # Errors
    /// The operating system refuses.
    pub fn write(&self, folder: &ResultFolder) -> Result<(), OutputError> {
        let write = |name: &str, bytes: &[u8]| {
            let path = folder.path(name);
            std::fs::write(&path, bytes).map_err(OutputError::io("write", &path))
        };
        write("case.toml", self.case.as_bytes())?;
        self.mesh.as_ref().map_or(Ok(()), |bytes| write(MESH, bytes))
    }
}

/// What is said of a run that may repeat the result beside its case: the words, and whether they are a warning.
pub fn repeats(now: &Provenance, before: &Provenance, file: &Path) -> (String, bool) {
    let differences = now.differences(before);
    if differences.is_empty() {
        return ("repeats the result beside the case file".into(), false);
    }
    let mut words = format!("not the same run as the result beside the case file: {}", differences.join("; "));
    let needs_options = now.petsc_options != before.petsc_options;
    if needs_options {
        let mpirun = if before.ranks > 1 { format!("mpirun -n {} ", before.ranks) } else { String::new() };
        let file = shlex::try_quote(&file.to_string_lossy()).map_or_else(|_| String::new(), |word| word.into_owned());
        let options = if before.petsc_options.is_empty() { String::new() } else { format!(" -- {}", before.petsc_options) };
        words += &format!("; `{mpirun}mezha run {file}{options}` repeats it");
    }
    (words, needs_options)
}

/// A word that the build knew.
fn known(word: &str) -> Option<String> {
    (!word.is_empty() && word != "unknown").then(|| word.to_owned())
}

/// The command of this process, as a shell takes it.
fn command(ranks: usize) -> String {
    let words: Vec<String> = std::env::args_os().map(|word| word.to_string_lossy().into_owned()).collect();
    let own = shlex::try_join(words.iter().map(String::as_str)).unwrap_or_default();
    if ranks > 1 { format!("mpirun -n {ranks} {own}") } else { own }
}

/// Names of all hosts, each once, in the order of the ranks. **Collective**
fn hosts(session: &Session) -> String {
    let own = format!("{}\n", uname().nodename().to_string_lossy());
    let all = session.gather_all(own.as_bytes());
    listed_once(&String::from_utf8_lossy(&all))
}

/// Lines, each once; of many the first, and how many there are.
fn listed_once(lines: &str) -> String {
    let mut names: Vec<&str> = Vec::new();
    for name in lines.lines() {
        if names.last() != Some(&name) && !names.contains(&name) {
            names.push(name);
        }
    }
    let first = names[..names.len().min(MOST_HOSTS)].join(", ");
    if names.len() > MOST_HOSTS { format!("{first}, ... ({} hosts)", names.len()) } else { first }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hosts_are_told_once_and_not_all_of_many() {
        assert_eq!(listed_once("a\na\nb\na\n"), "a, b");
        let many: String = (0..20).map(|k| format!("n{k}\nn{k}\n")).collect();
        assert_eq!(listed_once(&many), "n0, n1, n2, n3, n4, n5, n6, n7, ... (20 hosts)");
    }

    #[test]
    fn a_run_with_other_options_is_told_how_to_repeat() {
        let before = Provenance { ranks: 2, petsc_options: "-ksp_type gcr".into(), ..Provenance::default() };
        assert_eq!(repeats(&before, &before, Path::new("x")), ("repeats the result beside the case file".into(), false));
        let now = Provenance { petsc_options: String::new(), ..before.clone() };
        let (words, warns) = repeats(&now, &before, Path::new("out/a b/case.toml"));
        assert!(warns && words.ends_with("`mpirun -n 2 mezha run 'out/a b/case.toml' -- -ksp_type gcr` repeats it"), "{words}");
        let fewer = Provenance { ranks: 1, ..before.clone() };
        let (words, warns) = repeats(&fewer, &before, Path::new("x"));
        assert!(!warns && words.ends_with("ranks: 1 instead of 2"), "{words}");
    }
}
