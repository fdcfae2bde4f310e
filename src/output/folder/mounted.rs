//! A target that is a mount point, as the volume of a container is: no folder can take its name, so the files of a result move into it.

use std::fs;
use std::path::Path;

use rustix::fs::{AtFlags, CWD, StatxAttributes, StatxFlags, statx};

use super::leftover::{carry_over, free_name, is_equal};
use super::own_files::{OwnFiles, entries, names_within, remove_if_there};
use crate::output::error::OutputError;
use crate::output::summary::SUMMARY;

/// What a file system has of itself in its first folder.
const FOUND: &str = "lost+found";

/// Whether another file system begins at a folder, or the same one once more.
pub fn is_mount_point(folder: &Path) -> bool {
    let found = statx(CWD, folder, AtFlags::empty(), StatxFlags::TYPE);
    found.is_ok_and(|found| found.stx_attributes.contains(StatxAttributes::MOUNT_ROOT))
}

/// Whether there is nothing in a mount point but what the file system has of itself.
///
/// # Errors
/// The operating system refuses.
pub fn is_bare(target: &Path) -> Result<bool, OutputError> {
    Ok(entries(target)?.iter().all(|entry| entry.file_name() == FOUND))
}

/// Moves the files of a result from a folder within the target to the target itself, in the place of those that the result before
/// has written, but for one that is kept. What else has the name of a file of the result gets another one. The summary, which makes it
/// a result, goes first and comes last.
///
/// # Errors
/// The operating system refuses.
pub fn move_in(temporary: &Path, target: &Path, kept: Option<&Path>) -> Result<(), OutputError> {
    let before = OwnFiles::of(target).unwrap_or_default().without(kept);
    remove_if_there(&target.join(SUMMARY))?;
    before.0.iter().try_for_each(|name| remove_if_there(&target.join(name)))?;
    for name in names_within(temporary)?.iter().map(Path::new).filter(|name| kept != Some(*name)) {
        let (own, other) = (temporary.join(name), target.join(name));
        if other.symlink_metadata().is_ok() && !is_equal(&own, &other) {
            fs::rename(&other, free_name(&other)).map_err(OutputError::io("rename", &other))?;
        }
    }
    let summary = OwnFiles([SUMMARY.into()].into());
    carry_over(temporary, target, Path::new(""), &summary)?;
    fs::rename(temporary.join(SUMMARY), target.join(SUMMARY)).map_err(OutputError::io("make", &target.join(SUMMARY)))?;
    fs::remove_dir_all(temporary).map_err(OutputError::io("remove", temporary))
}
