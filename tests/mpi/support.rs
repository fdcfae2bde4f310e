//! Small matrices and problems for the checks.

use mezha::petsc::{Index, Krylov, Matrix, Session, Vector, options};
use std::ops::Range;

/// This rank's range of `total` numbers.
pub fn share(session: &Session, total: usize) -> Range<usize> {
    let [first, end] = [session.rank(), session.rank() + 1].map(|rank| rank * total / session.size());
    first..end
}

/// The vector `0, 1, 2, ...` of length `total`.
pub fn ramp(session: &Session, total: usize) -> Vector {
    let own = share(session, total);
    let mut x = Vector::new(session, own.len()).unwrap();
    x.values_mut().iter_mut().zip(own).for_each(|(value, i)| *value = i as f64);
    x
}

/// The `rows` × `columns` matrix with the given entries (column, value) in each row, from exact counts.
pub fn sparse(session: &Session, rows: usize, columns: usize, entries: impl Fn(usize) -> Vec<(usize, f64)>) -> Matrix {
    let (own_rows, own_columns) = (share(session, rows), share(session, columns));
    let counts = |own: bool| -> Vec<Index> {
        let count = |i| entries(i).iter().filter(|(j, _)| own_columns.contains(j) == own).count() as Index;
        own_rows.clone().map(count).collect()
    };
    let mut a = Matrix::aij(session, own_rows.len(), own_columns.len(), 1, &counts(true), &counts(false)).unwrap();
    for i in own_rows {
        let (columns, values): (Vec<Index>, Vec<f64>) = entries(i).iter().map(|(j, value)| (*j as Index, *value)).unzip();
        a.insert(&[i as Index], &columns, &values).unwrap();
    }
    a.assemble().unwrap();
    a
}

/// The matrix `[-1, 2, -1]` of size `n`, with `more` on its diagonal.
pub fn laplacian(session: &Session, n: usize, more: impl Fn(usize) -> f64) -> Matrix {
    sparse(session, n, n, |i| {
        let neighbours = i.checked_sub(1).into_iter().chain((i + 1 < n).then_some(i + 1));
        neighbours.map(|j| (j, -1.0)).chain([(i, 2.0 + more(i))]).collect()
    })
}

/// Writes zeros in place of the entries of a [`laplacian`].
pub fn clear(a: &mut Matrix) {
    let n = a.size().0;
    for i in a.row_range() {
        let columns: Vec<Index> = (i.saturating_sub(1)..(i + 2).min(n)).map(|j| j as Index).collect();
        a.insert(&[i as Index], &columns, &vec![0.0; columns.len()]).unwrap();
    }
    a.assemble().unwrap();
}

const NODES: usize = 127;
const POINTS: usize = 3;
const GAMMA: f64 = 0.5;

/// A string of nodes held at its quarter points by multipliers: `[K + γ BᵀB, Bᵀ; B, 0]`.
pub struct HeldString<'a> {
    session: &'a Session,
    schur: Matrix,
    nest: Matrix,
}

/// The quarter point that node `i` is, if it is one.
fn quarter(i: usize) -> Option<usize> {
    let quarter = (NODES + 1) / (POINTS + 1);
    (i + 1).is_multiple_of(quarter).then(|| (i + 1) / quarter - 1)
}

impl<'a> HeldString<'a> {
    pub fn new(session: &'a Session) -> Self {
        let n = NODES;
        let k = sparse(session, n, n, |i| {
            let neighbours = i.checked_sub(1).into_iter().chain((i + 1 < n).then_some(i + 1));
            let held = if quarter(i).is_some() { GAMMA } else { 0.0 };
            neighbours.map(|j| (j, -1.0)).chain([(i, 2.0 + held)]).collect()
        });
        let b = sparse(session, POINTS, n, |i| (0..n).filter(|j| quarter(*j) == Some(i)).map(|j| (j, 1.0)).collect());
        let b_transpose = sparse(session, n, POINTS, |j| quarter(j).map(|i| (i, 1.0)).into_iter().collect());
        let zero = sparse(session, POINTS, POINTS, |i| vec![(i, 0.0)]);
        let schur = sparse(session, POINTS, POINTS, |i| vec![(i, -1.0 / GAMMA)]);
        let nest = Matrix::nest(session, [[&k, &b_transpose], [&b, &zero]]).unwrap();
        Self { session, schur, nest }
    }

    /// GMRES with block elimination; a factor on every rank for the nodes, unless the user has chosen otherwise.
    pub fn solver(&self, prefix: &str) -> Krylov {
        let defaults = [
            ("ksp_type", "gmres"),
            ("ksp_pc_side", "right"),
            ("fieldsplit_u_ksp_type", "preonly"),
            ("fieldsplit_u_pc_type", "redundant"),
            ("fieldsplit_lambda_ksp_type", "preonly"),
            ("fieldsplit_lambda_pc_type", "jacobi"),
        ];
        for (name, value) in defaults {
            options::set_default(self.session, &format!("-{prefix}{name}"), value).unwrap();
        }
        let krylov = Krylov::new(self.session, prefix).unwrap();
        krylov.set_operators(&self.nest, &self.nest).unwrap();
        krylov.set_tolerance(1e-10, 60).unwrap();
        let [u, lambda] = self.nest.nest_index_sets().unwrap();
        let preconditioner = krylov.preconditioner();
        preconditioner.field_split_schur(&[("u", &u), ("lambda", &lambda)], &self.schur).unwrap();
        krylov.set_from_options().unwrap();
        krylov.set_up().unwrap();

        let solvers = preconditioner.field_split_solvers().unwrap();
        assert_eq!(solvers.len(), 2);
        krylov
    }

    /// Some solution, and the right-hand side that belongs to it.
    pub fn solution(&self) -> Vector {
        let (mut x, _) = self.nest.create_vectors().unwrap();
        let own = x.range();
        x.values_mut().iter_mut().zip(own).for_each(|(value, i)| *value = (0.1 * i as f64).sin());
        x
    }

    /// What the system makes of [`HeldString::solution`].
    pub fn right_hand_side(&self) -> Vector {
        let (_, mut b) = self.nest.create_vectors().unwrap();
        self.nest.multiply(&self.solution(), &mut b).unwrap();
        b
    }
}
