//! The stiffness of the bodies on each level: rows that are stored, and strips that need not be.

mod assembly;
mod block_lanes;
mod earlier_couplings;
mod elastic;
mod even_triangles;
mod expanded;
mod lanes;
mod lattice_operator;
mod lattice_rows;
mod pattern;
mod precision;
mod recurrence;
mod registers;
mod row_kernel;
mod row_stencil;
mod stored_rows;
mod strip_kernel;
mod strip_set;
mod strips;
mod sweep_order;
mod triangle_kernel;

pub use earlier_couplings::EarlierCouplings;
pub use elastic::Elastic;
pub use even_triangles::EvenTriangles;
pub use lattice_operator::LatticeOperator;
pub use lattice_rows::LatticeRows;
pub use precision::Precision;
pub use stored_rows::StoredRows;
pub use strip_kernel::SweepHalves;
pub use strip_set::Strips;

use super::SystemError;
use crate::element::Block;
use crate::petsc::{Index, Matrix, Session};
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

/// Nodes that contact couples to each node.
pub type ContactNeighbours = BTreeMap<usize, BTreeSet<usize>>;

/// What solvers of PETSc's see of a stiffness.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum SolverView {
    /// What it does: a shell.
    Action,
    /// All its rows, in a matrix of PETSc's.
    Entries,
}

/// `K`, or `K + Bᵀ D B`, of one level.
pub struct Stiffness {
    lattice: Rc<LatticeOperator>,
    matrix: Matrix,
    seen: SolverView,
    /// Nodes of this rank whose rows have been added to since they were assembled, each perhaps several times.
    changed: Vec<usize>,
}

impl Stiffness {
    /// From its rows. **Collective**
    fn new(lattice: LatticeOperator, seen: SolverView, session: &Session) -> Result<Self, SystemError> {
        let lattice = Rc::new(lattice);
        let mut matrix = match seen {
            SolverView::Action => Matrix::operator(session, 2 * lattice.own.len(), Box::new(lattice.clone()))?,
            SolverView::Entries => lattice.expanded(session)?,
        };
        matrix.set_positive_definite(true)?;
        Ok(Self { lattice, matrix, seen, changed: Vec::new() })
    }

    /// What solvers see.
    pub fn operator(&self) -> &Matrix {
        &self.matrix
    }

    /// Its rows.
    pub fn lattice(&self) -> &Rc<LatticeOperator> {
        &self.lattice
    }

    /// The matrix of all rows, if there is one.
    pub fn into_stored(self) -> Option<Matrix> {
        (self.seen == SolverView::Entries).then_some(self.matrix)
    }

    /// Whether some rows of this rank lie in strips or in even macro triangles.
    pub fn has_strips(&self) -> bool {
        !self.lattice.strips.nodes.is_empty() || !self.lattice.even.triangles.is_empty()
    }

    /// Adds blocks to the couplings of a node of contact, one of this rank's, with others; each is a column node and its block.
    /// Holds after [`Stiffness::assemble`].
    pub fn add_to_row(&mut self, row: usize, couplings: &[(usize, Block)]) -> Result<(), SystemError> {
        self.changed.push(row);
        self.lattice.add_to_row(row, couplings);
        if self.seen == SolverView::Entries {
            for (column, block) in couplings {
                self.matrix.add_blocks(&[row as Index], &[*column as Index], block.as_flattened())?;
            }
        }
        Ok(())
    }

    /// Makes added blocks hold; the work is that of the rows that they are in. **Collective**
    pub fn assemble(&mut self) -> Result<(), SystemError> {
        self.changed.sort_unstable();
        self.changed.dedup();
        self.lattice.assemble(self.changed.drain(..));
        // Of a shell PETSc is told that values have changed. It forgets what else it knew.
        self.matrix.assemble()?;
        Ok(self.matrix.set_positive_definite(true)?)
    }

    /// A copy with places for the couplings of a contact boundary. **Collective**
    fn with_places(&self, neighbours: &ContactNeighbours, session: &Session) -> Result<Self, SystemError> {
        Self::new(self.lattice.with_places(neighbours, session)?, self.seen, session)
    }

    /// With all its rows in a matrix of PETSc's, as factorisations want it; `None` if that is what solvers see. **Collective**
    pub fn expanded(&self, session: &Session) -> Result<Option<Matrix>, SystemError> {
        match self.seen {
            SolverView::Entries => Ok(None),
            SolverView::Action => Ok(Some(self.lattice.expanded(session)?)),
        }
    }
}
