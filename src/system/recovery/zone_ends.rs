//! The ends of a zone that presses, where they are those of Γ_C: pressures without bound, corners of one body.

use crate::contact::{MultiplierSpace, Zone};
use crate::mesh::MacroMesh;
use crate::system::{Contact, ContactPressure};

/// Growth of the pressure from the last segment but one to the last, and by one refinement, above which it may be singular at
/// an end.
const GROWS: f64 = 1.02;

/// Share of the growth by one refinement that the next one adds where λ goes like a power of the distance below zero: one or
/// more; where it is bounded a half or less.
const GOES_ON: f64 = 0.75;

/// Two ends are one if they are nearer than this share of the length.
const SAME: f64 = 1e-6;

impl ContactPressure<'_> {
    /// Whether λ grows towards an end of Γ_C, ever more quickly, and without bound as meshes are refined, as far as the values
    /// there on the mesh `before` and on the one before that (`earlier`) tell. Steps grow towards any steep end.
    pub fn grows_towards(&self, zone: &Zone, end: usize, [before, earlier]: [Option<f64>; 2]) -> bool {
        let contact = self.contact;
        if !touches(contact, zone, end) || zone.segments.len() < 3 {
            return false;
        }
        let nth = |i: usize| if end == 0 { zone.segments.start + i } else { zone.segments.end - 1 - i };
        let [a, b, c] = [0, 1, 2].map(|i| self.value(nth(i), 0.5));
        let lengths = [0, 1, 2].map(|i| contact.boundary.segment_length(nth(i)));
        let slopes = [(a - b) / (lengths[0] + lengths[1]), (b - c) / (lengths[1] + lengths[2])];
        let last = self.value(nth(0), if end == 0 { 0.05 } else { 0.95 });
        let grown = match (before, earlier) {
            (Some(before), Some(earlier)) => {
                last > GROWS * before && before > earlier && last - before > GOES_ON * (before - earlier)
            }
            (Some(before), None) => contact.multipliers.space != MultiplierSpace::P0 && last > GROWS * before,
            _ => true,
        };
        a > GROWS * b && slopes[0] > slopes[1] && grown
    }

    /// Whether a zone reaches an end of Γ_C where one of the bodies has a corner and the other goes on.
    pub fn ends_at_a_corner(&self, mesh: &MacroMesh, zone: &Zone, end: usize) -> bool {
        let contact = self.contact;
        let boundary = &contact.boundary;
        if !touches(contact, zone, end) || boundary.period().is_some() {
            return false;
        }
        let knots = boundary.knots();
        let (here, length) = (if end == 0 { knots[0] } else { knots[knots.len() - 1] }, knots[knots.len() - 1] - knots[0]);
        // How far each body's boundary goes on beyond the end.
        let beyond = contact.pair.between.each_ref().map(|name| {
            let edges = mesh.boundary(name).map(|boundary| boundary.edges.as_slice()).unwrap_or(&[]);
            let vertices = edges.iter().flat_map(|&edge| mesh.edges[edge as usize].vertices);
            let feet = vertices.map(|vertex| boundary.foot(mesh.vertices[vertex as usize]) - here);
            feet.map(|foot| if end == 0 { -foot } else { foot }).fold(f64::NEG_INFINITY, f64::max) / length
        });
        let least = beyond[0].min(beyond[1]);
        least.abs() < SAME && beyond[0].max(beyond[1]) > SAME
    }
}

/// Whether a zone reaches an end of Γ_C.
fn touches(contact: &Contact, zone: &Zone, end: usize) -> bool {
    if end == 0 { zone.segments.start == 0 } else { zone.segments.end == contact.boundary.segments() }
}
