//! What splines through the nodes of undeclared boundaries leave unknown of their shape, and what that does to λ.
//!
//! A spline through every node is compared with that through every other one, and that with the one through every fourth. Where a boundary
//! is smooth, the slopes of the first two differ by much less than those of the last two, and the difference tells the error
//! of the first. Where its nodes scatter, or where its curvature jumps, it does not fall. A gap that is uneven by waves with slopes
//! e' takes pressures of E* e'/2 on a half-plane (Johnson, Contact mechanics, 1985, 13.2). Root mean squares by that, and measured on
//! whole rings of 30/36, 24/32, 20/28 and 40/48 chords that overlap by 5e-4 of the radius: .031 and .033, .059 and .058, .10 and .10,
//! .013 and .014.

use super::traces::TracePoint;
use crate::discretisation::Contact;
use crate::geometry::{Curve, Point};

/// The slopes of a spline through nodes of a smooth boundary are exact to the third power of their distance.
const ORDER: f64 = 8.0;

/// Width of a contact boundary at an end by that at its middle, on the axis of revolution.
const ON_AXIS: f64 = 1e-9;

/// A side that is a spline through nodes, with those through fewer of them.
struct NodedSide<'c> {
    all: &'c Curve,
    second: Curve,
    fourth: Curve,
}

/// Estimated relative error of λ, root mean square over what presses, by the shapes of sides that nobody has declared; nothing if gaps are
/// not measured between shapes, or if nothing presses.
pub fn shape_error(contact: &Contact, points: &[TracePoint]) -> Option<f64> {
    let shapes = contact.shapes.as_ref()?;
    let pressing: Vec<&TracePoint> = points.iter().filter(|point| point.lambda > 0.0).collect();
    let force: f64 = pressing.iter().map(|point| point.lambda).sum();
    let mean = pressing.iter().map(|point| point.lambda * point.lambda).sum::<f64>() / force;
    // With both ends free a tilt moves what presses, and no more; at an axis, or at a line of symmetry, it is a ridge or a groove.
    let (boundary, middle) = (&contact.boundary, contact.boundary.parameter_at(0.5 * contact.boundary.length()));
    let is_on_axis = |end: f64| boundary.width(end) < ON_AXIS * boundary.width(middle);
    let is_free = contact.ends_with_a_body() == [false; 2] && !boundary.ends().into_iter().any(is_on_axis);
    let slopes = shapes.each_ref().map(|curves| slope_error(curves, &pressing, is_free));
    (force > 0.0 && contact.compliance > 0.0).then(|| 0.5 * slopes[0].hypot(slopes[1]) / (contact.compliance * mean))
}

/// Error of the slopes of a side where it presses (radians), root mean square; without their mean, where that is no matter.
fn slope_error(curves: &[Curve], pressing: &[&TracePoint], without_mean: bool) -> f64 {
    let sides: Vec<NodedSide> = curves.iter().filter_map(NodedSide::of).collect();
    let (mut first, mut second) = (Vec::new(), Vec::new());
    for point in pressing {
        let away = |side: &&NodedSide| (side.all.point(side.all.nearest(point.x)) - point.x).norm_squared();
        let Some(side) = sides.iter().min_by(|a, b| away(a).total_cmp(&away(b))) else { continue };
        first.push(apart(side.all, &side.second, point.x));
        second.push(apart(&side.second, &side.fourth, point.x));
    }
    let [first, second] = [first, second].map(|differences| deviation(&differences, without_mean));
    // A share that stays on each coarser spline makes a series; what does not fall is all error.
    let share = (first / second).max(1.0 / ORDER);
    if share < 0.5 { first * share / (1.0 - share) } else { first }
}

impl<'c> NodedSide<'c> {
    fn of(curve: &'c Curve) -> Option<Self> {
        let Curve::Spline(spline) = curve else { return None };
        let second = spline.coarser()?;
        let fourth = second.coarser().unwrap_or_else(|| second.clone());
        Some(Self { all: curve, second: Curve::Spline(second), fourth: Curve::Spline(fourth) })
    }
}

/// Angle between two curves beside a point (radians).
fn apart(one: &Curve, other: &Curve, x: Point) -> f64 {
    let [a, b] = [one, other].map(|curve| curve.tangent(curve.nearest(x)));
    a.perp(&b).atan2(a.dot(&b))
}

/// Root mean square of values, or of what differs from their mean; 0 without any.
fn deviation(values: &[f64], without_mean: bool) -> f64 {
    let count = values.len().max(1) as f64;
    let mean = if without_mean { values.iter().sum::<f64>() / count } else { 0.0 };
    (values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / count).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Spline;

    /// Error of the slopes of the spline through points of a height over x, where it presses around the origin.
    fn off(height: impl Fn(f64) -> f64) -> f64 {
        let points: Vec<Point> = (-40..=40).map(|k| 0.05 * f64::from(k)).map(|x| Point::new(x, height(x))).collect();
        let spline = Spline::through(points.iter().map(|point| point.x).collect(), &points, false);
        let at = |k: i32| {
            let x = Point::new(0.013 * f64::from(k), 0.0);
            let (displacement, stress, distance) = ([0.0; 2], [0.0; 2], [0.0; 2]);
            TracePoint { arc: x.x, x, normal: Point::y(), lambda: 1.0, displacement, slip: 0.0, stress, distance, gap: 0.0 }
        };
        let pressing: Vec<TracePoint> = (-30..=30).map(at).collect();
        slope_error(&[Curve::Spline(spline)], &pressing.iter().collect::<Vec<_>>(), true)
    }

    #[test]
    fn what_nodes_leave_unknown_is_of_the_size_of_what_they_miss() {
        let round = |x: f64| 2.0 - (4.0 - x * x).sqrt();
        assert!(off(round) < 1e-6, "{}", off(round));
        assert_eq!(off(|_| 0.0), 0.0);
        // Every third node is off by 1e-4: slopes by that over the distance of nodes.
        let scatter = off(|x| round(x) + if (20.0 * x).round() as i32 % 3 == 0 { 1e-4 } else { 0.0 });
        assert!((1e-3..5e-3).contains(&scatter), "{scatter}");
        // A ridge of two planes at .02 that nodes round off over two of their distances.
        let ridge = off(|x| 0.02 * x.abs());
        assert!((1e-3..1e-2).contains(&ridge), "{ridge}");
    }
}
