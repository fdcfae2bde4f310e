//! The rows of a stiffness that are stored, as blocks of two by two.

use super::lanes::Lanes;
use super::precision::Precision;
use super::strips::inverse;
use crate::element::Block;
use crate::petsc::{Matrix, Result};
use crate::system::space::Real;
use std::ops::Range;

/// Rows of some nodes of this rank. Columns count the nodes of this rank from 0; those of others have places in a list of
/// their own.
#[derive(Default)]
pub struct StoredRows<T = f64> {
    nodes: Vec<u32>,
    /// Inverses of the diagonal blocks.
    inverses: Vec<[[T; 2]; 2]>,
    near: Part<T>,
    far: Part<T>,
}

/// One part of all rows: that of row `k` lies in `starts[k]..starts[k + 1]`.
struct Part<T> {
    starts: Vec<u32>,
    columns: Vec<u32>,
    blocks: Vec<[[T; 2]; 2]>,
}

impl<T> Default for Part<T> {
    fn default() -> Self {
        Self { starts: vec![0], columns: Vec::new(), blocks: Vec::new() }
    }
}

impl<T: Real> Part<T> {
    /// `sum - Σ K x` of a row. A block fills a register, whose four products come together at the end.
    #[inline(always)]
    fn subtract<L: Lanes<Real = T, Nodes = [[T; 2]; 2]>>(&self, lanes: L, k: usize, sum: [T; 2], x: &[[T; 2]]) -> [T; 2] {
        let range = self.starts[k] as usize..self.starts[k + 1] as usize;
        let (columns, blocks) = (self.columns[range.clone()].as_chunks::<2>(), self.blocks[range].as_chunks::<2>());
        let zero = lanes.load([[T::default(); 2]; 2]);
        let node = |column: u32| lanes.load([x[column as usize]; 2]);
        let (mut one, mut other) = (zero, zero);
        for (columns, blocks) in columns.0.iter().zip(blocks.0) {
            one = lanes.multiply_add(lanes.load(blocks[0]), node(columns[0]), one);
            other = lanes.multiply_add(lanes.load(blocks[1]), node(columns[1]), other);
        }
        if let ([column], [block]) = (columns.1, blocks.1) {
            one = lanes.multiply_add(lanes.load(*block), node(*column), one);
        }
        let [[a, b], [c, d]] = lanes.store(lanes.add(one, other));
        [sum[0] - (a + b), sum[1] - (c + d)]
    }

    fn push(&mut self, column: usize, block: [[T; 2]; 2]) {
        self.columns.push(column as u32);
        self.blocks.push(block);
    }

    /// Columns and blocks of row `k`.
    fn row(&self, k: usize) -> impl Iterator<Item = (usize, [[T; 2]; 2])> {
        let range = self.starts[k] as usize..self.starts[k + 1] as usize;
        self.columns[range.clone()].iter().map(|&column| column as usize).zip(self.blocks[range].iter().copied())
    }

    fn end_row(&mut self) {
        self.starts.push(self.columns.len() as u32);
    }
}

/// Columns of other ranks in the rows of `nodes`, ascending.
pub fn far_columns(matrix: &Matrix, own: &Range<usize>, nodes: &[u32]) -> Result<Vec<usize>> {
    let mut found = Vec::new();
    for &node in nodes {
        matrix.row(2 * (own.start + node as usize), |columns, _| {
            found.extend(columns.iter().step_by(2).map(|&c| c as usize / 2).filter(|column| !own.contains(column)));
        })?;
    }
    found.sort_unstable();
    found.dedup();
    Ok(found)
}

/// Blocks of a node's two rows, with their column nodes.
fn blocks_of(matrix: &Matrix, node: usize) -> Result<Vec<(usize, Block)>> {
    let mut blocks: Vec<(usize, Block)> = Vec::new();
    matrix.row(2 * node, |columns, values| {
        let columns = columns.iter().step_by(2).map(|&c| c as usize / 2);
        blocks.extend(columns.zip(values.as_chunks().0).map(|(column, &upper)| (column, [upper, [0.0; 2]])));
    })?;
    matrix.row(2 * node + 1, |_, values| {
        blocks.iter_mut().zip(values.as_chunks().0).for_each(|((_, block), &lower)| block[1] = lower);
    })?;
    Ok(blocks)
}

impl StoredRows {
    /// Reads the rows of `nodes`, which hold whole blocks, from an assembled matrix; `far` are the columns of other ranks.
    ///
    /// # Panics
    /// If a diagonal block has no inverse: a stiffness has one.
    pub fn read(matrix: &Matrix, own: &Range<usize>, nodes: &[u32], far: &[usize]) -> Result<Self> {
        let mut rows = Self { nodes: nodes.to_vec(), ..Self::default() };
        for &node in nodes {
            let row = own.start + node as usize;
            for (column, block) in blocks_of(matrix, row)? {
                if column == row {
                    rows.inverses.push(inverse(&block).expect("a stiffness has a diagonal"));
                }
                match own.contains(&column) {
                    true => rows.near.push(column - own.start, block),
                    false => rows.far.push(far.binary_search(&column).expect("a known column"), block),
                }
            }
            rows.near.end_row();
            rows.far.end_row();
        }
        Ok(rows)
    }

    /// Reads the row of one node again, after its values have changed; nothing happens if it is not among these.
    ///
    /// # Panics
    /// As [`StoredRows::read`].
    pub fn read_again(&mut self, matrix: &Matrix, own: &Range<usize>, row: usize, far: &[usize]) -> Result<()> {
        let Ok(k) = self.nodes.binary_search(&((row - own.start) as u32)) else { return Ok(()) };
        let [mut near, mut other] = [&self.near, &self.far].map(|part| part.starts[k] as usize);
        for (column, block) in blocks_of(matrix, row)? {
            if column == row {
                self.inverses[k] = inverse(&block).expect("a stiffness has a diagonal");
            }
            let (part, at, place) = match own.contains(&column) {
                true => (&mut self.near, &mut near, column - own.start),
                false => (&mut self.far, &mut other, far.binary_search(&column).expect("a known column")),
            };
            assert_eq!(part.columns[*at] as usize, place, "the pattern of a stiffness stays");
            part.blocks[*at] = block;
            *at += 1;
        }
        Ok(())
    }

    /// From the rows of all nodes, in any order: for each its node, how many columns, and these; and all blocks. All columns are
    /// near.
    ///
    /// # Panics
    /// As [`StoredRows::read`].
    pub fn of_all(numbers: &[u32], values: &[f64]) -> Self {
        let blocks: &[[[f64; 2]; 2]] = values.as_chunks::<2>().0.as_chunks().0;
        let (mut rows, mut at, mut start) = (Vec::new(), 0, 0);
        while at < numbers.len() {
            let count = numbers[at + 1] as usize;
            rows.push((numbers[at], at + 2..at + 2 + count, start));
            (at, start) = (at + 2 + count, start + count);
        }
        rows.sort_unstable_by_key(|row| row.0);
        let mut all = Self::default();
        for (node, columns, start) in rows {
            for (k, &column) in numbers[columns].iter().enumerate() {
                if column == node {
                    all.inverses.push(inverse(&blocks[start + k]).expect("a stiffness has a diagonal"));
                }
                all.near.push(column as usize, blocks[start + k]);
            }
            all.nodes.push(node);
            all.near.end_row();
            all.far.end_row();
        }
        all
    }

    /// Shows each row: its node, and its near and far columns with their blocks.
    pub fn each_row(
        &self,
        mut show: impl FnMut(usize, &mut dyn Iterator<Item = (usize, Block)>, &mut dyn Iterator<Item = (usize, Block)>),
    ) {
        for (k, &node) in self.nodes.iter().enumerate() {
            show(node as usize, &mut self.near.row(k), &mut self.far.row(k));
        }
    }

    /// The rows of single unknowns, if these are those of all nodes: columns and values.
    pub fn scalar_rows(&self) -> Vec<(Vec<i32>, Vec<f64>)> {
        let mut rows = Vec::with_capacity(2 * self.nodes.len());
        self.each_row(|_, near, _| {
            let row: Vec<(usize, Block)> = near.collect();
            for a in 0..2 {
                let columns = row.iter().flat_map(|(column, _)| [2 * *column as i32, 2 * *column as i32 + 1]).collect();
                rows.push((columns, row.iter().flat_map(|(_, block)| block[a]).collect()));
            }
        });
        rows
    }

    /// The same in another precision.
    pub fn converted<U: Real>(&self) -> StoredRows<U> {
        let blocks = |blocks: &[Block]| blocks.iter().map(|block| block.map(|row| row.map(U::of))).collect();
        let part = |part: &Part<f64>| Part {
            starts: part.starts.clone(),
            columns: part.columns.clone(),
            blocks: blocks(&part.blocks),
        };
        StoredRows {
            nodes: self.nodes.clone(),
            inverses: blocks(&self.inverses),
            near: part(&self.near),
            far: part(&self.far),
        }
    }

    /// Blocks in all rows.
    pub fn block_count(&self) -> usize {
        self.near.blocks.len() + self.far.blocks.len()
    }

}

/// Work on the rows of a range.
enum Task<'a, T> {
    Multiply { y: &'a mut [[T; 2]], x: &'a [[T; 2]] },
    Residual { r: &'a mut [[T; 2]], b: &'a [[T; 2]], x: &'a [[T; 2]] },
    Forward { b: &'a [[T; 2]], x: &'a mut [[T; 2]] },
    Backward { b: &'a [[T; 2]], x: &'a mut [[T; 2]] },
}

/// A task with what it works on; `far` are the values of columns of other ranks, none stands for zeros.
pub struct OnRows<'a, T> {
    rows: &'a StoredRows<T>,
    range: Range<usize>,
    far: &'a [[T; 2]],
    task: Task<'a, T>,
}

impl<T: Real> OnRows<'_, T> {
    /// Does it.
    #[inline(always)]
    pub fn work<L: Lanes<Real = T, Nodes = [[T; 2]; 2]>>(self, lanes: L) {
        let Self { rows, range, far, task } = self;
        match task {
            Task::Multiply { y, x } => {
                for k in range {
                    let sum = rows.subtract(lanes, k, [T::default(); 2], x, far);
                    y[rows.nodes[k] as usize] = [-sum[0], -sum[1]];
                }
            }
            Task::Residual { r, b, x } => {
                for k in range {
                    let node = rows.nodes[k] as usize;
                    r[node] = rows.subtract(lanes, k, b[node], x, far);
                }
            }
            Task::Forward { b, x } => {
                for k in range {
                    rows.relax(lanes, k, b, x, far);
                }
            }
            Task::Backward { b, x } => {
                for k in range.rev() {
                    rows.relax(lanes, k, b, x, far);
                }
            }
        }
    }
}

impl<T: Precision> StoredRows<T> {
    /// `y = K x` in the rows of a range; `far` are the values of columns of other ranks.
    pub fn multiply(&self, range: Range<usize>, x: &[[T; 2]], far: &[[T; 2]], y: &mut [[T; 2]]) {
        T::on_rows(OnRows { rows: self, range, far, task: Task::Multiply { y, x } });
    }

    /// `r = b - K x` in the rows of a range.
    pub fn residual(&self, range: Range<usize>, b: &[[T; 2]], x: &[[T; 2]], far: &[[T; 2]], r: &mut [[T; 2]]) {
        T::on_rows(OnRows { rows: self, range, far, task: Task::Residual { r, b, x } });
    }

    /// Relaxes the nodes of a range in their order, `far` staying as it is; no `far` stands for zeros.
    pub fn forward(&self, range: Range<usize>, b: &[[T; 2]], x: &mut [[T; 2]], far: &[[T; 2]]) {
        T::on_rows(OnRows { rows: self, range, far, task: Task::Forward { b, x } });
    }

    /// The same in the opposite order.
    pub fn backward(&self, range: Range<usize>, b: &[[T; 2]], x: &mut [[T; 2]], far: &[[T; 2]]) {
        T::on_rows(OnRows { rows: self, range, far, task: Task::Backward { b, x } });
    }
}

impl<T: Real> StoredRows<T> {
    /// The nodes whose rows these are.
    pub fn nodes(&self) -> &[u32] {
        &self.nodes
    }

    #[inline(always)]
    fn subtract<L: Lanes<Real = T, Nodes = [[T; 2]; 2]>>(
        &self,
        lanes: L,
        k: usize,
        sum: [T; 2],
        x: &[[T; 2]],
        far: &[[T; 2]],
    ) -> [T; 2] {
        let sum = self.near.subtract(lanes, k, sum, x);
        if far.is_empty() { sum } else { self.far.subtract(lanes, k, sum, far) }
    }

    #[inline(always)]
    fn relax<L: Lanes<Real = T, Nodes = [[T; 2]; 2]>>(
        &self,
        lanes: L,
        k: usize,
        b: &[[T; 2]],
        x: &mut [[T; 2]],
        far: &[[T; 2]],
    ) {
        let node = self.nodes[k] as usize;
        let sum = self.subtract(lanes, k, b[node], x, far);
        let ([u, v], inverse) = (x[node], &self.inverses[k]);
        x[node] = [u + (inverse[0][0] * sum[0] + inverse[0][1] * sum[1]), v + (inverse[1][0] * sum[0] + inverse[1][1] * sum[1])];
    }
}
