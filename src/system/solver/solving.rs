//! Solves to a tolerance: trials on one rung after the other.

use super::ladder::{MOST_ITERATIONS, needed};
use super::linear_solve::{LinearEnding, LinearSolve, Residual};
use super::linear_solver::LinearSolver;
use super::prepared::Prepared;
use crate::discretisation::SystemError;
use crate::petsc::{KrylovEnding, Vector, WatchedSolve};
use crate::system::saddle_point::SaddlePoint;

/// Relative residual above which rounding is no excuse.
pub const MOST_ROUNDING: f64 = 1e-6;

impl LinearSolver {
    /// Solves from the `x` that is given, until the residual is below `tolerance |b|` or rounding stops it; a solve that
    /// is slow or stuck goes up the ladder, and later ones begin there. `known` is the residual of this `x`, if somebody knows it;
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
            let rung = self.rung();
            let allowed = rung.trial.min(MOST_ITERATIONS - solve.iterations);
            let (ended, needed) = self.trial(system, b, x, tolerance, allowed)?;
            solve.iterations += ended.iterations;
            system.product.residual(b, x, &mut r)?;
            solve.residual = r.norm()? / norm;
            if solve.residual <= tolerance {
                if needed > rung.most {
                    self.climb(needed, &mut solve);
                }
                return Ok(solve);
            }
            // A start from where rounding has left a solve does better, as long as its residual falls. What GMRES gets stuck at is
            // rounding, which no rung mends; the residual that BiCGStab knows is no longer the true one before that.
            let falls = solve.residual < 0.5 * before;
            let is_slow_or_stuck = ended.iterations >= allowed || !falls && rung.is_short();
            if is_slow_or_stuck && solve.iterations < MOST_ITERATIONS && self.climb(needed, &mut solve) {
                if solve.residual.is_nan() || solve.residual > 1.0 {
                    x.set(0.0)?;
                }
                before = f64::INFINITY;
            } else if falls && solve.iterations < rung.last {
                before = solve.residual;
            } else {
                solve.ending = self.ending(system, x, norm, tolerance, &solve, ended)?;
                return Ok(solve);
            }
        }
    }

    /// Goes on from `x` on the present rung, for so many iterations at most. Those that a whole solve needs at this rate come with
    /// how it ended. **Collective**
    fn trial(
        &mut self,
        system: &SaddlePoint,
        b: &Vector,
        x: &mut Vector,
        tolerance: f64,
        allowed: usize,
    ) -> Result<(KrylovEnding, f64), SystemError> {
        let rung = self.rung();
        let Prepared { krylov, bordered, .. } = self.prepare(system)?;
        if let Some(bordered) = bordered.as_ref().filter(|bordered| bordered.is_stale()) {
            krylov.set_up()?;
            bordered.prepare(system)?;
        }
        krylov.set_initial_guess_nonzero(true)?;
        krylov.set_tolerance(tolerance, allowed)?;
        let ended = krylov.solve_allowing(b, x)?;
        Ok((ended, needed(&krylov.residual_history(), rung.is_short())))
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
