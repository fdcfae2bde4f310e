//! Strips and stored rows of a rank together.

use super::earlier_couplings::EarlierCouplings;
use super::even_triangles::EvenTriangles;
use super::registers::on_rows;
use super::row_kernel::{OnRows, RowTask};
use super::stored_rows::StoredRows;
use super::strip_kernel::SweepHalves;
use super::strip_set::Strips;
use super::sweep_order::SweepOrder;
use std::ops::Range;

/// Rows to work on.
pub struct LatticeRows<'a> {
    pub strips: &'a Strips,
    pub even: &'a EvenTriangles,
    pub stored: &'a StoredRows,
    pub order: &'a SweepOrder,
}

impl LatticeRows<'_> {
    /// `y = K x` at nodes in strips and inside of even macro triangles, as far as no node of another rank is needed.
    pub fn multiply_inside(&self, x: &[[f64; 2]], y: &mut [[f64; 2]]) {
        let Strips { alike, kernels, nodes, .. } = self.strips;
        alike.iter().for_each(|(strips, kind)| kernels[*kind].multiply(&nodes[strips.clone()], x, y));
        self.even.multiply(true, x, &[], y);
    }

    /// `r = b - K x` at these nodes, those of even macro triangles being left out if not asked for.
    pub fn residual_inside(&self, with_even: bool, b: &[[f64; 2]], x: &[[f64; 2]], r: &mut [[f64; 2]]) {
        let Strips { alike, kernels, nodes, .. } = self.strips;
        alike.iter().for_each(|(strips, kind)| kernels[*kind].residual(&nodes[strips.clone()], b, x, r));
        if with_even {
            self.even.residual(true, b, x, &[], r);
        }
    }

    /// `y = K x` at all other nodes; `far` are the values of other ranks, none stands for zeros.
    pub fn multiply_in_others(&self, x: &[[f64; 2]], far: &[[f64; 2]], y: &mut [[f64; 2]]) {
        self.even.multiply(false, x, far, y);
        self.stored.multiply(0..self.stored.nodes().len(), x, far, y);
    }

    /// `r = b - K x` at all other nodes.
    pub fn residual_in_others(&self, b: &[[f64; 2]], x: &[[f64; 2]], far: &[[f64; 2]], r: &mut [[f64; 2]]) {
        self.even.residual(false, b, x, far, r);
        self.stored.residual(0..self.stored.nodes().len(), b, x, far, r);
    }

    /// The first part of a Gauss-Seidel sweep: forward through the sides that need no node of another rank.
    pub fn begin_to_relax(&self, b: &[[f64; 2]], x: &mut [[f64; 2]]) {
        self.order.near_sides.iter().for_each(|range| self.stored.forward(range.clone(), b, x, &[]));
    }

    /// The rest of it; `far` are the values of other ranks, none stands for zeros.
    pub fn end_to_relax(&self, sweep: SweepHalves, b: &[[f64; 2]], x: &mut [[f64; 2]], far: &[[f64; 2]]) {
        assert!(sweep != SweepHalves::ForwardFromZero, "a sweep from zero begins from zero");
        let (stored, SweepOrder { near_sides, far_sides, inside }) = (self.stored, self.order);
        far_sides.iter().for_each(|range| stored.forward(range.clone(), b, x, far));
        for (triangle, rows) in self.strips.triangles.iter().zip(inside) {
            let parts = &self.strips.alike[triangle.alike.clone()];
            let (kernels, nodes) = (&self.strips.kernels, &self.strips.nodes);
            // Strips come first: what they bring into the cache the stored rows find there.
            parts.iter().for_each(|(strips, kind)| kernels[*kind].forward(&nodes[strips.clone()], b, x));
            stored.forward(rows.clone(), b, x, far);
            if sweep == SweepHalves::Both {
                stored.backward(rows.clone(), b, x, far);
                parts.iter().rev().for_each(|(strips, kind)| kernels[*kind].backward(&nodes[strips.clone()], b, x));
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
    pub fn relax_from_zero(&self, earlier: &EarlierCouplings, b: &[[f64; 2]], x: &mut [[f64; 2]]) {
        let (stored, Strips { triangles, alike, kernels, nodes, .. }) = (self.stored, self.strips);
        let SweepOrder { near_sides, far_sides, inside } = self.order;
        if !triangles.is_empty() {
            // Strips look at nodes that come after them.
            x.fill([0.0; 2]);
        }
        near_sides.iter().chain(far_sides).for_each(|range| stored.forward_from_zero(range.clone(), earlier, b, x));
        for (triangle, rows) in triangles.iter().zip(inside) {
            let parts = &alike[triangle.alike.clone()];
            parts.iter().for_each(|(strips, kind)| kernels[*kind].forward(&nodes[strips.clone()], b, x));
            stored.forward_from_zero(rows.clone(), earlier, b, x);
        }
        self.even.relax(SweepHalves::ForwardFromZero, b, x, &[]);
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

    /// The same where nodes that are not among these `earlier` couplings are zero, whatever `x` holds.
    pub fn forward_from_zero(&self, range: Range<usize>, earlier: &EarlierCouplings, b: &[[f64; 2]], x: &mut [[f64; 2]]) {
        on_rows(OnRows { rows: self, range, far: &[], task: RowTask::FromZero { earlier, b, x } });
    }

    /// Relaxes them in the opposite order.
    pub fn backward(&self, range: Range<usize>, b: &[[f64; 2]], x: &mut [[f64; 2]], far: &[[f64; 2]]) {
        on_rows(OnRows { rows: self, range, far, task: RowTask::Backward { b, x } });
    }
}
