//! Boundaries of contacts as they are drawn: whether they face each other, how far apart, claim one place twice, or lie close without
//! a contact.

mod claim;
mod closeness;
mod drawing_check;
mod facing;
mod gap;

pub use closeness::{ClosePair, CloseSide, WIDEST_TURN, close_pairs, close_sides};
pub use facing::Facing;
pub use gap::{DrawnGap, drawn_gap};
