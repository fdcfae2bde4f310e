//! The first mesh of a sequence, halved at once to what the forces ask for where smooth sides touch at a point.
//!
//! Between smooth convex sides a force presses on a half width b that the theory of Hertz tells, however coarse the mesh is that the
//! force was found on. Where it tells more than a fifth of the radius, or sides conform, adaptivity decides alone.

use crate::accuracy::{Accuracy, Goal, Quantity};
use crate::discretisation::{Scene, SystemError};
use crate::geometry::Point;
use crate::mesh::{BisectedMesh, MacroMesh};
use crate::procedure::sequence::across::distance;
use crate::procedure::sequence::mesh_sequence::MeshSequence;
use crate::procedure::settings::Procedure;

/// Macro edges by the half width b, at most: elements are half of them, so that four lie on b.
const MOST_EDGE: f64 = 0.5;

/// The same by the root of the error that is asked for of a pressure or of a peak, whose errors fall with the square of the edges: with
/// edges of a quarter to a half of b the pressure of a roller was off by .8 to 1.4 %, with half of that by .2 to .4 %.
const EDGE_BY_ROOT: f64 = 3.5;

/// Rounds of halving at most: by then edges are a millionth of what they were.
const ROUNDS: usize = 40;

/// A place where a force acts between two boundaries, and the edge that it asks for (length).
struct WantedEdge<'s> {
    contact: &'s str,
    between: &'s [String; 2],
    place: Point,
    /// Half width of the contact there (length).
    half: f64,
    edge: f64,
}

impl Procedure<'_> {
    /// Halves the first mesh of a sequence where point contacts carry more than the share of the largest force that is asked for, as
    /// long as that leaves room for finer meshes. **Collective**
    ///
    /// # Errors
    /// As of [`Procedure::begun`].
    pub(crate) fn halve_by_forces(&self, sequence: &mut MeshSequence, accuracy: &Accuracy) -> Result<(), SystemError> {
        let coarsest = Scene { refine: 0, ..sequence.scene.clone() };
        let loaded = match self.loaded_places(&coarsest) {
            Ok(Some(loaded)) => loaded,
            // The mesh of the file is too coarse for a contact; finer ones may do.
            Ok(None) | Err(SystemError::Case(_)) => return Ok(()),
            Err(error) => return Err(error),
        };
        let tolerance = accuracy.goals.iter().map(|goal| goal.tolerance).fold(1.0, f64::min);
        let largest = loaded.iter().map(|place| place.force).fold(0.0, f64::max);
        let edge = edge_by_half_width(&accuracy.goals);
        let wanted = |place: &LoadedPlace| {
            let pair = &coarsest.pairs[place.contact];
            let (at, half) = place.width.filter(|_| place.force > tolerance * largest)?;
            Some(WantedEdge { contact: &pair.name, between: &pair.between, place: at, half, edge: edge * half })
        };
        let wanted: Vec<WantedEdge> = loaded.iter().filter_map(wanted).collect();
        if wanted.is_empty() {
            return Ok(());
        }
        let name = |place: &LoadedPlace| coarsest.pairs[place.contact].name.clone();
        // What carries less than the accuracy of the largest has nothing to resolve.
        let light = loaded.iter().filter(|place| place.force <= tolerance * largest).map(name);
        sequence.begin_with_resolved(wanted.iter().map(|wanted| wanted.contact.to_string()).chain(light).collect(), tolerance);
        for _ in 0..ROUNDS {
            let marked: Vec<u32> = wanted.iter().flat_map(|wanted| wanted.too_long(&sequence.mesh.mesh)).collect();
            let next: Option<BisectedMesh> = (!marked.is_empty()).then(|| sequence.mesh.refined(marked.into_iter()));
            let Some(next) = next.filter(|next| sequence.has_room_for(next)) else { break };
            sequence.begin_with(next);
        }
        Ok(())
    }
}

/// The longest macro edge on a contact by its half width.
fn edge_by_half_width(goals: &[Goal]) -> f64 {
    let asked = goals.iter().filter(|goal| matches!(goal.quantity, Quantity::Pressure(_) | Quantity::Peak(_)));
    asked.map(|goal| EDGE_BY_ROOT * goal.tolerance.sqrt()).fold(MOST_EDGE, f64::min)
}

/// Where a contact presses, as far as the coarsest mesh tells.
pub(crate) struct LoadedPlace {
    /// The contact among all of the scene.
    pub contact: usize,
    /// Its force (per thickness).
    pub force: f64,
    /// Where it acts and on what half width, if the sides touch at a point.
    pub width: Option<(Point, f64)>,
}

impl WantedEdge<'_> {
    /// Macro triangles with an edge on the contact that is too long, beside the place of either side that is nearest to the force: sides
    /// that are drawn in each other are apart by more than it presses on.
    fn too_long(&self, mesh: &MacroMesh) -> Vec<u32> {
        let mut all = Vec::new();
        for edges in self.between.each_ref().map(|name| mesh.edges_of(name)) {
            let feet = edges.iter().map(|&edge| mesh.foot_on_chord(edge, self.place));
            let away = |foot: &Point| (foot - self.place).norm_squared();
            let Some(foot) = feet.min_by(|a, b| away(a).total_cmp(&away(b))) else { continue };
            let is_near = |edge: u32| {
                let ends = mesh.edge_ends(edge);
                let bent = (mesh.edge_position(edge, 0.5) - 0.5 * (ends[0] + ends[1])).norm();
                distance(mesh, foot, edge) <= self.half + bent
            };
            let long = edges.iter().copied().filter(|&edge| mesh.edge_length(edge) > self.edge && is_near(edge));
            all.extend(long.filter_map(|edge| mesh.edges[edge as usize].triangles[0]));
        }
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::samples::seam;
    use crate::mesh::each_once;
    use crate::mesh::samples::two_blocks;

    /// Two blocks, the upper one drawn a tenth into the lower one.
    #[test]
    fn both_sides_are_halved_however_deep_they_are_drawn_in_each_other() {
        let mut mesh = two_blocks();
        let upper = mesh.bodies.iter().position(|name| name == "upper").expect("named") as u32;
        let of_upper = mesh.triangles.iter().filter(|triangle| triangle.body == upper).flat_map(|triangle| triangle.vertices);
        each_once(of_upper).into_iter().for_each(|vertex| mesh.vertices[vertex as usize].y -= 0.1);
        let pair = seam();
        for height in [1.0, 0.9] {
            let place = Point::new(0.6, height);
            let wanted = WantedEdge { contact: &pair.name, between: &pair.between, place, half: 1e-3, edge: 0.1 };
            let bodies = each_once(wanted.too_long(&mesh).into_iter().map(|at| mesh.triangles[at as usize].body));
            assert_eq!(bodies.len(), 2, "a force at {place}");
        }
    }
}
