//! The two forms of the saddle point.

/// Whether the system is augmented.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// With the augmentation, for the iterative solver.
    Augmented,
    /// Without, for the direct solver.
    Plain,
}
