//! Triangles that overlap their own body.

use crate::geometry::{Disc, Point, cross, overlapping_discs};
use crate::mesh::MeshError;
use crate::mesh::macro_mesh::MacroMesh;

/// Triangles overlap if they lie in each other by more than this share of their size.
const DEPTH: f64 = 1e-6;

impl MacroMesh {
    /// No two triangles of a body may cover the same place. Where two regions overlap, the boundary of one runs inside the
    /// other: so it is enough to look at the triangles on boundaries.
    ///
    /// # Errors
    /// Words with the place.
    pub(crate) fn check_overlap(&self) -> Result<(), MeshError> {
        let is_on_boundary = |triangle: &usize| {
            let edges = self.triangles[*triangle].edges;
            edges.iter().any(|&edge| self.edges[edge as usize].triangles[1].is_none())
        };
        let all: Vec<Disc> = (0..self.triangles.len()).map(|triangle| disc_around(self.corners(triangle))).collect();
        let on_boundary: Vec<usize> = (0..self.triangles.len()).filter(is_on_boundary).collect();
        let discs: Vec<Disc> = on_boundary.iter().map(|&triangle| all[triangle]).collect();
        let body = |triangle: usize| self.triangles[triangle].body as usize;
        let mut first: Option<usize> = None;
        overlapping_discs(&all, &discs, |one, at| {
            let other = on_boundary[at];
            let may_be_first = one != other && body(one) == body(other) && first.is_none_or(|first| one < first);
            if may_be_first && overlap(self.corners(one), self.corners(other)) {
                first = Some(one);
            }
        });
        let Some(first) = first else { return Ok(()) };
        let (x, body) = (self.corners(first).iter().sum::<Point>() / 3.0, &self.bodies[body(first)]);
        Err(self.unusable(format!(
            "triangles of body \"{body}\" overlap near ({}, {}): the same place would count twice; mesh the scene again",
            x.x, x.y
        )))
    }
}

/// A disc that holds a triangle.
fn disc_around(corners: [Point; 3]) -> Disc {
    let middle = corners.iter().sum::<Point>() / 3.0;
    Disc { middle, radius: corners.iter().map(|corner| (corner - middle).norm()).fold(0.0, f64::max) }
}

/// Whether two triangles, both counter-clockwise, have an area in common: no side of either parts them.
fn overlap(a: [Point; 3], b: [Point; 3]) -> bool {
    let size = |t: &[Point; 3]| (t[1] - t[0]).norm().max((t[2] - t[1]).norm()).max((t[0] - t[2]).norm());
    let least = DEPTH * size(&a).min(size(&b));
    let parts = |own: &[Point; 3], other: &[Point; 3]| {
        (0..3).any(|k| {
            let along = (own[(k + 1) % 3] - own[k]).normalize();
            other.iter().all(|x| cross(along, x - own[k]) <= least)
        })
    };
    !parts(&a, &b) && !parts(&b, &a)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn triangles_overlap_if_they_have_an_area_in_common() {
        let at = |x: f64, y: f64| [Point::new(x, y), Point::new(x + 1.0, y), Point::new(x, y + 1.0)];
        assert!(overlap(at(0.0, 0.0), at(0.3, 0.3)));
        assert!(overlap(at(0.0, 0.0), at(0.0, 0.0)));
        assert!(!overlap(at(0.0, 0.0), at(1.0, 0.0)), "a corner in common");
        assert!(!overlap(at(0.0, 0.0), at(0.6, 0.6)));
        let mirrored = [Point::new(1.0, 0.0), Point::new(1.0, 1.0), Point::new(0.0, 1.0)];
        assert!(!overlap(at(0.0, 0.0), mirrored), "an edge in common");
    }
}
