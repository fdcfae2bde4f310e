//! Case and mesh read and brought together: names resolved, and what cannot be solved refused.

pub(crate) mod input;
pub(crate) mod known;
pub(crate) mod means;
pub(crate) mod names;
pub(crate) mod scene;

pub use input::read_case;
pub use known::{check_pressures, has_values};
