//! Small matrices and problems for the checks.

use mezha::petsc::{Index, Krylov, Matrix, MultigridLevel, Session, Vector, options};
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
        a.add(&[i as Index], &columns, &values).unwrap();
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

const LEVELS: u32 = 5;
const POINTS: usize = 3;
const GAMMA: f64 = 0.5;

/// A string of nodes held at its quarter points by multipliers: `[K + γ BᵀB, Bᵀ; B, 0]`, with levels below it.
pub struct HeldString<'a> {
    session: &'a Session,
    levels: Vec<Matrix>,
    interpolations: Vec<Matrix>,
    schur: Matrix,
    nest: Matrix,
}

/// Nodes of level `l`, the coarsest being 0.
fn nodes(l: u32) -> usize {
    (1 << (l + 3)) - 1
}

/// The quarter point that node `i` of level `l` is, if it is one.
fn quarter(l: u32, i: usize) -> Option<usize> {
    let quarter = 1 << (l + 1);
    (i + 1).is_multiple_of(quarter).then(|| (i + 1) / quarter - 1)
}

impl<'a> HeldString<'a> {
    pub fn new(session: &'a Session) -> Self {
        // Entries 2^l / 2^finest on level l: 1 / h on nested meshes, relative to the finest.
        let level = |l: u32| {
            let scale = 0.5_f64.powi((LEVELS - 1 - l) as i32);
            let n = nodes(l);
            sparse(session, n, n, |i| {
                let neighbours = i.checked_sub(1).into_iter().chain((i + 1 < n).then_some(i + 1));
                let held = if quarter(l, i).is_some() { GAMMA } else { 0.0 };
                neighbours.map(|j| (j, -scale)).chain([(i, 2.0 * scale + held)]).collect()
            })
        };
        let levels: Vec<Matrix> = (0..LEVELS).map(level).collect();
        // Coarse node j is fine node 2 j + 1; those between take the mean of their two neighbours.
        let interpolation = |l: u32| {
            sparse(session, nodes(l), nodes(l - 1), |i| {
                if i % 2 == 1 {
                    return vec![((i - 1) / 2, 1.0)];
                }
                let (left, right) = ((i / 2).checked_sub(1), Some(i / 2).filter(|j| *j < nodes(l - 1)));
                left.into_iter().chain(right).map(|j| (j, 0.5)).collect()
            })
        };
        let interpolations = (1..LEVELS).map(interpolation).collect();
        let (top, n) = (LEVELS - 1, nodes(LEVELS - 1));
        let b = sparse(session, POINTS, n, |i| (0..n).filter(|j| quarter(top, *j) == Some(i)).map(|j| (j, 1.0)).collect());
        let b_transpose = sparse(session, n, POINTS, |j| quarter(top, j).map(|i| (i, 1.0)).into_iter().collect());
        let zero = sparse(session, POINTS, POINTS, |i| vec![(i, 0.0)]);
        let schur = sparse(session, POINTS, POINTS, |i| vec![(i, -1.0 / GAMMA)]);
        let nest = Matrix::nest(session, [[&levels[top as usize], &b_transpose], [&b, &zero]]).unwrap();
        Self { session, levels, interpolations, schur, nest }
    }

    /// GMRES with block elimination; multigrid for the nodes, unless the user has chosen otherwise.
    pub fn solver(&self, prefix: &str) -> Krylov {
        let defaults = [
            ("ksp_type", "gmres"),
            ("ksp_pc_side", "right"),
            ("fieldsplit_u_ksp_type", "preonly"),
            ("fieldsplit_u_pc_type", "none"),
            ("fieldsplit_u_mg_levels_ksp_type", "richardson"),
            ("fieldsplit_u_mg_levels_ksp_max_it", "1"),
            ("fieldsplit_u_mg_levels_pc_type", "sor"),
            ("fieldsplit_u_mg_coarse_ksp_type", "preonly"),
            ("fieldsplit_u_mg_coarse_pc_type", "redundant"),
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
        let nodes = solvers[0].preconditioner();
        assert_eq!(nodes.prefix(), format!("{prefix}fieldsplit_u_"));
        let interpolations = std::iter::once(None).chain(self.interpolations.iter().map(Some));
        let levels: Vec<MultigridLevel> = self
            .levels
            .iter()
            .zip(interpolations)
            .map(|(operator, interpolation)| MultigridLevel { operator, interpolation })
            .collect();
        nodes.multigrid(&levels).unwrap();
        solvers[0].set_up().unwrap();
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
