//! Contact boundaries that are placed anew, as wide as both sides are there.

use crate::contact::{CurveChoice, Known};
use crate::geometry::Point;
use crate::petsc::Session;
use crate::system::{BoundaryMotion, Contact, Discretisation, SystemError};

/// The contacts of undeformed bodies, those on the curve of one side from end to end of what both sides face; nothing if none
/// becomes wider.
///
/// Where the sides are drawn nearest may be beside the line of the force: a body that has to tilt before it lies flat falls
/// off a contact that goes no farther. **Collective**
///
/// # Errors
/// [`SystemError::Case`] if a boundary cannot be placed.
pub(super) fn widened(
    problem: &Discretisation,
    session: &Session,
) -> Result<Option<(Vec<Contact>, BoundaryMotion)>, SystemError> {
    let mut is_wider = false;
    let wide = |contact: &Contact| {
        let (known, knots) = (contact.known.clone(), contact.boundary.knots());
        let [first, last] = contact.limits;
        let is_bounded = first.is_finite() && last.is_finite();
        if !matches!(contact.pair.curve, CurveChoice::Own(_))
            || !is_bounded
            || knots[0] <= first && knots[knots.len() - 1] >= last
        {
            return known;
        }
        is_wider = true;
        Known { ends: Some(contact.limits), segments: None, ..known }
    };
    let known: Vec<Known> = problem.contacts.iter().map(wide).collect();
    if !is_wider {
        return Ok(None);
    }
    let space = problem.finest();
    let contacts = Contact::all_again(&problem.scene, &space.numbering, session.rank(), &known, &|_| Point::zeros())?;
    let at_rest = BoundaryMotion::new(&problem.scene, space, &vec![0.0; space.local_unknowns()], session);
    Ok(Some((contacts, at_rest)))
}
