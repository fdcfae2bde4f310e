//! The ladder of ways to solve the augmented system: a solve that is slow or stuck on one rung goes on with a later one.
//!
//! A symmetric Gauss-Seidel sweep smooths well on good triangles and for ν up to about 0.45. Flat triangles and ν towards
//! 0.5 make it slow; four steps of CG with the same sweep are stronger and cost four times as much; a Cholesky factor of
//! `K + BᵀDB` always does, as long as there is memory for it. BiCGStab comes before all of these where it saves time, and GMRES
//! follows it where it does not come to its tolerance.
//!
//! Iterations of all solves together to 1e-8 on example 1, 66 000 unknowns (P1 with `p0`, P2 with `p1-discontinuous`): ν = 0.45
//! 16 and 19; 0.49 11 and 19 (steps); 0.499 9 and 9 (factor); 0.4999 14 and 9 (factor). On needles of 5 degrees (`cases/hard`,
//! 22 000 and 34 000 unknowns), refined towards both corners, 16 to 22. Rounding is the last limit: on example 1 a residual below
//! 1e-8 is reached up to ν = 0.49999, and at 0.499999 it stands at 9e-8.

use super::preconditioning::{LARGEST_FACTOR, Preconditioning};

/// Unknowns of the displacement above which BiCGStab comes before GMRES: it has nine vectors instead of fifteen for
/// ten iterations, so that fewer are cleared and added. To 1e-8 that saves a tenth of a solve at a million unknowns. On smaller
/// systems it saves less, and GMRES may end after every cycle.
pub const MANY: usize = 500_000;

/// Iterations after which a solve has failed.
pub const MOST_ITERATIONS: usize = 300;

/// Iterations to 1e-8 that may be due to rigid motions alone, where some are unknown and not found inside the cycle: a stronger
/// smoother does not save them. Fifteen round triangles and squares whose turns are held, eight of them told to what stands around
/// the cycle: up to 64, with two steps of CG in the place of the sweep as many at three times the cost, and with a factor as many, too.
const OF_MOTIONS: usize = 90;

/// One way to solve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rung {
    /// The Krylov method, by PETSc's name: BiCGStab, GMRES, and GMRES for preconditioners that are not linear.
    pub method: &'static str,
    pub preconditioning: Preconditioning,
    /// Iterations after which a solve without its tolerance is slow.
    pub trial: usize,
    /// Iterations to 1e-8 above which a later rung pays.
    pub most: f64,
    /// Iterations after which a solve has failed, those on earlier rungs among them. One that resists a factor for so long has
    /// lost its inf-sup constant.
    pub last: usize,
}

const BICGSTAB: &str = "fbcgs";

/// The rungs, the cheapest first.
const LADDER: [Rung; 4] = [
    Rung { method: BICGSTAB, preconditioning: Preconditioning::Sweep, trial: 20, most: 26.0, last: MOST_ITERATIONS },
    Rung { method: "gmres", preconditioning: Preconditioning::Sweep, trial: 20, most: 26.0, last: MOST_ITERATIONS },
    Rung { method: "fgmres", preconditioning: Preconditioning::Steps, trial: 40, most: 100.0, last: MOST_ITERATIONS },
    Rung { method: "gmres", preconditioning: Preconditioning::Factor, trial: 60, most: f64::INFINITY, last: 120 },
];

/// A factor of the plain system, which is a ladder of its own.
pub const DIRECT: Rung = Rung { trial: MOST_ITERATIONS, last: MOST_ITERATIONS, ..LADDER[3] };

/// What the user has chosen by options, which stays.
#[derive(Clone, Copy, Debug)]
pub struct Chosen {
    /// The Krylov method, or how it is to work.
    pub method: bool,
    /// What preconditions the displacements.
    pub preconditioning: bool,
}

impl Rung {
    /// Whether its method is BiCGStab.
    pub fn is_short(self) -> bool {
        self.method == BICGSTAB
    }
}

/// The rungs for a system of so many unknowns, from a preconditioning on; `is_bordered` if rigid motions are unknown beside it.
pub fn ladder(first: Preconditioning, unknowns: usize, is_bordered: bool, chosen: Chosen) -> Vec<Rung> {
    let strongest = if unknowns > LARGEST_FACTOR { Preconditioning::Steps } else { Preconditioning::Factor };
    // What a coarser mesh needed may be more than fits here.
    let (first, last) = if chosen.preconditioning { (first, first) } else { (first.min(strongest), strongest) };
    let is_open =
        |rung: &Rung| (first..=last).contains(&rung.preconditioning) && (!rung.is_short() || unknowns > MANY && !chosen.method);
    let least = if is_bordered { OF_MOTIONS } else { 0 };
    let most = |rung: Rung| if chosen.preconditioning { f64::INFINITY } else { rung.most.max(least as f64) };
    let rungs = LADDER.into_iter().filter(is_open);
    rungs.map(|rung| Rung { trial: rung.trial.max(least), most: most(rung), ..rung }).collect()
}

/// How many rungs a solve goes up that needs so many iterations to 1e-8 on the first of these: to the first later one that they
/// are not too many for, or to the last one; `None` if there is no later one.
pub fn climb(rungs: &[Rung], needed: f64) -> Option<usize> {
    let later = || 1..rungs.len();
    later().find(|&k| needed <= rungs[k].most).or(later().last())
}

/// Cycles to a relative residual of 1e-8 at the rate of the second half of a history of residual norms of GMRES, or of all of
/// one of BiCGStab, whose norms may rise, and whose iterations have two cycles. The rate of that one is rough: it calls for no more
/// than steps of CG.
pub fn needed(history: &[f64], is_short: bool) -> f64 {
    let count = history.len();
    if count < 3 {
        return 0.0;
    }
    let (first, cycles, most) = if is_short { (0, 2.0, LADDER[2].most) } else { (count / 2, 1.0, f64::INFINITY) };
    let fall = (history[first] / history[count - 1]).ln() / (count - 1 - first) as f64;
    if fall > 1e-6 { most.min(cycles * 1e8_f64.ln() / fall) } else { most }
}

#[cfg(test)]
mod tests {
    use super::Preconditioning::{Factor, Steps, Sweep};
    use super::*;

    const MILLION: usize = 1_000_000;
    const NOTHING: Chosen = Chosen { method: false, preconditioning: false };

    /// Methods and preconditionings.
    fn kinds(rungs: &[Rung]) -> Vec<(&str, Preconditioning)> {
        rungs.iter().map(|rung| (rung.method, rung.preconditioning)).collect()
    }

    /// What follows the first rung of a ladder.
    fn next(rungs: &[Rung], needed: f64) -> Option<(&str, Preconditioning)> {
        climb(rungs, needed).map(|k| kinds(rungs)[k])
    }

    #[test]
    fn the_rate_tells_the_iterations() {
        let history: Vec<f64> = (0..=20).map(|k| 0.1f64.powf(f64::from(k) / 5.0)).collect();
        assert!((needed(&history, false) - 40.0).abs() < 1e-9);
        assert!((needed(&history, true) - 80.0).abs() < 1e-9, "an iteration of BiCGStab has two cycles");
        assert_eq!(needed(&[1.0; 20], false), f64::INFINITY);
        assert_eq!(needed(&[1.0; 20], true), 100.0, "its rate is rough");
        assert!(needed(&[1.0, 1e-2, 1e-4, 0.9e-4], true) < 26.0, "one step that does little is not the rate");
    }

    #[test]
    fn a_slow_solve_climbs_to_what_is_strong_enough() {
        let rungs = ladder(Sweep, 1000, false, NOTHING);
        assert_eq!(kinds(&rungs), [("gmres", Sweep), ("fgmres", Steps), ("gmres", Factor)]);
        assert_eq!(next(&rungs, 50.0), Some(("fgmres", Steps)));
        for needed in [150.0, 1e9, f64::INFINITY] {
            assert_eq!(next(&rungs, needed), Some(("gmres", Factor)));
        }
        assert_eq!(next(&ladder(Sweep, 10 * MILLION, false, NOTHING), 1e9), Some(("fgmres", Steps)), "no memory for a factor");
        let large = ladder(Factor, 10 * MILLION, false, NOTHING);
        assert_eq!((kinds(&large), next(&large, 1e9)), (vec![("fgmres", Steps)], None), "even if a coarser mesh needed one");
        assert!(rungs[0].most < 27.0 && rungs[1].most > 27.0, "27 iterations are slow with a sweep alone");
    }

    #[test]
    fn many_unknowns_begin_with_a_short_recurrence() {
        let rungs = ladder(Sweep, MILLION, false, NOTHING);
        assert!(rungs[0].is_short() && !ladder(Steps, MILLION, false, NOTHING)[0].is_short());
        assert_eq!([10.0, 27.0].map(|needed| next(&rungs, needed)), [Some(("gmres", Sweep)), Some(("fgmres", Steps))]);
        let bordered = ladder(Sweep, MILLION, true, NOTHING);
        assert_eq!([27.0, 91.0].map(|needed| next(&bordered, needed)), [Some(("gmres", Sweep)), Some(("fgmres", Steps))]);
        assert!(bordered.iter().all(|rung| rung.trial == OF_MOTIONS));
    }

    #[test]
    fn what_the_user_has_chosen_stays() {
        let rungs = ladder(Sweep, MILLION, false, Chosen { preconditioning: true, method: false });
        assert_eq!(kinds(&rungs), [("fbcgs", Sweep), ("gmres", Sweep)]);
        assert!(rungs.iter().all(|rung| rung.most == f64::INFINITY), "no later rung pays");
        let rungs = ladder(Sweep, MILLION, false, Chosen { preconditioning: true, method: true });
        assert_eq!(kinds(&rungs), [("gmres", Sweep)]);
        assert_eq!(ladder(Sweep, MILLION, false, Chosen { method: true, ..NOTHING })[0].method, "gmres");
    }
}
