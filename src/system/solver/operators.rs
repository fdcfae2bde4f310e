//! What a linear solver works on: the operator and the matrix it preconditions by, and the steps between auxiliary levels.

use super::preconditioning::Preconditioning;
use crate::discretisation::SystemError;
use crate::multigrid::Interpolation;
use crate::petsc::{Krylov, Matrix, Session};
use crate::system::saddle_point::SaddlePoint;

/// The product of the nest and the nest, or for a factor the one with all rows stored. **Collective**
pub(super) fn set_operators(
    krylov: &Krylov,
    system: &SaddlePoint,
    preconditioning: Preconditioning,
    session: &Session,
) -> Result<(), SystemError> {
    let stored = if preconditioning == Preconditioning::Factor { system.stored_nest(session)? } else { None };
    match &stored {
        Some(nest) => krylov.set_operators(if system.border.is_some() { &system.product } else { nest }, nest)?,
        None => krylov.set_operators(&system.product, &system.nest)?,
    }
    Ok(())
}

/// The nest converted, of which a factor is made, and as the operator the same or, with rigid motions beside it, its product.
/// **Collective**
pub(super) fn set_plain_operators(krylov: &Krylov, system: &SaddlePoint) -> Result<(), SystemError> {
    let mut converted = system.nest.convert_aij()?;
    converted.set_symmetric(true)?;
    Ok(krylov.set_operators(if system.border.is_some() { &system.product } else { &converted }, &converted)?)
}

/// Those interpolations that lead to auxiliary levels, or up from them.
pub(super) fn below<'a>(interpolations: &'a [Interpolation], system: &SaddlePoint) -> Vec<&'a Matrix> {
    interpolations[..interpolations.len() + 1 - system.stiffness.len()].iter().map(|step| &step.matrix).collect()
}
