//! A preconditioner of the blocks of sets at rest, made one of the system from which rigid motions are eliminated.
//!
//! Beside the preconditioner `P` of the blocks stands the border of [`BorderBlocks`]:
//!
//! ```text
//! [ P   V ] [y]   [x]        y = P⁻¹ x - Z p,   p = -Σ⁻¹ Wᵀ P⁻¹ x
//! [ Wᵀ  E ] [p] = [0]        Z = P⁻¹ V,         Σ = E - Wᵀ Z - Zᵀ (V - A Z)
//! ```
//! `V` is without its gaps where `P` is a block triangle: motions are displacements, which it eliminates before the multipliers.
//! The last term of `Σ` makes its error that of `Z` squared. Held means that contact hardly resists are left out: a system with them
//! is that of the blocks. More than a few motions and means the cycle of a block triangle finds with the displacements instead
//! (`multigrid/cycle/border.rs`).

use super::block_triangle::BlockTriangle;
use crate::discretisation::Form;
use crate::multigrid::scaled_inverse;
use crate::petsc::{Action, Result, Vector};
use crate::system::saddle_point::{BorderBlocks, BorderUnknown, SaddlePoint};
use nalgebra::{DMatrix, DVector};
use std::cell::{Cell, RefCell};
use std::rc::Rc;

/// Stiffness that contact lends a held mean, relative to that of the body itself, from which `P` has to be told. Ten rollers between
/// two plates whose shifts and turns are held, at up to half of it: 10 iterations instead of 7.
const RESISTED: f64 = 1.0;

/// Held means that it is told of at most: each takes two vectors, and two cycles or more for an active set. The others cost
/// iterations: of the ten rollers, when contact resists their vertical shifts, too, 20 instead of 8.
const MOST_HELD: usize = 8;

/// Unknowns up to which they are found here, beside a cycle that could find them: each takes a vector and two cycles or more for an
/// active set, inside the cycle all together some iterations. Rigid tools and plates that carry a force, `round_hertz` and `wheels`:
/// 12 and 13 iterations instead of 15 and 16, in as much time.
const FEW: usize = 2;

/// The same stiffness as `RESISTED`, of held means that are found in the cycle. Two assemblies of 20 and 25 bodies that are not round
/// (all cycles of a run): 68 and 97 at 1e-3; 81 and 101 at 1e-2; 270 and 123 at 1e-1.
const RESISTED_INSIDE: f64 = 1e-2;

/// Unknowns that are found in the cycle at most; of more, none: their Schur complement is dense, and its inverse
/// takes 7 ms of 128, 68 of 256, and 1.2 s of 512 of them, for every set.
const MOST_INSIDE: usize = 128;

/// Cycles for a column of `Z`, at most, and the relative residual that is enough.
const MOST_CYCLES: usize = 4;
const ENOUGH: f64 = 0.1;

/// The same of a factor of the whole system, which has it for one solve with its triangles.
const EXACT: f64 = 1e-6;

/// The preconditioner, for one active set at a time.
pub struct Bordered {
    of_blocks: Box<dyn Action>,
    /// The same, if it is one whose cycle can find motions.
    triangle: Option<Rc<BlockTriangle>>,
    border: Rc<RefCell<BorderBlocks>>,
    form: Form,
    /// What belongs to a set; nothing until somebody has asked for it.
    of_set: RefCell<Option<OfSet>>,
    /// Whether that is another set, or not prepared yet.
    is_stale: Cell<bool>,
}

struct OfSet {
    unknowns: Vec<BorderUnknown>,
    /// Columns of `Z`.
    responses: Vec<Vector>,
    /// `Σ⁻¹`.
    inverse: DMatrix<f64>,
}

impl Bordered {
    /// Around a preconditioner of the blocks.
    pub fn new(
        of_blocks: Box<dyn Action>,
        triangle: Option<Rc<BlockTriangle>>,
        border: Rc<RefCell<BorderBlocks>>,
        form: Form,
    ) -> Rc<Self> {
        Rc::new(Self { of_blocks, triangle, border, form, of_set: RefCell::new(None), is_stale: Cell::new(true) })
    }

    /// Blocks have changed.
    pub fn forget(&self) {
        self.is_stale.set(true);
    }

    /// Whether it has to be prepared.
    pub fn is_stale(&self) -> bool {
        self.is_stale.get()
    }

    /// Tells the cycle of the motions of the set, or finds `Z` and `Σ` for them; the preconditioner of the blocks is set up.
    /// **Collective**
    pub fn prepare(&self, system: &SaddlePoint) -> Result<()> {
        let border = self.border.borrow();
        let unknowns = match &self.triangle {
            Some(triangle) => {
                let inside = border.resisted(RESISTED_INSIDE, usize::MAX);
                let is_inside = (FEW + 1..=MOST_INSIDE).contains(&inside.len());
                triangle.tell(&border, if is_inside { inside } else { Vec::new() });
                if is_inside { Vec::new() } else { border.resisted(RESISTED, MOST_HELD) }
            }
            None => border.resisted(RESISTED, MOST_HELD),
        };
        let (mut responses, mut residuals) = (Vec::new(), Vec::new());
        for &unknown in &unknowns {
            let (z, r) = self.response(system, &border, unknown)?;
            responses.push(z);
            residuals.push(r);
        }
        let count = unknowns.len();
        let mut works = vec![0.0; count * count];
        for (i, z) in responses.iter().enumerate() {
            for (j, r) in residuals.iter().enumerate() {
                works[count * i + j] = z.values().iter().zip(r.values().iter()).map(|(a, b)| a * b).sum();
            }
        }
        system.session.sum(&mut works);
        let mut schur = DMatrix::zeros(count, count);
        for (j, z) in responses.iter().enumerate() {
            let sums = border.sums(&z.values());
            for (i, &row) in unknowns.iter().enumerate() {
                schur[(i, j)] = border.entry(row, unknowns[j]) - sums.of(row) - works[count * i + j];
            }
        }
        let scales: Vec<f64> = unknowns.iter().map(|&unknown| border.scale(unknown)).collect();
        let inverse = scaled_inverse(schur, &scales);
        self.of_set.replace(Some(OfSet { unknowns, responses, inverse }));
        self.is_stale.set(false);
        Ok(())
    }

    /// A column of `Z`, from that of the set before, and what is missing, `V - A Z` of that column. **Collective**
    fn response(&self, system: &SaddlePoint, border: &BorderBlocks, unknown: BorderUnknown) -> Result<(Vector, Vector)> {
        let (mut z, mut v) = system.nest.create_vectors()?;
        z.set(0.0)?;
        v.set(0.0)?;
        border.add_column(unknown, 1.0, self.form == Form::Plain, &mut v.values_mut());
        if let Some(OfSet { unknowns, responses, .. }) = &*self.of_set.borrow()
            && let Some(at) = unknowns.iter().position(|&known| known == unknown)
        {
            z.copy_from(&responses[at])?;
        }
        let enough = if self.form == Form::Plain { EXACT } else { ENOUGH };
        let (mut r, mut change, whole) = (v.duplicate()?, v.duplicate()?, v.norm()?);
        let mut left = self.missing(system, &v, &z, &mut r)?;
        if left > whole {
            z.set(0.0)?;
            left = self.missing(system, &v, &z, &mut r)?;
        }
        for _ in 0..MOST_CYCLES {
            if left <= enough * whole {
                break;
            }
            self.of_blocks.apply(&r, &mut change)?;
            z.axpy(1.0, &change)?;
            let now = self.missing(system, &v, &z, &mut r)?;
            if now >= left {
                z.axpy(-1.0, &change)?;
                self.missing(system, &v, &z, &mut r)?;
                break;
            }
            left = now;
        }
        Ok((z, r))
    }

    /// `r = v - A z`, of displacements alone where the blocks are a triangle; its norm. **Collective**
    fn missing(&self, system: &SaddlePoint, v: &Vector, z: &Vector, r: &mut Vector) -> Result<f64> {
        system.nest.residual(v, z, r)?;
        if self.form == Form::Augmented {
            let own = system.multipliers.own.len();
            let mut values = r.values_mut();
            let first = values.len() - own;
            values[first..].fill(0.0);
        }
        r.norm()
    }
}

impl Action for Rc<Bordered> {
    fn apply(&self, x: &Vector, y: &mut Vector) -> Result<()> {
        self.of_blocks.apply(x, y)?;
        let of_set = self.of_set.borrow();
        let Some(OfSet { unknowns, responses, inverse }) = of_set.as_ref().filter(|of_set| !of_set.unknowns.is_empty()) else {
            return Ok(());
        };
        let sums = self.border.borrow().sums(&y.values());
        let p = inverse * DVector::from_iterator(unknowns.len(), unknowns.iter().map(|&unknown| sums.of(unknown)));
        for (z, p) in responses.iter().zip(p.iter()) {
            y.axpy(*p, z)?;
        }
        Ok(())
    }
}
