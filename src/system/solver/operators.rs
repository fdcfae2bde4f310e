//! What a linear solver works on: the operator and the matrix it preconditions by.

use super::preconditioning::Preconditioning;
use crate::discretisation::SystemError;
use crate::petsc::{Krylov, Session};
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
