//! Contacts of a scene on their ranks: each placed and cut, with the edges of this rank, and coupled to its two bodies.

mod boundary_motion;
mod contact;
mod contact_pressure;
mod coupling;
mod reach;
mod side_materials;
mod soundness;

pub use boundary_motion::BoundaryMotion;
pub use contact::Contact;
pub use contact_pressure::ContactPressure;
pub use coupling::{Coupled, Coupling, bilateral, coupled_here};
pub use reach::{beside, widest};
pub use soundness::{check_soundness, refused_contacts};
