//! Parametric cubic splines: `through` points in `interpolation.rs`, with their mirror images in `mirrored.rs`, fitted to samples in
//! `least_squares.rs`.

mod interpolation;
mod least_squares;
mod mirrored;

pub use interpolation::chord_lengths;
pub use least_squares::FitSample;

use super::Point;
use super::point_row::PointRow;

/// A twice continuously differentiable piecewise cubic curve.
#[derive(Clone, Debug, PartialEq)]
pub struct Spline {
    /// Parameters of the span ends, ascending.
    knots: Vec<f64>,
    /// For each span the coefficients of 1, τ, τ², τ³ with τ = t - knot.
    spans: Vec<[Point; 4]>,
    /// Whether it ends where it begins, as smooth there as elsewhere.
    closed: bool,
    /// Directions of the lines of symmetry through its ends, where it goes on as its own image.
    mirrors: [Option<Point>; 2],
    /// Points of it, equally many in each span, from which the nearest one to another point is looked for.
    points: PointRow,
}

/// Spans of a spline which each turn so little that their ends are points enough to look for a nearest one.
const ENOUGH_SPANS: usize = 16;

/// Points in each span of a spline of fewer than [`ENOUGH_SPANS`].
const POINTS_IN_A_SPAN: usize = 4;

impl Spline {
    /// The spline of spans with these coefficients, between knots of which there is one more.
    fn of_spans(knots: Vec<f64>, spans: Vec<[Point; 4]>, closed: bool) -> Self {
        let mut spline = Self { knots, spans, closed, mirrors: [None; 2], points: PointRow::default() };
        let (in_a_span, last) = (spline.parts() / spline.spans.len(), spline.knots.len() - 1);
        let part = |k: usize| at(&spline.spans[k / in_a_span], spline.part_end(k) - spline.knots[k / in_a_span])[0];
        let end = at(&spline.spans[last - 1], spline.knots[last] - spline.knots[last - 1])[0];
        spline.points = PointRow::new((0..spline.parts()).map(part).chain([end]).collect());
        spline
    }

    /// The spline shifted by a vector (length).
    pub fn moved(mut self, by: Point) -> Self {
        self.spans.iter_mut().for_each(|span| span[0] += by);
        self.points.shift(by);
        self
    }

    /// Length of one turn in the parameter, if it is closed.
    pub fn period(&self) -> Option<f64> {
        let [first, last] = self.range();
        self.closed.then_some(last - first)
    }

    /// The parameter within the range that stands for `t`: of an open spline the nearest one.
    fn inside(&self, t: f64) -> f64 {
        let [first, last] = self.range();
        match self.closed {
            true if !(first..=last).contains(&t) => first + (t - first).rem_euclid(last - first),
            true => t,
            false => t.clamp(first, last),
        }
    }

    /// Whether a step from `t` stays on the tangent at an end, along which an open spline goes on.
    pub fn goes_on_straight(&self, t: f64, step: f64) -> bool {
        let [first, last] = self.range();
        !self.closed && (t >= last && step > 0.0 || t <= first && step < 0.0)
    }

    /// Number of equal parts of its spans, of which each turns little.
    pub fn parts(&self) -> usize {
        self.spans.len() * if self.spans.len() < ENOUGH_SPANS { POINTS_IN_A_SPAN } else { 1 }
    }

    /// Parameter at which part `k` begins, or the last one ends.
    fn part_end(&self, k: usize) -> f64 {
        let (in_a_span, last) = (self.parts() / self.spans.len(), self.spans.len() - 1);
        let span = (k / in_a_span).min(last);
        let share = (k - span * in_a_span) as f64 / in_a_span as f64;
        self.knots[span] + share * (self.knots[span + 1] - self.knots[span])
    }

    /// Parameters of the span ends, ascending.
    pub fn knots(&self) -> &[f64] {
        &self.knots
    }

    /// First and last parameter.
    pub fn range(&self) -> [f64; 2] {
        [self.knots[0], self.knots[self.knots.len() - 1]]
    }

    /// Parameter of the end of a part that is nearest to `p`.
    pub fn nearest_part_end(&self, p: Point) -> f64 {
        self.part_end(self.points.nearest(p))
    }

    /// The span at a parameter within the range, found from where it would be among even ones.
    fn span(&self, t: f64) -> (&[Point; 4], f64) {
        let ([first, last], count) = (self.range(), self.spans.len());
        let even = ((t - first) / (last - first) * count as f64) as usize;
        let is_in = |k: &usize| self.knots[*k] <= t && t < self.knots[*k + 1];
        let near = even.saturating_sub(1)..(even + 2).min(count);
        let k = near.into_iter().find(is_in);
        let k = k.unwrap_or_else(|| self.knots.partition_point(|&knot| knot <= t).clamp(1, count) - 1);
        (&self.spans[k], t - self.knots[k])
    }

    /// Point at parameter `t`; beyond its ends an open spline goes on along its tangents, and a closed one begins again.
    pub fn point(&self, t: f64) -> Point {
        self.point_and_derivative(t)[0]
    }

    /// Point and derivative at once.
    pub fn point_and_derivative(&self, t: f64) -> [Point; 2] {
        let inside = self.inside(t);
        let (span, tau) = self.span(inside);
        let [point, slope] = at(span, tau);
        [if t == inside || self.closed { point } else { point + (t - inside) * slope }, slope]
    }

    /// Derivative of the point by the parameter.
    pub fn derivative(&self, t: f64) -> Point {
        let (span, tau) = self.span(self.inside(t));
        at(span, tau)[1]
    }
}

/// Point and derivative on a span, of its own parameter.
fn at(&[a, b, c, d]: &[Point; 4], tau: f64) -> [Point; 2] {
    [a + tau * (b + tau * (c + tau * d)), b + tau * (2.0 * c + 3.0 * tau * d)]
}
