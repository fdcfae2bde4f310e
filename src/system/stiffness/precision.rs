//! What the cycle works with in double and in single precision: kernels, strips, stored rows.

use super::lanes::Plain;
#[cfg(target_arch = "x86_64")]
use super::lanes::{Double, Single, WideDouble, WideSingle};
use super::lattice_operator::Strips;
use super::stored_rows::StoredRows;
use super::strip_kernel::{StripKernel, kernel};
use super::strips::Couplings;
use crate::system::space::Real;
use std::cell::RefCell;
use std::rc::Rc;

/// A precision to work in. Double precision shares what the matrix has, single precision has copies.
pub trait Precision: Real {
    /// The kernel of some couplings that suits the processor best.
    fn kernel(couplings: &Couplings) -> Box<dyn StripKernel<Self>>;

    /// Strips in this precision.
    fn strips(strips: &Rc<Strips>) -> Rc<Strips<Self>>;

    /// Stored rows in this precision.
    fn stored(rows: &Rc<RefCell<StoredRows>>) -> Rc<RefCell<StoredRows<Self>>>;

    /// Takes over changed values.
    fn refresh(rows: &Rc<RefCell<StoredRows>>, own: &Rc<RefCell<StoredRows<Self>>>);
}

impl Precision for f64 {
    fn kernel(couplings: &Couplings) -> Box<dyn StripKernel<Self>> {
        #[cfg(target_arch = "x86_64")]
        {
            if let Some(simd) = pulp::x86::V4::try_new() {
                return kernel(WideDouble(simd), couplings);
            }
            if let Some(simd) = pulp::x86::V3::try_new() {
                return kernel(Double(simd), couplings);
            }
        }
        kernel(Plain::<f64>::default(), couplings)
    }

    fn strips(strips: &Rc<Strips>) -> Rc<Strips> {
        strips.clone()
    }

    fn stored(rows: &Rc<RefCell<StoredRows>>) -> Rc<RefCell<StoredRows>> {
        rows.clone()
    }

    fn refresh(_: &Rc<RefCell<StoredRows>>, _: &Rc<RefCell<StoredRows>>) {}
}

impl Precision for f32 {
    fn kernel(couplings: &Couplings) -> Box<dyn StripKernel<Self>> {
        #[cfg(target_arch = "x86_64")]
        {
            if let Some(simd) = pulp::x86::V4::try_new() {
                return kernel(WideSingle(simd), couplings);
            }
            if let Some(simd) = pulp::x86::V3::try_new() {
                return kernel(Single(simd), couplings);
            }
        }
        kernel(Plain::<f32>::default(), couplings)
    }

    fn strips(strips: &Rc<Strips>) -> Rc<Strips<f32>> {
        Rc::new(strips.converted())
    }

    fn stored(rows: &Rc<RefCell<StoredRows>>) -> Rc<RefCell<StoredRows<f32>>> {
        Rc::new(RefCell::new(rows.borrow().converted()))
    }

    fn refresh(rows: &Rc<RefCell<StoredRows>>, own: &Rc<RefCell<StoredRows<f32>>>) {
        *own.borrow_mut() = rows.borrow().converted();
    }
}
