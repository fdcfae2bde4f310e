//! Where the ends of a contact boundary go, by the pressure on it or by its force.

use crate::contact::true_end;
use crate::discretisation::{Contact, ContactPressure};

/// Segments that press, at least, where an end is told by the pressure beside it: of a contact narrower than that the mesh knows the
/// force alone, and its ends would wander with the bend of the boundary from fit to fit.
const TELLING: usize = 3;

/// Where the force tells the width 2b, too (Hertz), it does so better as long as the segments that press, times b/R, are fewer: the
/// pressure of n segments misses the width by about .8/n² (11 - 14 % on three, 3 % on four, 1 - 4 % on nine; `packing/discs_3` and
/// `roller`), the force by some (b/R)².
const TELLING_BESIDE_A_FORCE: f64 = 0.9;

/// At a pole the pressure of n segments misses the width of a contact of half-spaces by less than this by n²: at most .65 on 6 to 36 segments
/// (`round_hertz`). A hollow ball on a block, whose contact is 3.7 % wider than that of half-spaces, showed 1.3 on six. In the plane, where the
/// force tells the width of arches and coatings as well, the pressure misses it by up to 3.9 (`bending`), and is not asked.
const MISSED: f64 = 1.0;

/// And by this share of how far the ends still are from both places: `√(r + η)` was taken for a series of two terms.
const MISSED_BESIDE: f64 = 0.5;

/// Ends that the pressure has placed stay with it up to this share of that, so that they do not go to and fro: above what half-spaces show.
const STAYS: f64 = 0.75;

/// An end of Γ_C lies at the end of a body if less than this share of an edge is between them.
const AT_THE_END: f64 = 1e-2;

/// What the secant makes of a finding at most: of an end that is found a segment off again and again, too. A head that presses on a flange
/// from its one edge to the other had its end a twentieth of its width farther with each fit.
const MOST_STRETCH: f64 = 4.0;

/// Share of a segment up to which it tells how far off its end is.
const WHOLE: f64 = 0.99;

/// Error of an end by the segment beside it, as a share of that segment's length.
pub const OF_A_SEGMENT: f64 = 0.025;

/// A position of an end and how far off it was found to be, in the parameter of Γ_C.
pub type FoundEnd = Option<(f64, f64)>;

/// Ends of a Γ_C that is to be a part of a closed one: half a segment beyond the only zone that presses. Nothing if that goes all
/// around, or if there are several, which the active set keeps apart.
pub fn ends_of_a_part(pressure: &ContactPressure) -> Option<[f64; 2]> {
    let boundary = &pressure.contact.boundary;
    let zones = pressure.zones();
    let [zone] = &zones[..] else { return None };
    let half = |k: usize| 0.5 * boundary.segment_length(k);
    let ends = [zone.arcs[0] - half(zone.segments.start), zone.arcs[1] + half(zone.segments.end - 1)];
    (ends[1] - ends[0] < boundary.length()).then(|| ends.map(|arc| boundary.parameter_at(arc)))
}

/// Where the ends of a contact go: by the pressure next to them, with the secant through the last two findings; not
/// beyond the bodies' boundaries.
pub fn free_ends(pressure: &ContactPressure, history: &mut [FoundEnd; 2], least: f64) -> [f64; 2] {
    let ContactPressure { contact, values: lambda, active } = *pressure;
    let boundary = &contact.boundary;
    let now = boundary.ends();
    let mut next = now;
    let edge = contact.edge_length() / boundary.speed(now[0]);
    if let Some(ends) = ends_by_force(pressure, least) {
        return ends;
    }
    // What presses up to both ends lies on too short a boundary.
    if pressing_segments(pressure) < TELLING && active.contains(&false) {
        return now;
    }
    for k in [0, 1] {
        let outwards = if k == 0 { -1.0 } else { 1.0 };
        // At the end of a body contact may end with any pressure: it stays there, wherever the body goes.
        let last = multipliers_at(contact, k);
        if (now[k] - contact.limits[k]).abs() < AT_THE_END * edge && last.iter().all(|&i| active[i]) {
            next[k] = contact.limits[k] + outwards * edge;
            continue;
        }
        let Some(arc) = true_end(boundary, &contact.multipliers, lambda, active, k) else {
            // A segment alone that presses all over tells no end: contact goes on as far again.
            if active.iter().all(|&is_active| is_active) {
                next[k] = now[k] + outwards * (now[1] - now[0]);
            }
            continue;
        };
        let off = boundary.parameter_at(arc) - now[k];
        let slope = history[k].filter(|(before, _)| now[k] != *before).map(|(before, was)| (off - was) / (now[k] - before));
        // A segment tells of an end that lies farther than that no more than that it does.
        let outer = if k == 0 { 0 } else { boundary.segments() - 1 };
        let is_farther = outwards * (arc - boundary.arcs()[outer + k]) >= WHOLE * boundary.segment_length(outer);
        let creeps = is_farther && slope.is_some_and(|slope| slope >= -1.0 / MOST_STRETCH);
        history[k] = Some((now[k], off));
        let within = |end: f64| if k == 0 { end.max(contact.limits[0]) } else { end.min(contact.limits[1]) };
        next[k] = match slope {
            // The curve goes an edge beyond its ends, which is no farther than a step that creeps.
            _ if creeps => now[k] + MOST_STRETCH * off,
            Some(slope) if (-4.0..-0.25).contains(&slope) => within(now[k] - off / slope),
            _ => within(now[k] + off),
        };
    }
    // A contact smaller than an edge is none that the mesh can tell.
    if next[1].min(contact.limits[1]) - next[0].max(contact.limits[0]) > edge { next } else { now }
}

/// Ends as far from the middle of the pressure as its force presses sides that touch at a point (Hertz), or where they are if it is
/// smaller than the `least` one that counts; nothing if the sides conform, or the pressure tells the ends better.
pub fn ends_by_force(pressure: &ContactPressure, least: f64) -> Option<[f64; 2]> {
    let Contact { boundary, multipliers, limits, known, .. } = pressure.contact;
    let touch = known.touch?;
    let force = pressure.force();
    if force.abs() <= least {
        return Some(boundary.ends());
    }
    let half = touch.half_width(force, pressure.contact.compliance)?;
    let pressing = pressing_segments(pressure);
    if pressing as f64 * half * touch.roundest > TELLING_BESIDE_A_FORCE {
        return None;
    }
    // ∫λ ds and ∫λ s ds of a segment, of a line across which λ does not change: the force itself is that of the whole width.
    let of_segment = |k: usize| {
        let [start, end] = boundary.segment_arcs(k);
        let [a, b] = [0.0, 1.0].map(|z| multipliers.value(pressure.values, k, z));
        let length = end - start;
        [0.5 * length * (a + b), length * (0.5 * (a + b) * start + length * (a + 2.0 * b) / 6.0)]
    };
    let sum = |all: [f64; 2], own: [f64; 2]| [all[0] + own[0], all[1] + own[1]];
    let [pressed, moment] = (0..boundary.segments()).map(of_segment).fold([0.0; 2], sum);
    let now = boundary.ends();
    let segment = boundary.length() / boundary.segments() as f64;
    let middle = moment / pressed;
    let at = |arc: f64| boundary.parameter_at(arc).clamp(limits[0], limits[1]);
    let place = |middle: f64| [at(middle - half), at(middle + half)];
    if touch.is_at_pole() || pressing >= TELLING {
        let ends = place(if touch.is_at_pole() { boundary.arc(boundary.foot(touch.place)) } else { middle });
        let is_known = pressing < TELLING || !touch.is_at_pole() || !pressure_says_otherwise(pressure, ends, pressing);
        return is_known.then_some(ends);
    }
    // The place within a segment is not known any better: where few press, the ends would go to and fro.
    let here = 0.5 * boundary.length();
    let ends = place(if (middle - here).abs() <= 0.5 * segment { here } else { middle });
    let stays = ends.iter().zip(now).all(|(end, now)| (end - now).abs() * boundary.speed(now) <= OF_A_SEGMENT * segment);
    Some(if stays { now } else { ends })
}

/// Whether the pressure beside the ends, which would lie here by the force, tells another width than it can miss: then bodies are no
/// half-spaces over the width of the contact, as shells and coatings are not.
fn pressure_says_otherwise(pressure: &ContactPressure, forced: [f64; 2], pressing: usize) -> bool {
    let ContactPressure { contact, values, active } = *pressure;
    let (boundary, now) = (&contact.boundary, contact.boundary.ends());
    let told = |end: usize| {
        let found = true_end(boundary, &contact.multipliers, values, active, end).filter(|_| forced[end] != contact.limits[end]);
        found.map_or(forced[end], |arc| boundary.parameter_at(arc))
    };
    let width = |ends: [f64; 2]| ends[1] - ends[0];
    let [by_force, by_pressure] = [width(forced), told(1) - told(0)];
    let [missed, off] = [by_force, by_pressure].map(|told| (width(now) - told).abs());
    let stays = if off < missed { STAYS } else { 1.0 };
    // Of segments shorter than edges the mesh feels no more than edges.
    let edges = by_force * boundary.speed(now[0]) / contact.edge_length();
    let share = stays * MISSED / edges.min(pressing as f64).powi(2);
    (by_pressure - by_force).abs() > share * by_force + MISSED_BESIDE * missed.min(off)
}

/// Segments from the first that presses to the last.
fn pressing_segments(pressure: &ContactPressure) -> usize {
    let ContactPressure { contact, active, .. } = *pressure;
    let all = (0..active.len()).filter(|&i| active[i]).map(|i| contact.multipliers.segment_of(i));
    let [first, last] = all.fold([usize::MAX, 0], |[first, last], k| [first.min(k), last.max(k)]);
    (last + 1).saturating_sub(first)
}

/// Multipliers of the segment at the first end (0) or the last (1).
fn multipliers_at(contact: &Contact, end: usize) -> Vec<usize> {
    let segment = if end == 0 { 0 } else { contact.boundary.segments() - 1 };
    let rows = contact.multipliers.on_segment(segment, 0.0).0;
    rows[..contact.multipliers.per_segment()].to_vec()
}
