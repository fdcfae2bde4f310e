//! What sliding does to a contact that is modelled on the undeformed bodies: its normals and corresponding points stay,
//! while curved bodies that slide along each other show each other another part of their boundaries.

use super::smooth_side::SmoothSide;
use super::{Configuration, ContactBoundary, Multipliers};
use crate::geometry::{Curve, Point, gauss_points, turn_right};

/// Gauss points of a segment.
const POINTS: usize = 2;

/// How far two bodies slide where they press, and what the linear gap leaves out.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sliding {
    /// Way along each other, root mean square weighted with λ (length).
    pub slip: f64,
    /// `∫λ e ds` with `e` the gap of the displaced bodies less that of the linear theory (force times length).
    pub work: f64,
    /// Standard deviation of `e` from its mean, weighted with λ (length).
    pub deviation: f64,
    /// The same from a straight line along Γ_C: the tilt that moves a contact with two free ends is left out (length).
    pub bend: f64,
    /// `∫λ ds` (force per thickness).
    pub force: f64,
    /// Length of the segments that press.
    pub length: f64,
}

/// Integrates over the segments that press; `lambda` are the multipliers' values, tension does not count.
pub fn sliding(sides: [&SmoothSide; 2], boundary: &ContactBoundary, multipliers: &Multipliers, lambda: &[f64]) -> Sliding {
    let mut length = 0.0;
    // Rows of (force, arc length, slip, error) at the points that press.
    let mut rows: Vec<[f64; 4]> = Vec::new();
    for (k, ends) in boundary.knots().windows(2).enumerate() {
        let before = rows.len();
        for (z, weight) in gauss_points(POINTS) {
            let pressure = multipliers.value(lambda, k, *z);
            let t = ends[0] + z * (ends[1] - ends[0]);
            if pressure > 0.0
                && let Some([slip, error]) = at(sides, boundary.point(t), boundary.normal(t))
            {
                rows.push([pressure * weight * boundary.segment_length(k), boundary.arc(t), slip, error]);
            }
        }
        length += if rows.len() > before { boundary.segment_length(k) } else { 0.0 };
    }
    let force: f64 = rows.iter().map(|[part, ..]| part).sum();
    if force == 0.0 {
        return Sliding::default();
    }
    let mean = |value: &dyn Fn(&[f64; 4]) -> f64| rows.iter().map(|row| row[0] * value(row)).sum::<f64>() / force;
    let [middle, error] = [mean(&|row| row[1]), mean(&|row| row[3])];
    let square = mean(&|row| (row[3] - error).powi(2));
    let spread = mean(&|row| (row[1] - middle).powi(2));
    let common = mean(&|row| (row[1] - middle) * (row[3] - error));
    let tilted = if spread > 0.0 { common * common / spread } else { 0.0 };
    Sliding {
        slip: mean(&|row| row[2] * row[2]).sqrt(),
        work: force * error,
        deviation: square.sqrt(),
        bend: (square - tilted).max(0.0).sqrt(),
        force,
        length,
    }
}

/// Slip, and gap of the displaced bodies less the linear one, at a point of Γ_C that moves with the bodies' mean. Each
/// boundary keeps its shape and moves by the displacement of its corresponding point: what it is strained moves on with
/// the contact, and is no error.
fn at(sides: [&SmoothSide; 2], x: Point, normal: Point) -> Option<[f64; 2]> {
    let [undeformed, deformed] =
        [Configuration::Reference, Configuration::Deformed].map(|which| sides.map(|side| side.curve(which)));
    let distance = |curve: &Curve, t: f64, origin: Point| (curve.point(t) - origin).dot(&normal);
    let mut feet = [0.0; 2];
    for (foot, curve) in feet.iter_mut().zip(undeformed) {
        *foot = curve.hit_from(curve.nearest(x), x, normal)?;
    }
    let moved = [0, 1].map(|k| deformed[k].point(feet[k]) - undeformed[k].point(feet[k]));
    let apart = moved[1] - moved[0];
    let mut change = [0.0; 2];
    for (k, sign) in [-1.0, 1.0].into_iter().enumerate() {
        let curve = undeformed[k];
        let origin = x - 0.5 * sign * apart;
        let foot = curve.hit_from(feet[k], origin, normal)?;
        change[k] = distance(curve, foot, origin) - distance(curve, feet[k], x);
    }
    Some([apart.dot(&turn_right(normal)).abs(), change[1] - change[0] - apart.dot(&normal)])
}
