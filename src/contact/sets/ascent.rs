//! Active sets of rising energy: what finds the set where the plain rule goes round, or on and on.
//!
//! With `Σ = B K⁻¹ Bᵀ + C` and the penetration `d - Σλ` the pressures are the λ ≥ 0 of the largest dual energy
//! `dᵀλ - ½ λᵀΣλ`. The plain rule releases and adds multipliers at once, and its energy may fall: for the compliance of
//! slender bodies, which is far from diagonal, it wanders for hundreds of sets. Here pulling multipliers are released first,
//! until none is left: that is a point with λ ≥ 0 where the energy is largest on its set. If it is higher than the last such
//! point, all that penetrate there are added; if not, a quarter of those that were added before, in the end one alone.
//! One added multiplier raises the energy if those it makes pull are released one by one, where they pass zero on the way.
//! So no such point comes back, and the search ends, whatever the compliance.
//!
//! Sources: Lawson, Hanson, Solving Least Squares Problems (1974), chapter 23; Hungerländer, Rendl, SIAM Journal on
//! Optimization 25 (2015), 1633-1659.
//!
//! Turned down were loading in steps (the set on the way is as hard to find as the last one, and a gap does not scale with the
//! load), damping (no proof), and an interior-point method (15 to 20 solves, too, with other matrices for each). Tried on 40
//! seats of a slender leaf, 190 multipliers, flat and wavy, solved densely: the plain rule took 84 sets from all closed (median;
//! 124 at most), principal pivoting with a safeguard (Kim, Park) up to 623, rising energy 13 (18 at most), from any first set.

/// Factor by which fewer multipliers are added where the energy has not risen.
const REDUCTION: usize = 4;

/// What was solved for a set, for every multiplier.
#[derive(Clone, Copy, Debug)]
pub struct SetSolution<'a> {
    /// Pressures, zero on the open ones (stress).
    pub lambda: &'a [f64],
    /// `(Bu - Cλ - c)_i` (length squared).
    pub penetration: &'a [f64],
    /// Pressure that one unit of penetration is worth (stress per length squared).
    pub penalty: &'a [f64],
}

/// A set without pulling multipliers, and what was solved for it.
#[derive(Clone, Debug)]
struct Highest {
    active: Vec<bool>,
    lambda: Vec<f64>,
    penetration: Vec<f64>,
}

/// State of the search.
#[derive(Clone, Debug, Default)]
pub struct Ascent {
    highest: Option<Highest>,
    /// How many multipliers were added to the highest set.
    added: usize,
    /// λ ≥ 0 on the way from the highest point to the next, while only one multiplier is added.
    way: Option<Vec<f64>>,
}

impl Ascent {
    /// Before anything is solved.
    pub fn new() -> Self {
        Self::default()
    }

    /// The set to be solved for next; nothing if the energy rises no more.
    pub fn next(&mut self, active: &[bool], bilateral: &[bool], solution: &SetSolution) -> Option<Vec<bool>> {
        let pulls = |i: &usize| active[*i] && !bilateral[*i] && solution.lambda[*i] < 0.0;
        let pulling: Vec<usize> = (0..active.len()).filter(pulls).collect();
        if !pulling.is_empty() {
            let mut next = active.to_vec();
            self.released(&pulling, solution).into_iter().for_each(|i| next[i] = false);
            return Some(next);
        }
        let rises = self.highest.as_ref().is_none_or(|highest| highest.gain(active, solution) > 0.0);
        if rises {
            let (lambda, penetration) = (solution.lambda.to_vec(), solution.penetration.to_vec());
            self.highest = Some(Highest { active: active.to_vec(), lambda, penetration });
            self.added = usize::MAX;
        } else if self.added <= 1 {
            return None;
        } else {
            self.added = (self.added / REDUCTION).max(1);
        }
        let highest = self.highest.as_ref()?;
        let mut penetrating: Vec<usize> =
            (0..active.len()).filter(|&i| !highest.active[i] && highest.penetration[i] > 0.0).collect();
        if penetrating.is_empty() {
            return None;
        }
        let depth = |i: usize| solution.penalty[i] * highest.penetration[i];
        penetrating.sort_by(|&a, &b| depth(b).total_cmp(&depth(a)));
        penetrating.truncate(self.added);
        self.added = penetrating.len();
        self.way = (self.added == 1).then(|| highest.lambda.clone());
        let mut next = highest.active.clone();
        penetrating.into_iter().for_each(|i| next[i] = true);
        Some(next)
    }

    /// Which of the pulling multipliers are released: all of them, or on the way from one point to the next those that pass
    /// zero first.
    fn released(&mut self, pulling: &[usize], solution: &SetSolution) -> Vec<usize> {
        let Some(way) = &mut self.way else { return pulling.to_vec() };
        let share = |way: &[f64], i: usize| way[i] / (way[i] - solution.lambda[i]);
        let first = pulling.iter().map(|&i| share(way, i)).fold(1.0, f64::min);
        let released = pulling.iter().copied().filter(|&i| share(way, i) <= first).collect();
        way.iter_mut().zip(solution.lambda).for_each(|(value, goal)| *value = (*value + first * (goal - *value)).max(0.0));
        released
    }
}

impl Highest {
    /// How much higher the dual energy of another set is (twice, per depth): `(p + p')ᵀ(λ' - λ)`, because the penetration p
    /// is the gradient of the energy; p is zero on its own set.
    fn gain(&self, active: &[bool], solution: &SetSolution) -> f64 {
        let pairs = (0..active.len()).map(|i| match (self.active[i], active[i]) {
            (false, true) => self.penetration[i] * solution.lambda[i],
            (true, false) => -solution.penetration[i] * self.lambda[i],
            _ => 0.0,
        });
        pairs.sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{DMatrix, DVector};

    /// Solves for λ on a set, and the penetration.
    fn solved(compliance: &DMatrix<f64>, d: &DVector<f64>, active: &[bool]) -> (Vec<f64>, Vec<f64>) {
        let own: Vec<usize> = (0..active.len()).filter(|&i| active[i]).collect();
        let mut lambda = DVector::zeros(active.len());
        if !own.is_empty() {
            let part = compliance.select_rows(&own).select_columns(&own);
            let values = part.cholesky().expect("positive definite").solve(&d.select_rows(&own));
            own.iter().zip(&values).for_each(|(&i, &value)| lambda[i] = value);
        }
        let penetration = d - compliance * &lambda;
        (lambda.as_slice().to_vec(), penetration.as_slice().to_vec())
    }

    /// Sets until the search ends, and the last set; λ ≥ 0 and no penetration hold there.
    fn search(compliance: &DMatrix<f64>, d: &DVector<f64>, start: bool) -> (usize, Vec<bool>) {
        let count = d.len();
        let (bilateral, penalty) = (vec![false; count], vec![1.0; count]);
        let (mut active, mut ascent) = (vec![start; count], Ascent::new());
        for solves in 1..=1000 {
            let (lambda, penetration) = solved(compliance, d, &active);
            let found = SetSolution { lambda: &lambda, penetration: &penetration, penalty: &penalty };
            let Some(next) = ascent.next(&active, &bilateral, &found) else {
                let most = d.amax();
                for i in 0..count {
                    assert!(if active[i] { lambda[i] >= 0.0 } else { penetration[i] <= 1e-9 * most }, "multiplier {i}");
                }
                return (solves, active);
            };
            active = next;
        }
        panic!("no end after 1000 solves");
    }

    /// Deflection of a clamped beam at `x` under a unit force at `s`: beside it the plain rule goes through a hundred sets.
    fn beam(count: usize) -> DMatrix<f64> {
        let place = |i: usize| (i + 1) as f64 / count as f64;
        DMatrix::from_fn(count, count, |i, j| {
            let [a, b] = [place(i).min(place(j)), place(i).max(place(j))];
            a * a * (3.0 * b - a) / 6.0 + if i == j { 1e-7 } else { 0.0 }
        })
    }

    #[test]
    fn a_beam_finds_its_seat_in_few_sets_from_any_start() {
        let count = 80;
        let compliance = beam(count);
        for (waves, height) in [(0.0, 0.0), (1.0, 1e-2), (3.0, 1e-3), (4.0, 1e-2)] {
            let d = DVector::from_fn(count, |i, _| {
                let x = (i + 1) as f64 / count as f64;
                0.2 * x * x * (3.0 - x) - 0.5 * x * x - height * (1.0 - (waves * std::f64::consts::TAU * x).cos())
            });
            let found = [true, false].map(|start| search(&compliance, &d, start));
            assert_eq!(found[0].1, found[1].1, "{waves} waves of {height}");
            assert!(found.iter().all(|(solves, _)| *solves <= 25), "{waves} waves of {height}: {found:?}");
        }
    }

    #[test]
    fn any_positive_definite_compliance_comes_to_an_end() {
        let mut seed: u64 = 7;
        let mut random = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (seed >> 33) as f64 / (1u64 << 31) as f64 - 0.5
        };
        for count in (4..44).step_by(4) {
            // Of a third of the rank: what too many multipliers look like.
            let factor = DMatrix::from_fn(count, count / 3 + 1, |_, _| random());
            let compliance = &factor * factor.transpose() + 1e-4 * DMatrix::identity(count, count);
            let d = DVector::from_fn(count, |_, _| random());
            let found = [true, false].map(|start| search(&compliance, &d, start));
            assert_eq!(found[0].1, found[1].1, "{count} multipliers");
        }
    }
}
