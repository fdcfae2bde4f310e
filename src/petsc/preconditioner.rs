//! Preconditioners.

use super::error::{Result, give_back, petsc, words};
use super::ffi;
use super::index_set::IndexSet;
use super::krylov::Krylov;
use super::matrix::Matrix;
use super::session::Session;
use std::ffi::CString;
use std::ptr;

/// The preconditioner of a [`Krylov`] method.
pub struct Preconditioner {
    raw: ffi::PC,
    session: Session,
}

impl Preconditioner {
    /// Another reference to a preconditioner of PETSc's.
    pub(super) fn share(session: &Session, raw: ffi::PC) -> Result<Self> {
        petsc!(PetscObjectReference(raw.cast()))?;
        Ok(Self { raw, session: session.clone() })
    }

    pub(super) fn raw(&self) -> ffi::PC {
        self.raw
    }

    pub(super) fn session(&self) -> &Session {
        &self.session
    }

    /// Chooses the kind by PETSc's name, such as `"lu"`. **Collective**
    pub fn set_kind(&self, kind: &str) -> Result<()> {
        let kind = CString::new(kind).expect("a kind has no zero byte");
        petsc!(PCSetType(self.raw, kind.as_ptr()))
    }

    /// Its kind by PETSc's name; empty before one has been chosen.
    pub fn kind(&self) -> String {
        let mut kind = ptr::null();
        petsc!(PCGetType(self.raw, &mut kind)).expect("a preconditioner knows its kind");
        words(kind)
    }

    /// Reads its options. **Collective**
    pub fn set_from_options(&self) -> Result<()> {
        petsc!(PCSetFromOptions(self.raw))
    }

    /// Prepares it for its operators. **Collective**
    pub fn set_up(&self) -> Result<()> {
        petsc!(PCSetUp(self.raw))
    }

    /// Keeps what has been prepared although the operators have changed, or not. **Collective**
    pub fn set_reuse(&self, reuse: bool) -> Result<()> {
        let flag = if reuse { ffi::PetscBool::PETSC_TRUE } else { ffi::PetscBool::PETSC_FALSE };
        petsc!(PCSetReusePreconditioner(self.raw, flag))
    }

    /// What its options begin with after the minus; may be empty.
    pub fn prefix(&self) -> String {
        let mut prefix = ptr::null();
        petsc!(PCGetOptionsPrefix(self.raw, &mut prefix)).expect("a preconditioner knows its prefix");
        words(prefix)
    }

    /// Block elimination of two named fields with the given approximation `schur` of the lower block's
    /// Schur complement; upper triangular unless options say otherwise. **Collective**
    pub fn field_split_schur(&self, fields: &[(&str, &IndexSet)], schur: &Matrix) -> Result<()> {
        self.set_kind("fieldsplit")?;
        for (name, set) in fields {
            let name = CString::new(*name).expect("a field name has no zero byte");
            petsc!(PCFieldSplitSetIS(self.raw, name.as_ptr(), set.raw()))?;
        }
        // PETSc forgets the Schur matrix, and does not say so, if it comes before the type.
        petsc!(PCFieldSplitSetType(self.raw, ffi::PCCompositeType::PC_COMPOSITE_SCHUR))?;
        let given = ffi::PCFieldSplitSchurPreType::PC_FIELDSPLIT_SCHUR_PRE_USER;
        petsc!(PCFieldSplitSetSchurPre(self.raw, given, schur.raw()))?;
        let upper = ffi::PCFieldSplitSchurFactType::PC_FIELDSPLIT_SCHUR_FACT_UPPER;
        petsc!(PCFieldSplitSetSchurFactType(self.raw, upper))
    }

    /// The solvers of the fields, in their order; after set-up. **Collective**
    pub fn field_split_solvers(&self) -> Result<Vec<Krylov>> {
        let (mut count, mut array) = (0, ptr::null_mut());
        petsc!(PCFieldSplitGetSubKSP(self.raw, &mut count, &mut array))?;
        let solvers: Result<Vec<Krylov>> =
            (0..count as usize).map(|i| Krylov::share(&self.session, unsafe { *array.add(i) })).collect();
        petsc!(mezha_free(array.cast()))?;
        solvers
    }

    /// What failed when it was prepared or applied last, in words.
    pub(super) fn failure(&self) -> Result<&'static str> {
        use ffi::PCFailedReason as Reason;
        let mut reason = Reason::PC_NOERROR;
        petsc!(PCGetFailedReason(self.raw, &mut reason))?;
        Ok(match reason {
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

impl Drop for Preconditioner {
    /// Gives back one PETSc reference. **Collective**
    fn drop(&mut self) {
        give_back(|| unsafe { ffi::PCDestroy(&mut self.raw) });
    }
}
