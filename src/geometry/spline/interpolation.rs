//! Splines through given points, open and closed.

use super::Spline;
use crate::geometry::Point;

impl Spline {
    /// The spline through `points`, in their order, at given parameters, ascending, as the lengths of the chords are; at the second
    /// point from each end the third derivative is continuous too ("not a knot"), so that it is of fourth order up to its ends. Two
    /// points give a line, three a parabola. The last point of a closed one is the first again.
    ///
    /// # Panics
    /// If there are fewer than two points, or four of a closed one (three places), or not as many parameters.
    pub fn through(knots: Vec<f64>, points: &[Point], closed: bool) -> Self {
        let least = if closed { 4 } else { 2 };
        assert!(points.len() >= least && points.len() == knots.len(), "a spline needs {least} points, each with a parameter");
        let curvature = if closed { closed_curvatures(&knots, points) } else { curvatures(&knots, points) };
        let span = |k: usize| {
            let h = knots[k + 1] - knots[k];
            let (m0, m1) = (curvature[k], curvature[k + 1]);
            let slope = (points[k + 1] - points[k]) / h - h / 6.0 * (2.0 * m0 + m1);
            [points[k], slope, 0.5 * m0, (m1 - m0) / (6.0 * h)]
        };
        let spans = (0..points.len() - 1).map(span).collect();
        Self::of_spans(knots, spans, closed)
    }

    /// The spline through every other point between its spans, the odd ones or the even ones, and through its ends; nothing if these are
    /// too few.
    pub fn through_half(&self, odd: bool) -> Option<Self> {
        let (last, [begin, end]) = (self.knots.len() - 1, self.range());
        let inner: Vec<f64> = (if odd { 1 } else { 2 }..last).step_by(2).map(|k| self.knots[k]).collect();
        let knots: Vec<f64> = match self.closed && odd {
            // A closed one has no end: it begins at the first of them.
            true => inner.iter().copied().chain([inner.first()? + end - begin]).collect(),
            false => [begin].into_iter().chain(inner).chain([end]).collect(),
        };
        let points: Vec<Point> = knots.iter().map(|knot| self.point(*knot)).collect();
        let least = if self.closed { 4 } else { 2 };
        (points.len() >= least && points.len() <= last).then(|| Self::through(knots, &points, self.closed).mirrored(self.mirrors))
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

/// Second derivatives at the knots of the open spline through points: a system of three diagonals.
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
    let inner = eliminated(rows);
    let mut m: Vec<Point> = [Point::zeros()].into_iter().chain(inner).chain([Point::zeros()]).collect();
    for (end, next, beyond, [near, far]) in [(0, 1, 2, ends[0]), (n - 1, n - 2, n - 3, ends[1])] {
        m[end] = ((near + far) * m[next] - near * m[beyond]) / far;
    }
    m
}

/// The solution of a system of three diagonals, by its rows `lower, middle, upper | right`; nothing is before the first, and behind
/// the last.
fn eliminated(mut rows: Vec<([f64; 3], Point)>) -> Vec<Point> {
    for k in 1..rows.len() {
        let ([_, middle, upper], right) = rows[k - 1];
        let factor = rows[k].0[0] / middle;
        rows[k].0[1] -= factor * upper;
        rows[k].1 -= factor * right;
    }
    let mut values = vec![Point::zeros(); rows.len()];
    let mut next = Point::zeros();
    for (value, ([_, middle, upper], right)) in values.iter_mut().zip(&rows).rev() {
        *value = (right - *upper * next) / *middle;
        next = *value;
    }
    values
}

/// Second derivatives at the knots of the closed spline through points, of which the last is the first again: a cyclic system of
/// three diagonals, solved by the formula of Sherman and Morrison.
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
        let row = |k: usize| ([h(k + n - 1), diagonal(k), h(k)], right(k));
        eliminated((0..n).map(row).collect())
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

    fn through(points: &[Point]) -> Spline {
        Spline::through(chord_lengths(points), points, false)
    }

    fn through_closed(points: &[Point]) -> Spline {
        Spline::through(chord_lengths(points), points, true)
    }

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
        let errors = [8, 16, 32].map(|count| off(&through(&arc(count))));
        for pair in errors.windows(2) {
            assert!((pair[0] / pair[1]).log2() > 3.7, "{errors:?}");
        }
        for (k, point) in arc(8).iter().enumerate() {
            let spline = through(&arc(8));
            assert!((spline.point(spline.knots[k]) - point).norm() < 1e-14);
        }
    }

    /// Points of the circle of radius 2, unevenly spaced, the last the first again.
    fn circle(count: usize) -> Vec<Point> {
        let turn = |k: usize| std::f64::consts::TAU * (k as f64 + 0.3 * (k as f64).sin()) / count as f64;
        let at = |a: f64| Point::new(2.0 * a.cos(), 2.0 * a.sin());
        (0..count).map(turn).chain([turn(0)]).map(at).collect()
    }

    #[test]
    fn a_closed_spline_is_of_fourth_order_and_as_smooth_at_its_seam_as_elsewhere() {
        let errors = [10, 20, 40].map(|count| off(&through_closed(&circle(count))));
        for pair in errors.windows(2) {
            assert!((pair[0] / pair[1]).log2() > 3.4, "{errors:?}");
        }
        let points = circle(12);
        let spline = through_closed(&points);
        for (t, point) in spline.knots.iter().zip(&points) {
            assert!((spline.point(*t) - point).norm() < 1e-13);
        }
        // Begun at another point it is the same curve.
        let turned: Vec<Point> = (0..=12).map(|k| points[(k + 5) % 12]).collect();
        let other = through_closed(&turned);
        let period = spline.period().expect("closed");
        for k in 0..50 {
            let t = 0.7 * f64::from(k) - 9.0;
            assert!((spline.point(t + spline.knots[5]) - other.point(t)).norm() < 1e-12);
            assert!((spline.derivative(t + period) - spline.derivative(t)).norm() < 1e-12);
        }
    }
}
