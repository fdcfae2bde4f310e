//! What each zone of a contact that presses is, and what is estimated of its pressure.

use crate::contact::Zone;
use crate::discretisation::Contact;
use crate::output::summary::{ContactEstimate, ZoneSummary};
use crate::procedure::Solved;
use crate::recovery::TracePoint;
use crate::run::verdict::limits::{EDGES, GROWS_AT_CORNERS, PROVES};

/// Fewer segments say nothing of each other.
const LEAST_SEGMENTS: usize = 3;

/// The zones of a contact, in order of arc length.
pub struct Zones<'a> {
    solved: &'a Solved,
    /// Place of the contact among all.
    at: usize,
    /// Traces of the contact.
    points: &'a [TracePoint],
    contact: &'a Contact,
    zones: Vec<Zone>,
}

impl<'a> Zones<'a> {
    /// The zones of contact `at`; `points` are its traces.
    pub fn new(solved: &'a Solved, at: usize, points: &'a [TracePoint]) -> Self {
        let contact = &solved.problem.contacts[at];
        Self { solved, at, points, contact, zones: solved.solution.pressure(contact).zones() }
    }

    /// Arc lengths of their ends; on a closed boundary they may go on beyond its seam.
    pub fn arcs(&self) -> Vec<[f64; 2]> {
        self.zones.iter().map(|zone| zone.arcs).collect()
    }

    /// Intervals of arc length that press, in ascending order.
    pub fn closed(&self) -> Vec<[f64; 2]> {
        let mut closed: Vec<[f64; 2]> = self.zones.iter().flat_map(Zone::intervals).collect();
        closed.sort_by(|a, b| a[0].total_cmp(&b[0]));
        closed
    }

    /// Most edges of the softer body on a zone.
    pub fn closed_edges(&self) -> Option<f64> {
        self.zones.iter().map(|zone| self.contact.edges_on(zone)).reduce(f64::max)
    }

    /// Arcs of the zones that anyone would look at.
    pub fn counting(&self) -> Vec<[f64; 2]> {
        self.solved.solution.pressure(self.contact).counting(&self.zones, self.arcs()).collect()
    }

    /// Each zone as the summary has it; `corner_error` is what corners within the contact do to λ.
    pub fn summaries(&self, corner_error: Option<f64>) -> Vec<ZoneSummary> {
        let Self { solved: Solved { problem, solution, estimate, .. }, contact, zones, points, .. } = self;
        let pressure = solution.pressure(contact);
        let estimates = estimate.of_zones(self.at, &pressure, zones, points);
        // Meshes that adapt are refined there by more than one half, or by nothing.
        let goes_on = if self.solved.adaptation.is_none() { estimate.peaks_go_on(self.at) } else { Vec::new() };
        let describe = |(k, share): (usize, f64)| {
            let (zone, (found, at_ends)) = (&zones[k], &estimates[k]);
            let before = |end: usize| at_ends.map(|values| values.map(|values| values[end]));
            let grows = (0..2).any(|end| pressure.grows_towards(&problem.scene, zone, end, before(end)));
            let goes_on = goes_on.get(k).is_none_or(|goes_on| *goes_on);
            let joint = pressure.grows_at_joint(zone).filter(|_| goes_on).map(|t| contact.boundary.point(t).into());
            let at_end = is_singular(grows, corner_error);
            let singular = at_end || joint.is_some();
            let edges = contact.edges_on(zone);
            // All signs of a narrow zone may be small beside its error, unless they are very small.
            let wide = edges >= EDGES.value && contact.segments_on(zone) >= LEAST_SEGMENTS;
            let tells = |_: &f64| wide || found.worst.is_some_and(|worst| worst <= PROVES);
            ZoneSummary {
                ends: Some(zone.arcs),
                edges: Some(edges),
                segments: Some(contact.segments_on(zone)),
                share: Some(share),
                hertz_width: pressure.hertz_width(zone, points),
                pressure_max: Some(pressure.peak_of(zone)),
                lambda: found.pressure.filter(tells),
                whole: found.inside.filter(tells),
                worst: found.worst,
                force: found.force,
                peak: peak_error(found.peak.filter(tells), singular).map(|error| error.max(pressure.variation_at_joints(zone))),
                peak_at_end: Some(pressure.peaks_at_end(zone)),
                singular: Some(singular),
                singular_at_end: Some(at_end),
                singular_at: joint,
                cut_off: Some(pressure.cut_off(&problem.scene.mesh, zone, &problem.contacts)),
                corner: Some((0..2).any(|end| pressure.ends_at_a_corner(&problem.scene.mesh, zone, end))),
            }
        };
        pressure.shares(zones).into_iter().enumerate().map(describe).collect()
    }
}

/// Whether λ grows without bound towards an end: beside corners that matter it grows, too, and what looks singular may be one of
/// them.
fn is_singular(grows: bool, corner_error: Option<f64>) -> bool {
    grows && !corner_error.is_some_and(|error| error > GROWS_AT_CORNERS)
}

/// The error of the largest pressure, which has none where it grows without bound.
fn peak_error(estimated: Option<f64>, singular: bool) -> Option<f64> {
    estimated.filter(|_| !singular)
}

/// Estimated errors of the whole contact: those of its worst zone that counts, the peak of its highest.
pub fn contact_estimate(force: Option<f64>, zones: &[ZoneSummary]) -> ContactEstimate {
    let lambda: Option<Vec<f64>> = ZoneSummary::counting(zones).map(|zone| zone.lambda).collect();
    let highest = zones.iter().max_by(|a, b| a.pressure_max.unwrap_or(0.0).total_cmp(&b.pressure_max.unwrap_or(0.0)));
    ContactEstimate {
        force,
        lambda: lambda.and_then(|all| all.into_iter().reduce(f64::max)),
        peak: highest.and_then(|zone| zone.peak),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn growth_beside_corners_that_matter_is_not_called_singular() {
        assert_eq!([None, Some(0.004), Some(0.006)].map(|error| is_singular(true, error)), [true, true, false]);
        assert!(!is_singular(false, None));
    }

    #[test]
    fn only_singular_zones_lose_the_error_of_their_peak() {
        assert_eq!([true, false].map(|singular| peak_error(Some(0.1), singular)), [None, Some(0.1)]);
    }

    #[test]
    fn a_contact_has_the_error_of_its_worst_zone_and_the_peak_of_its_highest() {
        let zone = |pressure_max, share, lambda, peak| ZoneSummary {
            pressure_max: Some(pressure_max),
            share: Some(share),
            lambda,
            peak: Some(peak),
            ..ZoneSummary::default()
        };
        let all = [zone(1.0, 0.3, Some(0.02), 0.1), zone(3.0, 0.4, Some(0.05), 0.2), zone(2.0, 0.3, Some(0.03), 0.3)];
        let found = contact_estimate(Some(0.01), &all);
        assert_eq!((found.force, found.lambda, found.peak), (Some(0.01), Some(0.05), Some(0.2)));
        // What nobody would look at says nothing; what cannot be told of one zone is not of the contact.
        let faint = zone(0.01, 1e-3, Some(0.9), 0.9);
        assert_eq!(contact_estimate(None, &[all[0].clone(), faint]).lambda, Some(0.02));
        assert_eq!(contact_estimate(None, &[all[0].clone(), zone(1.0, 0.5, None, 0.1)]).lambda, None);
    }
}
