//! Which registers suit the processor, in double and in single precision: it is asked at run time.

#[cfg(target_arch = "x86_64")]
use super::lanes::{DoubleLanes, NarrowLanes, SingleLanes, WideDoubleLanes, WideSingleLanes};
use super::lanes::{LaneWork, Lanes, PlainLanes};
use super::row_kernel::OnRows;
use super::strip_kernel::{StripKernel, kernel};
use super::strips::Couplings;
use super::triangle_kernel::{TriangleKernel, triangle_kernel};
use crate::system::space::Real;

/// Numbers, and the kernels that work on them.
pub trait Registers: Real {
    /// The kernel of some couplings that suits the processor best.
    fn strip_kernel(couplings: &Couplings) -> Box<dyn StripKernel<Self>>;

    /// How many even macro triangles of so many that are left suit the processor best, side by side.
    fn side_by_side(left: usize) -> usize;

    /// The kernel of some even macro triangles, as many as [`Registers::side_by_side`] says.
    fn triangle_kernel(couplings: &[&[Couplings]]) -> Box<dyn TriangleKernel<Self>>;

    /// Does work on stored rows.
    fn on_rows(work: OnRows<Self>);
}

/// Work on stored rows with some registers.
struct RowsWith<'a, L: Lanes>(L, OnRows<'a, L::Real>);

impl<T: Real, L: Lanes<Real = T, Nodes = [[T; 2]; 2]>> RowsWith<'_, L> {
    fn run(self) {
        self.0.run(self);
    }
}

impl<T: Real, L: Lanes<Real = T, Nodes = [[T; 2]; 2]>> LaneWork for RowsWith<'_, L> {
    #[inline(always)]
    fn work(self) {
        self.1.work(self.0);
    }
}

impl Registers for f64 {
    fn strip_kernel(couplings: &Couplings) -> Box<dyn StripKernel<Self>> {
        #[cfg(target_arch = "x86_64")]
        {
            if let Some(simd) = pulp::x86::V4::try_new() {
                return kernel(WideDoubleLanes(simd), couplings);
            }
            if let Some(simd) = pulp::x86::V3::try_new() {
                return kernel(DoubleLanes(simd), couplings);
            }
        }
        kernel(PlainLanes::<f64>::default(), couplings)
    }

    fn side_by_side(left: usize) -> usize {
        #[cfg(target_arch = "x86_64")]
        if left > 2 && pulp::x86::V4::try_new().is_some() {
            return left.min(4);
        }
        left.min(2)
    }

    fn triangle_kernel(couplings: &[&[Couplings]]) -> Box<dyn TriangleKernel<Self>> {
        #[cfg(target_arch = "x86_64")]
        {
            if let Some(simd) = pulp::x86::V4::try_new().filter(|_| couplings.len() > 2) {
                return triangle_kernel(WideDoubleLanes(simd), couplings);
            }
            if let Some(simd) = pulp::x86::V3::try_new() {
                return triangle_kernel(DoubleLanes(simd), couplings);
            }
        }
        triangle_kernel(PlainLanes::<f64>::default(), couplings)
    }

    fn on_rows(work: OnRows<f64>) {
        #[cfg(target_arch = "x86_64")]
        if let Some(simd) = pulp::x86::V3::try_new() {
            return RowsWith(DoubleLanes(simd), work).run();
        }
        RowsWith(PlainLanes::default(), work).run();
    }
}

impl Registers for f32 {
    fn strip_kernel(couplings: &Couplings) -> Box<dyn StripKernel<Self>> {
        #[cfg(target_arch = "x86_64")]
        {
            if let Some(simd) = pulp::x86::V4::try_new() {
                return kernel(WideSingleLanes(simd), couplings);
            }
            if let Some(simd) = pulp::x86::V3::try_new() {
                return kernel(SingleLanes(simd), couplings);
            }
        }
        kernel(PlainLanes::<f32>::default(), couplings)
    }

    fn side_by_side(left: usize) -> usize {
        #[cfg(target_arch = "x86_64")]
        {
            if left > 4 && pulp::x86::V4::try_new().is_some() {
                return left.min(8);
            }
            if left > 2 && pulp::x86::V3::try_new().is_some() {
                return left.min(4);
            }
        }
        left.min(2)
    }

    fn triangle_kernel(couplings: &[&[Couplings]]) -> Box<dyn TriangleKernel<Self>> {
        #[cfg(target_arch = "x86_64")]
        {
            if let Some(simd) = pulp::x86::V4::try_new().filter(|_| couplings.len() > 4) {
                return triangle_kernel(WideSingleLanes(simd), couplings);
            }
            if let Some(simd) = pulp::x86::V3::try_new() {
                return match couplings.len() {
                    3.. => triangle_kernel(SingleLanes(simd), couplings),
                    _ => triangle_kernel(NarrowLanes(simd), couplings),
                };
            }
        }
        triangle_kernel(PlainLanes::<f32>::default(), couplings)
    }

    fn on_rows(work: OnRows<f32>) {
        #[cfg(target_arch = "x86_64")]
        if let Some(simd) = pulp::x86::V3::try_new() {
            return RowsWith(NarrowLanes(simd), work).run();
        }
        RowsWith(PlainLanes::default(), work).run();
    }
}
