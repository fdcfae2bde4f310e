//! Estimated errors: of energies, forces, pressures and ends of contact, from solutions on successive refinements, and what
//! each goal is sensitive to.

mod decay;
mod difference;
mod duals;
mod end_estimate;
mod energy_norm;
mod estimate;
mod value_estimate;
mod zone_estimate;

pub use difference::Difference;
pub(crate) use duals::{Duals, weighted};
pub(crate) use energy_norm::{energy_apart, share_left};
pub(crate) use estimate::AtEnds;
pub use estimate::Estimate;
pub use zone_estimate::{ZoneDifference, ZoneEstimate};
