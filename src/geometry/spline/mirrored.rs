//! Splines that end at lines of symmetry and are smooth there together with their mirror images.

use super::Spline;
use crate::geometry::Point;

/// What an end does to the curvature of a spline falls by 2 + √3 from knot to knot: below rounding after so many.
const FORGOTTEN: usize = 28;

impl Spline {
    /// The open spline through the same points at the same parameters that is square to lines of these directions through its ends, as
    /// the spline through the points and their mirror images is; without lines it stays what it is.
    pub fn mirrored(self, mirrors: [Option<Point>; 2]) -> Self {
        if mirrors == [None; 2] {
            return self;
        }
        let points = self.knots.iter().map(|knot| (*knot, self.point(*knot)));
        let mut row: Vec<(f64, Point)> = points.collect();
        let (ends, count) = ([row[0], row[row.len() - 1]], self.spans.len());
        let mut before = 0;
        // Of two mirrors each shows the images in the other.
        for _ in 0..FORGOTTEN.div_ceil(count) {
            let images = |at: usize, row: &[(f64, Point)]| {
                let image = |line: Point| row.iter().rev().map(|point| reflected(*point, ends[at], line)).collect::<Vec<_>>();
                let is_new = |knot: f64| if at == 0 { knot < row[0].0 } else { knot > row[row.len() - 1].0 };
                let all = mirrors[at].map(image).unwrap_or_default();
                all.into_iter().filter(|(knot, _)| is_new(*knot)).collect::<Vec<_>>()
            };
            let first = images(0, &row);
            before += first.len();
            row = [first, row].concat();
            let behind = images(1, &row);
            row.extend(behind);
        }
        let (knots, points): (Vec<f64>, Vec<Point>) = row.into_iter().unzip();
        let spans = Self::through(knots, &points, false).spans[before..before + count].to_vec();
        Self { mirrors, ..Self::of_spans(self.knots, spans, false) }
    }
}

/// A point with its parameter, reflected at the line of a direction through another.
fn reflected((knot, x): (f64, Point), (middle, foot): (f64, Point), line: Point) -> (f64, Point) {
    (2.0 * middle - knot, foot + 2.0 * line.dot(&(x - foot)) * line - (x - foot))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::chord_lengths;
    use std::f64::consts::FRAC_PI_2;

    /// A quarter of an ellipse (half axes 3 and 2) by so many chords, beginning on the y axis.
    fn quarter(count: usize) -> Vec<Point> {
        (0..=count).map(|k| FRAC_PI_2 * k as f64 / count as f64).map(|a| Point::new(3.0 * a.sin(), 2.0 * a.cos())).collect()
    }

    #[test]
    fn a_quarter_is_as_the_whole_closed_spline() {
        for count in [4, 7, 40] {
            let points = quarter(count);
            let spline = Spline::through(chord_lengths(&points), &points, false).mirrored([Some(Point::y()), Some(Point::x())]);
            let image = |at: usize| quarter(count)[at];
            let whole = (0..=4 * count).map(|k| match (k / count % 4, k % count) {
                (0, k) => image(k),
                (1, k) => image(count - k).component_mul(&Point::new(1.0, -1.0)),
                (2, k) => -image(k),
                (_, k) => image(count - k).component_mul(&Point::new(-1.0, 1.0)),
            });
            let mut whole: Vec<Point> = whole.collect();
            whole[4 * count] = whole[0];
            let closed = Spline::through(chord_lengths(&whole), &whole, true);
            let [first, last] = spline.range();
            for t in (0..=100).map(|k| first + (last - first) * f64::from(k) / 100.0) {
                assert!((spline.point(t) - closed.point(t)).norm() < 1e-12, "{count}: {t}");
            }
            assert!(spline.derivative(first).y.abs() < 1e-12 && spline.derivative(last).x.abs() < 1e-12);
            let half = spline.through_half(true).expect("enough points");
            assert!(half.derivative(first).y.abs() < 1e-12 && half.derivative(last).x.abs() < 1e-12);
        }
    }

    #[test]
    fn one_line_leaves_the_other_end_as_it_was() {
        let points = quarter(30);
        let open = Spline::through(chord_lengths(&points), &points, false);
        let one = open.clone().mirrored([None, Some(Point::x())]);
        let [first, last] = open.range();
        assert!((one.derivative(first) - open.derivative(first)).norm() < 1e-12);
        assert!(one.derivative(last).x.abs() < 1e-13 && open.derivative(last).x.abs() > 1e-6);
    }
}
