//! The contact problem as the convex quadratic programme that it is, once displacements are eliminated body by body.
//!
//! ```text
//! min ½ λᵀ S λ - λᵀ p     S = B K⁺ Bᵀ,  p = B K⁺ f - c,  λ >= 0 where contact can only push
//! with G λ = e            for each rigid motion R that nothing else holds: G = (B R)ᵀ, e = Rᵀ f
//! ```
//! Its optimality conditions are those of contact: the gap `c - B u = S λ - p - Gᵀ a >= 0` with the motions `a`, and `λ` times the
//! gap zero. It is solved by an interior-point method (`clarabel`; Goulart, Chen, arXiv:2405.12762), which has no set to begin
//! with and none to lose: bodies that hold each other, touch without force, or are held by more contacts than balance needs are all
//! the same to it. Where no forces balance the loads there is a motion that every contact lets go and that the loads drive.

use clarabel::algebra::CscMatrix;
use clarabel::solver::{
    DefaultSettings, DefaultSettingsBuilder, DefaultSolution, DefaultSolver, IPSolver, NonnegativeConeT, SolverStatus, ZeroConeT,
};

/// Relative accuracy of the programme: below what any mesh that it is solved on is good for.
const TOLERANCE: f64 = 1e-9;

/// The programme of some multipliers and of the rigid motions that they alone hold.
#[derive(Clone, Debug, Default)]
pub struct Programme {
    /// Entries of `S` on and above its diagonal, each place once: row, column, value.
    pub compliance: Vec<(usize, usize, f64)>,
    /// `p`: penetration of each multiplier under the loads alone, all motions at rest.
    pub penetration: Vec<f64>,
    /// Whether each multiplier can only push.
    pub pushes: Vec<bool>,
    /// Entries of `G`: motion, multiplier, penetration by the unit motion.
    pub resistance: Vec<(usize, usize, f64)>,
    /// `e`: work of the loads in each unit motion.
    pub driven: Vec<f64>,
}

/// What came of a programme.
#[derive(Clone, Debug, PartialEq)]
pub enum ProgrammeOutcome {
    /// The forces balance the loads.
    Found {
        /// `λ` of each multiplier.
        multipliers: Vec<f64>,
        /// Gap of each multiplier, as its row of `B` measures it.
        gaps: Vec<f64>,
        /// Each rigid motion.
        motions: Vec<f64>,
    },
    /// No forces do. The smallest motion with work one that no contact resists.
    Driven(Vec<f64>),
    /// The interior-point method has ended without either, with these words.
    Unsolved(String),
}

impl Programme {
    /// Solves the programme: the forces, gaps and motions, or the motion that no contact resists.
    pub fn solve(&self) -> ProgrammeOutcome {
        let count = self.penetration.len();
        if count == 0 && self.driven.is_empty() {
            return ProgrammeOutcome::Found { multipliers: Vec::new(), gaps: Vec::new(), motions: Vec::new() };
        }
        if self.is_at_rest() {
            let gaps = self.penetration.iter().map(|depth| -depth).collect();
            return ProgrammeOutcome::Found { multipliers: vec![0.0; count], gaps, motions: vec![0.0; self.driven.len()] };
        }
        let scales = self.scales();
        let Scales { multiplier, motion, force } = &scales;
        let entries = self.compliance.iter().map(|&(i, j, value)| (i.min(j), i.max(j), value * multiplier[i] * multiplier[j]));
        let quadratic = sparse(count, count, entries.collect());
        let linear: Vec<f64> = (0..count).map(|i| -self.penetration[i] * multiplier[i] / force).collect();
        let pushing: Vec<usize> = (0..count).filter(|&i| self.pushes[i]).collect();
        let equations = self.driven.len();
        let mut rows: Vec<(usize, usize, f64)> =
            self.resistance.iter().map(|&(k, i, value)| (k, i, value * motion[k] * multiplier[i])).collect();
        rows.extend(pushing.iter().enumerate().map(|(at, &i)| (equations + at, i, -1.0)));
        let constraints = sparse(equations + pushing.len(), count, rows);
        let mut right: Vec<f64> = self.driven.iter().zip(motion).map(|(work, scale)| work * scale / force).collect();
        right.resize(equations + pushing.len(), 0.0);
        let solution = interior_point((&quadratic, &linear), (&constraints, &right), [equations, pushing.len()]);
        match solution {
            Ok(solution) if is_solved(solution.status) => self.found(&solution, &pushing, &scales),
            Ok(solution) => self.escape(motion).unwrap_or_else(|| ProgrammeOutcome::Unsolved(format!("{:?}", solution.status))),
            Err(words) => ProgrammeOutcome::Unsolved(words),
        }
    }

    /// Whether nothing drives the bodies and none lies in another: they stay where they are. Among all places that are as good the
    /// method would choose one far off.
    fn is_at_rest(&self) -> bool {
        let is_open = |(depth, pushes): (&f64, &bool)| *depth == 0.0 || *pushes && *depth < 0.0;
        self.driven.iter().all(|work| *work == 0.0) && self.penetration.iter().zip(&self.pushes).all(is_open)
    }

    /// Multipliers, gaps and motions from those that are scaled.
    fn found(&self, solution: &DefaultSolution<f64>, pushing: &[usize], scales: &Scales) -> ProgrammeOutcome {
        let Scales { multiplier, motion, force } = scales;
        let multipliers = solution.x.iter().zip(multiplier).map(|(value, scale)| value * scale * force).collect();
        let motions = motion.iter().enumerate().map(|(k, scale)| -solution.z[k] * scale * force).collect();
        let mut gaps = vec![0.0; multiplier.len()];
        for (at, &i) in pushing.iter().enumerate() {
            gaps[i] = solution.z[self.driven.len() + at] * force / multiplier[i];
        }
        ProgrammeOutcome::Found { multipliers, gaps, motions }
    }

    /// The smallest motion of work one that no contact resists: `Gᵀ a <= 0`, or `= 0` where contact pulls, too. Nothing if there is
    /// none.
    fn escape(&self, scale: &[f64]) -> Option<ProgrammeOutcome> {
        let (count, multipliers) = (self.driven.len(), self.penetration.len());
        let largest = self.driven.iter().zip(scale).map(|(work, scale)| (work * scale).abs()).fold(0.0, f64::max);
        if largest == 0.0 {
            return None;
        }
        let quadratic = sparse(count, count, (0..count).map(|k| (k, k, 1.0)).collect());
        // Equations first: the work, and what contacts of both directions hold.
        let mut order: Vec<usize> = (0..multipliers).filter(|&i| !self.pushes[i]).collect();
        let equations = 1 + order.len();
        order.extend((0..multipliers).filter(|&i| self.pushes[i]));
        let mut place = vec![0; multipliers];
        order.iter().enumerate().for_each(|(at, &i)| place[i] = 1 + at);
        let mut size = vec![f64::MIN_POSITIVE; multipliers];
        let resisted = || self.resistance.iter().map(|&(k, i, value)| (k, i, value * scale[k]));
        resisted().for_each(|(_, i, value)| size[i] = size[i].max(value.abs()));
        let work = self.driven.iter().enumerate().map(|(k, work)| (0, k, work * scale[k] / largest));
        let rows = work.chain(resisted().map(|(k, i, value)| (place[i], k, value / size[i]))).collect();
        let mut right = vec![0.0; 1 + multipliers];
        right[0] = 1.0;
        let constraints = sparse(1 + multipliers, count, rows);
        let solution =
            interior_point((&quadratic, &vec![0.0; count]), (&constraints, &right), [equations, 1 + multipliers - equations]);
        let solution = solution.ok().filter(|solution| is_solved(solution.status))?;
        Some(ProgrammeOutcome::Driven(solution.x.iter().zip(scale).map(|(value, scale)| value * scale / largest).collect()))
    }

    /// What makes entries and unknowns about one: a unit diagonal of `S`, unit rows of `G`, and forces by the largest load, or, where the
    /// loads drive nothing, by what presses bodies into each other that stay where they are.
    fn scales(&self) -> Scales {
        let mut diagonal = vec![0.0f64; self.penetration.len()];
        self.compliance.iter().filter(|(i, j, _)| i == j).for_each(|&(i, _, value)| diagonal[i] = value);
        let stiffest = diagonal.iter().copied().filter(|value| *value > 0.0).fold(f64::INFINITY, f64::min);
        let least = if stiffest.is_finite() { stiffest } else { 1.0 };
        let multiplier: Vec<f64> = diagonal.iter().map(|value| value.max(least).sqrt().recip()).collect();
        let mut rows = vec![0.0f64; self.driven.len()];
        self.resistance.iter().for_each(|&(k, i, value)| rows[k] = rows[k].max((value * multiplier[i]).abs()));
        let motion: Vec<f64> = rows.iter().map(|row| if *row > 0.0 { row.recip() } else { 1.0 }).collect();
        let drives = self.driven.iter().zip(&motion).map(|(work, scale)| (work * scale).abs());
        let both = |i: usize| if self.pushes[i] { self.penetration[i] } else { self.penetration[i].abs() };
        let drawn = (0..multiplier.len()).map(|i| both(i) * multiplier[i]).fold(0.0, f64::max);
        let loads = drives.fold(0.0, f64::max);
        // Loads that balance each other, as a pressure all around, leave a resultant of rounding.
        let force = if loads > TOLERANCE * drawn { loads } else { drawn };
        Scales { multiplier, motion, force: if force > 0.0 { force } else { 1.0 } }
    }
}

/// Scales of the unknowns of a programme.
struct Scales {
    multiplier: Vec<f64>,
    motion: Vec<f64>,
    force: f64,
}

fn is_solved(status: SolverStatus) -> bool {
    matches!(status, SolverStatus::Solved | SolverStatus::AlmostSolved)
}

/// Entries of a matrix or of a vector, each place once, in the order of their keys.
pub fn added_up<K: Ord>(mut entries: Vec<(usize, usize, f64)>, key: impl Fn(usize, usize) -> K) -> Vec<(usize, usize, f64)> {
    entries.sort_unstable_by_key(|&(i, j, _)| key(i, j));
    entries.dedup_by(|next, kept| {
        let is_same = (next.0, next.1) == (kept.0, kept.1);
        kept.2 += if is_same { next.2 } else { 0.0 };
        is_same
    });
    entries
}

/// A matrix by its entries, each place once or several times.
fn sparse(rows: usize, columns: usize, entries: Vec<(usize, usize, f64)>) -> CscMatrix<f64> {
    let entries = added_up(entries, |i, j| (j, i));
    let starts = (0..=columns).map(|column| entries.partition_point(|(_, j, _)| *j < column)).collect();
    let (places, values) = entries.into_iter().map(|(i, _, value)| (i, value)).unzip();
    CscMatrix::new(rows, columns, starts, places, values)
}

/// `min ½ xᵀ P x + qᵀ x` with `A x = b` in the first rows and `A x <= b` in the others.
fn interior_point(
    (quadratic, linear): (&CscMatrix<f64>, &[f64]),
    (constraints, right): (&CscMatrix<f64>, &[f64]),
    [equations, inequalities]: [usize; 2],
) -> Result<DefaultSolution<f64>, String> {
    let settings: DefaultSettings<f64> = DefaultSettingsBuilder::default()
        .verbose(false)
        .max_threads(1)
        .tol_gap_abs(TOLERANCE)
        .tol_gap_rel(TOLERANCE)
        .tol_feas(TOLERANCE)
        .build()
        .map_err(|error| error.to_string())?;
    let cones = [ZeroConeT(equations), NonnegativeConeT(inequalities)];
    let mut solver =
        DefaultSolver::new(quadratic, linear, constraints, right, &cones, settings).map_err(|error| error.to_string())?;
    solver.solve();
    Ok(solver.solution)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A block of weight 1 on two springs of compliance 1 and 2 at x = -1 and x = 2 from its middle, free to move up and to turn,
    /// and a third contact that a gap keeps open; pushed sideways by `side`.
    fn block(side: f64) -> Programme {
        Programme {
            compliance: vec![(0, 0, 1.0), (1, 1, 2.0), (2, 2, 1.0)],
            penetration: vec![0.0, 0.0, -5.0],
            pushes: vec![true; 3],
            resistance: vec![(0, 0, -1.0), (0, 1, -1.0), (0, 2, 1.0), (1, 0, 1.0), (1, 1, -2.0), (2, 2, 0.0)],
            driven: vec![-1.0, 0.0, side],
        }
    }

    #[test]
    fn forces_follow_from_balance_and_open_contacts_carry_nothing() {
        let ProgrammeOutcome::Found { multipliers, gaps, motions } = block(0.0).solve() else { panic!("it stands") };
        let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-7, "{a} instead of {b}");
        near(multipliers[0], 2.0 / 3.0);
        near(multipliers[1], 1.0 / 3.0);
        near(multipliers[2], 0.0);
        gaps[..2].iter().for_each(|gap| near(*gap, 0.0));
        // It sinks by 2/3 under both springs, level.
        near(motions[0], -2.0 / 3.0);
        near(motions[1], 0.0);
        near(gaps[2], 5.0 + 2.0 / 3.0);
    }

    #[test]
    fn loads_that_no_contact_balances_are_told_by_the_motion_they_drive() {
        let ProgrammeOutcome::Driven(motion) = block(3.0).solve() else { panic!("nothing holds it sideways") };
        assert!(motion[0].abs() < 1e-6 && motion[1].abs() < 1e-6 && (motion[2] - 1.0 / 3.0).abs() < 1e-6, "{motion:?}");
        let mut lifted = Programme { driven: vec![1.0, 0.0, 0.0], ..block(0.0) };
        assert!(matches!(lifted.solve(), ProgrammeOutcome::Found { .. }), "the third contact holds it");
        lifted.resistance.retain(|(_, i, _)| *i < 2);
        let ProgrammeOutcome::Driven(motion) = lifted.solve() else { panic!("it flies off") };
        assert!(motion[0] > 0.0, "{motion:?}");
    }

    #[test]
    fn bodies_that_nothing_drives_stay_where_they_are() {
        let still = Programme { driven: vec![0.0; 3], ..block(0.0) };
        let wanted = ProgrammeOutcome::Found { multipliers: vec![0.0; 3], gaps: vec![0.0, 0.0, 5.0], motions: vec![0.0; 3] };
        let ProgrammeOutcome::Found { multipliers, gaps, motions } = still.solve() else { panic!("it stands") };
        let gaps = gaps.into_iter().map(|gap| gap + 0.0).collect();
        assert_eq!(ProgrammeOutcome::Found { multipliers, gaps, motions }, wanted);
    }

    /// A block that lies in both jaws of a vice by .5, on loads that balance each other but for rounding.
    #[test]
    fn a_resultant_of_rounding_sets_no_scale() {
        let vice = |work: f64| Programme {
            compliance: vec![(0, 0, 1.0), (1, 1, 1.0)],
            penetration: vec![0.5, 0.5],
            pushes: vec![true; 2],
            resistance: vec![(0, 0, -1.0), (0, 1, 1.0)],
            driven: vec![work],
        };
        for work in [0.0, 1e-15, -1e-14, 1e-12] {
            let ProgrammeOutcome::Found { multipliers, motions, .. } = vice(work).solve() else {
                panic!("both jaws hold it: {work}")
            };
            assert!(multipliers.iter().all(|force| (force - 0.5).abs() < 1e-7) && motions[0].abs() < 1e-7, "{multipliers:?}");
        }
    }

    #[test]
    fn a_programme_in_other_units_has_the_same_forces() {
        let small = |programme: Programme| Programme {
            compliance: programme.compliance.iter().map(|&(i, j, value)| (i, j, 1e-40 * value)).collect(),
            penetration: programme.penetration.iter().map(|value| 1e-20 * value).collect(),
            driven: programme.driven.iter().map(|value| 1e20 * value).collect(),
            ..programme
        };
        let ProgrammeOutcome::Found { multipliers, .. } = small(block(0.0)).solve() else { panic!("it stands") };
        assert!((multipliers[0] - 2e20 / 3.0).abs() < 1e13, "{multipliers:?}");
    }
}
