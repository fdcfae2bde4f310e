//! Local element kernels.

/// Polynomial degree of the displacement on a triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Order {
    /// Linear, three nodes.
    P1,
    /// Quadratic, six nodes.
    P2,
}
