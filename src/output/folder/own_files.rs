//! What a folder holds, how it goes, and which of its files its result has written: all others are the user's.

use serde_json::Value;
use std::collections::BTreeSet;
use std::fs::{self, DirEntry};
use std::path::{Path, PathBuf};

use crate::output::error::OutputError;
use crate::output::summary::{SUMMARY, read_summary};

/// Names of the files of a result, relative to its folder.
#[derive(Debug, Default)]
pub struct OwnFiles(pub BTreeSet<PathBuf>);

impl OwnFiles {
    /// The files that the summary in a folder lists; None if there is no summary of mezha.
    pub fn of(folder: &Path) -> Option<Self> {
        let summary = read_summary(folder);
        let is_result = summary["mezha"].is_string() && summary["status"].is_string();
        let listed = summary["files"].as_array().into_iter().flatten().filter_map(Value::as_str);
        is_result.then(|| Self(listed.chain([SUMMARY]).map(PathBuf::from).collect()))
    }

    /// Whether the result has written the file of this name.
    pub fn has(&self, name: &Path) -> bool {
        self.0.contains(name)
    }

    /// Whether the result has written a file in the folder of this name.
    pub fn has_within(&self, folder: &Path) -> bool {
        self.0.iter().any(|name| name.starts_with(folder))
    }

    /// The same without the file that is kept, if one is.
    pub fn without(mut self, kept: Option<&Path>) -> Self {
        self.0.retain(|name| kept != Some(name.as_path()));
        self
    }
}

/// Names of all files in a folder and in those within, relative to it, sorted.
///
/// # Errors
/// The operating system refuses.
pub fn names_within(folder: &Path) -> Result<Vec<String>, OutputError> {
    let mut names = Vec::new();
    let mut folders = vec![PathBuf::new()];
    while let Some(inner) = folders.pop() {
        for entry in entries(&folder.join(&inner))? {
            let name = inner.join(entry.file_name());
            if entry.path().is_dir() { folders.push(name) } else { names.push(name.to_string_lossy().into_owned()) }
        }
    }
    names.sort();
    Ok(names)
}

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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_summary_of_mezha_makes_a_result() {
        let folder = tempfile::tempdir().unwrap();
        for text in ["[1,2,3]", "{}", "", r#"{"mezha": "0.1"}"#, r#"{"mezha": 1, "status": "converged"}"#] {
            fs::write(folder.path().join(SUMMARY), text).unwrap();
            assert!(OwnFiles::of(folder.path()).is_none(), "{text}");
        }
        fs::write(folder.path().join(SUMMARY), r#"{"mezha": "0.1", "status": "converged", "files": ["steps/0001/a.csv"]}"#)
            .unwrap();
        let own = OwnFiles::of(folder.path()).unwrap();
        assert!(["summary.json", "steps/0001/a.csv"].iter().all(|name| own.has(Path::new(name))));
        assert!(own.has_within(Path::new("steps")) && !own.has_within(Path::new("step")) && !own.has(Path::new("case.toml")));
    }
}
