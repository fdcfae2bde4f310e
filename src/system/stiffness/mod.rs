//! The stiffness of the bodies on each level: assembled rows, and strips that need not be.

mod assembly;
mod elastic;
mod expanded;
mod lanes;
mod lattice_operator;
mod lattice_rows;
mod matrices;
mod preallocation;
mod precision;
mod stored_rows;
mod strip_kernel;
mod strips;

pub use elastic::Elastic;
pub use lattice_operator::{LatticeOperator, Strips};
pub use lattice_rows::LatticeRows;
pub use preallocation::ContactNeighbours;
pub use precision::Precision;
pub use stored_rows::StoredRows;

use super::{Space, SystemError};
use crate::petsc::{Matrix, Session};
use matrices::contact_places;
use std::collections::BTreeSet;
use std::rc::Rc;

/// `K`, or `K + Bᵀ D B`, of one level.
pub struct Stiffness {
    rows: Rows,
    /// Nodes of this rank whose rows have been added to since they were assembled.
    changed: BTreeSet<usize>,
}

/// The rows of a level.
enum Rows {
    /// All are stored.
    Stored(Matrix),
    /// Some are, the others lie in strips; solvers see a shell around both.
    Lattice { lattice: Rc<LatticeOperator>, shell: Matrix },
}

impl Stiffness {
    /// From its stored rows, assembled, and the others, if there are any. **Collective**
    fn new(stored: Matrix, strips: Option<&Rc<Strips>>, space: &Space, session: &Session) -> Result<Self, SystemError> {
        let rows = match strips {
            None => Rows::Stored(stored),
            Some(strips) => {
                let lattice = Rc::new(LatticeOperator::new(stored, &space.own, strips, session)?);
                let mut shell = Matrix::operator(session, space.local_unknowns(), Box::new(lattice.clone()))?;
                shell.set_positive_definite(true)?;
                Rows::Lattice { lattice, shell }
            }
        };
        Ok(Self { rows, changed: BTreeSet::new() })
    }

    /// What solvers see.
    pub fn operator(&self) -> &Matrix {
        match &self.rows {
            Rows::Stored(matrix) => matrix,
            Rows::Lattice { shell, .. } => shell,
        }
    }

    /// Its strips and stored rows, if it is made of these.
    pub fn lattice(&self) -> Option<&Rc<LatticeOperator>> {
        match &self.rows {
            Rows::Stored(_) => None,
            Rows::Lattice { lattice, .. } => Some(lattice),
        }
    }

    /// The matrix of all rows, if all are stored.
    pub fn into_stored(self) -> Option<Matrix> {
        match self.rows {
            Rows::Stored(matrix) => Some(matrix),
            Rows::Lattice { .. } => None,
        }
    }

    /// Whether some rows are not stored.
    pub fn has_strips(&self) -> bool {
        matches!(self.rows, Rows::Lattice { .. })
    }

    /// Adds a block to the couplings of two nodes of contact, the row being one of this rank's. Holds after
    /// [`Stiffness::assemble`].
    pub fn add_block(&mut self, row: usize, column: usize, block: &[f64; 4]) -> Result<(), SystemError> {
        self.changed.insert(row);
        match &mut self.rows {
            Rows::Stored(matrix) => Ok(matrix.add_blocks(&[row as i32], &[column as i32], block)?),
            Rows::Lattice { lattice, .. } => Ok(lattice.add_block(row, column, block)?),
        }
    }

    /// Makes added blocks hold; the work is that of the rows that they are in. **Collective**
    pub fn assemble(&mut self) -> Result<(), SystemError> {
        let changed = std::mem::take(&mut self.changed);
        match &mut self.rows {
            Rows::Stored(matrix) => matrix.assemble()?,
            Rows::Lattice { lattice, shell } => {
                lattice.assemble(changed.into_iter())?;
                // PETSc is told that values have changed; it forgets what else it knew.
                shell.assemble()?;
                shell.set_positive_definite(true)?;
            }
        }
        Ok(())
    }

    /// A copy with places for the couplings of a contact boundary. **Collective**
    fn with_places(&self, space: &Space, neighbours: &ContactNeighbours, session: &Session) -> Result<Self, SystemError> {
        let places = contact_places(space, neighbours, session)?;
        let (mut stored, strips) = match &self.rows {
            Rows::Stored(matrix) => (matrix.sum(&places)?, None),
            Rows::Lattice { lattice, .. } => (lattice.stored().sum(&places)?, Some(lattice.strips())),
        };
        stored.set_positive_definite(true)?;
        Self::new(stored, strips, space, session)
    }

    /// With all its rows stored, as factorisations want it; `None` if they are. **Collective**
    pub fn expanded(&self, session: &Session) -> Result<Option<Matrix>, SystemError> {
        match &self.rows {
            Rows::Stored(_) => Ok(None),
            Rows::Lattice { lattice, .. } => Ok(Some(lattice.expanded(session)?)),
        }
    }
}
