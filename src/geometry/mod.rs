//! Curves, formulas and quadrature of the plane; no mesh.

mod curve;
mod formula;
mod gauss;
mod nearness;
mod parametric_curve;
mod place;
mod point_row;
mod spline;

pub use curve::Curve;
pub use formula::{Formula, FormulaError};
pub use gauss::gauss_points;
pub use nearness::{Disc, overlapping_discs};
pub use parametric_curve::ParametricCurve;
pub use place::{Coordinates, Quote, Rounded};
pub use spline::{FitSample, Spline, chord_lengths};

/// A point, or a vector, of the plane (length).
pub type Point = nalgebra::Vector2<f64>;

/// Directions along x and y.
pub const AXES: [Point; 2] = [Point::new(1.0, 0.0), Point::new(0.0, 1.0)];

/// Turns a vector a quarter turn clockwise: the tangent of a counter-clockwise boundary becomes its outward normal.
pub fn turn_right(v: Point) -> Point {
    Point::new(v.y, -v.x)
}

/// `a_x b_y - a_y b_x`: twice the signed area of the triangle that two vectors span.
pub fn cross(a: Point, b: Point) -> f64 {
    a.x * b.y - a.y * b.x
}

/// The smallest box around points: its lower left and its upper right corner. Around none it is inside out, without end.
pub fn bounds(points: impl IntoIterator<Item = Point>) -> [Point; 2] {
    let nothing = [Point::repeat(f64::INFINITY), Point::repeat(f64::NEG_INFINITY)];
    points.into_iter().fold(nothing, |[low, high], x| [low.inf(&x), high.sup(&x)])
}
