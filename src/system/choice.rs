//! What a case asks of the solver.

use crate::discretisation::Form;

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
    /// Whether the system is augmented for this solver.
    pub fn form(self) -> Form {
        match self {
            Self::Auto | Self::FieldSplit => Form::Augmented,
            Self::Direct => Form::Plain,
        }
    }

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
