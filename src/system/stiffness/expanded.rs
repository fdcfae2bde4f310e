//! Strips made into stored rows, as factorisations want them.

use super::lattice_operator::LatticeOperator;
use crate::petsc::{Matrix, Result, Session};

impl LatticeOperator {
    /// The same with all rows stored. **Collective**
    pub fn expanded(&self, session: &Session) -> Result<Matrix> {
        let stored = self.stored();
        let range = stored.row_range();
        let first = range.start / 2;
        let (mut near, mut far) = (vec![0; range.len() / 2], vec![0; range.len() / 2]);
        for node in self.stored_nodes().into_iter().map(|node| node as usize) {
            stored.row(2 * (first + node), |columns, _| {
                let own = columns.iter().filter(|&&column| range.contains(&(column as usize))).count();
                (near[node], far[node]) = (own as i32 / 2, (columns.len() - own) as i32 / 2);
            })?;
        }
        self.each_row(|node, couplings| near[node] = couplings.len() as i32);
        let mut matrix = Matrix::aij(session, range.len(), range.len(), 2, &near, &far)?;
        for row in self.stored_nodes().into_iter().flat_map(|node| [0, 1].map(|a| range.start + 2 * node as usize + a)) {
            let mut inserted = Ok(());
            stored.row(row, |columns, values| inserted = matrix.insert(&[row as i32], columns, values))?;
            inserted?;
        }
        let mut inserted = Ok(());
        self.each_row(|node, couplings| {
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
        Ok(matrix)
    }
}
