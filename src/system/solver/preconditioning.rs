//! Preconditioners of the displacements.

use crate::discretisation::SMALL;
use std::collections::BTreeMap;

/// What preconditions the displacements, the weakest first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Preconditioning {
    /// Multigrid with one symmetric Gauss-Seidel sweep.
    Sweep,
    /// Multigrid with a few steps of CG, preconditioned by the sweep.
    Steps,
    /// A Cholesky factor.
    Factor,
}

/// Steps of CG of one smoothing. Thin shells of revolution (P2, ν = 0.49, two ranks, 1.5·10⁴ to 3.4·10⁶ unknowns) take 16 to 18
/// iterations with two, 11 to 14 with three and 8 to 10 with four; flat needles 24, 16 and 13, upright ones of P2 25, 22 and 21.
/// Seconds are alike to a fifth.
const STEPS: usize = 4;

/// Ratio of graded refinement below which triangles are too flat for a sweep: it needs more iterations on each level.
const FLAT: f64 = 0.25;

impl Preconditioning {
    /// The cheapest one that does on a mesh of so many levels, the macro mesh among them, refined by these ratios at vertices.
    pub fn of(levels: usize, ratios: &BTreeMap<u32, f64>) -> Self {
        let flat = levels > 1 && ratios.values().any(|&ratio| ratio < FLAT);
        if flat { Self::Steps } else { Self::Sweep }
    }

    /// Where to begin if the choice is free, and why, in words; levels and ratios as in [`Self::of`].
    pub fn first(levels: usize, ratios: &BTreeMap<u32, f64>, unknowns: usize) -> (Self, String) {
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

    /// Steps of CG that smooth in the place of one sweep.
    pub fn conjugate_steps(self) -> usize {
        match self {
            Self::Sweep | Self::Factor => 0,
            Self::Steps => STEPS,
        }
    }

    /// What it does, after the name of the cycle.
    pub fn words(self, cycle: &str) -> String {
        match self {
            Self::Sweep => cycle.to_string(),
            Self::Steps => format!("{cycle}, smoothed by {STEPS} CG steps"),
            Self::Factor => "Cholesky factor".to_string(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_small_mesh_without_levels_begins_with_a_factor() {
        let even = BTreeMap::new();
        assert_eq!(Preconditioning::first(1, &even, 2000).0, Preconditioning::Factor);
        assert_eq!(Preconditioning::first(1, &even, 10_000).0, Preconditioning::Sweep);
        assert_eq!(Preconditioning::first(3, &even, 10_000).0, Preconditioning::Sweep);
    }

    #[test]
    fn flat_triangles_begin_with_the_stronger_smoother() {
        let (preconditioning, words) = Preconditioning::first(3, &[(1, 0.4), (2, 0.2)].into(), 10_000);
        assert_eq!(
            (preconditioning, Preconditioning::of(3, &[(0, 0.3)].into())),
            (Preconditioning::Steps, Preconditioning::Sweep)
        );
        assert!(words.contains("smoothed by 4 CG steps, because the mesh has 3 levels and some mesh.grade.ratio"), "{words}");
        assert_eq!(Preconditioning::of(1, &[(0, 0.2)].into()), Preconditioning::Sweep, "not refined at all");
    }
}
