//! Curves by formulas of their parameter.

use super::Point;
use super::formula::Formula;

/// Ends of a curve nearer than this share of its speed times its range are one point, where its tangents are one, too.
const MEETS_ITSELF: f64 = 1e-9;

/// Parts of the range between the points that are kept: the nearest of them is where a search for a foot begins.
pub const PARTS: usize = 64;

/// A plane curve `t -> (x(t), y(t))`, with points of it that are computed once.
#[derive(Clone, Debug, PartialEq)]
pub struct ParametricCurve {
    x: Formula,
    y: Formula,
    range: [f64; 2],
    closes: bool,
    /// Whether its formulas go on beyond the range, for its length on either side; if not, its tangents do.
    goes_on: bool,
    /// Points between equal parts of the range.
    points: Vec<Point>,
}

impl ParametricCurve {
    /// The curve of two formulas of one variable, with the first and the last value of that.
    pub fn new(x: Formula, y: Formula, range: [f64; 2]) -> Self {
        let mut curve = Self { x, y, range, closes: false, goes_on: true, points: Vec::new() };
        let ([first, last], speed) = (range.map(|t| curve.at(t)), range.map(|t| curve.slope_at(t)));
        let near = |a: Point, b: Point, size: f64| (a - b).norm() <= MEETS_ITSELF * size;
        curve.closes = near(first, last, speed[0].norm() * (range[1] - range[0])) && near(speed[0], speed[1], speed[0].norm());
        let beyond = (1..=PARTS).flat_map(|k| [curve.parameter(PARTS + k), range[0] + range[1] - curve.parameter(PARTS + k)]);
        curve.goes_on =
            curve.closes || beyond.into_iter().all(|t| [curve.at(t), curve.slope_at(t)].iter().flatten().all(|v| v.is_finite()));
        curve.points = (0..=PARTS).map(|k| curve.at(curve.parameter(k))).collect();
        curve
    }

    /// The curve shifted by a vector (length).
    pub fn moved(&self, by: Point) -> Self {
        Self::new(self.x.plus(by.x), self.y.plus(by.y), self.range)
    }

    /// First and last parameter.
    pub fn range(&self) -> [f64; 2] {
        self.range
    }

    /// Length of its range, if the curve ends where it begins, in the same direction.
    pub fn period(&self) -> Option<f64> {
        self.closes.then_some(self.range[1] - self.range[0])
    }

    /// Point at a parameter; beyond the range that of the formulas, or of the next turn of a closed curve, or, where the formulas have no
    /// value, of the tangent at the end.
    pub fn point(&self, t: f64) -> Point {
        let t = self.within(t);
        let end = if self.goes_on { t } else { t.clamp(self.range[0], self.range[1]) };
        if end == t { self.at(t) } else { self.at(end) + (t - end) * self.slope_at(end) }
    }

    /// Derivative of the point by the parameter.
    pub fn derivative(&self, t: f64) -> Point {
        let t = self.within(t);
        self.slope_at(if self.goes_on { t } else { t.clamp(self.range[0], self.range[1]) })
    }

    /// Parameter of the nearest of the points that are kept.
    pub fn nearest_part_end(&self, p: Point) -> f64 {
        let distance = |k: &usize| (self.points[*k] - p).norm_squared();
        self.parameter((0..=PARTS).min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or_default())
    }

    fn parameter(&self, part: usize) -> f64 {
        self.range[0] + (self.range[1] - self.range[0]) * part as f64 / PARTS as f64
    }

    /// The parameter within the range that means the same point of a closed curve.
    fn within(&self, t: f64) -> f64 {
        let [first, last] = self.range;
        if (first..=last).contains(&t) || !self.closes { t } else { first + (t - first).rem_euclid(last - first) }
    }

    fn at(&self, t: f64) -> Point {
        Point::new(self.x.value(&[t]), self.y.value(&[t]))
    }

    fn slope_at(&self, t: f64) -> Point {
        Point::new(self.x.derivative(0, &[t]), self.y.derivative(0, &[t]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    fn curve(x: &str, y: &str, range: [f64; 2]) -> ParametricCurve {
        let read = |text| Formula::parse(text, &["t"]).expect("a formula");
        ParametricCurve::new(read(x), read(y), range)
    }

    #[test]
    fn a_closed_curve_goes_on_where_it_began() {
        let ellipse = curve("3*cos(t)", "sin(t)", [0.0, TAU]);
        assert_eq!(ellipse.period(), Some(TAU));
        assert!((ellipse.point(TAU + 0.3) - ellipse.point(0.3)).norm() < 1e-14);
        assert!((ellipse.derivative(-0.3) - ellipse.derivative(TAU - 0.3)).norm() < 1e-14);
        let half = curve("3*cos(t)", "sin(t)", [0.0, 0.5 * TAU]);
        assert_eq!(half.period(), None);
        assert!((half.point(4.0) - ellipse.point(4.0)).norm() < 1e-14, "continued by its formulas");
    }

    #[test]
    fn a_curve_whose_formulas_end_goes_on_along_its_tangents() {
        let crown = curve("t", "-0.004*log(1-(t/4)^2)", [-3.99, 3.99]);
        let [end, slope] = [crown.point(3.99), crown.derivative(3.99)];
        for beyond in [0.005, 1.0] {
            assert!((crown.point(3.99 + beyond) - end - beyond * slope).norm() < 1e-12);
            assert_eq!(crown.derivative(-3.99 - beyond), crown.derivative(-3.99));
        }
    }

    #[test]
    fn a_curve_with_a_corner_where_it_ends_does_not_close() {
        assert_eq!(curve("sin(t)", "sin(0.5*t)", [0.0, TAU]).period(), None);
    }

    #[test]
    fn the_nearest_point_kept_is_within_half_a_part() {
        let ellipse = curve("3*cos(t)", "sin(t)", [0.0, TAU]).moved(Point::new(5.0, -1.0));
        for t in [0.0, 0.4, 2.2, 6.2] {
            let found = ellipse.nearest_part_end(ellipse.point(t));
            assert!((found - t).abs() <= 0.51 * TAU / PARTS as f64, "{t}: {found}");
        }
    }
}
