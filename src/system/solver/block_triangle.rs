//! The preconditioner of the whole system, without the copies of its parts that PETSc's fieldsplit makes.

use crate::multigrid::Cycle;
use crate::petsc::{Action, Krylov, Matrix, Result, Vector, Window};
use crate::system::saddle_point::{BorderBlocks, BorderUnknown, SaddlePoint};
use std::cell::RefCell;
use std::rc::Rc;

/// The inverse of the upper triangle `[A B; 0 S]`, with the cycle for the inverse of `A` and PETSc's solver of the lower field for that of
/// `S`. This is what fieldsplit does with the same parts. Rigid motions that are unknown belong to the upper field: the cycle finds
/// those that it is told of.
pub struct BlockTriangle {
    cycle: Rc<RefCell<Cycle>>,
    /// Rigid motions, and multipliers of means, that the cycle has been told of.
    told: RefCell<Vec<BorderUnknown>>,
    border: Option<Rc<RefCell<BorderBlocks>>>,
    lower: Krylov,
    coupling: Matrix,
    room: RefCell<Room>,
}

/// What shows matrices of PETSc's parts of vectors, and room for right-hand sides.
struct Room {
    upper: Window,
    lower: [Window; 2],
    force: Vec<f64>,
    minus: Vec<f64>,
}

impl BlockTriangle {
    /// From the solver of the lower field and the coupling `B` of a system. **Collective**
    pub fn new(cycle: &Rc<RefCell<Cycle>>, lower: Krylov, system: &SaddlePoint) -> Result<Rc<Self>> {
        let SaddlePoint { session, multipliers, border, .. } = system;
        let (rows, columns) = multipliers.transpose.local_size();
        let room = Room {
            upper: Window::new(session, rows)?,
            lower: [Window::new(session, columns)?, Window::new(session, columns)?],
            force: vec![0.0; rows],
            minus: vec![0.0; columns],
        };
        let (cycle, border, coupling) = (cycle.clone(), border.clone(), multipliers.transpose.share()?);
        Ok(Rc::new(Self { cycle, told: RefCell::new(Vec::new()), border, lower, coupling, room: RefCell::new(room) }))
    }

    /// Tells the cycle of unknowns of the border, those of before no longer. **Collective**
    pub fn tell(&self, border: &BorderBlocks, unknowns: Vec<BorderUnknown>) {
        self.cycle.borrow_mut().set_border(border.for_cycle(&unknowns));
        self.told.replace(unknowns);
    }
}

impl Action for Rc<BlockTriangle> {
    fn apply(&self, x: &Vector, y: &mut Vector) -> Result<()> {
        let (x, mut y) = (x.values(), y.values_mut());
        let Room { upper, lower: [right, left], force, minus } = &mut *self.room.borrow_mut();
        let ((f, g), (u, lambda)) = (x.split_at(force.len()), y.split_at_mut(force.len()));
        right.read(g, |g| left.write(lambda, |lambda| self.lower.apply(g, lambda)))?;
        minus.iter_mut().zip(&*lambda).for_each(|(minus, lambda)| *minus = -lambda);
        force.copy_from_slice(f);
        right.read(minus, |minus| upper.write(force, |force| self.coupling.multiply_add(minus, force)))?;
        let told = self.told.borrow();
        let border = self.border.as_ref().filter(|_| !told.is_empty());
        let g = border.map_or_else(Vec::new, |border| border.borrow().balances(&told, minus));
        self.cycle.borrow_mut().apply(force, &g, u);
        Ok(())
    }
}
