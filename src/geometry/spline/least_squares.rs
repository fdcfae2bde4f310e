//! Splines of equal spans that are nearest to samples in the weighted mean square: uniform cubic B-splines.

use super::Spline;
use crate::geometry::Point;
use nalgebra::DMatrix;
use std::ops::Range;

/// A sample that a spline is fitted to: parameter, point, weight.
pub type FitSample = (f64, Point, f64);

/// Third differences of four controls.
const THIRD: [f64; 4] = [-1.0, 3.0, -3.0, 1.0];

impl Spline {
    /// The spline with `spans` equal spans over the parameters of `samples` that is nearest to them in the weighted
    /// mean square. Samples on a straight line whose parameter is its length give that line to rounding.
    ///
    /// # Panics
    /// If there are fewer than two samples or no span.
    pub fn fit(samples: &[FitSample], spans: usize) -> Self {
        assert!(samples.len() > 1 && spans > 0, "a fit needs samples and spans");
        let first = samples.iter().map(|sample| sample.0).fold(f64::INFINITY, f64::min);
        let last = samples.iter().map(|sample| sample.0).fold(f64::NEG_INFINITY, f64::max);
        // The fit is one to the difference from the chord, so that straight data stay straight.
        let (width, chord) = ((last - first) / spans as f64, chord(samples));
        let mut equations = NormalEquations::new(spans + 3);
        for &(t, point, weight) in samples {
            let k = (((t - first) / width) as usize).min(spans - 1);
            equations.add(k, (t - first) / width - k as f64, point - chord(t), weight);
        }
        let control = equations.controls(0..spans);
        let knots: Vec<f64> = (0..=spans).map(|k| first + width * k as f64).collect();
        let span = |k: usize| {
            let line = (chord(knots[k]), (chord(last) - chord(first)) / (last - first));
            let [place, slope, second, third] = of_controls([0, 1, 2, 3].map(|i| control(k + i)), width);
            [line.0 + place, line.1 + slope, second, third]
        };
        let spans = (0..spans).map(span).collect();
        Self::of_spans(knots, spans, false)
    }

    /// The closed spline with `spans` equal spans over the parameters from 0 to `period` that is nearest to samples in the
    /// weighted mean square; samples may have any parameter.
    ///
    /// # Panics
    /// If there are no samples, or fewer than four spans.
    pub fn fit_closed(samples: &[FitSample], spans: usize, period: f64) -> Self {
        assert!(!samples.is_empty() && spans > 3, "a closed fit needs samples and four spans");
        let width = period / spans as f64;
        let mean = mean(samples);
        let mut equations = NormalEquations::new(spans);
        for &(t, point, weight) in samples {
            let t = t.rem_euclid(period) / width;
            let k = (t as usize).min(spans - 1);
            equations.add(k, t - k as f64, point - mean, weight);
        }
        let control = equations.controls(0..spans);
        let span = |k: usize| of_controls([0, 1, 2, 3].map(|i| mean + control(k + i)), width);
        let knots = (0..=spans).map(|k| width * k as f64).collect();
        Self::of_spans(knots, (0..spans).map(span).collect(), true)
    }
}

/// Normal equations of the controls of uniform cubic B-splines. Those of a closed spline go round: control `k` stands for
/// `k + count` too.
struct NormalEquations {
    matrix: DMatrix<f64>,
    /// A column for each component of the controls.
    right: DMatrix<f64>,
}

impl NormalEquations {
    fn new(count: usize) -> Self {
        Self { matrix: DMatrix::zeros(count, count), right: DMatrix::zeros(count, 2) }
    }

    /// Adds a sample at the fraction `z` of span `k`.
    fn add(&mut self, k: usize, z: f64, point: Point, weight: f64) {
        let (count, values) = (self.matrix.nrows(), basis(z));
        for (a, &left) in values.iter().enumerate() {
            let row = (k + a) % count;
            values.iter().enumerate().for_each(|(b, &value)| self.matrix[(row, (k + b) % count)] += weight * left * value);
            self.right[(row, 0)] += weight * left * point.x;
            self.right[(row, 1)] += weight * left * point.y;
        }
    }

    /// The controls, with a trace of a penalty on the third differences that begin at `firsts`: spans without samples are
    /// bridged smoothly. Zeros, if the equations are singular.
    fn controls(mut self, firsts: Range<usize>) -> impl Fn(usize) -> Point {
        let count = self.matrix.nrows();
        let scale = 1e-9 * self.matrix.diagonal().max();
        for k in firsts {
            for (a, left) in THIRD.iter().enumerate() {
                for (b, right) in THIRD.iter().enumerate() {
                    self.matrix[((k + a) % count, (k + b) % count)] += scale * left * right;
                }
            }
        }
        for i in 0..count {
            self.matrix[(i, i)] += 1e-6 * scale;
        }
        let control = self.matrix.cholesky().map_or(DMatrix::zeros(count, 2), |factor| factor.solve(&self.right));
        move |i: usize| Point::new(control[(i % count, 0)], control[(i % count, 1)])
    }
}

/// Weighted mean of the points of samples.
fn mean(samples: &[FitSample]) -> Point {
    let total: f64 = samples.iter().map(|sample| sample.2).sum();
    samples.iter().fold(Point::zeros(), |sum, (_, x, w)| sum + *w * x) / total
}

/// The regression line of samples on their parameter.
fn chord(samples: &[FitSample]) -> impl Fn(f64) -> Point + Copy {
    let total: f64 = samples.iter().map(|sample| sample.2).sum();
    let middle = samples.iter().map(|(t, _, w)| w * t).sum::<f64>() / total;
    let mean = mean(samples);
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::chord_lengths;

    /// Largest distance of a spline from the circle of radius 2 about `centre`.
    fn off(spline: &Spline, centre: Point) -> f64 {
        let [first, last] = spline.range();
        let away = |k: i32| ((spline.point(first + (last - first) * f64::from(k) / 500.0) - centre).norm() - 2.0).abs();
        (0..=500).map(away).fold(0.0, f64::max)
    }

    #[test]
    fn straight_data_stay_straight() {
        let line = |t: f64| Point::new(1.0 + 0.6 * t, 3.0 + 0.8 * t);
        let samples: Vec<FitSample> = [0.0, 0.1, 0.35, 0.5, 1.2, 1.3, 2.0].map(|t| (t, line(t), 0.3 + t)).to_vec();
        let fit = Spline::fit(&samples, 5);
        let points: Vec<Point> = samples.iter().map(|sample| sample.1).collect();
        let through = Spline::through(chord_lengths(&points), &points, false);
        for t in [0.0, 0.2, 0.77, 1.9, 2.0] {
            assert!((fit.point(t) - line(t)).norm() < 1e-13 && (through.point(t) - line(t)).norm() < 1e-13);
            assert!((fit.derivative(t) - Point::new(0.6, 0.8)).norm() < 1e-12);
        }
    }

    #[test]
    fn a_fit_with_more_spans_is_nearer_to_a_circle() {
        let samples: Vec<FitSample> = (0..=200)
            .map(|k| 1.5 * f64::from(k) / 200.0)
            .map(|a| (2.0 * a, Point::new(2.0 * a.cos(), 2.0 * a.sin()), 1.0))
            .collect();
        let errors = [2, 4, 8].map(|spans| off(&Spline::fit(&samples, spans), Point::zeros()));
        assert!(errors[0] < 5e-3 && errors[1] < errors[0] / 8.0 && errors[2] < errors[1] / 8.0, "{errors:?}");
    }

    #[test]
    fn a_closed_fit_is_a_circle_wherever_its_samples_begin() {
        let samples = |from: f64| -> Vec<FitSample> {
            let sample = |k: usize| from + std::f64::consts::TAU * (k as f64 + 0.2 * (k as f64).cos()) / 200.0;
            (0..200).map(sample).map(|a| (2.0 * a, Point::new(1.0 + 2.0 * a.cos(), 2.0 * a.sin()), 0.1)).collect()
        };
        let period = 2.0 * std::f64::consts::TAU;
        let errors = [8, 16, 32].map(|spans| off(&Spline::fit_closed(&samples(0.0), spans, period), Point::new(1.0, 0.0)));
        assert!(errors[0] < 5e-3 && errors[1] < errors[0] / 10.0 && errors[2] < errors[1] / 10.0, "{errors:?}");
        let [one, other] = [0.0, 40.0].map(|from| Spline::fit_closed(&samples(from), 16, period));
        for k in 0..40 {
            let t = 0.9 * f64::from(k);
            assert!((one.point(t) - other.point(t)).norm() < 1e-4);
        }
    }
}
