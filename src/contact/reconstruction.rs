//! λ made smoother than its space: what the segments are too coarse for shows in the difference.

use super::{ContactBoundary, MultiplierSpace, Multipliers, Zone};
use crate::geometry::gauss_points;

/// Samples that a value is interpolated from.
const NEIGHBOURS: usize = 4;

/// Differences between λ on a zone and its reconstruction, relative to λ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Roughness {
    /// Root mean square, in the middle of the zone.
    pub middle: f64,
    /// Of the largest value.
    pub peak: f64,
}

/// How far λ on a zone is from the cubics through its best samples: the middles of segments (P0), their two Gauss points (P1
/// discontinuous), their ends (P1 continuous), and zero where contact ends inside the boundary. Nothing if there are fewer
/// than three samples.
pub fn roughness(boundary: &ContactBoundary, multipliers: &Multipliers, lambda: &[f64], zone: &Zone) -> Option<Roughness> {
    let samples = samples(boundary, multipliers, lambda, zone);
    if samples.len() < 3 {
        return None;
    }
    let arcs = boundary.arcs();
    let (mut sums, mut peak) = ([0.0; 2], f64::NEG_INFINITY);
    for k in zone.segments.clone() {
        let length = arcs[k + 1] - arcs[k];
        for (z, weight) in gauss_points(5) {
            let arc = arcs[k] + z * length;
            let smooth = interpolate(&samples, arc);
            peak = peak.max(smooth);
            if zone.has_in_its_middle(arc) {
                let here = multipliers.value(lambda, k, *z);
                sums[0] += weight * length * (here - smooth).powi(2);
                sums[1] += weight * length * here * here;
            }
        }
    }
    let found = zone.peak(multipliers, lambda);
    Some(Roughness { middle: (sums[0] / sums[1]).sqrt(), peak: (peak / found - 1.0).abs() })
}

/// Arc lengths and values.
fn samples(boundary: &ContactBoundary, multipliers: &Multipliers, lambda: &[f64], zone: &Zone) -> Vec<[f64; 2]> {
    let arcs = boundary.arcs();
    let at = |k: usize, z: f64| [arcs[k] + z * (arcs[k + 1] - arcs[k]), multipliers.value(lambda, k, z)];
    let gauss = 0.5 / 3f64.sqrt();
    let segments = zone.segments.clone();
    let mut samples: Vec<[f64; 2]> = match multipliers.space {
        MultiplierSpace::P0 => segments.map(|k| at(k, 0.5)).collect(),
        MultiplierSpace::P1Discontinuous => segments.flat_map(|k| [at(k, 0.5 - gauss), at(k, 0.5 + gauss)]).collect(),
        MultiplierSpace::P1Continuous => {
            return (zone.segments.start..=zone.segments.end).map(|i| [arcs[i], lambda[i]]).collect();
        }
    };
    if zone.segments.start > 0 {
        samples.insert(0, [zone.arcs[0], 0.0]);
    }
    if zone.segments.end < boundary.segments() {
        samples.push([zone.arcs[1], 0.0]);
    }
    samples
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
