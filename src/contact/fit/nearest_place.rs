//! The place at which two smooth sides come nearest to each other, and how round they are there.

use crate::contact::fit::hertz::{MOST_ROUND, ball_radius, half_width};
use crate::contact::pair::Configuration;
use crate::contact::smooth_side::SmoothSide;
use crate::geometry::{Point, cross};

/// Places that are looked at in the first window.
const PLACES: usize = 64;

/// Places that are looked at in each window after the first, which is as wide as two steps of the window before.
const PLACES_IN_A_SMALLER_WINDOW: usize = 16;

/// Number of windows: the last has steps of a millionth of the first one's.
const WINDOWS: usize = 6;

/// Share of the gap between two places at which both are as near as the other: sides that are round all over never fall below what they
/// have parted, the humps of a wave touch.
const AGAIN: f64 = 0.5;

/// Share of a side over which its curvature is taken.
const ALONG: f64 = 1e-3;

/// Where two sides touch first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointContact {
    /// The place on body 1's side.
    pub place: Point,
    /// Relative curvature of the sides there (1/length): positive if they part on both sides of the place.
    pub curvature: f64,
    /// Curvature of the rounder one of both, or what stands for their thinness if that is larger (1/length): beside both the contact
    /// has to be small for its bodies to be half-planes.
    pub roundest: f64,
    /// How far the bodies extend across the plane there ([`crate::element::Plane::width`]).
    pub width: f64,
}

impl PointContact {
    /// Whether it lies on the axis of revolution.
    pub fn is_at_pole(&self) -> bool {
        self.width == 0.0
    }

    /// Half width of what presses there with a force (per thickness; of the whole ring in bodies of revolution), by the compliance of both surfaces together (1/stress; Hertz);
    /// nothing if the sides conform.
    pub fn half_width(&self, force: f64, compliance: f64) -> Option<f64> {
        let half = match self.is_at_pole() {
            true => ball_radius(self.curvature, force, compliance),
            false => half_width(self.curvature, force / self.width, compliance),
        };
        half.filter(|half| half * self.roundest <= MOST_ROUND)
    }
}

/// The place where the gap between undeformed sides is smallest, within `reach` of `around` along body 1's side; nothing if it is
/// smallest at an end of that, unless both sides go on there as their own images at the axis of revolution, or if the sides come near
/// again beside it.
pub fn point_contact([first, second]: [&SmoothSide; 2], around: Point, reach: f64) -> Option<PointContact> {
    let curve = first.curve(Configuration::Reference);
    // A closed side goes on across its seam.
    let place = |t: f64| curve.point(first.turn().map_or(t, |turn| t.rem_euclid(turn)));
    let gap = |t: f64| {
        let x = place(t);
        let (foot, outward) = second.nearest_place(x);
        (x - foot).dot(&outward)
    };
    let (mut middle, mut half) = (first.nearest(around, Configuration::Reference), reach);
    for window in 0..WINDOWS {
        let places = if window == 0 { PLACES } else { PLACES_IN_A_SMALLER_WINDOW };
        let at = |k: usize| middle + half * (2.0 * k as f64 / places as f64 - 1.0);
        let is_there = |k: &usize| first.turn().is_some() || (0.0..=first.length()).contains(&at(*k));
        let gaps: Vec<(usize, f64)> = (0..=places).filter(is_there).map(|k| (k, gap(at(k)))).collect();
        let &(least, nearest) = gaps.iter().min_by(|(_, a), (_, b)| a.total_cmp(b))?;
        if window == 0 && (least == 0 || least == places || !is_there(&(least - 1)) || !is_there(&(least + 1))) {
            return at_pole([first, second], place(at(least)), 2.0 * half / places as f64);
        }
        let is_beside = |k: usize| first.turn().is_none_or(|turn| (at(k) - at(least)).abs() < 0.5 * turn);
        let parted = |(k, gap): &(usize, f64)| is_beside(*k).then_some(gap - nearest);
        let (behind, ahead) = gaps.split_at(gaps.partition_point(|(k, _)| *k <= least));
        if window == 0 && (falls_again(ahead.iter().filter_map(parted)) || falls_again(behind.iter().rev().filter_map(parted))) {
            return None;
        }
        (middle, half) = (at(least), 2.0 * half / places as f64);
    }
    Some(touching([first, second], place(middle), bulge))
}

/// Whether sides that part from the place where they are nearest come together again: by half of how far they have parted.
fn falls_again(parted: impl Iterator<Item = f64>) -> bool {
    let mut most = 0.0_f64;
    parted.into_iter().any(|parted| {
        most = most.max(parted);
        parted < AGAIN * most
    })
}

/// The contact of two sides at a pole of both that is no farther than a step from a place; nothing if there is none.
fn at_pole(sides: [&SmoothSide; 2], x: Point, step: f64) -> Option<PointContact> {
    let [one, _] = sides.map(|side| side.poles().map(|pole| side.places[pole]).find(|pole| (pole - x).norm() <= step));
    let place = one.filter(|one| sides[1].poles().any(|pole| (sides[1].places[pole] - one).norm() <= step))?;
    Some(touching(sides, Point::new(0.0, place.y), bulge_at_pole))
}

fn touching([first, second]: [&SmoothSide; 2], place: Point, bulge: fn(&SmoothSide, Point) -> f64) -> PointContact {
    let [one, other] = [bulge(first, place), bulge(second, place)];
    PointContact { place, curvature: one + other, roundest: one.abs().max(other.abs()), width: 1.0 }
}

/// Curvature of a side at the place nearest to a point (1/length), positive where the body bulges: by the shape as it is known, since
/// that of a spline through nodes is off by some 1e-4.
fn bulge(side: &SmoothSide, x: Point) -> f64 {
    let (t, step) = on_shape(side, x);
    curvature(side, x, [t - step, t + step])
}

/// Curvature of a side at a pole: the shape may be known on one side of the axis only.
fn bulge_at_pole(side: &SmoothSide, x: Point) -> f64 {
    let (t, step) = on_shape(side, x);
    let goes_out = side.shape.point(t + step).x > side.shape.point(t - step).x;
    curvature(side, x, if goes_out { [t, t + step] } else { [t - step, t] })
}

/// Parameter of the place on a side's shape that is nearest to a point, and the part of it over which the curvature is taken.
fn on_shape(side: &SmoothSide, x: Point) -> (f64, f64) {
    let t = side.shape.nearest(x);
    (t, ALONG * side.length() / side.shape.derivative(t).norm())
}

/// Mean curvature of a side's shape about a place between two of its parameters (1/length), positive where the body bulges.
fn curvature(side: &SmoothSide, x: Point, [from, to]: [f64; 2]) -> f64 {
    let (curve, shape) = (side.curve(Configuration::Reference), &side.shape);
    let turn = cross(shape.tangent(from), shape.tangent(to)).asin();
    let t = 0.5 * (from + to);
    // A side goes from left to right, however its shape does.
    let along = curve.tangent(side.nearest(x, Configuration::Reference)).dot(&shape.tangent(t)).signum();
    side.hand * along * turn / ((to - from) * shape.derivative(t).norm())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sides_that_come_near_again_do_not_touch_at_one_point() {
        let again = |parted: &[f64]| falls_again(parted.iter().copied());
        assert!(!again(&[0.1, 0.4, 0.9, 1.6]) && !again(&[0.1, 0.4, 0.3, 0.25]) && !again(&[0.0, 0.0]) && !again(&[]));
        assert!(again(&[0.1, 0.4, 0.1, 0.0]) && again(&[0.0, 1.0, 0.49]));
    }
}
