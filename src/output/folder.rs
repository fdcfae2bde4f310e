//! A result folder appears whole or not at all.

use std::fs::{self, File};
use std::io::{self, ErrorKind};
use std::os::unix::fs::MetadataExt;
use std::path::{Path, PathBuf};
use std::thread::sleep;
use std::time::Duration;

use rustix::fs::{CWD, RenameFlags, renameat_with};

use super::leftover::{make_hidden, recover, remove_empty, retire};
use super::own_files::{OwnFiles, SUMMARY, names_within};
use super::{OutputError, Summary};

/// How often, and after which time, it is tried to remove a folder that other ranks still write to.
const MOST_TRIES: usize = 5;
const PAUSE: Duration = Duration::from_millis(10);

/// A result under construction: files go to a temporary folder beside the target, which takes its name at the end.
///
/// For a target `out/bars` the temporary is `out/.bars.HOST-PROCESS-NUMBER.partial`, which no other run has.
/// Dropped without [`commit`](ResultFolder::commit), it is removed. In parallel rank 0 alone creates and commits; the other
/// ranks write to its [`temporary`](ResultFolder::temporary) in between.
#[derive(Debug)]
pub struct ResultFolder {
    target: PathBuf,
    temporary: PathBuf,
    /// Folders above that were made for it, from the inside out.
    made_above: Vec<PathBuf>,
    /// The result that is to be replaced; while it is open, no other folder can be taken for it.
    replaced: Option<File>,
    /// Locked while this lives, so that nobody clears the temporary away.
    _lock: Option<File>,
    /// A file of the replaced result that stays.
    kept: Option<PathBuf>,
    committed: bool,
}

impl ResultFolder {
    /// Makes the temporary folder for the target `out`, with all folders above it.
    ///
    /// The target may be missing or empty; if it holds a result (a `summary.json` of mezha) it is replaced with `force` only,
    /// and if it holds anything else, never. What killed runs of this host have left beside it is cleared first.
    ///
    /// # Errors
    /// The target must not be replaced, has no name, or the operating system refuses.
    pub fn create(out: &Path, force: bool) -> Result<ResultFolder, OutputError> {
        if out.file_name().is_none() {
            return Err(OutputError::NoName(out.to_path_buf()));
        }
        // Without dots and slashes at its end, which a folder cannot be renamed to.
        let out = &out.components().collect::<PathBuf>();
        recover(out);
        let replaced = match holds_result(out, force)? {
            true => Some(File::open(out).map_err(OutputError::io("open", out))?),
            false => None,
        };
        let (temporary, made_above) = make_hidden(out).map_err(OutputError::io("create a folder beside", out))?;
        let lock = File::open(&temporary).ok().filter(|folder| folder.try_lock().is_ok());
        Ok(ResultFolder { target: out.to_path_buf(), temporary, made_above, replaced, _lock: lock, kept: None, committed: false })
    }

    /// The temporary folder, by its path from the root.
    pub fn temporary(&self) -> &Path {
        &self.temporary
    }

    /// Where the file `name` of this result is written to: a path in the temporary folder.
    pub fn path(&self, name: &str) -> PathBuf {
        self.temporary.join(name)
    }

    /// Writes the summary, with a list of all files of this result: it is the last of them.
    ///
    /// # Errors
    /// The operating system refuses.
    pub fn write_summary(&self, summary: &Summary) -> Result<(), OutputError> {
        let mut files = names_within(&self.temporary)?;
        files.push(SUMMARY.into());
        files.sort();
        files.dedup();
        Summary { files, ..summary.clone() }.write(&self.path(SUMMARY))
    }

    /// If this file is one of the result that is to be replaced, it stays.
    pub fn keep(&mut self, file: &Path) {
        let inside = |folder: PathBuf| file.canonicalize().ok()?.strip_prefix(folder).ok().map(Path::to_path_buf);
        self.kept = self.target.canonicalize().ok().and_then(inside);
    }

    /// Removes what was written so far.
    ///
    /// # Errors
    /// The operating system refuses.
    pub fn empty(&self) -> Result<(), OutputError> {
        for entry in fs::read_dir(&self.temporary).map_err(OutputError::io("read the folder", &self.temporary))? {
            let path = entry.map_err(OutputError::io("read the folder", &self.temporary))?.path();
            let removed = if path.is_dir() { fs::remove_dir_all(&path) } else { fs::remove_file(&path) };
            removed.map_err(OutputError::io("remove", &path))?;
        }
        Ok(())
    }

    /// Gives the whole result its name. A result that was there is removed; files in it that it has not written are carried over.
    ///
    /// # Errors
    /// [`OutputError::Overtaken`] if the target is no longer what it was at the start; [`OutputError::Remains`] if the new result
    /// is in its place, and not all of the old one could be removed; else the operating system refuses.
    pub fn commit(mut self) -> Result<(), OutputError> {
        let left = match &self.replaced {
            Some(seen) if is_there(&self.target) => self.replace(seen)?,
            _ => self.appear()?,
        };
        self.committed = true;
        left.map_or(Ok(()), |old| {
            let retired = self.retire(&old);
            retired.map_err(|error| OutputError::Remains { target: self.target.clone(), old, source: Box::new(error) })
        })
    }

    /// Removes the result that was replaced.
    fn retire(&self, old: &Path) -> Result<(), OutputError> {
        let own = OwnFiles::of(old).unwrap_or_default();
        let own = self.kept.iter().fold(own, |own, kept| own.without(kept));
        retire(old, &self.target, &own)
    }

    /// Takes the name of a target that is missing or empty: a folder never replaces one that holds anything.
    fn appear(&self) -> Result<Option<PathBuf>, OutputError> {
        match fs::rename(&self.temporary, &self.target) {
            Ok(()) => Ok(None),
            Err(error) if is_taken(&error) => Err(self.overtaken()),
            Err(error) => Err(OutputError::io("make", &self.target)(error)),
        }
    }

    /// Takes the name of the result that was `seen` at the start, in one step; where that rests until it is removed.
    fn replace(&self, seen: &File) -> Result<Option<PathBuf>, OutputError> {
        let exchange = || renameat_with(CWD, &self.temporary, CWD, &self.target, RenameFlags::EXCHANGE);
        if !is_same(&self.target, seen) {
            return Err(self.overtaken());
        }
        if exchange().is_err() {
            return self.replace_in_two_steps(seen);
        }
        if is_same(&self.temporary, seen) {
            return Ok(Some(self.temporary.clone()));
        }
        // Another run came between the look and the step: its result goes back to its place.
        exchange().map_err(|error| OutputError::io("give back", &self.target)(error.into()))?;
        Err(self.overtaken())
    }

    /// The same where the file system cannot exchange folders: there is no target for a moment.
    fn replace_in_two_steps(&self, seen: &File) -> Result<Option<PathBuf>, OutputError> {
        let old = self.temporary.with_extension("old");
        fs::rename(&self.target, &old).map_err(OutputError::io("set aside", &self.target))?;
        if is_same(&old, seen) {
            match self.appear() {
                Ok(_) => return Ok(Some(old)),
                // The one that has come instead is the newer one.
                Err(error @ OutputError::Overtaken(_)) => return self.retire(&old).and(Err(error)),
                Err(error) => return fs::rename(&old, &self.target).map_err(OutputError::io("restore", &old)).and(Err(error)),
            }
        }
        fs::rename(&old, &self.target).map_err(OutputError::io("give back", &old))?;
        Err(self.overtaken())
    }

    fn overtaken(&self) -> OutputError {
        OutputError::Overtaken(self.target.clone())
    }
}

impl Drop for ResultFolder {
    /// Removes an unfinished result; an error here has nobody left to tell. Other ranks may still write to it for a moment.
    fn drop(&mut self) {
        let is_left = || !self.committed && is_there(&self.temporary);
        for _ in 0..MOST_TRIES {
            if is_left() && fs::remove_dir_all(&self.temporary).is_err() {
                sleep(PAUSE);
            }
        }
        if !self.committed {
            remove_empty(&self.made_above);
        }
    }
}

/// Whether anything has this name.
fn is_there(path: &Path) -> bool {
    path.symlink_metadata().is_ok()
}

/// Whether a path leads to this open folder.
fn is_same(path: &Path, open: &File) -> bool {
    match (path.symlink_metadata(), open.metadata()) {
        (Ok(one), Ok(other)) => (one.dev(), one.ino()) == (other.dev(), other.ino()),
        _ => false,
    }
}

/// Whether a folder could not get a name because something else has it.
fn is_taken(error: &io::Error) -> bool {
    matches!(error.kind(), ErrorKind::DirectoryNotEmpty | ErrorKind::AlreadyExists | ErrorKind::NotADirectory)
}

/// Whether the target holds a result that is to be replaced; refuses one that must not be.
fn holds_result(out: &Path, force: bool) -> Result<bool, OutputError> {
    if !out.exists() && !out.is_symlink() {
        return Ok(false);
    }
    // A link is not followed: replacing the result would replace the link.
    if !out.is_dir() || out.is_symlink() {
        return Err(OutputError::NotAFolder(out.to_path_buf()));
    }
    let empty = fs::read_dir(out).map_err(OutputError::io("read the folder", out))?.next().is_none();
    let holds_result = OwnFiles::of(out).is_some();
    match (empty, holds_result, force) {
        (true, _, _) => Ok(false),
        (_, true, true) => Ok(true),
        (_, true, false) => Err(OutputError::HoldsResult(out.to_path_buf())),
        (_, false, _) => Err(OutputError::HoldsOtherFiles(out.to_path_buf())),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn write_result(out: &Path, force: bool, case: &str) -> Result<(), OutputError> {
        let folder = ResultFolder::create(out, force)?;
        write_case(&folder, case);
        folder.commit()
    }

    /// A summary that tells the name of a case.
    fn write_case(folder: &ResultFolder, case: &str) {
        folder.write_summary(&Summary::new(case, 1)).unwrap();
    }

    /// The case of the result in a folder.
    fn case_in(folder: &Path) -> String {
        Summary::read(&folder.join("summary.json")).unwrap().case
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
        assert_eq!(folder.path("a"), folder.temporary().join("a"));
        assert!(folder.temporary().is_absolute() && folder.temporary().parent() == out.parent());
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
        drop(ResultFolder::create(&root.path().join("deep/er/bars"), false).unwrap());
        assert!(names(root.path()).is_empty());
        let [one, other] = ["deep/one", "deep/other"].map(|out| ResultFolder::create(&root.path().join(out), false).unwrap());
        drop(one);
        assert!(other.temporary().is_dir(), "what somebody else has come into stays");
    }

    #[test]
    fn result_is_replaced_by_force_alone() {
        let root = tempfile::tempdir().unwrap();
        let out = root.path().join("bars");
        let first = ResultFolder::create(&out, false).unwrap();
        fs::write(first.path("fields_7.vtu"), "of the first").unwrap();
        write_case(&first, "first");
        first.commit().unwrap();
        let refusal = write_result(&out, false, "second").unwrap_err();
        assert!(matches!(refusal, OutputError::HoldsResult(_)) && refusal.to_string().contains("--force"));
        assert_eq!(case_in(&out), "first");
        write_result(&out, true, "second").unwrap();
        assert_eq!(case_in(&out), "second");
        assert_eq!(names(&out), ["summary.json"]);
        assert_eq!(names(root.path()), ["bars"]);
    }

    #[test]
    fn abandoned_replacement_keeps_the_old_result() {
        let root = tempfile::tempdir().unwrap();
        let out = root.path().join("bars");
        write_result(&out, false, "first").unwrap();
        drop(ResultFolder::create(&out, true).unwrap());
        assert_eq!(case_in(&out), "first");
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
    fn a_summary_of_another_program_is_no_result() {
        let root = tempfile::tempdir().unwrap();
        fs::write(root.path().join("summary.json"), "[1, 2, 3]").unwrap();
        let refusal = write_result(root.path(), true, "mine").unwrap_err();
        assert!(matches!(refusal, OutputError::HoldsOtherFiles(_)), "{refusal}");
    }

    /// A run that was interrupted before it has read its mesh has no copy of it.
    #[test]
    fn a_file_that_is_needed_stays() {
        let root = tempfile::tempdir().unwrap();
        let out = root.path().join("bars");
        let write = |kept: &[&str], mesh: bool| {
            let mut folder = ResultFolder::create(&out, true).unwrap();
            kept.iter().for_each(|name| folder.keep(&out.join(name)));
            if mesh {
                fs::write(folder.path("case.msh"), "mesh").unwrap();
            }
            write_case(&folder, "next");
            folder.commit().unwrap();
        };
        write(&[], true);
        write(&["case.msh"], false);
        assert_eq!(names(&out), ["case.msh", "summary.json"]);
    }

    #[test]
    fn a_target_may_end_with_a_dot() {
        let root = tempfile::tempdir().unwrap();
        for out in ["fresh/.", "fresh/./", "deep/./fresh/"] {
            write_result(&root.path().join(out), true, out).unwrap();
            assert_eq!(case_in(&root.path().join(out)), out);
        }
        assert_eq!(
            (names(root.path()), names(&root.path().join("deep"))),
            (vec!["deep".into(), "fresh".into()], vec!["fresh".into()])
        );
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

    /// Two results that were begun at the same time: the first that ends stays, whether it replaces one or not.
    #[test]
    fn the_second_is_told() {
        for force in [false, true] {
            let root = tempfile::tempdir().unwrap();
            let out = root.path().join("bars");
            if force {
                write_result(&out, false, "before").unwrap();
            }
            let [first, second] = ["first", "second"].map(|text| {
                let folder = ResultFolder::create(&out, force).unwrap();
                write_case(&folder, text);
                folder
            });
            assert_ne!(first.temporary(), second.temporary());
            first.commit().unwrap();
            let refusal = second.commit().unwrap_err();
            assert!(matches!(refusal, OutputError::Overtaken(_)), "{refusal}");
            assert_eq!(case_in(&out), "first");
            assert_eq!(names(root.path()), ["bars"]);
        }
    }

    #[test]
    fn a_result_that_was_taken_away_is_not_missed() {
        let root = tempfile::tempdir().unwrap();
        let out = root.path().join("bars");
        write_result(&out, false, "first").unwrap();
        let folder = ResultFolder::create(&out, true).unwrap();
        write_case(&folder, "second");
        fs::remove_dir_all(&out).unwrap();
        folder.commit().unwrap();
        assert_eq!((names(&out), names(root.path())), (vec!["summary.json".into()], vec!["bars".into()]));
    }

    /// As on file systems that cannot exchange two folders.
    #[test]
    fn two_steps_do_the_same() {
        let root = tempfile::tempdir().unwrap();
        let out = root.path().join("bars");
        write_result(&out, false, "first").unwrap();
        let [a, b] = [0, 1].map(|_| ResultFolder::create(&out, true).unwrap());
        write_case(&a, "second");
        let old = a.replace_in_two_steps(a.replaced.as_ref().unwrap()).unwrap().unwrap();
        assert_eq!(case_in(&old), "first");
        a.retire(&old).unwrap();
        let refusal = b.replace_in_two_steps(b.replaced.as_ref().unwrap()).unwrap_err();
        assert!(matches!(refusal, OutputError::Overtaken(_)), "{refusal}");
        drop((a, b));
        assert_eq!(case_in(&out), "second");
        assert_eq!(names(root.path()), ["bars"]);
    }

    /// Many at once, and one at a time: what stands under the name is always whole, and of one run.
    #[test]
    fn a_race_has_whole_results_only() {
        let root = tempfile::tempdir().unwrap();
        let out = root.path().join("bars");
        write_result(&out, false, "before").unwrap();
        let write = |runner: usize| {
            let mut won = 0;
            for round in 0..50 {
                let Ok(folder) = ResultFolder::create(&out, true) else { continue };
                let text = format!("{runner} {round}");
                fs::write(folder.path("contact_a.csv"), &text).unwrap();
                write_case(&folder, &text);
                match folder.commit() {
                    Ok(()) => won += 1,
                    Err(OutputError::Overtaken(_)) => {}
                    Err(error) => panic!("{error}"),
                }
            }
            won
        };
        let won: usize = std::thread::scope(|scope| {
            let runners: Vec<_> = (0..4).map(|runner| scope.spawn(move || write(runner))).collect();
            runners.into_iter().map(|runner| runner.join().unwrap()).sum()
        });
        assert!(won > 0 && case_in(&out) == fs::read_to_string(out.join("contact_a.csv")).unwrap());
        assert_eq!((names(&out).len(), names(root.path())), (2, vec!["bars".into()]));
    }
}
