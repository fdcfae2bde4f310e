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
    /// `∫λ e ds` with `e` the gap of the deformed bodies less that of the linear theory (force times length).
    pub work: f64,
    /// Standard deviation of `e` weighted with λ (length).
    pub deviation: f64,
    /// `∫λ ds` (force per thickness).
    pub force: f64,
    /// Length of the segments that press.
    pub length: f64,
}

/// Integrates over the segments that press; `lambda` are the multipliers' values, tension does not count.
pub fn sliding(sides: [&SmoothSide; 2], boundary: &ContactBoundary, multipliers: &Multipliers, lambda: &[f64]) -> Sliding {
    let (mut slips, mut work, mut squares, mut force, mut length) = (0.0, 0.0, 0.0, 0.0, 0.0);
    for (k, ends) in boundary.knots().windows(2).enumerate() {
        let mut presses = false;
        for (z, weight) in gauss_points(POINTS) {
            let pressure = multipliers.value(lambda, k, *z).max(0.0);
            let t = ends[0] + z * (ends[1] - ends[0]);
            let Some([slip, error]) = at(sides, boundary.point(t), boundary.normal(t)).filter(|_| pressure > 0.0) else {
                continue;
            };
            let part = pressure * weight * boundary.segment_length(k);
            presses = true;
            force += part;
            slips += part * slip * slip;
            work += part * error;
            squares += part * error * error;
        }
        length += if presses { boundary.segment_length(k) } else { 0.0 };
    }
    if force == 0.0 {
        return Sliding::default();
    }
    let deviation = (squares / force - (work / force).powi(2)).max(0.0).sqrt();
    Sliding { slip: (slips / force).sqrt(), work, deviation, force, length }
}

/// Slip, and gap of the deformed bodies less the linear one, at a point of Γ_C that moves with the bodies' mean.
fn at(sides: [&SmoothSide; 2], x: Point, normal: Point) -> Option<[f64; 2]> {
    let curves = [Configuration::Reference, Configuration::Deformed].map(|which| sides.map(|side| side.curve(which)));
    let meet = |curve: &Curve, origin: Point, from: f64| {
        let t = curve.hit_from(from, origin, normal)?;
        Some((t, (curve.point(t) - origin).dot(&normal)))
    };
    let mut before = [(0.0, 0.0); 2];
    for (found, curve) in before.iter_mut().zip(curves[0]) {
        *found = meet(curve, x, curve.nearest(x))?;
    }
    let moved = [0, 1].map(|k| curves[1][k].point(before[k].0) - curves[0][k].point(before[k].0));
    let origin = x + 0.5 * (moved[0] + moved[1]);
    let mut after = [0.0; 2];
    for k in 0..2 {
        after[k] = meet(curves[1][k], origin, before[k].0)?.1;
    }
    let apart = moved[1] - moved[0];
    let error = (after[1] - after[0]) - (before[1].1 - before[0].1) - apart.dot(&normal);
    Some([apart.dot(&turn_right(normal)).abs(), error])
}
