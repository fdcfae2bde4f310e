//! Macro meshes made of others: bisected, or with a vertex at a point that the case names.

mod bisection;
mod cells;
mod connected;
mod insertion;
mod origin;

pub use bisection::BisectedMesh;
pub use cells::Cells;
pub use origin::Origin;
