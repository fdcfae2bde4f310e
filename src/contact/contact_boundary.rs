//! Γ_C: a curve of its own, its normal, and its segments.

use crate::element::Plane;
use crate::geometry::{Curve, Point, gauss_points, turn_right};
use std::ops::Range;

/// What is left of a turn by less than this share is rounding: the boundary is closed.
const WHOLE: f64 = 1e-9;

/// Pieces that arc lengths are summed over.
const PIECES: usize = 32;

/// Steps of Newton's method within a piece at most, and the last of them by the parameters: each doubles the digits.
const MOST_STEPS: usize = 20;
const ROUNDED: f64 = 1e-15;

/// The contact boundary of one pair. The same on every rank; it knows nothing of the meshes.
///
/// One that goes all around a closed curve is closed: it begins and ends at its seam, and what is said of a parameter, an arc
/// length or a segment holds one turn farther, too.
#[derive(Clone, Debug)]
pub struct ContactBoundary {
    curve: Curve,
    /// +1 if the normal is the tangent turned right, -1 if turned left.
    side: f64,
    /// Parameters of the segment ends, ascending: one more than segments.
    knots: Vec<f64>,
    /// Arc length from the start to each segment end.
    arcs: Vec<f64>,
    /// Arc length from the start to the ends of pieces that are as long in the parameter.
    pieces: Vec<f64>,
    /// Length of one turn in the parameter, if the curve closes in itself.
    period: Option<f64>,
    /// What the plane that it lies in stands for.
    plane: Plane,
}

impl ContactBoundary {
    /// The part of `curve` between two parameters, as one segment; the normal at the middle has a positive part along `towards`.
    /// What is as long as the whole closed curve, or longer, is all of it.
    pub fn new(curve: Curve, range: [f64; 2], towards: Point) -> Self {
        let period = curve.period();
        let range = match period {
            Some(period) if range[1] - range[0] >= (1.0 - WHOLE) * period => [range[0], range[0] + period],
            _ => range,
        };
        let side = turn_right(curve.tangent(0.5 * (range[0] + range[1]))).dot(&towards).signum();
        let pieces = pieces(&curve, range);
        let arcs = vec![0.0, pieces[pieces.len() - 1]];
        Self { curve, side, knots: range.to_vec(), arcs, pieces, period, plane: Plane::default() }
    }

    /// The boundary in another plane.
    pub fn in_plane(self, plane: Plane) -> Self {
        Self { plane, ..self }
    }

    /// Whether it is turned about an axis of revolution.
    pub fn is_round(&self) -> bool {
        self.plane == Plane::Revolution
    }

    /// How far it extends across the plane at parameter `t` ([`Plane::width`]).
    pub fn width(&self, t: f64) -> f64 {
        self.plane.width(self.point(t))
    }

    /// How far bodies extend across the plane at a point beside it.
    pub fn width_at(&self, x: Point) -> f64 {
        self.plane.width(x)
    }

    /// Cuts it at these fractions of its arc length (from 0 to 1, ascending).
    pub fn cut(&mut self, fractions: &[f64]) {
        let (length, ends) = (self.length(), self.ends());
        let last = fractions.len() - 1;
        let knot = |(k, &fraction): (usize, &f64)| match k {
            0 => ends[0],
            k if k == last => ends[1],
            _ => self.parameter_at(fraction * length),
        };
        let knots: Vec<f64> = fractions.iter().enumerate().map(knot).collect();
        self.arcs = fractions.iter().map(|fraction| fraction * length).collect();
        self.knots = knots;
    }

    /// Arc length of the whole (length).
    pub fn length(&self) -> f64 {
        self.arcs[self.arcs.len() - 1]
    }

    /// Number of segments.
    pub fn segments(&self) -> usize {
        self.knots.len() - 1
    }

    /// Parameters of the segment ends.
    pub fn knots(&self) -> &[f64] {
        &self.knots
    }

    /// Parameters of its first and last point.
    pub fn ends(&self) -> [f64; 2] {
        [self.knots[0], self.knots[self.segments()]]
    }

    /// Arc lengths of the segment ends from the start.
    pub fn arcs(&self) -> &[f64] {
        &self.arcs
    }

    /// Whether it goes all around a closed curve, so that its end is its start.
    pub fn is_closed(&self) -> bool {
        let [first, last] = self.ends();
        self.period.is_some_and(|period| last - first > (1.0 - WHOLE) * period)
    }

    /// Arc length of one turn, if it is closed.
    pub fn turn(&self) -> Option<f64> {
        self.is_closed().then(|| self.length())
    }

    /// Arc length of segment `k`.
    pub fn segment_length(&self, k: usize) -> f64 {
        let [from, to] = self.segment_arcs(k);
        to - from
    }

    /// Arc lengths of the ends of segment `k`; beyond the last segment of a closed boundary its first ones follow.
    pub fn segment_arcs(&self, k: usize) -> [f64; 2] {
        let (turns, k) = (k / self.segments(), k % self.segments());
        [k, k + 1].map(|k| self.arcs[k] + turns as f64 * self.length())
    }

    /// Parameter at the fraction `z` (in the parameter) of segment `k`; beyond the last segment of a closed boundary its first ones
    /// follow.
    pub fn parameter_on(&self, k: usize, z: f64) -> f64 {
        let k = k % self.segments();
        self.knots[k] + z * (self.knots[k + 1] - self.knots[k])
    }

    /// Gauss points of some segments, `count` on each: segment, fraction of it (in the parameter) and arc length where one stands, and
    /// the length that it stands for.
    pub fn gauss_on(&self, segments: Range<usize>, count: usize) -> impl Iterator<Item = (usize, f64, f64, f64)> {
        segments.flat_map(move |k| {
            let [from, to] = self.segment_arcs(k);
            gauss_points(count).iter().map(move |(z, weight)| (k, *z, from + z * (to - from), weight * (to - from)))
        })
    }

    /// Gauss points of all segments in the parameter, `count` on each: segment, fraction of it and parameter where one stands, and the
    /// length that it stands for.
    pub fn gauss_by_parameter(&self, count: usize) -> impl Iterator<Item = (usize, f64, f64, f64)> {
        self.knots.windows(2).enumerate().flat_map(move |(k, ends)| {
            let at = move |z: f64| ends[0] + z * (ends[1] - ends[0]);
            gauss_points(count).iter().map(move |(z, weight)| (k, *z, at(*z), weight * (ends[1] - ends[0]) * self.speed(at(*z))))
        })
    }

    /// Whether it is a straight line by its kind.
    pub fn is_straight(&self) -> bool {
        self.curve.is_line()
    }

    /// Segment that holds parameter `t`, and the fraction (in the parameter) of the segment that lies before it.
    pub fn locate(&self, t: f64) -> (usize, f64) {
        let k = self.knots.partition_point(|&knot| knot <= t).clamp(1, self.segments()) - 1;
        (k, (t - self.knots[k]) / (self.knots[k + 1] - self.knots[k]))
    }

    /// Point at parameter `t`.
    pub fn point(&self, t: f64) -> Point {
        self.curve.point(t)
    }

    /// Unit normal at parameter `t`, from body 1 to body 2.
    pub fn normal(&self, t: f64) -> Point {
        turn_right(self.curve.tangent(t)) * self.side
    }

    /// Unit tangent at parameter `t`, the way on which the arc length grows.
    pub fn tangent(&self, t: f64) -> Point {
        self.curve.tangent(t)
    }

    /// Arc length per parameter.
    pub fn speed(&self, t: f64) -> f64 {
        self.curve.derivative(t).norm()
    }

    /// Parameter of the foot of `p`: the normal line there passes through `p`. May lie beyond the ends.
    pub fn foot(&self, p: Point) -> f64 {
        let t = self.curve.nearest(p);
        let [first, last] = self.ends();
        let middle = 0.5 * (first + last);
        self.period.map_or(t, |period| middle + nearest_turn(t - middle, period))
    }

    /// Parameter of about the nearest point of the curve, as few looks tell it.
    pub fn near(&self, p: Point) -> f64 {
        self.curve.nearly_nearest(p)
    }

    /// Feet of the two ends of an edge, in its direction; on a closed curve the edge is followed, not the long way round.
    pub fn directed_feet(&self, ends: [Point; 2]) -> [f64; 2] {
        let [a, b] = ends.map(|p| self.foot(p));
        [a, self.period.map_or(b, |period| a + nearest_turn(b - a, period))]
    }

    /// Feet of the two ends of an edge, lower first; on a closed curve the edge is followed, not the long way round.
    pub fn feet(&self, ends: [Point; 2]) -> [f64; 2] {
        let [a, b] = self.directed_feet(ends);
        [a.min(b), a.max(b)]
    }

    /// Parts of it that an edge between two points lies at, unclipped, ascending: on a closed curve an edge across the seam, or
    /// across both ends of a long arc, lies at two.
    pub fn parts(&self, ends: [Point; 2]) -> impl Iterator<Item = [f64; 2]> {
        let [from, to] = self.feet(ends);
        let [first, last] = self.ends();
        let turns = self.period.map_or([0.0; 3], |period| [-period, 0.0, period]);
        let count = if self.period.is_some() { 3 } else { 1 };
        turns
            .into_iter()
            .take(count)
            .map(move |turn| [from + turn, to + turn])
            .filter(move |part| part[0] < last && part[1] > first)
    }

    /// Parameter of one full turn, if the curve closes in itself.
    pub fn period(&self) -> Option<f64> {
        self.period
    }

    /// Arc length from the start to parameter `t`.
    pub fn arc(&self, t: f64) -> f64 {
        let (k, _) = self.locate(t);
        self.arcs[k] + arc_of(&self.curve, [self.knots[k], t])
    }

    /// Parameter at arc length `s` from the start, by Newton's method on one of its pieces.
    pub fn parameter_at(&self, s: f64) -> f64 {
        let [first, last] = self.ends();
        if is_even(&self.curve) {
            return first + s / self.speed(first);
        }
        let turn = self.turn().map_or(0.0, |length| (s / length).floor());
        let s = s - turn * self.length();
        let count = self.pieces.len() - 1;
        let piece = self.pieces.partition_point(|&arc| arc <= s).clamp(1, count) - 1;
        let parameter = |k: usize| first + (last - first) * k as f64 / count as f64;
        let [from, to] = [self.pieces[piece], self.pieces[piece + 1]];
        let start = parameter(piece);
        let mut t = start + (parameter(piece + 1) - start) * (s - from) / (to - from);
        for _ in 0..MOST_STEPS {
            let step = (s - from - arc_of(&self.curve, [start, t])) / self.speed(t);
            t += step;
            if step.abs() <= ROUNDED * first.abs().max(last.abs()).max(last - first) {
                break;
            }
        }
        t + turn * self.period.unwrap_or(0.0)
    }
}

/// Whether arc lengths go with the parameter.
fn is_even(curve: &Curve) -> bool {
    matches!(curve, Curve::Line(_) | Curve::Circle { .. })
}

/// Arc length between two parameters that lie near each other, by 16 Gauss points.
fn arc_of(curve: &Curve, [from, to]: [f64; 2]) -> f64 {
    let speed = |t: f64| curve.derivative(t).norm();
    gauss_points(16).iter().map(|(x, w)| w * (to - from) * speed(from + (to - from) * x)).sum()
}

/// Arc lengths from the start of a range to the ends of its pieces, all as long in the parameter: one, where these lengths go with it.
fn pieces(curve: &Curve, [first, last]: [f64; 2]) -> Vec<f64> {
    if is_even(curve) {
        return vec![0.0, (last - first) * curve.derivative(first).norm()];
    }
    let end = |k: usize| first + (last - first) * k as f64 / PIECES as f64;
    let mut arcs = vec![0.0; PIECES + 1];
    (0..PIECES).for_each(|k| arcs[k + 1] = arcs[k] + arc_of(curve, [end(k), end(k + 1)]));
    arcs
}

/// What is left of a way in a parameter without whole turns: at most half of one, in either direction.
fn nearest_turn(way: f64, period: f64) -> f64 {
    (way + 0.5 * period).rem_euclid(period) - 0.5 * period
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Formula, ParametricCurve};

    fn on_circle(angle: f64) -> Point {
        Point::new(1.0 + 2.0 * angle.cos(), 2.0 * angle.sin())
    }

    fn circle(range: [f64; 2]) -> ContactBoundary {
        ContactBoundary::new(Curve::Circle { centre: [1.0, 0.0], radius: 2.0 }, range, Point::new(-1.0, 0.0))
    }

    /// The same circle as formulas, begun at the top and run through in the other direction.
    fn formulas() -> ContactBoundary {
        let read = |text| Formula::parse(text, &["t"]).expect("a formula");
        let curve =
            Curve::Parametric(ParametricCurve::new(read("1 + 2*sin(2*t)"), read("2*cos(2*t)"), [0.0, std::f64::consts::PI]));
        ContactBoundary::new(curve, [0.0, std::f64::consts::PI], Point::new(0.0, -1.0))
    }

    #[test]
    fn a_whole_circle_is_closed_wherever_it_begins() {
        use std::f64::consts::TAU;
        for from in [0.0, -3.0, 5.0] {
            let mut boundary = circle([from, from + TAU]);
            assert!(
                boundary.is_closed() && circle([from, from + 8.0]).is_closed() && !circle([from, from + 0.999 * TAU]).is_closed()
            );
            boundary.cut(&[0.0, 0.1, 0.5, 1.0]);
            assert!((boundary.length() - 2.0 * TAU).abs() < 1e-12);
            for k in 0..3 {
                let [here, farther] = [k, k + 3].map(|k| boundary.segment_arcs(k));
                assert!((farther[0] - here[0] - 2.0 * TAU).abs() < 1e-12 && (farther[1] - here[1] - 2.0 * TAU).abs() < 1e-12);
                assert_eq!(boundary.parameter_on(k, 0.3), boundary.parameter_on(k + 3, 0.3));
                // Along a zone that goes on across the seam.
                let [a, b] = [here[0] + 0.1, farther[0] + 0.1].map(|s| boundary.point(boundary.parameter_at(s)));
                assert!((a - b).norm() < 1e-12);
            }
        }
        let closed = formulas();
        assert!(closed.is_closed() && (closed.length() - 2.0 * TAU).abs() < 1e-12);
        assert_eq!(closed.period(), Some(std::f64::consts::PI));
        assert!(!parabola().is_closed() && parabola().turn().is_none());
    }

    #[test]
    fn an_edge_across_the_seam_lies_at_both_ends() {
        for boundary in [circle([0.0, 7.0]), circle([-2.0, 5.0]), formulas()] {
            let (first, last) = (boundary.knots()[0], boundary.knots()[1]);
            let all = (0..10).map(|k| [k, k + 1].map(|k| on_circle(0.2 + std::f64::consts::TAU * f64::from(k) / 10.0)));
            let mut parts: Vec<[f64; 2]> = all.flat_map(|ends| boundary.parts(ends).collect::<Vec<_>>()).collect();
            assert_eq!(parts.len(), 11, "{parts:?}");
            parts.sort_by(|a, b| a[0].total_cmp(&b[0]));
            assert!(parts[0][0] < first && parts[10][1] > last);
            assert!(parts.windows(2).all(|two| (two[0][1] - two[1][0]).abs() < 1e-9), "{parts:?}");
        }
        // Both ends of an arc, nearer to each other than the edge is long.
        let arc = circle([0.05, std::f64::consts::TAU - 0.05]);
        assert_eq!(arc.parts([on_circle(0.2), on_circle(-0.2)]).count(), 2);
        assert_eq!(arc.parts([on_circle(0.2), on_circle(0.4)]).count(), 1);
        let ends = [on_circle(0.4), on_circle(0.2)];
        assert!((arc.directed_feet(ends)[0] - arc.directed_feet(ends)[1] - 0.2).abs() < 1e-12);
    }

    fn parabola() -> ContactBoundary {
        let read = |text| Formula::parse(text, &["t"]).expect("a formula");
        let curve = Curve::Parametric(ParametricCurve::new(read("t"), read("4 + t - 0.25*t^2"), [0.0, 4.0]));
        ContactBoundary::new(curve, [0.0, 4.0], Point::new(0.0, 1.0))
    }

    #[test]
    fn the_arc_length_of_a_parabola_is_the_known_one() {
        // x from -2 to 2, slope -x/2: 2 (sqrt(2) + asinh(1)).
        let exact = 2.0 * (2f64.sqrt() + 1f64.asinh());
        assert!((parabola().length() / exact - 1.0).abs() < 1e-14);
    }

    #[test]
    fn cutting_gives_segments_of_the_wanted_length() {
        let mut boundary = parabola();
        boundary.cut(&[0.0, 0.1, 0.4, 1.0]);
        let length = boundary.length();
        for (t, fraction) in boundary.knots().iter().zip([0.0, 0.1, 0.4, 1.0]) {
            assert!((boundary.arc(*t) - fraction * length).abs() < 1e-13);
        }
        assert_eq!(boundary.locate(boundary.knots()[2] + 1e-9).0, 2);
        assert_eq!(boundary.locate(-1.0).0, 0);
    }

    #[test]
    fn the_normal_points_from_body_1_to_body_2() {
        let up = parabola();
        assert!(up.normal(3.0).y > 0.0);
        let line = Curve::Line([[6.0, 4.0], [0.0, 3.0]]);
        assert!(ContactBoundary::new(line, [0.0, 1.0], Point::new(0.0, 1.0)).normal(0.5).y > 0.0);
    }
}
