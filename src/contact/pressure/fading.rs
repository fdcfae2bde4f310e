//! Where a pressure that fades out comes to nothing, between the ends of segments.

use crate::contact::contact_boundary::ContactBoundary;
use crate::contact::multiplier::Multipliers;
use crate::contact::pressure::zones::Zone;

/// Powers of the distance that pressures fade out with: smooth contact of smooth bodies, a wedge, a gap that opens slowly.
const POWERS: [f64; 4] = [0.5, 1.0, 1.5, 2.0];

/// Largest share by which the pressure farthest from the end may be off a power law.
const MOST_OFF: f64 = 0.1;

/// Arc length at which the pressure of a zone comes to nothing, by the means of λ on three segments near its first end (0) or its
/// last (1). The outermost segment says nothing: the set of active multipliers decides what is on it. The end lies no farther
/// inside than that segment, and outside than as much again. Nothing where λ does not fade out like a power of the distance.
pub fn faded_end(boundary: &ContactBoundary, multipliers: &Multipliers, lambda: &[f64], zone: &Zone, end: usize) -> Option<f64> {
    if zone.segments.len() < 4 || zone.goes_round() {
        return None;
    }
    let nth = |i: usize| if end == 0 { zone.segments.start + i } else { zone.segments.end - 1 - i };
    let length = boundary.segment_length(nth(0));
    let middle = |k: usize| 0.5 * boundary.segment_arcs(k).iter().sum::<f64>();
    // Distances from the end of the outermost segment, inwards.
    let inwards = |s: f64| if end == 0 { s - zone.arcs[0] } else { zone.arcs[1] - s };
    let near = [1, 2, 3].map(nth).map(|k| (inwards(middle(k)), multipliers.value(lambda, k, 0.5)));
    let [(a, p), (b, q), (c, r)] = near;
    if !(0.0 < p && p < q && q < r) {
        return None;
    }
    let by_power = |power: f64| {
        let [y, z] = [p, q].map(|value| value.powf(1.0 / power));
        let slope = (z - y) / (b - a);
        let off = ((y + slope * (c - a)).max(0.0).powf(power) / r - 1.0).abs();
        (off, a - y / slope)
    };
    let (off, inside) = POWERS.map(by_power).into_iter().min_by(|one, other| one.0.total_cmp(&other.0))?;
    (off < MOST_OFF && inside.abs() <= length).then_some(if end == 0 { zone.arcs[0] + inside } else { zone.arcs[1] - inside })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::pair::MultiplierSpace;
    use crate::geometry::{Curve, Point};

    /// Of a pressure `(end - s)^power` on ten even segments of a line of length one, and of the same seen from the other side.
    fn found(power: f64, at: f64) -> [Option<f64>; 2] {
        let mut boundary = ContactBoundary::new(Curve::Line([[0.0, 0.0], [1.0, 0.0]]), [0.0, 1.0], Point::new(0.0, 1.0));
        boundary.cut(&(0..=10).map(|k| f64::from(k) / 10.0).collect::<Vec<_>>());
        let multipliers = Multipliers::new(MultiplierSpace::P0, &boundary);
        let primitive = |s: f64| -(at - s).max(0.0).powf(power + 1.0) / (power + 1.0);
        let mut lambda: Vec<f64> = (0..10).map(|k| primitive(0.1 * f64::from(k + 1)) - primitive(0.1 * f64::from(k))).collect();
        [1, 0].map(|end| {
            let active: Vec<bool> = lambda.iter().map(|value| *value > 0.0).collect();
            let zones = Zone::all(&boundary, &multipliers, &lambda, &active);
            let found = faded_end(&boundary, &multipliers, &lambda, &zones[0], end);
            lambda.reverse();
            if end == 0 { found.map(|s| 1.0 - s) } else { found }
        })
    }

    #[test]
    fn pressures_that_fade_out_end_within_a_segment() {
        for power in [0.5, 1.0, 1.5, 2.0] {
            for at in [0.61, 0.65, 0.69] {
                let [last, first] = found(power, at).map(|end| end.expect("it fades out"));
                assert!((last - at).abs() < 0.02, "power {power}: {last} instead of {at}");
                assert!((first - last).abs() < 1e-12, "{first}, {last}");
            }
        }
    }

    #[test]
    fn a_pressure_that_does_not_fade_has_no_such_end() {
        assert_eq!(found(0.02, 0.65)[0], None);
        assert_eq!(found(1.0, 0.25)[0], None, "three segments");
    }
}
