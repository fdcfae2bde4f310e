//! What a result is made of: provenance, the case as it is run, and its mesh. With these a result folder repeats its run.

use crate::accuracy::Accuracy;
use crate::case::{Case, sha256};
use crate::origin::{COMMIT, COMPILER};
use crate::output::summary::Provenance;
use crate::output::{OutputError, ResultFolder, whole_machine};
use crate::petsc::{Session, options, versions};
use rustix::system::uname;
use std::path::{Path, PathBuf};
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
    pub case: String,
    /// Bytes of the mesh, if they are copied; on rank 0.
    mesh: Option<Vec<u8>>,
}

impl ResultOrigin {
    /// What is known before the mesh is read. **Collective**
    pub fn new(case: &Case, session: &Session) -> Self {
        let petsc_options = options::of_user(session).iter().map(|option| in_shell(option)).collect::<Vec<_>>().join(" ");
        let provenance = Provenance {
            commit: known(COMMIT),
            petsc: versions::petsc(),
            mpi: versions::mpi(),
            blas: versions::blas(),
            compiler: known(COMPILER),
            command: command(session.size()),
            directory: std::env::current_dir().map_or_else(|_| String::new(), |folder| folder.display().to_string()),
            petsc_options,
            case_hash: case_hash(case),
            step_hashes: case.steps.iter().map(|step| case_hash(&step.case)).collect(),
            mesh_hash: None,
            mesh_file: std::path::absolute(&case.mesh.file).unwrap_or_else(|_| case.mesh.file.clone()).display().to_string(),
            host: hosts(session),
            cpu: whole_machine(),
            ranks: session.size(),
            date: humantime::format_rfc3339_seconds(SystemTime::now()).to_string(),
        };
        Self { provenance, case: case.resolved(), mesh: None }
    }

    /// Adds the bytes of the mesh file, on rank 0, for a result in the folder `out`.
    pub fn add_mesh(&mut self, case: &Case, bytes: Vec<u8>, out: &Path) {
        self.provenance.mesh_hash = Some(sha256(&bytes));
        // A result that is replaced may have the only copy of the mesh.
        if bytes.len() <= MOST_COPIED || is_within(&case.mesh.file, out) {
            self.case = case.resolved_with_mesh(MESH);
            self.mesh = Some(bytes);
        }
    }

    /// The case of a load step, as it is written to a folder so many levels inside that of the result.
    pub fn case_inside(&self, step: &Case, levels: usize) -> String {
        match &self.mesh {
            Some(_) => step.resolved_with_mesh(&format!("{}{MESH}", "../".repeat(levels))),
            None => step.resolved(),
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

/// What made the result that a case file lies beside, if case and name of the mesh are still the same; None of a load step too,
/// whose run begins elsewhere. On rank 0.
///
/// # Errors
/// The mesh file has another SHA-256 than that of the result, also of a load step in its folder; words with both and the remedy.
pub fn result_before(case: &Case, mesh: &[u8]) -> Result<Option<Provenance>, String> {
    let beside = case.file.parent().unwrap_or(Path::new(""));
    let hash = case_hash(case);
    let above = beside.join("../..");
    let whole = Provenance::of_result(beside).filter(|before| before.case_hash == hash);
    let is_whole = whole.is_some();
    let step = || Provenance::of_result(&above).filter(|before| before.step_hashes.contains(&hash));
    let Some(before) = whole.or_else(step) else { return Ok(None) };
    let copy = if is_whole { beside } else { &above }.join(MESH);
    let named = if copy.is_file() { copy } else { PathBuf::from(&before.mesh_file) };
    if !is_same_file(&case.mesh.file, &named) {
        return Ok(None);
    }
    let now = sha256(mesh);
    match &before.mesh_hash {
        Some(then) if *then != now => Err(format!(
            "{}: mesh.file = {}: the mesh has changed since {} was made (SHA-256 {then} then, {now} now), so that the run cannot be repeated; put the old mesh back, or copy case.toml and the mesh to a folder of their own to run the new one",
            case.file.display(),
            case.mesh.file.display(),
            if is_whole { "the result beside the case" } else { "the result with this load step" }
        )),
        _ => Ok(Some(before).filter(|_| is_whole)),
    }
}

/// What may end the meshes of an accuracy elsewhere in another run: time and memory that are left. Empty if nothing does.
pub fn may_end_elsewhere(accuracy: Option<&Accuracy>) -> String {
    let Some(accuracy) = accuracy else { return String::new() };
    let time = accuracy.most_seconds.map(|_| "time (accuracy.max_seconds)");
    let memory = accuracy.most_unknowns.is_none().then_some("memory (accuracy.max_unknowns is not given)");
    let all: Vec<&str> = time.into_iter().chain(memory).collect();
    if all.is_empty() { String::new() } else { format!(", unless {} ends it on another mesh", all.join(" or ")) }
}

/// What is said of a run that may repeat the result beside its case: the words, and whether they are a warning. `unless` follows
/// where it does repeat it.
pub fn repeats(now: &Provenance, before: &Provenance, file: &Path, unless: &str) -> (String, bool) {
    let differences = now.differences(before);
    if differences.is_empty() {
        return (format!("repeats the result beside the case file{unless}"), false);
    }
    let mut words = format!("not the same run as the result beside the case file: {}", differences.join("; "));
    let needs_options = now.petsc_options != before.petsc_options;
    if needs_options {
        words += &format!(
            "; `{}` repeats it",
            repeating(before, file, std::env::var_os("PETSC_OPTIONS").is_some_and(|all| !all.is_empty()))
        );
    }
    (words, needs_options)
}

/// The command that repeats a run; options of the environment, if there are some now, are no part of it.
fn repeating(before: &Provenance, file: &Path, has_environment: bool) -> String {
    let environment = if has_environment { "env -u PETSC_OPTIONS " } else { "" };
    let mpirun = if before.ranks > 1 { format!("mpirun -n {} ", before.ranks) } else { String::new() };
    let file = shlex::try_quote(&file.to_string_lossy()).map_or_else(|_| String::new(), |word| word.into_owned());
    let options = if before.petsc_options.is_empty() { String::new() } else { format!(" -- {}", before.petsc_options) };
    format!("{environment}{mpirun}mezha run {file}{options}")
}

/// `-name value` as a shell takes it: a value may have blanks.
fn in_shell(option: &str) -> String {
    let words: Vec<&str> = option.splitn(2, ' ').collect();
    shlex::try_join(words).unwrap_or_else(|_| option.to_owned())
}

/// SHA-256 of a resolved case whose mesh lies beside it.
fn case_hash(case: &Case) -> String {
    sha256(case.resolved_with_mesh(MESH).as_bytes())
}

/// Whether both paths lead to one file.
fn is_same_file(one: &Path, other: &Path) -> bool {
    matches!((one.canonicalize(), other.canonicalize()), (Ok(one), Ok(other)) if one == other)
}

/// Whether a file lies in a folder, or in one within.
fn is_within(file: &Path, folder: &Path) -> bool {
    matches!((file.canonicalize(), folder.canonicalize()), (Ok(file), Ok(folder)) if file.starts_with(&folder))
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
        let said = repeats(&before, &before, Path::new("x"), ", unless");
        assert_eq!(said, ("repeats the result beside the case file, unless".into(), false));
        let now = Provenance { petsc_options: String::new(), ..before.clone() };
        let (words, warns) = repeats(&now, &before, Path::new("out/a b/case.toml"), "");
        assert!(warns && words.ends_with("mpirun -n 2 mezha run 'out/a b/case.toml' -- -ksp_type gcr` repeats it"), "{words}");
        let fewer = Provenance { ranks: 1, ..before.clone() };
        let (words, warns) = repeats(&fewer, &before, Path::new("x"), "");
        assert!(!warns && words.ends_with("ranks: 1 instead of 2"), "{words}");
    }

    #[test]
    fn a_command_that_repeats_can_be_copied() {
        let options = ["-ksp_type gcr", "-log_view :a b.txt", "-ksp_monitor"].map(in_shell).join(" ");
        assert_eq!(options, "-ksp_type gcr -log_view ':a b.txt' -ksp_monitor");
        let before = Provenance { ranks: 1, petsc_options: options, ..Provenance::default() };
        let words = repeating(&before, Path::new("x"), false);
        assert_eq!(words, "mezha run x -- -ksp_type gcr -log_view ':a b.txt' -ksp_monitor");
        let bare = Provenance { ranks: 2, ..Provenance::default() };
        assert_eq!(repeating(&bare, Path::new("x"), true), "env -u PETSC_OPTIONS mpirun -n 2 mezha run x");
    }

    #[test]
    fn limits_of_time_and_memory_are_told() {
        let limited = |most_unknowns, most_seconds| Accuracy { goals: Vec::new(), most_unknowns, most_seconds };
        assert_eq!(may_end_elsewhere(None), "");
        assert_eq!(may_end_elsewhere(Some(&limited(Some(1000), None))), "");
        assert_eq!(
            may_end_elsewhere(Some(&limited(None, Some(1.0)))),
            ", unless time (accuracy.max_seconds) or memory (accuracy.max_unknowns is not given) ends it on another mesh"
        );
    }
}
