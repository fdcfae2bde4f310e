//! Sparse symmetric matrices of 3x3 blocks, a row for each piece: their factor, and what it says of a few rows.

use nalgebra::{Cholesky, Const, DMatrix, DVector, Matrix3, SymmetricEigen, Vector3};
use std::cell::OnceCell;
use std::collections::{BTreeMap, BTreeSet};

/// Steps of the inverse iteration at most.
const MOST_STEPS: usize = 60;

/// Change of a unit vector at which the iteration stands.
const STANDS: f64 = 1e-9;

/// Blocks by row and column, of both halves.
pub type Blocks = BTreeMap<(usize, usize), Matrix3<f64>>;

/// Adds other blocks, times a factor.
pub fn add(sum: &mut Blocks, more: &Blocks, factor: f64) {
    more.iter().for_each(|(&at, block)| *sum.entry(at).or_default() += factor * block);
}

/// The order that eliminates the row with the fewest neighbours next, of those that are left: it makes few blocks where each row
/// has few, as in the plane.
pub fn least_degrees(count: usize, coupled: impl Iterator<Item = (usize, usize)>) -> Vec<usize> {
    let mut neighbours = vec![BTreeSet::new(); count];
    for (a, b) in coupled.filter(|(a, b)| a != b) {
        neighbours[a].insert(b);
        neighbours[b].insert(a);
    }
    let mut left: BTreeSet<(usize, usize)> = (0..count).map(|row| (neighbours[row].len(), row)).collect();
    let mut order = Vec::with_capacity(count);
    while let Some((_, row)) = left.pop_first() {
        order.push(row);
        let around = std::mem::take(&mut neighbours[row]);
        for &other in &around {
            left.remove(&(neighbours[other].len(), other));
            neighbours[other].remove(&row);
            neighbours[other].extend(around.iter().filter(|&&third| third != other));
            left.insert((neighbours[other].len(), other));
        }
    }
    order
}

/// Blocks of a column, by their places.
type PlacedBlocks = Vec<(usize, Matrix3<f64>)>;

/// `A = L D Lᵀ` in the order of elimination.
pub struct BlockFactor {
    /// Where each row stands in the order.
    place: Vec<usize>,
    /// Blocks of L below each place, by ascending places.
    columns: Vec<PlacedBlocks>,
    /// Blocks of D, and their factors.
    pivots: Vec<(Matrix3<f64>, Cholesky<f64, Const<3>>)>,
    /// Columns of `D^(-1/2) L⁻¹` by rows, as soon as somebody has asked for them: each is that of many contacts.
    halves: Vec<OnceCell<PlacedBlocks>>,
}

impl BlockFactor {
    /// Of a matrix with a `shift` of the diagonal of each row; nothing if that is not positive definite.
    pub fn new(blocks: &Blocks, order: &[usize], shift: impl Fn(usize) -> f64) -> Option<Self> {
        let mut place = vec![0; order.len()];
        order.iter().enumerate().for_each(|(at, &row)| place[row] = at);
        let mut rest: Vec<BTreeMap<usize, Matrix3<f64>>> =
            order.iter().enumerate().map(|(at, &row)| BTreeMap::from([(at, shift(row) * Matrix3::identity())])).collect();
        for (&(row, column), block) in blocks.iter().filter(|((row, column), _)| place[*row] >= place[*column]) {
            *rest[place[column]].entry(place[row]).or_default() += block;
        }
        let (mut columns, mut pivots) = (Vec::with_capacity(order.len()), Vec::with_capacity(order.len()));
        for at in 0..order.len() {
            let mut below = std::mem::take(&mut rest[at]);
            let pivot = below.remove(&at)?;
            let factor = Cholesky::new(pivot)?;
            let column: PlacedBlocks =
                below.iter().map(|(&row, block)| (row, factor.solve(&block.transpose()).transpose())).collect();
            for (k, (&other, block)) in below.iter().enumerate() {
                for (row, factor_block) in &column[k..] {
                    *rest[other].entry(*row).or_default() -= factor_block * block.transpose();
                }
            }
            columns.push(column);
            pivots.push((pivot, factor));
        }
        let halves = vec![OnceCell::new(); order.len()];
        Some(Self { place, columns, pivots, halves })
    }

    /// Number of unknowns.
    pub fn count(&self) -> usize {
        3 * self.place.len()
    }

    /// `A⁻¹ b`
    pub fn solve(&self, b: &DVector<f64>) -> DVector<f64> {
        let mut values = vec![Vector3::zeros(); self.place.len()];
        self.place.iter().enumerate().for_each(|(row, &at)| values[at] = b.fixed_rows::<3>(3 * row).into_owned());
        for (at, column) in self.columns.iter().enumerate() {
            let value = values[at];
            column.iter().for_each(|(below, block)| values[*below] -= block * value);
        }
        values.iter_mut().zip(&self.pivots).for_each(|(value, (_, factor))| *value = factor.solve(value));
        self.backwards(values)
    }

    /// `L⁻ᵀ` of values by places, by rows.
    fn backwards(&self, mut values: Vec<Vector3<f64>>) -> DVector<f64> {
        for (at, column) in self.columns.iter().enumerate().rev() {
            let above: Vector3<f64> = column.iter().map(|(below, block)| block.tr_mul(&values[*below])).sum();
            values[at] -= above;
        }
        DVector::from_iterator(self.count(), self.place.iter().flat_map(|&at| values[at].data.0[0]))
    }

    /// The unit vector that the matrix makes smallest. It begins with that of the smallest pivot: of several that vanish the first,
    /// and of what was eliminated before.
    pub fn softest(&self) -> DVector<f64> {
        let eigen: Vec<_> = self.pivots.iter().map(|(pivot, _)| SymmetricEigen::new(*pivot)).collect();
        let least = eigen.iter().map(|block| block.eigenvalues.min()).fold(f64::INFINITY, f64::min);
        let at = eigen.iter().position(|block| block.eigenvalues.min() <= 2.0 * least).unwrap_or(0);
        let mut values = vec![Vector3::zeros(); self.place.len()];
        values[at] = eigen[at].eigenvectors.column(eigen[at].eigenvalues.imin()).into_owned();
        let mut softest = self.backwards(values).normalize();
        for _ in 0..MOST_STEPS {
            let next = self.solve(&softest).normalize();
            let change = (&next - &softest).norm();
            softest = next;
            if change < STANDS {
                break;
            }
        }
        softest
    }

    /// The rows of `A⁻¹` and their columns: `Wᵀ D⁻¹ W` with the columns of `W = L⁻¹`, which are nothing but on the way from the row
    /// to the last one, from each to the first block below it.
    pub fn compliance(&self, rows: &[usize]) -> DMatrix<f64> {
        let halves: Vec<_> = rows.iter().map(|&row| self.halves[row].get_or_init(|| self.half(row))).collect();
        let mut all = DMatrix::zeros(3 * rows.len(), 3 * rows.len());
        for (i, left) in halves.iter().enumerate() {
            for (j, right) in halves[..=i].iter().enumerate() {
                let mut sum = Matrix3::zeros();
                let mut column = left.iter().peekable();
                for (at, block) in right.iter() {
                    while column.next_if(|(other, _)| other < at).is_some() {}
                    if let Some((_, other)) = column.next_if(|(other, _)| other == at) {
                        sum += other.tr_mul(block);
                    }
                }
                all.fixed_view_mut::<3, 3>(3 * i, 3 * j).copy_from(&sum);
                all.fixed_view_mut::<3, 3>(3 * j, 3 * i).copy_from(&sum.transpose());
            }
        }
        all
    }

    /// Blocks of `D^(-1/2) L⁻¹` in the column of a row, by places.
    fn half(&self, row: usize) -> PlacedBlocks {
        let (mut values, mut half) = (vec![Matrix3::zeros(); self.place.len()], Vec::new());
        values[self.place[row]] = Matrix3::identity();
        let mut next = Some(self.place[row]);
        while let Some(at) = next {
            let value = values[at];
            self.columns[at].iter().for_each(|(below, block)| values[*below] -= block * value);
            half.push((at, self.pivots[at].1.l_dirty().solve_lower_triangular_unchecked(&value)));
            next = self.columns[at].first().map(|(below, _)| *below);
        }
        half
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rows in a grid, each coupled with its neighbours, in the order of elimination.
    fn grid(side: usize) -> (Blocks, Vec<usize>) {
        let mut blocks = Blocks::new();
        let spring = |k: usize| Matrix3::from_fn(|i, j| if i == j { 1.0 } else { 0.1 * ((k + i * j) % 3) as f64 });
        for row in 0..side * side {
            let right = (row % side + 1 < side).then_some(row + 1);
            for other in right.into_iter().chain((row + side < side * side).then_some(row + side)) {
                let own = spring(row + other) * spring(row + other).transpose();
                for (at, sign) in [((row, row), 1.0), ((other, other), 1.0), ((row, other), -1.0), ((other, row), -1.0)] {
                    *blocks.entry(at).or_default() += sign * own;
                }
            }
        }
        *blocks.entry((3, 3)).or_default() += Matrix3::identity();
        let order = least_degrees(side * side, blocks.keys().copied());
        (blocks, order)
    }

    fn dense(blocks: &Blocks, count: usize) -> DMatrix<f64> {
        let mut all = DMatrix::zeros(3 * count, 3 * count);
        blocks.iter().for_each(|(&(i, j), block)| all.fixed_view_mut::<3, 3>(3 * i, 3 * j).copy_from(block));
        all
    }

    #[test]
    fn it_solves_like_a_dense_one_and_finds_the_softest_vector() {
        let (blocks, order) = grid(5);
        let (all, factor) = (dense(&blocks, 25), BlockFactor::new(&blocks, &order, |_| 0.0).expect("it is positive"));
        let b = DVector::from_fn(75, |i, _| (i as f64).sin());
        assert!((&all * factor.solve(&b) - &b).norm() < 1e-10);
        let eigen = SymmetricEigen::new(all.clone());
        let exact = eigen.eigenvectors.column(eigen.eigenvalues.imin());
        assert!((factor.softest().dot(&exact).abs() - 1.0).abs() < 1e-9);
        let inverse = all.try_inverse().expect("it is positive");
        let rows = [2, 7, 24];
        let wanted = DMatrix::from_fn(9, 9, |i, j| inverse[(3 * rows[i / 3] + i % 3, 3 * rows[j / 3] + j % 3)]);
        assert!((factor.compliance(&rows) - wanted).amax() < 1e-10);
        assert!(BlockFactor::new(&blocks, &order, |_| -1.1 * eigen.eigenvalues.min()).is_none(), "not positive");
    }

    #[test]
    fn few_blocks_are_made() {
        let (blocks, order) = grid(30);
        let factor = BlockFactor::new(&blocks, &order, |_| 0.0).expect("it is positive");
        let count: usize = factor.columns.iter().map(Vec::len).sum();
        assert!(count < 900 * 15, "{count} blocks");
    }
}
