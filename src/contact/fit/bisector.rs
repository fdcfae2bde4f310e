//! The curve half-way between two smooth sides: what Γ_C is where nobody declares it.
//!
//! Its points are as far from one side as from the other along its own normal, so its tangent bisects theirs. A curve
//! through the nodes of both sides would follow one side where the other has no node, and turn its normal there: as bodies
//! slide, a normal that turns unevenly acts like a curvature that they do not have.

use crate::contact::fit::halfway::{BEYOND, Halfway, halfway, parameters_between, sort};
use crate::contact::pair::Pair;
use crate::contact::smooth_side::SmoothSide;
use crate::geometry::{Curve, FitSample, Point, Spline};
use std::ops::Range;

/// Spans at most.
const MOST_SPANS: usize = 64;

/// Spans of a closed curve at least.
const LEAST_AROUND: usize = 4;

/// Corrections of the points half-way at least; each leaves a share of the square of the angle between the sides.
const CORRECTIONS: usize = 2;

/// Corrections of the points half-way at most, where round bodies part from each other by a large angle.
const MOST_CORRECTIONS: usize = 12;

/// Points that move by less than this share of the curve need no further correction.
const CENTRED: f64 = 1e-3;

/// Corrections that move as many points by more than this share of what the one before did bring little. Between discs of 24 edges the
/// points of first fits do not come to rest: from the third correction on each moves them by .7 to 1.5 times the one before. To check
/// 1003 discs takes some 5 s without these corrections, and 8 s with them.
const STALLED: f64 = 0.7;

/// Share of a curve from pole to pole that is shown beyond each: with both halves of the images less than half a turn.
const SHOWN: f64 = 0.25;

/// The curve half-way between two sides.
pub struct Bisector {
    /// The curve; its parameter is that of the first side.
    pub curve: Curve,
    /// Parameters up to which both sides are known.
    pub limits: [f64; 2],
}

impl Bisector {
    /// Through the points half-way between some nodes of each side and the other side, in the pair's configuration: least
    /// squares, each weighted by the length it stands for, so that a finer body does not pull the curve. Without a wish the
    /// data choose the number of spans.
    ///
    /// # Errors
    /// Words, if the nodes do not face the other side, or if the pair wants more spans than they bear.
    pub fn between(sides: [&SmoothSide; 2], nodes: &[Range<usize>; 2], pair: &Pair) -> Result<Self, String> {
        Self::along(sides, nodes, pair, None)
    }

    /// The closed curve between two closed sides that face each other all around.
    ///
    /// # Errors
    /// Words, if the sides do not face each other, or if the pair wants more spans than they bear, or fewer than a closed curve needs.
    pub fn around(sides: [&SmoothSide; 2], pair: &Pair) -> Result<Self, String> {
        if let Some(spans) = pair.spans.filter(|&spans| spans < LEAST_AROUND) {
            return Err(format!(
                "spans = {spans}: \"{}\" and \"{}\" meet all around, and a closed curve has {LEAST_AROUND} spans or more; give {LEAST_AROUND}, or \"auto\"",
                pair.between[0], pair.between[1]
            ));
        }
        let all = sides.map(|side| 0..side.nodes());
        Self::along(sides, &all, pair, Some(sides[0].length()))
    }

    fn along(sides: [&SmoothSide; 2], nodes: &[Range<usize>; 2], pair: &Pair, turn: Option<f64>) -> Result<Self, String> {
        let mut points = halfway(sides, nodes, pair);
        sort(&mut points);
        if points.len() < 2 || points[0].parameter >= points[points.len() - 1].parameter {
            let [first, second] = &pair.between;
            return Err(format!(
                "\"{first}\" and \"{second}\" face each other nowhere over a length; name boundaries that do, or correct the mesh"
            ));
        }
        let count: usize = nodes.iter().map(|nodes| nodes.len()).sum();
        let most = (count / 4).max(1);
        if let Some(spans) = pair.spans.filter(|&spans| spans > most) {
            return Err(format!(
                "spans = {spans}: where they meet, \"{}\" and \"{}\" have {} nodes, which bear {most}; give {most} or fewer, or \"auto\", or refine the mesh",
                pair.between[0], pair.between[1], count
            ));
        }
        let curves = sides.map(|side| side.curve(pair.configuration));
        let poles = poles_between(sides, nodes);
        let fit = |points: &[Halfway]| Curve::Spline(fit_by_the_data(&samples(points, &poles), pair.spans, turn));
        let mut curve = fit(&points);
        let whole = points[points.len() - 1].parameter - points[0].parameter;
        let mut before = (f64::INFINITY, 0);
        for correction in 0..MOST_CORRECTIONS {
            let mut next = points.clone();
            let moved = next.iter_mut().map(|point| point.centre(&curve, curves, whole)).fold(0.0, f64::max);
            // A first guess that is far off says nothing of most points, and no curve goes through less than two places.
            let [first, last] = parameters_between(&next);
            let count = next.iter().filter(|point| point.is_between).count();
            if 2 * count < next.len() || first >= last {
                break;
            }
            points = next;
            sort(&mut points);
            curve = fit(&points);
            let is_stalled = count <= before.1 && moved > STALLED * before.0;
            if correction + 1 >= CORRECTIONS && (moved <= CENTRED * whole || is_stalled) {
                break;
            }
            before = (moved, count);
        }
        let data: Vec<f64> = points.iter().filter(|point| point.is_between).map(|point| point.parameter).collect();
        let limits = turn.map_or_else(|| limits(sides, nodes, pair, &curve, &data), |turn| [0.0, turn]);
        Ok(Self { curve, limits })
    }
}

/// Parameters of the first side at which both sides meet the axis of revolution at a right angle, within these nodes: two where a body
/// lies in another one, with all of its section.
fn poles_between([first, second]: [&SmoothSide; 2], nodes: &[Range<usize>; 2]) -> Vec<f64> {
    let own = || first.poles().filter(|pole| nodes[0].contains(pole));
    let nearest = |other: usize| {
        let away = |pole: &usize| (first.places[*pole] - second.places[other]).norm();
        own().min_by(|a, b| away(a).total_cmp(&away(b))).map(|pole| first.parameters[pole])
    };
    second.poles().filter(|pole| nodes[1].contains(pole)).filter_map(nearest).collect()
}

/// What the curve is fitted to, ascending: points half-way, and beyond poles their images at the other side of the axis, without
/// which the curve may meet the axis at any angle, and leave it. Of two poles each shows what is near it, or the images would meet.
fn samples(points: &[Halfway], poles: &[f64]) -> Vec<FitSample> {
    let between = || points.iter().filter(|point| point.is_between);
    let reach = if let [one, other] = poles { SHOWN * (other - one).abs() } else { f64::INFINITY };
    let image = |&at: &f64| {
        let near = between().filter(move |point| (point.parameter - at).abs() <= reach);
        near.map(move |point| (2.0 * at - point.parameter, reflected(point.place), point.weight))
    };
    let mut samples: Vec<FitSample> = between().map(|point| (point.parameter, point.place, point.weight)).collect();
    samples.extend(poles.iter().flat_map(image));
    samples.sort_by(|a, b| a.0.total_cmp(&b.0));
    samples
}

/// The image of a point at the other side of the axis of revolution.
fn reflected(x: Point) -> Point {
    Point::new(-x.x, x.y)
}

/// The part of the curve that both sides see: the data, ascending, but up to the feet of the ends of a side and no farther. Least squares
/// may begin inside of such an end, and each correction moves the first place farther in: pressure would be missing between the two. A
/// curve is known as far beyond its data as these are from each other.
fn limits(sides: [&SmoothSide; 2], nodes: &[Range<usize>; 2], pair: &Pair, curve: &Curve, data: &[f64]) -> [f64; 2] {
    let count = data.len();
    let spacing = [data[1] - data[0], data[count - 1] - data[count - 2]];
    let data = [data[0], data[count - 1]];
    let middle = 0.5 * (data[0] + data[1]);
    let beyond = spacing.map(|spacing| spacing.max(BEYOND * (data[1] - data[0])));
    let (mut limits, mut ends) = (data, [false; 2]);
    for (side, nodes) in sides.iter().zip(nodes).filter(|(side, _)| side.turn().is_none()) {
        let last = side.points.len() - 1;
        for node in [0, last].into_iter().filter(|node| nodes.contains(node)) {
            let foot = curve.nearest(side.positions(pair.configuration)[node]);
            let foot = if side.poles().any(|pole| pole == node) { on_axis(curve, foot) } else { foot };
            if foot < middle {
                let nearest = if ends[0] { limits[0] } else { data[0] - beyond[0] };
                (limits[0], ends[0]) = (nearest.max(foot), true);
            } else {
                let nearest = if ends[1] { limits[1] } else { data[1] + beyond[1] };
                (limits[1], ends[1]) = (nearest.min(foot), true);
            }
        }
    }
    limits
}

/// Parameter at which a curve crosses the axis of revolution, near another one: beyond it nothing of a body would be across.
fn on_axis(curve: &Curve, near: f64) -> f64 {
    (0..2).fold(near, |t, _| t - curve.point(t).x / curve.derivative(t).x)
}

/// Even spans that samples, ascending, fill with two each at least: one without any would be anything.
fn spans_with_data(samples: &[FitSample]) -> usize {
    let apart = samples.windows(2).map(|two| two[1].0 - two[0].0).fold(0.0, f64::max);
    ((samples[samples.len() - 1].0 - samples[0].0) / (2.0 * apart)) as usize
}

/// The fewest spans whose mean distance from the samples is as small as that of any number, but for a half: more would
/// follow the scatter between the two bodies.
fn fit_by_the_data(samples: &[FitSample], wish: Option<usize>, turn: Option<f64>) -> Spline {
    let fit = |spans: usize| match turn {
        Some(turn) => Spline::fit_closed(samples, spans, turn),
        None => Spline::fit(samples, spans),
    };
    if let Some(spans) = wish {
        return fit(spans);
    }
    let least = if turn.is_some() { LEAST_AROUND } else { 1 };
    let most = (samples.len() / 4).min(spans_with_data(samples)).clamp(least, MOST_SPANS);
    let counts = std::iter::successors(Some(least), |count| (2 * count <= most).then_some(2 * count));
    let fits: Vec<(f64, Spline)> = counts
        .map(|count| {
            let spline = fit(count);
            let squares: f64 = samples.iter().map(|(t, x, weight)| weight * (spline.point(*t) - x).norm_squared()).sum();
            (squares.sqrt(), spline)
        })
        .collect();
    let size = samples.iter().map(|(_, x, weight)| weight * x.norm_squared()).sum::<f64>().sqrt();
    let nearest = fits.iter().map(|fit| fit.0).fold(f64::INFINITY, f64::min);
    let good = fits.iter().position(|fit| fit.0 <= (1.5 * nearest).max(1e-14 * size)).unwrap_or(0);
    fits.into_iter().nth(good).map(|fit| fit.1).unwrap_or_else(|| fit(least))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::pair::{Configuration, CurveChoice, EndRule};
    use crate::contact::samples::seam;
    use crate::element::Order;
    use crate::geometry::turn_right;
    use crate::mesh::samples::two_blocks;
    use crate::mesh::{EdgeNode, Level, Numbering, Partition};
    use std::rc::Rc;

    fn on_arc(radius: f64, count: usize) -> Vec<FitSample> {
        let sample = |k: usize| {
            let a = k as f64 / count as f64;
            (a, Point::new(radius * a.sin(), radius * a.cos()), 1.0 / count as f64)
        };
        (0..=count).map(sample).collect()
    }

    #[test]
    fn the_data_choose_the_spans() {
        let spans = |spline: &Spline| spline.knots().len() - 1;
        assert!(spans(&fit_by_the_data(&on_arc(1.0, 200), None, None)) >= 16, "an arc wants many");
        let straight: Vec<FitSample> = (0..40).map(|k| (f64::from(k), Point::new(f64::from(k), 2.0), 1.0)).collect();
        assert_eq!(spans(&fit_by_the_data(&straight, None, None)), 1);
        let mut scattered = on_arc(1.0, 60);
        scattered.extend(on_arc(1.01, 47));
        assert!(spans(&fit_by_the_data(&scattered, None, None)) <= 2, "scatter between two bodies is not followed");
        assert_eq!(spans(&fit_by_the_data(&on_arc(1.0, 200), Some(7), None)), 7);
        // Many samples in the middle of an arc, and eight on either side of it.
        let all = on_arc(1.0, 1600);
        let graded: Vec<FitSample> =
            all.iter().enumerate().filter(|(k, _)| k % 100 == 0 || (700..900).contains(k)).map(|(_, x)| *x).collect();
        let spline = fit_by_the_data(&graded, None, None);
        assert!(spans(&spline) <= 8, "{} spans are empty", spans(&spline));
        assert!(all.iter().all(|(t, x, _)| (spline.point(*t) - x).norm() < 1e-4));
    }

    fn pair(between: [&str; 2]) -> Pair {
        Pair {
            between: between.map(String::from),
            curve: CurveChoice::Fit,
            configuration: Configuration::Deformed,
            ends: EndRule::Free,
            ..seam()
        }
    }

    /// A flat side and one that rises from it like a parabola, of different meshes, and what lies half-way, in both orders.
    #[test]
    fn it_is_as_far_from_one_side_as_from_the_other_whichever_is_first() {
        let mesh = two_blocks();
        let partition = Rc::new(Partition::new(&mesh, &[0; 6], 1));
        let numbering = Numbering::new(Level { intervals: 16, order: Order::P2 }, &partition);
        let upper = mesh.bodies.iter().position(|name| name == "upper");
        let displacement = |node: EdgeNode| {
            let x = node.place(&mesh, &numbering);
            let rises = Some(mesh.body_beside(node.edge)) == upper;
            Point::new(0.0, if rises { 0.2 * (x.x - 0.7).powi(2) } else { 0.0 })
        };
        let orders = [["lower.seam", "upper.seam"], ["upper.seam", "lower.seam"]];
        let found = orders.map(|between| {
            let pair = pair(between);
            let sides = SmoothSide::of_pair(&mesh, &numbering, &pair, &displacement);
            let sides = [&sides[0][0], &sides[1][0]];
            let nodes = sides.map(|side| 0..side.points.len());
            let bisector = Bisector::between(sides, &nodes, &pair).expect("they face each other");
            for k in 0..=40 {
                let t = bisector.limits[0] + (bisector.limits[1] - bisector.limits[0]) * f64::from(k) / 40.0;
                let (x, normal) = (bisector.curve.point(t), turn_right(bisector.curve.tangent(t)));
                let curves = sides.map(|side| side.curve(Configuration::Deformed));
                let hits = curves.map(|curve| curve.hit_from(curve.nearest(x), x, normal).expect("both sides are there"));
                let [a, b] = [0, 1].map(|k| (curves[k].point(hits[k]) - x).dot(&normal));
                assert!((a + b).abs() < 1e-5 + 2e-3 * a.abs(), "{a} and {b} at {x}");
                let angle = |curve: &Curve, t: f64| curve.tangent(t).y.atan2(curve.tangent(t).x);
                let sides = 0.5 * (angle(curves[0], hits[0]) + angle(curves[1], hits[1]));
                assert!((angle(&bisector.curve, t) - sides).abs() < 5e-3, "{} and {sides} at {x}", angle(&bisector.curve, t));
            }
            bisector
        });
        let [first, second] = &found;
        for k in 0..=20 {
            let x = first.curve.point(first.limits[0] + (first.limits[1] - first.limits[0]) * f64::from(k) / 20.0);
            let t = second.curve.nearest(x);
            // The sides are up to 0.34 apart.
            assert!((second.curve.point(t) - x).norm() < 3e-4, "{} at {x}", (second.curve.point(t) - x).norm());
        }
    }

    /// The arc of a round body of radius 1 that touches the origin from below or above, by coarse nodes about 15 degrees apart.
    fn round_side(centre: f64, turned: f64) -> SmoothSide {
        let at = |k: i32| (turned + 15.0 * f64::from(k)).to_radians();
        let points: Vec<Point> = (-4..=4).map(|k| Point::new(at(k).sin(), centre - centre.signum() * at(k).cos())).collect();
        let shape = Curve::Circle { centre: [0.0, centre], radius: 1.0 };
        SmoothSide::through(shape, points.clone(), points, centre.signum(), 2, false)
    }

    /// Round bodies part from each other widely within a few coarse edges: what lies half-way is the line on which they touch, but
    /// for the outer tenths, and runs as evenly.
    #[test]
    fn between_round_bodies_with_long_edges_it_is_straight_and_even() {
        for turned in 0..15 {
            let sides = [round_side(-1.0, f64::from(turned) - 7.0), round_side(1.0, 5.0 - 0.7 * f64::from(turned))];
            let sides = [&sides[0], &sides[1]];
            let nodes = sides.map(|side| 2..side.points.len() - 2);
            let bisector = Bisector::between(sides, &nodes, &pair(["one", "other"])).expect("they face each other");
            for k in 0..=20 {
                let t = bisector.limits[0] + (bisector.limits[1] - bisector.limits[0]) * (0.1 + 0.04 * f64::from(k));
                let (x, slope) = (bisector.curve.point(t), bisector.curve.derivative(t));
                // The sides are x² apart.
                assert!(x.y.abs() < 1e-3 + 0.1 * x.x * x.x, "turned by {turned}: {x}");
                assert!((slope.y / slope.x).abs() < 0.2, "turned by {turned}: it turns at {x}: {slope}");
                assert!((0.7..1.1).contains(&slope.x), "turned by {turned}: it runs unevenly at {x}: {slope}");
            }
        }
    }
}
