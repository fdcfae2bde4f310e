//! A scene cut into unknowns: spaces of all levels, contacts, couplings.

use super::{Contact, Coupling, Scene, Space, SystemError};
use crate::contact::Jump;
use crate::mesh::levels;
use crate::petsc::Session;

/// Everything that a system is assembled from.
pub struct Discretisation {
    /// The physics.
    pub scene: Scene,
    /// Displacement spaces, coarsest first: the macro mesh with P1.
    pub spaces: Vec<Space>,
    /// The contacts, on the finest level.
    pub contacts: Vec<Contact>,
    /// Their couplings.
    pub coupling: Coupling,
}

impl Discretisation {
    /// Couples the contacts of a scene whose spaces are at hand. **Collective**
    ///
    /// # Errors
    /// [`SystemError::Case`] if a contact boundary cannot be placed or measured.
    pub fn new(scene: Scene, spaces: Vec<Space>, session: &Session) -> Result<Self, SystemError> {
        let finest = &spaces[spaces.len() - 1];
        let contacts = Contact::all(&scene, &finest.numbering, session.rank())?;
        let coupling = Coupling::new(&scene, &contacts, session)?;
        Ok(Self { scene, spaces, contacts, coupling })
    }

    /// Space of the finest level: the one that is solved in.
    pub fn finest(&self) -> &Space {
        &self.spaces[self.spaces.len() - 1]
    }

    /// The contact of a multiplier.
    pub fn contact_of(&self, multiplier: usize) -> &Contact {
        let at = self.contacts.partition_point(|contact| contact.first <= multiplier);
        &self.contacts[at - 1]
    }

    /// The jump terms of all contacts.
    pub fn jumps(&self) -> impl Iterator<Item = &Jump> {
        self.contacts.iter().flat_map(|contact| &contact.jumps)
    }

    /// Number of displacement unknowns of all ranks.
    pub fn unknown_count(&self) -> usize {
        2 * self.finest().numbering.node_count()
    }

    /// Number of multipliers of all contacts.
    pub fn multiplier_count(&self) -> usize {
        self.coupling.gap.len()
    }
}

/// Spaces of all levels that multigrid uses, coarsest first.
///
/// # Errors
/// [`SystemError::Case`] if supports contradict each other.
pub fn spaces(scene: &Scene, rank: usize) -> Result<Vec<Space>, SystemError> {
    levels(scene.order, scene.refine).into_iter().map(|level| Space::new(scene, level, rank)).collect()
}
