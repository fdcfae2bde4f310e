//! What a rung of the ladder works with, once it is set up.

use super::bordered::Bordered;
use crate::multigrid::{Cycle, GalerkinLevels};
use crate::petsc::{Krylov, ReplacedAction};
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
