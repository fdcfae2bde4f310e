//! What can go wrong on the way to the disk, and why there is no result.

use std::fs;
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

/// A result that could not be written.
#[derive(Debug, thiserror::Error)]
pub enum OutputError {
    /// The folder holds a result, which is kept.
    #[error("`{}` already holds a result; replace it with --force, or choose another folder with --out", .0.display())]
    HoldsResult(PathBuf),
    /// The folder holds files, but no result: they are somebody else's, even with `--force`.
    #[error("`{}` holds files but no summary.json of mezha, so it is not a result that may be replaced; choose another folder with --out", .0.display())]
    HoldsOtherFiles(PathBuf),
    /// The target exists and is not a folder.
    #[error("`{}` is no folder, or a link to one, which is not followed; choose another one with --out", .0.display())]
    NotAFolder(PathBuf),
    /// The target has no name of its own, such as `.` or `/`.
    #[error("`{}` does not name a folder that can be made; name one with --out, such as out/result", .0.display())]
    NoName(PathBuf),
    /// Another run was faster.
    #[error(
        "another run, or somebody else, has put files into `{}` since this run began, and they stay there; choose another folder with --out, or let one run end before the next begins",
        .0.display()
    )]
    Overtaken(PathBuf),
    /// The new result is whole and in its place, and not all of the one before could be removed.
    #[error(
        "the new result is in place in `{}`, but what was there before cannot be cleared away: {source}; what is left of it is in `{}`: take from there what is yours, and remove it",
        target.display(),
        old.display()
    )]
    Remains {
        /// The folder of the new result.
        target: PathBuf,
        /// Where the rest of the old one is.
        old: PathBuf,
        /// What could not be done.
        source: Box<OutputError>,
    },
    /// The result is whole, and in another place than it was meant for.
    #[error("{source}; what is solved is not lost: the result is in `{}`", place.display())]
    Elsewhere {
        /// The folder of the result.
        place: PathBuf,
        /// Why it is not where it was meant to be.
        source: Box<OutputError>,
    },
    /// The operating system refused.
    #[error("cannot {action} `{}`: {source}{}", path.display(), room(source))]
    Io {
        /// What was tried, in the infinitive.
        action: &'static str,
        /// The file or folder.
        path: PathBuf,
        /// The reason of the operating system.
        source: io::Error,
    },
    /// A figure that cannot be drawn.
    #[error("cannot draw `{}`: {reason}", path.display())]
    Figure {
        /// The file.
        path: PathBuf,
        /// Why.
        reason: String,
    },
}

/// What helps where there is no room.
fn room(refusal: &io::Error) -> &'static str {
    match refusal.kind() {
        ErrorKind::FileTooLarge | ErrorKind::StorageFull | ErrorKind::QuotaExceeded => {
            "; make room there (ulimit -f, quota, disk), or choose another folder with --out"
        }
        _ => "",
    }
}

impl OutputError {
    /// The same for a file of a result that could not be written: what there is of it goes, and its room is free.
    pub(crate) fn unwritten(path: &Path) -> impl FnOnce(io::Error) -> OutputError {
        let (path, told) = (path.to_path_buf(), Self::io("write", path));
        move |source| {
            let _ = fs::remove_file(path);
            told(source)
        }
    }

    /// Turns an error of the operating system into ours; for `map_err`.
    pub(crate) fn io(action: &'static str, path: &Path) -> impl FnOnce(io::Error) -> OutputError {
        let path = path.to_path_buf();
        move |source| OutputError::Io { action, path, source }
    }
}

/// Why there is no result, of a run or of a study.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{0}")]
pub enum RunError {
    /// The input cannot be used, on every rank alike: 2.
    Input(String),
    /// The same, in words that begin with a key; the caller puts the case file before them.
    Key(String),
    /// Somebody has changed the input, or the result is in another place than it was meant for; on every rank alike: 1.
    Overtaken(String),
    /// PETSc, MPI or the disk failed, perhaps on this rank alone: 1.
    Failed(String),
}

impl RunError {
    /// The exit code.
    pub fn code(&self) -> i32 {
        match self {
            Self::Input(_) | Self::Key(_) => 2,
            Self::Overtaken(_) | Self::Failed(_) => 1,
        }
    }
}

impl From<OutputError> for RunError {
    fn from(error: OutputError) -> Self {
        match error {
            OutputError::Io { .. } | OutputError::Figure { .. } => Self::Failed(error.to_string()),
            refused => Self::Input(refused.to_string()),
        }
    }
}
