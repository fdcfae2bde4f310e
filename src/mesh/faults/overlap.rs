//! Triangles that overlap their own body.

use crate::geometry::{Coordinates, Disc, Point, bounds, cross, overlapping_discs};
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
        let is_outer = |triangle: &usize| self.triangles[*triangle].edges.iter().any(|&edge| self.is_outer(edge));
        let on_boundary: Vec<usize> = (0..self.triangles.len()).filter(is_outer).collect();
        let strip = BoundaryStrip::new(self, &on_boundary);
        let near: Vec<usize> = (0..self.triangles.len()).filter(|&triangle| strip.meets(&self.corners(triangle))).collect();
        let [discs, outer] = [&near, &on_boundary].map(|all| all.iter().map(|&k| disc(&self.corners(k))).collect::<Vec<_>>());
        let mut first = usize::MAX;
        overlapping_discs(&discs, &outer, |a, b| {
            let [one, other] = [near[a], on_boundary[b]];
            let is_alike = one != other && self.triangles[one].body == self.triangles[other].body;
            if is_alike && one < first && overlap(self.corners(one), self.corners(other)) {
                first = one;
            }
        });
        if first < self.triangles.len() {
            let (x, body) = (disc(&self.corners(first)).middle, &self.bodies[self.triangles[first].body as usize]);
            return Err(self.unusable(format!(
                "triangles of body \"{body}\" overlap near {}: the same place would count twice; mesh the scene again",
                Coordinates(x)
            )));
        }
        Ok(())
    }
}

/// A disc that holds a triangle.
fn disc(corners: &[Point; 3]) -> Disc {
    let middle = corners.iter().sum::<Point>() / 3.0;
    Disc { middle, radius: corners.iter().map(|x| (x - middle).norm()).fold(0.0, f64::max) }
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

/// Squares that the strip marks for each triangle of the mesh at most, and that it looks at for one. The box of an equilateral
/// triangle is 1.5 squares wide and 1.3 high in a mesh of its like, so that it meets 6 of them in the mean, and 9 at most. Without the
/// bound the work would be quadratic for bands of long thin ones.
const MOST_MARKS: usize = 16;

/// The strip along all boundaries, in squares of one grid, as many as the mesh has triangles: most triangles lie away from it.
struct BoundaryStrip {
    low: Point,
    /// Width of the squares (length).
    width: f64,
    /// Squares of a row.
    row: usize,
    /// Which squares meet the box of a triangle on a boundary; none if so many are met that all count.
    marked: Vec<bool>,
}

impl BoundaryStrip {
    fn new(mesh: &MacroMesh, on_boundary: &[usize]) -> Self {
        let [low, high] = bounds(mesh.vertices.iter().copied());
        let size = high - low;
        let count = mesh.triangles.len() as f64;
        // Roots first: the product of small sizes would be zero.
        let width = (size.x.sqrt() * size.y.sqrt() / count.sqrt()).max(size.amax() / count);
        let [row, rows] = [size.x, size.y].map(|size| (size / width) as usize + 1);
        let mut strip = Self { low, width, row, marked: vec![false; row * rows] };
        let mut marks = 0;
        for &triangle in on_boundary {
            for square in strip.squares(strip.box_of(&mesh.corners(triangle))) {
                strip.marked[square] = true;
                marks += 1;
                if marks > MOST_MARKS * mesh.triangles.len() {
                    return Self { marked: Vec::new(), ..strip };
                }
            }
        }
        strip
    }

    /// The first and the last square, in both directions, under the box of a triangle.
    fn box_of(&self, [a, b, c]: &[Point; 3]) -> [[usize; 2]; 2] {
        let place = |x: Point| [0, 1].map(|k| ((x[k] - self.low[k]) / self.width) as usize);
        [place(a.inf(b).inf(c)), place(a.sup(b).sup(c))]
    }

    fn squares(&self, [low, high]: [[usize; 2]; 2]) -> impl Iterator<Item = usize> + use<> {
        let row = self.row;
        (low[1]..=high[1]).flat_map(move |j| (low[0]..=high[0]).map(move |i| j * row + i))
    }

    /// Whether a triangle may have a triangle on a boundary in its box; one that is long beside the others may always.
    fn meets(&self, corners: &[Point; 3]) -> bool {
        let [low, high] = self.box_of(corners);
        let is_long = (high[0] - low[0] + 1).saturating_mul(high[1] - low[1] + 1) > MOST_MARKS;
        is_long || self.marked.is_empty() || self.squares([low, high]).any(|square| self.marked[square])
    }
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

    /// Nor is any triangle where the boxes of those on boundaries meet too many squares.
    #[test]
    fn a_long_triangle_is_not_looked_for_in_the_strip() {
        let mesh = crate::mesh::samples::columns(500, 1.0);
        let strip = BoundaryStrip::new(&mesh, &[0]);
        let at = |x: f64, y: f64| Point::new(x, y);
        let thin = [at(0.0, 0.0), at(500.0, 1.0), at(499.0, 1.0)];
        let [low, high] = strip.box_of(&thin);
        assert!((high[0] - low[0] + 1) * (high[1] - low[1] + 1) > MOST_MARKS && strip.meets(&thin));
        let small = [at(400.0, 0.0), at(401.0, 0.0), at(400.0, 1.0)];
        assert!(!strip.meets(&small) && strip.meets(&mesh.corners(0)), "one triangle is on the boundary");
        let all = BoundaryStrip::new(&mesh, &vec![0; 100 * mesh.triangles.len()]);
        assert!(all.marked.is_empty() && all.meets(&small), "too many marks");
    }
}
