//! Corners that press on a side to which Γ_C is not parallel.
//!
//! A half-plane under a pressure that falls to zero at both ends is not pushed along: `∫p u' ds = 0` for the slopes u' of its surface. So
//! the force of a corner acts along the normal of the side on which it presses, and a curve half-way between both sides, or on that with
//! the corner, gives it another direction.

use super::cut_off::ends_with_a_corner;
use super::zone_ends::beyond;
use crate::contact::{Configuration, SmoothSide, Zone};
use crate::discretisation::{Contact, ContactPressure, Scene};

/// Places of a zone that are looked at: enough that some lie on either hand of one where curved sides are parallel.
const PLACES: usize = 8;

/// Share of the force of a contact from which a zone counts: a smaller one turns the direction of the whole by a twentieth of its own
/// error at most.
const LEAST_SHARE: f64 = 0.05;

/// Largest angle between Γ_C and a side on which a corner of the other one presses (radians), of the zones that count; `sides` are those
/// of body 1 and of body 2 that meet. Corners are those of elastic bodies, and the ends of rigid tools.
pub fn slant(scene: &Scene, pressure: &ContactPressure, sides: [&SmoothSide; 2]) -> f64 {
    let zones = pressure.zones();
    let shares = pressure.shares(&zones);
    let counting = zones.iter().zip(shares).filter(|(_, share)| *share > LEAST_SHARE);
    let all = counting.flat_map(|(zone, _)| [0, 1].map(|end| (zone, end)));
    let pressed = all.filter_map(|(zone, end)| Some((zone, pressed_by_a_corner(scene, pressure.contact, zone, end)?)));
    pressed.map(|(zone, side)| angle_to(sides[side], pressure, zone)).fold(0.0, f64::max)
}

/// The side on which a zone presses with a corner of the other one, at an end of Γ_C; a fitted curve may begin within the first segment
/// from it.
fn pressed_by_a_corner(scene: &Scene, contact: &Contact, zone: &Zone, end: usize) -> Option<usize> {
    let (boundary, mesh) = (&contact.boundary, &scene.mesh);
    if !zone.is_at_end[end] || boundary.is_closed() {
        return None;
    }
    let segment = if end == 0 { zone.segments.start } else { zone.segments.end - 1 };
    let near = boundary.segment_length(segment) / boundary.length();
    let beyond = beyond(contact, mesh, end);
    let side = usize::from(beyond[1] > beyond[0]);
    let is_an_end = beyond[1 - side].abs() < near && beyond[side] > beyond[1 - side] + near;
    let is_corner = || contact.rigid[1 - side] || ends_with_a_corner(contact, mesh, 1 - side, end);
    (is_an_end && is_corner()).then_some(side)
}

/// Smallest angle between Γ_C and a side over a zone (radians); nothing if they are parallel somewhere there.
fn angle_to(side: &SmoothSide, pressure: &ContactPressure, zone: &Zone) -> f64 {
    let boundary = &pressure.contact.boundary;
    let angle = |k: usize| {
        let t = boundary.parameter_at(zone.arcs[0] + (k as f64 + 0.5) / PLACES as f64 * (zone.arcs[1] - zone.arcs[0]));
        let (x, normal) = (boundary.point(t) - side.shift, boundary.normal(t));
        let tangent = side.curve(Configuration::Reference).tangent(side.nearest(x, Configuration::Reference));
        let across = tangent.perp(&normal);
        (tangent.dot(&normal) * across.signum()).atan2(across.abs())
    };
    let [low, high] =
        (0..PLACES).map(angle).fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], angle| [low.min(angle), high.max(angle)]);
    if low * high > 0.0 { low.abs().min(high.abs()) } else { 0.0 }
}
