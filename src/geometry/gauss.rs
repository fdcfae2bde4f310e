//! Gauss-Legendre points on the unit interval.

use std::f64::consts::PI;
use std::sync::OnceLock;

/// Largest number of points of a rule.
const MOST: usize = 20;

/// The `n` Gauss-Legendre points of [0, 1] with their weights (sum 1), ascending; exact for degree `2n - 1`.
///
/// # Panics
/// If `n` is 0 or above 20.
pub fn gauss_points(n: usize) -> &'static [(f64, f64)] {
    static RULES: OnceLock<Vec<Vec<(f64, f64)>>> = OnceLock::new();
    let rules = RULES.get_or_init(|| (1..=MOST).map(rule).collect());
    &rules[n - 1]
}

/// Roots of the Legendre polynomial by Newton's method from Chebyshev's guess.
fn rule(n: usize) -> Vec<(f64, f64)> {
    let mut points = Vec::with_capacity(n);
    for k in (0..n).rev() {
        let mut x = (PI * (k as f64 + 0.75) / (n as f64 + 0.5)).cos();
        let mut slope = 1.0;
        for _ in 0..100 {
            let (value, derivative) = legendre(n, x);
            slope = derivative;
            let step = value / derivative;
            x -= step;
            if step.abs() < 1e-16 {
                break;
            }
        }
        points.push((0.5 * (1.0 + x), 1.0 / ((1.0 - x * x) * slope * slope)));
    }
    points
}

/// Value and derivative of the Legendre polynomial of degree `n` at `x`.
fn legendre(n: usize, x: f64) -> (f64, f64) {
    let (mut before, mut value) = (1.0, x);
    for k in 2..=n {
        let k = k as f64;
        (before, value) = (value, ((2.0 * k - 1.0) * x * value - (k - 1.0) * before) / k);
    }
    (value, n as f64 * (x * value - before) / (x * x - 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_rule_integrates_its_degree_exactly() {
        for n in 1..=MOST {
            for degree in 0..2 * n {
                let sum: f64 = gauss_points(n).iter().map(|(x, w)| w * x.powi(degree as i32)).sum();
                assert!((sum * (degree as f64 + 1.0) - 1.0).abs() < 1e-13, "{n} points, degree {degree}: {sum}");
            }
        }
    }

    #[test]
    fn points_ascend() {
        assert!(gauss_points(7).windows(2).all(|w| w[0].0 < w[1].0));
    }
}
