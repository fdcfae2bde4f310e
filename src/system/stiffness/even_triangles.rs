//! Inner nodes of even macro triangles: all of them have the couplings of their row, which are not stored. A macro triangle is
//! worked on in a lattice of its own.

use super::block_lanes::product;
use super::strip_kernel::{RowsOf, SweepHalves, TriangleKernel};
use super::strips::Couplings;
use crate::element::Block;
use crate::mesh::lattice;
use crate::system::space::Real;
use crate::system::triangle_lattice::{TriangleNodes, clear_sides, side_nodes, zeros};
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::rc::Rc;

/// Even macro triangles of this rank that are worked on as a whole.
#[derive(Default)]
pub struct EvenTriangles<T = f64> {
    /// Lattice intervals.
    pub n: usize,
    /// Couplings of the rows of each of them.
    pub couplings: Rc<Vec<Vec<Couplings>>>,
    /// The work on each.
    kernels: Rc<Vec<Box<dyn TriangleKernel<T>>>>,
    /// Where they lie.
    pub triangles: Vec<TriangleNodes>,
    /// Lattices to work in.
    room: RefCell<[Vec<[T; 2]>; 2]>,
}

/// Right-hand side of the inner nodes of a macro triangle, as the kernel may read it: some nodes before its first and behind its
/// last one are read, too. Those of the first and of the last macro triangle may have none and come into a lattice.
fn right_hand_side<'a, T: Real>(triangle: &TriangleNodes, b: &'a [[T; 2]], own: &'a mut [[T; 2]]) -> (RowsOf, &'a [[T; 2]]) {
    if triangle.inner.start > 0 && triangle.inner.end + 8 <= b.len() {
        return (RowsOf::Inner(triangle.inner.start), b);
    }
    triangle.bring_inner(b, own);
    (RowsOf::Lattice, own)
}

impl<T: Real> EvenTriangles<T> {
    /// Of triangles with these kernels.
    pub fn new(
        n: usize,
        couplings: Rc<Vec<Vec<Couplings>>>,
        kernels: Rc<Vec<Box<dyn TriangleKernel<T>>>>,
        triangles: Vec<TriangleNodes>,
    ) -> Self {
        let room = RefCell::new([0; 2].map(|_| if triangles.is_empty() { Vec::new() } else { zeros(n) }));
        Self { n, couplings, kernels, triangles, room }
    }

    /// `y = K x` at inner nodes of those macro triangles whose sides are all here, or not; `far` are the values of other ranks, none
    /// stands for zeros.
    pub fn multiply(&self, is_here: bool, x: &[[T; 2]], far: &[[T; 2]], y: &mut [[T; 2]]) {
        let [own_y, own_x] = &mut *self.room.borrow_mut();
        for (triangle, kernel) in self.triangles.iter().zip(&*self.kernels).filter(|(of, _)| of.is_here == is_here) {
            triangle.bring_sides(x, far, own_x);
            kernel.multiply(self.n, &x[triangle.inner.clone()], own_x, own_y, &mut y[triangle.inner.clone()]);
        }
    }

    /// `r = b - K x` at inner nodes of those macro triangles whose sides are all here, or not.
    pub fn residual(&self, is_here: bool, b: &[[T; 2]], x: &[[T; 2]], far: &[[T; 2]], r: &mut [[T; 2]]) {
        let mut own_r = if self.triangles.is_empty() { Vec::new() } else { zeros(self.n) };
        for k in (0..self.triangles.len()).filter(|&k| self.triangles[k].is_here == is_here) {
            self.residual_of(k, b, x, far, &mut own_r);
            self.triangles[k].take_inner(&own_r, r);
        }
    }

    /// The residual of one macro triangle in a lattice, with zeros on its sides.
    pub fn residual_of(&self, k: usize, b: &[[T; 2]], x: &[[T; 2]], far: &[[T; 2]], r: &mut [[T; 2]]) {
        let [own_b, own_x] = &mut *self.room.borrow_mut();
        let triangle = &self.triangles[k];
        triangle.bring_sides(x, far, own_x);
        let (rows, b) = right_hand_side(triangle, b, own_b);
        self.kernels[k].residual(self.n, rows, b, &x[triangle.inner.clone()], own_x, r);
        clear_sides(self.n, r);
    }

    /// A Gauss-Seidel sweep over the inner nodes of one macro triangle after the other: they do not couple.
    pub fn relax(&self, sweep: SweepHalves, b: &[[T; 2]], x: &mut [[T; 2]], far: &[[T; 2]]) {
        let [own_b, own_x] = &mut *self.room.borrow_mut();
        for (triangle, kernel) in self.triangles.iter().zip(&*self.kernels) {
            triangle.bring_sides(x, far, own_x);
            let (rows, b) = right_hand_side(triangle, b, own_b);
            kernel.relax(self.n, sweep, rows, b, &mut x[triangle.inner.clone()], own_x);
        }
    }
}

impl EvenTriangles {
    /// The same with other places for the columns of other ranks; this rank has `near` nodes.
    pub fn moved(&self, near: usize, moved: &[u32]) -> Self {
        let triangles = self.triangles.iter().map(|triangle| triangle.moved(near, moved)).collect();
        Self::new(self.n, self.couplings.clone(), self.kernels.clone(), triangles)
    }

    /// Shows the rows of all inner nodes: the node, and its couplings, that with itself first; columns are counted as
    /// [`TriangleNodes::sides`].
    pub fn each_row(&self, mut show: impl FnMut(usize, &[(usize, Block)])) {
        let n = self.n;
        let mut row = Vec::new();
        let on_sides: BTreeMap<(usize, usize), u32> = side_nodes(n).zip(0..).collect();
        for (triangle, couplings) in self.triangles.iter().zip(&*self.couplings) {
            let turned: BTreeMap<_, _> = triangle.turned.iter().copied().collect();
            for (i, j) in (1..n - 1).flat_map(|j| (1..n - j).map(move |i| (i, j))) {
                row.clear();
                row.extend(couplings[j % couplings.len()].of(i).iter().map(|&((di, dj), block)| {
                    let (k, l) = (i.wrapping_add_signed(di as isize), j.wrapping_add_signed(dj as isize));
                    if let lattice::Place::Inside(place) = lattice::place(n, k, l) {
                        return (triangle.inner.start + place, block);
                    }
                    let side = on_sides[&(k, l)];
                    (triangle.sides[side as usize] as usize, turned.get(&side).map_or(block, |frame| product(&block, frame)))
                }));
                show(triangle.inner.start + lattice::row_start(n, j) + i - 1, &row);
            }
        }
    }
}
