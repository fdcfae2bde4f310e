//! Whether anything acts in a scene.

use super::scene::Scene;
use crate::contact::{GapChoice, Law, Pair, drawn_gap};
use crate::geometry::Formula;
use crate::mesh::Numbering;

/// Sides that reach into each other by less than this share of the shorter one do so by rounding, and so do bodies move by less than
/// this share of the largest.
pub const BY_ROUNDING: f64 = 1e-9;

impl Scene {
    /// Whether it has loads, prescribed motions, heat or interference. Without them its bodies stay as they are drawn.
    pub fn is_driven(&self, numbering: &Numbering) -> bool {
        is_loaded(self) || self.is_moved() || self.pairs.iter().any(|pair| interferes(self, numbering, pair))
    }

    /// Whether nothing but interference can press its bodies.
    pub fn is_left_to_interference(&self) -> bool {
        !is_loaded(self) && !self.is_moved()
    }

    /// Whether supports, means or rigid sets move bodies.
    pub fn is_moved(&self) -> bool {
        let by_support = self.supports.iter().flat_map(|support| [&support.ux, &support.uy, &support.normal]).flatten().any(acts);
        let by_mean = self.means.iter().flat_map(|mean| &mean.held).any(|held| held.value != 0.0);
        by_support || by_mean || self.rigid.iter().any(|set| set.prescribed.iter().flatten().any(|value| *value != 0.0))
    }
}

fn acts(formula: &Formula) -> bool {
    !formula.is_zero()
}

fn is_loaded(scene: &Scene) -> bool {
    let by_load = scene.loads.iter().flat_map(|load| load.kind.formulas()).any(acts);
    let at_points = scene.point_loads.iter().any(|load| load.force.iter().any(acts));
    let mut parts = scene.bodies.iter().flat_map(|body| &body.parts);
    let within = parts.any(|part| {
        let heats = part.heat.as_ref().is_some_and(|heat| heat.expansion != 0.0 && acts(&heat.temperature));
        heats || part.force.iter().any(acts)
    });
    by_load || at_points || within || scene.rigid.iter().any(|set| set.applied.iter().any(|force| *force != 0.0))
}

/// Whether the sides of a contact reach into each other before anything moves.
fn interferes(scene: &Scene, numbering: &Numbering, pair: &Pair) -> bool {
    match &pair.gap {
        GapChoice::Closed => false,
        GapChoice::Formula(gap) => gap.as_constant().is_none_or(|gap| gap < 0.0 || pair.law == Law::Bilateral && gap > 0.0),
        // Of sides that do not face each other it is not known.
        GapChoice::Geometry => drawn_gap(&scene.mesh, numbering, pair).is_none_or(|gap| {
            let size = if pair.law == Law::Bilateral { gap.least.abs() } else { -gap.least };
            size > BY_ROUNDING * gap.length
        }),
    }
}
