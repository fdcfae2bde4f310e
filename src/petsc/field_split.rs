//! Preconditioners of two fields.

use super::error::{Result, petsc};
use super::ffi;
use super::index_set::IndexSet;
use super::krylov::Krylov;
use super::matrix::Matrix;
use super::preconditioner::Preconditioner;
use std::ffi::CString;
use std::ptr;

impl Preconditioner {
    /// Block elimination of two named fields with the given approximation `schur` of the lower block's
    /// Schur complement; upper triangular unless options say otherwise. **Collective**
    pub fn field_split_schur(&self, fields: &[(&str, &IndexSet)], schur: &Matrix) -> Result<()> {
        self.set_kind("fieldsplit")?;
        for (name, set) in fields {
            let name = CString::new(*name).expect("a field name has no zero byte");
            petsc!(PCFieldSplitSetIS(self.raw, name.as_ptr(), set.raw))?;
        }
        // PETSc forgets the Schur matrix, and does not say so, if it comes before the type.
        petsc!(PCFieldSplitSetType(self.raw, ffi::PCCompositeType::PC_COMPOSITE_SCHUR))?;
        let given = ffi::PCFieldSplitSchurPreType::PC_FIELDSPLIT_SCHUR_PRE_USER;
        petsc!(PCFieldSplitSetSchurPre(self.raw, given, schur.raw))?;
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
}
