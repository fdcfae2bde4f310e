//! All rows made into a matrix of PETSc's, as factorisations want it.

use super::lattice_operator::LatticeOperator;
use super::stored_rows::StoredRows;
use crate::element::Block;
use crate::petsc::{Index, Matrix, Result, Session};

impl LatticeOperator {
    /// The same with all rows stored. **Collective**
    pub fn expanded(&self, session: &Session) -> Result<Matrix> {
        let rows = self.rows.borrow();
        let (mut near, mut far) = (vec![0; self.own.len()], vec![0; self.own.len()]);
        for (k, &node) in rows.nodes.iter().enumerate().filter(|(k, _)| rows.is_stored(*k)) {
            (near[node as usize], far[node as usize]) = (rows.near.row(k).len() as Index, rows.far.row(k).len() as Index);
        }
        self.each_row(|node, couplings| {
            let here = couplings.iter().filter(|(column, _)| self.own.contains(column)).count();
            near[node] += here as Index;
            far[node] += (couplings.len() - here) as Index;
        });
        let unknowns = 2 * self.own.len();
        let mut matrix = Matrix::aij(session, unknowns, unknowns, 2, &near, &far)?;
        let mut row = BlockRow::default();
        (0..rows.nodes.len())
            .filter(|&k| rows.is_stored(k))
            .try_for_each(|k| self.insert_stored(&rows, k, &mut row, &mut matrix))?;
        let mut inserted = Ok(());
        self.each_row(|node, couplings| {
            inserted = inserted.clone().and(row.insert(&mut matrix, self.own.start + node, couplings.iter().copied()));
        });
        inserted?;
        matrix.assemble()?;
        matrix.set_positive_definite(true)?;
        Ok(matrix)
    }

    /// Brings some of the stored rows to an expanded matrix, as they are now. They hold after [`Matrix::assemble`].
    pub fn renew(&self, changed: impl Iterator<Item = u32>, matrix: &mut Matrix) -> Result<()> {
        let (rows, mut row) = (self.rows.borrow(), BlockRow::default());
        changed.map(|k| k as usize).try_for_each(|k| self.insert_stored(&rows, k, &mut row, matrix))
    }

    fn insert_stored(&self, rows: &StoredRows, k: usize, row: &mut BlockRow, matrix: &mut Matrix) -> Result<()> {
        let here = rows.near.couplings(k).map(|(column, block)| (self.own.start + column as usize, *block));
        let there = rows.far.couplings(k).map(|(column, block)| (self.far[column as usize], *block));
        row.insert(matrix, self.own.start + rows.nodes[k] as usize, here.chain(there))
    }
}

/// One row of blocks on its way to a matrix.
#[derive(Default)]
struct BlockRow {
    columns: Vec<Index>,
    blocks: Vec<Block>,
    values: Vec<f64>,
}

impl BlockRow {
    fn insert(&mut self, matrix: &mut Matrix, row: usize, couplings: impl Iterator<Item = (usize, Block)>) -> Result<()> {
        self.columns.clear();
        self.blocks.clear();
        couplings.for_each(|(column, block)| {
            self.columns.push(column as Index);
            self.blocks.push(block);
        });
        self.values.clear();
        (0..2).for_each(|a| self.values.extend(self.blocks.iter().flat_map(|block| block[a])));
        matrix.insert_blocks(&[row as Index], &self.columns, &self.values)
    }
}
