//! A scene as it lies before anything is solved.

use crate::discretisation::{
    Contact, LooseMotion, Scene, Space, SystemError, check_soundness, finest_numbering, free_motion_if_closed, not_held_if_closed,
};
use crate::mesh::Numbering;

/// The mesh of the case with its contacts on bodies at rest.
pub struct AtRest {
    /// Nodes of the level that is solved in.
    pub numbering: Numbering,
    /// The contacts.
    pub contacts: Vec<Contact>,
}

impl AtRest {
    /// Places the contacts and looks at the supports: a scene that is not sound is refused here.
    ///
    /// # Errors
    /// [`SystemError::Case`] if the mesh is too fine, supports contradict each other, a boundary cannot be placed, the
    /// boundaries of a contact do not face each other, two contacts claim the same place, a formula has no finite value, or a
    /// triangle is turned inside out.
    pub fn new(scene: &Scene, rank: usize) -> Result<Self, SystemError> {
        // The space shows whether supports contradict each other.
        let Space { numbering, .. } = Space::new(scene, finest_numbering(scene)?.level, &scene.partition, rank)?;
        let contacts = Contact::all(scene, &numbering, rank)?;
        check_soundness(scene, &numbering, &contacts)?;
        Ok(Self { numbering, contacts })
    }

    /// Words for a body that can move though contact is closed everywhere, of a scene that is on one rank.
    ///
    /// # Errors
    /// [`SystemError::Case`] if a contact cannot be integrated.
    pub fn not_held(&self, scene: &Scene) -> Result<Option<String>, SystemError> {
        not_held_if_closed(scene, &self.numbering, &self.contacts)
    }
    /// A rigid motion that nothing holds though contact is closed everywhere, of a scene that is on one rank.
    ///
    /// # Errors
    /// [`SystemError::Case`] if a contact cannot be integrated.
    pub fn free_motion(&self, scene: &Scene) -> Result<Option<LooseMotion>, SystemError> {
        free_motion_if_closed(scene, &self.numbering, &self.contacts)
    }
}
