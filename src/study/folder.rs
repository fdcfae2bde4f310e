//! The folder of a study: the table in three forms, and the result of each run under `runs`.

use std::fs;
use std::path::{Path, PathBuf};

use super::StudyError;
use super::format;
use super::table::Table;
use crate::output::OutputError;

const TABLES: [&str; 3] = ["study.csv", "study.json", "study.md"];
const RUNS: &str = "runs";

/// The folder of the results of all runs.
pub fn runs(out: &Path) -> PathBuf {
    out.join(RUNS)
}

/// Makes the folder of a study. What an older study has left there goes, if `force` says so; other files stay.
///
/// # Errors
/// The folder holds a study, is no folder, or the operating system refuses.
pub fn claim(out: &Path, force: bool) -> Result<(), StudyError> {
    if out.exists() && !out.is_dir() {
        return Err(OutputError::NotAFolder(out.into()).into());
    }
    let runs = runs(out);
    let held = TABLES.map(|name| out.join(name)).into_iter().chain([runs.clone()]).any(|path| path.exists());
    if held && !force {
        let words = "already holds a study, or the runs of one; replace it with --force, or choose another folder with --out";
        return Err(StudyError::Input(format!("`{}` {words}", out.display())));
    }
    for path in TABLES.map(|name| out.join(name)).iter().filter(|path| path.exists()) {
        fs::remove_file(path).map_err(OutputError::io("remove", path))?;
    }
    fs::create_dir_all(&runs).map_err(OutputError::io("create the folder", &runs))?;
    for entry in fs::read_dir(&runs).map_err(OutputError::io("read the folder", &runs))? {
        let path = entry.map_err(OutputError::io("read the folder", &runs))?.path();
        let number = path.file_stem().unwrap_or_default().to_string_lossy();
        if number.chars().all(|c| c.is_ascii_digit()) {
            let removed = if path.is_dir() { fs::remove_dir_all(&path) } else { fs::remove_file(&path) };
            removed.map_err(OutputError::io("remove", &path))?;
        }
    }
    Ok(())
}

/// Writes the table as CSV, JSON and Markdown; each file appears whole or not at all.
///
/// # Errors
/// The operating system refuses.
pub fn write_tables(out: &Path, table: &Table) -> Result<(), OutputError> {
    for (name, text) in TABLES.into_iter().zip([format::csv(table), format::json(table), format::markdown(table)]) {
        let (path, temporary) = (out.join(name), out.join(format!(".{name}.partial")));
        fs::write(&temporary, text).map_err(OutputError::io("write", &temporary))?;
        fs::rename(&temporary, &path).map_err(OutputError::io("make", &path))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_older_study_goes_only_if_it_is_said_and_other_files_stay() {
        let folder = tempfile::tempdir().unwrap();
        let out = folder.path().join("deep/study");
        claim(&out, false).unwrap();
        for name in ["study.csv", "notes.md", "runs/007.stderr", "runs/mine.txt"] {
            fs::write(out.join(name), "old").unwrap();
        }
        fs::create_dir(out.join("runs/007")).unwrap();
        let refused = claim(&out, false).unwrap_err();
        assert!(matches!(&refused, StudyError::Input(words) if words.contains("--force")), "{refused}");
        assert!(out.join("study.csv").exists());
        claim(&out, true).unwrap();
        let there = |name: &str| out.join(name).exists();
        assert!(there("notes.md") && there("runs/mine.txt"));
        assert!(!there("study.csv") && !there("runs/007") && !there("runs/007.stderr"));
    }

    #[test]
    fn a_file_is_no_folder() {
        let folder = tempfile::tempdir().unwrap();
        let out = folder.path().join("file");
        fs::write(&out, "mine").unwrap();
        assert!(matches!(claim(&out, true), Err(StudyError::Input(_))));
    }
}
