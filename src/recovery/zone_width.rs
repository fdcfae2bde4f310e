//! How wide the zones of a contact are, and whether the mesh holds that.

use crate::accuracy::NARROWEST;
use crate::contact::{Law, Zone, hertz_width};
use crate::discretisation::ContactPressure;
use crate::mesh::MacroMesh;
use crate::recovery::traces::TracePoint;

/// A zone on so many edges is not looked at: its force would have to ask for a quarter of it or less.
const MANY: f64 = 4.0;

impl ContactPressure<'_> {
    /// Width that the force of a zone asks for between smooth convex sides (length; Hertz); `points` are the traces of the contact.
    pub fn hertz_width(&self, zone: &Zone, points: &[TracePoint]) -> Option<f64> {
        let Self { contact, .. } = self;
        let gaps = points.iter().map(|point| [point.arc, contact.pair.gap.at_rest(point.x, point.distance)]);
        let middle = contact.boundary.parameter_at(0.5 * (zone.arcs[0] + zone.arcs[1]));
        let force = self.force_of(zone) / contact.boundary.width(middle);
        hertz_width(gaps, zone.arcs, force, contact.compliance).filter(|width| *width <= contact.boundary.length())
    }

    /// Whether a zone of unilateral contact presses on few edges, and carries more than a force.
    pub fn has_few_edges(&self, least: f64) -> bool {
        self.contact.pair.law == Law::Unilateral && self.zones().iter().any(|zone| self.is_on_few_edges(zone, least))
    }

    fn is_on_few_edges(&self, zone: &Zone, least: f64) -> bool {
        self.force_of(zone).abs() > least && (f64::MIN_POSITIVE..MANY).contains(&self.contact.edges_on(zone))
    }

    /// Whether a zone of unilateral contact that carries more than a force is narrower than an edge, by what presses or by what its
    /// force asks for. The force of a corner is right on any mesh.
    pub fn is_too_narrow(&self, mesh: &MacroMesh, points: &[TracePoint], least: f64) -> bool {
        let narrow = |zone: &Zone| {
            let (length, width) = (zone.arcs[1] - zone.arcs[0], self.hertz_width(zone, points));
            let edges = self.contact.edges_on(zone) * width.map_or(1.0, |width| (width / length).min(1.0));
            let is_corner = width.is_none() && (0..2).any(|end| self.ends_at_a_corner(mesh, zone, end));
            edges < NARROWEST && !is_corner
        };
        let zones = self.zones();
        self.has_few_edges(least) && zones.iter().any(|zone| self.is_on_few_edges(zone, least) && narrow(zone))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::{Known, MultiplierSpace};
    use crate::discretisation::samples::{blocks, contact, pair};
    use crate::geometry::Point;
    use std::ops::Range;

    /// Two flat blocks, the upper one moved by .3 along the other: an edge of the softer one is as long as eight segments.
    #[test]
    fn what_presses_on_less_than_an_edge_is_too_narrow_unless_it_is_little_or_a_corner() {
        let scene = blocks(pair(MultiplierSpace::P0, 54), |_| Point::new(0.3, 0.0), Vec::new());
        let mut contact = contact(&scene, Known::default());
        let edge = contact.edge_lengths[27] / contact.boundary.segment_length(27);
        assert!((7.5..8.5).contains(&edge), "{edge}");
        let narrow = |contact: &crate::discretisation::Contact, pressed: Range<usize>, least: f64| {
            let active: Vec<bool> = (0..54).map(|k| pressed.contains(&k)).collect();
            let values: Vec<f64> = active.iter().map(|&active| f64::from(u8::from(active))).collect();
            let pressure = ContactPressure { contact, values: &values, active: &active };
            pressure.is_too_narrow(&scene.mesh, &[], least)
        };
        let force = 2.0 * contact.boundary.segment_length(20);
        assert!(narrow(&contact, 20..22, 0.5 * force));
        assert!(!narrow(&contact, 20..22, 2.0 * force), "it carries little");
        assert!(!narrow(&contact, 20..30, 0.0) && !narrow(&contact, 10..40, 0.0), "an edge and more");
        assert!(!narrow(&contact, 0..2, 0.0), "where one body ends and the other goes on");
        contact.pair.law = Law::Bilateral;
        assert!(!narrow(&contact, 20..22, 0.0));
    }
}
