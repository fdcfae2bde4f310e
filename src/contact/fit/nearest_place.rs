//! The place at which two smooth sides come nearest to each other, and how round they are there.

use crate::contact::fit::hertz::{MOST_ROUND, ball_radius, half_width};
use crate::contact::pair::Configuration;
use crate::contact::smooth_side::SmoothSide;
use crate::element::Plane;
use crate::geometry::{Point, cross};

/// Places that are looked at in the first window.
const PLACES: usize = 64;

/// Places that are looked at in each window after the first, which is as wide as two steps of the window before.
const PLACES_IN_A_SMALLER_WINDOW: usize = 16;

/// Number of windows: the last has steps of a millionth of the first one's.
const WINDOWS: usize = 6;

/// Share of a side over which its curvature is taken.
const ALONG: f64 = 1e-3;

/// Where two sides touch first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointContact {
    /// The place on body 1's side.
    pub place: Point,
    /// Relative curvature of the sides there (1/length): positive if they part on both sides of the place.
    pub curvature: f64,
    /// Curvature of the rounder one of both (1/length).
    pub roundest: f64,
    /// How far the bodies extend across the plane there ([`Plane::width`]).
    pub width: f64,
}

impl PointContact {
    /// The contact between bodies in another plane.
    pub fn in_plane(self, plane: Plane) -> Self {
        Self { width: plane.width(self.place), ..self }
    }

    /// Half width of what presses there with a force (per thickness; of the whole ring in bodies of revolution), by the compliance of both surfaces together (1/stress; Hertz);
    /// nothing if the sides conform.
    pub fn half_width(&self, force: f64, compliance: f64) -> Option<f64> {
        let half = match self.width > 0.0 {
            true => half_width(self.curvature, force / self.width, compliance),
            false => ball_radius(self.curvature, force, compliance),
        };
        half.filter(|half| half * self.roundest <= MOST_ROUND)
    }
}

/// The place where the gap between undeformed sides is smallest, within `reach` of `around` along body 1's side; nothing if it is
/// smallest at an end of that.
pub fn point_contact([first, second]: [&SmoothSide; 2], around: Point, reach: f64) -> Option<PointContact> {
    let curve = first.curve(Configuration::Reference);
    let gap = |t: f64| {
        let x = curve.point(t);
        let (foot, outward) = second.nearest_place(x);
        (x - foot).dot(&outward)
    };
    let (mut middle, mut half) = (first.nearest(around, Configuration::Reference), reach);
    for window in 0..WINDOWS {
        let places = if window == 0 { PLACES } else { PLACES_IN_A_SMALLER_WINDOW };
        let at = |k: usize| middle + half * (2.0 * k as f64 / places as f64 - 1.0);
        let is_there = |k: &usize| first.turn().is_some() || (0.0..=first.length()).contains(&at(*k));
        let gaps = (0..=places).filter(is_there).map(|k| (k, gap(at(k))));
        let (least, _) = gaps.min_by(|(_, a), (_, b)| a.total_cmp(b))?;
        if window == 0 && (least == 0 || least == places || !is_there(&(least - 1)) || !is_there(&(least + 1))) {
            return None;
        }
        (middle, half) = (at(least), 2.0 * half / places as f64);
    }
    let place = curve.point(middle);
    let [one, other] = [bulge(first, place), bulge(second, place)];
    Some(PointContact { place, curvature: one + other, roundest: one.abs().max(other.abs()), width: 1.0 })
}

/// Curvature of a side at the place nearest to a point (1/length), positive where the body bulges: by the shape as it is known, since
/// that of a spline through nodes is off by some 1e-4.
fn bulge(side: &SmoothSide, x: Point) -> f64 {
    let (curve, shape) = (side.curve(Configuration::Reference), side.shape());
    let (t, half) = (shape.nearest(x), ALONG * side.length());
    let step = half / shape.derivative(t).norm();
    let turn = cross(shape.tangent(t - step), shape.tangent(t + step)).asin();
    // A side goes from left to right, however its shape does.
    let along = curve.tangent(side.nearest(x, Configuration::Reference)).dot(&shape.tangent(t)).signum();
    side.hand() * along * turn / (2.0 * half)
}
