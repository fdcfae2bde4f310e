//! The stages of a run.

use crate::output::RunError;
use crate::petsc::{Session, Stage};

/// Stages of a run, as the summary times them.
pub struct Stages {
    /// Reading, partition.
    pub mesh: Stage,
    /// Assembly of matrices.
    pub assemble: Stage,
    /// Placing and coupling of contacts.
    pub contact: Stage,
    /// Setting up solvers.
    pub setup: Stage,
    /// Solving.
    pub solve: Stage,
    /// Looking at solutions, and writing them.
    pub output: Stage,
}

impl Stages {
    /// All stages. **Collective**
    pub fn new(session: &Session) -> Result<Self, RunError> {
        let stage = |name| Stage::new(session, name);
        Ok(Self {
            mesh: stage("mesh")?,
            assemble: stage("assemble")?,
            contact: stage("contact")?,
            setup: stage("setup")?,
            solve: stage("solve")?,
            output: stage("output")?,
        })
    }
}
