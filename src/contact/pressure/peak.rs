//! The largest pressure on a zone, from mean values of λ, which are more exact than λ itself.

use crate::contact::contact_boundary::ContactBoundary;
use crate::contact::multiplier::Multipliers;
use crate::contact::pressure::zones::Zone;

/// The largest size of a smooth pressure on a zone: of the parabola that has the means of λ over the segment where λ is largest
/// and the two next to it, on that segment. λ itself leans on the segment at an end of a boundary, and misses the curvature on
/// all of them. Nothing on fewer than three segments.
pub fn recovered_peak(boundary: &ContactBoundary, multipliers: &Multipliers, lambda: &[f64], zone: &Zone) -> Option<f64> {
    let size = |k: usize, z: f64| multipliers.value(lambda, k, z).abs();
    let highest = |k: usize| size(k, 0.0).max(size(k, 1.0));
    let top = zone.segments.clone().max_by(|a, b| highest(*a).total_cmp(&highest(*b)))?;
    let last = zone.segments.end.checked_sub(3).filter(|last| *last >= zone.segments.start)?;
    // Around a closed boundary each segment has one before and one behind it.
    let (top, first) = match zone.goes_round() {
        true => (top + boundary.segments(), top + boundary.segments() - 1),
        false => (top, top.saturating_sub(1).clamp(zone.segments.start, last)),
    };
    let near = [first, first + 1, first + 2];
    let intervals = near.map(|k| boundary.segment_arcs(k));
    let parabola = Parabola::of_means(intervals, near.map(|k| size(k, 0.5)));
    Some(parabola.largest(intervals[top - first]))
}

/// `a + b s + c s²`, with s from a place of its own.
struct Parabola {
    from: f64,
    coefficients: [f64; 3],
}

impl Parabola {
    /// The parabola with given means over three intervals.
    fn of_means(intervals: [[f64; 2]; 3], means: [f64; 3]) -> Self {
        let from = 0.5 * (intervals[1][0] + intervals[1][1]);
        // Means of s and s².
        let [p, q, r] = intervals.map(|interval| {
            let [a, b] = interval.map(|s| s - from);
            [0.5 * (a + b), (a * a + a * b + b * b) / 3.0]
        });
        let slopes = [(means[1] - means[0]) / (q[0] - p[0]), (means[2] - means[1]) / (r[0] - q[0])];
        let of_squares = [(q[1] - p[1]) / (q[0] - p[0]), (r[1] - q[1]) / (r[0] - q[0])];
        let c = (slopes[1] - slopes[0]) / (of_squares[1] - of_squares[0]);
        let b = slopes[0] - c * of_squares[0];
        Self { from, coefficients: [means[1] - b * q[0] - c * q[1], b, c] }
    }

    /// The largest value of the parabola on an interval.
    fn largest(&self, [start, end]: [f64; 2]) -> f64 {
        let [a, b, c] = self.coefficients;
        let crest = if c < 0.0 { (self.from - 0.5 * b / c).clamp(start, end) } else { start };
        let value = |s: f64| a + (s - self.from) * (b + c * (s - self.from));
        [start, end, crest].map(value).into_iter().fold(f64::NEG_INFINITY, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::pair::MultiplierSpace;
    use crate::geometry::{Curve, Point};

    /// Of means of a pressure on uneven segments of a line of length 4.
    fn found(space: MultiplierSpace, primitive: impl Fn(f64) -> f64, ends: &[f64]) -> Option<f64> {
        let mut boundary = ContactBoundary::new(Curve::Line([[0.0, 0.0], [4.0, 0.0]]), [0.0, 1.0], Point::new(0.0, 1.0));
        boundary.cut(&ends.iter().map(|s| s / 4.0).collect::<Vec<_>>());
        let multipliers = Multipliers::new(space, &boundary);
        let means = ends.windows(2).map(|e| (primitive(e[1]) - primitive(e[0])) / (e[1] - e[0]));
        let lambda: Vec<f64> = match space {
            MultiplierSpace::P0 => means.collect(),
            // Slopes that are far off.
            _ => means.flat_map(|mean| [mean + 0.3, mean - 0.3]).collect(),
        };
        let zones = Zone::all(&boundary, &multipliers, &lambda, &vec![true; lambda.len()]);
        recovered_peak(&boundary, &multipliers, &lambda, &zones[0])
    }

    #[test]
    fn the_crest_of_a_parabola_is_found_from_its_means() {
        let ends = [0.0, 0.7, 1.3, 2.2, 2.9, 4.0];
        for space in [MultiplierSpace::P0, MultiplierSpace::P1Discontinuous] {
            for crest in [0.0, 1.0, 1.75, 2.5, 4.0] {
                let primitive = |s: f64| 5.0 * s - (s - crest).powi(3) / 9.0;
                let peak = found(space, primitive, &ends).expect("five segments");
                assert!((peak - 5.0).abs() < 1e-12, "{space:?}, {crest}: {peak}");
            }
        }
    }

    #[test]
    fn a_slope_is_largest_at_its_end_and_two_segments_say_nothing() {
        let peak = found(MultiplierSpace::P0, |s| s * s, &[0.0, 1.0, 2.5, 3.0, 4.0]).expect("four segments");
        assert!((peak - 8.0).abs() < 1e-12, "{peak}");
        assert_eq!(found(MultiplierSpace::P0, |s| s, &[0.0, 2.0, 4.0]), None);
    }
}
