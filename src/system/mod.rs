//! The saddle-point system: it alone builds matrices and solvers.
//!
//! A [`Scene`] becomes a [`Discretisation`]: [`Space`]s (one per multigrid level), [`Contact`]s and their [`Coupling`].
//! From it come the blocks of the [`SaddlePoint`], a [`LinearSolver`] for them, and the [`ContactLoop`] over active
//! sets. What the solution means on the bodies is in [`recovery`].

mod auxiliary;
mod boundary_motion;
mod contact;
mod coupling;
mod discretisation;
mod field;
mod interpolation;
mod nodal_force;
mod outer_loop;
pub mod recovery;
mod saddle_point;
mod scene;
mod solver;
mod space;
pub mod stiffness;

pub use boundary_motion::BoundaryMotion;
pub use contact::Contact;
pub use coupling::{Coupled, Coupling, bilateral};
pub use discretisation::{Discretisation, spaces};
pub use field::Field;
pub use interpolation::interpolations;
pub use nodal_force::{load, nodal_forces};
pub use outer_loop::{
    BoundaryStep, CoarseSolution, ContactLoop, Difference, Estimate, Following, Onward, OuterStep, Solution, Start, Verdict,
    ZoneEstimate, carried, few_that_hold, is_needed, not_held, not_held_if_closed, rigid_start, stands,
};
pub use saddle_point::{CouplingRows, Form, MultiplierBlocks, SaddlePoint, SchurPattern};
pub use scene::Scene;
pub use solver::{Ending, LinearSolve, LinearSolver, Rung, inf_sup};
pub use space::Space;
pub use stiffness::Elastic;

use crate::body::SupportError;
use crate::contact::PlacingError;
use crate::element::BadJacobian;
use crate::petsc;

/// Which linear solver the case asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SolverChoice {
    /// The field split.
    Auto,
    /// Block preconditioner and Krylov iteration.
    FieldSplit,
    /// Sparse factorisation of the whole system.
    Direct,
}

impl SolverChoice {
    /// Name of the solver that is used.
    pub fn name(self) -> &'static str {
        match self {
            Self::Auto | Self::FieldSplit => "fieldsplit",
            Self::Direct => "direct",
        }
    }
}

/// How far a system is solved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Tolerance {
    /// To this relative residual.
    Residual(f64),
    /// Until the algebraic error is a tenth of the discretisation error.
    Discretisation,
}

impl Tolerance {
    /// Relative residual of solves that nothing is known of beforehand.
    pub fn residual(self) -> f64 {
        match self {
            Self::Residual(residual) => residual,
            Self::Discretisation => 1e-6,
        }
    }
}

/// Why a system cannot be set up or solved.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SystemError {
    /// The case asks for something that cannot be; in words.
    #[error("{0}")]
    Case(String),
    /// PETSc or MPI failed.
    #[error(transparent)]
    Petsc(#[from] petsc::Error),
}

impl From<BadJacobian> for SystemError {
    fn from(error: BadJacobian) -> Self {
        Self::Case(format!("mesh: {error}; refine the mesh along the curved boundary, or correct its [geometry]"))
    }
}

impl From<PlacingError> for SystemError {
    fn from(error: PlacingError) -> Self {
        Self::Case(error.to_string())
    }
}

impl From<SupportError> for SystemError {
    fn from(error: SupportError) -> Self {
        Self::Case(error.0)
    }
}
