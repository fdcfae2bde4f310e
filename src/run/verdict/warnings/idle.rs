//! What is said of a scene in which nothing happens.

use crate::body::LoadKind;
use crate::contact::{GapChoice, Pair, SmoothSide};
use crate::discretisation::Scene;
use crate::geometry::{Formula, Point};
use crate::mesh::Numbering;

/// Sides that reach into each other by less than this share of their length do so by rounding.
const DRAWN: f64 = 1e-9;

/// How it is said.
pub const IDLE: &str = "nothing loads, moves or presses the bodies, so that they stay as they are drawn";

/// A warning for a scene without loads, prescribed motions, heat and interference. All edges are on this rank.
pub fn idle(scene: &Scene, numbering: &Numbering) -> Option<String> {
    let is_driven = is_loaded(scene) || is_moved(scene) || scene.pairs.iter().any(|pair| interferes(scene, numbering, pair));
    (!is_driven).then(|| format!("{IDLE}; give a load, a support that moves, heat, or a negative gap"))
}

fn acts(formula: &Formula) -> bool {
    formula.as_constant() != Some(0.0)
}

fn is_loaded(scene: &Scene) -> bool {
    let by_load = scene.loads.iter().any(|load| match &load.kind {
        LoadKind::Pressure(pressure) => acts(pressure),
        LoadKind::Traction(traction) => traction.iter().any(acts),
    });
    let at_points = scene.point_loads.iter().any(|load| load.force.iter().any(acts));
    let mut parts = scene.bodies.iter().flat_map(|body| &body.parts);
    let within = parts.any(|part| {
        let heats = part.heat.as_ref().is_some_and(|heat| heat.expansion != 0.0 && acts(&heat.temperature));
        heats || part.force.iter().any(acts)
    });
    by_load || at_points || within || scene.rigid.iter().any(|set| set.applied.iter().any(|force| *force != 0.0))
}

fn is_moved(scene: &Scene) -> bool {
    let by_support = scene.supports.iter().flat_map(|support| [&support.ux, &support.uy, &support.normal]).flatten().any(acts);
    let by_mean = scene.means.iter().flat_map(|mean| &mean.held).any(|held| held.value != 0.0);
    by_support || by_mean || scene.rigid.iter().any(|set| set.prescribed.iter().flatten().any(|value| *value != 0.0))
}

/// Whether the sides of a contact reach into each other before anything moves.
fn interferes(scene: &Scene, numbering: &Numbering, pair: &Pair) -> bool {
    match &pair.gap {
        GapChoice::Closed => false,
        GapChoice::Formula(gap) => gap.as_constant().is_none_or(|gap| gap < 0.0),
        GapChoice::Geometry => {
            let [first, second] = SmoothSide::of_pair(&scene.mesh, numbering, pair, &|_| Point::zeros());
            let reaches = |side: &SmoothSide, other: &SmoothSide| {
                let least = DRAWN * side.length().max(other.length());
                (0..side.nodes()).any(|node| side.facing_gaps(node, other, pair, least).is_some_and(|gaps| gaps.at_rest < -least))
            };
            first.iter().any(|side| second.iter().any(|other| reaches(side, other)))
        }
    }
}
