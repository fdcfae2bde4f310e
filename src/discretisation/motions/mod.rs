//! Rigid motions of the bodies: which of them supports and contact hold, what drives one that is free, and what each body or
//! tool has moved by once a solution is found.

mod free_motion;
mod freedom;
mod held;
mod held_load;
mod mean_force;
mod rigid_motion;
mod rigid_start;

pub use freedom::Freedom;
pub use held::{LooseMotion, adrift, few_that_hold, free_motion_if_closed, needed_contacts, not_held, not_held_if_closed};
pub use held_load::{HeldLoad, forces_without_holds};
pub use rigid_motion::{rigid_motions, settle};
pub use rigid_start::rigid_start;
