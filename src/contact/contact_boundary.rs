//! Γ_C: a curve of its own, its normal, and its segments.

use crate::geometry::{Curve, Point, gauss_points, turn_right};

/// The contact boundary of one pair. The same on every rank; it knows nothing of the meshes.
#[derive(Clone, Debug)]
pub struct ContactBoundary {
    curve: Curve,
    /// +1 if the normal is the tangent turned right, -1 if turned left.
    side: f64,
    /// Parameters of the segment ends, ascending: one more than segments.
    knots: Vec<f64>,
    /// Arc length from the start to each segment end.
    arcs: Vec<f64>,
}

impl ContactBoundary {
    /// The part of `curve` between two parameters, as one segment; the normal at the middle has a positive part along `towards`.
    pub fn new(curve: Curve, range: [f64; 2], towards: Point) -> Self {
        let side = turn_right(curve.tangent(0.5 * (range[0] + range[1]))).dot(&towards).signum();
        let mut boundary = Self { curve, side, knots: range.to_vec(), arcs: vec![0.0; 2] };
        boundary.arcs[1] = boundary.arc_between(range[0], range[1]);
        boundary
    }

    /// Cuts it at these fractions of its arc length (from 0 to 1, ascending).
    pub fn cut(&mut self, fractions: &[f64]) {
        let (length, ends) = (self.length(), [self.knots[0], self.knots[self.knots.len() - 1]]);
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

    /// Arc lengths of the segment ends from the start.
    pub fn arcs(&self) -> &[f64] {
        &self.arcs
    }

    /// Arc length of segment `k`.
    pub fn segment_length(&self, k: usize) -> f64 {
        self.arcs[k + 1] - self.arcs[k]
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

    /// Arc length per parameter.
    pub fn speed(&self, t: f64) -> f64 {
        self.curve.derivative(t).norm()
    }

    /// Parameter of the foot of `p`: the normal line there passes through `p`. May lie beyond the ends.
    pub fn foot(&self, p: Point) -> f64 {
        let t = self.curve.nearest(p);
        match self.curve.period() {
            Some(period) => {
                let middle = 0.5 * (self.knots[0] + self.knots[self.knots.len() - 1]);
                middle + (t - middle + 0.5 * period).rem_euclid(period) - 0.5 * period
            }
            None => t,
        }
    }

    /// Feet of the two ends of an edge, lower first; on a closed curve the edge is followed, not the long way round.
    pub fn feet(&self, ends: [Point; 2]) -> [f64; 2] {
        let [a, b] = ends.map(|p| self.foot(p));
        let b = match self.curve.period() {
            Some(period) => a + (b - a + 0.5 * period).rem_euclid(period) - 0.5 * period,
            None => b,
        };
        [a.min(b), a.max(b)]
    }

    /// Parameter of one full turn, if the curve closes in itself.
    pub fn period(&self) -> Option<f64> {
        self.curve.period()
    }

    /// Arc length between two parameters: exact for lines and circles, otherwise by 16 Gauss points on each of 32 pieces.
    fn arc_between(&self, from: f64, to: f64) -> f64 {
        if matches!(self.curve, Curve::Line(_) | Curve::Circle { .. }) {
            return (to - from) * self.speed(from);
        }
        const PIECES: usize = 32;
        let step = (to - from) / PIECES as f64;
        let piece = |k: usize| {
            let start = from + step * k as f64;
            gauss_points(16).iter().map(|(x, w)| w * step * self.speed(start + step * x)).sum::<f64>()
        };
        (0..PIECES).map(piece).sum()
    }

    /// Arc length from the start to parameter `t`.
    pub fn arc(&self, t: f64) -> f64 {
        let (k, _) = self.locate(t);
        let (from, step) = (self.knots[k], t - self.knots[k]);
        let rest: f64 = gauss_points(16).iter().map(|(x, w)| w * step * self.speed(from + step * x)).sum();
        self.arcs[k] + rest
    }

    /// Parameter at arc length `s` from the start, by Newton's method from the uniform guess.
    pub fn parameter_at(&self, s: f64) -> f64 {
        let (first, last) = (self.knots[0], self.knots[self.knots.len() - 1]);
        let mut t = first + (last - first) * s / self.length();
        for _ in 0..60 {
            let step = (s - self.arc_between(first, t)) / self.speed(t);
            t += step;
            if step.abs() <= 1e-15 * (last - first) {
                break;
            }
        }
        t
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Formula;

    fn parabola() -> ContactBoundary {
        let read = |text| Formula::parse(text, &["t"]).expect("a formula");
        let curve = Curve::Parametric { x: read("t"), y: read("4 + t - 0.25*t^2"), range: [0.0, 4.0] };
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
