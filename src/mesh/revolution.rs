//! Meshes of bodies of revolution: halves of their sections, at the right of the axis x = 0.

use super::MeshError;
use super::macro_mesh::MacroMesh;
use crate::element::Plane;
use crate::geometry::{Coordinates, Point};

/// Share of the largest radius within which a vertex lies on the axis: files have six digits or more.
const ON_AXIS: f64 = 1e-7;

impl MacroMesh {
    /// Where a vertex is moved to: one on the axis of revolution stays there, though the point of a curve misses it by rounding.
    pub(super) fn kept_on_axis(&self, here: Point, there: Point) -> Point {
        let is_on_axis = self.plane == Plane::Revolution && here.x == 0.0;
        if is_on_axis { Point::new(0.0, there.y) } else { there }
    }

    /// Macro edges on the axis of revolution.
    pub fn edges_on_axis(&self) -> impl Iterator<Item = u32> {
        (0..self.edges.len() as u32).filter(|&edge| self.edge_ends(edge).iter().all(|end| end.x == 0.0))
    }

    /// Says what the plane stands for. In a body of revolution vertices beside the axis by rounding come to lie on it.
    ///
    /// # Errors
    /// [`MeshError::Unusable`] with the vertex of a body of revolution that lies at the left of the axis.
    pub fn set_plane(&mut self, plane: Plane) -> Result<(), MeshError> {
        self.plane = plane;
        if plane != Plane::Revolution {
            return Ok(());
        }
        let nearly = ON_AXIS * self.vertices.iter().map(|x| x.x.abs()).fold(0.0, f64::max);
        self.vertices.iter_mut().filter(|x| x.x.abs() <= nearly).for_each(|x| x.x = 0.0);
        match self.vertices.iter().find(|x| x.x < 0.0) {
            None => Ok(()),
            Some(x) => Err(self.unusable(format!(
                "the vertex at {} lies at the left of the axis of revolution, x = 0; mesh the half of the section at its right",
                Coordinates(*x)
            ))),
        }
    }
}
