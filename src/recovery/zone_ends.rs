//! Where the pressure of a zone has no bound, at the ends of Γ_C and where materials meet; corners of one body at these ends.

use crate::contact::{MultiplierSpace, Zone};
use crate::discretisation::{Contact, ContactPressure, Scene};
use crate::mesh::MacroMesh;

/// Growth of the pressure from the last segment but one to the last, and by one refinement, above which it may be singular at
/// an end.
const GROWS: f64 = 1.02;

/// Growth from segment to segment above which λ may be singular where materials meet: powers of the distance are weak there. Bars
/// whose moduli are as 2 : 3 have .003.
const GROWS_AT_JOINTS: f64 = 1.001;

/// Share of a segment from which it lies on both sides of a joint.
const ASIDE: f64 = 0.1;

/// Share of the largest λ of a zone from which it matters that λ grows elsewhere.
const AMONG: f64 = 0.5;

/// Share of the growth by one refinement that the next one adds where λ goes like a power of the distance below zero: one or
/// more; where it is bounded a half or less.
const GOES_ON: f64 = 0.75;

/// Two ends are one if they are nearer than this share of the length.
pub const SAME: f64 = 1e-6;

impl ContactPressure<'_> {
    /// Whether λ grows towards an end of Γ_C, ever more quickly, and without bound as meshes are refined, as far as the values
    /// there on the mesh `before` and on the one before that (`earlier`) tell, or because the corner of a body presses there on an
    /// elastic one that goes on (Dundurs, Lee 1972). Steps grow towards any steep end.
    pub fn grows_towards(&self, scene: &Scene, zone: &Zone, end: usize, [before, earlier]: [Option<f64>; 2]) -> bool {
        if !zone.is_at_end[end] || zone.segments.len() < 3 {
            return false;
        }
        let nth = |i: usize| if end == 0 { zone.segments.start + i } else { zone.segments.end - 1 - i };
        let last = self.size(nth(0), if end == 0 { 0.05 } else { 0.95 });
        let inner = if self.contact.multipliers.space == MultiplierSpace::P0 { nth(1) } else { nth(0) };
        if last > GROWS * self.size(inner, 0.5) && self.peaks_at_end(zone) && self.presses_with_a_corner(scene, zone, end) {
            return true;
        }
        let grown = match (before, earlier) {
            (Some(before), Some(earlier)) => {
                last > GROWS * before && before > earlier && last - before > GOES_ON * (before - earlier)
            }
            (Some(before), None) => self.contact.multipliers.space != MultiplierSpace::P0 && last > GROWS * before,
            _ => true,
        };
        grown && self.steepens([0, 1, 2].map(nth), GROWS)
    }

    /// Whether λ grows by more than a factor towards the first of three segments in a row, ever more quickly.
    fn steepens(&self, row: [usize; 3], factor: f64) -> bool {
        let [a, b, c] = row.map(|k| self.size(k, 0.5));
        let lengths = row.map(|k| self.contact.boundary.segment_length(k));
        let slopes = [(a - b) / (lengths[0] + lengths[1]), (b - c) / (lengths[1] + lengths[2])];
        a > factor * b && slopes[0] > slopes[1]
    }

    /// Parameter of Γ_C at which an edge between two materials ends within a zone, or at an end of it, and towards which λ grows without
    /// bound (Bogy 1971), as far as this mesh tells, where it is among the largest of the zone. A smooth pressure, however steep, goes on
    /// rising on the other side.
    pub fn grows_at_joint(&self, zone: &Zone) -> Option<f64> {
        let height = |k: usize| self.size(k, 0.5);
        let goes_on = |near: usize, [next, far]: [usize; 2]| height(near) < height(next) && height(next) < height(far);
        let rows = self.rows_at_joints(zone).into_iter();
        let mut grown = rows.filter(|(_, row, across)| {
            !across.is_some_and(|across| goes_on(row[0], across)) && self.steepens(*row, GROWS_AT_JOINTS)
        });
        grown.next().map(|(joint, ..)| joint)
    }

    /// How much λ varies beside such a place over three segments, by the largest λ of the zone: as long as that is much, it may grow
    /// without bound on finer meshes.
    pub fn variation_at_joints(&self, zone: &Zone) -> f64 {
        let variation = |(_, row, _): (f64, [usize; 3], Option<[usize; 2]>)| {
            let [near, next, far] = row.map(|k| self.size(k, 0.5));
            (near - next).abs().max((next - far).abs()).max((near - far).abs())
        };
        self.rows_at_joints(zone).into_iter().map(variation).fold(0.0, f64::max) / self.peak_of(zone)
    }

    /// Three segments of a zone in a row from each place on at which an edge between two materials ends, with its parameter and two
    /// segments in a row on its other side, where the first of the three is among the highest.
    fn rows_at_joints(&self, zone: &Zone) -> Vec<(f64, [usize; 3], Option<[usize; 2]>)> {
        let (boundary, least) = (&self.contact.boundary, AMONG * self.peak_of(zone));
        let count = boundary.segments() as isize;
        let within_zone = |k: isize| {
            let own = if boundary.is_closed() { k.rem_euclid(count) } else { k };
            let is_within = [own, own + count].iter().any(|&k| zone.segments.contains(&(k as usize)));
            (is_within && (0..count).contains(&own)).then_some(own as usize)
        };
        let of_joint = |&joint: &f64| {
            let (at, z) = boundary.locate(joint);
            // A segment on both sides of the joint says nothing of either.
            let before = if z > 1.0 - ASIDE { at } else { at.wrapping_sub(1) } as isize;
            let behind = if z < ASIDE { at } else { at + 1 } as isize;
            [(before, -1, behind), (behind, 1, before)].into_iter().filter_map(move |(first, way, across)| {
                let [a, b, c] = [0, 1, 2].map(|i| within_zone(first + way * i));
                Some((joint, [a?, b?, c?], within_zone(across).zip(within_zone(across - way)).map(|(near, far)| [near, far])))
            })
        };
        let rows = self.contact.joints.iter().flat_map(of_joint);
        rows.filter(|(_, row, _)| self.size(row[0], 0.5) > least).collect()
    }
}

/// How far the boundary of each body goes on beyond an end of Γ_C, by the length of Γ_C.
pub fn beyond(contact: &Contact, mesh: &MacroMesh, end: usize) -> [f64; 2] {
    let [first, last] = contact.boundary.ends();
    let farthest = |side| outwards(contact, mesh, side, end).into_iter().map(|(_, way)| way).fold(f64::NEG_INFINITY, f64::max);
    [0, 1].map(|side| farthest(side) / (last - first) - 0.5)
}

/// The vertices of a side, and how far towards an end the foot of each lies from the middle of Γ_C (in its parameter). A closed curve is
/// cut opposite to that middle, or, where the side ends, in its widest opening.
pub fn outwards(contact: &Contact, mesh: &MacroMesh, side: usize, end: usize) -> Vec<(u32, f64)> {
    let boundary = &contact.boundary;
    let [first, last] = boundary.ends();
    let vertices = mesh.edges_of(&contact.pair.between[side]).iter().flat_map(|&edge| mesh.edges[edge as usize].vertices);
    let way = |vertex: u32| boundary.foot(mesh.vertices[vertex as usize] + contact.moved[side][end]) - 0.5 * (first + last);
    let mut ways: Vec<(u32, f64)> = vertices.map(|vertex| (vertex, way(vertex))).collect();
    if let Some(period) = boundary.period() {
        ways.iter_mut().for_each(|(_, way)| *way = way.rem_euclid(period));
        ways.sort_by_key(|(vertex, _)| *vertex);
        let is_closed = ways.chunk_by(|a, b| a.0 == b.0).all(|alike| alike.len() > 1);
        ways.sort_by(|a, b| a.1.total_cmp(&b.1));
        let gap = |pair: &&[(u32, f64)]| pair[1].1 - pair[0].1;
        let widest = ways.windows(2).max_by(|a, b| gap(a).total_cmp(&gap(b)));
        let middle = |pair: &[(u32, f64)]| 0.5 * (pair[0].1 + pair[1].1);
        let cut = widest.filter(|_| !is_closed).map_or(0.5 * period, middle);
        ways.iter_mut().filter(|(_, way)| *way > cut).for_each(|(_, way)| *way -= period);
    }
    ways.iter_mut().for_each(|(_, way)| *way = [-*way, *way][end]);
    ways
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::{Known, SegmentRule};
    use crate::discretisation::samples::{blocks, contact, pair};
    use crate::geometry::Point;

    /// Whether a pressure, given at the middles of uneven segments by their distance from an end, grows towards that end.
    fn grows(space: MultiplierSpace, end: usize, pressure: impl Fn(f64) -> f64, before: [Option<f64>; 2]) -> bool {
        let mut pair = pair(space, 1);
        let from_first = [0.0, 0.05, 0.2, 0.5, 0.8, 1.0];
        let fractions = from_first.map(|z| if end == 0 { z } else { 1.0 - z });
        let mut fractions = fractions.to_vec();
        fractions.sort_by(f64::total_cmp);
        pair.segments = SegmentRule::Fractions(fractions);
        let scene = blocks(pair, |_| Point::zeros(), Vec::new());
        let contact = contact(&scene, Known::default());
        let away = |k: usize| {
            let middle = 0.5 * (contact.boundary.arcs()[k] + contact.boundary.arcs()[k + 1]);
            if end == 0 { middle } else { 2.0 - middle }
        };
        let times = if space == MultiplierSpace::P0 { 1 } else { 2 };
        let values: Vec<f64> = (0..5).flat_map(|k| vec![pressure(away(k)); times]).collect();
        let active: Vec<bool> = vec![true; values.len()];
        let pressure = ContactPressure { contact: &contact, values: &values, active: &active };
        let zones = pressure.zones();
        assert_eq!(zones.len(), 1);
        pressure.grows_towards(&scene, &zones[0], end, before)
    }

    #[test]
    fn a_pressure_grows_towards_an_end_if_it_does_so_ever_more_quickly() {
        for end in [0, 1] {
            let first = |pressure: &dyn Fn(f64) -> f64| grows(MultiplierSpace::P0, end, pressure, [None; 2]);
            assert!(first(&|r| 1.0 / r.sqrt()) && first(&|r| 4.0 - r + 0.1 * r * r));
            assert!(!first(&|r| 4.0 - r - 0.1 * r * r), "it grows, but less and less");
            assert!(!first(&|r| 4.0 - 0.1 * r + 0.01 * r * r), "next to even");
            assert!(!first(&|r| 1.0 + r * r) && !first(&|_| 1.0));
        }
    }

    /// Ten segments of a line of length 2, the material changes at 1: `pressure` is by the distance from there, before it negative.
    fn grows_at_joint(joint: f64, pressure: impl Fn(f64) -> f64) -> bool {
        let mut contact = contact(&blocks(pair(MultiplierSpace::P0, 10), |_| Point::zeros(), Vec::new()), Known::default());
        contact.joints = vec![contact.boundary.parameter_at(joint)];
        let middles = contact.boundary.arcs().windows(2).map(|arcs| 0.5 * (arcs[0] + arcs[1]) - 1.0);
        let values: Vec<f64> = middles.map(pressure).collect();
        let active: Vec<bool> = values.iter().map(|&p| p > 0.0).collect();
        let pressure = ContactPressure { contact: &contact, values: &values, active: &active };
        pressure.zones().iter().any(|zone| pressure.grows_at_joint(zone).is_some())
    }

    #[test]
    fn a_pressure_grows_where_materials_meet_if_it_does_so_on_either_side() {
        let power = |r: f64| r.abs().powf(-0.1);
        let sides = |r: f64, [before, behind]: [f64; 2]| if r < 0.0 { before } else { behind };
        assert!(grows_at_joint(1.0, power));
        assert!(grows_at_joint(1.0, |r| sides(r, [0.1, power(r)])) && grows_at_joint(1.0, |r| sides(r, [power(r), 0.1])));
        assert!(grows_at_joint(1.0, |r| sides(r, [-1.0, power(r)])), "one side is open");
        assert!(grows_at_joint(0.97, |r| if r.abs() < 0.15 { 0.5 } else { power(r) }), "its own segment says nothing");
        assert!(!grows_at_joint(1.0, |r| sides(r, [0.01, 6.0])), "a jump between two even pressures");
        assert!(!grows_at_joint(1.0, |r| 1.0 - r * r), "the middle of a round contact");
        assert!(
            !grows_at_joint(1.0, |r| (2.0 * r).exp()) && !grows_at_joint(1.0, |r| (-2.0 * r).exp()),
            "a steep smooth pressure"
        );
        assert!(!grows_at_joint(1.0, |r| 4.0 * (r - 0.9).abs().powf(-0.5) + power(r)), "far below the largest");
    }

    #[test]
    fn a_pressure_is_singular_only_if_it_went_on_growing_with_each_mesh() {
        // In the segment at the end it is 2.
        let singular = |space, before, earlier| grows(space, 1, |r| 2.0 * (0.05 / r).sqrt(), [before, earlier]);
        let found = |before, earlier| singular(MultiplierSpace::P0, Some(before), Some(earlier));
        assert!(found(1.5, 1.0) && found(1.9, 1.8));
        assert!(!found(1.5, 0.7), "each time by much less");
        assert!(!found(1.97, 1.96), "next to nothing");
        assert!(!found(1.5, 1.6), "it fell before");
        assert!(!found(2.5, 1.0), "it falls");
        assert!(!singular(MultiplierSpace::P0, Some(1.5), None), "steps say nothing");
        assert!(singular(MultiplierSpace::P1Discontinuous, Some(1.5), None));
        assert!(!singular(MultiplierSpace::P1Discontinuous, Some(1.97), None));
    }

    #[test]
    fn a_zone_that_ends_inside_or_on_two_segments_is_not_singular() {
        let scene = blocks(pair(MultiplierSpace::P0, 10), |_| Point::zeros(), Vec::new());
        let contact = contact(&scene, Known::default());
        let found = |pressed: std::ops::Range<usize>, end: usize| {
            let power = |k: usize| 1.0 / (if end == 0 { k - pressed.start + 1 } else { pressed.end - k } as f64);
            let values: Vec<f64> = (0..10).map(|k| if pressed.contains(&k) { power(k) } else { 0.0 }).collect();
            let active: Vec<bool> = (0..10).map(|k| pressed.contains(&k)).collect();
            let pressure = ContactPressure { contact: &contact, values: &values, active: &active };
            pressure.grows_towards(&scene, &pressure.zones()[0], end, [None; 2])
        };
        assert!(found(0..5, 0) && found(5..10, 1) && found(0..3, 0) && found(0..10, 1));
        assert!(!found(1..6, 0) && !found(4..9, 1) && !found(0..2, 0) && !found(8..10, 1));
    }

    /// Both ends of a zone that reaches them, and of one that does not.
    fn corners(upper: impl Fn(Point) -> Point, ends: Option<[f64; 2]>) -> [bool; 2] {
        let scene = blocks(pair(MultiplierSpace::P0, 8), upper, Vec::new());
        let contact = contact(&scene, Known { ends, ..Known::default() });
        let zone = |active: &[bool]| Zone::all(&contact.boundary, &contact.multipliers, &[1.0; 8], active).remove(0);
        let inner: Vec<bool> = (0..8).map(|k| (1..7).contains(&k)).collect();
        let pressure = ContactPressure { contact: &contact, values: &[1.0; 8], active: &[true; 8] };
        let of = |zone: &Zone| [0, 1].map(|end| pressure.ends_at_a_corner(&scene.mesh, zone, end));
        assert_eq!(of(&zone(&inner)), [false; 2]);
        of(&zone(&[true; 8]))
    }

    /// λ rises ever more quickly towards both ends, and has changed little since the mesh before.
    #[test]
    fn the_corner_of_a_body_that_presses_on_one_that_goes_on_is_singular_on_any_mesh() {
        let grows = |upper: &dyn Fn(Point) -> Point| {
            let scene = blocks(pair(MultiplierSpace::P0, 8), upper, Vec::new());
            let contact = contact(&scene, Known::default());
            let values = [2.0, 1.3, 1.1, 1.0, 1.0, 1.1, 1.3, 2.0];
            let pressure = ContactPressure { contact: &contact, values: &values, active: &[true; 8] };
            [0, 1].map(|end| pressure.grows_towards(&scene, &pressure.zones()[0], end, [Some(1.99), Some(1.98)]))
        };
        assert_eq!(grows(&|_| Point::zeros()), [false; 2], "both end");
        assert_eq!(grows(&|_| Point::new(0.3, 0.0)), [true; 2]);
    }

    #[test]
    fn a_corner_is_where_one_body_ends_and_the_other_goes_on() {
        assert_eq!(corners(|_| Point::zeros(), None), [false; 2], "both end");
        assert_eq!(corners(|_| Point::new(0.3, 0.0), None), [true; 2]);
        assert_eq!(corners(|_| Point::new(-0.3, 0.0), None), [true; 2]);
        assert_eq!(corners(|x| Point::new(-0.5 * x.x, 0.0), None), [false, true]);
        assert_eq!(corners(|x| Point::new(0.5 * (2.0 - x.x), 0.0), None), [true, false]);
        assert_eq!(corners(|_| Point::zeros(), Some([0.25, 0.75])), [false; 2], "both go on");
    }
}
