//! Preconditioners of the displacements, and which one a slow solve falls back on.
//!
//! A symmetric Gauss-Seidel sweep smooths well on good triangles and for ν up to about 0.45. Flat triangles and ν towards
//! 0.5 make it slow; two or four steps of CG with the same sweep are stronger and cost two and four times as much; a
//! Cholesky factor of `K + BᵀDB` always does, as long as there is memory for it.
//!
//! Iterations of all solves together to 1e-8 on example 1, 17 000 unknowns (P1 with `p0`, P2 with `p1-discontinuous`): ν = 0.45
//! 16 and 21; 0.49 25 and 36 (two steps); 0.499 34 and 31 (factor); 0.4999 52 and 33 (factor). On needles of 5 degrees
//! (`cases/hard`, 34 000 unknowns), refined towards both corners, 20 to 28 and 28 to 38 on the finest mesh, with two steps from
//! the coarsest on. Rounding is the last limit: on example 1 a residual below 1e-8 is reached up to ν = 0.49999, and at 0.499999
//! it stands at 9e-8.

use crate::discretisation::SMALL;

/// Iterations that a solve to 1e-8 may need before the next one pays.
pub(super) const MOST: [(Preconditioning, f64); 3] =
    [(Preconditioning::Sweep, 26.0), (Preconditioning::TwoSteps, 100.0), (Preconditioning::FourSteps, 180.0)];

/// Iterations of a sweep that may be due to rigid motions alone, where some are unknown. Fourteen discs, and a bearing whose rollers
/// turn: up to 17 and 35, with two steps of CG in the place of the sweep as many, at three times the cost.
pub(super) const MOST_BORDERED: usize = 60;

/// Unknowns up to which a factor fits into memory.
const LARGEST_FACTOR: usize = 3_000_000;

/// What preconditions the displacements.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Preconditioning {
    /// Multigrid with one symmetric Gauss-Seidel sweep.
    Sweep,
    /// Multigrid with two steps of CG, preconditioned by the sweep.
    TwoSteps,
    /// Multigrid with four.
    FourSteps,
    /// A Cholesky factor.
    Factor,
}

/// Ratio of graded refinement below which triangles are too flat for a sweep: it needs more iterations on each level.
const FLAT: f64 = 0.25;

impl Preconditioning {
    /// The cheapest one that does on a mesh of so many levels, the macro mesh among them, refined by these ratios.
    pub fn of(levels: usize, ratios: &[Option<f64>]) -> Self {
        let flat = levels > 1 && ratios.iter().flatten().any(|&ratio| ratio < FLAT);
        if flat { Self::TwoSteps } else { Self::Sweep }
    }

    /// Where to begin if the choice is free, and why, in words; levels and ratios as in [`Self::of`].
    pub fn first(levels: usize, ratios: &[Option<f64>], unknowns: usize) -> (Self, String) {
        let preconditioning = Self::of(levels, ratios);
        if levels > 1 {
            let flat = format!(" and some mesh.grade.ratio is below {FLAT}");
            let flat = if preconditioning == Self::Sweep { "" } else { &flat };
            let words = preconditioning.words("multigrid");
            return (preconditioning, format!("fieldsplit with {words}, because the mesh has {levels} levels{flat}"));
        }
        let begin = format!("because the mesh has no levels (refine = 0), and {unknowns} unknowns are");
        if unknowns <= SMALL {
            (Self::Factor, format!("fieldsplit with a Cholesky factor, {begin} no more than {SMALL}"))
        } else {
            (Self::Sweep, format!("fieldsplit with multigrid on auxiliary levels, {begin} more than {SMALL}"))
        }
    }

    /// Iterations after which it is asked whether to fall back on a stronger one.
    pub fn trial_iterations(self) -> usize {
        match self {
            Self::Sweep => 20,
            Self::TwoSteps => 40,
            Self::FourSteps | Self::Factor => 60,
        }
    }

    /// The one to fall back on for a system of `unknowns` that this one would need so many iterations for, from here to 1e-8:
    /// at least the next one, if there is any.
    pub fn fallback(self, needed: f64, unknowns: usize) -> Option<Self> {
        let stronger = [Self::TwoSteps, Self::FourSteps, Self::Factor];
        let fits = |other: &Self| *other > self && (*other != Self::Factor || unknowns <= LARGEST_FACTOR);
        let stronger: Vec<Self> = stronger.into_iter().filter(fits).collect();
        let is_enough = |other: &&Self| match self {
            Self::Sweep => MOST.iter().all(|(bounded, most)| bounded != *other || needed <= *most),
            _ => true,
        };
        stronger.iter().find(is_enough).or(stronger.last()).copied()
    }

    /// Whether a solve at this rate leaves the next one to a stronger preconditioning. Iterations that rigid motions take, which
    /// are unknown beside the blocks (`is_bordered`), are not saved by a stronger smoother.
    pub fn is_too_weak(self, needed: f64, is_bordered: bool) -> bool {
        self == Self::Sweep && needed > if is_bordered { MOST_BORDERED as f64 } else { MOST[0].1 }
    }

    /// What it does, after the name of the cycle.
    pub fn words(self, cycle: &str) -> String {
        match self {
            Self::Sweep => cycle.to_string(),
            Self::TwoSteps => format!("{cycle}, smoothed by 2 CG steps"),
            Self::FourSteps => format!("{cycle}, smoothed by 4 CG steps"),
            Self::Factor => "Cholesky factor".to_string(),
        }
    }
}

/// Cycles to a relative residual of 1e-8 at the rate of the second half of a history of residual norms of GMRES, or of all of
/// one of BiCGStab, whose norms may rise, and whose iterations have two cycles.
pub fn needed(history: &[f64], is_short: bool) -> f64 {
    let count = history.len();
    if count < 3 {
        return 0.0;
    }
    let (first, cycles) = if is_short { (0, 2.0) } else { (count / 2, 1.0) };
    let fall = (history[first] / history[count - 1]).ln() / (count - 1 - first) as f64;
    if fall > 1e-6 { cycles * 1e8_f64.ln() / fall } else { f64::INFINITY }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rate_tells_the_iterations() {
        let history: Vec<f64> = (0..=20).map(|k| 0.1f64.powf(f64::from(k) / 5.0)).collect();
        assert!((needed(&history, false) - 40.0).abs() < 1e-9);
        assert!((needed(&history, true) - 80.0).abs() < 1e-9, "an iteration of BiCGStab has two cycles");
        assert_eq!(needed(&[1.0; 20], false), f64::INFINITY);
        assert!(needed(&[1.0, 1e-2, 1e-4, 0.9e-4], true) < 26.0, "one step that does little is not the rate");
    }

    #[test]
    fn a_small_mesh_without_levels_begins_with_a_factor() {
        assert_eq!(Preconditioning::first(1, &[None], 2000).0, Preconditioning::Factor);
        assert_eq!(Preconditioning::first(1, &[None], 10_000).0, Preconditioning::Sweep);
        assert_eq!(Preconditioning::first(3, &[None], 10_000).0, Preconditioning::Sweep);
    }

    #[test]
    fn flat_triangles_begin_with_the_stronger_smoother() {
        let (preconditioning, words) = Preconditioning::first(3, &[None, Some(0.4), Some(0.2)], 10_000);
        assert_eq!((preconditioning, Preconditioning::of(3, &[Some(0.3)])), (Preconditioning::TwoSteps, Preconditioning::Sweep));
        assert!(words.contains("smoothed by 2 CG steps, because the mesh has 3 levels and some mesh.grade.ratio"), "{words}");
        assert_eq!(Preconditioning::of(1, &[Some(0.2)]), Preconditioning::Sweep, "not refined at all");
    }

    #[test]
    fn a_slow_solve_falls_back_on_what_is_strong_enough() {
        assert_eq!(Preconditioning::Sweep.fallback(50.0, 1000), Some(Preconditioning::TwoSteps));
        assert_eq!(Preconditioning::Sweep.fallback(150.0, 1000), Some(Preconditioning::FourSteps));
        assert_eq!(Preconditioning::Sweep.fallback(1e9, 1000), Some(Preconditioning::Factor));
        assert_eq!(Preconditioning::Sweep.fallback(1e9, 10_000_000), Some(Preconditioning::FourSteps), "no memory for a factor");
        assert_eq!(Preconditioning::Factor.fallback(1e9, 1000), None);
        assert!(Preconditioning::Sweep.is_too_weak(27.0, false) && !Preconditioning::TwoSteps.is_too_weak(27.0, false));
    }
}
