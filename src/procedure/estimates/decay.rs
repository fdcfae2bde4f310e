//! How errors fall from mesh to mesh, and what is left of them by one difference or two.

use super::difference::Difference;

/// Factors by which squares of errors fall, at least and at most: outside of these the meshes are too coarse to tell.
const FACTORS: [f64; 2] = [1.0 / 80.0, 0.75];

/// Factors by which squares of errors fall on one macro triangle, as far as the next mesh is foreseen: from P2 on a smooth solution
/// to P1 at a corner.
const LOCAL_FACTORS: [f64; 2] = [1.0 / 16.0, 0.5];

/// Share of the whole square below which that of a macro triangle may be rounding, which falls as it will.
const ROUNDING: f64 = 1e-14;

/// The factor q of squares with q/(1 - q) = .7², for a mesh that is adapted by one difference.
const ONE_FALLS: f64 = 0.33;

/// Largest factor by which errors of a force are taken to fall.
pub const FORCE_SLOWEST: f64 = 0.6;

/// Share of the last difference of a value that is left: where it says nothing of how it falls, and at least.
pub const SHARES: [f64; 2] = [0.6, 0.0];

/// Factor by which the difference has fallen on each macro triangle of this rank; the one that leaves what is left by one difference,
/// where that is all there is.
pub fn falls(last: &Difference, before: Option<&Difference>, shares_left: &[Option<f64>]) -> Vec<f64> {
    let by_share = |share: f64| (share / (1.0 + share)).clamp(LOCAL_FACTORS[0], LOCAL_FACTORS[1]);
    let least = ROUNDING * last.energy;
    let fall = |(at, now): (usize, &f64)| match before.and_then(|before| before.of_triangles.get(at)) {
        Some(then) if *then > 0.0 => (now.max(least) / then.max(least)).clamp(LOCAL_FACTORS[0], LOCAL_FACTORS[1]),
        Some(_) => LOCAL_FACTORS[1],
        None => shares_left.get(at).copied().flatten().map_or(ONE_FALLS, by_share),
    };
    last.of_triangles.iter().enumerate().map(fall).collect()
}

/// What is left of an additive error, from two successive differences of it.
pub fn left(before: f64, last: f64) -> f64 {
    if last == 0.0 {
        return 0.0;
    }
    let factor = (last / before).clamp(FACTORS[0], FACTORS[1]);
    last * factor / (1.0 - factor)
}

/// What is left of the error of a value, from one difference or two; `fall` is the factor by which it falls on a smooth solution,
/// `unknown` and `least` the shares of a difference that are left where nothing tells, and at least.
/// The last difference may be small by luck, where errors of either sign meet: so it counts for no less than the one before
/// leaves of itself there.
pub fn value_left(before: Option<f64>, last: f64, fall: f64, [unknown, least]: [f64; 2]) -> Option<f64> {
    let left = match before {
        Some(before) if last < fall * before => fall * before * unknown.max(fall / (1.0 - fall)),
        Some(before) => {
            let factor = (last / before).min(FORCE_SLOWEST);
            last * (factor / (1.0 - factor)).max(least)
        }
        None => last * SHARES[0],
    };
    left.is_finite().then_some(left)
}
