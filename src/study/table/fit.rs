//! What points say together: a power law, and which of them no other beats.

use serde::Serialize;

/// A law is fitted through so many points, those of the largest abscissae: what counts is where it goes.
pub const FITTED: usize = 3;
/// Points further from the line than by this factor do not follow a power law.
pub const FARTHEST: f64 = 1.5;

/// y ~ x^exponent, by least squares of the logarithms.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct PowerLaw {
    /// The slope in a diagram with logarithmic axes.
    pub exponent: f64,
    /// Largest factor between a point and the line.
    pub deviation: f64,
}

impl PowerLaw {
    /// The law of the last points; None if there are too few different ones, or if one is not positive.
    pub fn through(points: &[(f64, f64)]) -> Option<Self> {
        let mut points: Vec<(f64, f64)> = points.iter().map(|(x, y)| (x.ln(), y.ln())).collect();
        points.sort_by(|a, b| b.0.total_cmp(&a.0));
        points.truncate(FITTED);
        if points.len() < FITTED || !points.iter().all(|(x, y)| x.is_finite() && y.is_finite()) {
            return None;
        }
        if points.windows(2).any(|pair| pair[0].0 - pair[1].0 < 1e-3) {
            return None;
        }
        let count = points.len() as f64;
        let mean = points.iter().fold((0.0, 0.0), |sum, point| (sum.0 + point.0 / count, sum.1 + point.1 / count));
        let product = |f: fn(f64, f64) -> f64| points.iter().map(|(x, y)| f(x - mean.0, y - mean.1)).sum::<f64>();
        let exponent = product(|x, y| x * y) / product(|x, _| x * x);
        let distance = points.iter().map(|(x, y)| (y - mean.1 - exponent * (x - mean.0)).abs()).fold(0.0, f64::max);
        Some(Self { exponent, deviation: distance.exp() })
    }

    /// Whether the points lie on the line well enough for it to be called a law.
    pub fn holds(&self) -> bool {
        self.deviation <= FARTHEST
    }
}

/// Which points no other one beats: none is at least as small in both coordinates and smaller in one.
pub fn front(points: &[(f64, f64)]) -> Vec<bool> {
    let beats = |a: &(f64, f64), b: &(f64, f64)| a.0 <= b.0 && a.1 <= b.1 && (a.0 < b.0 || a.1 < b.1);
    points.iter().map(|point| !points.iter().any(|other| beats(other, point))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn a_power_law_is_found_and_early_points_do_not_count() {
        let exact: Vec<(f64, f64)> = [64.0, 256.0, 1024.0, 4096.0].map(|n: f64| (n, 3.0 * n.powf(-0.9))).to_vec();
        let law = PowerLaw::through(&exact).unwrap();
        assert!((law.exponent + 0.9).abs() < 1e-12 && law.deviation < 1.0 + 1e-12 && law.holds(), "{law:?}");
        let mut early = exact.clone();
        early[0].1 = 1e6;
        early.reverse();
        assert_eq!(PowerLaw::through(&early).unwrap(), law);
    }

    #[test]
    fn known_data_have_their_known_slope() {
        // Logarithms to base 2: (0, 0), (1, 1), (2, 5); slope 5/2, mean (1, 2), residuals 1/2, -1, 1/2.
        let law = PowerLaw::through(&[(1.0, 1.0), (2.0, 2.0), (4.0, 32.0)]).unwrap();
        assert!((law.exponent - 2.5).abs() < 1e-12 && (law.deviation - 2.0).abs() < 1e-12, "{law:?}");
        assert!(!law.holds());
    }

    #[test]
    fn too_little_is_no_law() {
        let bad: [&[(f64, f64)]; 5] = [
            &[],
            &[(1.0, 1.0), (2.0, 2.0)],
            &[(1.0, 1.0), (2.0, 2.0), (2.0, 3.0)],
            &[(1.0, 1.0), (2.0, 2.0), (4.0, 0.0)],
            &[(1.0, 1.0), (2.0, 2.0), (4.0, f64::NAN)],
        ];
        for points in bad {
            assert_eq!(PowerLaw::through(points), None, "{points:?}");
        }
    }

    #[test]
    fn the_front_of_known_points() {
        let points = [(1.0, 9.0), (2.0, 5.0), (2.0, 6.0), (3.0, 5.0), (4.0, 1.0), (4.0, 1.0), (9.0, 0.5)];
        assert_eq!(front(&points), [true, true, false, false, true, true, true]);
        assert!(front(&[]).is_empty());
    }

    proptest! {
        #[test]
        fn the_front_is_beaten_by_nobody_and_beats_all_others(numbers in prop::collection::vec((0_u8..20, 0_u8..20), 1..40)) {
            let points: Vec<(f64, f64)> = numbers.iter().map(|&(x, y)| (f64::from(x), f64::from(y))).collect();
            let on_front = front(&points);
            let best: Vec<(f64, f64)> = points.iter().zip(&on_front).filter(|(_, on)| **on).map(|(point, _)| *point).collect();
            prop_assert!(!best.is_empty());
            for (a, b) in best.iter().flat_map(|a| best.iter().map(move |b| (a, b))) {
                prop_assert!(a == b || (a.0 < b.0) == (a.1 > b.1), "{:?} and {:?}", a, b);
            }
            for (point, on) in points.iter().zip(&on_front) {
                let matched = best.iter().any(|other| other.0 <= point.0 && other.1 <= point.1);
                prop_assert!(matched && (*on == best.contains(point)), "{:?}", point);
            }
        }
    }
}
