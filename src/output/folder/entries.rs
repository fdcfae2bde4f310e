//! What a folder holds, and how it goes.

use std::fs::{self, DirEntry};
use std::path::Path;

use crate::output::error::OutputError;

/// Everything in a folder.
///
/// # Errors
/// The operating system refuses.
pub fn entries(folder: &Path) -> Result<Vec<DirEntry>, OutputError> {
    fs::read_dir(folder).and_then(Iterator::collect).map_err(OutputError::io("read the folder", folder))
}

/// Removes a file, or a folder with all in it, if it is there.
///
/// # Errors
/// The operating system refuses.
pub fn remove_if_there(path: &Path) -> Result<(), OutputError> {
    let removed = match (path.exists(), path.is_dir()) {
        (false, _) => Ok(()),
        (true, true) => fs::remove_dir_all(path),
        (true, false) => fs::remove_file(path),
    };
    removed.map_err(OutputError::io("remove", path))
}
