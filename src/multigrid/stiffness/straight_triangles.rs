//! Straight P2 triangles of a mesh that is not cut up: their nodes have no stored rows, and products go through the triangles.
//!
//! A row of a P2 node has 7 to 13 blocks, 32 bytes each: that is more than all else that a solve keeps of the node. A triangle is told by
//! its six nodes and two gradients. Each of its stiffnesses is a sum of the nine blocks `β_kl = λ h_k ⊗ h_l + μ (h_l ⊗ h_k + h_k·h_l I)`,
//! where `h_k = √(2 J/3) ∇l_k` are the gradients of its barycentric coordinates and `J` is its Jacobian determinant, twice its area:
//!
//! | nodes | coupling |
//! |---|---|
//! | corner `k`, itself | `3/4 β_kk` |
//! | corners `k`, `l` | `-1/4 β_kl` |
//! | corner `k`, midside `kl` | `β_kl` |
//! | corner `k`, the midside across | none: the stiffness of a straight triangle has a zero there |
//! | midside `kl`, itself | `2 (β_kk + β_ll) + β_kl + β_lk` |
//! | midsides `kl`, `lm` | `β_kl - β_lk + 2 β_km` |
//!
//! They are the integrals over a triangle of the products of the gradients `(4 l_k - 1) ∇l_k` and `4 (l_k ∇l_l + l_l ∇l_k)`.

use super::lanes::Lanes;
use super::registers::on_rows;
use super::row_kernel::RowWork;
use super::stored_rows::StoredRows;
use crate::element::block::{add, transpose};
use crate::element::{BadJacobian, Block, PlaneLaw, jacobian};
use crate::geometry::Point;
use crate::mesh::Lists;

/// One of them.
pub struct StraightTriangle {
    /// Corners, then midsides, counted from this rank's first node.
    nodes: [u32; 6],
    /// Which of the laws it has.
    law: u32,
    /// `h` of the second and of the third corner (no unit); the three of them make zero.
    gradients: [[f64; 2]; 2],
}

/// Those of this rank that have nodes whose rows are not stored. All nodes of these are this rank's, and free.
#[derive(Default)]
pub struct StraightTriangles {
    triangles: Vec<StraightTriangle>,
    /// `λ` and `μ` (stress) of each law.
    laws: Vec<[f64; 2]>,
}

/// What the couplings of a straight triangle are sums of: `β` of each two of its corners.
pub struct CornerBlocks([[Block; 3]; 3]);

impl CornerBlocks {
    fn new([second, third]: [[f64; 2]; 2], [lambda, mu]: [f64; 2]) -> Self {
        let h = [[-second[0] - third[0], -second[1] - third[1]], second, third];
        let mut blocks = [[[[0.0; 2]; 2]; 3]; 3];
        for (k, l) in [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0)] {
            let (a, b) = (h[k], h[l]);
            let shear = mu * (a[0] * b[0] + a[1] * b[1]);
            let of = |i: usize, j: usize| lambda * (a[i] * b[j]) + mu * (b[i] * a[j]);
            blocks[k][l] = [[of(0, 0) + shear, of(0, 1)], [of(1, 0), of(1, 1) + shear]];
            blocks[l][k] = transpose(&blocks[k][l]);
        }
        Self(blocks)
    }

    /// The coupling of two nodes, corners before midsides, if there is one. That of the same two the other way round is its transpose, to
    /// the last digit.
    #[inline]
    pub fn coupling(&self, a: usize, b: usize) -> Option<Block> {
        let beta = |k: usize, l: usize| &self.0[k % 3][l % 3];
        Some(match (a, b) {
            _ if a > b => transpose(&self.coupling(b, a)?),
            (_, ..3) => sum([(if a == b { 0.75 } else { -0.25 }, beta(a, b))]),
            (..3, _) if a == b - 3 => *beta(a, b + 1),
            (..3, _) if a == (b + 1) % 3 => *beta(a, b),
            (..3, _) => return None,
            _ if a == b => sum([(2.0, beta(a, a)), (2.0, beta(a + 1, a + 1)), (1.0, beta(a, a + 1)), (1.0, beta(a + 1, a))]),
            // Midsides `kl` and `lm`: the corner that they share is the second of the first, or the first of it.
            (_, _) if b == a + 1 => sum([(1.0, beta(a, b)), (-1.0, beta(b, a)), (2.0, beta(a, b + 1))]),
            _ => sum([(1.0, beta(a + 1, a)), (-1.0, beta(a, a + 1)), (2.0, beta(a + 1, b))]),
        })
    }
}

/// A sum of multiples of blocks.
#[inline(always)]
fn sum<const N: usize>(terms: [(f64, &Block); N]) -> Block {
    let mut sum = [[0.0; 2]; 2];
    for (factor, [[a, b], [c, d]]) in terms {
        add(&mut sum, &[[factor * a, factor * b], [factor * c, factor * d]]);
    }
    sum
}

impl StraightTriangles {
    /// None yet, of bodies with these laws.
    pub fn new(laws: &[PlaneLaw]) -> Self {
        Self { triangles: Vec::new(), laws: laws.iter().map(|law| [law.lambda, law.mu]).collect() }
    }

    /// Whether there are any.
    pub fn is_empty(&self) -> bool {
        self.triangles.is_empty()
    }

    /// Couplings of their nodes, both ways.
    pub fn coupling_count(&self) -> usize {
        30 * self.triangles.len()
    }

    /// The largest modulus `λ + 2μ` (stress).
    pub fn largest_modulus(&self) -> f64 {
        self.laws.iter().fold(0.0, |most, [lambda, mu]| most.max(lambda + 2.0 * mu))
    }

    /// What the couplings of a triangle with these corners are sums of; it is kept with its nodes, counted from this rank's first, if it
    /// has some whose rows are not stored.
    ///
    /// # Errors
    /// [`BadJacobian`] if it is turned inside out.
    pub fn couplings(&mut self, corners: &[Point; 3], law: u32, nodes: Option<[u32; 6]>) -> Result<CornerBlocks, BadJacobian> {
        let ([_, second, third], determinant) = jacobian(corners, [1.0, 0.0, 0.0])?;
        let gradients = [second, third].map(|gradient| (gradient * (determinant / 1.5).sqrt()).into());
        self.triangles.extend(nodes.map(|nodes| StraightTriangle { nodes, law, gradients }));
        Ok(CornerBlocks::new(gradients, self.laws[law as usize]))
    }

    /// `y = K x` where rows are not stored; where they are, `y` is anything afterwards.
    pub fn multiply(&self, x: &[[f64; 2]], y: &mut [[f64; 2]]) {
        if !self.is_empty() {
            y.fill([0.0; 2]);
            on_rows(Product { triangles: self, x, y });
        }
    }

    /// Shows the rows that are not stored, ascending: their blocks in the columns that the pattern of the rows has, which are the node
    /// itself, later nodes and those whose rows are stored. The others are couplings of earlier rows, transposed.
    pub fn each_row(&self, rows: &StoredRows, mut show: impl FnMut(usize, &[u32], &[Block])) {
        let around = self.around_nodes(rows);
        let mut blocks = Vec::new();
        for k in (0..rows.nodes.len()).filter(|&k| !rows.is_stored(k)) {
            let columns = &rows.near.columns[rows.near.row(k)];
            blocks.clear();
            blocks.resize(columns.len(), [[0.0; 2]; 2]);
            for place in around.of(k) {
                let triangle = &self.triangles[*place as usize / 6];
                let couplings = CornerBlocks::new(triangle.gradients, self.laws[triangle.law as usize]);
                for (b, &node) in triangle.nodes.iter().enumerate() {
                    let at = columns.iter().map(|&other| usize::from(other < node)).sum::<usize>();
                    if columns.get(at) == Some(&node)
                        && let Some(block) = couplings.coupling(*place as usize % 6, b)
                    {
                        add(&mut blocks[at], &block);
                    }
                }
            }
            show(k, columns, &blocks);
        }
    }

    /// Shows all couplings of the rows that are not stored: row, column, block.
    pub fn each_coupling(&self, rows: &StoredRows, mut show: impl FnMut(usize, usize, Block)) {
        self.each_row(rows, |k, columns, blocks| {
            for (column, block) in columns.iter().map(|&column| column as usize).zip(blocks) {
                show(k, column, *block);
                if column > k && !rows.is_stored(column) {
                    show(column, k, transpose(block));
                }
            }
        });
    }

    /// The triangles around each node whose row is not stored, ascending: six times the triangle, and which of its nodes it is.
    fn around_nodes(&self, rows: &StoredRows) -> Lists<u32> {
        let nodes = self.triangles.iter().flat_map(|triangle| triangle.nodes).map(|node| node as usize).zip(0..);
        Lists::new(rows.nodes.len(), nodes.filter(|(node, _)| !rows.is_stored(*node)))
    }
}

/// A product, two triangles side by side.
struct Product<'a> {
    triangles: &'a StraightTriangles,
    x: &'a [[f64; 2]],
    y: &'a mut [[f64; 2]],
}

impl RowWork for Product<'_> {
    #[inline(always)]
    fn work<L: Lanes<Nodes = [[f64; 2]; 2]>>(self, lanes: L) {
        let Self { triangles: StraightTriangles { triangles, laws }, x, y } = self;
        for two in triangles.chunks(2) {
            let both = [&two[0], &two[two.len() - 1]];
            let mut u = [lanes.load([[0.0; 2]; 2]); 6];
            for (a, u) in u.iter_mut().enumerate() {
                *u = lanes.load([x[both[0].nodes[a] as usize], x[both[1].nodes[a] as usize]]);
            }
            let [[[a, b], [c, d]], [[e, f], [g, h]]] = both.map(|of| of.gradients);
            let gradients = [[pair(lanes, a, e), pair(lanes, b, f)], [pair(lanes, c, g), pair(lanes, d, h)]];
            let forces = forces(lanes, &u, gradients, both.map(|of| laws[of.law as usize]));
            for (lane, triangle) in two.iter().enumerate() {
                for (&node, force) in triangle.nodes.iter().zip(&forces) {
                    let (sum, force) = (&mut y[node as usize], lanes.store(*force)[lane]);
                    *sum = [sum[0] + force[0], sum[1] + force[1]];
                }
            }
        }
    }
}

/// Forces of two triangles with their values at the nodes, gradients and moduli, by stresses near their three corners: that rule is exact.
///
/// Near corner `p` the gradient of the values is `Σ_k c_k ⊗ ∇l_k` with `c_k = 2 u_kp - u_k/3 + 2/3 Σ_l u_kl`, where `u_kl` is the value at
/// a midside and `u_kk` that at a corner. Half of that is taken, and the factor 4 is in the gradients.
#[inline(always)]
fn forces<L: Lanes<Nodes = [[f64; 2]; 2]>>(
    lanes: L,
    u: &[L::Register; 6],
    [g, h]: [[L::Register; 2]; 2],
    laws: [[f64; 2]; 2],
) -> [L::Register; 6] {
    let (minus, sixth, third) = (pair(lanes, -1.0, -1.0), pair(lanes, -1.0 / 6.0, -1.0 / 6.0), pair(lanes, 1.0 / 3.0, 1.0 / 3.0));
    let (lambda_mu, along) = (lanes.load(laws), lanes.load(laws.map(|[lambda, mu]| [lambda + 2.0 * mu, mu])));
    let zero = pair(lanes, 0.0, 0.0);
    let (mut base, mut sums, mut t) = (*u, [zero; 3], [[zero; 3]; 3]);
    for k in 0..3 {
        base[k] = two_products(lanes, [sixth, third], [u[k], lanes.add(u[3 + k], u[3 + (k + 2) % 3])]);
    }
    // `t[p][k]` is what the stress near corner `p` does to the gradient of `l_k`.
    for p in 0..3 {
        let first = lanes.multiply(minus, lanes.add(base[0], u[AT[0][p]]));
        let second = lanes.add(first, lanes.add(base[1], u[AT[1][p]]));
        let third = lanes.add(first, lanes.add(base[2], u[AT[2][p]]));
        let x = two_products(lanes, [second, third], [g[0], h[0]]);
        let y = lanes.turned(two_products(lanes, [second, third], [g[1], h[1]]));
        let stress =
            [two_products(lanes, [along, lambda_mu], [x, y]), lanes.turned(two_products(lanes, [along, lambda_mu], [y, x]))];
        let (second, third) = (two_products(lanes, stress, g), two_products(lanes, stress, h));
        t[p] = [lanes.multiply(minus, lanes.add(second, third)), second, third];
        for k in 0..3 {
            sums[k] = lanes.add(sums[k], t[p][k]);
        }
    }
    for k in 0..3 {
        let l = (k + 1) % 3;
        base[k] = lanes.multiply_add(sixth, sums[k], t[k][k]);
        base[3 + k] = lanes.multiply_add(third, lanes.add(sums[k], sums[l]), lanes.add(t[k][l], t[l][k]));
    }
    base
}

/// A number for each of two nodes.
#[inline(always)]
fn pair<L: Lanes<Nodes = [[f64; 2]; 2]>>(lanes: L, a: f64, b: f64) -> L::Register {
    lanes.load([[a; 2], [b; 2]])
}

/// `a₀ b₀ + a₁ b₁`.
#[inline(always)]
fn two_products<L: Lanes>(lanes: L, a: [L::Register; 2], b: [L::Register; 2]) -> L::Register {
    lanes.multiply_add(a[0], b[0], lanes.multiply(a[1], b[1]))
}

/// Which node lies between two corners.
const AT: [[usize; 3]; 3] = [[0, 3, 5], [3, 1, 4], [5, 4, 2]];

#[cfg(test)]
mod tests {
    use super::super::pattern::RowColumns;
    use super::*;
    use crate::discretisation::samples::vector;
    use crate::element::{Plane, stiffness};

    const PLACES: [[f64; 2]; 4] = [[0.1, 0.0], [1.3, 0.2], [0.4, 0.9], [1.7, 1.1]];

    /// Two triangles with a side in common, of different laws.
    fn triangles() -> [([usize; 3], [u32; 6], PlaneLaw); 2] {
        [
            ([0, 1, 2], [0, 1, 2, 4, 5, 6], PlaneLaw::new(2.0, 0.3, Plane::Strain)),
            ([1, 3, 2], [1, 3, 2, 7, 8, 5], PlaneLaw::new(5.0, 0.4, Plane::Stress)),
        ]
    }

    fn stiffness_of((corners, _, law): &([usize; 3], [u32; 6], PlaneLaw)) -> [[Block; 6]; 6] {
        let x = corners.map(|corner| Point::from(PLACES[corner]));
        let midside = |k: usize| 0.5 * (x[k] + x[(k + 1) % 3]);
        stiffness(&[x[0], x[1], x[2], midside(0), midside(1), midside(2)], law, true).expect("a good triangle")
    }

    fn check(found: &[f64], exact: &[f64]) {
        assert!(found.iter().zip(exact).all(|(a, b)| (a - b).abs() < 1e-13), "{found:?} {exact:?}");
    }

    #[test]
    fn couplings_and_products_are_those_of_the_stiffness_of_each_triangle() {
        let mut all = StraightTriangles::new(&triangles().map(|(.., law)| law));
        let (x, mut exact, mut y) = (vector(9, 4), [[0.0; 2]; 9], vec![[3.0; 2]; 9]);
        for (k, triangle) in triangles().iter().enumerate() {
            let corners = triangle.0.map(|corner| PLACES[corner].into());
            let couplings = all.couplings(&corners, k as u32, Some(triangle.1)).expect("a good triangle");
            for (a, row) in stiffness_of(triangle).iter().enumerate() {
                for (b, block) in row.iter().enumerate() {
                    let found = couplings.coupling(a, b);
                    assert_eq!(found, couplings.coupling(b, a).as_ref().map(transpose), "to the last digit");
                    check(found.unwrap_or_default().as_flattened(), block.as_flattened());
                    let x = x[triangle.1[b] as usize];
                    (0..2).for_each(|i| exact[triangle.1[a] as usize][i] += block[i][0] * x[0] + block[i][1] * x[1]);
                }
            }
        }
        all.multiply(&x, &mut y);
        check(y.as_flattened(), exact.as_flattened());
    }

    /// Nodes 3 and 5 have stored rows; all others are shown in rows of their own.
    #[test]
    fn rows_that_are_not_stored_are_sums_over_triangles() {
        let mut all = StraightTriangles::new(&triangles().map(|(.., law)| law));
        let is_stored = |k: usize| k == 3 || k == 5;
        let mut columns = RowColumns::new(&[9; 9]);
        (0..9).for_each(|k| (0..9).filter(|&l| is_stored(k) || is_stored(l) || l >= k).for_each(|l| columns.push(k, l)));
        let (rows, _) = columns.into_rows((0..9).collect(), &(0..9), std::iter::empty(), is_stored);
        let [mut exact, mut found] = [[[[[0.0; 2]; 2]; 9]; 9]; 2];
        for (k, triangle) in triangles().iter().enumerate() {
            _ = all.couplings(&triangle.0.map(|corner| PLACES[corner].into()), k as u32, Some(triangle.1));
            for (a, row) in triangle.1.iter().zip(stiffness_of(triangle)).filter(|(a, _)| !is_stored(**a as usize)) {
                triangle.1.iter().zip(&row).for_each(|(b, block)| add(&mut exact[*a as usize][*b as usize], block));
            }
        }
        all.each_coupling(&rows, |row, column, block| add(&mut found[row][column], &block));
        check(found.as_flattened().as_flattened().as_flattened(), exact.as_flattened().as_flattened().as_flattened());
    }
}
