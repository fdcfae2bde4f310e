//! What may be wrong with a mesh: overlaps, slits, bodies in pieces.

mod overlap;
mod pieces;
mod slit;

pub use slit::Slit;
