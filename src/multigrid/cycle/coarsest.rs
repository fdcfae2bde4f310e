//! What solves on the coarsest level of the mesh: a factor on the one rank that has all of it, or levels of mezha's own below it.

use super::level::CycleLevel;
use crate::multigrid::stiffness::LatticeOperator;
use crate::petsc::{Error, Factor, Krylov, Matrix, MultigridCycle, MultigridLevel, Result, Session, Vector};

/// Prefix of the options of the smoothers and of the coarsest solver: that of PETSc's own multigrid, so that the defaults of
/// `system/solver` hold here, too.
const PREFIX: &str = "fieldsplit_u_";

/// The solver of the coarsest level of the mesh.
pub enum Coarsest {
    /// The level is small: a factor on the rank that has it.
    Factor(Option<Factor>),
    /// It is not: a cycle of PETSc's multigrid, on this level and the auxiliary ones below it.
    Auxiliary { solver: Krylov, b: Vector, x: Vector },
}

impl Coarsest {
    /// A factor of a level that one rank has. **Collective**
    ///
    /// # Errors
    /// [`Error::NotConverged`] on every rank if the level is singular.
    pub fn factor(lattice: &LatticeOperator, session: &Session) -> Result<Self> {
        assert_eq!(lattice.far_count(), 0, "one rank has all nodes of the coarsest level");
        let has_nodes = lattice.node_count() > 0;
        let factor = has_nodes.then(|| Factor::new(session, &lattice.rows().borrow().scalar_rows())).transpose();
        let is_singular = matches!(factor, Err(Error::NotConverged { .. }));
        if session.any(is_singular) { Err(Factor::singular()) } else { factor.map(Self::Factor) }
    }

    /// A cycle on auxiliary levels and, as the last one, the coarsest level of the mesh. **Collective**
    pub fn auxiliary(levels: &[MultigridLevel], session: &Session) -> Result<Self> {
        let finest: &Matrix = levels[levels.len() - 1].operator;
        let solver = Krylov::new(session, PREFIX)?;
        solver.set_operators(finest, finest)?;
        solver.set_from_options()?;
        solver.preconditioner().multigrid(MultigridCycle::Full, levels)?;
        solver.set_up()?;
        let (b, x) = finest.create_vectors()?;
        Ok(Self::Auxiliary { solver, b, x })
    }

    /// Takes over changed values. **Collective**
    pub fn refresh(&mut self, lattice: &LatticeOperator, session: &Session) -> Result<()> {
        match self {
            Self::Factor(_) => *self = Self::factor(lattice, session)?,
            Self::Auxiliary { solver, .. } => solver.preconditioner().set_up()?,
        }
        Ok(())
    }

    /// Solves with the right-hand side of a level, on auxiliary levels by one such cycle. **Collective**
    pub fn solve(&mut self, cycle: MultigridCycle, level: &mut CycleLevel) -> Result<()> {
        let (from, to) = (level.b.as_flattened(), level.x.as_flattened_mut());
        let set = |b: &mut [f64]| b.copy_from_slice(from);
        let mut get = |x: &[f64]| to.copy_from_slice(x);
        match self {
            Self::Factor(None) => Ok(()),
            Self::Factor(Some(factor)) => factor.solve(set, get),
            Self::Auxiliary { solver, b, x } => {
                set(&mut b.values_mut());
                solver.preconditioner().set_cycle(cycle)?;
                solver.apply(b, x)?;
                get(&x.values());
                Ok(())
            }
        }
    }
}
