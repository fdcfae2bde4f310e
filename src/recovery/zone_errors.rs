//! What one solution alone says of the errors of λ on each zone that presses.

use super::traces::TracePoint;
use crate::contact::{Roughness, Zone, roughness};
use crate::discretisation::Contact;

/// Signs of error on one zone, relative to its pressure.
#[derive(Clone, Debug, PartialEq)]
pub struct ZoneErrors {
    /// Root mean squares of `λ + n·σn` of body 1 and body 2 in the middle of the zone.
    pub stress: [f64; 2],
    /// The same all over it, but for its ends at those of the boundary.
    pub stress_inside: [f64; 2],
    /// The same on the segments beside its peak.
    pub stress_at_peak: [f64; 2],
    /// λ against its reconstruction.
    pub roughness: Option<Roughness>,
    /// Whether an edge between two materials ends in the middle of the zone.
    pub has_joint: bool,
    /// Whether one of the bodies is a rigid tool, which has no stress: that of the other one stands for both.
    pub by_one_body: bool,
}

/// One for each zone; `points` are those of [`super::Evaluation::traces`].
pub fn zone_errors(contact: &Contact, lambda: &[f64], zones: &[Zone], points: &[TracePoint]) -> Vec<ZoneErrors> {
    // The stress of a body that bears a load there says nothing of λ.
    let apart = |counts: &dyn Fn(f64) -> bool| {
        let found = apart(points, counts, |point, k| on_boundary(contact, point, k));
        let speaks = [0, 1].map(|k| if contact.rigid[k] { 1 - k } else { k });
        speaks.map(|k| if contact.loaded[k] { f64::NAN } else { found[k] })
    };
    let one = |zone: &Zone| {
        let boundary = &contact.boundary;
        let height = |k: &usize| contact.multipliers.value(lambda, *k, 0.5);
        let top = zone.segments.clone().max_by(|a, b| height(a).total_cmp(&height(b))).unwrap_or(zone.segments.start);
        // One segment before the highest one, and one behind it.
        let (top, first, last) = match zone.goes_round() {
            true => (top + boundary.segments(), 0, usize::MAX),
            false => (top, zone.segments.start, zone.segments.end - 1),
        };
        let near = [boundary.segment_arcs(top.saturating_sub(1).max(first))[0], boundary.segment_arcs((top + 1).min(last))[1]];
        let is_near = |arc: f64| {
            let beyond = boundary.turn().map_or(0.0, |turn| ((arc - near[0]) / turn).floor() * turn);
            arc - beyond >= near[0] && arc - beyond <= near[1]
        };
        ZoneErrors {
            stress: apart(&|arc| zone.has_in_its_middle(arc)),
            stress_inside: apart(&|arc| zone.has_inside(arc)),
            stress_at_peak: apart(&is_near),
            roughness: roughness(&contact.boundary, &contact.multipliers, lambda, zone),
            has_joint: contact.joints.iter().any(|&joint| zone.has_in_its_middle(boundary.arc(joint))),
            by_one_body: contact.rigid.contains(&true),
        }
    };
    zones.iter().map(one).collect()
}

/// By what the stress at a body's corresponding point becomes one per area of Γ_C: in a body of revolution a ring that lies farther
/// from the axis is longer.
fn on_boundary(contact: &Contact, point: &TracePoint, body: usize) -> f64 {
    let width = |x| contact.boundary.width_at(x);
    let own = width(point.x);
    // On the axis, or beside it by rounding, both rings have no radius.
    let is_ring = own > 1e-9 * contact.boundary.length();
    if is_ring { width(point.x + point.distance[body] * point.normal) / own } else { 1.0 }
}

/// Relative root mean squares of `λ + n·σn` of both bodies over some arc lengths, by the trapezoidal rule, each stress times a factor.
fn apart(points: &[TracePoint], counts: impl Fn(f64) -> bool, factor: impl Fn(&TracePoint, usize) -> f64) -> [f64; 2] {
    let mut sums = [0.0; 3];
    let complete = points.iter().filter(|point| point.is_complete());
    let ends = complete.clone().zip(complete.skip(1));
    for (first, second) in ends.filter(|(first, second)| counts(first.arc) && counts(second.arc)) {
        let half = 0.5 * (second.arc - first.arc);
        for point in [first, second] {
            for (k, (sum, stress)) in sums.iter_mut().zip(point.stress).enumerate() {
                *sum += half * (point.lambda + factor(point, k) * stress).powi(2);
            }
            sums[2] += half * point.lambda.powi(2);
        }
    }
    [0, 1].map(|k| (sums[k] / sums[2]).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stresses_are_apart_from_the_pressure_by_their_root_mean_square() {
        // Uneven points; λ is 2, and the stresses miss it by 0.1 and by 0.2 times the arc length, where both bodies are.
        let arcs: Vec<f64> = (0..=40).map(|k| (f64::from(k) / 40.0).powi(2) * 3.0).collect();
        let zero = crate::geometry::Point::zeros();
        let point = |&arc: &f64| TracePoint {
            arc,
            x: zero,
            normal: zero,
            lambda: 2.0,
            displacement: [0.0; 2],
            slip: 0.0,
            stress: [-2.1, 0.2 * arc - 2.0],
            distance: [0.0; 2],
            gap: 0.0,
        };
        let points: Vec<TracePoint> = arcs.iter().map(point).collect();
        let [first, second] = apart(&points, |arc| arc <= 3.0, |_, _| 1.0);
        assert!((first - 0.05).abs() < 1e-12 && (second - 0.1 * 3f64.sqrt()).abs() < 1e-3, "{first}, {second}");
        let [_, half] = apart(&points, |arc| arc <= 1.5, |_, _| 1.0);
        assert!((half - 0.1 * (1.5f64 * 1.5 / 3.0).sqrt()).abs() < 5e-3, "{half}");
    }
}
