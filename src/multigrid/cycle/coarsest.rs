//! What solves below the lowest level that the cycle sweeps: a factor on the one rank that has all of the coarsest level of the
//! mesh, or where the macro mesh is large, auxiliary levels; a factor that all ranks make where none of these would be smaller.

use super::level::CycleLevel;
use crate::multigrid::interpolation::Interpolation;
use crate::multigrid::stiffness::LatticeOperator;
use crate::petsc::{Error, Factor, Krylov, Matrix, MultigridCycle, MultigridLevel, Result, Session, Vector};
use std::rc::Rc;

/// Prefix of the options of the smoothers and of the coarsest solver: that of PETSc's own multigrid, so that the defaults of
/// `system/solver` hold here, too.
const PREFIX: &str = "fieldsplit_u_";

/// Prefix of the options of the coarsest solver alone.
const COARSE_PREFIX: &str = "fieldsplit_u_mg_coarse_";

/// Cycles on auxiliary levels for what a force does, at most, and the relative residual that is enough: two assemblies had
/// the same iterations with 1e-2 and with .3 in its place (and up to ten cycles).
const MOST_CYCLES: usize = 4;
const ENOUGH: f64 = 0.1;

/// The solver below the levels that are swept.
pub enum Coarsest {
    /// The coarsest level of the mesh is small: a factor on the rank that has it, and the level's vectors.
    Factor { factor: Option<Factor>, lattice: Rc<LatticeOperator>, b: Vec<[f64; 2]>, x: Vec<[f64; 2]> },
    /// It is not: a solver on auxiliary levels below it.
    Auxiliary(Box<AuxiliarySolver>),
}

/// A solver on auxiliary levels.
pub struct AuxiliarySolver {
    /// A cycle of PETSc's multigrid; where there is one such level, or the level is the coarsest of the mesh, a factor.
    solver: Krylov,
    is_cycle: bool,
    /// All interpolations, of which this one leads up from the levels here.
    interpolations: Rc<[Interpolation]>,
    up: usize,
    operator: Matrix,
    b: Vector,
    x: Vector,
    /// On the level above.
    fine: Vector,
}

impl Coarsest {
    /// A factor of a level that one rank has. **Collective**
    ///
    /// # Errors
    /// [`Error::NotConverged`] on every rank if the level is singular.
    pub fn factor(lattice: Rc<LatticeOperator>, session: &Session) -> Result<Self> {
        let nodes = vec![[0.0; 2]; lattice.node_count()];
        Ok(Self::Factor { factor: factor(&lattice, session)?, lattice, b: nodes.clone(), x: nodes })
    }

    /// A solver on levels below those that are swept, the coarsest first; the interpolation behind theirs leads up from them.
    /// **Collective**
    pub fn on_levels(levels: &[MultigridLevel], interpolations: &Rc<[Interpolation]>, session: &Session) -> Result<Self> {
        let (finest, is_cycle, up) = (levels[levels.len() - 1].operator, levels.len() > 1, levels.len() - 1);
        let solver = Krylov::new(session, if is_cycle { PREFIX } else { COARSE_PREFIX })?;
        solver.set_operators(finest, finest)?;
        solver.set_from_options()?;
        if is_cycle {
            solver.preconditioner().multigrid(MultigridCycle::Full, levels)?;
        }
        solver.set_up()?;
        let (x, fine) = interpolations[up].matrix.create_vectors()?;
        let (b, interpolations) = (finest.create_vectors()?.0, interpolations.clone());
        let operator = finest.share()?;
        Ok(Self::Auxiliary(Box::new(AuxiliarySolver { solver, is_cycle, interpolations, up, operator, b, x, fine })))
    }

    /// Takes over changed values. **Collective**
    pub fn refresh(&mut self, session: &Session) -> Result<()> {
        match self {
            Self::Factor { factor: known, lattice, .. } => *known = factor(lattice, session)?,
            Self::Auxiliary(auxiliary) => auxiliary.solver.preconditioner().set_up()?,
        }
        Ok(())
    }

    /// Takes forces from the level above. **Collective**
    pub fn restrict(&mut self, level: &mut CycleLevel, fine: &[[f64; 2]]) -> Result<()> {
        match self {
            Self::Factor { b, .. } => level.restrict(fine, b),
            Self::Auxiliary(auxiliary) => auxiliary.restrict(|forces| forces.copy_from_slice(fine.as_flattened()))?,
        }
        Ok(())
    }

    /// Takes the residual from the level above, behind a sweep of these `b` and `x`; `r` has room for it. **Collective**
    pub fn restrict_residual(&mut self, level: &mut CycleLevel, of: [&[[f64; 2]]; 2], r: &mut [[f64; 2]]) -> Result<()> {
        match self {
            Self::Factor { b, .. } => level.restrict_residual(of[0], of[1], r, b),
            Self::Auxiliary(auxiliary) => {
                auxiliary.restrict(|forces| level.residual(of[0], of[1], forces.as_chunks_mut().0))?;
            }
        }
        Ok(())
    }

    /// Hands what was found to the level above: from there on, or added. **Collective**
    pub fn prolong<const ADD: bool>(&mut self, level: &mut CycleLevel, fine: &mut [[f64; 2]]) -> Result<()> {
        match self {
            Self::Factor { x, .. } if ADD => level.correct(x, fine),
            Self::Factor { x, .. } => level.begin(x, fine),
            Self::Auxiliary(auxiliary) => {
                let AuxiliarySolver { interpolations, up, x, fine: values, .. } = &mut **auxiliary;
                interpolations[*up].matrix.multiply(x, values)?;
                let add = |(to, value): (&mut f64, &f64)| *to = value + if ADD { *to } else { 0.0 };
                fine.as_flattened_mut().iter_mut().zip(&*values.values()).for_each(add);
            }
        }
        Ok(())
    }

    /// Shows the forces.
    pub fn with_forces<T>(&self, show: impl FnOnce(&[f64]) -> T) -> T {
        match self {
            Self::Factor { b, .. } => show(b.as_flattened()),
            Self::Auxiliary(auxiliary) => show(&auxiliary.b.values()),
        }
    }

    /// Hands out the solution to be changed.
    pub fn with_solution<T>(&mut self, change: impl FnOnce(&mut [f64]) -> T) -> T {
        match self {
            Self::Factor { x, .. } => change(x.as_flattened_mut()),
            Self::Auxiliary(auxiliary) => change(&mut auxiliary.x.values_mut()),
        }
    }

    /// What the forces `b` do, and what is missing: `z ≈ A⁻¹ b` and `b - A z`; `before` is what they did in another set.
    /// **Collective**
    pub fn response(&mut self, before: Option<&[f64]>) -> Result<[Vec<f64>; 2]> {
        if let Self::Auxiliary(auxiliary) = self {
            return auxiliary.response(before);
        }
        self.solve(MultigridCycle::V)?;
        let response = self.with_solution(|x| x.to_vec());
        let missing = vec![0.0; response.len()];
        Ok([response, missing])
    }

    /// Solves, on auxiliary levels by one such cycle. **Collective**
    pub fn solve(&mut self, cycle: MultigridCycle) -> Result<()> {
        match self {
            Self::Factor { factor: None, .. } => Ok(()),
            Self::Factor { factor: Some(factor), b, x, .. } => factor
                .solve(|forces| forces.copy_from_slice(b.as_flattened()), |found| x.as_flattened_mut().copy_from_slice(found)),
            Self::Auxiliary(auxiliary) => {
                let AuxiliarySolver { solver, is_cycle, b, x, .. } = &mut **auxiliary;
                if *is_cycle {
                    solver.preconditioner().set_cycle(cycle)?;
                }
                solver.apply(b, x)
            }
        }
    }
}

impl AuxiliarySolver {
    /// Takes what `bring` puts on the level above. **Collective**
    fn restrict(&mut self, bring: impl FnOnce(&mut [f64])) -> Result<()> {
        bring(&mut self.fine.values_mut());
        self.interpolations[self.up].matrix.multiply_transpose(&self.fine, &mut self.b)
    }

    /// [`Coarsest::response`], which begins with what the forces did before. **Collective**
    fn response(&self, before: Option<&[f64]>) -> Result<[Vec<f64>; 2]> {
        let Self { solver, operator, b, .. } = self;
        let (mut z, mut r, mut change) = (b.duplicate()?, b.duplicate()?, b.duplicate()?);
        z.set(0.0)?;
        if let Some(before) = before {
            z.values_mut().copy_from_slice(before);
        }
        operator.residual(b, &z, &mut r)?;
        let (whole, mut left) = (b.norm()?, r.norm()?);
        if left > whole {
            z.set(0.0)?;
            r.copy_from(b)?;
            left = whole;
        }
        if self.is_cycle {
            solver.preconditioner().set_cycle(MultigridCycle::V)?;
        }
        for _ in 0..MOST_CYCLES {
            if left <= ENOUGH * whole {
                break;
            }
            solver.apply(&r, &mut change)?;
            z.axpy(1.0, &change)?;
            operator.residual(b, &z, &mut r)?;
            let now = r.norm()?;
            if now >= left {
                z.axpy(-1.0, &change)?;
                operator.residual(b, &z, &mut r)?;
                break;
            }
            left = now;
        }
        Ok([z.values().to_vec(), r.values().to_vec()])
    }
}

/// **Collective**
fn factor(lattice: &LatticeOperator, session: &Session) -> Result<Option<Factor>> {
    assert_eq!(lattice.far_count(), 0, "one rank has all nodes of the coarsest level");
    let has_nodes = lattice.node_count() > 0;
    let factor = has_nodes.then(|| Factor::new(session, &lattice.rows().borrow().scalar_rows())).transpose();
    let is_singular = matches!(factor, Err(Error::NotConverged { .. }));
    if session.any(is_singular) { Err(Factor::singular()) } else { factor }
}
