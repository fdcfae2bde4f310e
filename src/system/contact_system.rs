//! The system of one contact boundary with its state: the active set, the unknowns, and what solves it.

use super::stiffness::Stiffness;
use super::{
    Discretisation, Interpolation, LinearEnding, LinearSolve, LinearSolver, Preconditioning, Residual, RigidBorder, SaddlePoint,
    SolverChoice, Space, SystemError, inf_sup,
};
use crate::petsc::{Matrix, Session, Vector};
use nalgebra::DVector;
use std::cell::{Cell, OnceCell};
use std::rc::Rc;

/// Solves with rigid sets that move, for one active set: each brings their balance to its own tolerance of the one before.
const MOST_BALANCED: usize = 8;

/// Relative residual of the responses to their motion, at most.
const RESPONSE: f64 = 1e-6;

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
    session: Session,
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
    rigid: RigidState,
}

/// Rigid sets with an unknown motion.
struct RigidState {
    border: RigidBorder,
    /// Free components of the motion.
    motion: Vec<f64>,
    /// Unknowns that answer to each of them, for an active set.
    responses: Vec<Vector>,
    /// The border's product with each response.
    products: Vec<DVector<f64>>,
    /// Relative residual of the responses; nothing if they are those of another active set.
    solved_to: Option<f64>,
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
        session: &Session,
    ) -> Result<Self, SystemError> {
        let solver = LinearSolver::new(&blocks, interpolations, choice, preconditioning, session)?;
        let unknowns = blocks.nest.create_vectors()?.0;
        let rigid = RigidState::new(problem, &unknowns, session)?;
        let (session, right_hand_side, residual) = (session.clone(), OnceCell::new(), Cell::new(None));
        Ok(Self { problem, session, blocks, solver, is_solver_current: true, unknowns, right_hand_side, residual, rigid })
    }

    /// What it was assembled from.
    pub fn problem(&self) -> &'a Discretisation {
        self.problem
    }

    /// All ranks.
    pub fn session(&self) -> &Session {
        &self.session
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
        self.rigid.solved_to = None;
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
        if self.rigid.border.is_empty() {
            put(&self.blocks, self.space(), start, &mut self.unknowns);
        } else {
            let motion = self.rigid.border.motion_of(self.problem, &start.displacement, &self.session);
            let back: Vec<f64> = motion.iter().map(|component| -component).collect();
            let mut displacement = start.displacement.clone();
            self.rigid.border.displace(self.problem, &back, &mut displacement);
            let (pressures, active) = (start.pressures.clone(), start.active.clone());
            put(&self.blocks, self.space(), &Start { displacement, pressures, active }, &mut self.unknowns);
            self.move_rigidly(motion);
        }
        self.set_active(&start.active)
    }

    /// Solves for the active set, from the unknowns as they are, until the residual is below `tolerance |b|` or rounding stops
    /// it. **Collective**
    pub fn solve(&mut self, tolerance: f64) -> Result<LinearSolve, SystemError> {
        self.bring_solver_up_to_date()?;
        if self.rigid.border.is_empty() {
            return self.solve_at_rest(tolerance);
        }
        self.balance_rigid_sets(tolerance)?;
        let mut solve = self.solve_at_rest(tolerance)?;
        for _ in 0..MOST_BALANCED {
            if matches!(solve.ending, LinearEnding::Failed { .. }) || self.balance_rigid_sets(tolerance)? <= tolerance {
                return Ok(solve);
            }
            let again = self.solve_at_rest(tolerance)?;
            solve = LinearSolve { iterations: solve.iterations + again.iterations, ..again };
        }
        let reason = "the forces on rigid tools or plates do not come to balance".into();
        let (iterations, residual) = (solve.iterations, solve.residual);
        Ok(LinearSolve { ending: LinearEnding::Failed { reason, iterations, residual }, ..solve })
    }

    /// Solves with the rigid sets where they are. **Collective**
    fn solve_at_rest(&mut self, tolerance: f64) -> Result<LinearSolve, SystemError> {
        self.right_hand_side()?;
        let (b, known) = (self.right_hand_side.get().expect("just made"), self.residual.take());
        let (solve, residual) = self.solver.solve(&self.blocks, b, &mut self.unknowns, known, tolerance)?;
        self.residual.set(Some(residual));
        Ok(solve)
    }

    /// Moves the rigid sets, and all else with them, to where their forces balance. What they were out of balance by before,
    /// relative to the largest force on them, is returned; less than `enough` is left as it is. **Collective**
    fn balance_rigid_sets(&mut self, enough: f64) -> Result<f64, SystemError> {
        self.respond(enough.min(RESPONSE))?;
        let pressures = self.pressures();
        let product = self.with_free_displacement(|u| self.rigid.border.transposed(u, &pressures, &self.session));
        let unbalanced = self.rigid.border.unbalanced(&product, &self.rigid.motion);
        let share = self.rigid.border.share(&unbalanced, &pressures, self.largest_displacement());
        if share > enough {
            let correction = self.rigid.border.correction(&self.rigid.products, &unbalanced);
            for (response, by) in self.rigid.responses.iter().zip(correction.iter()) {
                self.unknowns.axpy(-by, response)?;
            }
            self.move_rigidly(self.rigid.motion.iter().zip(correction.iter()).map(|(q, by)| q + by).collect());
        }
        Ok(share)
    }

    fn move_rigidly(&mut self, motion: Vec<f64>) {
        self.blocks.move_rigidly(&self.rigid.border, &motion);
        self.rigid.motion = motion;
        self.right_hand_side.take();
        self.residual.take();
    }

    /// Solves for the responses to the motions of rigid sets, if those that are known are not exact enough or those of another
    /// active set. **Collective**
    fn respond(&mut self, tolerance: f64) -> Result<(), SystemError> {
        if self.rigid.solved_to.is_some_and(|known| known <= tolerance) {
            return Ok(());
        }
        self.rigid.products.clear();
        for component in 0..self.rigid.border.len() {
            let (forces, gaps) = self.rigid.border.column(component);
            let b = self.blocks.right_hand_side_of(forces, gaps, self.problem.finest())?;
            let response = &mut self.rigid.responses[component];
            self.solver.solve(&self.blocks, &b, response, None, tolerance)?;
            let unknowns = self.problem.finest().local_unknowns();
            let pressures = pressures_of(&self.blocks, &response.values()[unknowns..], &self.session);
            let [product, _] = self.rigid.border.transposed(&response.values()[..unknowns], &pressures, &self.session);
            self.rigid.products.push(product);
        }
        self.rigid.solved_to = Some(tolerance);
        Ok(())
    }

    /// Displacements under other nodal forces (`load`, of this rank) and other gaps, all else as it is: the active set,
    /// supports that do not move. **Collective**
    pub fn response(&mut self, load: &[f64], gap: &[f64], tolerance: f64) -> Result<Vec<f64>, SystemError> {
        self.bring_solver_up_to_date()?;
        let b = self.blocks.right_hand_side_of(load, gap, self.space())?;
        let mut x = self.unknowns.duplicate()?;
        x.set(0.0)?;
        self.solver.solve(&self.blocks, &b, &mut x, None, tolerance)?;
        let unknowns = self.space().local_unknowns();
        if self.rigid.border.is_empty() {
            return Ok(x.values()[..unknowns].to_vec());
        }
        self.respond(tolerance)?;
        let pressures = pressures_of(&self.blocks, &x.values()[unknowns..], &self.session);
        let given = self.rigid.border.loaded(self.problem, load, &self.session);
        let [product, _] = self.rigid.border.transposed(&x.values()[..unknowns], &pressures, &self.session);
        let unbalanced = given - product;
        let motion = self.rigid.border.correction(&self.rigid.products, &unbalanced);
        for (response, by) in self.rigid.responses.iter().zip(motion.iter()) {
            x.axpy(-by, response)?;
        }
        let mut displacement = x.values()[..unknowns].to_vec();
        self.rigid.border.displace(self.problem, motion.as_slice(), &mut displacement);
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
    pub fn residual_of_displacement(&self, displacement: Vec<f64>) -> Result<Residual, SystemError> {
        let mut x = self.unknowns.duplicate()?;
        let (pressures, active) = (vec![0.0; self.active().len()], self.active().to_vec());
        put(&self.blocks, self.space(), &Start { displacement, pressures, active }, &mut x);
        Ok(self.residual_of(&x)?.1)
    }

    fn residual_of(&self, x: &Vector) -> Result<(Vector, Residual), SystemError> {
        let b = self.right_hand_side()?;
        let mut r = b.duplicate()?;
        self.blocks.nest.residual(b, x, &mut r)?;
        let norms = Residual { norm: r.norm()?, whole: b.norm()? };
        Ok((r, norms))
    }

    /// Residual of the unknowns, and the relative one of the plain system, without augmentation. **Collective**
    pub fn both_residuals(&self) -> Result<(Residual, f64), SystemError> {
        let (r, residual) = self.residual_of(&self.unknowns)?;
        Ok((residual, self.blocks.plain_residual(r, self.right_hand_side()?, self.space(), &self.session)?))
    }

    /// Shows this rank's displacements in the nodes' frames, zero where they are prescribed.
    pub fn with_free_displacement<T>(&self, with: impl FnOnce(&[f64]) -> T) -> T {
        with(&self.unknowns.values()[..self.space().local_unknowns()])
    }

    /// This rank's displacements in the nodes' frames, with those that are prescribed.
    pub fn displacement(&self) -> Vec<f64> {
        let space = self.space();
        let mut displacement = self.with_free_displacement(<[f64]>::to_vec);
        for (node, constraint) in space.constraints.iter().filter(|(node, _)| space.own.contains(node)) {
            for k in (0..2).filter(|&k| constraint.fixed[k]) {
                displacement[2 * (node - space.own.start) + k] = constraint.value[k];
            }
        }
        self.rigid.border.displace(self.problem, &self.rigid.motion, &mut displacement);
        displacement
    }

    /// Largest displacement of a node along an axis of its frame (length). **Collective**
    pub fn largest_displacement(&self) -> f64 {
        let larger = |most: f64, value: &f64| most.max(value.abs());
        let mut most = [if self.rigid.border.is_empty() {
            let of_supports = self.space().constraints.iter().filter(|(node, _)| self.space().own.contains(node));
            let fixed = of_supports.flat_map(|(_, of)| of.fixed.iter().zip(&of.value).filter(|(fixed, _)| **fixed));
            fixed.map(|(_, value)| value).fold(self.with_free_displacement(|u| u.iter().fold(0.0, larger)), larger)
        } else {
            self.displacement().iter().fold(0.0, larger)
        }];
        self.session.max(&mut most);
        most[0]
    }

    /// `λ_i = s_i λ̂_i` of all multipliers (stress). **Collective**
    pub fn pressures(&self) -> Vec<f64> {
        pressures_of(&self.blocks, &self.unknowns.values()[self.space().local_unknowns()..], &self.session)
    }

    /// `(B u - c)_i` of all multipliers, active or not, for this rank's displacements (length squared). **Collective**
    pub fn penetration(&self, displacement: &[f64]) -> Vec<f64> {
        self.blocks.penetration(displacement, self.space(), &self.session)
    }

    /// `C λ` of the jump term (length squared).
    pub fn jump_term(&self, pressures: &[f64]) -> Vec<f64> {
        self.blocks.multipliers.jump_term(pressures)
    }

    /// Discrete inf-sup constant of each contact, where it can be had. **Collective**
    pub fn inf_sup(&self) -> Result<Vec<Option<f64>>, SystemError> {
        inf_sup(&self.blocks, &self.problem.contacts, &self.session)
    }

    /// All blocks of the finest level: rows of this rank's displacements, then of its multipliers.
    pub fn matrix(&self) -> &Matrix {
        &self.blocks.nest
    }

    /// `K + Bᵀ D B` on the levels that the solver uses, coarsest first, auxiliary ones among them. **Collective**
    pub fn levels(&mut self) -> Result<Vec<&Matrix>, SystemError> {
        self.bring_solver_up_to_date()?;
        Ok(self.solver.auxiliary_operators().chain(self.blocks.stiffness.iter().map(Stiffness::operator)).collect())
    }

    /// What preconditions the displacements.
    pub fn preconditioning(&self) -> Preconditioning {
        self.solver.preconditioning
    }

    /// What solves it, in words.
    pub fn solver_name(&self) -> &str {
        &self.solver.name
    }

    /// Options that the user gave and nothing has asked for.
    pub fn unused_options(&self) -> Result<Vec<String>, SystemError> {
        self.solver.unused_options()
    }
}

impl RigidState {
    /// Sets at rest. **Collective**
    fn new(problem: &Discretisation, unknowns: &Vector, session: &Session) -> Result<Self, SystemError> {
        let border = RigidBorder::new(problem, session)?;
        let count = border.len();
        let mut responses = Vec::new();
        for _ in 0..count {
            let mut response = unknowns.duplicate()?;
            response.set(0.0)?;
            responses.push(response);
        }
        Ok(Self { border, motion: vec![0.0; count], responses, products: Vec::new(), solved_to: None })
    }
}

/// Pressures of all multipliers (stress), from the scaled ones of this rank. **Collective**
fn pressures_of(blocks: &SaddlePoint, own: &[f64], session: &Session) -> Vec<f64> {
    let all = blocks.multipliers.collect(own, session);
    all.iter().zip(&blocks.multipliers.scale).map(|(value, scale)| value * scale).collect()
}

/// Puts a start into unknowns; prescribed components are no unknowns, and open multipliers begin from zero.
fn put(blocks: &SaddlePoint, space: &Space, start: &Start, x: &mut Vector) {
    let unknowns = space.local_unknowns();
    let mut values = x.values_mut();
    values[..unknowns].copy_from_slice(&start.displacement);
    for (node, constraint) in space.constraints.iter().filter(|(node, _)| space.own.contains(node)) {
        for k in (0..2).filter(|&k| constraint.fixed[k]) {
            values[2 * (node - space.own.start) + k] = 0.0;
        }
    }
    for (at, &i) in blocks.multipliers.own.iter().enumerate() {
        values[unknowns + at] = if start.active[i] { start.pressures[i] / blocks.multipliers.scale[i] } else { 0.0 };
    }
}
