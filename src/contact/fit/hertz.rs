//! How wide a contact is that a force asks for.

use nalgebra::{Matrix3, Vector3};
use std::f64::consts::PI;

/// Half width, as a share of the radius, up to which bodies around a contact are half-planes.
pub(crate) const MOST_ROUND: f64 = 0.2;

/// Width `2 b = 4 √(P R / π E*)` of the contact that presses with a force P (per thickness) within `zone`, an interval of arc
/// lengths, between smooth sides with a gap at rest of `s²/2R` there (Hertz; the `compliance` 1/E* is that of both surfaces
/// together); nothing if they are not convex against each other, or conform. `gaps` are pairs of arc length and gap at rest.
pub fn hertz_width(gaps: impl Iterator<Item = [f64; 2]>, zone: [f64; 2], force: f64, compliance: f64) -> Option<f64> {
    let (middle, half) = (0.5 * (zone[0] + zone[1]), 0.5 * (zone[1] - zone[0]));
    let (mut gram, mut right) = (Matrix3::<f64>::zeros(), Vector3::<f64>::zeros());
    for [arc, gap] in gaps.filter(|[arc, gap]| (arc - middle).abs() <= 2.0 * half && gap.is_finite()) {
        let t = (arc - middle) / half;
        let row = Vector3::new(1.0, t, t * t);
        gram += row * row.transpose();
        right += gap * row;
    }
    let curvature = 2.0 * gram.lu().solve(&right)?[2] / (half * half);
    half_width(curvature, force, compliance).map(|half| 2.0 * half)
}

/// Half width `b = √(4 P R / π E*)` of the contact that presses with a force P (per thickness) between smooth sides of the relative
/// `curvature` 1/R (Hertz; `compliance` is 1/E* = 1/E'₁ + 1/E'₂ by the plane moduli E', E/(1 - ν²) in plane strain); nothing if
/// nothing presses, the sides are not convex against each other, or conform.
pub(crate) fn half_width(curvature: f64, force: f64, compliance: f64) -> Option<f64> {
    let half = 2.0 * (force * compliance / (curvature * PI)).sqrt();
    (curvature > 0.0 && force > 0.0 && half * curvature <= MOST_ROUND).then_some(half)
}

/// Radius `a = (3 P R / 4 E*)^(1/3)` of the circle on which balls of the relative `curvature` 1/R press with a force P (Hertz; the
/// `compliance` is 1/E*); nothing where [`half_width`] has none.
pub(crate) fn ball_radius(curvature: f64, force: f64, compliance: f64) -> Option<f64> {
    let radius = (0.75 * force * compliance / curvature).cbrt();
    (curvature > 0.0 && force > 0.0 && radius * curvature <= MOST_ROUND).then_some(radius)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_parabola_is_as_wide_as_hertz_has_it_and_a_plane_or_a_hollow_is_nothing() {
        let gaps = |curvature: f64| (0..9).map(move |k| [f64::from(k), 0.5 * curvature * (f64::from(k) - 3.0).powi(2)]);
        // b = √(4 P R / π E*): R = 100, E* = 50, P = 0.5.
        let wanted = 2.0 * (4.0 * 0.5 * 100.0 / (PI * 50.0)).sqrt();
        let found = hertz_width(gaps(0.01), [2.0, 4.0], 0.5, 1.0 / 50.0).expect("it is convex");
        assert!((found - wanted).abs() < 1e-9, "{found} instead of {wanted}");
        assert_eq!(hertz_width(gaps(-0.01), [2.0, 4.0], 0.5, 1.0 / 50.0), None);
        assert_eq!(hertz_width(gaps(0.01), [2.0, 4.0], 5e3, 1.0 / 50.0), None, "it conforms");
    }
}
