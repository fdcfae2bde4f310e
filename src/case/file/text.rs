//! Text and name of a file.

use std::path::Path;

use super::error::CaseError;
use crate::mesh::read_regular;

/// A case or a study file is never as large.
const MOST_BYTES: u64 = 64 << 20;

/// Text of a file; `kind` says which one the command wants.
///
/// # Errors
/// The file cannot be read.
pub fn read_text(file: &Path, kind: &str) -> Result<String, CaseError> {
    let refused = |words: String| {
        CaseError::of_file(file, format!("cannot be read: {words}; the first argument is the path of a {kind} file"))
    };
    let bytes = read_regular(file, MOST_BYTES).map_err(|error| refused(error.to_string()))?;
    String::from_utf8(bytes).map_err(|_| refused("it is no text in UTF-8".into()))
}

/// Name of the folder if the file is called as most are, `case.toml`, say; else the file's stem.
pub fn name_of(file: &Path, usual: &str) -> String {
    let stem = file.file_stem().unwrap_or_default();
    if file.file_name() != Some(usual.as_ref()) {
        return stem.to_string_lossy().into_owned();
    }
    let here = file.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let folder = here.canonicalize().or_else(|_| std::path::absolute(here)).unwrap_or_default();
    folder.file_name().unwrap_or(stem).to_string_lossy().into_owned()
}
