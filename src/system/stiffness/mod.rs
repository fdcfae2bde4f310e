//! The stiffness of the bodies on each level: assembled rows, and strips that need not be.

mod assembly;
mod elastic;
mod lattice_operator;
mod room;
mod stored_rows;
mod strips;

pub use assembly::Assembly;
pub use elastic::Elastic;
pub use room::ContactNeighbours;

use super::{Space, SystemError};
use crate::petsc::{Matrix, Session};
use lattice_operator::{LatticeOperator, Strips};
use room::contact_room;
use std::rc::Rc;

/// `K`, or `K + Bᵀ D B`, of one level.
pub struct Stiffness {
    /// The rows that are stored: all, or those outside of strips.
    stored: Matrix,
    lattice: Option<Rc<LatticeOperator>>,
    operator: Matrix,
}

impl Stiffness {
    /// From its stored rows, assembled, and the others, if there are any. **Collective**
    fn new(stored: Matrix, strips: Option<&Rc<Strips>>, space: &Space, session: &Session) -> Result<Self, SystemError> {
        let Some(strips) = strips else { return Ok(Self { operator: stored.clone(), stored, lattice: None }) };
        let lattice = Rc::new(LatticeOperator::new(&stored, &space.own, strips, session)?);
        let mut operator = Matrix::operator(session, space.local_unknowns(), Box::new(lattice.clone()))?;
        operator.set_positive_definite(true)?;
        Ok(Self { stored, lattice: Some(lattice), operator })
    }

    /// What solvers see.
    pub fn operator(&self) -> &Matrix {
        &self.operator
    }

    /// Whether some rows are not stored.
    pub fn has_strips(&self) -> bool {
        self.lattice.is_some()
    }

    /// Adds a block to the couplings of two nodes of contact. Holds after [`Stiffness::assemble`].
    pub fn add_block(&mut self, row: usize, column: usize, block: &[f64; 4]) -> Result<(), SystemError> {
        Ok(self.stored.add_blocks(&[row as i32], &[column as i32], block)?)
    }

    /// Brings added blocks to their ranks. **Collective**
    pub fn assemble(&mut self) -> Result<(), SystemError> {
        self.stored.assemble()?;
        if let Some(lattice) = &self.lattice {
            lattice.refresh()?;
            // PETSc is told that values have changed; it forgets what else it knew.
            self.operator.assemble()?;
            self.operator.set_positive_definite(true)?;
        }
        Ok(())
    }

    /// A copy with room for the couplings of a contact boundary. **Collective**
    fn with_room(&self, space: &Space, neighbours: &ContactNeighbours, session: &Session) -> Result<Self, SystemError> {
        let mut stored = self.stored.sum(&contact_room(space, neighbours, session)?)?;
        stored.set_positive_definite(true)?;
        Self::new(stored, self.lattice.as_ref().map(|lattice| lattice.strips()), space, session)
    }

    /// With all its rows stored, as factorisations want it; `None` if they are. **Collective**
    pub fn expanded(&self, session: &Session) -> Result<Option<Matrix>, SystemError> {
        let Some(lattice) = &self.lattice else { return Ok(None) };
        let range = self.stored.row_range();
        let first = range.start / 2;
        let (mut near, mut far) = (vec![0; range.len() / 2], vec![0; range.len() / 2]);
        for node in lattice.stored_nodes().into_iter().map(|node| node as usize) {
            self.stored.row(2 * (first + node), |columns, _| {
                let own = columns.iter().filter(|&&column| range.contains(&(column as usize))).count();
                (near[node], far[node]) = (own as i32 / 2, (columns.len() - own) as i32 / 2);
            })?;
        }
        lattice.each_row(|node, couplings| near[node] = couplings.len() as i32);
        let mut matrix = Matrix::aij(session, range.len(), range.len(), 2, &near, &far)?;
        for row in lattice.stored_nodes().into_iter().flat_map(|node| [0, 1].map(|a| range.start + 2 * node as usize + a)) {
            let mut inserted = Ok(());
            self.stored.row(row, |columns, values| inserted = matrix.insert(&[row as i32], columns, values))?;
            inserted?;
        }
        let mut inserted = Ok(());
        lattice.each_row(|node, couplings| {
            let row = (range.start + 2 * node) as i32;
            for &(distance, block) in couplings {
                let column = (range.start + 2 * node.wrapping_add_signed(distance)) as i32;
                let outcome = matrix.insert(&[row, row + 1], &[column, column + 1], block.as_flattened());
                inserted = inserted.clone().and(outcome);
            }
        });
        inserted?;
        matrix.assemble()?;
        matrix.set_positive_definite(true)?;
        Ok(Some(matrix))
    }
}
