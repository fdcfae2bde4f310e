//! What a linear contact model leaves out where bodies move far: its normals and corresponding points stay, while curved
//! bodies that slide along each other, or turn, face each other with other parts of their boundaries; and bodies that turn grow.

use super::smooth_side::SmoothSide;
use super::{Configuration, ContactBoundary, Multipliers};
use crate::geometry::{Point, gauss_points, turn_right};
use nalgebra::Rotation2;

/// Gauss points of a segment.
const POINTS: usize = 2;

/// A body that turns.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Turn {
    /// Its rotation (radians).
    pub angle: f64,
    /// Its middle, about which the linear theory makes it larger by half the square of the angle.
    pub middle: Point,
}

/// A gap that the linear theory leaves out, over the part of Γ_C that presses.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct GapError {
    /// `∫λ e ds` (force times length); growth is not part of it.
    pub work: f64,
    /// Standard deviation of e from its mean, weighted with λ (length).
    pub deviation: f64,
    /// The same from a straight line along Γ_C: the tilt that moves a contact with two free ends is left out (length).
    pub bend: f64,
}

/// How far two bodies slide and turn where they press, and what the linear gap leaves out.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FiniteMotion {
    /// Way along each other, root mean square weighted with λ (length).
    pub slip: f64,
    /// Gap of the displaced bodies less that of the linear theory.
    pub whole: GapError,
    /// What of it is left out because bodies turn.
    pub turning: GapError,
    /// `∫λ ds` (force per thickness).
    pub force: f64,
    /// Length of the segments that press.
    pub length: f64,
}

/// A point that presses.
struct PressedPoint {
    /// λ times the length it stands for.
    weight: f64,
    arc: f64,
    slip: f64,
    /// Gap that is left out: by all motion, by translations alone, by growth.
    moved: f64,
    shifted: f64,
    grown: f64,
}

/// Integrates over the segments that press; `lambda` are the multipliers' values, tension does not count. Without `sides`
/// (straight lines, and boundaries that follow the deformed bodies) only growth is left out.
pub fn finite_motion(
    sides: Option<[&SmoothSide; 2]>,
    turns: [Turn; 2],
    boundary: &ContactBoundary,
    multipliers: &Multipliers,
    lambda: &[f64],
) -> FiniteMotion {
    let mut length = 0.0;
    // Parameter, weight and arc length of the points that press.
    let mut points: Vec<[f64; 3]> = Vec::new();
    for (k, ends) in boundary.knots().windows(2).enumerate() {
        let before = points.len();
        for (z, weight) in gauss_points(POINTS) {
            let pressure = multipliers.value(lambda, k, *z);
            let t = ends[0] + z * (ends[1] - ends[0]);
            if pressure > 0.0 {
                points.push([t, pressure * weight * boundary.segment_length(k), boundary.arc(t)]);
            }
        }
        length += if points.len() > before { boundary.segment_length(k) } else { 0.0 };
    }
    let force: f64 = points.iter().map(|[_, weight, _]| weight).sum();
    if force == 0.0 {
        return FiniteMotion::default();
    }
    let tilts = sides.map_or([0.0; 2], |sides| sides.map(|side| mean_tilt(side, boundary, &points)));
    let pressed_point = |&[t, weight, arc]: &[f64; 3]| {
        let (x, normal) = (boundary.point(t), boundary.normal(t));
        let [slip, moved, shifted] = match sides {
            Some(sides) => {
                let [[slip, moved], [_, shifted]] = [left_out(sides, tilts, x, normal)?, left_out(sides, [0.0; 2], x, normal)?];
                [slip, moved, shifted]
            }
            None => [0.0; 3],
        };
        let growth = turns.map(|turn| 0.5 * turn.angle * turn.angle * (x - turn.middle).dot(&normal));
        Some(PressedPoint { weight, arc, slip, moved, shifted, grown: growth[0] - growth[1] })
    };
    let pressed: Vec<PressedPoint> = points.iter().filter_map(pressed_point).collect();
    FiniteMotion {
        slip: mean(&pressed, |point| point.slip * point.slip).sqrt(),
        whole: gap_error(&pressed, force, |point| point.moved),
        turning: gap_error(&pressed, force, |point| point.moved - point.shifted),
        force,
        length,
    }
}

/// Mean weighted with λ; zero without points.
fn mean(pressed: &[PressedPoint], value: impl Fn(&PressedPoint) -> f64) -> f64 {
    let total: f64 = pressed.iter().map(|point| point.weight).sum();
    if total == 0.0 { 0.0 } else { pressed.iter().map(|point| point.weight * value(point)).sum::<f64>() / total }
}

/// Work of a gap that is left out, and how uneven it is together with growth.
fn gap_error(pressed: &[PressedPoint], force: f64, gap: impl Fn(&PressedPoint) -> f64) -> GapError {
    let all = |point: &PressedPoint| gap(point) + point.grown;
    let (middle, error) = (mean(pressed, |point| point.arc), mean(pressed, all));
    let square = mean(pressed, |point| (all(point) - error).powi(2));
    let spread = mean(pressed, |point| (point.arc - middle).powi(2));
    let common = mean(pressed, |point| (point.arc - middle) * (all(point) - error));
    let tilted = if spread > 0.0 { common * common / spread } else { 0.0 };
    GapError { work: force * mean(pressed, gap), deviation: square.sqrt(), bend: (square - tilted).max(0.0).sqrt() }
}

/// Angle by which a side is turned where it presses, its mean weighted with λ (radians).
fn mean_tilt(side: &SmoothSide, boundary: &ContactBoundary, points: &[[f64; 3]]) -> f64 {
    let (mut sum, mut total) = (0.0, 0.0);
    for &[t, weight, _] in points {
        let foot = side.nearest(boundary.point(t), Configuration::Reference);
        let [before, after] = [Configuration::Reference, Configuration::Deformed].map(|which| side.curve(which).tangent(foot));
        sum += weight * before.perp(&after).atan2(before.dot(&after));
        total += weight;
    }
    sum / total
}

/// Slip, and gap of the displaced bodies less the linear one, at a point of Γ_C that moves with the bodies' mean. Each
/// boundary keeps its shape, moves by the displacement of its corresponding point, and turns by its tilt about it: what it
/// is strained moves on with the contact, and is no error.
fn left_out(sides: [&SmoothSide; 2], tilts: [f64; 2], x: Point, normal: Point) -> Option<[f64; 2]> {
    let [undeformed, deformed] =
        [Configuration::Reference, Configuration::Deformed].map(|which| sides.map(|side| side.curve(which)));
    let mut feet = [0.0; 2];
    for (foot, curve) in feet.iter_mut().zip(undeformed) {
        *foot = curve.hit_from(curve.nearest(x), x, normal)?;
    }
    let moved = [0, 1].map(|k| deformed[k].point(feet[k]) - undeformed[k].point(feet[k]));
    let mean_tilt = 0.5 * (tilts[0] + tilts[1]);
    let mut change = [0.0; 2];
    for k in 0..2 {
        // The line along which the gap is measured, as seen from the body.
        let (curve, start) = (undeformed[k], undeformed[k].point(feet[k]));
        let origin = start + Rotation2::new(-tilts[k]) * (x + 0.5 * (moved[0] + moved[1]) - start - moved[k]);
        let direction = Rotation2::new(mean_tilt - tilts[k]) * normal;
        let foot = curve.hit_from(feet[k], origin, direction)?;
        change[k] = (curve.point(foot) - origin).dot(&direction) - (start - x).dot(&normal);
    }
    let apart = moved[1] - moved[0];
    Some([apart.dot(&turn_right(normal)).abs(), change[1] - change[0] - apart.dot(&normal)])
}
