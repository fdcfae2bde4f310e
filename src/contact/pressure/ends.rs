//! The true ends of contact, from the pressure next to the ends of Γ_C.
//!
//! Near a smooth end of contact λ goes like √r; where Γ_C ends too early, λ has the singularity of a punch besides,
//! `λ ≈ K/√r + c √r` with the distance r from the end of Γ_C, and `√(r + η) ≈ √r + η/(2√r)` says how much too early:
//! `η = 2 K/c`. Two mean pressures give K and c.

use crate::contact::contact_boundary::ContactBoundary;
use crate::contact::multiplier::Multipliers;

/// Arc length (length) at which contact ends, by the pressures of the last two segments that carry any: at most one segment
/// from where the last of them ends, half a segment into one that carries nothing. Where only one carries pressure it
/// is its end. Nothing if that is the only segment, or none does. The `end` is the first (0) or the last (1).
pub fn true_end(
    boundary: &ContactBoundary,
    multipliers: &Multipliers,
    lambda: &[f64],
    active: &[bool],
    end: usize,
) -> Option<f64> {
    let carries = |k: &usize| {
        let rows = multipliers.on_segment(*k, 0.0).0;
        rows.iter().take(multipliers.per_segment()).any(|&i| active[i])
    };
    // The segment before another (0), or behind it (1).
    let beside =
        |k: usize, way: usize| if way == 0 { k.checked_sub(1) } else { Some(k + 1).filter(|&k| k < boundary.segments()) };
    let mut carrying = (0..boundary.segments()).filter(carries);
    let (outer, outwards) = if end == 0 { (carrying.next()?, -1.0) } else { (carrying.next_back()?, 1.0) };
    let (beyond, edge) = (beside(outer, end), boundary.arcs()[outer + end]);
    let mean = |k: usize| multipliers.value(lambda, k, 0.5);
    let excess = match beside(outer, 1 - end).filter(carries) {
        Some(next) => {
            let lengths = [outer, next].map(|k| boundary.segment_length(k));
            let third = beside(next, 1 - end).filter(carries).map(|k| (mean(k), boundary.segment_length(k)));
            if third.is_some_and(|(third, length)| fades([mean(outer), mean(next), third], [lengths[0], lengths[1], length])) {
                return Some(edge);
            }
            let most = beyond.map_or(lengths[0], |k| 0.5 * boundary.segment_length(k));
            too_early(lengths, [outer, next].map(mean)).clamp(-lengths[0], most)
        }
        None if beyond.is_some() => 0.0,
        None => return None,
    };
    Some(edge + outwards * excess)
}

/// Whether a pressure fades out like a power above one: mean pressures that fall to the end, and ever more slowly. Then
/// Γ_C may end where the active set does; there is no root to look for.
fn fades([outer, next, third]: [f64; 3], [a, b, c]: [f64; 3]) -> bool {
    let slopes = [(next - outer) / (a + b), (third - next) / (b + c)];
    outer < 0.45 * next && slopes[0] > 0.0 && slopes[1] > slopes[0]
}

/// `η` from the lengths and mean pressures of the outermost segment and the next one.
fn too_early([h, next]: [f64; 2], [outer, inner]: [f64; 2]) -> f64 {
    // Integrals of 1/√r and √r over both segments.
    let integrals = |r: f64| [2.0 * r.sqrt(), 2.0 / 3.0 * r.powf(1.5)];
    let ([a, b], [c, d]) = (integrals(h), integrals(h + next));
    let (c, d) = (c - a, d - b);
    let (p, q) = (outer * h, inner * next);
    let (k, slope) = ((p * d - q * b), (a * q - c * p));
    if slope > 0.0 { 2.0 * k / slope } else { h.copysign(k) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::pair::MultiplierSpace;
    use crate::geometry::{Curve, Point};

    #[test]
    fn the_end_of_a_pressure_like_a_root_is_found() {
        // λ = √(1.03 - s) on segments of 0.1 that end at 1: means are exact.
        let mut boundary = ContactBoundary::new(Curve::Line([[0.0, 0.0], [1.0, 0.0]]), [0.0, 1.0], Point::new(0.0, 1.0));
        boundary.cut(&(0..=10).map(|k| k as f64 / 10.0).collect::<Vec<_>>());
        let multipliers = Multipliers::new(MultiplierSpace::P0, &boundary);
        let mean = |exact: f64, k: usize| {
            let primitive = |s: f64| -2.0 / 3.0 * (exact - s).max(0.0).powf(1.5);
            (primitive(0.1 * (k + 1) as f64) - primitive(0.1 * k as f64)) / 0.1
        };
        for (exact, tolerance) in [(1.0, 1e-12), (1.001, 1e-4), (1.01, 3e-3), (1.03, 1.2e-2), (0.97, 1e-2)] {
            let lambda: Vec<f64> = (0..10).map(|k| mean(exact, k)).collect();
            let found = true_end(&boundary, &multipliers, &lambda, &[true; 10], 1).expect("two segments");
            assert!((found - exact).abs() < tolerance, "{found} for {exact}");
        }
    }

    #[test]
    fn a_pressure_that_fades_out_stays_where_it_is() {
        assert!(fades([1.0 / 3.0, 7.0 / 3.0, 19.0 / 3.0], [1.0; 3]), "r squared");
        assert!(!fades([0.667, 1.219, 1.579], [1.0; 3]), "the root of r");
        assert!(!fades([0.236, 0.989, 1.41], [1.0; 3]), "the root, with half a segment too much");
        assert!(!fades([2.0, 0.83, 0.64], [1.0; 3]), "a punch");
    }

    /// λ goes like 1/√r, so that contact ends far outside: at most half a segment into one that carries nothing.
    #[test]
    fn an_end_moves_by_half_a_segment_at_most() {
        let mut boundary = ContactBoundary::new(Curve::Line([[0.0, 0.0], [1.0, 0.0]]), [0.0, 1.0], Point::new(0.0, 1.0));
        boundary.cut(&(0..=10).map(|k| k as f64 / 10.0).collect::<Vec<_>>());
        let multipliers = Multipliers::new(MultiplierSpace::P0, &boundary);
        let active: Vec<bool> = (0..10).map(|k| (3..7).contains(&k)).collect();
        let lambda = [0.0, 0.0, 0.0, 2.0, 0.83, 0.83, 2.0, 0.0, 0.0, 0.0];
        for (end, expected) in [(0, 0.25), (1, 0.75)] {
            let found = true_end(&boundary, &multipliers, &lambda, &active, end).expect("four segments");
            assert!((found - expected).abs() < 1e-12, "{end}: {found}");
        }
    }

    #[test]
    fn one_segment_says_nothing() {
        let boundary = ContactBoundary::new(Curve::Line([[0.0, 0.0], [1.0, 0.0]]), [0.0, 1.0], Point::new(0.0, 1.0));
        let multipliers = Multipliers::new(MultiplierSpace::P0, &boundary);
        assert_eq!(true_end(&boundary, &multipliers, &[1.0], &[true], 0), None);
    }

    /// Pressures of all kinds on uneven segments, and the same seen from the other side.
    #[test]
    fn the_first_end_is_found_as_the_last_one_is() {
        let place = |ends: &[f64], lambda: &[f64], active: &[bool], end: usize| {
            let mut boundary = ContactBoundary::new(Curve::Line([[0.0, 0.0], [1.0, 0.0]]), [0.0, 1.0], Point::new(0.0, 1.0));
            boundary.cut(ends);
            true_end(&boundary, &Multipliers::new(MultiplierSpace::P0, &boundary), lambda, active, end)
        };
        let ends = [0.0, 0.1, 0.25, 0.3, 0.5, 0.62, 0.8, 1.0];
        let back: Vec<f64> = ends.iter().rev().map(|z| 1.0 - z).collect();
        for (lambda, is_active, wanted) in [
            ([0.0, 0.0, 1.0, 3.0, 2.5, 0.0, 0.0], "0011100", None),
            ([0.5, 0.9, 1.2, 1.0, 0.9, 0.7, 0.4], "1111111", None),
            ([0.0, 0.01, 0.2, 0.9, 0.9, 0.2, 0.01], "0111111", None),
            ([0.0, 0.0, 0.0, 0.7, 0.0, 0.0, 0.0], "0001000", Some([0.3, 0.5])),
            ([0.0, 2.0, 0.8, 0.7, 0.8, 2.0, 0.0], "0111110", Some([0.05, 0.9])),
            ([0.0, 0.1, 0.9, 4.0, 1.2, 0.1, 0.0], "0111110", Some([0.1, 0.8])),
        ] {
            let active: Vec<bool> = is_active.chars().map(|c| c == '1').collect();
            let (mut mirrored, mut active_back) = (lambda.to_vec(), active.clone());
            mirrored.reverse();
            active_back.reverse();
            let first = place(&ends, &lambda, &active, 0).expect("an end");
            let last = place(&back, &mirrored, &active_back, 1).expect("an end");
            assert!((first + last - 1.0).abs() < 1e-12, "{is_active}: {first} and {last}");
            let other = place(&ends, &lambda, &active, 1).expect("an end");
            if let Some(wanted) = wanted {
                assert!((first - wanted[0]).abs() < 1e-12 && (other - wanted[1]).abs() < 1e-12, "{is_active}: {first}, {other}");
            }
        }
    }
}
