//! What came of a linear solve.

/// How a linear solve ended.
#[derive(Clone, Debug, PartialEq)]
pub enum LinearEnding {
    /// The tolerance is reached.
    Converged,
    /// Rounding allows no smaller residual.
    Rounding {
        /// The relative residual.
        residual: f64,
        /// What was asked for.
        tolerance: f64,
    },
    /// The residual stays too large.
    Failed {
        /// Why the solver gave up.
        reason: String,
        /// Krylov iterations.
        iterations: usize,
        /// The relative residual.
        residual: f64,
    },
}

/// A linear solve in figures.
#[derive(Clone, Debug, PartialEq)]
pub struct LinearSolve {
    /// How it ended.
    pub ending: LinearEnding,
    /// Krylov iterations.
    pub iterations: usize,
    /// True residual of the augmented system, relative to the right-hand side.
    pub residual: f64,
    /// The method or the stronger preconditioner that it, or the next one, went over to; in words.
    pub fallback: Option<String>,
}

/// Norm of a residual, and that of the right-hand side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Residual {
    /// `|b - A x|`.
    pub norm: f64,
    /// `|b|`.
    pub whole: f64,
}

impl Residual {
    /// One relative to the other; zero without any right-hand side.
    pub fn relative(self) -> f64 {
        if self.whole > 0.0 { self.norm / self.whole } else { 0.0 }
    }
}
