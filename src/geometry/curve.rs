//! Plane curves with a parameter.

use super::parametric_curve::{self, ParametricCurve};
use super::spline::Spline;
use super::{Point, cross};
use std::f64::consts::TAU;

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
    Parametric(ParametricCurve),
    /// A spline through or near points.
    Spline(Spline),
}

/// Where the way to a foot shrinks by a smaller share of what has been gone, the point lies at a centre of curvature, and what
/// is nearest is not told by slopes.
const LEAST_SHRUNK: f64 = 0.1;

impl Curve {
    /// The curve shifted by a vector (length).
    pub fn moved(&self, by: Point) -> Self {
        let place = |[x, y]: [f64; 2]| [x + by.x, y + by.y];
        match self {
            same if by == Point::zeros() => same.clone(),
            Self::Line(ends) => Self::Line(ends.map(place)),
            Self::Circle { centre, radius } => Self::Circle { centre: place(*centre), radius: *radius },
            Self::Parametric(curve) => Self::Parametric(curve.moved(by)),
            Self::Spline(spline) => Self::Spline(spline.clone().moved(by)),
        }
    }

    /// First and last parameter.
    pub fn range(&self) -> [f64; 2] {
        match self {
            Self::Line(_) => [0.0, 1.0],
            Self::Circle { .. } => [0.0, TAU],
            Self::Parametric(curve) => curve.range(),
            Self::Spline(spline) => spline.range(),
        }
    }

    /// Length of one turn in the parameter, if the curve closes in itself: circles, and curves that end where they begin, in the
    /// same direction.
    pub fn period(&self) -> Option<f64> {
        match self {
            Self::Line(_) => None,
            Self::Circle { .. } => Some(TAU),
            Self::Parametric(curve) => curve.period(),
            Self::Spline(spline) => spline.period(),
        }
    }

    /// Whether the curve is a straight line by its kind.
    pub fn is_line(&self) -> bool {
        matches!(self, Self::Line(_))
    }

    /// Point at parameter `t`.
    pub fn point(&self, t: f64) -> Point {
        match self {
            Self::Line([a, b]) => Point::new(a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])),
            Self::Circle { centre, radius } => Point::new(centre[0] + radius * t.cos(), centre[1] + radius * t.sin()),
            Self::Parametric(curve) => curve.point(t),
            Self::Spline(spline) => spline.point(t),
        }
    }

    /// Derivative of the point by the parameter.
    pub fn derivative(&self, t: f64) -> Point {
        match self {
            Self::Line([a, b]) => Point::new(b[0] - a[0], b[1] - a[1]),
            Self::Circle { radius, .. } => Point::new(-radius * t.sin(), radius * t.cos()),
            Self::Parametric(curve) => curve.derivative(t),
            Self::Spline(spline) => spline.derivative(t),
        }
    }

    /// Point and derivative, of which a spline has both from one look.
    fn point_and_derivative(&self, t: f64) -> [Point; 2] {
        match self {
            Self::Spline(spline) => spline.point_and_derivative(t),
            _ => [self.point(t), self.derivative(t)],
        }
    }

    /// Unit tangent at parameter `t`.
    pub fn tangent(&self, t: f64) -> Point {
        self.derivative(t).normalize()
    }

    /// Parameter of the curve's nearest point: its normal line passes through `p`. Beyond an end the curve is
    /// continued by its formulas, so that a point just outside still has its own foot.
    pub fn nearest(&self, p: Point) -> f64 {
        match self {
            Self::Line([a, _]) => {
                let along = self.derivative(0.0);
                (p - Point::new(a[0], a[1])).dot(&along) / along.norm_squared()
            }
            Self::Circle { centre, .. } => {
                let r = p - Point::new(centre[0], centre[1]);
                r.y.atan2(r.x).rem_euclid(TAU)
            }
            Self::Parametric(curve) => self.nearest_from(p, curve.nearest_part_end(p), parametric_curve::PARTS),
            Self::Spline(spline) => self.nearest_from(p, spline.nearest_part_end(p), spline.parts()),
        }
    }

    /// Parameter of a point of the curve that is as near as few looks tell.
    pub fn nearly_nearest(&self, p: Point) -> f64 {
        match self {
            Self::Spline(spline) => spline.nearest_part_end(p),
            _ => self.nearest(p),
        }
    }

    /// The nearest point from a parameter near it: Newton's method on `(p - x(t)) . x'(t) = 0`, with the curvature from the step before
    /// (a secant), since points farther away than the curve's radius would go back and forth without it; by steps of one part of its
    /// range at most, since the way that is left on the tangent is too long there. Beyond the ends of a spline the tangent is the curve.
    fn nearest_from(&self, p: Point, mut t: f64, parts: usize) -> f64 {
        let [first, last] = self.range();
        let longest = (last - first).abs() / parts as f64;
        let mut before: Option<[f64; 2]> = None;
        let away = |t: f64| (p - self.point(t)).norm();
        let start = t;
        for _ in 0..200 {
            let [point, slope] = self.point_and_derivative(t);
            let straight = (p - point).dot(&slope) / slope.norm_squared();
            if matches!(self, Self::Spline(spline) if spline.goes_on_straight(t, straight)) {
                t += straight;
                break;
            }
            // On a straight line the way that is left shrinks by as much as has been gone.
            let shrunk = before.map_or(1.0, |[at, left]| (left - straight) / (t - at));
            before = Some([t, straight]);
            let step = if shrunk > LEAST_SHRUNK { straight / shrunk } else { straight }.clamp(-longest, longest);
            t += step;
            // Far from the origin coordinates lose digits, and steps never become smaller than what is lost.
            if step.abs() <= 1e-15 * (last - first).abs() + 2.0 * f64::EPSILON * p.amax() / slope.norm() {
                break;
            }
        }
        // Between two curvatures the steps may lead away: the place that they began at is nearer then.
        if away(t) > away(start) { start } else { t }
    }

    /// Where the line from `origin` along the unit vector `direction` meets the curve next to the origin: signed
    /// distance, and by what share of its range the hit lies beyond an end (0 within). Nothing if the line misses.
    pub fn hit(&self, origin: Point, direction: Point) -> Option<(f64, f64)> {
        let t = self.hit_from(self.nearest(origin), origin, direction)?;
        let offset = self.point(t) - origin;
        let [first, last] = self.range();
        let beyond = if self.period().is_some() { 0.0 } else { (first - t).max(t - last) / (last - first) };
        Some((offset.dot(&direction), if beyond > 1e-9 { beyond } else { 0.0 }))
    }

    /// Parameter of the point where the line from `origin` along the unit vector `direction` meets the curve, by Newton's
    /// method from the parameter `t`. Nothing if the line misses.
    pub fn hit_from(&self, mut t: f64, origin: Point, direction: Point) -> Option<f64> {
        let mut at = self.point_and_derivative(t);
        for _ in 0..100 {
            let [point, derivative] = at;
            let slope = cross(direction, derivative);
            if slope.abs() <= 1e-12 * derivative.norm() {
                return None;
            }
            let step = cross(direction, point - origin) / slope;
            t -= step;
            at = self.point_and_derivative(t);
            // Far from the origin coordinates lose digits, and steps never become smaller than what is lost.
            if step.abs() <= 1e-15 * (1.0 + t.abs()) + 2.0 * f64::EPSILON * origin.amax() / slope.abs() {
                break;
            }
        }
        let offset = at[0] - origin;
        let missed = cross(direction, offset).abs() > 1e-9 * (offset.norm() + at[1].norm());
        (!missed).then_some(t)
    }
}

#[cfg(test)]
mod tests {
    use super::super::formula::Formula;
    use super::super::spline::chord_lengths;
    use super::*;

    fn parabola() -> Curve {
        let read = |text| Formula::parse(text, &["t"]).expect("a formula");
        Curve::Parametric(ParametricCurve::new(read("t"), read("4 + t - 0.25*t^2"), [0.0, 4.0]))
    }

    /// A triangle with round corners of radius .2 to a width of 2: points farther from a corner than that.
    #[test]
    fn the_nearest_point_of_a_corner_is_found_from_afar() {
        let read = |text| Formula::parse(text, &["t"]).expect("a formula");
        let [x, y] = ["(1 + 0.1*cos(3*t))*cos(t) + 0.3*sin(3*t)*sin(t)", "(1 + 0.1*cos(3*t))*sin(t) - 0.3*sin(3*t)*cos(t)"];
        let curve = Curve::Parametric(ParametricCurve::new(read(x), read(y), [0.0, std::f64::consts::TAU]));
        for p in [Point::new(1.8, 0.1), Point::new(2.5, -0.3), Point::new(-1.2, 1.7)] {
            let t = curve.nearest(p);
            assert!((p - curve.point(t)).dot(&curve.tangent(t)).abs() < 1e-12, "{p}: {t}");
        }
    }

    #[test]
    fn the_nearest_point_sees_its_origin_along_the_normal() {
        let curves = [Curve::Line([[0.0, 3.0], [6.0, 4.0]]), Curve::Circle { centre: [1.0, -1.0], radius: 2.0 }, parabola()];
        for curve in &curves {
            for p in [Point::new(1.2, 3.9), Point::new(2.9, 5.1), Point::new(0.1, 4.2)] {
                let t = curve.nearest(p);
                assert!((p - curve.point(t)).dot(&curve.tangent(t)).abs() < 1e-12, "{curve:?} {p}");
            }
        }
    }

    #[test]
    fn a_line_along_the_normal_meets_the_curve_it_came_from() {
        let curve = parabola();
        let (t, d) = (1.7, 0.3);
        let normal = super::super::turn_right(curve.tangent(t));
        let found = curve.hit(curve.point(t) - d * normal, normal);
        let (distance, beyond) = found.expect("a hit");
        assert!((distance - d).abs() < 1e-12 && beyond == 0.0);
    }

    /// A short arc, and points a thousand times its length away.
    #[test]
    fn a_point_far_beyond_the_ends_of_a_spline_has_its_foot_on_the_tangent_there() {
        let points: Vec<Point> = (0..9).map(|k| 0.01 * f64::from(k)).map(|t| Point::new(t.sin(), 1.0 - t.cos())).collect();
        let curve = Curve::Spline(Spline::through(chord_lengths(&points), &points, false));
        for p in [Point::new(80.0, 3.0), Point::new(-80.0, 3.0)] {
            let t = curve.nearest(p);
            assert!((p - curve.point(t)).dot(&curve.tangent(t)).abs() < 1e-12, "{p}: {t}");
        }
    }

    #[test]
    fn a_curve_that_is_moved_has_its_points_moved() {
        let points: Vec<Point> = (0..9).map(|k| Point::new(f64::from(k).cos(), f64::from(k))).collect();
        let spline = Curve::Spline(Spline::through(chord_lengths(&points), &points, false));
        let circle = Curve::Circle { centre: [1.0, -1.0], radius: 2.0 };
        let by = Point::new(0.3, -4.0);
        for curve in [Curve::Line([[0.0, 3.0], [6.0, 4.0]]), circle, parabola(), spline] {
            for t in [0.0, 0.4, 1.7] {
                let moved = curve.moved(by);
                assert!((moved.point(t) - curve.point(t) - by).norm() < 1e-14, "{curve:?}");
                assert!((moved.derivative(t) - curve.derivative(t)).norm() < 1e-14, "{curve:?}");
            }
        }
    }

    #[test]
    fn a_line_that_misses_is_told() {
        let circle = Curve::Circle { centre: [0.0, 0.0], radius: 1.0 };
        assert_eq!(circle.hit(Point::new(0.0, 2.0), Point::new(1.0, 0.0)), None);
    }
}
