//! Estimated errors of λ on one zone that presses, from three signs that are independent of each other: how λ differs from
//! what it was on the mesh before, how far the bodies' stresses are from it, and how coarse the segments are for it.
//!
//! The estimate of a zone is the larger of two figures, times 1.2. One is the smaller of stress and difference: bodies that are
//! bent have stresses that are off by much more than λ, and a difference may be small by luck. The other is what the segments
//! are too coarse for. The factor by which differences fall is taken halfway between what was seen and 4 (`p0`) or 16 (others)
//! in the square. The stresses need no other mesh, so that there is an estimate with `refine = 0`, too.
//!
//! Measured on 13 cases with an exact or a very fine solution, six pairs of spaces each, `segments = "auto"`, in the middle of
//! zones of 4 edges and 4 segments at least, errors below 5e-4 left out: at `refine` 1 to 3 no estimate of 190 is below 0.3 of
//! the truth, two are below 0.5 and nine above 3. At `refine = 0`, 62 zones, none is below 0.5, and half are above 3.
//! `tests/effectivity.rs` holds this. On 3 edges and fewer peaks were 6 to 79 % off.

use crate::contact::{MultiplierSpace, Roughness, Zone};
use crate::discretisation::Contact;
use crate::geometry::Point;
use crate::recovery::ZoneErrors;

/// Largest factor by which squares of errors of λ are taken to fall.
const SLOWEST: f64 = 0.75;

/// Error of λ by its difference from the mesh before, where there is one difference only: P0, and linear.
const BY_ONE: [f64; 2] = [0.58, 0.5];

/// What an estimate is multiplied by: too large does less harm than too small.
const MARGIN: f64 = 1.2;

/// Share of the stresses' distance from λ that an estimate has at least. Where bodies are bent, their stresses are off by much
/// more than λ is, but not by any factor.
const LEAST_OF_STRESS: f64 = 0.02;

/// What a sign is multiplied by that stands alone: it may be small by luck.
const ALONE: f64 = 10.0;

/// Error of the peak by its difference from the mesh before.
const PEAK_BY_ONE: f64 = 0.7;

/// How λ differs on one zone, relative to what it is there.
#[derive(Clone, Debug, PartialEq)]
pub struct ZoneDifference {
    /// Its middle and its length, to be found again on another mesh.
    middle: Point,
    length: f64,
    /// L2 difference of λ in its middle.
    pressure: f64,
    /// The same all over it, but for its ends at those of the boundary.
    inside: f64,
    /// Of its force.
    force: f64,
    /// Of its peak.
    pub peak: f64,
    /// The size that λ had at its ends (stress).
    pub at_ends: [f64; 2],
}

/// Estimated relative errors on one zone; nothing where there is not enough to tell.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ZoneEstimate {
    /// Of λ in the middle of the zone, root mean square.
    pub pressure: Option<f64>,
    /// The same all over it, but for its ends at those of the boundary.
    pub inside: Option<f64>,
    /// The largest of all signs of error of λ, and many times it if there is but one: if it is small, so is the error.
    pub worst: Option<f64>,
    /// Of the force of the zone.
    pub force: Option<f64>,
    /// Of the largest λ.
    pub peak: Option<f64>,
}

impl ZoneDifference {
    /// Compares λ of a contact on a zone with what it was `before`.
    pub(crate) fn new(contact: &Contact, lambda: &[f64], zone: &Zone, before: impl Fn(Point) -> f64) -> Self {
        let boundary = &contact.boundary;
        let (mut squares, mut force, mut peak) = ([[0.0; 2]; 2], 0.0, f64::NEG_INFINITY);
        for (k, z, arc, length) in boundary.gauss_on(0..boundary.segments(), 3) {
            let t = boundary.parameter_on(k, z);
            let there = before(boundary.point(t));
            if zone.reaches(arc) {
                force += length * boundary.width(t) * there;
                peak = there.abs().max(peak);
            }
            let here = contact.multipliers.value(lambda, k, z);
            let counts = [zone.has_in_its_middle(arc), zone.has_inside(arc)];
            for (sums, _) in squares.iter_mut().zip(counts).filter(|(_, counts)| *counts) {
                sums[0] += length * (here - there).powi(2);
                sums[1] += length * here * here;
            }
        }
        let [pressure, inside] = squares.map(|[difference, whole]| (difference / whole).sqrt());
        let [now, top] = [zone.force(&contact.multipliers, lambda), zone.peak(&contact.multipliers, lambda)];
        Self {
            middle: boundary.point(boundary.parameter_at(0.5 * (zone.arcs[0] + zone.arcs[1]))),
            length: zone.length(),
            pressure,
            inside,
            force: (force / now - 1.0).abs(),
            peak: (peak / top - 1.0).abs(),
            at_ends: [(zone.segments.start, 0.05), (zone.segments.end - 1, 0.95)]
                .map(|(k, z)| before(boundary.point(boundary.parameter_on(k, z))).abs()),
        }
    }

    /// The nearest of the zones on another mesh, if it is near.
    pub(crate) fn again<'a>(&self, others: &'a [Self]) -> Option<&'a Self> {
        let away = |other: &&Self| (self.middle - other.middle).norm();
        let nearest = others.iter().min_by(|a, b| away(a).total_cmp(&away(b)));
        nearest.filter(|other| away(other) < 0.5 * self.length.max(other.length))
    }

    /// Error of λ that is left, if it falls halfway between how the differences fall and how it should.
    fn left(&self, before: Option<&Self>, space: MultiplierSpace, of: fn(&Self) -> f64) -> Option<f64> {
        let [at_best, by_one] = match space {
            MultiplierSpace::P0 => [0.25, BY_ONE[0]],
            _ => [0.0625, BY_ONE[1]],
        };
        let rest = |factor: f64| (factor / (1.0 - factor)).sqrt();
        let left = match before {
            Some(before) => {
                let factor = (of(self) / of(before)).powi(2).clamp(at_best, SLOWEST);
                of(self) * (rest(factor) * rest(at_best)).sqrt()
            }
            None => of(self) * by_one,
        };
        Some(left).filter(|left| left.is_finite())
    }
}

/// The three signs of the error of λ on one part of a zone, as far as they are known.
struct Signs {
    /// Mean of both bodies' stresses' distances from λ.
    stress: Option<f64>,
    /// What is left by the differences between meshes.
    left: Option<f64>,
    /// How coarse the segments are.
    rough: Option<f64>,
    /// Whether an edge between two materials ends in the middle of the zone.
    has_joint: bool,
    /// Whether the other body is a rigid tool.
    by_one_body: bool,
}

impl Signs {
    /// The smaller one of stress and difference, but no less than the segments allow. Against a rigid tool the difference counts: by
    /// the stress of the other body alone λ of P1 on a wedge and under a flat punch was 1.3 and 1.4 times as far off as estimated.
    /// Where materials meet and λ may have no bound the larger one counts, with the stress of the body that is farther off: by the
    /// mean of both, errors of three of 22 pressures were up to 1.6 times the estimate.
    fn error(&self) -> Option<f64> {
        let chosen = if self.has_joint { f64::max } else { f64::min };
        let stress = self.stress.filter(|_| self.has_joint || !self.by_one_body || self.left.is_none());
        let error = [stress, self.left].into_iter().flatten().reduce(chosen);
        error.zip(self.rough).map(|(error, rough)| error.max(rough))
    }
}

impl ZoneEstimate {
    /// From what the solution itself says, and the last two differences between meshes as far as there are any.
    pub fn new(space: MultiplierSpace, errors: &ZoneErrors, differences: [Option<&ZoneDifference>; 2]) -> Self {
        let [last, before] = differences;
        let signs = |stress: [f64; 2], left: fn(&ZoneDifference) -> f64, rough: fn(Roughness) -> f64| Signs {
            stress: if errors.has_joint { largest(stress) } else { geometric_mean(stress) },
            left: last.and_then(|last| last.left(before, space, left)),
            rough: errors.roughness.map(rough).filter(|rough| rough.is_finite()),
            has_joint: errors.has_joint,
            by_one_body: errors.by_one_body,
        };
        let middle = signs(errors.stress, |zone| zone.pressure, |rough| rough.middle);
        let inside = signs(errors.stress_inside, |zone| zone.inside, |rough| rough.inside);
        let least = middle.stress.map_or(0.0, |stress| LEAST_OF_STRESS * stress);
        let pressure = middle.error().map(|error| MARGIN * error.max(least));
        let known = [largest(errors.stress), middle.left, middle.rough].into_iter().flatten();
        let alone = if known.clone().count() == 1 { ALONE } else { 1.0 };
        Self {
            pressure,
            inside: inside.error().map(|error| MARGIN * error),
            worst: known.reduce(f64::max).map(|sign| MARGIN * alone * sign),
            force: last.map(|last| 0.5 * last.force).filter(|force| force.is_finite()),
            peak: pressure.and_then(|error| peak(error, middle.stress, errors, last)),
        }
    }
}

/// Error of the peak, with the margin of all estimates; stresses count in so far as they did for `error`, that of λ.
fn peak(error: f64, stress: Option<f64>, errors: &ZoneErrors, last: Option<&ZoneDifference>) -> Option<f64> {
    let share = stress.filter(|stress| *stress > error).map_or(1.0, |stress| (error / stress).sqrt());
    let signs = [
        errors.roughness.map(|rough| rough.peak),
        geometric_mean(errors.stress_at_peak).map(|stress| share * stress),
        last.map(|last| PEAK_BY_ONE * last.peak),
    ];
    signs.into_iter().flatten().filter(|sign| sign.is_finite()).reduce(f64::max).map(|sign| MARGIN * sign)
}

/// The larger of what both bodies say, as far as they say anything.
fn largest(stress: [f64; 2]) -> Option<f64> {
    stress.into_iter().filter(|stress| stress.is_finite()).reduce(f64::max)
}

/// Of both bodies' distances: the finer body follows λ whatever it is, the coarser one is off by its own error.
fn geometric_mean([a, b]: [f64; 2]) -> Option<f64> {
    Some((a * b).sqrt()).filter(|mean| mean.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn difference(pressure: f64) -> ZoneDifference {
        ZoneDifference {
            middle: Point::new(0.5, 0.0),
            length: 1.0,
            pressure,
            inside: pressure,
            force: 0.1,
            peak: 0.1,
            at_ends: [1.0; 2],
        }
    }

    fn errors(stress: f64, middle: f64) -> ZoneErrors {
        ZoneErrors {
            stress: [stress; 2],
            stress_inside: [stress; 2],
            stress_at_peak: [stress; 2],
            roughness: Some(Roughness { middle, inside: middle, peak: 0.01 }),
            has_joint: false,
            by_one_body: false,
        }
    }

    #[test]
    fn errors_that_fall_as_they_should_are_found() {
        // Errors 1/4 and 1/16 of P0 in the square: differences are 3/4 and 3/16 of the first.
        let [before, last] = [0.75f64.sqrt(), 0.1875f64.sqrt()].map(difference);
        let left = last.left(Some(&before), MultiplierSpace::P0, |zone| zone.pressure).expect("two differences");
        assert!((left / 0.0625f64.sqrt() - 1.0).abs() < 1e-12);
    }

    #[test]
    fn the_smaller_of_stress_and_difference_counts_but_never_less_than_roughness() {
        let pressure = |stress, last: f64, middle| {
            let found = ZoneEstimate::new(MultiplierSpace::P0, &errors(stress, middle), [Some(&difference(last)), None]);
            found.pressure.expect("an estimate") / MARGIN
        };
        assert!((pressure(0.02, 1.0, 0.01) - 0.02).abs() < 1e-12);
        assert!((pressure(0.02, 1.0, 0.05) - 0.05).abs() < 1e-12);
        assert!((pressure(0.5, 0.1, 0.01) - 0.058).abs() < 1e-12, "bent bodies");
        assert!((pressure(2.0, 0.01, 0.01) - 0.04).abs() < 1e-12, "a difference that is small by luck");
    }

    #[test]
    fn where_materials_meet_the_larger_sign_counts() {
        let joint = ZoneErrors { has_joint: true, ..errors(0.02, 0.01) };
        let found = |last| ZoneEstimate::new(MultiplierSpace::P0, &joint, [Some(&difference(last)), None]).pressure;
        assert!(found(0.1).is_some_and(|error| (error / MARGIN - 0.058).abs() < 1e-12));
        assert!(found(0.01).is_some_and(|error| (error / MARGIN - 0.02).abs() < 1e-12));
        let uneven = |has_joint| {
            let errors = ZoneErrors { has_joint, stress: [0.02, 0.08], ..errors(0.02, 0.01) };
            ZoneEstimate::new(MultiplierSpace::P0, &errors, [Some(&difference(0.01)), None]).pressure.expect("two signs") / MARGIN
        };
        assert!((uneven(true) - 0.08).abs() < 1e-12 && uneven(false) < 0.04, "the stress of the body that is farther off");
    }

    #[test]
    fn against_a_rigid_tool_the_difference_counts_and_the_stress_where_there_is_none() {
        let tool = ZoneErrors { by_one_body: true, ..errors(0.02, 0.01) };
        let found = |last: Option<&ZoneDifference>| ZoneEstimate::new(MultiplierSpace::P0, &tool, [last, None]).pressure;
        let close = |found: Option<f64>, wanted: f64| assert!(found.is_some_and(|error| (error / MARGIN - wanted).abs() < 1e-12));
        close(found(Some(&difference(0.1))), 0.058);
        close(found(None), 0.02);
    }

    #[test]
    fn one_sign_alone_is_no_estimate() {
        let alone = ZoneErrors { stress: [f64::NAN; 2], ..errors(0.1, 0.1) };
        let found = ZoneEstimate::new(MultiplierSpace::P0, &alone, [None, None]);
        assert_eq!([found.pressure, found.force, found.peak], [None; 3]);
        assert!(found.worst.is_some_and(|worst| worst > 1.0));
    }

    #[test]
    fn a_zone_is_found_again_where_it_was() {
        let at = |from: f64, to: f64| ZoneDifference {
            middle: Point::new(0.5 * (from + to), 0.0),
            length: to - from,
            ..difference(0.1)
        };
        let others = [at(0.0, 1.0), at(3.0, 4.0)];
        assert_eq!(at(3.2, 3.6).again(&others), Some(&others[1]));
        assert_eq!(at(6.0, 6.5).again(&others), None);
    }

    #[test]
    fn what_is_left_falls_half_way_between_what_was_seen_and_what_should_be() {
        // With a factor f of the squares √(f/(1-f)) is left of the last difference: of 1/4 as seen, of 1/16 as it should be.
        let (last, before) = (difference(0.1), difference(0.2));
        let left = last.left(Some(&before), MultiplierSpace::P1Continuous, |zone| zone.pressure).expect("a number");
        let wanted = 0.1 * ((1.0f64 / 3.0).sqrt() * (1.0f64 / 15.0).sqrt()).sqrt();
        assert!((left - wanted).abs() < 1e-12, "{left} instead of {wanted}");
        assert_eq!(last.left(Some(&difference(f64::NAN)), MultiplierSpace::P0, |zone| zone.pressure), None);
    }
}
