//! What the quadratic programme says of a scene that is not solved: whether its loads drive a body off all its contacts.

use crate::accuracy::{Accuracy, share_of_nothing};
use crate::discretisation::{Contact, Scene, SystemError, finest_numbering};
use crate::geometry::Point;
use crate::mesh::{EdgeNode, Numbering};
use crate::procedure::one_mesh::begun::{MOST_WORK, work_of_programme};
use crate::procedure::one_mesh::meshes::COARSER;
use crate::procedure::one_mesh::wide_contact::{Fineness, WideContact, as_drawn, drawn_contacts, largest_force, wide_contacts};
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
    mut wide: Vec<WideContact>,
    accuracy: Option<&Accuracy>,
) -> Result<Option<String>, SystemError> {
    let predictor = Predictor::new(scene, numbering)?;
    let mut answer = predictor.predict(&drawn_contacts(&wide))?;
    if matches!(answer, Prediction::Driven { .. }) {
        // As a run does.
        wide = wide_contacts(scene, numbering, Fineness::Fine)?;
        answer = predictor.predict(&drawn_contacts(&wide))?;
    }
    let pressures = match answer {
        Prediction::Held { pressures, .. } => pressures,
        Prediction::Driven { words, .. } => return Ok(Some(words)),
        Prediction::Unknown(_) => return Ok(None),
    };
    let least = share_of_nothing(accuracy) * largest_force(&wide, &pressures);
    let Some(known) = as_drawn(&wide, &pressures, least) else { return Ok(None) };
    let contacts = Contact::all_again(scene, numbering, 0, &known, &|_: EdgeNode| Point::zeros())?;
    Ok(match predictor.predict(&contacts)? {
        Prediction::Driven { words, turns: true } => Some(words),
        _ => None,
    })
}
