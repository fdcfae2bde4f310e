//! Whether the displacements control the pressure.

use super::doubt::Doubt;
use super::zones::is_proved;
use crate::case::Case;
use crate::contact::{MultiplierSpace, Pair, SegmentRule};
use crate::element::Order;
use crate::output::summary::ContactSummary;
use crate::run::report::{LOCKING, short};

/// A contact whose inf-sup constant is below this has pressures that its displacements do not control.
const LEAST_INF_SUP: f64 = 0.1;

/// A pressure with more alternation than this is not one.
const MOST_OSCILLATION: f64 = 0.05;

/// What tells that the displacements do not control the pressure; it may be why a solve has failed.
pub fn stability_doubts(contact: &ContactSummary, pair: &Pair, case: &Case) -> Vec<Doubt> {
    let unstable = contact.inf_sup.filter(|beta| *beta < LEAST_INF_SUP);
    let segment = contact.h_ratio.map_or(String::new(), |ratio| format!(" with segments of {} edges", short(ratio)));
    let unstable = unstable.map(|beta| {
        let figure = format!("inf-sup constant {beta:.3}{segment}, at least {LEAST_INF_SUP} wanted");
        ("the inf-sup constant is too small", figure)
    });
    // Beside a singular end λ swings without harm to its middle, which the estimate tells.
    let harmless = contact.zones.iter().filter(|zone| zone.counts(&contact.zones)).all(|zone| is_proved(zone.lambda));
    let rough = contact.oscillation.filter(|share| *share > MOST_OSCILLATION && !harmless);
    let rough = rough.map(|share| {
        let figure = format!("oscillation {share:.3}{segment}, at most {MOST_OSCILLATION} wanted");
        ("the pressure oscillates", figure)
    });
    let remedy = stability(pair, case);
    [unstable, rough].into_iter().flatten().map(|(cause, figure)| Doubt { cause, figure, remedy }).collect()
}

/// What mends a space too rich for the displacements; P1 has locked before its multipliers are too many.
fn stability(pair: &Pair, case: &Case) -> &'static str {
    let mut parts = case.bodies.iter().flat_map(|body| &body.parts);
    let locked = case.mesh.order == Order::P1 && parts.any(|part| part.material.poisson_in_plane() > LOCKING);
    match (locked, pair.segments == SegmentRule::Auto, pair.space) {
        (true, ..) => "take mesh.order = 2: P1 triangles lock",
        (_, true, MultiplierSpace::P1Continuous) => "take another multiplier space, or refine the mesh",
        (_, true, _) => "take stabilise = true, another multiplier space, or refine the mesh",
        (_, _, MultiplierSpace::P1Continuous) => "take fewer segments (\"auto\" is safe), or another multiplier space",
        _ => "take fewer segments (\"auto\" is safe), stabilise = true, or another multiplier space",
    }
}
