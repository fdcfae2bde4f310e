//! Which registers suit the processor: it is asked at run time.

use super::couplings::Couplings;
#[cfg(target_arch = "x86_64")]
use super::lanes::{Avx2Lanes, Avx512Lanes};
use super::lanes::{LaneWork, Lanes, PlainLanes};
use super::row_kernel::RowWork;
use super::triangle_kernel::{TriangleKernel, triangle_kernel};

/// Work on stored rows with some registers.
struct RowsWith<L: Lanes, W: RowWork>(L, W);

impl<L: Lanes<Nodes = [[f64; 2]; 2]>, W: RowWork> RowsWith<L, W> {
    fn run(self) {
        self.0.run(self);
    }
}

impl<L: Lanes<Nodes = [[f64; 2]; 2]>, W: RowWork> LaneWork for RowsWith<L, W> {
    #[inline(always)]
    fn work(self) {
        self.1.work(self.0);
    }
}

/// How many even macro triangles of so many that are left suit the processor best, side by side.
pub fn side_by_side(left: usize) -> usize {
    #[cfg(target_arch = "x86_64")]
    if left > 2 && pulp::x86::V4::try_new().is_some() {
        return left.min(4);
    }
    left.min(2)
}

/// The kernel of some even macro triangles, as many as [`side_by_side`] says.
pub fn triangles_kernel(couplings: &[&[Couplings]]) -> Box<dyn TriangleKernel> {
    #[cfg(target_arch = "x86_64")]
    {
        if let Some(simd) = pulp::x86::V4::try_new().filter(|_| couplings.len() > 2) {
            return triangle_kernel(Avx512Lanes(simd), couplings);
        }
        if let Some(simd) = pulp::x86::V3::try_new() {
            return triangle_kernel(Avx2Lanes(simd), couplings);
        }
    }
    triangle_kernel(PlainLanes, couplings)
}

/// Does work on stored rows.
pub fn on_rows(work: impl RowWork) {
    #[cfg(target_arch = "x86_64")]
    if let Some(simd) = pulp::x86::V3::try_new() {
        return RowsWith(Avx2Lanes(simd), work).run();
    }
    RowsWith(PlainLanes, work).run();
}
