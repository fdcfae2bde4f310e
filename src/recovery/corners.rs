//! Corners of bodies that press within a contact whose normals are those of smooth boundaries.
//!
//! The error is `0.5 √(Σ(w θ)²)` over both bodies, θ the sharpest corner (radians) and w the share of the body in the compliance
//! `(1 - ν²)/E`; with `gap = "closed"` 0.3 of that. Measured in the mean square of the middle 60 % on rings of chords of two
//! edges each, corners of 3.8 to 18 degrees, `refine` 0 to 2, estimate by error: 0.9 to 1.4 with a declared interference and
//! equal E, but for one run at `refine = 0`; 0.7 to 0.85 with a stiff inner ring; 2.5 to 4 with one that is 20 times softer,
//! where λ is right in the middle and off by half at the ends; 0.7 to 2.8 from `refine = 1` on for closed rings under outer
//! pressure. A single corner of 6, 12 or 19 degrees between two flat faces with an interference spoils λ by 1.2, 4.6 and 11 %
//! (estimates 3.7, 7.4 and 12 %); with a contact on each face λ is right to rounding. Closed, 19 degrees are worth 0.3 % and are
//! estimated at 3.5 %.

use crate::contact::GapChoice;
use crate::discretisation::{Contact, Scene};

/// Error of λ by a corner of one radian on the softer body (root mean square). Measured on rings of subdivided chords with
/// corners of 4 to 18 degrees, on stiff and on alike ones.
const BY_A_CORNER: f64 = 0.5;

/// The same as a share of that, where the bodies are said to touch: both move alike along the tangent then.
const WHERE_CLOSED: f64 = 0.3;

/// The last part of a zone at either end, as a share of its length: a corner there ends contact rather than lies within it.
const END: f64 = 0.05;

/// Sharpest corner within the zones that press (radians), and the relative error of λ that it is worth.
///
/// Γ_C is smooth, so beside a corner of the body its normal is that of no facet: λ has a part along each facet, which jumps
/// at the corner, and strains the body. How much, is the share of that body in the compliance of both.
pub struct Corners {
    /// The sharpest corner (radians).
    pub angle: f64,
    /// Estimated relative error of λ.
    pub error: f64,
}

/// Looks for corners that are left in the edges of both bodies of a contact, on the undeformed bodies, within `zones`: the
/// arcs that press.
pub fn corners(scene: &Scene, contact: &Contact, zones: &[[f64; 2]]) -> Corners {
    let boundary = &contact.boundary;
    let inside = |s: f64| zones.iter().any(|[from, to]| (s - from).min(to - s) > END * (to - from));
    // A zone of a closed boundary may go on across the seam, or have no end.
    let turn = boundary.turn();
    let goes_round = turn.is_some_and(|turn| zones.iter().any(|[from, to]| to - from >= turn * (1.0 - 1e-12)));
    let within = |s: f64| goes_round || inside(s) || turn.is_some_and(|turn| inside(s + turn));
    let sharpest = contact.pair.between.each_ref().map(|name| {
        let all = scene.mesh.corners_left(name).into_iter();
        let pressing = all.filter(|corner| within(boundary.arc(boundary.foot(corner.place))));
        pressing.map(|corner| corner.angle).fold(0.0, f64::max)
    });
    let compliance = contact.parts.map(|part| scene.compliance(part));
    let part = |k: usize| sharpest[k] * compliance[k] / (compliance[0] + compliance[1]);
    let share = if matches!(contact.pair.gap, GapChoice::Closed) { WHERE_CLOSED } else { 1.0 };
    Corners { angle: sharpest[0].max(sharpest[1]), error: share * BY_A_CORNER * part(0).hypot(part(1)) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::{CurveChoice, Known, MultiplierSpace};
    use crate::discretisation::samples::{blocks, contact, pair};
    use crate::geometry::{Formula, Point};

    /// A corner of 2.3 degrees in the middle of the upper block, which has a fifth of the compliance.
    #[test]
    fn a_corner_counts_by_the_compliance_of_its_body_where_a_zone_presses() {
        let mut pair = pair(MultiplierSpace::P0, 8);
        (pair.curve, pair.gap) = (CurveChoice::Fit, GapChoice::Formula(Formula::constant(0.0)));
        let lift = |x: Point| Point::new(0.0, if x.y == 1.0 && x.x == 0.9 { 0.02 } else { 0.0 });
        let scene = blocks(pair, lift, Vec::new());
        let mut contact = contact(&scene, Known::default());
        let angle = (0.02f64 / 0.9).atan() + (0.02f64 / 1.1).atan();
        let arc = contact.boundary.arc(contact.boundary.foot(Point::new(0.9, 1.02)));
        let found = |contact: &Contact, ends: [f64; 2]| {
            let found = corners(&scene, contact, &[ends]);
            (found.angle, found.error)
        };
        for ends in [[arc - 0.4, arc + 0.6], [arc - 0.06, arc + 0.94], [arc - 0.94, arc + 0.06]] {
            let (of, error) = found(&contact, ends);
            assert!((of - angle).abs() < 1e-9 && (error - 0.5 * 0.2 * angle).abs() < 1e-9, "{of}, {error}");
        }
        for ends in [[arc - 0.04, arc + 0.96], [arc - 0.96, arc + 0.04], [arc + 0.1, arc + 0.5], [arc - 0.5, arc - 0.1]] {
            assert_eq!(found(&contact, ends), (0.0, 0.0), "no corner within {ends:?}");
        }
        contact.pair.gap = GapChoice::Closed;
        let (_, error) = found(&contact, [arc - 0.4, arc + 0.6]);
        assert!((error - 0.3 * 0.5 * 0.2 * angle).abs() < 1e-9, "{error}");
    }
}
