//! One mesh: its coarser refinements first, then one contact boundary after the other on each of them.

mod begun;
mod boundaries;
mod foretold;
mod meshes;
mod wide_contact;

pub use boundaries::OneMesh;
