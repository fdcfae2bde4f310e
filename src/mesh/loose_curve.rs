//! Physical curves that bound no body.

use crate::geometry::Point;

/// A physical curve without triangles: no line of it lies between nodes that triangles have. It may be drawn for a rigid tool.
#[derive(Clone, Debug, PartialEq)]
pub struct LooseCurve {
    /// Name in the mesh file.
    pub name: String,
    /// Ends of its lines, in the order of the file.
    pub lines: Vec<[Point; 2]>,
}
