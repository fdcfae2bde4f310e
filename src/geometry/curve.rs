//! Plane curves with a parameter.

use super::Formula;

/// A plane curve `t -> (x, y)` over a range of its parameter.
#[derive(Clone, Debug, PartialEq)]
pub enum Curve {
    /// Straight line from the first point (t = 0) to the second (t = 1).
    Line([[f64; 2]; 2]),
    /// Full circle; t is the angle in radians from the x axis.
    Circle {
        /// Middle of the circle.
        centre: [f64; 2],
        /// Radius, > 0.
        radius: f64,
    },
    /// Formulas of `t`.
    Parametric {
        /// x(t).
        x: Formula,
        /// y(t).
        y: Formula,
        /// First and last value of t.
        range: [f64; 2],
    },
}
