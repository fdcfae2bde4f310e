//! What the quadratic programme says of a scene that is not solved: whether its loads drive a body off all its contacts.

use crate::accuracy::Accuracy;
use crate::discretisation::{Contact, Scene, SystemError, finest_numbering};
use crate::mesh::Numbering;
use crate::procedure::one_mesh::begun::{MOST_WORK, work_of_programme};
use crate::procedure::one_mesh::meshes::COARSER;
use crate::procedure::one_mesh::wide_contact::{Fineness, WideContact, asked, drawn_contacts, wide_contacts};
use crate::procedure::settings::Procedure;
use crate::programme::{Prediction, Predictor};

impl Procedure<'_> {
    /// Words for a body that the loads drive off all its contacts, of a scene on one rank: by the mesh that a run begins with, or by
    /// a coarser one, so that the programmes of so many `scenes` together are not dear. Nothing if contact holds the bodies, if the
    /// programme has no answer, or if it is dear on every mesh.
    pub fn driven_off(scene: &Scene, accuracy: Option<&Accuracy>, scenes: usize) -> Option<String> {
        for times in COARSER.min(scene.refine)..=scene.refine {
            let mesh = scene.coarser(times);
            // Nothing is said where a contact cannot be placed: it may be on a finer mesh.
            let numbering = finest_numbering(&mesh).ok()?;
            let wide = wide_contacts(&mesh, &numbering, Fineness::Graded).ok()?;
            if work_of_programme(&mesh, numbering.level, &drawn_contacts(&wide)) * scenes as f64 <= MOST_WORK {
                return said_by_programme(&mesh, &numbering, wide, accuracy).ok()?;
            }
        }
        None
    }
}

/// What the programme says on the mesh of a scene.
///
/// # Errors
/// [`SystemError::Case`] if a contact cannot be placed or integrated there.
fn said_by_programme(
    scene: &Scene,
    numbering: &Numbering,
    wide: Vec<WideContact>,
    accuracy: Option<&Accuracy>,
) -> Result<Option<String>, SystemError> {
    let predictor = Predictor::new(scene, numbering)?;
    let predict = |contacts: &[Contact]| predictor.predict(contacts);
    match asked(scene, numbering, wide, accuracy, predict)?.1 {
        Prediction::Driven { words, .. } => Ok(Some(words)),
        Prediction::Held(_) | Prediction::Unknown(_) => Ok(None),
    }
}
