//! The system of one contact boundary with its state: the active set, the unknowns, and what solves it.

use crate::discretisation::{Discretisation, Space, SystemError};
use crate::multigrid::{Interpolation, LatticeOperator, Stiffness};
use crate::petsc::{Matrix, Vector};
use crate::system::choice::SolverChoice;
use crate::system::rigid_border::RigidBorder;
use crate::system::saddle_point::{BorderValues, SaddlePoint};
use crate::system::solver::{LinearEnding, LinearSolve, LinearSolver, Preconditioning, Residual, inf_sup};
use std::cell::{Cell, OnceCell};
use std::rc::Rc;

/// What a solve begins with.
pub struct Start {
    /// This rank's displacements, in the nodes' frames, those of rigid sets among them.
    pub displacement: Vec<f64>,
    /// Pressures of all multipliers (stress).
    pub pressures: Vec<f64>,
    /// States of all multipliers.
    pub active: Vec<bool>,
}

/// A system that is solved for one active set after the other. Blocks, levels, solver and right-hand side always belong to
/// the same set, that of the last [`System::set_active`].
pub struct System<'a> {
    problem: &'a Discretisation,
    blocks: SaddlePoint,
    solver: LinearSolver,
    /// Whether the solver has seen the blocks as they are.
    is_solver_current: bool,
    /// Displacements in the nodes' frames, zero where they are prescribed, and scaled multipliers.
    unknowns: Vector,
    /// The right-hand side of the set, once somebody has asked for it.
    right_hand_side: OnceCell<Vector>,
    /// The residual of the unknowns, once somebody has asked for it or a solve has told it.
    residual: Cell<Option<Residual>>,
    /// Rigid motions that are unknown, if there are any.
    border: Option<Rc<RigidBorder>>,
    /// These motions, beside the unknowns.
    motion: Vec<f64>,
}

impl<'a> System<'a> {
    /// Sets up the solver of assembled blocks, with a preconditioning to begin with; the unknowns are zero.
    /// `interpolations[l]` leads from level `l` to level `l + 1`, where auxiliary levels come before those of the blocks.
    /// **Collective**
    pub fn new(
        problem: &'a Discretisation,
        blocks: SaddlePoint,
        interpolations: &Rc<[Interpolation]>,
        choice: SolverChoice,
        preconditioning: Preconditioning,
    ) -> Result<Self, SystemError> {
        let border = RigidBorder::new(problem)?.map(Rc::new);
        let blocks = match &border {
            Some(border) => blocks.with_border(problem, border.clone())?,
            None => blocks,
        };
        let solver = LinearSolver::new(&blocks, interpolations, choice, preconditioning)?;
        let unknowns = blocks.nest.create_vectors()?.0;
        let motion = vec![0.0; border.as_ref().map_or(0, |border| border.components.len())];
        let (right_hand_side, residual) = (OnceCell::new(), Cell::new(None));
        Ok(Self { problem, blocks, solver, is_solver_current: true, unknowns, right_hand_side, residual, border, motion })
    }

    /// What it was assembled from.
    pub fn problem(&self) -> &'a Discretisation {
        self.problem
    }

    fn space(&self) -> &'a Space {
        self.problem.finest()
    }

    /// The active set.
    pub fn active(&self) -> &[bool] {
        self.blocks.active()
    }

    /// Goes to another active set: the blocks of multipliers that change do, on every level, and open ones begin from zero.
    /// **Collective**
    pub fn set_active(&mut self, active: &[bool]) -> Result<(), SystemError> {
        if self.blocks.active() == active {
            return Ok(());
        }
        self.blocks.set_active(self.problem, active)?;
        self.is_solver_current = false;
        self.right_hand_side.take();
        self.residual.take();
        let unknowns = self.space().local_unknowns();
        let mut values = self.unknowns.values_mut();
        for (at, _) in self.blocks.multipliers.own.iter().enumerate().filter(|(_, i)| !active[**i]) {
            values[unknowns + at] = 0.0;
        }
        Ok(())
    }

    /// Takes over the unknowns of a start, and its active set. **Collective**
    pub fn begin(&mut self, start: &Start) -> Result<(), SystemError> {
        self.residual.take();
        let mut at_rest = None;
        if let Some(border) = &self.border {
            self.motion = border.motion_of(self.problem, &start.displacement);
            let back: Vec<f64> = self.motion.iter().map(|component| -component).collect();
            border.displace(self.problem.finest(), &back, at_rest.insert(start.displacement.clone()));
        }
        let displacement = at_rest.as_ref().unwrap_or(&start.displacement);
        put(&self.blocks, self.problem.finest(), displacement, (&start.pressures, &start.active), &mut self.unknowns);
        self.set_active(&start.active)
    }

    /// Solves for the active set, from the unknowns as they are, until the residual is below `tolerance |b|` or rounding stops
    /// it. **Collective**
    pub fn solve(&mut self, tolerance: f64) -> Result<LinearSolve, SystemError> {
        self.bring_solver_up_to_date()?;
        self.right_hand_side()?;
        let (b, known) = (self.right_hand_side.get().expect("just made"), self.residual.take());
        let (mut solve, residual) = self.solver.solve(&self.blocks, b, &mut self.unknowns, known, tolerance)?;
        self.residual.set(Some(residual));
        self.motion = self.blocks.motion(&self.unknowns, &self.blocks.given(), None, &self.motion);
        if self.blocks.border.as_ref().is_some_and(|border| border.borrow().is_driven_freely()) {
            let reason = "the forces on rigid tools or plates do not come to balance".into();
            let LinearSolve { iterations, residual, .. } = solve;
            solve.ending = LinearEnding::Failed { reason, iterations, residual };
        }
        Ok(solve)
    }

    /// Displacements under other nodal forces (`load`, of this rank) and other gaps, all else as it is: the active set,
    /// supports that do not move. **Collective**
    pub fn response(&mut self, load: &[f64], gap: &[f64], tolerance: f64) -> Result<Vec<f64>, SystemError> {
        self.bring_solver_up_to_date()?;
        let loads = self.border.as_ref().map(|border| border.loads_of(self.problem, load)).unwrap_or_default();
        let given = BorderValues { motion: loads, mean: vec![0.0; self.motion.len()] };
        let b = self.blocks.right_hand_side_of(|values| values.copy_from_slice(load), gap, &given, self.space())?;
        let mut x = self.unknowns.duplicate()?;
        x.set(0.0)?;
        self.solver.solve(&self.blocks, &b, &mut x, None, tolerance)?;
        let mut displacement = x.values()[..self.space().local_unknowns()].to_vec();
        if let Some(border) = &self.border {
            let motion = self.blocks.motion(&x, &given, Some(gap), &vec![0.0; self.motion.len()]);
            border.displace(self.space(), &motion, &mut displacement);
        }
        Ok(displacement)
    }

    fn bring_solver_up_to_date(&mut self) -> Result<(), SystemError> {
        if !self.is_solver_current {
            self.solver.refresh(&self.blocks)?;
            self.is_solver_current = true;
        }
        Ok(())
    }

    /// The right-hand side of the active set, in the order of [`System::matrix`]. **Collective**
    pub fn right_hand_side(&self) -> Result<&Vector, SystemError> {
        if self.right_hand_side.get().is_none() {
            let b = self.blocks.right_hand_side(self.space())?;
            _ = self.right_hand_side.set(b);
        }
        Ok(self.right_hand_side.get().expect("just made"))
    }

    /// Residual of the unknowns. **Collective**
    pub fn residual(&self) -> Result<Residual, SystemError> {
        if self.residual.get().is_none() {
            self.residual.set(Some(self.residual_of(&self.unknowns)?.1));
        }
        Ok(self.residual.get().expect("just set"))
    }

    /// Norm of the nodal forces of the load, and of those of contact, as the unknowns are. **Collective**
    pub fn force_norms(&self) -> Result<[f64; 2], SystemError> {
        self.blocks.force_norms(&self.pressures(), self.space())
    }

    /// Residual that displacements alone would leave. **Collective**
    pub fn residual_of_displacement(&self, displacement: &[f64]) -> Result<Residual, SystemError> {
        let mut x = self.unknowns.duplicate()?;
        put(&self.blocks, self.space(), displacement, (&vec![0.0; self.active().len()], self.active()), &mut x);
        Ok(self.residual_of(&x)?.1)
    }

    fn residual_of(&self, x: &Vector) -> Result<(Vector, Residual), SystemError> {
        let b = self.right_hand_side()?;
        let mut r = b.duplicate()?;
        self.blocks.product.residual(b, x, &mut r)?;
        let norms = Residual { norm: r.norm()?, whole: b.norm()? };
        Ok((r, norms))
    }

    /// Residual of the unknowns, and the relative one of the plain system, without augmentation. **Collective**
    pub fn both_residuals(&self) -> Result<(Residual, f64), SystemError> {
        let (r, residual) = self.residual_of(&self.unknowns)?;
        Ok((residual, self.blocks.plain_residual(r, self.right_hand_side()?, self.space())?))
    }

    /// Shows this rank's displacements in the nodes' frames, zero where they are prescribed.
    pub fn with_free_displacement<T>(&self, with: impl FnOnce(&[f64]) -> T) -> T {
        with(&self.unknowns.values()[..self.space().local_unknowns()])
    }

    /// This rank's displacements in the nodes' frames, with those that are prescribed.
    pub fn displacement(&self) -> Vec<f64> {
        let space = self.space();
        let mut displacement = self.with_free_displacement(<[f64]>::to_vec);
        space.fixed().for_each(|(at, value)| displacement[at] = value);
        if let Some(border) = &self.border {
            border.displace(space, &self.motion, &mut displacement);
        }
        displacement
    }

    /// Largest displacement of a node along an axis of its frame (length). **Collective**
    pub fn largest_displacement(&self) -> f64 {
        let larger = |most: f64, value: &f64| most.max(value.abs());
        let own = if self.border.is_none() {
            let free = self.with_free_displacement(|u| u.iter().fold(0.0, larger));
            self.space().fixed().fold(free, |most, (_, value)| larger(most, &value))
        } else {
            self.displacement().iter().fold(0.0, larger)
        };
        self.problem.session.max([own])[0]
    }

    /// `λ_i = s_i λ̂_i` of all multipliers (stress). **Collective**
    pub fn pressures(&self) -> Vec<f64> {
        let multipliers = &self.blocks.multipliers;
        let all = multipliers.collect(&self.unknowns.values()[self.space().local_unknowns()..]);
        all.iter().zip(&multipliers.scale).map(|(value, scale)| value * scale).collect()
    }

    /// `(B u - c)_i` of all multipliers, active or not, for this rank's displacements (length squared). **Collective**
    pub fn penetration(&self, displacement: &[f64]) -> Vec<f64> {
        self.blocks.penetration(displacement, &self.motion, self.space())
    }

    /// `C λ` of the jump term (length squared).
    pub fn jump_term(&self, pressures: &[f64]) -> Vec<f64> {
        self.blocks.multipliers.jump_term(pressures)
    }

    /// Discrete inf-sup constant of each contact, where it can be had. **Collective**
    pub fn inf_sup(&self) -> Result<Vec<Option<f64>>, SystemError> {
        inf_sup(&self.blocks, &self.problem.contacts)
    }

    /// All blocks of the finest level: rows of this rank's displacements, then of its multipliers.
    pub fn matrix(&self) -> &Matrix {
        &self.blocks.nest
    }

    /// Rows of `K + Bᵀ D B` on the levels that the solver uses, coarsest first, auxiliary ones among them. **Collective**
    pub fn levels(&mut self) -> Result<Vec<Rc<LatticeOperator>>, SystemError> {
        self.bring_solver_up_to_date()?;
        let auxiliary = self.solver.auxiliary_levels(&self.blocks)?;
        Ok(auxiliary.chain(self.blocks.stiffness.iter().map(Stiffness::lattice)).cloned().collect())
    }

    /// What preconditions the displacements.
    pub fn preconditioning(&self) -> Preconditioning {
        self.solver.preconditioning()
    }

    /// What solves it, in words.
    pub fn solver_name(&self) -> &str {
        &self.solver.name
    }
}

/// Puts displacements, and the pressures of what is active, into unknowns; prescribed components are no unknowns, and open multipliers
/// begin from zero.
fn put(blocks: &SaddlePoint, space: &Space, displacement: &[f64], (pressures, active): (&[f64], &[bool]), x: &mut Vector) {
    let unknowns = space.local_unknowns();
    let mut values = x.values_mut();
    values[..unknowns].copy_from_slice(displacement);
    space.fixed().for_each(|(at, _)| values[at] = 0.0);
    for (at, &i) in blocks.multipliers.own.iter().enumerate() {
        values[unknowns + at] = if active[i] { pressures[i] / blocks.multipliers.scale[i] } else { 0.0 };
    }
}
