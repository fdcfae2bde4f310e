//! How wide the zones of a contact are, and whether the mesh holds that.

use crate::contact::{Law, Zone, hertz_width};
use crate::discretisation::ContactPressure;
use crate::mesh::MacroMesh;
use crate::recovery::traces::TracePoint;

/// Edges that the narrowest contact has at least: on less than one no element can bend to a pressure.
pub const NARROWEST: f64 = 1.0;

impl ContactPressure<'_> {
    /// Width that the force of a zone asks for between smooth convex sides (length; Hertz); `points` are the traces of the contact.
    pub fn hertz_width(&self, zone: &Zone, points: &[TracePoint]) -> Option<f64> {
        let Self { contact, .. } = self;
        let gaps = points.iter().map(|point| [point.arc, contact.pair.gap.at_rest(point.x, point.distance)]);
        let middle = contact.boundary.parameter_at(0.5 * (zone.arcs[0] + zone.arcs[1]));
        let force = self.force_of(zone) / contact.boundary.width(middle);
        hertz_width(gaps, zone.arcs, force, contact.compliance).filter(|width| *width <= contact.boundary.length())
    }

    /// Whether a zone of unilateral contact that carries more than a force is narrower than an edge, by what presses or by what its force asks for. The force
    /// of a corner is right on any mesh.
    pub fn is_too_narrow(&self, mesh: &MacroMesh, points: &[TracePoint], least: f64) -> bool {
        let narrow = |zone: &Zone| {
            let (length, width) = (zone.arcs[1] - zone.arcs[0], self.hertz_width(zone, points));
            let edges = self.contact.edges_on(zone) * width.map_or(1.0, |width| (width / length).min(1.0));
            let is_corner = width.is_none() && (0..2).any(|end| self.ends_at_a_corner(mesh, zone, end));
            edges < NARROWEST && !is_corner
        };
        self.contact.pair.law == Law::Unilateral && self.zones().iter().any(|zone| self.force_of(zone).abs() > least && narrow(zone))
    }
}
