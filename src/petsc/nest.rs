//! Matrices made of two by two others.

use super::error::{Result, petsc};
use super::index_set::IndexSet;
use super::matrix::Matrix;
use super::session::Session;
use std::ptr;

impl Matrix {
    /// The matrix `[A B; C D]` of four others, which it shares: on each rank the rows of `A` come before those of `C`.
    /// Vectors from [`Matrix::create_vectors`] are plain ones, with a rank's entries in that order. **Collective**
    pub fn nest(session: &Session, blocks: [[&Matrix; 2]; 2]) -> Result<Self> {
        let mut raw = ptr::null_mut();
        let all = blocks.as_flattened().iter().map(|block| block.raw()).collect::<Vec<_>>();
        petsc!(MatCreateNest(session.raw(), 2, ptr::null(), 2, ptr::null(), all.as_ptr(), &mut raw))?;
        Ok(Self::from_raw(session, raw))
    }

    /// Global row numbers of the upper and of the lower blocks.
    ///
    /// # Errors
    /// If the matrix is not a nest.
    pub fn nest_index_sets(&self) -> Result<[IndexSet; 2]> {
        let mut rows = [ptr::null_mut(); 2];
        petsc!(MatNestGetISs(self.raw(), rows.as_mut_ptr(), ptr::null_mut()))?;
        let [upper, lower] =
            rows.map(|set| petsc!(PetscObjectReference(set.cast())).map(|()| IndexSet::from_raw(self.session(), set)));
        Ok([upper?, lower?])
    }

    /// Tells a nest that entries of its blocks have changed, so that preconditioners are built again. **Collective**
    pub fn refresh(&mut self) -> Result<()> {
        self.assemble()
    }
}
