//! Local kernels: shape functions, stiffness, loads. They return values; callers insert them.

pub mod block;
mod load;
mod map;
mod measure;
mod nodal_stress;
mod plane_law;
mod revolution;
mod shape;
mod stiffness;

pub use block::{Block, times};
pub use load::{edge_load, heat_load, triangle_load};
pub use map::{BadJacobian, jacobian, place_of};
pub use measure::{MEASURE_NAMES, MEASURES, StressMeasure};
pub use nodal_stress::{corner_slopes, nodal_stresses, straight_stresses};
pub use plane_law::{Heat, Plane, PlaneLaw, Strain, von_mises};
pub use shape::{edge_shape, edge_slope, shape, slopes};
pub use stiffness::{
    Rule, SIX_POINTS, check_map, energies, heated_stress, internal_forces, six_points, stiffness, strain, stress,
};

/// A function of triangles with as many nodes as an order has, called for it: `by_order!(order, f(x))` is `f::<3>(x)` for P1, and
/// `f::<6>(x)` for P2.
macro_rules! by_order {
    ($order:expr, $function:ident($($argument:expr),* $(,)?)) => {
        match $order {
            $crate::element::Order::P1 => $function::<3>($($argument),*),
            $crate::element::Order::P2 => $function::<6>($($argument),*),
        }
    };
}
pub(crate) use by_order;

/// Polynomial degree of the displacement on a triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Order {
    /// Linear, three nodes.
    P1,
    /// Quadratic, six nodes.
    P2,
}

impl Order {
    /// Degree of the polynomials: lattice intervals per triangle edge.
    pub fn degree(self) -> usize {
        match self {
            Self::P1 => 1,
            Self::P2 => 2,
        }
    }
}
