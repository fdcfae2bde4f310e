//! λ made smoother than its space: what the segments are too coarse for shows in the difference.

use crate::contact::contact_boundary::ContactBoundary;
use crate::contact::multiplier::Multipliers;
use crate::contact::pair::MultiplierSpace;
use crate::contact::pressure::zones::Zone;

/// A sample nearer to the one before than this share of its distance to the next says the same.
const SAME: f64 = 0.02;

/// Samples that a value is interpolated from.
const NEIGHBOURS: usize = 4;

/// Differences between λ on a zone and its reconstruction, relative to λ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Roughness {
    /// Root mean square of the difference in the middle of the zone.
    pub middle: f64,
    /// Root mean square of the difference on the zone, but for its ends at those of the boundary.
    pub inside: f64,
    /// Difference of the largest values.
    pub peak: f64,
}

/// How far λ on a zone is from the cubics through its best samples: the middles of segments (P0), their two Gauss points (P1
/// discontinuous), their ends (P1 continuous), and zero where contact ends inside the boundary. Nothing if there are fewer
/// than three samples.
pub fn roughness(boundary: &ContactBoundary, multipliers: &Multipliers, lambda: &[f64], zone: &Zone) -> Option<Roughness> {
    let mut samples = apart(&samples(boundary, multipliers, lambda, zone));
    if samples.len() < 3 {
        return None;
    }
    if zone.goes_round() {
        samples = around(&samples, zone.length());
    }
    let (mut middle, mut inside, mut peak) = ([0.0; 2], [0.0; 2], f64::NEG_INFINITY);
    for (k, z, arc, length) in boundary.gauss_on(zone.segments.clone(), 5) {
        let smooth = interpolate(&samples, arc);
        peak = peak.max(smooth.abs());
        let here = multipliers.value(lambda, k, z);
        for (sums, counts) in [(&mut middle, zone.has_in_its_middle(arc)), (&mut inside, zone.has_inside(arc))] {
            if counts {
                sums[0] += length * (here - smooth).powi(2);
                sums[1] += length * here * here;
            }
        }
    }
    let highest = zone.peak(multipliers, lambda);
    let [middle, inside] = [middle, inside].map(|sums| (sums[0] / sums[1]).sqrt());
    Some(Roughness { middle, inside, peak: (peak / highest - 1.0).abs() })
}

/// Samples all around a closed boundary, with some of the last before the first and some of the first behind the last.
fn around(samples: &[[f64; 2]], turn: f64) -> Vec<[f64; 2]> {
    // The first and the last one may be the same end of a segment.
    let count =
        if samples[samples.len() - 1][0] - samples[0][0] > turn * (1.0 - 1e-12) { samples.len() - 1 } else { samples.len() };
    let more = NEIGHBOURS.min(count);
    let at = |k: usize| [samples[k % count][0] + ((k / count) as f64 - 1.0) * turn, samples[k % count][1]];
    (count - more..2 * count + more).map(at).collect()
}

/// Arc lengths and values.
fn samples(boundary: &ContactBoundary, multipliers: &Multipliers, lambda: &[f64], zone: &Zone) -> Vec<[f64; 2]> {
    let at = |k: usize, z: f64| {
        let [from, to] = boundary.segment_arcs(k);
        [from + z * (to - from), multipliers.value(lambda, k, z)]
    };
    let gauss = 0.5 / 3f64.sqrt();
    let segments = zone.segments.clone();
    let mut samples: Vec<[f64; 2]> = match multipliers.space {
        MultiplierSpace::P0 => segments.map(|k| at(k, 0.5)).collect(),
        MultiplierSpace::P1Discontinuous => segments.flat_map(|k| [at(k, 0.5 - gauss), at(k, 0.5 + gauss)]).collect(),
        MultiplierSpace::P1Continuous => {
            return std::iter::once(at(zone.segments.start, 0.0)).chain(segments.map(|k| at(k, 1.0))).collect();
        }
    };
    if !zone.is_at_end[0] && !zone.goes_round() {
        samples.insert(0, [zone.arcs[0], 0.0]);
    }
    if !zone.is_at_end[1] && !zone.goes_round() {
        samples.push([zone.arcs[1], 0.0]);
    }
    samples
}

/// Samples without those of a segment much shorter than its neighbours.
fn apart(samples: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut kept: Vec<[f64; 2]> = Vec::new();
    for (k, sample) in samples.iter().enumerate() {
        let near = match (kept.last(), samples.get(k + 1)) {
            (Some(last), Some(next)) => sample[0] - last[0] < SAME * (next[0] - sample[0]),
            _ => false,
        };
        if !near {
            kept.push(*sample);
        }
    }
    kept
}

/// The polynomial through the nearest samples.
fn interpolate(samples: &[[f64; 2]], arc: f64) -> f64 {
    let count = samples.len().min(NEIGHBOURS);
    let after = samples.partition_point(|sample| sample[0] < arc);
    let first = after.saturating_sub(count / 2).min(samples.len() - count);
    let near = &samples[first..first + count];
    let weight = |j: usize| -> f64 {
        let factor = |k: usize| (arc - near[k][0]) / (near[j][0] - near[k][0]);
        (0..count).filter(|&k| k != j).map(factor).product()
    };
    (0..count).map(|j| weight(j) * near[j][1]).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Curve, Point};

    /// Of a pressure x (4 - x) on a line from 0 to 4, at these segment ends.
    fn found(space: MultiplierSpace, ends: &[f64]) -> Roughness {
        let mut boundary = ContactBoundary::new(Curve::Line([[0.0, 0.0], [4.0, 0.0]]), [0.0, 1.0], Point::new(0.0, 1.0));
        boundary.cut(&ends.iter().map(|x| x / 4.0).collect::<Vec<_>>());
        let multipliers = Multipliers::new(space, &boundary);
        let at = |x: f64| x * (4.0 - x);
        let lambda: Vec<f64> = match space {
            MultiplierSpace::P0 => ends.windows(2).map(|e| at(0.5 * (e[0] + e[1]))).collect(),
            MultiplierSpace::P1Discontinuous => ends.windows(2).flat_map(|e| [at(e[0]), at(e[1])]).collect(),
            MultiplierSpace::P1Continuous => ends.iter().map(|x| at(*x)).collect(),
        };
        let zones = Zone::all(&boundary, &multipliers, &lambda, &vec![true; lambda.len()]);
        assert_eq!(zones.len(), 1);
        roughness(&boundary, &multipliers, &lambda, &zones[0]).expect("enough samples")
    }

    #[test]
    fn a_parabola_is_missed_by_as_much_as_its_space_must() {
        let ends: Vec<f64> = (0..=8).map(|k| 0.5 * k as f64).collect();
        // On a segment of length H a constant misses the slope λ' by λ' H/√12, and a chord the curvature by H² λ''/√120.
        assert!((found(MultiplierSpace::P0, &ends).middle / 0.056 - 1.0).abs() < 0.2, "{:?}", found(MultiplierSpace::P0, &ends));
        let chord = found(MultiplierSpace::P1Continuous, &ends);
        assert!((chord.middle / (0.5 / 120f64.sqrt() / 3.6) - 1.0).abs() < 0.2, "{chord:?}");
        assert!(chord.peak < 1e-3);
    }

    #[test]
    fn a_segment_of_no_length_does_no_harm() {
        let ends = [0.0, 0.5, 1.0, 1.5, 2.0, 2.0 + 1e-7, 2.5, 3.0, 3.5, 4.0];
        for space in [MultiplierSpace::P0, MultiplierSpace::P1Discontinuous, MultiplierSpace::P1Continuous] {
            assert!(found(space, &ends).middle < 0.1, "{space:?}: {:?}", found(space, &ends));
        }
    }

    /// Where contact ends inside the boundary the pressure is zero there: two segments are enough for a parabola then.
    #[test]
    fn a_pressure_is_zero_where_contact_ends_inside_the_boundary() {
        let mut boundary = ContactBoundary::new(Curve::Line([[0.0, 0.0], [4.0, 0.0]]), [0.0, 1.0], Point::new(0.0, 1.0));
        boundary.cut(&[0.0, 0.25, 0.5, 0.75, 1.0]);
        let multipliers = Multipliers::new(MultiplierSpace::P0, &boundary);
        let of = |pressed: std::ops::Range<usize>| {
            let lambda: Vec<f64> = (0..4).map(|k| if pressed.contains(&k) { 1.5 } else { 0.0 }).collect();
            let active: Vec<bool> = (0..4).map(|k| pressed.contains(&k)).collect();
            roughness(&boundary, &multipliers, &lambda, &Zone::all(&boundary, &multipliers, &lambda, &active)[0])
        };
        // 2 (x - 1) (3 - x), highest at the last Gauss point before its middle.
        let z = 0.5 + 0.5 * (5.0 + 2.0 * (10.0f64 / 7.0).sqrt()).sqrt() / 3.0;
        let found = of(1..3).expect("four samples").peak;
        assert!((found - (2.0 * z * (2.0 - z) / 1.5 - 1.0)).abs() < 1e-12, "{found}");
        assert!(of(0..2).is_some() && of(2..4).is_some(), "three samples");
        assert_eq!(of(0..1), None);
        assert!(of(1..2).is_some(), "zero, the middle, zero");
    }

    /// The nearest linear functions to a parabola meet it at the two Gauss points of each segment: from these it is found again.
    #[test]
    fn a_parabola_is_found_again_from_the_gauss_points_of_its_nearest_chords() {
        let mut boundary = ContactBoundary::new(Curve::Line([[0.0, 0.0], [4.0, 0.0]]), [0.0, 1.0], Point::new(0.0, 1.0));
        boundary.cut(&(0..=8).map(|k| f64::from(k) / 8.0).collect::<Vec<_>>());
        let multipliers = Multipliers::new(MultiplierSpace::P1Discontinuous, &boundary);
        let at = |k: usize| 5.0 + (0.5 * k as f64) * (4.0 - 0.5 * k as f64) + 0.25 / 6.0;
        let lambda: Vec<f64> = (0..8).flat_map(|k| [at(k), at(k + 1)]).collect();
        let zones = Zone::all(&boundary, &multipliers, &lambda, &[true; 16]);
        let found = roughness(&boundary, &multipliers, &lambda, &zones[0]).expect("enough samples");
        // The parabola less its nearest chord is H²/6 times the Legendre polynomial of second degree, whose mean square is 1/5.
        let size = 0.25 / 6.0 / 5f64.sqrt();
        assert!((found.middle * 8.66 / size - 1.0).abs() < 0.02, "{found:?}, {size}");
    }
}
