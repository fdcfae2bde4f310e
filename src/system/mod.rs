//! The saddle-point system.

/// Which linear solver the case asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SolverChoice {
    /// Direct for small systems, field split else.
    Auto,
    /// Block preconditioner and Krylov iteration.
    FieldSplit,
    /// Sparse factorisation.
    Direct,
}
