//! Intervals of a contact boundary that press.

use crate::contact::contact_boundary::ContactBoundary;
use crate::contact::multiplier::Multipliers;
use crate::mesh::each_once;
use std::ops::Range;

/// Share of the length of a zone that counts as its middle: at its ends λ falls like a root, or is singular.
const MIDDLE: f64 = 0.6;

/// Share of the length of a zone that is left out beside an end of the boundary.
const BESIDE: f64 = 0.1;

/// Share of the force from which a zone counts.
const LEAST_SHARE: f64 = 0.01;

/// Share of the highest pressure from which a zone counts, however small its force is.
const LEAST_PRESSURE: f64 = 0.1;

/// Whether anyone would look at a zone: by its share of the force of its contact, and its peak beside the `highest` of all.
pub fn zone_counts(share: f64, peak: f64, highest: f64) -> bool {
    share.abs() >= LEAST_SHARE || peak >= LEAST_PRESSURE * highest
}

/// Neighbouring segments that carry pressure, with none beside them that does. On a closed boundary a zone may go on across the
/// seam: its segments and arc lengths then go on beyond those of the boundary.
#[derive(Clone, Debug, PartialEq)]
pub struct Zone {
    /// Segments of the zone.
    pub segments: Range<usize>,
    /// Arc lengths of its ends.
    pub arcs: [f64; 2],
    /// Arc lengths of the ends of its reach: half way to the next zone, or the end of the boundary.
    pub reach: [f64; 2],
    /// Whether it reaches the ends of the boundary; a closed one has none.
    pub is_at_end: [bool; 2],
    /// Length of the boundary, if that is closed.
    turn: Option<f64>,
}

impl Zone {
    /// All zones of a boundary, in order of arc length. None where λ is zero all along: multipliers that are active there
    /// touch without pressure.
    pub fn all(boundary: &ContactBoundary, multipliers: &Multipliers, lambda: &[f64], active: &[bool]) -> Vec<Self> {
        if lambda.iter().all(|&pressure| pressure == 0.0) {
            return Vec::new();
        }
        let presses = |k: usize| multipliers.on_segment(k, 0.0).0.iter().any(|&i| active[i]);
        let mut ranges: Vec<Range<usize>> = Vec::new();
        for k in (0..boundary.segments()).filter(|&k| presses(k)) {
            match ranges.last_mut() {
                Some(range) if range.end == k => range.end = k + 1,
                _ => ranges.push(k..k + 1),
            }
        }
        if boundary.is_closed() {
            join_across_the_seam(&mut ranges, boundary.segments());
        }
        let arcs = |range: &Range<usize>| [boundary.segment_arcs(range.start)[0], boundary.segment_arcs(range.end - 1)[1]];
        let ends: Vec<[f64; 2]> = ranges.iter().map(arcs).collect();
        let ends_of_reach = |k: usize| {
            let half_way = |before: f64, behind: f64| 0.5 * (before + behind);
            let (first, last) = (ends[0][0], ends[ends.len() - 1][1]);
            let before = |turn: f64| half_way(last - turn, first);
            let outside = boundary.turn().map_or([0.0, boundary.length()], |turn| [before(turn), before(turn) + turn]);
            let low = if k == 0 { outside[0] } else { half_way(ends[k - 1][1], ends[k][0]) };
            let high = if k + 1 == ends.len() { outside[1] } else { half_way(ends[k][1], ends[k + 1][0]) };
            [low, high]
        };
        let at_end =
            |range: &Range<usize>| [range.start == 0, range.end == boundary.segments()].map(|at| at && !boundary.is_closed());
        let zone = |(k, range): (usize, &Range<usize>)| Self {
            segments: range.clone(),
            arcs: ends[k],
            reach: ends_of_reach(k),
            is_at_end: at_end(range),
            turn: boundary.turn(),
        };
        ranges.iter().enumerate().map(zone).collect()
    }

    /// Length of the zone (arc length).
    pub fn length(&self) -> f64 {
        self.arcs[1] - self.arcs[0]
    }

    /// Whether it goes all around a closed boundary.
    pub fn goes_round(&self) -> bool {
        self.turn.is_some_and(|turn| self.length() >= turn * (1.0 - 1e-12))
    }

    /// An arc length of a closed boundary as the zone counts it, within one turn about its middle.
    fn as_counted(&self, arc: f64) -> f64 {
        let middle = 0.5 * (self.arcs[0] + self.arcs[1]);
        self.turn.map_or(arc, |turn| middle + (arc - middle + 0.5 * turn).rem_euclid(turn) - 0.5 * turn)
    }

    /// Whether an arc length lies in the middle of the zone; all of a zone without ends is.
    pub fn has_in_its_middle(&self, arc: f64) -> bool {
        self.goes_round() || ((self.as_counted(arc) - self.arcs[0]) / self.length() - 0.5).abs() <= 0.5 * MIDDLE
    }

    /// Whether an arc length lies in the zone, and not beside an end of the boundary, where λ may be singular.
    pub fn has_inside(&self, arc: f64) -> bool {
        let beside = |end: usize| if self.is_at_end[end] { BESIDE * self.length() } else { 0.0 };
        let arc = self.as_counted(arc);
        self.goes_round() || (arc >= self.arcs[0] + beside(0) && arc <= self.arcs[1] - beside(1))
    }

    /// Whether an arc length lies in the reach of the zone.
    pub fn reaches(&self, arc: f64) -> bool {
        let arc = self.as_counted(arc);
        self.goes_round() || (arc > self.reach[0] && arc < self.reach[1])
    }

    /// Intervals of arc length of the zone on the boundary: two, if it goes on across the seam.
    pub fn intervals(&self) -> Vec<[f64; 2]> {
        let [from, to] = self.arcs;
        match self.turn {
            Some(turn) if to > turn * (1.0 + 1e-12) => vec![[0.0, to - turn], [from, turn]],
            _ => vec![self.arcs],
        }
    }

    /// `∫λ ds` (force per thickness).
    pub fn force(&self, multipliers: &Multipliers, lambda: &[f64]) -> f64 {
        let rows = each_once(self.segments.clone().flat_map(|k| multipliers.on_segment(k, 0.0).0));
        rows.into_iter().map(|i| lambda[i] * multipliers.integral(i)).sum()
    }

    /// Largest size of λ (stress): a zone of a bilateral contact may pull.
    pub fn peak(&self, multipliers: &Multipliers, lambda: &[f64]) -> f64 {
        self.values_at_ends(multipliers, lambda).map(|(value, ..)| value).fold(f64::NEG_INFINITY, f64::max)
    }

    /// Whether the largest λ, by its size, lies beside an end of the boundary, be it there alone or elsewhere, too.
    pub fn peaks_at_end(&self, boundary: &ContactBoundary, multipliers: &Multipliers, lambda: &[f64]) -> bool {
        let highest = self.peak(multipliers, lambda);
        let is_beside = |arc: f64| (0..2).any(|end| self.is_at_end[end] && (arc - self.arcs[end]).abs() < BESIDE * self.length());
        let mut values = self.values_at_ends(multipliers, lambda);
        values.any(|(value, segment, end)| value >= highest && is_beside(boundary.segment_arcs(segment)[end]))
    }

    /// Sizes of λ (stress) at both ends of each segment: size, segment, end.
    fn values_at_ends(&self, multipliers: &Multipliers, lambda: &[f64]) -> impl Iterator<Item = (f64, usize, usize)> {
        self.segments.clone().flat_map(|k| [0, 1].map(|end| (multipliers.value(lambda, k, end as f64).abs(), k, end)))
    }
}

/// Ranges of neighbouring segments at both ends of a closed boundary are one.
fn join_across_the_seam(ranges: &mut Vec<Range<usize>>, segments: usize) {
    if ranges.len() > 1 && ranges[0].start == 0 && ranges[ranges.len() - 1].end == segments {
        let first = ranges.remove(0);
        let last = ranges.len() - 1;
        ranges[last].end = segments + first.end;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::pair::MultiplierSpace;
    use crate::geometry::{Curve, Point};

    /// A boundary cut into ten segments, with the pressures 1, 2, ... on some of its multipliers.
    fn zones_of(
        mut boundary: ContactBoundary,
        space: MultiplierSpace,
        active: impl Fn(usize) -> bool,
    ) -> (Vec<Zone>, Multipliers, Vec<f64>) {
        boundary.cut(&(0..=10).map(|k| k as f64 / 10.0).collect::<Vec<_>>());
        let multipliers = Multipliers::new(space, &boundary);
        let active: Vec<bool> = (0..multipliers.count()).map(active).collect();
        let lambda: Vec<f64> = (0..active.len()).map(|i| if active[i] { (i + 1) as f64 } else { 0.0 }).collect();
        (Zone::all(&boundary, &multipliers, &lambda, &active), multipliers, lambda)
    }

    /// The zones of a line of length 10 in ten segments.
    fn zones(space: MultiplierSpace, active: impl Fn(usize) -> bool) -> (Vec<Zone>, Multipliers, Vec<f64>) {
        let boundary = ContactBoundary::new(Curve::Line([[0.0, 0.0], [10.0, 0.0]]), [0.0, 1.0], Point::new(0.0, 1.0));
        zones_of(boundary, space, active)
    }

    #[test]
    fn zones_reach_half_way_to_each_other_and_to_the_ends() {
        let (zones, multipliers, lambda) = zones(MultiplierSpace::P0, |k| (0..3).contains(&k) || (7..9).contains(&k));
        let [first, second] = &zones[..] else { panic!("{zones:?}") };
        assert_eq!((&first.segments, &second.segments), (&(0..3), &(7..9)));
        assert_eq!([first.is_at_end, second.is_at_end], [[true, false], [false, false]]);
        for (found, expected) in
            [(first.arcs, [0.0, 3.0]), (first.reach, [0.0, 5.0]), (second.arcs, [7.0, 9.0]), (second.reach, [5.0, 10.0])]
        {
            assert!((0..2).all(|k| (found[k] - expected[k]).abs() < 1e-12), "{found:?} instead of {expected:?}");
        }
        let forces = [first, second].map(|zone| zone.force(&multipliers, &lambda));
        assert!((forces[0] - 6.0).abs() < 1e-12 && (forces[1] - 17.0).abs() < 1e-12, "{forces:?}");
        assert_eq!([first, second].map(|zone| zone.peak(&multipliers, &lambda)), [3.0, 9.0]);
    }

    #[test]
    fn forces_and_peaks_are_those_of_all_multipliers_that_press() {
        for (space, force, peak) in [
            (MultiplierSpace::P1Discontinuous, 0.5 * (5.0 + 6.0 + 7.0 + 8.0), 8.0),
            (MultiplierSpace::P1Continuous, 3.0 + 4.0, 4.0),
        ] {
            // Both ends of the segments from 2 to 4; nodes 2 and 3.
            let pressed = if space == MultiplierSpace::P1Continuous { 2..4 } else { 4..8 };
            let (zones, multipliers, lambda) = zones(space, |i| pressed.contains(&i));
            assert_eq!(zones.len(), 1);
            assert!((zones[0].force(&multipliers, &lambda) - force).abs() < 1e-12, "{space:?}");
            assert_eq!(zones[0].peak(&multipliers, &lambda), peak);
        }
    }

    #[test]
    fn the_tenth_beside_an_end_of_the_boundary_is_left_out() {
        let (zones, ..) = zones(MultiplierSpace::P0, |k| k < 5);
        let inside = |arc: f64| zones[0].has_inside(arc);
        assert_eq!([0.4, 0.6, 4.9, 5.1].map(inside), [false, true, true, false]);
        let middle = |arc: f64| zones[0].has_in_its_middle(arc);
        assert_eq!([0.9, 1.1, 3.9, 4.1].map(middle), [false, true, true, false]);
    }

    #[test]
    fn middle_and_rest_of_a_zone_are_counted_from_its_own_ends() {
        let (found, ..) = zones(MultiplierSpace::P0, |k| (4..9).contains(&k));
        assert!((found[0].length() - 5.0).abs() < 1e-12);
        let middle = |arc: f64| found[0].has_in_its_middle(arc);
        assert_eq!([4.9, 5.1, 7.9, 8.1].map(middle), [false, true, true, false]);
        let (found, ..) = zones(MultiplierSpace::P0, |k| k >= 5);
        let inside = |arc: f64| found[0].has_inside(arc);
        assert_eq!([4.9, 5.1, 9.4, 9.6].map(inside), [false, true, true, false], "the tenth at the end of the boundary");
    }

    fn cut(mut boundary: ContactBoundary) -> ContactBoundary {
        boundary.cut(&(0..=10).map(|k| k as f64 / 10.0).collect::<Vec<_>>());
        boundary
    }

    #[test]
    fn the_largest_pressure_may_lie_at_an_end_of_the_boundary_from_either_side() {
        let line = cut(ContactBoundary::new(Curve::Line([[0.0, 0.0], [10.0, 0.0]]), [0.0, 1.0], Point::new(0.0, 1.0)));
        for space in [MultiplierSpace::P0, MultiplierSpace::P1Discontinuous, MultiplierSpace::P1Continuous] {
            let (all, multipliers, mut lambda) = zones(space, |_| true);
            let is_at_end = |lambda: &[f64]| all[0].peaks_at_end(&line, &multipliers, lambda);
            assert!(is_at_end(&lambda), "{space:?}: it rises up to the end");
            lambda.reverse();
            assert!(is_at_end(&lambda), "{space:?}: it falls from the other end");
            assert!(is_at_end(&vec![1.0; lambda.len()]), "{space:?}: it is the same everywhere");
            lambda[all.len() * multipliers.count() / 2] = 1e3;
            assert!(!is_at_end(&lambda), "{space:?}: it lies in the middle");
        }
        // An end of contact within the boundary is none.
        let (found, multipliers, lambda) = zones(MultiplierSpace::P0, |k| k < 5);
        assert!(!found[0].peaks_at_end(&line, &multipliers, &lambda));
    }

    #[test]
    fn a_closed_boundary_has_no_end_for_the_largest_pressure() {
        let tau = std::f64::consts::TAU;
        let curve = Curve::Circle { centre: [0.0, 0.0], radius: 10.0 / tau };
        let circle = cut(ContactBoundary::new(curve, [0.0, tau], Point::new(-1.0, 0.0)));
        for pressed in (0..20).map(|from| (from..from + 2).map(|k| k % 20).collect::<Vec<_>>()) {
            let (found, multipliers, lambda) = zones_around(MultiplierSpace::P1Discontinuous, |i| pressed.contains(&i));
            assert!(found.iter().all(|zone| !zone.peaks_at_end(&circle, &multipliers, &lambda)), "{pressed:?}");
        }
    }

    /// The zones of a circle of length 10 in ten segments.
    fn zones_around(space: MultiplierSpace, active: impl Fn(usize) -> bool) -> (Vec<Zone>, Multipliers, Vec<f64>) {
        let tau = std::f64::consts::TAU;
        let curve = Curve::Circle { centre: [0.0, 0.0], radius: 10.0 / tau };
        let boundary = ContactBoundary::new(curve, [0.0, tau], Point::new(-1.0, 0.0));
        zones_of(boundary, space, active)
    }

    #[test]
    fn a_zone_across_the_seam_is_one() {
        let near = |found: &[f64], wanted: &[f64]| {
            assert!(found.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 1e-9), "{found:?} instead of {wanted:?}")
        };
        let (zones, multipliers, lambda) = zones_around(MultiplierSpace::P0, |k| k < 2 || (4..5).contains(&k) || k >= 7);
        let [small, across] = &zones[..] else { panic!("{zones:?}") };
        assert_eq!((&small.segments, &across.segments), (&(4..5), &(7..12)));
        near(&across.arcs, &[7.0, 12.0]);
        near(across.intervals().as_flattened(), &[0.0, 2.0, 7.0, 10.0]);
        near(&across.reach, &[6.0, 13.0]);
        near(&small.reach, &[3.0, 6.0]);
        assert!(!across.is_at_end[0] && !across.is_at_end[1] && !across.goes_round());
        near(&[across.force(&multipliers, &lambda), across.peak(&multipliers, &lambda)], &[1.0 + 2.0 + 8.0 + 9.0 + 10.0, 10.0]);
        assert_eq!([0.9, 1.1, 8.1, 7.9].map(|arc| across.has_in_its_middle(arc)), [true, false, true, false]);
        assert_eq!([1.9, 2.1, 7.1, 6.9].map(|arc| across.has_inside(arc)), [true, false, true, false]);
        assert_eq!([2.9, 3.1, 6.1, 5.9].map(|arc| across.reaches(arc)), [true, false, true, false]);
        // Node 0 is between the last segment and the first.
        let (zones, ..) = zones_around(MultiplierSpace::P1Continuous, |k| k == 0);
        assert!(zones.len() == 1 && zones[0].segments == (9..11));
        let (all, multipliers, lambda) = zones_around(MultiplierSpace::P1Continuous, |_| true);
        assert!(all.len() == 1 && all[0].goes_round() && all[0].has_in_its_middle(0.1) && all[0].has_inside(9.9));
        near(&[all[0].force(&multipliers, &lambda)], &[55.0]);
        near(&all[0].reach, &[0.0, 10.0]);
    }
}
