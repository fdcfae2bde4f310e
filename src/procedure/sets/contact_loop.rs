//! The loop over active sets.

use crate::contact::{ActiveSet, GapChoice, SetChange};
use crate::discretisation::{Contact, Solution, SystemError, adrift, bilateral, few_that_hold, not_held};
use crate::procedure::ending::{Ending, Failure, Standing};
use crate::procedure::sets::carried_set::carried_set;
use crate::procedure::sets::contact_state::ContactState;
use crate::procedure::sets::pass::{Pass, relative_change};
use crate::procedure::sets::residual_scale::{LOOSE, last_residual, share, share_of_forces};
use crate::procedure::sets::unsettled::{going_on, places};
use crate::system::{LinearEnding, LinearSolve, MOST_ROUNDING, Start, System, Tolerance};

/// Relative residual that any solve goes to, at least: a start from a load step that is far away may have one above 1.
const WIDEST: f64 = 0.1;

/// Share of its residual that a start from a coarser mesh is solved to before its set is looked at: what is wrong with it is
/// seen by then.
const LOOK: f64 = 1e-2;

/// Multipliers that may change at such a look before the next solve is the last one.
const FEW: usize = 2;

/// Relative residual that no solve goes below.
const LEAST: f64 = 1e-13;

/// How much smaller a residual is asked for if the contact conditions are not met.
const FURTHER: f64 = 1e-2;

/// Active sets tried by the plain rule at most; from then on they are those of rising energy.
const MOST_PLAIN: usize = 12;

/// Active sets tried at most.
const MOST_SETS: usize = 120;

/// Relative residual of the solves by which sets of rising energy are told, if the tolerance asks for no less.
const TELLING: f64 = 1e-8;

/// Force that a solve cannot tell from none, as a share of the largest pressure, by its relative residual.
const DOUBT: f64 = 1e2;

/// That share at most, however loose the solve is: a set that is wrong is no matter of the residual.
const MOST_DOUBT: f64 = 1e-5;

/// Violation of the contact conditions by a set that comes back, as a share of the largest pressure, by the relative residual:
/// below it the set is as good as any other. Slender bodies change their forces by what is allowed in the end.
const AS_GOOD: f64 = 1e3;

/// That share at most.
const MOST_AS_GOOD: f64 = 1e-3;

/// How often contact that a body needs is kept against its forces.
const MOST_KEPT: usize = 30;

/// What the loop does next.
enum Next {
    /// It ends.
    End(Ending),
    /// It solves again to the final tolerance.
    Tighten,
    /// It solves to a smaller residual than the tolerance: the contact conditions ask for it.
    Further,
    /// It solves again, and goes over to sets of rising energy.
    Ascend,
    /// It solves again.
    Go,
    /// It solves to where the set is looked at again.
    Look,
}

/// The set that follows from a solve.
struct NextSet {
    change: SetChange,
    /// The body that it lets go, in words.
    lost: Option<String>,
}

/// Where a loop stands among all of a mesh.
#[derive(Clone, Copy, Debug)]
pub struct LoopPosition {
    /// Number of the contact boundary, from 1.
    pub boundary: usize,
    /// Passes made on boundaries before.
    pub passes: usize,
    /// Whether the boundary is nearly, or just, where the one before was.
    pub is_near: bool,
    /// Whether the set was hard to find on the coarser mesh: residuals say little of the forces then, as in slender bodies.
    pub is_hard: bool,
}

/// What a loop has found.
pub struct LoopOutcome {
    /// The solution of the last pass, with the set it was solved for.
    pub solution: Solution,
    /// How it ended.
    pub ending: Ending,
    /// Every pass.
    pub passes: Vec<Pass>,
    /// Whether the active set was found by rising energy, because the plain rule did not.
    pub ascended: bool,
}

/// Solves for one active set after the other, until one stands.
pub struct ContactLoop<'s, 'a> {
    system: &'s mut System<'a>,
    /// The set to solve for next; runs ahead of that of the system after a solve.
    set: ActiveSet,
    position: LoopPosition,
    /// How far the last solve was asked to go.
    wanted: f64,
    /// Share of the right-hand side that residuals are measured by.
    share: f64,
    /// Residual that the last solve goes to, and that of the present one, relative to the whole right-hand side.
    tolerance: f64,
    goal: f64,
    /// Whether the first set and its solution come from the programme, a coarser mesh or another boundary, and can be trusted.
    is_carried: bool,
    /// How often contact was kept that a body needs.
    kept: usize,
    /// Displacements of the pass before, none for zeros: of most first passes.
    before: Vec<f64>,
    passes: Vec<Pass>,
}

impl<'s, 'a> ContactLoop<'s, 'a> {
    /// Begins with a start, or with all closed where nothing is known. **Collective**
    pub fn begin(
        system: &'s mut System<'a>,
        start: Option<Start>,
        tolerance: Tolerance,
        position: LoopPosition,
    ) -> Result<Self, SystemError> {
        let problem = system.problem();
        let mut set = ActiveSet::new(bilateral(&problem.contacts));
        let is_carried = start.is_some() && !position.is_hard;
        if let Some(start) = start {
            set.start_from(&start.active);
            let carried = carried_set(system, set.active(), &start.displacement);
            if carried != set.active() {
                set.start_from(&carried);
            }
            system.begin(&Start { active: set.active().to_vec(), ..start })?;
        }
        let relative = last_residual(system, tolerance)?;
        let share = share_of_forces(system, share(system)?, relative)?;
        let last = share * relative;
        let is_expected = is_carried
            && (position.is_near && position.passes > 0 || !set.active().contains(&false) && stays_closed(&problem.contacts));
        let goal = match set.may_change() && !is_expected {
            false => last,
            true if is_carried => last.max((LOOK * system.residual()?.relative()).min(WIDEST)),
            true => last.max(share * LOOSE),
        };
        let known = |u: &[f64]| if u.iter().any(|value| *value != 0.0) { u.to_vec() } else { Vec::new() };
        let (before, wanted) = (system.with_free_displacement(known), tolerance.residual());
        Ok(Self { system, set, position, wanted, share, tolerance: last, goal, is_carried, kept: 0, before, passes: Vec::new() })
    }

    /// Solves until the active set stands and the last residual is below the tolerance; `report` is called with every pass.
    /// **Collective**
    pub fn solve(mut self, mut report: impl FnMut(&Pass)) -> Result<LoopOutcome, SystemError> {
        loop {
            let next = self.pass()?;
            report(&self.passes[self.passes.len() - 1]);
            match next {
                Next::End(ending) => return self.finish(ending),
                Next::Tighten => {
                    // A set may have come up twice because a solve was not exact: from here on that counts anew.
                    let relative = self.last();
                    self.share = share_of_forces(self.system, self.share, relative)?;
                    self.tolerance = self.share * relative;
                    self.goal = self.tolerance;
                    self.set.forget();
                }
                Next::Further => {
                    self.tolerance = (FURTHER * self.tolerance).max(self.share * LEAST);
                    self.goal = self.tolerance;
                }
                Next::Ascend => {
                    self.goal = self.tolerance.min(self.share * TELLING);
                    self.set.begin_ascent();
                }
                Next::Go | Next::Look => {}
            }
            self.before = self.system.with_free_displacement(<[f64]>::to_vec);
            self.system.set_active(self.set.active())?;
            if matches!(next, Next::Look) {
                self.goal = self.tolerance.max((LOOK * self.system.residual()?.relative()).min(WIDEST));
            }
        }
    }

    /// One solve, and what follows from it. **Collective**
    fn pass(&mut self) -> Result<Next, SystemError> {
        let residual = self.residual_to_reach()?;
        let solve = self.system.solve(residual)?;
        let state = ContactState::new(self.system);
        let failed = matches!(solve.ending, LinearEnding::Failed { .. });
        let next_set = if failed { None } else { Some(self.next_set(&state)) };
        self.record(&solve, &state, next_set.as_ref());
        // Bodies that nothing drives and nothing holds have forces of rounding alone, by which sets change for ever.
        let is_first = self.position.passes == 0 && self.passes.len() == 1;
        if let Some(words) = is_first.then(|| adrift(self.system.problem(), self.system.active())).flatten() {
            return Ok(Next::End(Ending::NotConverged(Failure::NotHeld(words))));
        }
        Ok(match next_set {
            None => Next::End(self.after_failure(solve.ending, &state)),
            Some(NextSet { change: SetChange::Settled, lost }) => self.after_settled(solve.ending, lost, &state),
            Some(NextSet { change, lost }) => self.after_change(&change, lost, &state),
        })
    }

    /// Keeps the figures of a pass. **Collective**
    fn record(&mut self, solve: &LinearSolve, state: &ContactState, next: Option<&NextSet>) {
        let (added, released) = match next {
            Some(NextSet { change: SetChange::Changed { added, released }, .. }) => (*added, *released),
            _ => (0, 0),
        };
        let pass = Pass {
            iteration: self.position.passes + self.passes.len() + 1,
            boundary: self.position.boundary,
            active: self.system.active().iter().filter(|active| **active).count(),
            added,
            released,
            krylov_iterations: solve.iterations,
            residual: solve.residual / self.share,
            max_penetration: state.largest_penetration(self.system.problem()),
            du: self.change(),
            fallback: solve.fallback.clone(),
        };
        self.passes.push(pass);
    }

    /// Relative residual to reach: the goal, but in the loop at least a tenth of the present one, so that a good start
    /// does not hide a changed set; never less than the final tolerance. **Collective**
    fn residual_to_reach(&self) -> Result<f64, SystemError> {
        if self.goal <= self.tolerance {
            return Ok(self.goal);
        }
        let residual = self.system.residual()?;
        if residual.whole == 0.0 {
            return Ok(self.goal);
        }
        Ok(self.goal.min((0.1 * residual.norm / residual.whole).max(self.tolerance)))
    }

    /// The set that follows from the forces: nothing changes where they are too small to be told from none. One that lets a
    /// body go may do so only because contact was closed where it is to open, and pulled: the few multipliers that are pulled
    /// least, and hold all, stay closed then, so that the rest comes to rest on them. If that has been tried, the words for the
    /// body. **Collective**
    fn next_set(&mut self, state: &ContactState) -> NextSet {
        let problem = self.system.problem();
        let doubt = if self.is_loose() { 0.0 } else { (DOUBT * self.goal / self.share).min(MOST_DOUBT) };
        let told = state.told_from(problem, doubt);
        let force = |i: usize| told.force(i);
        let change = if self.set.ascends() { self.set.ascend(&told.found()) } else { self.set.update(force) };
        let lost = not_held(problem, self.set.active());
        let is_new = matches!(change, SetChange::Changed { .. }) || self.set.ascends() && change == SetChange::Repeated;
        if lost.is_none() || self.kept == MOST_KEPT || !is_new {
            return NextSet { change, lost };
        }
        self.kept += 1;
        let few = few_that_hold(problem, self.set.active(), force);
        NextSet { change: self.set.keep(&few, self.system.active()), lost: None }
    }

    /// Relative residual that the last solve is to reach, of what strains.
    fn last(&self) -> f64 {
        self.tolerance / self.share
    }

    /// What violates the contact conditions most, in words.
    fn violated(&self, state: &ContactState) -> Option<String> {
        state.violated(self.system.problem(), self.system.active(), self.last())
    }

    fn after_failure(&self, ending: LinearEnding, state: &ContactState) -> Ending {
        let is_far = matches!(ending, LinearEnding::Failed { residual, .. } if residual.is_nan() || residual > MOST_ROUNDING);
        if self.last() > self.wanted || is_far {
            return self.ending(ending);
        }
        // What went on below the tolerance and could not is as good as rounding allows.
        match self.violated(state) {
            Some(words) => Ending::NotConverged(Failure::ConditionsViolated(words)),
            None => Ending::Converged(self.standing()),
        }
    }

    fn after_settled(&self, ending: LinearEnding, lost: Option<String>, state: &ContactState) -> Next {
        // A set that a coarser mesh or another boundary has left may hold less here.
        if let Some(words) = lost {
            return Next::End(Ending::NotConverged(Failure::NotHeld(words)));
        }
        if self.is_loose() {
            return Next::Tighten;
        }
        match (self.violated(state), ending) {
            (Some(_), LinearEnding::Converged) if self.last() > LEAST => Next::Further,
            (Some(words), _) => Next::End(Ending::NotConverged(Failure::ConditionsViolated(words))),
            (None, ending) => Next::End(self.ending(ending)),
        }
    }

    fn after_change(&self, change: &SetChange, lost: Option<String>, state: &ContactState) -> Next {
        if let Some(words) = lost {
            return Next::End(Ending::NotConverged(Failure::NotHeld(words)));
        }
        let (solves, repeated) = (self.passes.len(), *change == SetChange::Repeated);
        let goes_on = solves >= MOST_SETS;
        let is_as_good = || match goes_on {
            true => self.violated(state).is_none(),
            false => {
                let good = (AS_GOOD * self.goal / self.share).min(MOST_AS_GOOD);
                repeated && state.violation(self.system.problem(), self.system.active()) <= good
            }
        };
        if !self.is_loose() && is_as_good() {
            return Next::End(Ending::Converged(self.round(state)));
        }
        if goes_on {
            let words = going_on(self.system.problem(), solves, &self.changed());
            return Next::End(Ending::NotConverged(Failure::SetChanges(words)));
        }
        match change {
            _ if !self.set.ascends() && (solves >= MOST_PLAIN || repeated && !self.is_loose()) => Next::Ascend,
            SetChange::Repeated if !self.set.ascends() => Next::Tighten,
            SetChange::Changed { added, released } if self.is_carried && self.is_loose() => {
                // What is left of the wrong ones is seen in the last solve, if it is but a few.
                if added + released <= FEW { Next::Tighten } else { Next::Look }
            }
            _ => Next::Go,
        }
    }

    /// Multipliers that are to change after the last solve.
    fn changed(&self) -> Vec<usize> {
        let (was, is) = (self.system.active(), self.set.active());
        (0..was.len()).filter(|&i| was[i] != is[i]).collect()
    }

    /// What stands where sets go round: the one that was solved for, which is as good as any.
    fn round(&self, state: &ContactState) -> Standing {
        let problem = self.system.problem();
        Standing::Round { places: places(problem, &self.changed()), violation: state.violation(problem, self.system.active()) }
    }

    /// Whether the present solve is less exact than the last one is to be.
    fn is_loose(&self) -> bool {
        self.goal > self.tolerance
    }

    /// How the loop ends with a linear solve whose set stands.
    fn ending(&self, linear: LinearEnding) -> Ending {
        match linear {
            LinearEnding::Converged => Ending::Converged(self.standing()),
            LinearEnding::Rounding { residual, tolerance } => Ending::Converged(Standing::Rounding { residual, tolerance }),
            LinearEnding::Failed { reason, iterations, residual } => {
                Ending::NotConverged(Failure::LinearSolver { reason, iterations, residual })
            }
        }
    }

    fn standing(&self) -> Standing {
        if self.set.may_change() { Standing::ActiveSet } else { Standing::Residual }
    }

    /// The solution of the last pass. **Collective**
    fn finish(self, ending: Ending) -> Result<LoopOutcome, SystemError> {
        let Self { system, share, before, .. } = self;
        // Its memory is what the solution takes.
        drop(before);
        let (residual, plain_residual) = system.both_residuals()?;
        let whole = share * residual.whole;
        let solution = Solution {
            displacement: system.displacement(),
            multipliers: system.pressures(),
            active: system.active().to_vec(),
            residual: if whole == 0.0 { 0.0 } else { residual.norm / whole },
            plain_residual: plain_residual / share,
            inf_sup: Vec::new(),
        };
        Ok(LoopOutcome { solution, ending, passes: self.passes, ascended: self.set.ascends() })
    }

    /// Change of the displacement since the pass before, relative to its norm. **Collective**
    fn change(&self) -> f64 {
        self.system.with_free_displacement(|now| relative_change(now, &self.before, &self.system.problem().session))
    }
}

/// Whether contacts that are closed all along on one mesh will be so on the next: there is no gap, or they end where the
/// pressure does.
fn stays_closed(contacts: &[Contact]) -> bool {
    contacts.iter().all(|contact| contact.pair.has_free_ends() || matches!(contact.pair.gap, GapChoice::Closed))
}
