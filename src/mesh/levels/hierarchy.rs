//! The hierarchy of triangles over one macro triangle, refined evenly or towards graded corners.
//!
//! At each refinement the new node on an edge with a graded end goes to the fraction κ < ½ from that end; to the middle if
//! both ends are graded, or none.
//!
//! ```text
//!   2
//!   | \           One refinement, graded at corner 0. The child there is the triangle itself, κ times as large, and is
//!   |   \         graded again; the three others are refined evenly. So positions are affine in the lattice on each of
//!   |     o       these pieces, the levels nest, and there are few shapes: the pieces of one child are like those of
//!   |  . / \      the next. After one refinement no triangle has more than one graded corner.
//!   o '/    \
//!   |\/      \
//!   0-o-------1
//! ```
//! Order k in the energy norm for `u ~ r^α` wants `κ <= 2^(-k/α)`: Băcuță, Nistor, Zikatanov, Improving the rate of
//! convergence of 'high order finite elements' on polygons and domains with cusps, Numerische Mathematik 100 (2005), 165-184.

use crate::geometry::{Point, cross};

/// Fraction, from the first end of an edge, of its new node; `ratios` are the κ of its ends, if they are graded.
pub(crate) fn fraction(ratios: [Option<f64>; 2]) -> f64 {
    match ratios {
        [Some(ratio), None] => ratio,
        [None, Some(ratio)] => 1.0 - ratio,
        _ => 0.5,
    }
}

/// A triangle of the hierarchy over one macro triangle, in the reference triangle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct HierarchyTriangle {
    /// Corners of the triangle.
    pub(crate) corners: [Point; 3],
    /// κ of the graded corners.
    ratios: [Option<f64>; 3],
    /// Refinements that are left.
    left: u32,
    /// See [`Shapes`].
    shape: usize,
}

impl HierarchyTriangle {
    /// The macro triangle, to be refined so many times.
    pub(crate) fn whole(ratios: [Option<f64>; 3], refinements: u32) -> Self {
        let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]].map(Point::from);
        Self { corners, ratios, left: refinements, shape: 0 }
    }

    /// Whether its refinement moves nodes away from the middle; otherwise positions in it are affine in the lattice.
    fn is_graded(&self) -> bool {
        self.left > 0 && self.ratios.iter().any(Option::is_some)
    }

    /// The child at corner `k < 3`, its corners in the same order; with `k = 3` the one in the middle, whose corner `j` is
    /// the new node opposite to corner `j`.
    fn child(&self, k: usize) -> Self {
        let node = |a: usize, b: usize| {
            let t = fraction([self.ratios[a], self.ratios[b]]);
            self.corners[a] * (1.0 - t) + self.corners[b] * t
        };
        let corners = [0, 1, 2].map(|j| match k {
            3 => node((j + 1) % 3, (j + 2) % 3),
            _ if j == k => self.corners[k],
            _ => node(k, j),
        });
        let mut ratios = [None; 3];
        if k < 3 {
            ratios[k] = self.ratios[k];
        }
        let first = if self.shape == 0 { k } else { (self.shape - 1) / 4 };
        Self { corners, ratios, left: self.left - 1, shape: 1 + 4 * first + k }
    }

    /// The triangle that holds a lattice point and is affine, with the point's barycentric coordinates in it.
    pub(crate) fn below(mut self, mut l: [f64; 3]) -> (Self, [f64; 3]) {
        while self.is_graded() {
            let corner = (0..3).find(|&k| l[k] >= 0.5);
            l = match corner {
                Some(k) => [0, 1, 2].map(|j| if j == k { 2.0 * l[j] - 1.0 } else { 2.0 * l[j] }),
                None => l.map(|v| 1.0 - 2.0 * v),
            };
            self = self.child(corner.unwrap_or(3));
        }
        (self, l)
    }

    /// Barycentric coordinates in the lattice of a point of the reference triangle.
    pub(crate) fn lattice_of(&self, x: Point) -> [f64; 3] {
        if !self.is_graded() {
            return self.barycentric(x);
        }
        let least = |k: usize| self.child(k).barycentric(x).into_iter().fold(f64::INFINITY, f64::min);
        let k = (0..4).max_by(|&a, &b| least(a).total_cmp(&least(b))).unwrap_or(3);
        let l = self.child(k).lattice_of(x);
        match k {
            3 => l.map(|v| 0.5 * (1.0 - v)),
            _ => [0, 1, 2].map(|j| if j == k { 0.5 * (1.0 + l[j]) } else { 0.5 * l[j] }),
        }
    }

    fn barycentric(&self, x: Point) -> [f64; 3] {
        let [a, b, c] = self.corners;
        let whole = cross(b - a, c - a);
        let [first, second] = [cross(b - x, c - x) / whole, cross(c - x, a - x) / whole];
        [first, second, 1.0 - first - second]
    }
}

/// Barycentric coordinates of the point `(xi, eta)` of the reference triangle.
pub(crate) fn barycentric(at: Point) -> [f64; 3] {
    [1.0 - at.x - at.y, at.x, at.y]
}

/// The shapes of the affine pieces of one macro triangle. A piece of shape `1 + 4 a + b` lies in the child at `a` of the
/// whole (3: in the middle), and is the child at `b` of the child before it; shape 0 is the whole.
pub struct Shapes {
    pub(crate) whole: HierarchyTriangle,
    pub(crate) intervals: usize,
}

impl Shapes {
    /// How many there can be.
    pub const COUNT: usize = 17;

    /// Whether there is but one, because refinement is even.
    pub fn is_one(&self) -> bool {
        !self.whole.is_graded()
    }

    /// Shape of a triangle of the lattice, by its corners.
    pub fn of(&self, corners: [(usize, usize); 3]) -> usize {
        let sum = corners.iter().fold([0, 0], |[i, j], corner| [i + corner.0, j + corner.1]);
        let middle = sum.map(|v| v as f64 / (3 * self.intervals) as f64);
        self.whole.below(barycentric(middle.into())).0.shape
    }

    /// Corners, in the reference triangle, of a triangle like those of a shape but for its size.
    pub fn corners(&self, shape: usize) -> [Point; 3] {
        let Some(path) = shape.checked_sub(1) else { return self.whole.corners };
        let (first, last) = (path / 4, path % 4);
        let child = HierarchyTriangle { left: 2, ..self.whole }.child(first);
        if first == last { child.corners } else { child.child(last).corners }
    }
}
