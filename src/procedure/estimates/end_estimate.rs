//! How far the ends of contact may be off: by their way from mesh to mesh, and within the segments beside them.

use crate::contact::{MultiplierSpace, Zone, true_end};
use crate::discretisation::ContactPressure;
use crate::geometry::Point;

/// Error of an end of contact by the segment next to it, at least: where the set of active multipliers decides at which end of a
/// segment it lies, and where the boundary ends with the pressure (from .01 to .06 on contacts whose ends are known).
const WITHIN_A_SEGMENT: [f64; 2] = [0.5, 0.03];

/// Error of the place where a pressure fades out, by the segment there.
const FADED: f64 = 0.1;

/// Error of the place where a pressure fades out, by how far it has moved since the mesh before.
const FADED_MOVES: f64 = 0.5;

/// Largest way of an end of a zone that presses from where it was on the mesh before, by the width of the zone; one where there
/// are other zones.
pub(crate) fn way_of_ends(now: &ContactPressure, before: &ContactPressure) -> f64 {
    // A zone that goes all around has no ends.
    let ends = |pressure: &ContactPressure| -> Vec<Option<[Point; 2]>> {
        let boundary = &pressure.contact.boundary;
        let end = |arc: f64| boundary.point(boundary.parameter_at(arc));
        let zones = pressure.zones();
        pressure.counting(&zones, &zones).map(|zone| (!zone.goes_round()).then(|| zone.arcs.map(end))).collect()
    };
    let (now, before) = (ends(now), ends(before));
    if now.is_empty() {
        return if before.is_empty() { 0.0 } else { f64::NAN };
    }
    if now.len() != before.len() {
        return 1.0;
    }
    let way = |(a, b): (&Option<[Point; 2]>, &Option<[Point; 2]>)| match (a, b) {
        (Some(a), Some(b)) => (a[0] - b[0]).norm().max((a[1] - b[1]).norm()) / (a[1] - a[0]).norm(),
        (None, None) => 0.0,
        _ => 1.0,
    };
    now.iter().zip(&before).map(way).fold(0.0, f64::max)
}

/// How far an end of a zone that presses may be off within the segment next to it, by the width of the zone: none where a body
/// ends and presses to its end. Where the active set decides, and the pressure fades out, it tells how far; then this is all of
/// the error, and the second value is true.
pub(crate) fn ends_within_segments(pressure: &ContactPressure, before: &ContactPressure) -> (f64, bool) {
    let contact = pressure.contact;
    let is_of_a_body = contact.ends_with_a_body();
    let (zones, zones_before) = (pressure.zones(), before.zones());
    let off = |z: usize, zone: &Zone, end: usize| {
        if zone.goes_round() {
            return (0.0, true);
        }
        let segment = [zone.segments.start, zone.segments.end - 1][end];
        let length = contact.boundary.segment_length(segment);
        let presses_to_its_end = pressure.active[contact.multipliers.on_segment(segment, 0.0).0[end]];
        if zone.is_at_end[end] && presses_to_its_end {
            let is_free = contact.pair.has_free_ends() && !is_of_a_body[end];
            return if is_free { (WITHIN_A_SEGMENT[1] * length, false) } else { (before_the_body_ends(pressure, end), true) };
        }
        let earlier = zones_before.get(z).filter(|_| zones_before.len() == zones.len());
        match (pressure.faded_end(zone, end), earlier.and_then(|zone| before.faded_end(zone, end))) {
            (Some(now), Some(then)) => {
                let moved = then * contact.boundary.length() / before.contact.boundary.length() - now;
                ((now - zone.arcs[end]).abs() + (FADED * length).max(moved.abs() * FADED_MOVES), true)
            }
            _ => (WITHIN_A_SEGMENT[0] * length, false),
        }
    };
    let pressing = pressure.counting(&zones, zones.iter().enumerate());
    let all = pressing.flat_map(|(z, zone)| [0, 1].map(|end| (off(z, zone, end), zone.length())));
    // Other zones than on the mesh before say nothing of where these end.
    all.fold((0.0, zones.len() == zones_before.len()), |(most, is_all), ((off, tells), width)| {
        (most.max(off / width), is_all && tells)
    })
}

/// How far before the end of a body that seems to press to its end contact may end: of steps (P0), the last of which is one mean for
/// all of its segment, as far as a root through the last two means tells. Other spaces have a multiplier at the end that opens.
fn before_the_body_ends(pressure: &ContactPressure, end: usize) -> f64 {
    let ContactPressure { contact, values, active } = pressure;
    if contact.multipliers.space != MultiplierSpace::P0 {
        return 0.0;
    }
    let last = contact.boundary.arcs()[[0, contact.boundary.segments()][end]];
    let found = true_end(&contact.boundary, &contact.multipliers, values, active, end);
    found.map_or(0.0, |arc| if end == 0 { arc - last } else { last - arc }).max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::Known;
    use crate::discretisation::samples::{blocks, contact, pair};

    /// λ = √(r - d) on ten segments of the line of two blocks, with the distance r from one of its ends: contact ends at d. Steps press
    /// to the end as long as their mean presses.
    #[test]
    fn steps_that_press_at_the_end_of_a_body_tell_where_contact_ends_before_it() {
        let contact = contact(&blocks(pair(MultiplierSpace::P0, 10), |_| Point::zeros(), Vec::new()), Known::default());
        let arcs = contact.boundary.arcs().to_vec();
        let error = |end: usize, before: f64| {
            let primitive = |r: f64| 2.0 / 3.0 * (r - before).max(0.0).powf(1.5);
            let away = |arc: f64| if end == 0 { arc } else { arcs[10] - arc };
            let values: Vec<f64> =
                arcs.windows(2).map(|ends| (primitive(away(ends[1])) - primitive(away(ends[0]))).abs()).collect();
            let pressure = ContactPressure { contact: &contact, values: &values, active: &[true; 10] };
            ends_within_segments(&pressure, &pressure)
        };
        for end in [0, 1] {
            let (off, is_all) = error(end, 0.06);
            assert!(is_all && (0.02..0.06).contains(&off), "{off} for 0.03");
            assert!(error(end, 0.0).0 < 1e-12 && error(end, -0.5).0 == 0.0, "it presses to the end");
        }
    }
}
