//! A factor of a small symmetric matrix, on the one rank that has all of it.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::ldlt::factor::{LdltError, LdltRegularization};
use faer::sparse::linalg::cholesky::{LdltRef, SymbolicCholesky, factorize_symbolic_cholesky};
use faer::sparse::{SparseColMat, Triplet};
use faer::{ColMut, Conj, Par, Side};

/// `L D Lᵀ`. Pivots may have either sign: functions of a coarse level that are nearly alike on the mesh leave pivots of the
/// size of rounding, which would end a Cholesky factor.
pub struct SparseFactor {
    symbolic: SymbolicCholesky<u32>,
    values: Vec<f64>,
    memory: MemBuffer,
}

impl SparseFactor {
    /// Of a square matrix of so many rows, by its entries on and below the diagonal.
    ///
    /// # Errors
    /// If a pivot is zero: the matrix is singular.
    pub fn new(count: usize, lower: &[Triplet<u32, u32, f64>]) -> Result<Self, LdltError> {
        let matrix = SparseColMat::try_new_from_triplets(count, count, lower).expect("entries of a square matrix");
        let symbolic = factorize_symbolic_cholesky(matrix.symbolic(), Side::Lower, Default::default(), Default::default());
        let symbolic = symbolic.expect("memory for a small matrix");
        let mut values = vec![0.0; symbolic.len_val()];
        let working = symbolic.factorize_numeric_ldlt_scratch::<f64>(Par::Seq, Default::default());
        let mut memory = MemBuffer::new(working.or(symbolic.solve_in_place_scratch::<f64>(1, Par::Seq)));
        symbolic.factorize_numeric_ldlt(
            &mut values,
            matrix.as_ref(),
            Side::Lower,
            LdltRegularization::default(),
            Par::Seq,
            MemStack::new(&mut memory),
            Default::default(),
        )?;
        Ok(Self { symbolic, values, memory })
    }

    /// Replaces a right-hand side by the solution.
    pub fn solve(&mut self, b: &mut [f64]) {
        let factor = LdltRef::new(&self.symbolic, &self.values);
        let b = ColMut::from_slice_mut(b).as_mat_mut();
        factor.solve_in_place_with_conj(Conj::No, b, Par::Seq, MemStack::new(&mut self.memory));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The second differences of a line of points, the first of which is held; or none.
    fn line(count: u32, is_held: bool) -> Vec<Triplet<u32, u32, f64>> {
        let diagonal = (0..count).map(|k| {
            let ends = u32::from(k > 0 || is_held) + u32::from(k + 1 < count);
            Triplet::new(k, k, f64::from(ends))
        });
        diagonal.chain((1..count).map(|k| Triplet::new(k, k - 1, -1.0))).collect()
    }

    #[test]
    fn a_solution_is_found_from_the_entries_below_the_diagonal() {
        for count in [1, 2, 50, 900] {
            let mut factor = SparseFactor::new(count as usize, &line(count, true)).expect("a held line");
            for turn in 0..2 {
                // A force of one at the far end pulls all points by their distance from the held one.
                let mut b = vec![0.0; count as usize];
                b[count as usize - 1] = f64::from(turn + 1);
                factor.solve(&mut b);
                let worst = (1..).zip(&b).map(|(k, x)| (x - f64::from(k * (turn + 1))).abs()).fold(0.0, f64::max);
                assert!(worst < 1e-9 * f64::from(count), "{count}: {worst}");
            }
        }
    }

    #[test]
    fn a_singular_matrix_has_no_factor() {
        assert!(SparseFactor::new(3, &[Triplet::new(0, 0, 1.0), Triplet::new(1, 1, 0.0), Triplet::new(2, 2, 1.0)]).is_err());
        assert!(SparseFactor::new(2, &line(2, false)).is_err());
    }

    #[test]
    fn a_pivot_of_the_size_of_rounding_may_be_negative() {
        let entries = [Triplet::new(0, 0, 1.0), Triplet::new(1, 0, 1.0), Triplet::new(1, 1, 1.0 - 1e-15)];
        let mut factor = SparseFactor::new(2, &entries).expect("a pivot of -1e-15");
        let mut b = [1.0, 1.0];
        factor.solve(&mut b);
        assert!((b[0] + b[1] - 1.0).abs() < 1e-12, "{b:?}");
    }
}
