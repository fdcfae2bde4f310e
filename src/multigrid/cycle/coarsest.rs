//! What solves on the coarsest level: a factor on the one rank that has all of it, or where there are so many bodies that not even
//! an auxiliary level is small, a factor that all ranks make.

use super::sparse_factor::SparseFactor;
use crate::multigrid::stiffness::LatticeOperator;
use crate::petsc::{Error, Krylov, Matrix, Result, Session, Vector};
use std::rc::Rc;

/// Prefix of the options of the shared factor; `system/solver` has the defaults.
const PREFIX: &str = "fieldsplit_u_coarsest_";

/// The coarsest level: its solver, forces and solution.
pub struct Coarsest {
    lattice: Rc<LatticeOperator>,
    solver: CoarsestSolver,
    pub b: Vec<[f64; 2]>,
    pub x: Vec<[f64; 2]>,
}

enum CoarsestSolver {
    /// Of a small level, on the rank that has it.
    Factor(Option<Box<SparseFactor>>),
    Shared {
        solver: Krylov,
        rows: Matrix,
        b: Vector,
        x: Vector,
    },
}

impl Coarsest {
    /// Of the coarsest level, with its factor. **Collective**
    ///
    /// # Errors
    /// [`Error::Singular`] on every rank if the level is singular.
    pub fn new(lattice: &Rc<LatticeOperator>, is_small: bool, session: &Session) -> Result<Self> {
        let solver = if is_small { CoarsestSolver::Factor(factor(lattice, session)?) } else { shared(lattice, session)? };
        let nodes = vec![[0.0; 2]; lattice.node_count()];
        Ok(Self { lattice: lattice.clone(), solver, b: nodes.clone(), x: nodes })
    }

    /// Takes over changed values. **Collective**
    ///
    /// # Errors
    /// As of [`Coarsest::new`].
    pub fn refresh(&mut self, session: &Session) -> Result<()> {
        match &mut self.solver {
            CoarsestSolver::Factor(known) => *known = factor(&self.lattice, session)?,
            CoarsestSolver::Shared { solver, rows, .. } => {
                self.lattice.renew(0..self.lattice.node_count() as u32, rows)?;
                rows.assemble()?;
                factorise(solver, rows, session)?;
            }
        }
        Ok(())
    }

    /// `x = A⁻¹ b`. **Collective**
    pub fn solve(&mut self) -> Result<()> {
        let (forces, found) = (self.b.as_flattened(), self.x.as_flattened_mut());
        match &mut self.solver {
            CoarsestSolver::Factor(None) => Ok(()),
            CoarsestSolver::Factor(Some(factor)) => {
                found.copy_from_slice(forces);
                factor.solve(found);
                Ok(())
            }
            CoarsestSolver::Shared { solver, b, x, .. } => {
                b.values_mut().copy_from_slice(forces);
                solver.apply(b, x)?;
                found.copy_from_slice(&x.values());
                Ok(())
            }
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

/// **Collective**
fn shared(lattice: &LatticeOperator, session: &Session) -> Result<CoarsestSolver> {
    let (solver, mut rows) = (Krylov::new(session, PREFIX)?, lattice.expanded(session)?);
    solver.set_operators(&rows, &rows)?;
    solver.set_from_options()?;
    factorise(&solver, &mut rows, session)?;
    let (x, b) = rows.create_vectors()?;
    Ok(CoarsestSolver::Shared { solver, rows, b, x })
}

/// Makes the shared factor of rows with new values. **Collective**
fn factorise(solver: &Krylov, rows: &mut Matrix, session: &Session) -> Result<()> {
    rows.set_positive_definite(true)?;
    solver.set_operators(rows, rows)?;
    solver.set_up()?;
    if session.any(solver.preconditioner().has_failed()?) { Err(Error::Singular) } else { Ok(()) }
}
