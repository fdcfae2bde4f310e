//! What the cycle works with in double and in single precision: strips, even macro triangles, stored rows.

use super::even_triangles::EvenTriangles;
use super::registers::Registers;
use super::stored_rows::StoredRows;
use super::strip_set::Strips;
use std::cell::RefCell;
use std::rc::Rc;

/// A precision to work in. Double precision shares what the matrix has, single precision has copies.
pub trait Precision: Registers {
    /// Strips in this precision.
    fn strips(strips: &Rc<Strips>) -> Rc<Strips<Self>>;

    /// Even macro triangles in this precision.
    fn even(even: &Rc<EvenTriangles>) -> Rc<EvenTriangles<Self>>;

    /// Stored rows in this precision.
    fn stored(rows: &Rc<RefCell<StoredRows>>) -> Rc<RefCell<StoredRows<Self>>>;

    /// Takes over changed values.
    fn refresh(rows: &Rc<RefCell<StoredRows>>, own: &Rc<RefCell<StoredRows<Self>>>);

    /// Does work on a right-hand side and a solution in double precision; `own` holds them in this one, if need be.
    fn on<R>(
        b: &[[f64; 2]],
        x: &mut [[f64; 2]],
        own: &mut [Vec<[Self; 2]>; 2],
        work: impl FnOnce(&[[Self; 2]], &mut [[Self; 2]]) -> R,
    ) -> R;
}

impl Precision for f64 {
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
    fn even(even: &Rc<EvenTriangles>) -> Rc<EvenTriangles<f32>> {
        Rc::new(EvenTriangles::new(even.n, even.couplings.clone(), even.triangles.clone()))
    }

    fn strips(strips: &Rc<Strips>) -> Rc<Strips<f32>> {
        Rc::new(Strips {
            kernels: strips.couplings.iter().map(f32::strip_kernel).collect(),
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
