//! Named spans of time, which PETSc's own log (`-log_view`) shows too.

use super::error::{Result, petsc};
use super::ffi;
use super::session::Session;
use std::cell::Cell;
use std::ffi::CString;
use std::time::Instant;

/// A stage of the run and the time spent in it.
pub struct Stage {
    number: ffi::PetscLogStage,
    seconds: Cell<f64>,
    _session: Session,
}

impl Stage {
    /// A stage called `name`; a second one of the same name counts its own seconds. **Collective**
    pub fn new(session: &Session, name: &str) -> Result<Self> {
        let name = CString::new(name).expect("a stage name has no zero byte");
        let mut number = -1;
        petsc!(PetscLogStageGetId(name.as_ptr(), &mut number))?;
        if number < 0 {
            petsc!(PetscLogStageRegister(name.as_ptr(), &mut number))?;
        }
        Ok(Self { number, seconds: Cell::new(0.0), _session: session.clone() })
    }

    /// Enters the stage until the guard is dropped. Stages nest.
    pub fn enter(&self) -> StageGuard<'_> {
        petsc!(PetscLogStagePush(self.number)).expect("a registered stage");
        StageGuard { stage: self, start: Instant::now() }
    }

    /// Wall seconds on this rank inside the stage so far, with the stages entered from there.
    pub fn seconds(&self) -> f64 {
        self.seconds.get()
    }
}

/// Ends its stage when dropped.
pub struct StageGuard<'a> {
    stage: &'a Stage,
    start: Instant,
}

impl Drop for StageGuard<'_> {
    fn drop(&mut self) {
        unsafe { ffi::PetscLogStagePop() };
        self.stage.seconds.set(self.stage.seconds.get() + self.start.elapsed().as_secs_f64());
    }
}
