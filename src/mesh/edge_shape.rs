//! The true shape of one macro edge.

use crate::geometry::Curve;
use std::sync::Arc;

/// The true shape of a macro edge: a piece of a curve.
#[derive(Clone, Debug)]
pub struct EdgeShape {
    /// The curve.
    pub curve: Arc<Curve>,
    /// Parameters of the curve at the edge's first and second vertex.
    pub range: [f64; 2],
}

impl EdgeShape {
    /// Parameter of the curve at the fraction `t` from the edge's first vertex.
    pub fn parameter(&self, t: f64) -> f64 {
        self.range[0] + t * (self.range[1] - self.range[0])
    }
}
