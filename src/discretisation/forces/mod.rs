//! Forces at the nodes: of the loads, of stresses in the bodies, of springs, and of what holds mean motions.

mod internal_forces;
mod nodal_force;
mod springs;

pub use internal_forces::{internal_forces, local_strain_energy};
pub use nodal_force::{load, nodal_forces};
pub use springs::SpringForces;
