//! One contact boundary: one active set after the other, until one stands.

mod carried_set;
mod contact_loop;
mod contact_state;
mod pass;
mod residual_scale;
mod unsettled;

pub use contact_loop::{ContactLoop, LoopOutcome, LoopPosition};
pub use pass::{Pass, relative_change};
