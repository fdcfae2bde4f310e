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
pub use lattice_operator::LatticeOperator;
pub use stored_rows::{BlockPlace, StoredRows};
pub use strip_kernel::SweepHalves;

use super::SystemError;
use crate::element::Block;
use crate::petsc::{Matrix, Session};
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

/// Nodes that contact couples to each node.
pub type ContactNeighbours = BTreeMap<usize, BTreeSet<usize>>;

/// Where some couplings of a stored row lie.
#[derive(Clone, Copy)]
pub struct RowPlaces<'a> {
    /// The row.
    pub stored: u32,
    /// The place of its diagonal block, if that is to be inverted again.
    pub diagonal: Option<BlockPlace>,
    /// The places of the couplings.
    pub blocks: &'a [BlockPlace],
}

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
    /// Stored rows that have been added to since the matrix had its entries, each perhaps several times.
    changed: Vec<u32>,
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

    /// Adds blocks to the couplings of a node of contact, one of this rank's. Holds after [`Stiffness::assemble`].
    pub fn add_to_row(&mut self, places: RowPlaces, blocks: &[Block]) {
        self.lattice.add_to_row(places, blocks);
        if self.seen == SolverView::Entries {
            self.changed.push(places.stored);
        }
    }

    /// Makes added blocks hold. **Collective**
    pub fn assemble(&mut self) -> Result<(), SystemError> {
        self.changed.sort_unstable();
        self.changed.dedup();
        self.lattice.renew(self.changed.drain(..), &mut self.matrix)?;
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
