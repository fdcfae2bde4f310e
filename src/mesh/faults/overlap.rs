//! Triangles that overlap their own body.

use crate::geometry::{Coordinates, Point, bounds, cross};
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
        let on_boundary = |triangle: usize| {
            let edges = self.triangles[triangle].edges;
            edges.iter().any(|&edge| self.edges[edge as usize].triangles[1].is_none())
        };
        let on_boundary: Vec<usize> = (0..self.triangles.len()).filter(|&triangle| on_boundary(triangle)).collect();
        let (strip, grids) = (BoundaryStrip::new(self, &on_boundary), BoundaryGrids::new(self, &on_boundary));
        for triangle in (0..self.triangles.len()).filter(|&triangle| strip.meets(&self.corners(triangle))) {
            let alike = |other: &usize| *other != triangle && self.triangles[*other].body == self.triangles[triangle].body;
            let corners = self.corners(triangle);
            if grids.near(&corners).filter(alike).any(|other| overlap(corners, self.corners(other))) {
                let (x, body) = (corners.iter().sum::<Point>() / 3.0, &self.bodies[self.triangles[triangle].body as usize]);
                return Err(self.unusable(format!(
                    "triangles of body \"{body}\" overlap near {}: the same place would count twice; mesh the scene again",
                    Coordinates(x)
                )));
            }
        }
        Ok(())
    }
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

/// A square of a grid: the level of its size 2^level, and its place.
type GridSquare = (i32, i64, i64);

/// Grids of squares of many sizes, with the triangles on boundaries.
struct BoundaryGrids {
    low: Point,
    /// Levels of all triangles, ascending.
    levels: Vec<i32>,
    /// Each triangle in those squares of about its own size that its box meets, sorted by them.
    own: Vec<(GridSquare, u32)>,
    /// Each triangle in those squares of all larger sizes, and of its own.
    larger: Vec<(GridSquare, u32)>,
}

impl BoundaryGrids {
    fn new(mesh: &MacroMesh, on_boundary: &[usize]) -> Self {
        let [low, _] = bounds(mesh.vertices.iter().copied());
        // Triangles that follow each other are mostly of one level.
        let mut levels: Vec<i32> = (0..mesh.triangles.len()).map(|triangle| level(&mesh.corners(triangle))).collect();
        levels.dedup();
        levels.sort_unstable();
        levels.dedup();
        let mut grids = Self { low, levels, own: Vec::new(), larger: Vec::new() };
        for &triangle in on_boundary {
            let corners = mesh.corners(triangle);
            let own = level(&corners);
            for &level in &grids.levels[grids.levels.partition_point(|&level| level < own)..] {
                grids.larger.extend(under(low, &corners, level).map(|square| (square, triangle as u32)));
            }
            grids.own.extend(under(low, &corners, own).map(|square| (square, triangle as u32)));
        }
        grids.own.sort_unstable();
        grids.larger.sort_unstable();
        grids
    }

    /// Triangles on boundaries that may overlap one; some come more than once.
    fn near<'a>(&'a self, corners: &'a [Point; 3]) -> impl Iterator<Item = usize> + 'a {
        let own = level(corners);
        let above = &self.levels[self.levels.partition_point(|&level| level <= own)..];
        let larger =
            above.iter().flat_map(move |&level| under(self.low, corners, level).flat_map(|square| of_square(&self.own, square)));
        let smaller = under(self.low, corners, own).flat_map(|square| of_square(&self.larger, square));
        smaller.chain(larger)
    }
}

/// The squares of a level under the box of a triangle, in grids that begin at `low`.
fn under(low: Point, corners: &[Point; 3], level: i32) -> impl Iterator<Item = GridSquare> + use<> {
    let [a, b, c] = corners.map(|x| (x - low) / 2f64.powi(level));
    let (low, high) = (a.inf(&b).inf(&c), a.sup(&b).sup(&c));
    let [i0, j0, i1, j1] = [low.x, low.y, high.x, high.y].map(|v| v.floor() as i64);
    (i0..=i1).flat_map(move |i| (j0..=j1).map(move |j| (level, i, j)))
}

/// Triangles in a square.
fn of_square(sorted: &[(GridSquare, u32)], square: GridSquare) -> impl Iterator<Item = usize> {
    let first = sorted.partition_point(|(other, _)| *other < square);
    sorted[first..].iter().take_while(move |(other, _)| *other == square).map(|&(_, triangle)| triangle as usize)
}

/// Squares of size 2^level are as large as the box of a triangle, or up to twice.
fn level(corners: &[Point; 3]) -> i32 {
    let [a, b, c] = corners;
    let size = (a.sup(b).sup(c) - a.inf(b).inf(c)).amax();
    // The exponent of a normal number: what `log2` and `ceil` give.
    let exponent = (size.to_bits() >> 52) as i32 - 1023;
    exponent + i32::from(size.to_bits() << 12 != 0)
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

    #[test]
    fn pairs_that_are_looked_at_grow_as_the_number_of_triangles() {
        let looks = |count: usize| {
            let mesh = crate::mesh::samples::columns(count, 1.0);
            let grids = BoundaryGrids::new(&mesh, &Vec::from_iter(0..mesh.triangles.len()));
            (0..mesh.triangles.len()).map(|triangle| grids.near(&mesh.corners(triangle)).count()).sum::<usize>()
        };
        let [few, many] = [looks(500), looks(2000)];
        assert!(many <= 4 * few + 100 && many < 20 * 4000, "{few} and {many} looks");
    }
}
