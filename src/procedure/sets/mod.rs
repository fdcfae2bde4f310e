//! One contact boundary: one active set after the other, until one stands.

mod contact_loop;
mod contact_state;
mod first_set;
mod pass;
mod residual_scale;
mod unsettled;

pub use contact_loop::{ContactLoop, LoopOutcome, LoopPosition};
pub use pass::{Pass, relative_change};
