//! The next mesh of a sequence that is adapted to an accuracy: which macro triangles are bisected, and how often.

mod across;
mod by_forces;
mod foreseen;
mod marking;
mod mesh_sequence;

pub(crate) use by_forces::LoadedPlace;
pub(crate) use foreseen::{Indicators, LocalIndicator};
pub(crate) use mesh_sequence::MeshSequence;
