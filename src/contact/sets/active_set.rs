//! The primal-dual active set: which multipliers carry pressure.

use crate::contact::sets::ascent::{Ascent, SetSolution};

/// What a new active set means for the loop.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum SetChange {
    /// The set that was solved for stays: done.
    Settled,
    /// A set not seen before: solve again.
    Changed {
        /// Multipliers that became active.
        added: usize,
        /// Multipliers that were released.
        released: usize,
    },
    /// A set seen before: the loop would go round for ever.
    Repeated,
}

/// The active multipliers of all contacts, with every set that was tried.
///
/// Source: Hintermüller, Ito, Kunisch, SIAM Journal on Optimization 13 (2002), 865-888.
#[derive(Clone, Debug)]
pub struct ActiveSet {
    active: Vec<bool>,
    /// Multipliers of bilateral contacts: always active.
    bilateral: Vec<bool>,
    tried: Vec<Vec<bool>>,
    /// Set once the plain rule has been given up.
    ascent: Option<Ascent>,
}

impl ActiveSet {
    /// Everything active.
    pub fn new(bilateral: Vec<bool>) -> Self {
        let active = vec![true; bilateral.len()];
        Self { tried: vec![active.clone()], active, bilateral, ascent: None }
    }

    /// Begins with another set, as if none had been tried; bilateral multipliers are active whatever it says.
    pub fn start_from(&mut self, active: &[bool]) {
        self.active = active.iter().zip(&self.bilateral).map(|(&active, &bilateral)| active || bilateral).collect();
        self.forget();
    }

    /// Which multipliers are active.
    pub fn active(&self) -> &[bool] {
        &self.active
    }

    /// Whether some multiplier may be released at all.
    pub fn may_change(&self) -> bool {
        self.bilateral.contains(&false)
    }

    /// The next set: active where `force`, that is `λ_i + κ_i (Bu - Cλ - c)_i`, is positive; where it is zero nothing changes.
    pub fn update(&mut self, force: impl Fn(usize) -> f64) -> SetChange {
        let stays = |i: usize| force(i) > 0.0 || (force(i) == 0.0 && self.active[i]);
        let next: Vec<bool> = self.bilateral.iter().enumerate().map(|(i, &bilateral)| bilateral || stays(i)).collect();
        if next == self.active {
            return SetChange::Settled;
        }
        let before = std::mem::replace(&mut self.active, next);
        self.change_from(&before)
    }

    /// What the set is after another one; from here on it counts as tried.
    fn change_from(&mut self, before: &[bool]) -> SetChange {
        if self.tried.contains(&self.active) {
            return SetChange::Repeated;
        }
        self.tried.push(self.active.clone());
        let count = |now: bool| self.active.iter().zip(before).filter(|&(&is, &was)| is != was && is == now).count();
        SetChange::Changed { added: count(true), released: count(false) }
    }

    /// Gives up the plain rule: from here on sets follow by [`ActiveSet::ascend`], and those that were tried before count anew.
    pub fn begin_ascent(&mut self) {
        self.ascent = Some(Ascent::new());
        self.forget();
    }

    /// Whether the plain rule has been given up.
    pub fn ascends(&self) -> bool {
        self.ascent.is_some()
    }

    /// The next set by rising energy, after [`ActiveSet::begin_ascent`]. One that was tried may come back on the way; and, where
    /// energies differ by no more than the solves can tell, for ever.
    pub fn ascend(&mut self, found: &SetSolution) -> SetChange {
        let Some(ascent) = &mut self.ascent else { return SetChange::Settled };
        let Some(next) = ascent.next(&self.active, &self.bilateral, found) else { return SetChange::Settled };
        let before = std::mem::replace(&mut self.active, next);
        self.change_from(&before)
    }

    /// Closes `more` multipliers in the set that was found last, before anything is solved for it, and says what that makes of the
    /// set `solved` for last: the same one again, where nothing but `more` was to open.
    pub fn keep(&mut self, more: &[usize], solved: &[bool]) -> SetChange {
        if self.tried.last() == Some(&self.active) {
            self.tried.pop();
        }
        more.iter().for_each(|&i| self.active[i] = true);
        if self.active == solved {
            return SetChange::Settled;
        }
        self.change_from(solved)
    }

    /// Forgets the sets tried so far, because the solves become more exact from here on.
    pub fn forget(&mut self) {
        self.tried = vec![self.active.clone()];
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_set_that_stands_is_settled() {
        let mut set = ActiveSet::new(vec![false; 3]);
        let force = |i: usize| if i == 1 { -1.0 } else { 1.0 };
        assert_eq!(set.update(force), SetChange::Changed { added: 0, released: 1 });
        assert_eq!(set.update(force), SetChange::Settled);
        assert_eq!(set.active(), [true, false, true]);
    }

    #[test]
    fn a_cycle_is_told() {
        let mut set = ActiveSet::new(vec![false; 3]);
        assert!(matches!(set.update(|i| if i == 2 { -1.0 } else { 1.0 }), SetChange::Changed { .. }));
        assert_eq!(set.update(|_| 1.0), SetChange::Repeated);
    }

    /// It pulls when it is closed and penetrates when it is open, each by what the solve leaves.
    #[test]
    fn the_search_by_rising_energy_tells_a_set_that_comes_back() {
        let mut set = ActiveSet::new(vec![false; 2]);
        set.begin_ascent();
        let mut next = |lambda: [f64; 2], penetration: [f64; 2]| {
            set.ascend(&SetSolution { lambda: &lambda, penetration: &penetration, penalty: &[1.0; 2] })
        };
        assert_eq!(next([1.0, -1e-9], [0.0, 0.0]), SetChange::Changed { added: 0, released: 1 });
        assert_eq!(next([1.0, 0.0], [0.0, 1e-9]), SetChange::Repeated);
    }

    #[test]
    fn what_is_kept_closed_makes_no_set_twice() {
        let mut set = ActiveSet::new(vec![false; 3]);
        set.update(|_| -1.0);
        assert_eq!(set.keep(&[1], &[true; 3]), SetChange::Changed { added: 0, released: 2 });
        assert_eq!(set.active(), [false, true, false]);
        assert_eq!(set.update(|_| -1.0), SetChange::Changed { added: 0, released: 1 }, "the open set was never solved for");
        assert_eq!(set.keep(&[1], &[false, true, false]), SetChange::Settled, "nothing else was to open");
        assert_eq!(set.active(), [false, true, false]);
        set.update(|i| if i == 0 { 1.0 } else { -1.0 });
        assert_eq!(set.keep(&[1, 2], &[false, true, false]), SetChange::Repeated, "all was closed at first");
    }

    #[test]
    fn bilateral_multipliers_are_never_released() {
        let mut set = ActiveSet::new(vec![true, false]);
        set.start_from(&[false, false]);
        assert_eq!(set.active(), [true, false]);
        assert_eq!(set.update(|_| -1.0), SetChange::Settled);
    }

    #[test]
    fn without_a_force_nothing_changes() {
        let mut set = ActiveSet::new(vec![false; 2]);
        set.start_from(&[true, false]);
        assert_eq!(set.update(|_| 0.0), SetChange::Settled);
        assert_eq!(set.active(), [true, false]);
    }

    #[test]
    fn only_a_bilateral_set_may_not_change() {
        assert!(!ActiveSet::new(vec![true; 3]).may_change());
        assert!(ActiveSet::new(vec![true, false]).may_change() && ActiveSet::new(vec![false]).may_change());
    }
}
