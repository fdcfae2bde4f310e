//! The first mesh of a sequence, halved at once to what the forces ask for where smooth sides touch at a point.
//!
//! Between smooth convex sides a force presses on a half width b that the theory of Hertz tells, however coarse the mesh is that the
//! force was found on. Where it tells more than a fifth of the radius, or sides conform, adaptivity decides alone.

use super::settings::Procedure;
use crate::accuracy::Accuracy;
use crate::geometry::Point;
use crate::mesh::{BisectedMesh, MacroMesh};
use crate::system::{Scene, SystemError};

/// Macro edges by the half width b: elements are a quarter of them, so that four lie on b.
const EDGE: f64 = 2.0;

/// Rounds of halving at most: by then edges are a millionth of what they were.
const ROUNDS: usize = 40;

/// A place where a force acts between two boundaries, and the edge that it asks for (length).
struct WantedEdge<'s> {
    between: &'s [String; 2],
    place: Point,
    edge: f64,
}

impl Procedure<'_> {
    /// The mesh of a scene, halved where point contacts carry more than the share of the largest force that is asked for, as long as
    /// it has no more unknowns than `fits` allows. **Collective**
    ///
    /// # Errors
    /// As of [`Procedure::begun`].
    pub(super) fn halved_by_forces(
        &self,
        scene: &Scene,
        mesh: BisectedMesh,
        accuracy: &Accuracy,
        fits: impl Fn(&BisectedMesh) -> bool,
    ) -> Result<BisectedMesh, SystemError> {
        let coarsest = Scene { refine: 0, ..scene.clone() };
        let loaded = match self.loaded_places(&coarsest) {
            Ok(Some(loaded)) => loaded,
            // The mesh of the file is too coarse for a contact; finer ones may do.
            Ok(None) | Err(SystemError::Case(_)) => return Ok(mesh),
            Err(error) => return Err(error),
        };
        let tolerance = accuracy.goals.iter().map(|goal| goal.tolerance).fold(1.0, f64::min);
        let largest = loaded.iter().map(|place| place.force).fold(0.0, f64::max);
        let carries = loaded.iter().filter(|place| place.force > tolerance * largest);
        let wanted: Vec<WantedEdge> = carries.filter_map(|place| place.wanted(&scene.pairs[place.contact].between)).collect();
        let mut halved = mesh;
        for _ in 0..ROUNDS {
            let marked: Vec<u32> = wanted.iter().flat_map(|wanted| wanted.too_long(&halved.mesh)).collect();
            if marked.is_empty() {
                break;
            }
            let next = halved.refined(marked.into_iter());
            if !fits(&next) {
                break;
            }
            halved = next;
        }
        Ok(halved)
    }
}

/// Where a contact presses, as far as the coarsest mesh tells.
pub(super) struct LoadedPlace {
    /// The contact among all of the scene.
    pub contact: usize,
    /// Its force (per thickness).
    pub force: f64,
    /// Where it acts and on what half width, if the sides touch at a point.
    pub width: Option<(Point, f64)>,
}

impl LoadedPlace {
    /// The edge that the force asks for.
    fn wanted<'s>(&self, between: &'s [String; 2]) -> Option<WantedEdge<'s>> {
        self.width.map(|(place, half)| WantedEdge { between, place, edge: EDGE * half })
    }
}

impl WantedEdge<'_> {
    /// Macro triangles with an edge on the contact at the place that is too long.
    fn too_long(&self, mesh: &MacroMesh) -> Vec<u32> {
        let edges = self.between.iter().filter_map(|name| mesh.boundary(name)).flat_map(|boundary| &boundary.edges);
        let is_near = |edge: u32| {
            let ends = mesh.edges[edge as usize].vertices.map(|vertex| mesh.vertices[vertex as usize]);
            let along = ((self.place - ends[0]).dot(&(ends[1] - ends[0])) / (ends[1] - ends[0]).norm_squared()).clamp(0.0, 1.0);
            let bent = (mesh.edge_position(edge, 0.5) - 0.5 * (ends[0] + ends[1])).norm();
            (ends[0] + along * (ends[1] - ends[0]) - self.place).norm() <= 0.5 * self.edge + bent
        };
        let long = edges.copied().filter(|&edge| mesh.edge_length(edge) > self.edge && is_near(edge));
        long.filter_map(|edge| mesh.edges[edge as usize].triangles[0]).collect()
    }
}
