//! Why a study has no table.

use crate::case::CaseError;
use crate::output::OutputError;

/// Why there is no table.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum StudyError {
    /// The study cannot be made as it stands: 2.
    #[error("{0}")]
    Input(String),
    /// The disk failed: 1.
    #[error("{0}")]
    Failed(String),
}

impl From<CaseError> for StudyError {
    fn from(error: CaseError) -> Self {
        Self::Input(error.to_string())
    }
}

impl From<OutputError> for StudyError {
    fn from(error: OutputError) -> Self {
        match error {
            OutputError::Io { .. } => Self::Failed(error.to_string()),
            refused => Self::Input(refused.to_string()),
        }
    }
}
