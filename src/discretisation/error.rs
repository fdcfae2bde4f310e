//! Why there is no system.

use crate::element::BadJacobian;
use crate::petsc::{self, Session};

/// Why a system cannot be set up or solved.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SystemError {
    /// The case asks for something that cannot be; in words.
    #[error("{0}")]
    Case(String),
    /// PETSc options of the user's that nothing has asked for, each as `-name value`.
    #[error("PETSc options that nothing has used: {}; check their spelling", .0.join(", "))]
    UnusedOptions(Vec<String>),
    /// PETSc or MPI failed.
    #[error(transparent)]
    Petsc(#[from] petsc::Error),
}

impl From<BadJacobian> for SystemError {
    fn from(error: BadJacobian) -> Self {
        Self::Case(format!("mesh: {error}; refine the mesh along the curved boundary, or correct its [geometry]"))
    }
}

impl From<String> for SystemError {
    fn from(words: String) -> Self {
        Self::Case(words)
    }
}

/// An outcome on which all ranks agree: an inverted triangle on one of them is an error of all. **Collective**
///
/// # Errors
/// [`SystemError::Case`] with the words of the first rank that has any.
pub fn agreed<T>(session: &Session, outcome: Result<T, SystemError>) -> Result<T, SystemError> {
    Ok(session.agree(outcome)?)
}
