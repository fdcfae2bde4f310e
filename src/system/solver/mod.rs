//! Linear solvers of the saddle point.
//!
//! `fieldsplit`: GMRES (BiCGStab on many unknowns), preconditioned from the right by the block upper triangle of
//! `K + BᵀDB` and `S = -D⁻¹`; one multigrid F-cycle stands for the inverse of the first, on the levels of the mesh and
//! auxiliary ones below ([`super::auxiliary`]). Where that is too weak, solves fall back on stronger ones, in the end on a
//! Cholesky factor ([`Preconditioning`]). `direct`: MUMPS on the plain system. All settings are PETSc options, which a user's
//! own override; only the tolerance is the case's.
//!
//! # The choices, and what was measured
//!
//! The blocks are a MatNest with fields `u` and `lambda`, reachable as `-fieldsplit_u_...` and `-fieldsplit_lambda_...`. The
//! recipe, with the measurement behind each choice (an independent prototype; example 1, 264 thousand unknowns, GMRES
//! iterations to 1e-8, P1/P0 and P2/P1 discontinuous, unless said otherwise):
//!
//! - **augment the system itself, K_γ = K + BᵀDB**: K is singular where a body floats. Augmenting only the preconditioner: 23
//!   and 25 instead of 11 and 11. Not at all: no convergence in 1000, even with an exact factor of K. Augmentation as in Benzi,
//!   Golub, Liesen 2005 and Benzi, Olshanskii 2006.
//! - **γ_i = 3 E_c/H_i, local, E_c the harmonic mean**: flat from 2 to 7 (the figures of this list are at 5); at a million
//!   unknowns on 3 ranks 13 at most for every pair of spaces, against 16 at 5; one global γ on segments graded to 2⁻⁸: 36 and
//!   45 instead of 11 and 12. With E₂/E₁ from 1e-6 to 1e6: 10 to 13.
//! - **right-preconditioned GMRES (above half a million unknowns flexible BiCGStab: 5 or 6 iterations of two cycles instead of
//!   9 or 10 of one, nine vectors instead of fifteen, a tenth less time to 1e-8 at a million unknowns), block upper triangle, S
//!   = -D⁻¹**: the true residual decides; `full` costs two cycles for one iteration less; block diagonal 28 and 35; MINRES
//!   stops too early in its own norm.
//! - **one F-cycle on K_γ, one symmetric SOR sweep**: 11 iterations at 17 thousand as at 4 million unknowns; V-cycle 15 → 24
//!   from 17 thousand to 1 million; more sweeps cost what they save; the half sweep backward before the coarse corrections of
//!   levels below the finest saves one iteration in a hundred (616 of all cases together with it, 622 without) and takes about
//!   a tenth of a solve of a million unknowns with P1 (1 to 16 % in three comparisons on a noisy machine), 3 to 16 % with P2.
//! - **a sweep keeps nothing of its forward half for the backward half, as PETSc's SOR keeps L x**: in even macro triangles
//!   opposite couplings are added first: ten multiply-adds in either half, 14 and 6 with L and U apart; on sides L is one
//!   coupling of seven; in the stored rows of bent macro triangles, where by count up to a half of the way back is saved,
//!   solves of `pin_full` (P1, 1.4 million unknowns) and `hertz_discs` (P2, 724 thousand) took .5 % longer and .4 % less,
//!   medians of seven.
//! - **what limits the iterations is shared: the cycle and S**: on `bars_inclined/even.toml`, P1/P0, one rank, the eigenvalues
//!   of the cycle alone go down to .57, the worst of them, by a two-grid analysis of K, in a macro triangle with an angle of
//!   111 degrees; those of S with an exact K_γ go down to .55. A sweep that is better in flat macro triangles (overrelaxed by
//!   2/(1 + sin α)), one more sweep of the sides, γ at 5, a pentadiagonal S⁻¹: each by itself saves one of fourteen iterations
//!   to 1e-12, or none.
//! - **fine segments on every level: B_l = B_{l+1} P_{l+1}**: the F-cycle needs the variational property; aggregated ones stall
//!   or diverge once γ is 3 to 10 times as large, depending on the space.
//! - **multipliers scaled by E_c/H_i**: without, GMRES reports 1e-8 while the plain system is at 5.6e-6.
//! - **inactive multipliers stay, as identity**: same counts as dropping them; sizes, index sets and patterns survive the
//!   active-set loop.
//! - **loop at 1e-4, last solve at `tolerance`**: the right set in 10 of 10 runs; 1e-2 gives wrong ones.
//!
//! The stored rows of K_γ are assembled once with places for every coupling of Γ_C, and a change of the set writes to these
//! places alone, which are looked for once (`contact_places.rs`); where PETSc sees the rows, as on the coarsest level, those
//! that change are handed to it whole. `System::set_active` adds the difference of BᵀDB on every level and writes the rows and
//! columns of the multipliers that change, no others: at a million unknowns and 500 segments one that opens takes a hundredth
//! of a millisecond, all of them less than one. Blocks, right-hand side and solver cannot belong to different sets, since
//! `System` alone changes them. Below a macro mesh of more than 3000 unknowns, that of a fine file say, come auxiliary levels:
//! their operators are Galerkin products, made again by the next solve.
//! `direct` gives the plain system, converted to AIJ, to MUMPS: the reference for the other.

mod block_triangle;
mod bordered;
mod fallback;
mod inf_sup;
mod linear_solve;
mod options;

pub use fallback::Preconditioning;
pub use inf_sup::inf_sup;
pub use linear_solve::{LinearEnding, LinearSolve, Residual};

use self::block_triangle::BlockTriangle;
use self::bordered::Bordered;
use self::options::{
    CoarseSolver, FIELD_SPLIT, MOST_REDUNDANT, Options, REDUNDANT_FACTOR, SHORT_RECURRENCE, is_changed, is_chosen,
    is_method_chosen, is_split_changed, lambda_options, preconditioning_options,
};
use crate::discretisation::{Form, SystemError};
use crate::multigrid::Cycle;
use crate::multigrid::GalerkinLevels;
use crate::multigrid::Interpolation;
use crate::multigrid::Stiffness;
use crate::petsc::{
    self, Action, Krylov, KrylovEnding, Matrix, MultigridCycle, MultigridLevel, ReplacedAction, Session, Vector, WatchedSolve,
};
use crate::system::choice::SolverChoice;
use crate::system::saddle_point::SaddlePoint;
use fallback::{MOST, MOST_BORDERED, needed};
use std::rc::Rc;

/// Iterations after which a solve has failed.
const MOST_ITERATIONS: usize = 300;

/// Unknowns of the displacement above which BiCGStab takes the place of GMRES: it has nine vectors instead of fifteen for
/// ten iterations, so that fewer are cleared and added. To 1e-8 that saves a tenth of a solve at a million unknowns. On smaller
/// systems it saves less, and GMRES may end after every cycle.
pub(super) const MANY: usize = 500_000;

/// Relative residual above which rounding is no excuse.
const MOST_ROUNDING: f64 = 1e-6;

/// A solver, ready for one system.
pub struct LinearSolver {
    krylov: Krylov,
    /// What does the work of PETSc's fieldsplit, where no option asks for more, or stands around its preconditioner.
    _replaced: Option<ReplacedAction>,
    /// What knows of rigid motions that are eliminated, if there are any.
    bordered: Option<Rc<Bordered>>,
    session: Session,
    form: Form,
    /// The converted system of the direct solver.
    converted: Option<Matrix>,
    interpolations: Rc<[Interpolation]>,
    auxiliary: GalerkinLevels,
    /// The cycle, if it is mezha's own.
    cycle: Option<Cycle>,
    /// Whether BiCGStab stands in the place of GMRES, to save memory and time. What it cannot solve GMRES gets.
    is_short: bool,
    /// What preconditions the displacement block, from the next solve on.
    pub preconditioning: Preconditioning,
    /// The same in words.
    pub name: String,
    /// Whether it is set up. A stronger one that a solve falls back on waits for the next solve: there may be none.
    is_set_up: bool,
}

impl LinearSolver {
    /// Sets a solver up, with a preconditioning to begin with; `interpolations[l]` leads from level `l` to level `l + 1`,
    /// where auxiliary levels come before those of the system (the direct solver wants none). A system of one level is
    /// factorised.
    /// **Collective**
    pub fn new(
        system: &SaddlePoint,
        interpolations: &Rc<[Interpolation]>,
        choice: SolverChoice,
        preconditioning: Preconditioning,
        session: &Session,
    ) -> Result<Self, SystemError> {
        match choice.form() {
            Form::Augmented => Self::field_split(system, interpolations.clone(), preconditioning, MANY, session),
            Form::Plain => Self::direct(system, session),
        }
    }

    fn field_split(
        system: &SaddlePoint,
        interpolations: Rc<[Interpolation]>,
        preconditioning: Preconditioning,
        many: usize,
        session: &Session,
    ) -> Result<Self, SystemError> {
        let preconditioning = if interpolations.is_empty() { Preconditioning::Factor } else { preconditioning };
        let coarsest = interpolations.first().map_or(0, |interpolation| interpolation.matrix.size().1);
        let coarse = CoarseSolver::of(coarsest);
        let lambda = lambda_options(system.multipliers.pattern, session.size());
        let unknowns = system.finest_stiffness().operator().size().0;
        let is_short = preconditioning == Preconditioning::Sweep && unknowns > many && !is_method_chosen(session);
        let method: Options = if is_short { SHORT_RECURRENCE } else { &[] };
        let is_redundant = preconditioning == Preconditioning::Factor && session.size() > 1 && unknowns <= MOST_REDUNDANT;
        let factor: Options = if is_redundant { REDUNDANT_FACTOR } else { &[] };
        let smoother = preconditioning_options(preconditioning);
        for (name, value) in FIELD_SPLIT.iter().chain(lambda).chain(coarse.options()).chain(smoother).chain(method).chain(factor)
        {
            petsc::options::set_default(session, name, value)?;
        }
        let krylov = Krylov::new(session, "")?;
        set_operators(&krylov, system, preconditioning, session)?;
        let [u, lambda] = system.nest.nest_index_sets()?;
        let preconditioner = krylov.preconditioner();
        preconditioner.field_split_schur(&[("u", &u), ("lambda", &lambda)], &system.multipliers.schur)?;
        krylov.set_from_options()?;
        krylov.watch()?;
        krylov.set_up()?;
        let (mut auxiliary, mut cycle) = (GalerkinLevels::default(), None);
        if preconditioning != Preconditioning::Factor {
            auxiliary = GalerkinLevels::new(system.stiffness[0].operator(), &below(&interpolations, system))?;
            let solvers = preconditioner.field_split_solvers()?;
            let steps = std::iter::once(None).chain(interpolations.iter().map(|step| Some(&step.matrix)));
            let operators = auxiliary.iter().chain(system.stiffness.iter().map(Stiffness::operator));
            let levels: Vec<MultigridLevel> =
                operators.zip(steps).map(|(operator, interpolation)| MultigridLevel { operator, interpolation }).collect();
            petsc::options::clear(session, "-fieldsplit_u_pc_type")?;
            if preconditioning == Preconditioning::Sweep && !is_changed(session) {
                cycle = Cycle::new(&system.stiffness, &interpolations, &levels, session)?;
                // PETSc's multigrid below the cycle has set this default; field u has a shell.
                petsc::options::clear(session, "-fieldsplit_u_pc_type")?;
            }
            match &cycle {
                Some(cycle) => {
                    solvers[0].preconditioner().set_action("multigrid F-cycle on strips and stored rows", cycle.action())?;
                }
                None => solvers[0].preconditioner().multigrid(MultigridCycle::Full, &levels)?,
            }
            solvers[0].set_up()?;
        }
        let block_triangle = match cycle.as_ref().filter(|_| !is_split_changed(session)) {
            Some(cycle) => {
                let lower = preconditioner.field_split_solvers()?.pop().expect("two fields");
                Some(BlockTriangle::new(cycle.clone(), lower, &system.multipliers.transpose, session)?)
            }
            None => None,
        };
        let (replaced, bordered) = replace_action(&krylov, block_triangle, system, Form::Augmented, session)?;
        let kind = preconditioner.field_split_solvers()?[0].preconditioner().kind();
        let own = kind == "mg" || kind == "shell" || is_factor(kind.as_ref()) && preconditioning == Preconditioning::Factor;
        let name = if own { field_split_name(preconditioning) } else { format!("fieldsplit ({kind})") };
        let (session, form) = (session.clone(), Form::Augmented);
        Ok(Self {
            krylov,
            _replaced: replaced,
            bordered,
            session,
            form,
            converted: None,
            interpolations,
            auxiliary,
            cycle,
            preconditioning,
            is_short,
            name,
            is_set_up: true,
        })
    }

    fn direct(system: &SaddlePoint, session: &Session) -> Result<Self, SystemError> {
        for (name, value) in [
            ("-ksp_type", "gmres"),
            ("-ksp_pc_side", "right"),
            ("-ksp_norm_type", "unpreconditioned"),
            ("-ksp_divtol", "1e30"),
            ("-pc_type", "cholesky"),
            ("-pc_factor_mat_solver_type", "mumps"),
            // Towards ν = 0.5 good pivots fall short of MUMPS's own 0.01, and those put off outgrow its memory from 0.4999 on.
            ("-mat_mumps_cntl_1", "1e-4"),
            ("-mat_mumps_icntl_14", "100"),
        ] {
            petsc::options::set_default(session, name, value)?;
        }
        let krylov = Krylov::new(session, "")?;
        let name = "direct (MUMPS)".into();
        let mut solver = Self {
            krylov,
            _replaced: None,
            bordered: None,
            session: session.clone(),
            form: Form::Plain,
            converted: None,
            interpolations: Rc::new([]),
            auxiliary: GalerkinLevels::default(),
            cycle: None,
            preconditioning: Preconditioning::Factor,
            is_short: false,
            name,
            is_set_up: true,
        };
        solver.refresh(system)?;
        solver.krylov.set_from_options()?;
        solver.krylov.watch()?;
        solver.krylov.set_up()?;
        (solver._replaced, solver.bordered) = replace_action(&solver.krylov, None, system, Form::Plain, session)?;
        Ok(solver)
    }

    /// Takes over changed blocks. **Collective**
    pub fn refresh(&mut self, system: &SaddlePoint) -> Result<(), SystemError> {
        if let Some(bordered) = &self.bordered {
            bordered.forget();
        }
        if self.form == Form::Plain {
            let mut converted = system.nest.convert_aij()?;
            converted.set_symmetric(true)?;
            let product = if system.border.is_some() { &system.product } else { &converted };
            self.krylov.set_operators(product, &converted)?;
            self.converted = Some(converted);
        } else if !self.is_set_up {
            self.set_up(system)?;
        } else {
            self.auxiliary.refresh(system.stiffness[0].operator(), &below(&self.interpolations, system))?;
            if let Some(cycle) = &self.cycle {
                cycle.refresh(&self.session)?;
            }
            set_operators(&self.krylov, system, self.preconditioning, &self.session)?;
        }
        Ok(())
    }

    /// Sets the preconditioning up that a solve has fallen back on. **Collective**
    fn set_up(&mut self, system: &SaddlePoint) -> Result<(), SystemError> {
        let many = if self.is_short { MANY } else { usize::MAX };
        let interpolations = self.interpolations.clone();
        *self = Self::field_split(system, interpolations, self.preconditioning, many, &self.session)?;
        Ok(())
    }

    /// Operators of the auxiliary levels, coarsest first.
    pub fn auxiliary_operators(&self) -> impl Iterator<Item = &Matrix> {
        self.auxiliary.iter()
    }

    /// Options that the user gave and no object of this solver has asked for.
    pub fn unused_options(&self) -> Result<Vec<String>, SystemError> {
        Ok(petsc::options::unused(&self.session)?)
    }

    /// Solves from the `x` that is given, until the residual is below `tolerance |b|` or rounding stops it; a solve that
    /// is slow goes on with a stronger preconditioner, which stays. `known` is the residual of this `x`, if somebody knows it;
    /// that of the solution comes with what came of the solve. **Collective**
    pub fn solve(
        &mut self,
        system: &SaddlePoint,
        b: &Vector,
        x: &mut Vector,
        known: Option<Residual>,
        tolerance: f64,
    ) -> Result<(LinearSolve, Residual), SystemError> {
        let norm = known.map_or_else(|| b.norm(), |known| Ok(known.whole))?;
        let solve = self.solve_from(system, (b, norm), x, known.map(|known| known.norm), tolerance)?;
        let residual = Residual { norm: solve.residual * norm, whole: norm };
        Ok((solve, residual))
    }

    fn solve_from(
        &mut self,
        system: &SaddlePoint,
        (b, norm): (&Vector, f64),
        x: &mut Vector,
        known: Option<f64>,
        tolerance: f64,
    ) -> Result<LinearSolve, SystemError> {
        let mut solve = LinearSolve { ending: LinearEnding::Converged, iterations: 0, residual: 0.0, fallback: None };
        if norm == 0.0 {
            x.set(0.0)?;
            return Ok(solve);
        }
        let mut r = b.duplicate()?;
        let at_start = match known {
            Some(known) => known,
            None => {
                system.product.residual(b, x, &mut r)?;
                r.norm()?
            }
        };
        if at_start > norm {
            x.set(0.0)?;
        }
        let _watched = WatchedSolve::begin(norm, tolerance);
        let mut before = f64::INFINITY;
        loop {
            if !self.is_set_up {
                self.set_up(system)?;
            }
            let trial_iterations = self.trial_iterations().min(MOST_ITERATIONS - solve.iterations);
            if let Some(bordered) = self.bordered.as_ref().filter(|bordered| bordered.is_stale()) {
                self.krylov.set_up()?;
                bordered.prepare(system)?;
            }
            self.krylov.set_initial_guess_nonzero(true)?;
            self.krylov.set_tolerance(tolerance, trial_iterations)?;
            let solved = self.krylov.solve_allowing(b, x)?;
            let mut needed = needed(&self.krylov.residual_history(), self.is_short);
            if self.is_short {
                // Its rate is rough: it does not choose more than the next preconditioning.
                needed = needed.min(MOST[1].1);
            }
            solve.iterations += solved.iterations;
            system.product.residual(b, x, &mut r)?;
            solve.residual = r.norm()? / norm;
            if self.is_short && solve.residual > tolerance && solve.iterations < MOST_ITERATIONS {
                if solve.residual < 0.5 * before && solved.iterations < trial_iterations {
                    before = solve.residual;
                    continue;
                }
                self.give_up_short_recurrence(system, needed, &mut solve, x)?;
                before = f64::INFINITY;
                continue;
            }
            if solve.residual <= tolerance {
                if self.form == Form::Augmented && self.preconditioning.is_too_weak(needed, self.bordered.is_some()) {
                    self.fall_back(system, needed, &mut solve);
                }
                return Ok(solve);
            }
            // A start from where rounding has left a solve does better, as long as its residual falls.
            let falls = solve.residual < 0.5 * before;
            let slow = solved.iterations >= trial_iterations && needed > 1.0;
            if slow && solve.iterations < MOST_ITERATIONS && self.fall_back(system, needed, &mut solve) {
                before = f64::INFINITY;
            } else if !falls || solve.iterations >= MOST_ITERATIONS || self.is_exact(&solve) {
                solve.ending = self.ending(system, x, norm, tolerance, &solve, solved)?;
                return Ok(solve);
            } else {
                before = solve.residual;
            }
        }
    }

    /// BiCGStab does not come to its tolerance: GMRES takes its place, with the same preconditioning if that is good enough.
    fn give_up_short_recurrence(
        &mut self,
        system: &SaddlePoint,
        needed: f64,
        solve: &mut LinearSolve,
        x: &mut Vector,
    ) -> Result<(), SystemError> {
        (self.is_short, self.is_set_up) = (false, false);
        solve.fallback = Some(format!("{}, GMRES", self.name));
        if self.preconditioning.is_too_weak(needed, self.bordered.is_some()) {
            self.fall_back(system, needed, solve);
        }
        let is_better_than_nothing = solve.residual <= 1.0;
        if !is_better_than_nothing {
            x.set(0.0)?;
        }
        Ok(())
    }

    /// Iterations before it is asked whether to fall back.
    fn trial_iterations(&self) -> usize {
        match self.form {
            Form::Augmented if self.bordered.is_some() => self.preconditioning.trial_iterations().max(MOST_BORDERED),
            Form::Augmented => self.preconditioning.trial_iterations(),
            Form::Plain => MOST_ITERATIONS,
        }
    }

    /// Whether a factor has had its iterations: a system that still resists has lost its inf-sup constant.
    fn is_exact(&self, solve: &LinearSolve) -> bool {
        self.form == Form::Augmented
            && self.preconditioning == Preconditioning::Factor
            && solve.iterations >= 2 * self.trial_iterations()
    }

    /// Goes over to the next preconditioning that promises enough, if there is one; the next solve sets it up.
    fn fall_back(&mut self, system: &SaddlePoint, needed: f64, solve: &mut LinearSolve) -> bool {
        // The user's own choice stays.
        if self.form == Form::Plain || is_chosen(&self.session) {
            return false;
        }
        let unknowns = system.finest_stiffness().operator().size().0;
        let Some(preconditioning) = self.preconditioning.fallback(needed, unknowns) else { return false };
        (self.preconditioning, self.name, self.is_set_up) = (preconditioning, field_split_name(preconditioning), false);
        solve.fallback = Some(self.name.clone());
        true
    }

    /// What a solve that does not reach its tolerance has come to. **Collective**
    fn ending(
        &self,
        system: &SaddlePoint,
        x: &Vector,
        norm: f64,
        tolerance: f64,
        &LinearSolve { residual, iterations, .. }: &LinearSolve,
        solved: KrylovEnding,
    ) -> Result<LinearEnding, SystemError> {
        let floor = self.rounding(system, x, norm)?;
        Ok(if residual <= floor.min(MOST_ROUNDING) {
            LinearEnding::Rounding { residual, tolerance }
        } else {
            let reason = if solved.converged { "the residual no longer falls".to_string() } else { solved.reason };
            LinearEnding::Failed { reason, iterations, residual }
        })
    }

    /// Size that rounding alone can give the relative residual: `10 ε |K| |x| / |b|`.
    fn rounding(&self, system: &SaddlePoint, x: &Vector, norm: f64) -> Result<f64, SystemError> {
        let stiffness = system.finest_stiffness().operator().norm_infinity()?;
        Ok(10.0 * f64::EPSILON * stiffness * x.norm()? / norm)
    }
}

/// Puts in the place of what the preconditioner does a block triangle, and around it what knows of rigid motions, if there are
/// such. **Collective**
fn replace_action(
    krylov: &Krylov,
    block_triangle: Option<BlockTriangle>,
    system: &SaddlePoint,
    form: Form,
    session: &Session,
) -> Result<(Option<ReplacedAction>, Option<Rc<Bordered>>), SystemError> {
    let Some(border) = &system.border else {
        let replaced = block_triangle.map(|action| ReplacedAction::new(krylov.preconditioner(), |_| Ok(Box::new(action))));
        return Ok((replaced.transpose()?, None));
    };
    let mut bordered = None;
    let replaced = ReplacedAction::new(krylov.preconditioner(), |of_kind| {
        let of_blocks = block_triangle.map_or(of_kind, |action| Box::new(action) as Box<dyn Action>);
        let action = Bordered::new(of_blocks, border.clone(), form, session);
        bordered = Some(action.clone());
        Ok(Box::new(action))
    })?;
    Ok((Some(replaced), bordered))
}

/// Whether this is the preconditioner that factorises, by all ranks together or by each for itself.
fn is_factor(kind: &str) -> bool {
    kind == "cholesky" || kind == "redundant"
}

/// The solver with a preconditioning, in words.
fn field_split_name(preconditioning: Preconditioning) -> String {
    format!("fieldsplit ({})", preconditioning.words("multigrid F-cycle"))
}

/// The product of the nest and the nest, or for a factor the one with all rows stored. **Collective**
fn set_operators(
    krylov: &Krylov,
    system: &SaddlePoint,
    preconditioning: Preconditioning,
    session: &Session,
) -> Result<(), SystemError> {
    let stored = if preconditioning == Preconditioning::Factor { system.stored_nest(session)? } else { None };
    match &stored {
        Some(nest) => krylov.set_operators(if system.border.is_some() { &system.product } else { nest }, nest)?,
        None => krylov.set_operators(&system.product, &system.nest)?,
    }
    Ok(())
}

/// Those interpolations that lead to auxiliary levels, or up from them.
fn below<'a>(interpolations: &'a [Interpolation], system: &SaddlePoint) -> Vec<&'a Matrix> {
    interpolations[..interpolations.len() + 1 - system.stiffness.len()].iter().map(|step| &step.matrix).collect()
}
