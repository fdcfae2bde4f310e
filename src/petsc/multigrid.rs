//! Multigrid on levels that are given.

use super::error::{Result, petsc};
use super::matrix::Matrix;
use super::preconditioner::Preconditioner;
use super::vector::length;
use super::{ffi, options};
use std::ptr;

/// One level of a multigrid method.
pub struct MultigridLevel<'a> {
    /// The operator of this level.
    pub operator: &'a Matrix,
    /// Interpolation from the next coarser level to this one; `None` on the coarsest. Restriction is its transpose.
    pub interpolation: Option<&'a Matrix>,
}

impl Preconditioner {
    /// Makes this a full multigrid cycle over `levels`, the coarsest first, and reads its options. **Collective**
    ///
    /// A default that had switched the preconditioner to another kind gives way; a kind of the user's stays.
    ///
    /// # Panics
    /// If interpolations are missing or the coarsest level has one.
    pub fn multigrid(&self, levels: &[MultigridLevel<'_>]) -> Result<()> {
        let complete = levels.iter().enumerate().all(|(l, level)| level.interpolation.is_some() == (l > 0));
        assert!(complete && !levels.is_empty(), "an interpolation on every level but the coarsest");
        // An earlier default such as "none" would win again when options are read.
        options::set_default(self.session(), &format!("-{}pc_type", self.prefix()), "mg")?;
        self.set_kind("mg")?;
        petsc!(PCMGSetLevels(self.raw(), length(levels.len()), ptr::null_mut()))?;
        petsc!(PCMGSetType(self.raw(), ffi::PCMGType::PC_MG_FULL))?;
        for (l, level) in levels.iter().enumerate() {
            if let Some(interpolation) = level.interpolation {
                petsc!(PCMGSetInterpolation(self.raw(), length(l), interpolation.raw()))?;
            }
            let mut smoother = ptr::null_mut();
            petsc!(PCMGGetSmoother(self.raw(), length(l), &mut smoother))?;
            petsc!(KSPSetOperators(smoother, level.operator.raw(), level.operator.raw()))?;
        }
        self.set_from_options()
    }
}
