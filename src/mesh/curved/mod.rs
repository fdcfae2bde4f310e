//! Curved boundaries: true shapes of edges, and the smooth map of a macro triangle that follows them.

mod boundary_vertex;
mod bow;
mod midside;
mod mirror;
mod shape;
mod smooth_normal;
mod spline_shape;

pub use boundary_vertex::BoundaryVertex;
pub use smooth_normal::{SmoothNormals, SmoothPoint};
pub use spline_shape::Corner;
