//! Pressures along a seam: their zones, and how far two of them are apart.

use serde::{Deserialize, Serialize};

/// λ along the seam's parameter, with the length of a unit of it.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Profile {
    /// Parameter and λ, by parameter; a jump has two points.
    pub points: Vec<[f64; 2]>,
    /// ∫λ ds as the program tells it.
    pub force: f64,
}

/// A stretch where the bodies press.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Zone {
    pub from: f64,
    pub to: f64,
    /// Largest λ.
    pub peak: f64,
}

/// How far a pressure is from another, zone by zone: the largest of each, relative.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Apart {
    /// Mean square over a zone, by the zone's peak; of steps (p0), from the reference's mean over each.
    pub mean: f64,
    /// The same from the reference itself: what steps cannot follow counts as well.
    pub plain: f64,
    /// Peak; of steps, from that of the reference's means over them.
    pub peak: f64,
    /// Force of a zone.
    pub part: f64,
    /// Ends of a zone, by its width.
    pub ends: f64,
    /// The whole force.
    pub force: f64,
}

impl Apart {
    /// The worst figure of λ.
    pub fn lambda(&self) -> f64 {
        self.mean.max(self.peak).max(self.part)
    }
}

/// Points on which two pressures are compared in a zone.
const SAMPLES: usize = 2000;

impl Profile {
    pub fn new(mut points: Vec<[f64; 2]>, force: f64) -> Self {
        if points.first().is_some_and(|first| first[0] > points[points.len() - 1][0]) {
            points.reverse();
        }
        Self { points, force }
    }

    /// λ at a parameter, linear between the points; nothing beyond them.
    fn at(&self, u: f64) -> f64 {
        let k = self.points.partition_point(|point| point[0] <= u);
        if k == 0 || k == self.points.len() {
            let last = if k == 0 { self.points.first() } else { self.points.last() };
            return last.filter(|point| point[0] == u).map_or(0.0, |point| point[1]);
        }
        let ([a, low], [b, high]) = (self.points[k - 1], self.points[k]);
        if b > a { low + (high - low) * (u - a) / (b - a) } else { low }
    }

    fn samples(&self, from: f64, to: f64) -> Vec<f64> {
        let step = (to - from) / SAMPLES as f64;
        (0..SAMPLES).map(|k| self.at(from + (k as f64 + 0.5) * step)).collect()
    }

    /// If this λ goes in steps: samples of the reference's mean over each of them.
    fn steps(&self, reference: &Self, from: f64, to: f64) -> Option<Vec<f64>> {
        let wide = |pair: &&[[f64; 2]]| pair[1][0] > pair[0][0];
        if self.points.windows(2).filter(wide).any(|pair| (pair[1][1] - pair[0][1]).abs() > 1e-9 * pair[0][1].abs()) {
            return None;
        }
        let jumps = self.points.windows(2).filter(|pair| pair[1][0] == pair[0][0]).map(|pair| pair[0][0]);
        let ends: Vec<f64> = self.points.first().map(|point| point[0]).into_iter().chain(jumps).collect();
        let ends: Vec<f64> = ends.into_iter().chain(self.points.last().map(|point| point[0])).collect();
        let means: Vec<f64> = ends
            .windows(2)
            .map(|pair| {
                (0..200).map(|k| reference.at(pair[0] + (k as f64 + 0.5) / 200.0 * (pair[1] - pair[0]))).sum::<f64>() / 200.0
            })
            .collect();
        let at = |u: f64| {
            let k = ends.partition_point(|end| *end <= u);
            if k == 0 || k > means.len() { reference.at(u) } else { means[k - 1] }
        };
        let step = (to - from) / SAMPLES as f64;
        Some((0..SAMPLES).map(|k| at(from + (k as f64 + 0.5) * step)).collect())
    }

    /// The parameter about which λ has no moment.
    pub fn centre(&self) -> f64 {
        let piece = |pair: &[[f64; 2]]| {
            let force = 0.5 * (pair[0][1] + pair[1][1]) * (pair[1][0] - pair[0][0]);
            [force, 0.5 * force * (pair[0][0] + pair[1][0])]
        };
        let [force, moment] = self.points.windows(2).map(piece).fold([0.0; 2], |sum, own| [sum[0] + own[0], sum[1] + own[1]]);
        if force > 0.0 { moment / force } else { 0.0 }
    }

    /// The same λ, further along.
    pub fn moved(&self, by: f64) -> Self {
        Self { points: self.points.iter().map(|[u, lambda]| [u + by, *lambda]).collect(), force: self.force }
    }

    /// The zones that carry a hundredth of the force at least.
    pub fn zones(&self) -> Vec<Zone> {
        let top = self.points.iter().fold(0.0, |top: f64, point| top.max(point[1]));
        let mut zones: Vec<(Zone, f64)> = Vec::new();
        let mut open = true;
        for pair in self.points.windows(2) {
            let [[a, low], [b, high]] = [pair[0], pair[1]];
            let presses = low.max(high) > 2e-3 * top;
            match zones.last_mut() {
                Some((zone, force)) if presses && !open => {
                    (zone.to, zone.peak) = (b, zone.peak.max(low).max(high));
                    *force += 0.5 * (low + high) * (b - a);
                }
                _ if presses => zones.push((Zone { from: a, to: b, peak: low.max(high) }, 0.5 * (low + high) * (b - a))),
                _ => {}
            }
            // Where λ jumps from a value to another nothing opens.
            open = !presses && (b > a || open);
        }
        let all: f64 = zones.iter().map(|(_, force)| force).sum();
        zones.into_iter().filter(|(_, force)| *force > 0.01 * all).map(|(zone, _)| zone).collect()
    }

    /// How far this is from a reference. `ends` are the parameters where the seam ends; `smooth` tells where λ is not singular.
    pub fn apart(&self, reference: &Self, ends: [f64; 2], smooth: [bool; 2]) -> Apart {
        let zones = reference.zones();
        let own = self.zones();
        let mut apart = Apart { force: (self.force / reference.force - 1.0).abs(), ..Apart::default() };
        for (k, zone) in zones.iter().enumerate() {
            let width = zone.to - zone.from;
            let reach = 0.02 * (ends[1] - ends[0]).min(1.0);
            let cornered = [zone.from < ends[0] + reach && !smooth[0], zone.to > ends[1] - reach && !smooth[1]];
            // A little beside the zone counts, and nothing beside a corner.
            let before = if k == 0 { f64::NEG_INFINITY } else { 0.5 * (zones[k - 1].to + zone.from) };
            let after = zones.get(k + 1).map_or(f64::INFINITY, |next| 0.5 * (next.from + zone.to));
            let from = if cornered[0] { zone.from + 0.1 * width } else { (zone.from - 0.25 * width).max(before).max(ends[0]) };
            let to = if cornered[1] { zone.to - 0.1 * width } else { (zone.to + 0.25 * width).min(after).min(ends[1]) };
            let (a, b) = (self.samples(from, to), reference.samples(from, to));
            let steps = self.steps(reference, from, to);
            let peak = |values: &[f64]| values.iter().fold(0.0, |top: f64, value| top.max(*value));
            let sum = |values: &[f64]| values.iter().sum::<f64>();
            let share = (to - from) / (zone.to - zone.from).min(to - from);
            let mean = |b: &[f64], peak: f64| {
                let square: f64 = a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum();
                (square * share / SAMPLES as f64).sqrt() / peak
            };
            let possible = steps.as_ref().unwrap_or(&b);
            apart.plain = apart.plain.max(mean(&b, peak(&b)));
            apart.mean = apart.mean.max(mean(possible, peak(&b)));
            // Where λ rises all the way into a corner it has no largest value.
            let rises = |end: usize, at: usize| cornered[end] && possible[at] >= (1.0 - 1e-9) * peak(possible);
            if !rises(0, 0) && !rises(1, SAMPLES - 1) {
                apart.peak = apart.peak.max((peak(&a) / peak(possible) - 1.0).abs());
            }
            apart.part = apart.part.max((sum(&a) / sum(&b) - 1.0).abs());
            let nearest =
                |end: fn(&Zone) -> f64| own.iter().map(|own| (end(own) - end(zone)).abs()).fold(f64::INFINITY, f64::min);
            apart.ends = apart.ends.max(nearest(|zone| zone.from).max(nearest(|zone| zone.to)) / width);
        }
        if zones.is_empty() { Apart { mean: f64::NAN, ..apart } } else { apart }
    }
}
