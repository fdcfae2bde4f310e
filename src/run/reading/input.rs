//! What a run is made of: rank 0 alone reads the files, and all ranks work on its bytes.

use crate::case::{Case, Inputs, fingerprint, read_text};
use crate::mesh::read_bytes;
use crate::output::RunError;
use crate::petsc::Session;
use crate::run::reading::scene;
use std::path::Path;

/// Reads and checks a case file, after the overrides `KEY=VALUE`; it must be the one that is `wanted`, if any is. **Collective**
///
/// # Errors
/// [`RunError::Input`] with everything that is wrong, [`RunError::Overtaken`] if it is another file; on every rank alike.
pub fn read_case(file: &Path, overrides: &[String], wanted: Option<&Inputs>, session: &Session) -> Result<Case, RunError> {
    let text = session.share(|| read_text(file, "case").map(String::into_bytes));
    refuse_change(file, &text, wanted.map(|inputs| &inputs.case))?;
    let text = String::from_utf8(text.map_err(RunError::Input)?).expect("rank 0 has read a text");
    // Every rank has read the same text, so that all want the mesh or none, for the names that patterns stand for.
    let bytes = |mesh: &Path| session.share(|| read_bytes(mesh).map_err(|error| error.to_string()));
    match Case::parse_with(&text, file, overrides, &bytes) {
        Ok(case) => Ok(session.agree::<_, String>(Ok(case)).map_err(RunError::Input)?),
        Err(error) => {
            // Every rank has read the same text, so that all are here.
            let words = session
                .share(|| Ok::<_, String>(scene::told_with_names(&error, Case::draft(&text, file, overrides)).into_bytes()))
                .map_err(RunError::Input)?;
            Err(RunError::Input(String::from_utf8_lossy(&words).into_owned()))
        }
    }
}

/// The bytes of the mesh file; it must be the one that is `wanted`, if any is. **Collective**
///
/// # Errors
/// As of [`read_case`].
pub(crate) fn share_mesh(case: &Case, wanted: Option<&Inputs>, session: &Session) -> Result<Vec<u8>, RunError> {
    let bytes = session.share(|| scene::read_mesh_file(case));
    refuse_change(&case.mesh.file, &bytes, wanted.map(|inputs| &inputs.mesh))?;
    bytes.map_err(RunError::Input)
}

/// A file that cannot be read counts as an empty one.
fn refuse_change(file: &Path, bytes: &Result<Vec<u8>, String>, wanted: Option<&String>) -> Result<(), RunError> {
    let found = || fingerprint(&[bytes.as_deref().unwrap_or_default()]);
    match wanted {
        Some(wanted) if *wanted != found() => {
            let words = "has changed since this run was asked for; ask for it again";
            Err(RunError::Overtaken(format!("{} {words}", file.display())))
        }
        _ => Ok(()),
    }
}
