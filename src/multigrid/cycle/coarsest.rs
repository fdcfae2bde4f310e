//! What solves on the coarsest level: a factor on the one rank that has all of it. Where there are so many bodies that not even an
//! auxiliary level is small, too: one that all ranks make together adds in the order in which their messages come, so that its last
//! digits differ from run to run.

use super::sparse_factor::SparseFactor;
use crate::multigrid::stiffness::LatticeOperator;
use crate::petsc::{Error, Result, Session};
use std::rc::Rc;

/// The coarsest level: its factor, on the rank that has it, forces and solution.
pub struct Coarsest {
    lattice: Rc<LatticeOperator>,
    factor: Option<Box<SparseFactor>>,
    pub b: Vec<[f64; 2]>,
    pub x: Vec<[f64; 2]>,
}

impl Coarsest {
    /// Of the coarsest level, with its factor. **Collective**
    ///
    /// # Errors
    /// [`Error::Singular`] on every rank if the level is singular.
    pub fn new(lattice: &Rc<LatticeOperator>, session: &Session) -> Result<Self> {
        let nodes = vec![[0.0; 2]; lattice.node_count()];
        Ok(Self { lattice: lattice.clone(), factor: factor(lattice, session)?, b: nodes.clone(), x: nodes })
    }

    /// Takes over changed values. **Collective**
    ///
    /// # Errors
    /// As of [`Coarsest::new`].
    pub fn refresh(&mut self, session: &Session) -> Result<()> {
        self.factor = factor(&self.lattice, session)?;
        Ok(())
    }

    /// `x = A⁻¹ b`, on the rank that has the level.
    pub fn solve(&mut self) {
        if let Some(factor) = &mut self.factor {
            self.x.copy_from_slice(&self.b);
            factor.solve(self.x.as_flattened_mut());
        }
    }
}

/// **Collective**
fn factor(lattice: &LatticeOperator, session: &Session) -> Result<Option<Box<SparseFactor>>> {
    assert_eq!(lattice.far.len(), 0, "one rank has all nodes of the coarsest level");
    let unknowns = 2 * lattice.node_count();
    let new = || SparseFactor::new(unknowns, &lattice.rows.borrow().lower_entries()).map(Box::new);
    let factor = (unknowns > 0).then(new).transpose();
    let is_singular = session.any(factor.is_err());
    factor.ok().filter(|_| !is_singular).ok_or(Error::Singular)
}
