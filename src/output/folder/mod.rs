//! A result folder appears whole or not at all.

mod leftover;
mod mounted;
mod own_files;

pub use leftover::recover;
pub use own_files::{entries, remove_if_there};

use std::fs::{self, File};
use std::io::{self, ErrorKind};
use std::os::unix::fs::MetadataExt;
use std::path::{Path, PathBuf};
use std::thread::sleep;
use std::time::Duration;

use rustix::fs::{CWD, RenameFlags, renameat_with};

use crate::output::error::OutputError;
use crate::output::summary::{SUMMARY, Summary};
use leftover::{make_hidden, remove_empty, retire};
use mounted::{is_bare, is_mount_point, move_in};
use own_files::{OwnFiles, names_within};

/// What a result is called within a mount point while it is written.
const WITHIN: &str = "result";

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
    /// The result that is to be replaced, in a mount point its summary; while it is open, no other one can be taken for it.
    replaced: Option<File>,
    /// Locked while this lives, so that nobody clears the temporary away.
    _lock: Option<File>,
    /// A file of the replaced result that stays.
    kept: Option<PathBuf>,
    /// Whether the target is a mount point: the temporary folder is within it then.
    is_mounted: bool,
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
        let is_mounted = is_mount_point(out);
        let place = &if is_mounted { out.join(WITHIN) } else { out.clone() };
        recover(place);
        let replaced = match holds_result(out, force)? {
            true => {
                let seen = if is_mounted { out.join(SUMMARY) } else { out.clone() };
                Some(File::open(&seen).map_err(OutputError::io("open", &seen))?)
            }
            false => None,
        };
        let (temporary, made_above) = make_hidden(place).map_err(OutputError::io("create a folder beside", place))?;
        let lock = File::open(&temporary).ok().filter(|folder| folder.try_lock().is_ok());
        let target = out.to_path_buf();
        Ok(ResultFolder { target, temporary, made_above, replaced, _lock: lock, kept: None, is_mounted, committed: false })
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

    /// The same result under construction in another place, with all files that there are so far.
    ///
    /// # Errors
    /// As [`ResultFolder::create`]; the operating system refuses.
    pub fn begin_elsewhere(&self, out: &Path) -> Result<Self, OutputError> {
        let other = Self::create(out, false)?;
        for name in names_within(&self.temporary).unwrap_or_default() {
            let to = other.path(&name);
            let made = to.parent().map_or(Ok(()), fs::create_dir_all);
            made.and_then(|()| fs::copy(self.path(&name), &to)).map_err(OutputError::io("write", &to))?;
        }
        Ok(other)
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
        entries(&self.temporary)?.iter().try_for_each(|entry| remove_if_there(&entry.path()))
    }

    /// Gives the whole result its name. A result that was there is removed; files in it that it has not written are carried over.
    ///
    /// # Errors
    /// [`OutputError::Elsewhere`] if it is in another place, since the operating system refuses this one, or it is no longer what it
    /// was at the start; [`OutputError::Remains`] if the new result is in its place, and not all of the old one could be removed.
    pub fn commit(mut self) -> Result<(), OutputError> {
        let placed = match &self.replaced {
            _ if self.is_mounted => self.move_in(),
            Some(seen) if is_there(&self.target) => self.replace(seen),
            _ => self.appear(),
        };
        let left = match placed {
            Err(refusal @ (OutputError::Io { .. } | OutputError::Overtaken(_))) => return self.elsewhere(refusal),
            placed => placed?,
        };
        self.committed = true;
        left.map_or(Ok(()), |old| {
            let retired = self.retire(&old);
            retired.map_err(|error| OutputError::Remains { target: self.target.clone(), old, source: Box::new(error) })
        })
    }

    /// Gives the result, whose target is refused or taken, the name of its temporary folder without what hides it: nothing that is
    /// solved is lost.
    fn elsewhere(mut self, refusal: OutputError) -> Result<(), OutputError> {
        let hidden = self.temporary.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let place = self.temporary.with_file_name(hidden.trim_start_matches('.').trim_end_matches(".partial"));
        if !is_there(&self.temporary) || fs::rename(&self.temporary, &place).is_err() {
            return Err(refusal);
        }
        self.committed = true;
        Err(OutputError::Elsewhere { place, source: Box::new(refusal) })
    }

    /// Removes the result that was replaced.
    fn retire(&self, old: &Path) -> Result<(), OutputError> {
        retire(old, &self.target, &OwnFiles::of(old).unwrap_or_default().without(self.kept.as_deref()))
    }

    /// Moves into a mount point, if the result there, which its summary makes one, is still that of the start.
    fn move_in(&self) -> Result<Option<PathBuf>, OutputError> {
        let summary = self.target.join(SUMMARY);
        let is_seen = self.replaced.as_ref().is_some_and(|seen| is_same(&summary, seen));
        if is_there(&summary) && !is_seen {
            return Err(self.overtaken());
        }
        move_in(&self.temporary, &self.target, self.kept.as_deref()).map(|()| None)
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
    let is_empty = if is_mount_point(out) { is_bare(out)? } else { entries(out)?.is_empty() };
    match (is_empty, OwnFiles::of(out).is_some(), force) {
        (true, _, _) => Ok(false),
        (_, true, true) => Ok(true),
        (_, true, false) => Err(OutputError::HoldsResult(out.to_path_buf())),
        (_, false, _) => Err(OutputError::HoldsOtherFiles(out.to_path_buf())),
    }
}

#[cfg(test)]
mod tests;
