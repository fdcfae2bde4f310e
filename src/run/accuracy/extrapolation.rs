//! How the estimates of a goal fall from mesh to mesh, and on how many unknowns it would hold.

use super::goals::{name, told};
use crate::accuracy::{Adaptation, AdaptedMesh};
use crate::output::plot::{Sequence, grouped};
use crate::run::words::rounded_up;

/// So many meshes tell how an error falls.
const LAST: usize = 3;

/// Beyond so many unknowns an extrapolation says no more than that there are more.
const MOST_FORETOLD: f64 = 1e12;

/// The estimates on each mesh as a figure shows them, and the true errors as far as they are known: for each goal that is told.
pub fn sequences(adaptation: &Adaptation) -> Vec<Sequence> {
    told(&adaptation.accuracy, adaptation.meshes.last()).into_iter().map(|place| sequence(adaptation, place)).collect()
}

fn sequence(Adaptation { accuracy, meshes, .. }: &Adaptation, place: usize) -> Sequence {
    let goal = &accuracy.goals[place];
    let points = |of: fn(&AdaptedMesh) -> &[Option<f64>]| {
        meshes.iter().filter_map(|mesh| Some((mesh.unknowns as f64, of(mesh).get(place).copied()??))).collect()
    };
    let (estimates, errors) = (points(|mesh| &mesh.errors), points(|mesh| &mesh.true_errors));
    Sequence { name: name(&goal.quantity), asked: goal.tolerance, estimates, errors }
}

/// Unknowns on which a goal that is missed would hold, if its estimate falls on like `unknowns^-p`, with p from the last three
/// meshes. Nothing if it holds, if one of these meshes does not tell the error, or if it does not fall.
pub fn unknowns_needed(adaptation: &Adaptation, place: usize) -> Option<f64> {
    let Adaptation { accuracy, meshes, .. } = adaptation;
    let last = Adaptation { meshes: meshes[meshes.len().checked_sub(LAST)?..].to_vec(), ..Adaptation::new(accuracy.clone()) };
    let sequence = sequence(&last, place);
    let order = sequence.order().filter(|order| *order > 0.0)?;
    let (unknowns, error) = *sequence.estimates.last()?;
    let excess = error / sequence.asked;
    (excess > 1.0).then(|| unknowns * excess.powf(1.0 / order))
}

/// What a goal that is missed would take: `, which would take some 300 000 unknowns`.
pub fn would_take(adaptation: &Adaptation, place: usize) -> Option<String> {
    let needed = unknowns_needed(adaptation, place)?;
    Some(if needed > MOST_FORETOLD {
        format!(", which would take more than {} unknowns", grouped(MOST_FORETOLD as usize))
    } else {
        format!(", which would take some {} unknowns", grouped(rounded_up(needed).round() as usize))
    })
}
