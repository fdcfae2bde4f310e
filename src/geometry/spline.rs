//! Parametric cubic splines: through points, or fitted to them.

use super::Point;
use nalgebra::DMatrix;

/// A twice continuously differentiable piecewise cubic curve.
#[derive(Clone, Debug, PartialEq)]
pub struct Spline {
    /// Parameters of the span ends, ascending.
    knots: Vec<f64>,
    /// For each span the coefficients of 1, τ, τ², τ³ with τ = t - knot.
    spans: Vec<[Point; 4]>,
    /// Whether it ends where it begins, as smooth there as elsewhere.
    closed: bool,
    /// Points of it, equally many in each span, from which the nearest one to another point is looked for.
    points: Vec<Point>,
}

/// Spans of a spline which each turn so little that their ends are points enough to look for a nearest one.
const MANY: usize = 16;

/// Points for each span of a spline of fewer.
const IN_A_SPAN: usize = 4;

impl Spline {
    /// The spline through `points`, in their order, with the length of the chords as its parameter; at the second
    /// point from each end the third derivative is continuous too ("not a knot"), so that it is of fourth order up to
    /// its ends. Two points give a line, three a parabola.
    ///
    /// # Panics
    /// If there are fewer than two points.
    pub fn through(points: &[Point]) -> Self {
        Self::through_at(chord_lengths(points), points)
    }

    /// The same with given parameters, ascending, one for each point.
    ///
    /// # Panics
    /// If there are fewer than two points, or not as many parameters.
    pub fn through_at(knots: Vec<f64>, points: &[Point]) -> Self {
        assert!(points.len() > 1 && points.len() == knots.len(), "a spline needs two points, each with a parameter");
        let curvature = curvatures(&knots, points);
        Self::with_curvatures(knots, points, &curvature, false)
    }

    /// The closed spline through `points`, of which the last is the first again, each with a parameter, ascending.
    ///
    /// # Panics
    /// If there are fewer than four points (three places), or not as many parameters.
    pub fn through_closed_at(knots: Vec<f64>, points: &[Point]) -> Self {
        assert!(points.len() > 3 && points.len() == knots.len(), "a closed spline needs three places, each with a parameter");
        let curvature = closed_curvatures(&knots, points);
        Self::with_curvatures(knots, points, &curvature, true)
    }

    /// The same spline at another place.
    pub fn moved(mut self, by: Point) -> Self {
        self.spans.iter_mut().map(|span| &mut span[0]).chain(&mut self.points).for_each(|point| *point += by);
        self
    }

    /// The same with the length of the chords as its parameter.
    ///
    /// # Panics
    /// If there are fewer than four points.
    pub fn through_closed(points: &[Point]) -> Self {
        Self::through_closed_at(chord_lengths(points), points)
    }

    fn with_curvatures(knots: Vec<f64>, points: &[Point], curvature: &[Point], closed: bool) -> Self {
        let span = |k: usize| {
            let h = knots[k + 1] - knots[k];
            let (m0, m1) = (curvature[k], curvature[k + 1]);
            let slope = (points[k + 1] - points[k]) / h - h / 6.0 * (2.0 * m0 + m1);
            [points[k], slope, 0.5 * m0, (m1 - m0) / (6.0 * h)]
        };
        let spans = (0..points.len() - 1).map(span).collect();
        Self::of_spans(knots, spans, closed)
    }

    fn of_spans(knots: Vec<f64>, spans: Vec<[Point; 4]>, closed: bool) -> Self {
        let mut spline = Self { knots, spans, closed, points: Vec::new() };
        spline.points = (0..=spline.parts()).map(|k| spline.point(spline.part_end(k))).collect();
        spline
    }

    /// The spline with `spans` equal spans over the parameters of `samples` that is nearest to them in the weighted
    /// mean square. Samples are `(parameter, point, weight)`; samples on a straight line whose parameter is its length
    /// give that line to rounding.
    ///
    /// # Panics
    /// If there are fewer than two samples or no span.
    pub fn fit(samples: &[(f64, Point, f64)], spans: usize) -> Self {
        assert!(samples.len() > 1 && spans > 0, "a fit needs samples and spans");
        let first = samples.iter().map(|sample| sample.0).fold(f64::INFINITY, f64::min);
        let last = samples.iter().map(|sample| sample.0).fold(f64::NEG_INFINITY, f64::max);
        let width = (last - first) / spans as f64;
        let count = spans + 3;
        let (mut normal, mut right) = (DMatrix::<f64>::zeros(count, count), DMatrix::<f64>::zeros(count, 2));
        // The fit is one to the difference from the chord, so that straight data stay straight.
        let chord = chord(samples);
        for &(t, point, weight) in samples {
            let k = (((t - first) / width) as usize).min(spans - 1);
            let values = basis((t - first) / width - k as f64);
            let rest = point - chord(t);
            for (a, &left) in values.iter().enumerate() {
                for (b, &value) in values.iter().enumerate() {
                    normal[(k + a, k + b)] += weight * left * value;
                }
                right[(k + a, 0)] += weight * left * rest.x;
                right[(k + a, 1)] += weight * left * rest.y;
            }
        }
        smooth(&mut normal);
        let control = normal.cholesky().map_or(DMatrix::zeros(count, 2), |factor| factor.solve(&right));
        let at = |i: usize| Point::new(control[(i, 0)], control[(i, 1)]);
        let knots: Vec<f64> = (0..=spans).map(|k| first + width * k as f64).collect();
        let span = |k: usize| {
            let line = (chord(knots[k]), (chord(last) - chord(first)) / (last - first));
            let [place, slope, second, third] = of_controls([0, 1, 2, 3].map(|i| at(k + i)), width);
            [line.0 + place, line.1 + slope, second, third]
        };
        let spans = (0..spans).map(span).collect();
        Self::of_spans(knots, spans, false)
    }

    /// The closed spline with `spans` equal spans over the parameters from 0 to `period` that is nearest to samples in the
    /// weighted mean square; samples are `(parameter, point, weight)`, with any parameter.
    ///
    /// # Panics
    /// If there are no samples, or fewer than four spans.
    pub fn fit_closed(samples: &[(f64, Point, f64)], spans: usize, period: f64) -> Self {
        assert!(!samples.is_empty() && spans > 3, "a closed fit needs samples and four spans");
        let width = period / spans as f64;
        let total: f64 = samples.iter().map(|sample| sample.2).sum();
        let mean = samples.iter().fold(Point::zeros(), |sum, (_, x, w)| sum + *w * x) / total;
        let (mut normal, mut right) = (DMatrix::<f64>::zeros(spans, spans), DMatrix::<f64>::zeros(spans, 2));
        for &(t, point, weight) in samples {
            let t = t.rem_euclid(period) / width;
            let k = (t as usize).min(spans - 1);
            let values = basis(t - k as f64);
            let rest = point - mean;
            for (a, &left) in values.iter().enumerate() {
                let row = (k + a) % spans;
                values.iter().enumerate().for_each(|(b, &value)| normal[(row, (k + b) % spans)] += weight * left * value);
                right[(row, 0)] += weight * left * rest.x;
                right[(row, 1)] += weight * left * rest.y;
            }
        }
        smooth_around(&mut normal);
        let control = normal.cholesky().map_or(DMatrix::zeros(spans, 2), |factor| factor.solve(&right));
        let at = |i: usize| mean + Point::new(control[(i % spans, 0)], control[(i % spans, 1)]);
        let span = |k: usize| of_controls([0, 1, 2, 3].map(|i| at(k + i)), width);
        let knots = (0..=spans).map(|k| width * k as f64).collect();
        Self::of_spans(knots, (0..spans).map(span).collect(), true)
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

    /// Number of equal parts of its spans, of which each turns little.
    pub fn parts(&self) -> usize {
        self.spans.len() * if self.spans.len() < MANY { IN_A_SPAN } else { 1 }
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
        let away = |k: &usize| (self.points[*k] - p).norm_squared();
        let nearest = (0..self.points.len()).min_by(|a, b| away(a).total_cmp(&away(b)));
        self.part_end(nearest.unwrap_or(0))
    }

    fn span(&self, t: f64) -> (&[Point; 4], f64) {
        let k = self.knots.partition_point(|&knot| knot <= t).clamp(1, self.spans.len()) - 1;
        (&self.spans[k], t - self.knots[k])
    }

    /// Point at parameter `t`; beyond its ends an open spline goes on along its tangents, and a closed one begins again.
    pub fn point(&self, t: f64) -> Point {
        self.point_and_derivative(t)[0]
    }

    /// Point and derivative at once.
    pub fn point_and_derivative(&self, t: f64) -> [Point; 2] {
        let inside = self.inside(t);
        let (&[a, b, c, d], tau) = self.span(inside);
        let (point, slope) = (a + tau * (b + tau * (c + tau * d)), b + tau * (2.0 * c + 3.0 * tau * d));
        [if t == inside || self.closed { point } else { point + (t - inside) * slope }, slope]
    }

    /// Derivative of the point by the parameter.
    pub fn derivative(&self, t: f64) -> Point {
        let (&[_, b, c, d], tau) = self.span(self.inside(t));
        b + tau * (2.0 * c + 3.0 * tau * d)
    }
}

/// Length of the polygon through `points` up to each of them.
pub fn chord_lengths(points: &[Point]) -> Vec<f64> {
    let mut lengths = vec![0.0];
    for pair in points.windows(2) {
        lengths.push(lengths[lengths.len() - 1] + (pair[1] - pair[0]).norm());
    }
    lengths
}

/// The line from the mean of the samples along their regression on the parameter.
fn chord(samples: &[(f64, Point, f64)]) -> impl Fn(f64) -> Point + Copy {
    let total: f64 = samples.iter().map(|sample| sample.2).sum();
    let middle = samples.iter().map(|(t, _, w)| w * t).sum::<f64>() / total;
    let mean = samples.iter().fold(Point::zeros(), |sum, (_, x, w)| sum + *w * x) / total;
    let spread: f64 = samples.iter().map(|(t, _, w)| w * (t - middle).powi(2)).sum();
    let slope = samples.iter().fold(Point::zeros(), |sum, (t, x, w)| sum + w * (t - middle) * (x - mean)) / spread;
    move |t: f64| mean + (t - middle) * slope
}

/// Uniform cubic B-spline values on one span, at the fraction `z`.
fn basis(z: f64) -> [f64; 4] {
    let y = 1.0 - z;
    [y.powi(3) / 6.0, (3.0 * z.powi(3) - 6.0 * z * z + 4.0) / 6.0, (3.0 * y.powi(3) - 6.0 * y * y + 4.0) / 6.0, z.powi(3) / 6.0]
}

/// Coefficients of 1, τ, τ², τ³ on a span of this width, from the four controls of uniform cubic B-splines there.
fn of_controls([a, b, c, d]: [Point; 4], width: f64) -> [Point; 4] {
    [
        (a + 4.0 * b + c) / 6.0,
        (c - a) / (2.0 * width),
        (a - 2.0 * b + c) / (2.0 * width * width),
        (d - a + 3.0 * (b - c)) / (6.0 * width.powi(3)),
    ]
}

/// Third differences of four controls.
const THIRD: [f64; 4] = [-1.0, 3.0, -3.0, 1.0];

/// A trace of a penalty on third differences: spans without samples are bridged smoothly.
fn smooth(normal: &mut DMatrix<f64>) {
    let last = normal.nrows() - 3;
    penalise(normal, 0..last);
}

/// The same on controls that go round.
fn smooth_around(normal: &mut DMatrix<f64>) {
    let all = 0..normal.nrows();
    penalise(normal, all);
}

/// Penalises the third differences that begin at these controls.
fn penalise(normal: &mut DMatrix<f64>, firsts: std::ops::Range<usize>) {
    let count = normal.nrows();
    let scale = 1e-9 * normal.diagonal().max();
    for k in firsts {
        for (a, left) in THIRD.iter().enumerate() {
            for (b, right) in THIRD.iter().enumerate() {
                normal[((k + a) % count, (k + b) % count)] += scale * left * right;
            }
        }
    }
    for i in 0..count {
        normal[(i, i)] += 1e-6 * scale;
    }
}

/// Second derivatives at the knots of the spline through points.
fn curvatures(knots: &[f64], points: &[Point]) -> Vec<Point> {
    let n = points.len();
    if n == 2 {
        return vec![Point::zeros(); 2];
    }
    let h = |k: usize| knots[k + 1] - knots[k];
    let slope = |k: usize| (points[k + 1] - points[k]) / h(k);
    if n == 3 {
        return vec![2.0 * (slope(1) - slope(0)) / (h(0) + h(1)); 3];
    }
    // Rows `lower, middle, upper | right` of the inner knots; the end ones follow from their neighbours.
    let mut rows: Vec<([f64; 3], Point)> =
        (1..n - 1).map(|k| ([h(k - 1), 2.0 * (h(k - 1) + h(k)), h(k)], 6.0 * (slope(k) - slope(k - 1)))).collect();
    let last = rows.len() - 1;
    // m₀ = ((h₀ + h₁) m₁ - h₀ m₂) / h₁, and its mirror image.
    let ends = [[h(0), h(1)], [h(n - 2), h(n - 3)]];
    for (row, [near, far], [outer, inner]) in [(0, ends[0], [0, 2]), (last, ends[1], [2, 0])] {
        let entry = rows[row].0[outer];
        rows[row].0[1] += entry * (near + far) / far;
        rows[row].0[inner] -= entry * near / far;
    }
    for k in 1..=last {
        let ([_, middle, upper], right) = rows[k - 1];
        let factor = rows[k].0[0] / middle;
        rows[k].0[1] -= factor * upper;
        rows[k].1 -= factor * right;
    }
    let mut m = vec![Point::zeros(); n];
    for k in (0..=last).rev() {
        let ([_, middle, upper], right) = rows[k];
        m[k + 1] = if k == last { right / middle } else { (right - upper * m[k + 2]) / middle };
    }
    for (end, next, beyond, [near, far]) in [(0, 1, 2, ends[0]), (n - 1, n - 2, n - 3, ends[1])] {
        m[end] = ((near + far) * m[next] - near * m[beyond]) / far;
    }
    m
}

/// The same of a closed spline through points, of which the last is the first again: a cyclic system of three diagonals, solved
/// by the formula of Sherman and Morrison.
fn closed_curvatures(knots: &[f64], points: &[Point]) -> Vec<Point> {
    let n = points.len() - 1;
    let h = |k: usize| knots[k % n + 1] - knots[k % n];
    let slope = |k: usize| (points[k % n + 1] - points[k % n]) / h(k);
    let corner = h(n - 1);
    // Without the two corners, which are taken off the ends of the diagonal by a product of two vectors.
    let shift = -2.0 * (h(n - 1) + h(0));
    let diagonal = |k: usize| {
        let whole = 2.0 * (h(k + n - 1) + h(k));
        match k {
            0 => whole - shift,
            k if k == n - 1 => whole - corner * corner / shift,
            _ => whole,
        }
    };
    let right = |k: usize| 6.0 * (slope(k) - slope(k + n - 1));
    let solve = |right: &dyn Fn(usize) -> Point| {
        let (mut middle, mut values) = (Vec::with_capacity(n), Vec::with_capacity(n));
        for k in 0..n {
            let factor = if k == 0 { 0.0 } else { h(k - 1) / middle[k - 1] };
            middle.push(diagonal(k) - if k == 0 { 0.0 } else { factor * h(k - 1) });
            values.push(if k == 0 { right(0) } else { right(k) - factor * values[k - 1] });
        }
        for k in (0..n).rev() {
            let next = if k + 1 < n { h(k) * values[k + 1] } else { Point::zeros() };
            values[k] = (values[k] - next) / middle[k];
        }
        values
    };
    let base = solve(&right);
    let ends = |k: usize| match k {
        0 => Point::new(shift, 0.0),
        k if k == n - 1 => Point::new(corner, 0.0),
        _ => Point::zeros(),
    };
    let by = solve(&ends);
    let share = (base[0] + corner / shift * base[n - 1]) / (1.0 + by[0].x + corner / shift * by[n - 1].x);
    (0..=n).map(|k| base[k % n] - by[k % n].x * share).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn arc(count: usize) -> Vec<Point> {
        (0..=count).map(|k| 1.5 * k as f64 / count as f64).map(|a| Point::new(2.0 * a.cos(), 2.0 * a.sin())).collect()
    }

    /// Largest distance from the circle of radius 2.
    fn off(spline: &Spline) -> f64 {
        let [first, last] = spline.range();
        (0..=500).map(|k| (spline.point(first + (last - first) * k as f64 / 500.0).norm() - 2.0).abs()).fold(0.0, f64::max)
    }

    #[test]
    fn the_spline_through_an_arc_is_of_fourth_order() {
        let errors = [8, 16, 32].map(|count| off(&Spline::through(&arc(count))));
        for pair in errors.windows(2) {
            assert!((pair[0] / pair[1]).log2() > 3.7, "{errors:?}");
        }
        for (k, point) in arc(8).iter().enumerate() {
            let spline = Spline::through(&arc(8));
            assert!((spline.point(spline.knots[k]) - point).norm() < 1e-14);
        }
    }

    #[test]
    fn straight_data_stay_straight() {
        let line = |t: f64| Point::new(1.0 + 0.6 * t, 3.0 + 0.8 * t);
        let samples: Vec<(f64, Point, f64)> = [0.0, 0.1, 0.35, 0.5, 1.2, 1.3, 2.0].map(|t| (t, line(t), 0.3 + t)).to_vec();
        let fit = Spline::fit(&samples, 5);
        let points: Vec<Point> = samples.iter().map(|sample| sample.1).collect();
        let through = Spline::through(&points);
        for t in [0.0, 0.2, 0.77, 1.9, 2.0] {
            assert!((fit.point(t) - line(t)).norm() < 1e-13 && (through.point(t) - line(t)).norm() < 1e-13);
            assert!((fit.derivative(t) - Point::new(0.6, 0.8)).norm() < 1e-12);
        }
    }

    #[test]
    fn a_fit_with_more_spans_is_nearer_to_a_circle() {
        let samples: Vec<(f64, Point, f64)> = (0..=200)
            .map(|k| 1.5 * f64::from(k) / 200.0)
            .map(|a| (2.0 * a, Point::new(2.0 * a.cos(), 2.0 * a.sin()), 1.0))
            .collect();
        let errors = [2, 4, 8].map(|spans| off(&Spline::fit(&samples, spans)));
        assert!(errors[0] < 5e-3 && errors[1] < errors[0] / 8.0 && errors[2] < errors[1] / 8.0, "{errors:?}");
    }

    /// Points of the circle of radius 2, unevenly spaced, the last the first again.
    fn circle(count: usize) -> Vec<Point> {
        let turn = |k: usize| std::f64::consts::TAU * (k as f64 + 0.3 * (k as f64).sin()) / count as f64;
        let at = |a: f64| Point::new(2.0 * a.cos(), 2.0 * a.sin());
        (0..count).map(turn).chain([turn(0)]).map(at).collect()
    }

    #[test]
    fn a_closed_spline_is_of_fourth_order_and_as_smooth_at_its_seam_as_elsewhere() {
        let errors = [10, 20, 40].map(|count| off(&Spline::through_closed(&circle(count))));
        for pair in errors.windows(2) {
            assert!((pair[0] / pair[1]).log2() > 3.4, "{errors:?}");
        }
        let points = circle(12);
        let spline = Spline::through_closed(&points);
        for (t, point) in spline.knots.iter().zip(&points) {
            assert!((spline.point(*t) - point).norm() < 1e-13);
        }
        // Begun at another point it is the same curve.
        let turned: Vec<Point> = (0..=12).map(|k| points[(k + 5) % 12]).collect();
        let other = Spline::through_closed(&turned);
        let period = spline.period().expect("closed");
        for k in 0..50 {
            let t = 0.7 * f64::from(k) - 9.0;
            assert!((spline.point(t + spline.knots[5]) - other.point(t)).norm() < 1e-12);
            assert!((spline.derivative(t + period) - spline.derivative(t)).norm() < 1e-12);
        }
    }

    #[test]
    fn a_closed_fit_is_a_circle_wherever_its_samples_begin() {
        let samples = |from: f64| -> Vec<(f64, Point, f64)> {
            let sample = |k: usize| from + std::f64::consts::TAU * (k as f64 + 0.2 * (k as f64).cos()) / 200.0;
            (0..200).map(sample).map(|a| (2.0 * a, Point::new(1.0 + 2.0 * a.cos(), 2.0 * a.sin()), 0.1)).collect()
        };
        let period = 2.0 * std::f64::consts::TAU;
        let away = |spline: &Spline| {
            let at = |k: usize| (spline.point(period * k as f64 / 500.0) - Point::new(1.0, 0.0)).norm() - 2.0;
            (0..500).map(at).map(f64::abs).fold(0.0, f64::max)
        };
        let errors = [8, 16, 32].map(|spans| away(&Spline::fit_closed(&samples(0.0), spans, period)));
        assert!(errors[0] < 5e-3 && errors[1] < errors[0] / 10.0 && errors[2] < errors[1] / 10.0, "{errors:?}");
        let [one, other] = [0.0, 40.0].map(|from| Spline::fit_closed(&samples(from), 16, period));
        for k in 0..40 {
            let t = 0.9 * f64::from(k);
            assert!((one.point(t) - other.point(t)).norm() < 1e-4);
        }
    }
}
