//! Preconditioners.

use super::error::{Result, given_back, petsc, words};
use super::ffi;
use super::session::Session;
use std::ffi::CString;
use std::ptr;

/// The preconditioner of a [`super::Krylov`] method.
pub struct Preconditioner {
    pub(super) raw: ffi::PC,
    pub(super) session: Session,
}

impl Preconditioner {
    /// Another reference to a preconditioner of PETSc's.
    pub(super) fn share(session: &Session, raw: ffi::PC) -> Result<Self> {
        petsc!(PetscObjectReference(raw.cast()))?;
        Ok(Self { raw, session: session.clone() })
    }

    /// Chooses the kind by PETSc's name, such as `"lu"`. **Collective**
    pub fn set_kind(&self, kind: &str) -> Result<()> {
        let kind = CString::new(kind).expect("a kind has no zero byte");
        petsc!(PCSetType(self.raw, kind.as_ptr()))
    }

    /// Kind of the preconditioner by PETSc's name; empty before one has been chosen.
    pub fn kind(&self) -> String {
        let mut kind = ptr::null();
        petsc!(PCGetType(self.raw, &mut kind)).expect("a preconditioner knows its kind");
        words(kind)
    }

    /// Whether its factorisation could not get the memory that it asked for.
    pub(super) fn is_out_of_memory(&self) -> Result<bool> {
        Ok(self.failed_by()? == ffi::PCFailedReason::PC_FACTOR_OUTMEMORY)
    }

    fn failed_by(&self) -> Result<ffi::PCFailedReason> {
        let mut reason = ffi::PCFailedReason::PC_NOERROR;
        petsc!(PCGetFailedReason(self.raw, &mut reason))?;
        Ok(reason)
    }

    /// What failed when it was prepared or applied last, in words.
    pub(super) fn failure(&self) -> Result<&'static str> {
        use ffi::PCFailedReason as Reason;
        Ok(match self.failed_by()? {
            Reason::PC_FACTOR_STRUCT_ZEROPIVOT => "factorisation: a pivot is missing from the pattern",
            Reason::PC_FACTOR_NUMERIC_ZEROPIVOT => "factorisation: zero pivot, the matrix is singular",
            Reason::PC_FACTOR_OUTMEMORY => "factorisation: out of memory",
            Reason::PC_FACTOR_OTHER => "factorisation failed",
            Reason::PC_SUBPC_ERROR => "an inner preconditioner failed",
            Reason::PC_SETUP_ERROR => "the preconditioner could not be prepared",
            _ => "the preconditioner gave no finite result",
        })
    }
}

given_back!(Preconditioner, raw, PCDestroy);
