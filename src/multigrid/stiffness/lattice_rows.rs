//! Even macro triangles and stored rows of a rank together.

use super::even_triangles::EvenTriangles;
use super::registers::on_rows;
use super::row_kernel::{OnRows, RowTask};
use super::stored_rows::StoredRows;
use super::sweep_order::{SweepHalves, SweepOrder};
use std::ops::Range;

/// Rows to work on.
pub struct LatticeRows<'a> {
    pub even: &'a EvenTriangles,
    pub stored: &'a StoredRows,
    pub order: &'a SweepOrder,
}

impl LatticeRows<'_> {
    /// The first part of a Gauss-Seidel sweep: forward through the sides that need no node of another rank.
    pub fn begin_to_relax(&self, b: &[[f64; 2]], x: &mut [[f64; 2]]) {
        self.order.near_sides.iter().for_each(|range| self.stored.forward(range.clone(), b, x, &[]));
    }

    /// The rest of it; `far` are the values of other ranks, none stands for zeros.
    pub fn end_to_relax(&self, sweep: SweepHalves, b: &[[f64; 2]], x: &mut [[f64; 2]], far: &[[f64; 2]]) {
        let (stored, SweepOrder { near_sides, far_sides, inside }) = (self.stored, self.order);
        far_sides.iter().for_each(|range| stored.forward(range.clone(), b, x, far));
        for rows in inside {
            stored.forward(rows.clone(), b, x, far);
            if sweep == SweepHalves::Both {
                stored.backward(rows.clone(), b, x, far);
            }
        }
        self.even.relax(sweep, b, x, far);
        if sweep == SweepHalves::Both {
            for sides in [far_sides, near_sides] {
                sides.iter().rev().for_each(|range| stored.backward(range.clone(), b, x, far));
            }
        }
    }

    /// The forward half of a sweep from zero, whatever `x` holds; nodes of other ranks stay zero.
    pub fn relax_from_zero(&self, b: &[[f64; 2]], x: &mut [[f64; 2]]) {
        x.fill([0.0; 2]);
        self.begin_to_relax(b, x);
        self.end_to_relax(SweepHalves::ForwardFromZero, b, x, &[]);
    }
}

impl StoredRows {
    /// `y = K x` in the rows of a range; `far` are the values of columns of other ranks.
    pub fn multiply(&self, range: Range<usize>, x: &[[f64; 2]], far: &[[f64; 2]], y: &mut [[f64; 2]]) {
        on_rows(OnRows { rows: self, range, far, task: RowTask::Multiply { y, x } });
    }

    /// `r = b - K x` in the rows of a range.
    pub fn residual(&self, range: Range<usize>, b: &[[f64; 2]], x: &[[f64; 2]], far: &[[f64; 2]], r: &mut [[f64; 2]]) {
        on_rows(OnRows { rows: self, range, far, task: RowTask::Residual { r, b, x } });
    }

    /// Relaxes the nodes of a range in their order, `far` staying as it is; no `far` stands for zeros.
    pub fn forward(&self, range: Range<usize>, b: &[[f64; 2]], x: &mut [[f64; 2]], far: &[[f64; 2]]) {
        on_rows(OnRows { rows: self, range, far, task: RowTask::Forward { b, x } });
    }

    /// Relaxes them in the opposite order.
    pub fn backward(&self, range: Range<usize>, b: &[[f64; 2]], x: &mut [[f64; 2]], far: &[[f64; 2]]) {
        on_rows(OnRows { rows: self, range, far, task: RowTask::Backward { b, x } });
    }
}

#[cfg(test)]
mod tests {
    use super::super::assembly::{Assembled, Assembly};
    use super::*;
    use crate::contact::MultiplierSpace;
    use crate::discretisation::samples::{blocks, pair, vector};
    use crate::discretisation::{Scene, Space, spaces};
    use crate::element::Order;
    use crate::geometry::{Curve, Point};
    use crate::mesh::Partition;
    use std::rc::Rc;

    /// Blocks whose macro triangles are even, graded towards a corner, or bent.
    fn scenes(order: Order, refine: usize) -> Vec<Scene> {
        let mut even = Scene { order, refine, ..blocks(pair(MultiplierSpace::P0, 4), |_| Point::zeros(), Vec::new()) };
        even.bodies.iter_mut().flat_map(|body| &mut body.parts).for_each(|part| part.material.poisson = 0.3);
        let [mut graded, mut bent] = [(); 2].map(|()| (*even.mesh).clone());
        let corner = graded.vertices[0];
        graded.grade(corner, 0.3).expect("a vertex");
        let circle = Curve::Circle { centre: [1.0, -2.0], radius: 10f64.sqrt() };
        bent.bend("arc", &["lower.seam".into()], &circle).expect("the ends lie on it");
        let on = |mesh| Scene { mesh: Rc::new(mesh), ..even.clone() };
        vec![even.clone(), on(graded), on(bent)]
    }

    /// On one rank and on each of three.
    #[test]
    fn a_sweep_from_zero_is_a_sweep_through_zeros() {
        for order in [Order::P1, Order::P2] {
            let mut kinds = [0; 3];
            let scenes = scenes(order, 5).into_iter().flat_map(|scene| [1, 3].map(|ranks| (scene.clone(), ranks)));
            for ((mut scene, ranks), rank) in scenes.flat_map(|pair| (0..pair.1).map(move |rank| (pair.clone(), rank))) {
                let owners: Vec<i32> = (0..scene.mesh.triangles.len()).map(|triangle| (triangle % ranks) as i32).collect();
                scene.partition = Rc::new(Partition::new(&scene.mesh, &owners, ranks));
                for space in spaces(&scene, rank).expect("a small mesh") {
                    let found = check(&scene, &space, rank);
                    (0..3).for_each(|k| kinds[k] += found[k]);
                }
            }
            assert!(kinds.iter().all(|count| *count > 0), "{kinds:?}: some of each kind");
        }
    }

    /// Counts macro triangles whose inner rows are stored, even ones, and sides that need nodes of other ranks.
    fn check(scene: &Scene, space: &Space, rank: usize) -> [usize; 3] {
        let assembly = Assembly::new(scene, space, true, rank);
        let Assembled { rows, inside, even, .. } = assembly.assemble(&Default::default(), |_, _| ()).expect("good triangles");
        let (order, nodes) = (SweepOrder::new(&rows, &inside), space.own.len());
        let lattice = LatticeRows { even: &even, stored: &rows, order: &order };
        let (b, mut zero, mut x) = (vector(nodes, 3), vec![[0.0; 2]; nodes], vector(nodes, 8));
        lattice.begin_to_relax(&b, &mut zero);
        lattice.end_to_relax(SweepHalves::Forward, &b, &mut zero, &[]);
        lattice.relax_from_zero(&b, &mut x);
        let largest = zero.as_flattened().iter().fold(0.0, |largest: f64, v| largest.max(v.abs()));
        for (x, zero) in x.as_flattened().iter().zip(zero.as_flattened()) {
            // The same products are added in another order.
            assert!((x - zero).abs() <= 1e-14 * largest, "{x} {zero}");
        }
        [inside.len(), even.triangles.len(), order.far_sides.len()]
    }
}
