//! A result folder appears whole or not at all.

use std::fs;
use std::path::{Path, PathBuf};

use super::OutputError;

/// A result under construction: files go to a temporary folder beside the target, which takes its name at the end.
///
/// For a target `out/bars` the temporary is `out/.bars.partial`, on every rank; a replaced result rests as `out/.bars.old`
/// for the moment between two renames. Dropped without [`commit`](ResultFolder::commit), the temporary is removed.
/// In parallel rank 0 alone creates and commits; the other ranks write to [`temporary_path`](ResultFolder::temporary_path)
/// after rank 0 has created the folder and before it commits.
#[derive(Debug)]
pub struct ResultFolder {
    target: PathBuf,
    temporary: PathBuf,
    committed: bool,
}

impl ResultFolder {
    /// Makes the temporary folder for the target `out`, with all folders above it.
    ///
    /// The target may be missing or empty; if it holds a result (a `summary.json`) it is replaced with `force` only,
    /// and if it holds anything else, never. What a killed run left under the temporary names is cleared first.
    ///
    /// # Errors
    /// The target must not be replaced, has no name, or the operating system refuses.
    pub fn create(out: &Path, force: bool) -> Result<ResultFolder, OutputError> {
        let temporary = Self::temporary_path(out);
        if out.file_name().is_none() {
            return Err(OutputError::NoName(out.to_path_buf()));
        }
        recover_old(out)?;
        check_target(out, force)?;
        if temporary.exists() {
            fs::remove_dir_all(&temporary).map_err(OutputError::io("clear", &temporary))?;
        }
        fs::create_dir_all(&temporary).map_err(OutputError::io("create the folder", &temporary))?;
        Ok(ResultFolder { target: out.to_path_buf(), temporary, committed: false })
    }

    /// The temporary folder of the target `out`; the same on every rank.
    pub fn temporary_path(out: &Path) -> PathBuf {
        hidden_sibling(out, "partial")
    }

    /// Where the file `name` of this result is written to: a path in the temporary folder.
    pub fn path(&self, name: &str) -> PathBuf {
        self.temporary.join(name)
    }

    /// Gives the whole result its name. A result that was there is removed; files in it that no run writes are carried over.
    ///
    /// # Errors
    /// The operating system refuses.
    pub fn commit(mut self) -> Result<(), OutputError> {
        let old = hidden_sibling(&self.target, "old");
        if self.target.exists() {
            fs::rename(&self.target, &old).map_err(OutputError::io("set aside", &self.target))?;
        }
        if let Err(error) = fs::rename(&self.temporary, &self.target) {
            recover_old(&self.target)?;
            return Err(OutputError::io("make", &self.target)(error));
        }
        self.committed = true;
        if old.exists() { retire(&old, &self.target) } else { Ok(()) }
    }
}

impl Drop for ResultFolder {
    /// Removes an unfinished result; an error here has nobody left to tell.
    fn drop(&mut self) {
        if !self.committed {
            let _ = fs::remove_dir_all(&self.temporary);
        }
    }
}

/// `out/bars` and `partial` make `out/.bars.partial`.
fn hidden_sibling(out: &Path, suffix: &str) -> PathBuf {
    let name = out.file_name().unwrap_or_default().to_string_lossy();
    out.with_file_name(format!(".{name}.{suffix}"))
}

/// Refuses a target that must not be replaced.
fn check_target(out: &Path, force: bool) -> Result<(), OutputError> {
    if !out.exists() && !out.is_symlink() {
        return Ok(());
    }
    // A link is not followed: replacing the result would replace the link.
    if !out.is_dir() || out.is_symlink() {
        return Err(OutputError::NotAFolder(out.to_path_buf()));
    }
    let empty = fs::read_dir(out).map_err(OutputError::io("read the folder", out))?.next().is_none();
    let holds_result = out.join("summary.json").is_file();
    match (empty, holds_result, force) {
        (true, _, _) | (_, true, true) => Ok(()),
        (_, true, false) => Err(OutputError::HoldsResult(out.to_path_buf())),
        (_, false, _) => Err(OutputError::HoldsOtherFiles(out.to_path_buf())),
    }
}

/// After a run killed between the two renames of `commit`: brings the old result back, or finishes retiring it.
fn recover_old(out: &Path) -> Result<(), OutputError> {
    let old = hidden_sibling(out, "old");
    if !old.exists() {
        Ok(())
    } else if out.exists() {
        retire(&old, out)
    } else {
        fs::rename(&old, out).map_err(OutputError::io("restore", out))
    }
}

/// Carries files that no run writes from the old folder to the new one, then removes the old folder.
fn retire(old: &Path, new: &Path) -> Result<(), OutputError> {
    for entry in fs::read_dir(old).map_err(OutputError::io("read the folder", old))? {
        let name = entry.map_err(OutputError::io("read the folder", old))?.file_name();
        let (from, to) = (old.join(&name), new.join(&name));
        if !is_result_name(&name.to_string_lossy()) && !to.exists() {
            fs::rename(&from, &to).map_err(OutputError::io("carry over", &from))?;
        }
    }
    fs::remove_dir_all(old).map_err(OutputError::io("remove", old))
}

/// Whether a run writes a file of this name.
fn is_result_name(name: &str) -> bool {
    const WRITTEN: [(&str, &str); 8] = [
        ("summary", ".json"),
        ("case", ".toml"),
        ("contact_", ".csv"),
        ("contact_", ".vtu"),
        ("fields", "vtu"),
        ("pressure_", ".svg"),
        ("displacement_", ".svg"),
        ("deformed", ".svg"),
    ];
    WRITTEN.iter().any(|(start, end)| name.starts_with(start) && name.ends_with(end))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn write_result(out: &Path, force: bool, text: &str) -> Result<(), OutputError> {
        let folder = ResultFolder::create(out, force)?;
        fs::write(folder.path("summary.json"), text).unwrap();
        folder.commit()
    }

    fn names(folder: &Path) -> Vec<String> {
        let mut names: Vec<_> =
            fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    #[test]
    fn result_appears_only_when_committed() {
        let root = tempfile::tempdir().unwrap();
        let out = root.path().join("deep/er/bars");
        let folder = ResultFolder::create(&out, false).unwrap();
        fs::write(folder.path("summary.json"), "{}").unwrap();
        assert!(!out.exists());
        assert_eq!(folder.path("a"), ResultFolder::temporary_path(&out).join("a"));
        folder.commit().unwrap();
        assert_eq!(names(&out), ["summary.json"]);
        assert_eq!(names(out.parent().unwrap()), ["bars"]);
    }

    #[test]
    fn unfinished_result_leaves_nothing() {
        let root = tempfile::tempdir().unwrap();
        let folder = ResultFolder::create(&root.path().join("bars"), false).unwrap();
        fs::write(folder.path("summary.json"), "{}").unwrap();
        drop(folder);
        assert!(names(root.path()).is_empty());
    }

    #[test]
    fn result_is_replaced_by_force_alone() {
        let root = tempfile::tempdir().unwrap();
        let out = root.path().join("bars");
        write_result(&out, false, "first").unwrap();
        fs::write(out.join("fields_7.vtu"), "of the first").unwrap();
        let refusal = write_result(&out, false, "second").unwrap_err();
        assert!(matches!(refusal, OutputError::HoldsResult(_)) && refusal.to_string().contains("--force"));
        assert_eq!(fs::read_to_string(out.join("summary.json")).unwrap(), "first");
        write_result(&out, true, "second").unwrap();
        assert_eq!(fs::read_to_string(out.join("summary.json")).unwrap(), "second");
        assert_eq!(names(&out), ["summary.json"]);
        assert_eq!(names(root.path()), ["bars"]);
    }

    #[test]
    fn abandoned_replacement_keeps_the_old_result() {
        let root = tempfile::tempdir().unwrap();
        let out = root.path().join("bars");
        write_result(&out, false, "first").unwrap();
        drop(ResultFolder::create(&out, true).unwrap());
        assert_eq!(fs::read_to_string(out.join("summary.json")).unwrap(), "first");
    }

    #[test]
    fn foreign_files_survive() {
        let root = tempfile::tempdir().unwrap();
        let out = root.path().join("bars");
        fs::create_dir(&out).unwrap();
        write_result(&out, false, "an empty folder may be taken").unwrap();
        fs::write(out.join("notes.md"), "mine").unwrap();
        fs::create_dir(out.join("paper")).unwrap();
        write_result(&out, true, "second").unwrap();
        assert_eq!(names(&out), ["notes.md", "paper", "summary.json"]);
        fs::remove_file(out.join("summary.json")).unwrap();
        for force in [false, true] {
            assert!(matches!(write_result(&out, force, "third"), Err(OutputError::HoldsOtherFiles(_))));
        }
        assert_eq!(fs::read_to_string(out.join("notes.md")).unwrap(), "mine");
    }

    #[test]
    fn files_and_nameless_targets_are_refused() {
        let root = tempfile::tempdir().unwrap();
        let file = root.path().join("file");
        fs::write(&file, "mine").unwrap();
        assert!(matches!(ResultFolder::create(&file, true), Err(OutputError::NotAFolder(_))));
        assert!(matches!(ResultFolder::create(Path::new("."), true), Err(OutputError::NoName(_))));
        assert_eq!(fs::read_to_string(&file).unwrap(), "mine");
    }

    #[test]
    fn leftovers_of_a_killed_run_are_cleared() {
        let root = tempfile::tempdir().unwrap();
        let out = root.path().join("bars");
        drop(write_result(&out, false, "first"));
        fs::rename(&out, hidden_sibling(&out, "old")).unwrap();
        let temporary = ResultFolder::temporary_path(&out);
        fs::create_dir(&temporary).unwrap();
        fs::write(temporary.join("fields_3.vtu"), "stale").unwrap();
        assert!(matches!(ResultFolder::create(&out, false), Err(OutputError::HoldsResult(_))));
        write_result(&out, true, "second").unwrap();
        assert_eq!(names(&out), ["summary.json"]);
        assert_eq!(names(root.path()), ["bars"]);
    }
}
