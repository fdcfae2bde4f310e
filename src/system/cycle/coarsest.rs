//! The coarsest level, which every rank solves for itself.

use super::level::CycleLevel;
use crate::petsc::{Datum, Factor, Result, Session};
use crate::system::stiffness::{LatticeOperator, Precision};

/// A factor of the stiffness of all nodes.
pub struct Coarsest(Factor);

impl Coarsest {
    /// **Collective**
    pub fn new(lattice: &LatticeOperator, session: &Session) -> Result<Self> {
        let rows = lattice.gathered(session).scalar_rows();
        Ok(Self(Factor::new(session, &rows)?))
    }

    /// Takes over changed values. **Collective**
    pub fn refresh(&mut self, lattice: &LatticeOperator, session: &Session) -> Result<()> {
        *self = Self::new(lattice, session)?;
        Ok(())
    }

    /// Solves with the right-hand side of a level, which has all nodes.
    pub fn solve<T: Precision + Datum>(&mut self, level: &mut CycleLevel<T>) -> Result<()> {
        let CycleLevel { b, x, .. } = level;
        let set = |to: &mut [f64]| {
            assert_eq!(to.len(), 2 * b.len(), "all nodes of the coarsest level are here");
            to.iter_mut().zip(b.as_flattened()).for_each(|(to, from)| *to = from.double());
        };
        let get = |from: &[f64]| x.as_flattened_mut().iter_mut().zip(from).for_each(|(to, &from)| *to = T::of(from));
        self.0.solve(set, get)
    }
}
