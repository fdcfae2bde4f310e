//! What a rung of the ladder works with, once it is set up, and what its solver works on: the operator and the matrix it
//! preconditions by.

use super::bordered::Bordered;
use super::preconditioning::Preconditioning;
use crate::discretisation::SystemError;
use crate::multigrid::{Cycle, GalerkinLevels};
use crate::petsc::{Krylov, ReplacedAction};
use crate::system::saddle_point::SaddlePoint;
use std::cell::RefCell;
use std::rc::Rc;

/// A Krylov method with its preconditioner, set up for the blocks of one active set.
pub struct Prepared {
    pub krylov: Krylov,
    /// What does the work of PETSc's fieldsplit, where no option asks for more, or stands around its preconditioner.
    pub _replaced: Option<ReplacedAction>,
    /// What knows of rigid motions that are eliminated, if there are any.
    pub bordered: Option<Rc<Bordered>>,
    /// Auxiliary levels and the cycle, if it is that which preconditions the displacements.
    pub levels: Option<(GalerkinLevels, Rc<RefCell<Cycle>>)>,
    /// The solver and its preconditioning, in words.
    pub name: String,
}

/// The product of the nest and the nest, or for a factor the one with all rows stored. **Collective**
pub(super) fn set_operators(krylov: &Krylov, system: &SaddlePoint, preconditioning: Preconditioning) -> Result<(), SystemError> {
    let stored = if preconditioning == Preconditioning::Factor { system.stored_nest()? } else { None };
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
