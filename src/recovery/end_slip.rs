//! What bodies lose by sliding at the ends of their contact.
//!
//! The loss of a contact that ends by itself was measured on a layer that slides on a block: it lost 3, 11 and 45 % of its force
//! where `lost_at_ends` says 3, 11 and 33 %. Γ_C lies midway between what has slid, so that half of the slip passes the end of a
//! contact that another one takes over from: a wheel on a rail of two radii, slid by .1 of the zone on the one and .15 on the other,
//! had 4.8 and 13 % of their forces on the wrong one where `lost_at_ends` says 4.4 and 11 %.

use super::cut_off::is_taken_over;
use super::traces::TracePoint;
use super::zone_ends::{SAME, beyond};
use crate::discretisation::Contact;
use crate::mesh::MacroMesh;

/// What sliding does where contact comes near the ends of bodies, in shares of the length that presses.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EndSlip {
    /// Way of the bodies along each other at an end of Γ_C that they press up to and where one of them ends; the larger of both.
    pub way: f64,
    /// Change of the length that they have in common there. Where they press up to one end alone, what goes on behind the other one
    /// with the body that ends is no change. Where they press up to none, a quarter of the square of the slip by the distance to
    /// the nearest end of a body (so much does the force of a layer change that slides to the edge of a block). Where another contact
    /// begins, what passes from one to the other, by the force.
    pub lost: f64,
}

/// An end of Γ_C that the bodies press up to: how far body 2 slides outwards there, how far each goes on beyond it (lengths), and the
/// force that passes to the contact that begins there (force per thickness).
struct SlidEnd {
    outwards: f64,
    beyond: [f64; 2],
    passing: f64,
}

impl SlidEnd {
    /// By how much farther the bodies have something in common.
    fn farther(&self) -> f64 {
        let [first, second] = self.beyond;
        first.min(second + self.outwards) - first.min(second)
    }

    /// What the body that ends here reaches over the other one then, or draws in where both end.
    fn lost_alone(&self) -> f64 {
        let [out, stays] = if self.outwards > 0.0 { [1, 0] } else { [0, 1] };
        let margin = self.beyond[stays] - self.beyond[out];
        if margin < 0.0 { 0.0 } else { (self.outwards.abs() - margin).max(0.0) }
    }
}

/// What sliding does at both ends of a contact with these `zones` (arc lengths, in order) and this `force` (per thickness, or of the whole ring), one of
/// `all` contacts; nothing where nothing presses.
pub fn slip_at_ends(
    (contact, all): (&Contact, &[Contact]),
    mesh: &MacroMesh,
    (zones, points): (&[[f64; 2]], &[TracePoint]),
    force: f64,
) -> Option<EndSlip> {
    if contact.boundary.is_closed() {
        return None;
    }
    let (whole, pressed) = (contact.boundary.length(), zones.iter().map(|[a, b]| b - a).sum::<f64>());
    let of_end = |end: usize| {
        let reaches = |zone: &[f64; 2]| if end == 0 { zone[0] <= SAME * whole } else { zone[1] >= (1.0 - SAME) * whole };
        let beyond = beyond(contact, mesh, end).map(|beyond| beyond * whole);
        // Where a fit lets both go on, its end is that of the pressure.
        if beyond[0].min(beyond[1]) > SAME * whole || !zones.iter().any(reaches) {
            return None;
        }
        let mut complete = points.iter().filter(|point| point.is_complete());
        let last = if end == 0 { complete.next()? } else { complete.next_back()? };
        let width = contact.boundary.width(contact.boundary.ends()[end]);
        let passing = if is_taken_over(contact, end, all) { 0.5 * last.slip.abs() * last.lambda * width } else { 0.0 };
        Some(SlidEnd { outwards: [-last.slip, last.slip][end], beyond, passing })
    };
    let ends: Vec<SlidEnd> = [0, 1].into_iter().filter_map(of_end).collect();
    let lost = match ends.as_slice() {
        [] => return slip_near_ends(contact, mesh, zones, points),
        [one] => one.lost_alone(),
        both => both.iter().map(SlidEnd::farther).sum::<f64>().abs(),
    };
    let passing = ends.iter().map(|end| end.passing).fold(0.0, f64::max) / force;
    // Along a circle that is given as such nothing lies elsewhere after sliding.
    let is_circle = contact.boundary.period().is_some();
    let way = if is_circle { 0.0 } else { ends.iter().map(|end| end.outwards.abs()).fold(0.0, f64::max) };
    Some(EndSlip { way: way / pressed, lost: (lost / pressed).max(passing) })
}

/// The same of contact that ends by itself: between its ends and those of the bodies there is room to slide.
fn slip_near_ends(contact: &Contact, mesh: &MacroMesh, zones: &[[f64; 2]], points: &[TracePoint]) -> Option<EndSlip> {
    let whole = contact.boundary.length();
    let ends = [zones.first()?[0], zones.iter().map(|zone| zone[1]).fold(0.0, f64::max)];
    let of_end = |end: usize| {
        let room = if end == 0 { ends[0] } else { whole - ends[1] };
        let least = beyond(contact, mesh, end).into_iter().map(|beyond| room + beyond * whole).fold(f64::INFINITY, f64::min);
        let complete = points.iter().filter(|point| point.is_complete());
        let nearest = complete.min_by(|a, b| (a.arc - ends[end]).abs().total_cmp(&(b.arc - ends[end]).abs()))?;
        Some(0.25 * (nearest.slip / least).powi(2))
    };
    // Where there is no room at all, they lose no more than everything.
    let lost = [0, 1].into_iter().filter_map(of_end).fold(0.0, f64::max).min(1.0);
    Some(EndSlip { way: 0.0, lost })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::{Known, MultiplierSpace};
    use crate::discretisation::samples::{blocks, contact, pair};
    use crate::geometry::Point;

    /// A place in contact where one body slides along the other.
    fn slid_point(arc: f64, slip: f64) -> TracePoint {
        TracePoint {
            arc,
            x: Point::zeros(),
            normal: Point::y(),
            lambda: 1.0,
            displacement: [0.0; 2],
            slip,
            stress: [-1.0; 2],
            distance: [0.0; 2],
            gap: 0.0,
        }
    }

    /// Two blocks of the width 2, the upper one moved or stretched, that slide along each other: what they lose at their ends.
    #[test]
    fn bodies_lose_by_sliding_what_neither_goes_on() {
        let slid = |upper: &dyn Fn(Point) -> Point, slip: f64| {
            let scene = blocks(pair(MultiplierSpace::P0, 8), upper, Vec::new());
            let contact = contact(&scene, Known::default());
            let length = contact.boundary.length();
            let at = |arc: f64| slid_point(arc, slip);
            let found = slip_at_ends((&contact, &[]), &scene.mesh, (&[[0.0, length]], &[at(0.0), at(length)]), length)
                .expect("both ends press");
            assert!((found.way * length - slip.abs()).abs() < 1e-12);
            found.lost * length
        };
        let near = |found: f64, wanted: f64| assert!((found - wanted).abs() < 1e-9, "{found} instead of {wanted}");
        for slip in [0.3, -0.3] {
            near(slid(&|_| Point::zeros(), slip), 0.3);
            // The upper block is shorter by a quarter of the width at both ends.
            let shorter = |x: Point| Point::new(0.5 * (1.0 - x.x), 0.0);
            near(slid(&shorter, slip), 0.0);
            near(slid(&shorter, 2.0 * slip), 0.1);
        }
        // Shifted by 0.1, it is drawn back first, or goes on.
        let shifted = |_: Point| Point::new(0.1, 0.0);
        near(slid(&shifted, 0.3), 0.3);
        near(slid(&shifted, -0.3), 0.1);
    }

    /// Two blocks that slide with a pressure of 1, and contacts that begin where theirs ends.
    #[test]
    fn half_of_the_slip_passes_to_the_contact_that_begins_at_an_end() {
        let scene = blocks(pair(MultiplierSpace::P0, 8), |x| Point::new(0.5 * (1.0 - x.x), 0.0), Vec::new());
        let own = contact(&scene, Known::default());
        let mut next = contact(&scene, Known::default());
        next.first += 1;
        let lost = |all: &[Contact]| {
            let points = [slid_point(0.0, 0.1), slid_point(own.boundary.length(), 0.1)];
            let zones = [[0.0, own.boundary.length()]];
            slip_at_ends((&own, all), &scene.mesh, (&zones, &points), 4.0).expect("both ends press").lost
        };
        assert_eq!(lost(std::slice::from_ref(&own)), 0.0, "the upper block stays above the lower one");
        assert!((lost(&[next]) - 0.5 * 0.1 / 4.0).abs() < 1e-12);
    }

    /// Contact up to the ends of both bodies, taken for contact that ends before them: there is no room at all.
    #[test]
    fn bodies_without_room_lose_all_of_a_contact_and_no_more() {
        let scene = blocks(pair(MultiplierSpace::P0, 8), |_| Point::zeros(), Vec::new());
        let contact = contact(&scene, Known::default());
        let lost = |zone: [f64; 2], slip: f64| {
            let points = zone.map(|arc| slid_point(arc, slip));
            slip_near_ends(&contact, &scene.mesh, &[zone], &points).expect("a zone").lost
        };
        let length = contact.boundary.length();
        assert_eq!(lost([0.0, length], 0.3), 1.0);
        assert!((lost([0.25 * length, 0.75 * length], 0.3) - 0.25 * (0.3 / (0.25 * length)).powi(2)).abs() < 1e-12);
    }
}
