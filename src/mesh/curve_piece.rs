//! Pieces of curves: the true shape of one macro edge, or a part of the surface of a rigid tool; and curves that bound no body.

use crate::geometry::{Curve, Point};
use std::sync::Arc;

/// A curve over a range of its parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct CurvePiece {
    /// The curve.
    pub curve: Arc<Curve>,
    /// Its first and its last parameter: at the first and the second vertex of an edge.
    pub range: [f64; 2],
}

impl CurvePiece {
    /// Parameter of the curve at the fraction `t` from the first end.
    pub fn parameter(&self, t: f64) -> f64 {
        self.range[0] + t * (self.range[1] - self.range[0])
    }

    /// Point at this fraction.
    pub fn point(&self, t: f64) -> Point {
        self.curve.point(self.parameter(t))
    }
}

/// A physical curve without triangles: no line of it lies between nodes that triangles have. It may be drawn for a rigid tool.
#[derive(Clone, Debug, PartialEq)]
pub struct LooseCurve {
    /// Name in the mesh file.
    pub name: String,
    /// Ends of its lines, in the order of the file.
    pub lines: Vec<[Point; 2]>,
}
