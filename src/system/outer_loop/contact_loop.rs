//! The loop over active sets.

use super::contact_state::{ContactState, pressures};
use super::first_set::{carried_set, first_set};
use super::unsettled::going_on;
use crate::contact::{ActiveSet, Step};
use crate::petsc::{Session, Vector};
use crate::system::{
    Discretisation, Ending, LinearSolver, SaddlePoint, Solution, Space, SystemError, Tolerance, Verdict, few_that_hold, not_held,
    rigid_start,
};

/// Relative residual of the solves inside the loop: enough to find the right set.
const LOOSE: f64 = 1e-4;

/// Share of the residual of a start from a coarser mesh that solves as far as the discretisation does.
const FROM_START: f64 = 2e-4;

/// Relative residual that is small enough for any discretisation error.
const SMALL: f64 = 1e-10;

/// Relative residual that no solve goes below.
const LEAST: f64 = 1e-13;

/// How much smaller a residual is asked for if the contact conditions are not met.
const FURTHER: f64 = 1e-2;

/// What helps where they cannot be met.
const NOT_MET: &str =
    "rounding allows no better; take fewer segments, or a mesh whose bodies are less slender or less unlike in stiffness";

/// Active sets tried by the plain rule at most; from then on they are those of rising energy.
const MOST_PLAIN: usize = 12;

/// Active sets tried at most.
const MOST_SETS: usize = 120;

/// Relative residual of the solves by which sets of rising energy are told, if the tolerance asks for no less.
const TELLING: f64 = 1e-8;

/// Share of the right-hand side that the residual is measured by, at least: beyond it lies rounding.
const LEAST_SHARE: f64 = 1e-8;

/// How often contact that a body needs is kept against its forces.
const MOST_KEPT: usize = 3;

/// One pass of the loop, in figures.
#[derive(Clone, Debug, PartialEq)]
pub struct OuterStep {
    /// Number of the pass, from 1.
    pub iteration: usize,
    /// Number of the contact boundary it was made on, from 1.
    pub boundary: usize,
    /// Active multipliers of the solve.
    pub active: usize,
    /// Multipliers that became active after it.
    pub added: usize,
    /// Multipliers that were released after it.
    pub released: usize,
    /// Krylov iterations of its linear solve.
    pub krylov_iterations: usize,
    /// Its relative residual.
    pub residual: f64,
    /// Largest mean penetration over a multiplier (length).
    pub max_penetration: f64,
    /// Change of the displacement, relative to its norm.
    pub du: f64,
    /// The stronger preconditioner that the linear solver went over to, in words.
    pub climbed: Option<String>,
}

/// What the loop does next.
enum Next {
    /// It ends.
    End(Verdict),
    /// It solves again to the final tolerance.
    Tighten,
    /// It solves to a smaller residual than the tolerance: the contact conditions ask for it.
    Further,
    /// It solves again, and goes over to sets of rising energy.
    Ascend,
    /// It solves again.
    Go,
}

/// What the next step is judged by.
struct Judged<'a> {
    outcome: Step,
    /// The body that the new set lets go, in words.
    lost: Option<String>,
    ending: Ending,
    /// Relative residual that the last solve is to reach.
    residual: f64,
    /// Whether the solve was less exact than the last one is to be.
    loose: bool,
    /// Solves made.
    passes: usize,
    /// The set that was solved for.
    active: &'a [bool],
    state: &'a ContactState,
}

/// What a solve begins with.
pub struct Start<'a> {
    /// This rank's displacements, as in [`Solution`].
    pub displacement: &'a [f64],
    /// Pressures of all multipliers.
    pub multipliers: &'a [f64],
}

/// What the loop works on.
pub struct ContactLoop<'a> {
    /// What the system is assembled from.
    pub problem: &'a Discretisation,
    /// All ranks.
    pub session: &'a Session,
    /// Number of the contact boundary, from 1.
    pub boundary: usize,
    /// Passes made on boundaries before.
    pub passes: usize,
    /// How far the last solve goes.
    pub tolerance: Tolerance,
}

impl ContactLoop<'_> {
    fn finest(&self) -> &Space {
        self.problem.finest()
    }

    /// Solves until the active set stands and the last residual is below the tolerance; `report` hears every pass.
    /// **Collective**
    pub fn solve(
        &self,
        system: &mut SaddlePoint,
        solver: &mut LinearSolver,
        set: &mut ActiveSet,
        start: Option<Start>,
        mut report: impl FnMut(&OuterStep),
    ) -> Result<Solution, SystemError> {
        let (mut x, _) = system.nest.create_vectors()?;
        let mut before = vec![0.0; self.finest().local_unknowns()];
        if let Some(start) = start {
            self.begin(system, &mut x, &start);
            before.copy_from_slice(&x.values()[..self.finest().local_unknowns()]);
            let carried = carried_set(self.problem, system, set.active(), start.displacement, self.session);
            if carried != set.active() {
                set.start_from(&carried);
            }
        } else if let Some(first) = first_set(self.problem, system, self.session) {
            set.start_from(&first);
        }
        if !set.active().iter().all(|&active| active) {
            system.activate(self.problem, set.active())?;
            solver.refresh(system)?;
            self.release(system, &mut x, set.active());
        }
        let share = self.share(system, set.active())?;
        let mut tolerance = share * self.last_residual(system, &x, set.active())?;
        let mut goal = if set.may_change() { tolerance.max(share * LOOSE) } else { tolerance };
        let (mut steps, mut kept) = (Vec::new(), 0);
        loop {
            // The set that the blocks hold and the solution belongs to; `set` may run ahead of it.
            let active = set.active().to_vec();
            let b = system.right_hand_side(&active, self.finest())?;
            let residual = self.goal(goal, tolerance, system, &b, &x)?;
            let solve = solver.solve(system, &b, &mut x, residual)?;
            let state = ContactState::new(self.problem, system, &x, &active, self.session);
            let (outcome, lost) = match solve.ending {
                Ending::Failed(_) => (Step::Settled, None),
                _ => self.next_set(set, &state, &mut kept),
            };
            let (added, released) = if let Step::Changed { added, released } = outcome { (added, released) } else { (0, 0) };
            let step = OuterStep {
                iteration: self.passes + steps.len() + 1,
                boundary: self.boundary,
                active: active.iter().filter(|active| **active).count(),
                added,
                released,
                krylov_iterations: solve.iterations,
                residual: solve.residual / share,
                max_penetration: state.largest_penetration(self.problem),
                du: self.change(&x, &mut before),
                climbed: solve.climbed,
            };
            report(&step);
            steps.push(step);
            let loose = goal > tolerance;
            let (ending, residual) = (solve.ending, tolerance / share);
            let pass = Judged { outcome, lost, ending, residual, loose, passes: steps.len(), active: &active, state: &state };
            match self.judge(pass, set) {
                Next::End(verdict) => {
                    let solution = self.finish(system, &x, active, share, steps, verdict)?;
                    return Ok(Solution { ascended: set.ascends(), ..solution });
                }
                Next::Tighten => {
                    // Sets that inexact solves led to prove no cycle.
                    goal = tolerance;
                    set.forget();
                }
                Next::Further => {
                    tolerance = (FURTHER * tolerance).max(share * LEAST);
                    goal = tolerance;
                }
                Next::Ascend => {
                    goal = tolerance.min(share * TELLING);
                    set.begin_ascent();
                }
                Next::Go => {}
            }
            if set.active() != active {
                system.activate(self.problem, set.active())?;
                solver.refresh(system)?;
                self.release(system, &mut x, set.active());
            }
        }
    }

    /// Share of the right-hand side that asks for strain. Displacements prescribed to a stiff body are forces of its own
    /// modulus there, however little they strain it: beside them the forces of contact with a soft one are small, and a
    /// residual relative to all of it says nothing of these. So the part that moves the bodies rigidly does not count.
    /// **Collective**
    fn share(&self, system: &SaddlePoint, active: &[bool]) -> Result<f64, SystemError> {
        let Some(displacement) = rigid_start(self.problem, self.session.rank()) else { return Ok(1.0) };
        let b = system.right_hand_side(active, self.finest())?;
        let (mut x, mut r) = (b.duplicate()?, b.duplicate()?);
        self.begin(system, &mut x, &Start { displacement: &displacement, multipliers: &vec![0.0; active.len()] });
        system.nest.residual(&b, &x, &mut r)?;
        let share = r.norm()? / b.norm()?;
        Ok(if share > 0.0 { share.clamp(LEAST_SHARE, 1.0) } else { 1.0 })
    }

    /// Relative residual that the last solve is to reach. A start from a coarser mesh is off by the discretisation error of
    /// that mesh; this share of its residual leaves less than a tenth of this mesh's, in λ too. **Collective**
    fn last_residual(&self, system: &SaddlePoint, x: &Vector, active: &[bool]) -> Result<f64, SystemError> {
        match self.tolerance {
            Tolerance::Residual(residual) => Ok(residual),
            Tolerance::Discretisation => {
                let b = system.right_hand_side(active, self.finest())?;
                let mut r = b.duplicate()?;
                system.nest.residual(&b, x, &mut r)?;
                Ok((FROM_START * r.norm()? / b.norm()?).clamp(SMALL, LOOSE))
            }
        }
    }

    /// Puts a start into the unknowns; prescribed components are no unknowns.
    fn begin(&self, system: &SaddlePoint, x: &mut Vector, start: &Start) {
        let space = self.finest();
        let unknowns = space.local_unknowns();
        let mut values = x.values_mut();
        values[..unknowns].copy_from_slice(start.displacement);
        for (node, constraint) in space.constraints.iter().filter(|(node, _)| space.own.contains(node)) {
            for k in (0..2).filter(|&k| constraint.fixed[k]) {
                values[2 * (node - space.own.start) + k] = 0.0;
            }
        }
        for (at, &i) in system.multipliers.own.iter().enumerate() {
            values[unknowns + at] = start.multipliers[i] / system.multipliers.scale[i];
        }
    }

    /// Relative residual to reach: `goal`, but in the loop at least a tenth of the present one, so that a good start
    /// does not hide a changed set; never less than the final `tolerance`. **Collective**
    fn goal(&self, goal: f64, tolerance: f64, system: &SaddlePoint, b: &Vector, x: &Vector) -> Result<f64, SystemError> {
        let norm = b.norm()?;
        if goal <= tolerance || norm == 0.0 {
            return Ok(goal);
        }
        let mut r = b.duplicate()?;
        system.nest.residual(b, x, &mut r)?;
        Ok(goal.min((0.1 * r.norm()? / norm).max(tolerance)))
    }

    /// The set that follows from the forces. One that lets a body go may do so only because contact was closed where it is
    /// to open, and pulled: the few multipliers that are pulled least, and hold all, stay closed then, so that the rest
    /// comes to rest on them. If that has been tried, the words for the body.
    fn next_set(&self, set: &mut ActiveSet, state: &ContactState, kept: &mut usize) -> (Step, Option<String>) {
        let active = set.active().to_vec();
        let force = |i: usize| state.force(i);
        let outcome = if set.ascends() { set.ascend(&state.found()) } else { set.update(force) };
        let lost = not_held(self.problem, set.active());
        if lost.is_none() || *kept == MOST_KEPT || !matches!(outcome, Step::Changed { .. }) {
            return (outcome, lost);
        }
        if !set.keep(&few_that_hold(self.problem, set.active(), force)) {
            return (outcome, lost);
        }
        *kept += 1;
        let changed = |now: bool| active.iter().zip(set.active()).filter(|&(&was, &is)| was != is && is == now).count();
        (Step::Changed { added: changed(true), released: changed(false) }, None)
    }

    /// What follows from a pass.
    fn judge(&self, pass: Judged, set: &ActiveSet) -> Next {
        let Judged { outcome, lost, ending, residual, loose, passes, active, state } = pass;
        let repeated = outcome == Step::Repeated;
        match (outcome, ending) {
            // What went on below the tolerance and could not is as good as rounding allows.
            (_, Ending::Failed(_)) if residual <= self.tolerance.residual() => {
                Next::End(match state.violated(self.problem, active, residual) {
                    Some(words) => Verdict::NotConverged(format!("{words}; {NOT_MET}")),
                    None => Verdict::Converged(settled(set)),
                })
            }
            (_, Ending::Failed(words)) => Next::End(Verdict::NotConverged(words)),
            // A set that a coarser mesh or another boundary has left may hold less here.
            (Step::Settled, _) if lost.is_some() => Next::End(Verdict::NotConverged(lost.unwrap_or_default())),
            (Step::Settled, _) if loose => Next::Tighten,
            (Step::Settled, ending) => match (state.violated(self.problem, active, residual), ending) {
                (Some(_), Ending::Converged) if residual > LEAST => Next::Further,
                (Some(words), _) => Next::End(Verdict::NotConverged(format!("{words}; {NOT_MET}"))),
                (None, Ending::Rounding(words)) => Next::End(Verdict::Converged(words)),
                _ => Next::End(Verdict::Converged(settled(set))),
            },
            _ => match lost {
                Some(words) => Next::End(Verdict::NotConverged(words)),
                None if passes >= MOST_SETS => {
                    let changed: Vec<usize> = (0..active.len()).filter(|&i| active[i] != set.active()[i]).collect();
                    Next::End(Verdict::NotConverged(going_on(self.problem, passes, &changed)))
                }
                None if !set.ascends() && (passes >= MOST_PLAIN || repeated && !loose) => Next::Ascend,
                None if repeated => Next::Tighten,
                None => Next::Go,
            },
        }
    }

    /// The solution of the last pass, with the set it was solved for. **Collective**
    fn finish(
        &self,
        system: &SaddlePoint,
        x: &Vector,
        active: Vec<bool>,
        share: f64,
        steps: Vec<OuterStep>,
        verdict: Verdict,
    ) -> Result<Solution, SystemError> {
        let b = system.right_hand_side(&active, self.finest())?;
        let mut r = b.duplicate()?;
        system.nest.residual(&b, x, &mut r)?;
        let norm = share * b.norm()?;
        let unknowns = self.finest().local_unknowns();
        let mut displacement = x.values()[..unknowns].to_vec();
        for (node, constraint) in self.finest().constraints.iter().filter(|(node, _)| self.finest().own.contains(node)) {
            for k in (0..2).filter(|&k| constraint.fixed[k]) {
                displacement[2 * (node - self.finest().own.start) + k] = constraint.value[k];
            }
        }
        Ok(Solution {
            verdict,
            displacement,
            multipliers: pressures(self.problem, system, x, self.session),
            active,
            ascended: false,
            residual: if norm == 0.0 { 0.0 } else { r.norm()? / norm },
            plain_residual: system.plain_residual(&r, &b, self.finest(), self.session)? / share,
            steps,
            boundaries: Vec::new(),
            inf_sup: Vec::new(),
        })
    }

    /// Change of the displacement since the last call, relative to its norm. **Collective**
    fn change(&self, x: &Vector, before: &mut [f64]) -> f64 {
        let mut squares = [0.0; 2];
        for (now, then) in x.values().iter().zip(before.iter_mut()) {
            squares[0] += (now - *then).powi(2);
            squares[1] += now * now;
            *then = *now;
        }
        self.session.sum(&mut squares);
        if squares[1] > 0.0 { (squares[0] / squares[1]).sqrt() } else { 0.0 }
    }

    /// Released multipliers start the next solve from zero.
    fn release(&self, system: &SaddlePoint, x: &mut Vector, active: &[bool]) {
        let unknowns = self.finest().local_unknowns();
        let mut values = x.values_mut();
        for (at, &i) in system.multipliers.own.iter().enumerate() {
            if !active[i] {
                values[unknowns + at] = 0.0;
            }
        }
    }
}

fn settled(set: &ActiveSet) -> String {
    if set.may_change() {
        "the active set stands and the residual is below its tolerance".into()
    } else {
        "the residual is below its tolerance".into()
    }
}
