//! How much of a contact pressure is checkerboard.

use crate::contact::contact_boundary::ContactBoundary;
use crate::contact::multiplier::Multipliers;
use crate::contact::pair::MultiplierSpace;

/// Share of the contact length at each of its ends that is left out: where contact ends inside the boundary, and where the
/// boundary does, because there the pressure may have a singularity, around which it swings.
const END: [f64; 2] = [0.1, 0.2];

/// Root mean square of the alternating part of the pressure over that of the pressure, in the inner part of the contact.
///
/// The pressure is sampled where each space is most accurate: in the middle of the segments (P0), at their two Gauss
/// points (P1 discontinuous), at their ends (P1 continuous). At each sample the cubic through the two neighbours on
/// both sides is taken off, and what is left divided by what would be left of a pure alternation: so the figure is
/// the amplitude of a checkerboard, and of order `H⁴` for a smooth pressure. Only samples whose five multipliers are
/// all active count; one that is open between two that carry counts as active with no pressure, because an active set
/// of every other multiplier is a checkerboard too. Nothing if there is no such sample.
pub fn oscillation(boundary: &ContactBoundary, multipliers: &Multipliers, lambda: &[f64], active: &[bool]) -> Option<f64> {
    let mut samples = samples(boundary, multipliers, lambda, active);
    let turn = boundary.turn().filter(|_| samples.len() > 4);
    if let Some(turn) = turn {
        go_round(&mut samples, turn);
    }
    let lone: Vec<usize> = (1..samples.len().saturating_sub(1))
        .filter(|&k| !samples[k].active && samples[k - 1].active && samples[k + 1].active)
        .collect();
    lone.into_iter().for_each(|k| samples[k].active = true);
    let carried: Vec<f64> = samples.iter().filter(|sample| sample.active).map(|sample| sample.arc).collect();
    let (first, last) = (*carried.first()?, *carried.last()?);
    let (length, segment) = (boundary.length(), boundary.segment_length(0).max(boundary.segment_length(boundary.segments() - 1)));
    let ends = match turn {
        // All around it is smooth; samples that were added only stand beside others.
        Some(_) if samples.iter().all(|sample| sample.active) => [0.0; 2],
        Some(_) => [END[0]; 2],
        None => [first < segment, last > length - segment].map(|at_the_end| END[usize::from(at_the_end)]),
    };
    let inner = (first + ends[0] * (last - first))..=(last - ends[1] * (last - first));
    let mut sums = [0.0; 2];
    for five in samples.windows(5).filter(|five| five.iter().all(|s| s.active) && inner.contains(&five[2].arc)) {
        sums[0] += alternation(five).powi(2);
        sums[1] += five[2].value.powi(2);
    }
    (sums[1] > 0.0).then(|| (sums[0] / sums[1]).sqrt())
}

/// Begins the samples of a closed boundary at the widest part of it that carries nothing, so that no zone goes across their ends;
/// where there is no such part, with the last two before the first, and the first two behind the last.
fn go_round(samples: &mut Vec<PressureSample>, turn: f64) {
    let count = samples.len();
    let open_from = |k: usize| (0..count).take_while(|i| !samples[(k + i) % count].active).count();
    let (from, open) =
        (0..count).map(|k| (k, open_from(k))).max_by_key(|&(k, open)| (open, std::cmp::Reverse(k))).unwrap_or((0, 0));
    let at = |k: usize| PressureSample { arc: samples[k % count].arc + (k / count) as f64 * turn, ..samples[k % count] };
    // A single one that is open between two that carry is part of a checkerboard.
    let all: Vec<PressureSample> =
        if open > 1 { (from..from + count).map(at).collect() } else { (count - 2..2 * count + 2).map(at).collect() };
    *samples = all;
}

/// The pressure at one point of Γ_C.
#[derive(Clone, Copy)]
struct PressureSample {
    arc: f64,
    value: f64,
    active: bool,
}

fn samples(boundary: &ContactBoundary, multipliers: &Multipliers, lambda: &[f64], active: &[bool]) -> Vec<PressureSample> {
    let arcs = boundary.arcs();
    let at = |k: usize, z: f64| {
        let rows = multipliers.on_segment(k, z).0;
        let active = rows.iter().take(multipliers.per_segment()).all(|&i| active[i]);
        PressureSample { arc: arcs[k] + z * (arcs[k + 1] - arcs[k]), value: multipliers.value(lambda, k, z), active }
    };
    let gauss = 0.5 / 3f64.sqrt();
    match multipliers.space {
        MultiplierSpace::P0 => (0..boundary.segments()).map(|k| at(k, 0.5)).collect(),
        MultiplierSpace::P1Discontinuous => {
            (0..boundary.segments()).flat_map(|k| [at(k, 0.5 - gauss), at(k, 0.5 + gauss)]).collect()
        }
        MultiplierSpace::P1Continuous => {
            let end = |i: usize| PressureSample { arc: arcs[i], value: lambda[i], active: active[i] };
            (0..multipliers.count()).map(end).collect()
        }
    }
}

/// Amplitude of the alternation at the middle one of five samples.
fn alternation(five: &[PressureSample]) -> f64 {
    const OTHERS: [usize; 4] = [0, 1, 3, 4];
    let (mut rest, mut whole) = (five[2].value, 1.0);
    for j in OTHERS {
        let factor = |k: &usize| (five[2].arc - five[*k].arc) / (five[j].arc - five[*k].arc);
        let weight: f64 = OTHERS.iter().filter(|&&k| k != j).map(factor).product();
        rest -= weight * five[j].value;
        whole -= weight * if j % 2 == 0 { 1.0 } else { -1.0 };
    }
    rest / whole
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Curve, Point};

    fn setting(space: MultiplierSpace, segments: usize) -> (ContactBoundary, Multipliers) {
        let mut boundary = ContactBoundary::new(Curve::Line([[0.0, 0.0], [2.0, 0.0]]), [0.0, 1.0], Point::new(0.0, 1.0));
        boundary.cut(&(0..=segments).map(|k| k as f64 / segments as f64).collect::<Vec<_>>());
        let multipliers = Multipliers::new(space, &boundary);
        (boundary, multipliers)
    }

    /// A smooth pressure with an alternation of amplitude `a` on top.
    fn figure(space: MultiplierSpace, a: f64) -> f64 {
        let (boundary, multipliers) = setting(space, 20);
        let place = |i: usize| match space {
            MultiplierSpace::P0 => (i as f64 + 0.5) / 20.0,
            MultiplierSpace::P1Discontinuous => (i.div_ceil(2)) as f64 / 20.0,
            MultiplierSpace::P1Continuous => i as f64 / 20.0,
        };
        let sign = |i: usize| if i.is_multiple_of(2) { 1.0 } else { -1.0 };
        let lambda: Vec<f64> = (0..multipliers.count()).map(|i| 1.0 + (2.0 * place(i)).sin() + a * sign(i)).collect();
        oscillation(&boundary, &multipliers, &lambda, &vec![true; lambda.len()]).expect("enough samples")
    }

    #[test]
    fn a_smooth_pressure_has_none_and_a_checkerboard_its_amplitude() {
        for space in [MultiplierSpace::P0, MultiplierSpace::P1Continuous] {
            assert!(figure(space, 0.0) < 1e-5, "{space:?}");
            let mean = 1.0 + 0.78;
            assert!((figure(space, 0.5) * mean / 0.5 - 1.0).abs() < 0.1, "{space:?}");
        }
        assert!(figure(MultiplierSpace::P1Discontinuous, 0.0) < 1e-3);
        assert!(figure(MultiplierSpace::P1Discontinuous, 0.5) > 0.1);
    }

    #[test]
    fn every_other_multiplier_is_a_checkerboard() {
        let (boundary, multipliers) = setting(MultiplierSpace::P0, 20);
        let active: Vec<bool> = (0..20).map(|i| i % 2 == 0).collect();
        let lambda: Vec<f64> = active.iter().map(|&active| if active { 1.0 } else { 0.0 }).collect();
        assert!(oscillation(&boundary, &multipliers, &lambda, &active).expect("a figure") > 0.5);
    }

    #[test]
    fn a_contact_of_few_segments_has_no_figure() {
        let (boundary, multipliers) = setting(MultiplierSpace::P0, 4);
        assert_eq!(oscillation(&boundary, &multipliers, &[1.0; 4], &[true; 4]), None);
    }

    /// The figure of an even pressure on 50 segments with one higher value.
    fn of_one(odd: usize, active: std::ops::Range<usize>) -> f64 {
        let (boundary, multipliers) = setting(MultiplierSpace::P0, 50);
        let active: Vec<bool> = (0..50).map(|k| active.contains(&k)).collect();
        let value = |k: usize| if k == odd { 1.5 } else { 1.0 };
        let lambda: Vec<f64> = (0..50).map(|k| if active[k] { value(k) } else { 0.0 }).collect();
        oscillation(&boundary, &multipliers, &lambda, &active).expect("enough samples")
    }

    /// A fifth at an end of the boundary, a tenth where contact ends inside, from the first sample to the last; the middle one
    /// of five samples tells.
    #[test]
    fn the_ends_of_contact_do_not_count() {
        for (active, seen) in [(0..50, 8..42), (10..40, 11..39), (0..40, 6..38), (10..50, 12..44)] {
            for odd in [seen.start, seen.end - 1] {
                assert!(of_one(odd, active.clone()) > 1e-3, "{odd} in {active:?} counts");
            }
            for odd in [seen.start - 1, seen.end] {
                assert!(of_one(odd, active.clone()) < 1e-9, "{odd} in {active:?} does not count");
            }
        }
    }

    /// The nearest linear functions to a parabola meet it at the two Gauss points of each segment.
    #[test]
    fn a_parabola_has_no_oscillation_in_any_space() {
        let parabola = |x: f64| 3.0 + x * (2.0 - x);
        for space in [MultiplierSpace::P0, MultiplierSpace::P1Discontinuous, MultiplierSpace::P1Continuous] {
            let (boundary, multipliers) = setting(space, 10);
            let lambda: Vec<f64> = match space {
                MultiplierSpace::P0 => (0..10).map(|k| parabola(0.2 * (f64::from(k) + 0.5))).collect(),
                // The chord, higher by H²/6 times half the curvature.
                MultiplierSpace::P1Discontinuous => {
                    (0..10).flat_map(|k| [k, k + 1]).map(|k| parabola(0.2 * f64::from(k)) + 0.04 / 6.0).collect()
                }
                MultiplierSpace::P1Continuous => (0..=10).map(|k| parabola(0.2 * f64::from(k))).collect(),
            };
            let found = oscillation(&boundary, &multipliers, &lambda, &vec![true; lambda.len()]).expect("enough samples");
            assert!(found < 1e-12, "{space:?}: {found}");
        }
    }
}
