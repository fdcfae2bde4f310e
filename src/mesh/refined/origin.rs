//! Where the triangles of a mesh lie in one that is coarser.

/// Where a triangle lies in a mesh that is coarser.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Origin {
    /// The triangle that it is a part of.
    pub triangle: u32,
    /// Corners of the part in the barycentric coordinates of that triangle.
    pub corners: [[f64; 3]; 3],
}

/// Corners of a whole triangle.
const WHOLE: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

impl Origin {
    /// Whether it is the whole triangle, with its corners in the same order.
    pub fn is_whole(&self) -> bool {
        self.corners == WHOLE
    }

    /// Where it lies in a mesh that is coarser still, from where that one's triangles do.
    pub fn within(&self, coarser: &[Self]) -> Self {
        let outer = &coarser[self.triangle as usize];
        Self { triangle: outer.triangle, corners: self.corners.map(|l| outer.point(l)) }
    }

    /// All of a triangle.
    pub fn whole(triangle: usize) -> Self {
        Self { triangle: triangle as u32, corners: WHOLE }
    }

    /// A point of the part, by the barycentric coordinates of both.
    pub fn point(&self, l: [f64; 3]) -> [f64; 3] {
        std::array::from_fn(|k| (0..3).map(|corner| l[corner] * self.corners[corner][k]).sum())
    }

    /// Area of the part, as a share of the triangle's.
    pub fn area(&self) -> f64 {
        let [a, b, c] = self.corners;
        let [u, v] = [b, c].map(|x| [x[1] - a[1], x[2] - a[2]]);
        (u[0] * v[1] - u[1] * v[0]).abs()
    }
}
