//! Levels of refinement: the triangles over a macro triangle, the numbers of all nodes, and how much work they are.

mod edge_trace;
mod grading;
mod hierarchy;
mod numbering;
mod work;

pub use edge_trace::{BoundaryEdge, EdgeNode};
pub use hierarchy::Shapes;
pub use numbering::{Level, Numbering, TriangleNumbers, levels};
