//! What a pressure on Γ_C says of itself: its zones, ends, peaks, and how rough it is.

mod ends;
mod fading;
mod oscillation;
mod peak;
mod reconstruction;
mod zones;

pub use ends::true_end;
pub use fading::faded_end;
pub use oscillation::oscillation;
pub use peak::recovered_peak;
pub use reconstruction::{Roughness, roughness};
pub use zones::{Zone, zone_counts};
