//! Lines between two axes: quantities along the contact boundary, and diagrams of meshes, load steps and runs.

mod accuracy;
mod along;
mod blocks;
mod diagram;
mod named;
mod steps;

pub use accuracy::{Sequence, write_accuracy};
pub use along::{DrawnContact, write_along};
pub use blocks::{DiagramBlock, diagrams};
pub use diagram::{Diagram, DiagramLine, Mark};
pub use named::named_diagrams;
pub use steps::write_step_figure;
