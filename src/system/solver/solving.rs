//! Solves to a tolerance, and what takes the place of a method or a preconditioning that is too slow.

use super::fallback::{MOST, MOST_BORDERED, Preconditioning, needed};
use super::field_split::field_split_name;
use super::linear_solve::{LinearEnding, LinearSolve, Residual};
use super::linear_solver::LinearSolver;
use super::options::is_chosen;
use crate::discretisation::{Form, SystemError};
use crate::petsc::{KrylovEnding, Vector, WatchedSolve};
use crate::system::saddle_point::SaddlePoint;

/// Iterations after which a solve has failed.
const MOST_ITERATIONS: usize = 300;

/// Relative residual above which rounding is no excuse.
const MOST_ROUNDING: f64 = 1e-6;

/// Some iterations of one method with one preconditioning.
struct Trial {
    ended: KrylovEnding,
    /// Iterations that the whole solve needs at this rate.
    needed: f64,
    /// Whether all iterations were made that it was allowed.
    is_used_up: bool,
}

impl LinearSolver {
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
            let trial = self.trial(system, b, x, tolerance, &mut solve.iterations)?;
            system.product.residual(b, x, &mut r)?;
            solve.residual = r.norm()? / norm;
            if solve.residual <= tolerance {
                if self.form == Form::Augmented && self.preconditioning.is_too_weak(trial.needed, self.bordered.is_some()) {
                    self.fall_back(system, trial.needed, &mut solve);
                }
                return Ok(solve);
            }
            // A start from where rounding has left a solve does better, as long as its residual falls.
            let falls = solve.residual < 0.5 * before;
            let may_go_on = solve.iterations < MOST_ITERATIONS;
            let is_stronger = may_go_on && self.strengthen(system, &trial, falls, &mut solve, x)?;
            if !is_stronger && (!falls || !may_go_on || self.is_exact(&solve)) {
                solve.ending = self.ending(system, x, norm, tolerance, &solve, trial.ended)?;
                return Ok(solve);
            }
            before = if is_stronger { f64::INFINITY } else { solve.residual };
        }
    }

    /// Goes on from `x` with the present method and preconditioning, for as many iterations as these have; counts them.
    /// **Collective**
    fn trial(
        &mut self,
        system: &SaddlePoint,
        b: &Vector,
        x: &mut Vector,
        tolerance: f64,
        iterations: &mut usize,
    ) -> Result<Trial, SystemError> {
        if !self.is_set_up {
            self.set_up(system)?;
        }
        let allowed = self.trial_iterations().min(MOST_ITERATIONS - *iterations);
        if let Some(bordered) = self.bordered.as_ref().filter(|bordered| bordered.is_stale()) {
            self.krylov.set_up()?;
            bordered.prepare(system)?;
        }
        self.krylov.set_initial_guess_nonzero(true)?;
        self.krylov.set_tolerance(tolerance, allowed)?;
        let ended = self.krylov.solve_allowing(b, x)?;
        let mut needed = needed(&self.krylov.residual_history(), self.is_short);
        if self.is_short {
            // Its rate is rough: it does not choose more than the next preconditioning.
            needed = needed.min(MOST[1].1);
        }
        *iterations += ended.iterations;
        let is_used_up = ended.iterations >= allowed;
        Ok(Trial { ended, needed, is_used_up })
    }

    /// Puts a stronger method or preconditioning in the place of one that is too slow, and says whether it has. **Collective**
    fn strengthen(
        &mut self,
        system: &SaddlePoint,
        trial: &Trial,
        falls: bool,
        solve: &mut LinearSolve,
        x: &mut Vector,
    ) -> Result<bool, SystemError> {
        if !self.is_short {
            return Ok(trial.is_used_up && trial.needed > 1.0 && self.fall_back(system, trial.needed, solve));
        }
        if falls && !trial.is_used_up {
            return Ok(false);
        }
        self.give_up_short_recurrence(system, trial.needed, solve, x)?;
        Ok(true)
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
