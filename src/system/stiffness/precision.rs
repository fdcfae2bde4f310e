//! What the cycle works with in double and in single precision: kernels, strips, stored rows.

use super::even_triangles::EvenTriangles;
#[cfg(target_arch = "x86_64")]
use super::lanes::{DoubleLanes, NarrowLanes, SingleLanes, WideDoubleLanes, WideSingleLanes};
use super::lanes::{LaneWork, Lanes, PlainLanes};
use super::row_kernel::OnRows;
use super::stored_rows::StoredRows;
use super::strip_kernel::{StripKernel, TriangleKernel, kernel, triangle_kernel};
use super::strip_set::Strips;
use super::strips::Couplings;
use crate::system::space::Real;
use std::cell::RefCell;
use std::rc::Rc;

/// A precision to work in. DoubleLanes precision shares what the matrix has, single precision has copies.
pub trait Precision: Real {
    /// The kernel of some couplings that suits the processor best.
    fn kernel(couplings: &Couplings) -> Box<dyn StripKernel<Self>>;

    /// The kernel of the rows of an even macro triangle that suits the processor best.
    fn triangle_kernel(couplings: &[Couplings]) -> Box<dyn TriangleKernel<Self>>;

    /// Strips in this precision.
    fn strips(strips: &Rc<Strips>) -> Rc<Strips<Self>>;

    /// Even macro triangles in this precision.
    fn even(even: &Rc<EvenTriangles>) -> Rc<EvenTriangles<Self>>;

    /// Stored rows in this precision.
    fn stored(rows: &Rc<RefCell<StoredRows>>) -> Rc<RefCell<StoredRows<Self>>>;

    /// Takes over changed values.
    fn refresh(rows: &Rc<RefCell<StoredRows>>, own: &Rc<RefCell<StoredRows<Self>>>);

    /// Does work on stored rows.
    fn on_rows(work: OnRows<Self>);

    /// Does work on a right-hand side and a solution in double precision; `own` holds them in this one, if need be.
    fn on<R>(
        b: &[[f64; 2]],
        x: &mut [[f64; 2]],
        own: &mut [Vec<[Self; 2]>; 2],
        work: impl FnOnce(&[[Self; 2]], &mut [[Self; 2]]) -> R,
    ) -> R;
}

/// LaneWork on stored rows with some registers.
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

impl Precision for f64 {
    fn kernel(couplings: &Couplings) -> Box<dyn StripKernel<Self>> {
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

    fn triangle_kernel(couplings: &[Couplings]) -> Box<dyn TriangleKernel<Self>> {
        #[cfg(target_arch = "x86_64")]
        {
            if let Some(simd) = pulp::x86::V4::try_new() {
                return triangle_kernel(WideDoubleLanes(simd), couplings);
            }
            if let Some(simd) = pulp::x86::V3::try_new() {
                return triangle_kernel(DoubleLanes(simd), couplings);
            }
        }
        triangle_kernel(PlainLanes::<f64>::default(), couplings)
    }

    fn even(even: &Rc<EvenTriangles>) -> Rc<EvenTriangles> {
        even.clone()
    }

    fn strips(strips: &Rc<Strips>) -> Rc<Strips> {
        strips.clone()
    }

    fn stored(rows: &Rc<RefCell<StoredRows>>) -> Rc<RefCell<StoredRows>> {
        rows.clone()
    }

    fn refresh(_: &Rc<RefCell<StoredRows>>, _: &Rc<RefCell<StoredRows>>) {}

    fn on_rows(work: OnRows<f64>) {
        #[cfg(target_arch = "x86_64")]
        if let Some(simd) = pulp::x86::V3::try_new() {
            return RowsWith(DoubleLanes(simd), work).run();
        }
        RowsWith(PlainLanes::default(), work).run();
    }

    fn on<R>(
        b: &[[f64; 2]],
        x: &mut [[f64; 2]],
        _: &mut [Vec<[f64; 2]>; 2],
        work: impl FnOnce(&[[f64; 2]], &mut [[f64; 2]]) -> R,
    ) -> R {
        work(b, x)
    }
}

impl Precision for f32 {
    fn kernel(couplings: &Couplings) -> Box<dyn StripKernel<Self>> {
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

    fn triangle_kernel(couplings: &[Couplings]) -> Box<dyn TriangleKernel<Self>> {
        #[cfg(target_arch = "x86_64")]
        {
            if let Some(simd) = pulp::x86::V4::try_new() {
                return triangle_kernel(WideSingleLanes(simd), couplings);
            }
            if let Some(simd) = pulp::x86::V3::try_new() {
                return triangle_kernel(SingleLanes(simd), couplings);
            }
        }
        triangle_kernel(PlainLanes::<f32>::default(), couplings)
    }

    fn even(even: &Rc<EvenTriangles>) -> Rc<EvenTriangles<f32>> {
        let kernels = even.couplings.iter().map(|couplings| f32::triangle_kernel(couplings)).collect();
        Rc::new(EvenTriangles::new(even.n, even.couplings.clone(), Rc::new(kernels), even.triangles.clone()))
    }

    fn strips(strips: &Rc<Strips>) -> Rc<Strips<f32>> {
        Rc::new(Strips {
            kernels: strips.couplings.iter().map(f32::kernel).collect(),
            couplings: strips.couplings.clone(),
            nodes: strips.nodes.clone(),
            alike: strips.alike.clone(),
            triangles: strips.triangles.clone(),
        })
    }

    fn stored(rows: &Rc<RefCell<StoredRows>>) -> Rc<RefCell<StoredRows<f32>>> {
        Rc::new(RefCell::new(rows.borrow().converted()))
    }

    fn refresh(rows: &Rc<RefCell<StoredRows>>, own: &Rc<RefCell<StoredRows<f32>>>) {
        *own.borrow_mut() = rows.borrow().converted();
    }

    fn on_rows(work: OnRows<f32>) {
        #[cfg(target_arch = "x86_64")]
        if let Some(simd) = pulp::x86::V3::try_new() {
            return RowsWith(NarrowLanes(simd), work).run();
        }
        RowsWith(PlainLanes::default(), work).run();
    }

    fn on<R>(
        b: &[[f64; 2]],
        x: &mut [[f64; 2]],
        [own_b, own_x]: &mut [Vec<[f32; 2]>; 2],
        work: impl FnOnce(&[[f32; 2]], &mut [[f32; 2]]) -> R,
    ) -> R {
        own_b.clear();
        own_b.extend(b.iter().map(|node| node.map(|v| v as f32)));
        own_x.resize(x.len(), [0.0; 2]);
        let outcome = work(own_b, own_x);
        x.iter_mut().zip(own_x).for_each(|(to, from)| *to = from.map(f64::from));
        outcome
    }
}
