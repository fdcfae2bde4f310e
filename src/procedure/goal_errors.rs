//! Estimated errors of the goals of an accuracy.

use crate::accuracy::{
    CUT, DEEPEST, DOUBTED_WITHIN_SEGMENTS, Goal, HERTZ_BY_UNRESOLVED, LEFT, ProbePoint, Quantity, ROUNDING_BY_OVERLAP,
};
use crate::contact::{GapChoice, Law, Penetration, Zone};
use crate::discretisation::{BY_ROUNDING, BoundaryMotion, Contact, Discretisation, Field, SystemError, needed_contacts};
use crate::procedure::estimates::AtEnds;
use crate::procedure::settings::Procedure;
use crate::procedure::solved::Solved;
use crate::recovery::{penetration_of, smooth_joints, trace_points, unresolved_force};

/// Error of λ above which it is not known where it presses.
const MOST_UNKNOWN: f64 = 0.08;

/// Share of the largest force up to which it is asked whether a contact carries less than is asked for.
const SMALL: f64 = 0.5;

/// A force below this share of what would press if a contact took up the largest displacement, `E_c u`, is what solves leave: 2e-13 of it
/// where one block slides along another, and 1e-13 of `E α ϑ L` between bodies that part by cooling (1.8 million unknowns). A weight of
/// 4e-10 of that on a hot plate was right to seven digits.
const LEFT_BY_SOLVES: f64 = 1e-11;

/// Differences in the energy norm that say that the solution was there before.
const ROUNDING: f64 = 1e-6;

impl Procedure<'_> {
    /// The estimated relative error of a goal; nothing where there is not enough to tell, or where it would be reached, but the mesh
    /// does not hold a contact that counts. **Collective**
    pub(super) fn goal_error(&self, goal: &Goal, solved: &Solved) -> Result<Option<f64>, SystemError> {
        let error = self.estimated_error(goal, solved)?;
        Ok(if self.unresolved_contact(goal, error, solved)?.is_some() { None } else { error })
    }

    /// A contact that is not resolved though a goal with this `error` is reached: that of the goal, or any where it is none of one
    /// contact, which carries more than the goal's tolerance of the largest force. Meshes that do not hold a contact may agree on its force, and on
    /// the energy. **Collective**
    fn unresolved_contact(&self, goal: &Goal, error: Option<f64>, solved: &Solved) -> Result<Option<usize>, SystemError> {
        let contacts = &solved.problem.contacts;
        let of_goal = |at: &usize| goal.quantity.contact().is_none_or(|name| contacts[*at].pair.name == name);
        let all = if error.is_some_and(|error| error <= goal.tolerance) { 0..contacts.len() } else { 0..0 };
        for at in all.filter(of_goal).filter(|&at| contacts[at].pair.law == Law::Unilateral) {
            if self.is_unresolved(solved, at, goal.tolerance)? {
                return Ok(Some(at));
            }
        }
        Ok(None)
    }

    /// The contact that keeps a goal from being reached, though its estimate is small enough. **Collective**
    pub(super) fn kept_by<'s>(&self, goal: &Goal, solved: &'s Solved) -> Result<Option<&'s Contact>, SystemError> {
        let at = self.unresolved_contact(goal, self.estimated_error(goal, solved)?, solved)?;
        Ok(at.map(|at| &solved.problem.contacts[at]))
    }

    /// What is estimated of one goal. **Collective**
    fn estimated_error(&self, Goal { quantity, tolerance }: &Goal, solved: &Solved) -> Result<Option<f64>, SystemError> {
        let estimate = &solved.estimate;
        let at = quantity.contact().and_then(|name| contact_called(&solved.problem, name));
        if let Some(at) = at {
            if is_rounding(solved, at) {
                return Ok(Some(0.0));
            }
            // What carries less than is asked for of the largest force needs no zone to be resolved.
            let share = self.share_of_largest(solved, at, *tolerance)?;
            if share < *tolerance {
                return Ok(Some(share));
            }
            if !self.presses_or_is_clear(solved, at)? {
                return Ok(None);
            }
        }
        let of = |errors: &[Option<f64>], at: usize| errors.get(at).copied().flatten();
        Ok(match (quantity, at) {
            // Where everything is found on the mesh before, rounding is all that the differences tell.
            (Quantity::Energy, _) => estimate.energy.or_else(|| rounded(solved)),
            (Quantity::Displacement(probe), _) => self.probe_errors(solved, probe)[0],
            (Quantity::Stress(probe), _) => self.probe_errors(solved, probe)[1],
            (Quantity::Force(_), Some(at)) => of(&estimate.force, at),
            (Quantity::Pressure(_), Some(at)) => self.pressure_error(solved, at)?,
            (Quantity::Peak(_), Some(at)) => {
                let pressure = solved.solution.pressure(&solved.problem.contacts[at]);
                let variation = pressure.zones().iter().map(|zone| pressure.variation_at_joints(zone)).fold(0.0, f64::max);
                of(&estimate.peak, at).filter(|_| !has_unbounded_peak(solved, at)).map(|error| error.max(variation))
            }
            (Quantity::Ends(_), Some(at)) if self.presses_throughout(solved, at)? => {
                of(&estimate.ends, at).map(|error| error + solved.ending.would_move())
            }
            _ => None,
        })
    }

    /// Force of a contact, and what the overlap of its bodies between segments may be worth, by the largest force of all contacts. A
    /// body that could move if the contact were open goes out of its way: there an overlap is worth nothing. **Collective**
    fn share_of_largest(&self, solved: &Solved, at: usize, tolerance: f64) -> Result<f64, SystemError> {
        let Solved { problem, solution, .. } = solved;
        let force = |contact: &Contact| solution.pressure(contact).force().abs();
        let largest = problem.contacts.iter().map(force).fold(0.0, f64::max);
        let own = force(&problem.contacts[at]);
        if problem.contacts.len() == 1 || largest == 0.0 || own > SMALL * largest || is_shared(solved, at) {
            return Ok(1.0);
        }
        let u = Field::displacement(problem, &solution.displacement);
        let contact = &problem.contacts[at];
        let points = trace_points(problem, &solution.pressure(contact), &u)?;
        let complete = points.iter().filter(|point| point.is_complete());
        let depth = complete.map(|point| -point.gap * contact.boundary.width_at(point.x)).fold(0.0, f64::max);
        let modulus = contact.moduli.iter().copied().fold(0.0, f64::max);
        let worth = HERTZ_BY_UNRESOLVED * modulus * depth;
        let is_needed = || needed_contacts(problem, &solution.active)[at];
        Ok(if own + worth > tolerance * largest && is_needed() { own } else { own + worth } / largest)
    }

    /// Whether what a contact carries beyond a share of the largest force presses on less than an edge, or bodies lie in each other, within
    /// segments that are longer than what presses or elsewhere. **Collective**
    fn is_unresolved(&self, solved: &Solved, at: usize, tolerance: f64) -> Result<bool, SystemError> {
        let Solved { problem, solution, .. } = solved;
        let force = |contact: &Contact| solution.pressure(contact).force().abs();
        let (contact, own) = (&problem.contacts[at], force(&problem.contacts[at]));
        let largest = problem.contacts.iter().map(force).fold(0.0, f64::max);
        let least = if is_shared(solved, at) { 0.0 } else { tolerance * largest };
        if own <= least || is_rounding(solved, at) {
            return Ok(false);
        }
        let u = Field::displacement(problem, &solution.displacement);
        let pressure = solution.pressure(contact);
        let points = trace_points(problem, &pressure, &u)?;
        let off = unresolved_force(contact, &points, 0.0);
        let is_within_segments = off > DOUBTED_WITHIN_SEGMENTS * own && off > least;
        let has_few_edges = pressure.has_few_edges(least);
        let is_cut = smooth_joints(at, problem, solution).cut > CUT;
        let is_too_narrow = has_few_edges && pressure.is_too_narrow(&problem.scene.mesh, &points, least);
        if is_cut || is_within_segments || is_too_narrow {
            return Ok(true);
        }
        // A tool whose force is given presses by it on any mesh.
        let motion = BoundaryMotion::new(&problem.scene, problem.finest(), &solution.displacement, &problem.session);
        let Penetration { depth, approach, .. } = penetration_of(problem, &motion, contact, own);
        Ok(depth > (DEEPEST * approach).max(LEFT * largest_displacement(solved)))
    }

    /// Whether rounding alone presses where bodies lie in each other within segments, and nothing drives a body that could move then: meshes
    /// that are finer tell no more of where it lies. What moves or heats bodies may press on edges that no mesh holds yet, and goals that are
    /// `missed` on other contacts are reached all the same: rollers of a bearing lie loose beside those that carry. **Collective**
    pub(super) fn is_adrift<'g>(
        &self,
        solved: &Solved,
        mut missed: impl Iterator<Item = (usize, &'g Goal)>,
    ) -> Result<bool, SystemError> {
        let Solved { problem, solution, .. } = solved;
        if problem.scene.is_moved() || problem.scene.is_heated() {
            return Ok(false);
        }
        let u = Field::displacement(problem, &solution.displacement);
        let mut loose = Vec::new();
        for contact in &problem.contacts {
            let pressure = solution.pressure(contact);
            let off = unresolved_force(contact, &trace_points(problem, &pressure, &u)?, 0.0);
            if off > 0.0 && pressure.force().abs() < ROUNDING_BY_OVERLAP * off {
                loose.push(contact.pair.name.clone());
            }
        }
        let carries =
            |(_, goal): (usize, &Goal)| goal.quantity.contact().is_some_and(|name| !loose.iter().any(|loose| loose == name));
        Ok(!missed.any(carries) && solved.adrift_without(&loose).is_some())
    }

    /// Errors of displacement and stress at a point.
    fn probe_errors(&self, solved: &Solved, probe: &ProbePoint) -> [Option<f64>; 2] {
        let at = self.probes().iter().position(|other| other == probe);
        at.and_then(|at| solved.estimate.probes.get(at).copied()).unwrap_or([None; 2])
    }

    /// Error of λ on the worst zone of a contact. **Collective**
    fn pressure_error(&self, solved: &Solved, at: usize) -> Result<Option<f64>, SystemError> {
        let Solved { problem, solution, estimate, .. } = solved;
        let u = Field::displacement(problem, &solution.displacement);
        let pressure = solution.pressure(&problem.contacts[at]);
        let points = trace_points(problem, &pressure, &u)?;
        let zones = pressure.zones();
        let all = estimate.of_zones(at, &pressure, &zones, &points);
        let errors: Option<Vec<f64>> = pressure.counting(&zones, &all).map(|(zone, _)| zone.pressure).collect();
        if zones.is_empty() {
            // Where nothing presses, the force is all that there is to know of λ.
            return Ok(estimate.force.get(at).copied().flatten());
        }
        Ok(errors.and_then(|errors| errors.into_iter().reduce(f64::max)))
    }

    /// Whether something presses on a contact, or nothing does for sure: nothing moves bodies that lie as they are drawn, or they are
    /// farther apart than that distance changes from one point to the next, so that they do not meet in between. **Collective**
    fn presses_or_is_clear(&self, solved: &Solved, at: usize) -> Result<bool, SystemError> {
        let Solved { problem, solution, estimate, .. } = solved;
        let pressure = solution.pressure(&problem.contacts[at]);
        let (pair, is_at_rest) = (&pressure.contact.pair, estimate.difference == Some(0.0));
        if !pressure.zones().is_empty() || is_at_rest && !matches!(pair.gap, GapChoice::Formula(_)) {
            return Ok(true);
        }
        let u = Field::displacement(problem, &solution.displacement);
        let points = trace_points(problem, &pressure, &u)?;
        let gaps: Vec<f64> = points.iter().filter(|point| point.is_complete()).map(|point| point.gap).collect();
        let change = gaps.windows(2).map(|pair| (pair[1] - pair[0]).abs()).fold(0.0, f64::max);
        let least = if is_at_rest { -BY_ROUNDING * pressure.contact.boundary.length() } else { change };
        Ok(gaps.iter().all(|gap| *gap > least))
    }

    /// Whether λ of a contact is known well enough that its zones cannot be open in their middle: its error is smaller than the
    /// smallest value there is, or nothing presses. **Collective**
    fn presses_throughout(&self, solved: &Solved, at: usize) -> Result<bool, SystemError> {
        let pressure = solved.solution.pressure(&solved.problem.contacts[at]);
        let boundary = &pressure.contact.boundary;
        let smallest = |zone: &Zone| {
            let middle =
                zone.segments.clone().filter(|&k| zone.has_in_its_middle(0.5 * boundary.segment_arcs(k).iter().sum::<f64>()));
            let least = middle.map(|k| pressure.size(k, 0.5)).fold(f64::INFINITY, f64::min);
            least / pressure.peak_of(zone)
        };
        let zones = pressure.zones();
        let Some(smallest) = pressure.counting(&zones, &zones).map(smallest).reduce(f64::min) else { return Ok(true) };
        Ok(self.pressure_error(solved, at)?.is_some_and(|error| error < smallest.min(MOST_UNKNOWN)))
    }

    /// Whether λ of a contact grows without bound towards an end of it, or where materials meet, as far as this mesh tells.
    pub(super) fn has_unbounded_peak(&self, solved: &Solved, name: &str) -> bool {
        contact_called(&solved.problem, name).is_some_and(|at| has_unbounded_peak(solved, at))
    }
}

/// Whether λ of a contact grows without bound towards an end of one of its zones, or where materials meet.
fn has_unbounded_peak(Solved { problem, solution, estimate, .. }: &Solved, at: usize) -> bool {
    let pressure = solution.pressure(&problem.contacts[at]);
    let grows = |(zone, at_ends): (&Zone, &AtEnds)| {
        (0..2)
            .any(|end| pressure.grows_towards(&problem.scene, zone, end, at_ends.map(|values| values.map(|values| values[end]))))
    };
    let zones = pressure.zones();
    zones.iter().any(|zone| pressure.grows_at_joint(zone).is_some()) || zones.iter().zip(&estimate.at_ends(at)).any(grows)
}

/// Whether another contact goes on smoothly from one and presses beside it: the edge of a common pressure is no matter of its force.
fn is_shared(Solved { problem, solution, .. }: &Solved, at: usize) -> bool {
    !smooth_joints(at, problem, solution).shared.is_empty()
}

/// Whether rounding alone presses on a contact: that of bodies which move, or grow by heat, along it or away from it. **Collective**
fn is_rounding(solved: &Solved, at: usize) -> bool {
    let Solved { problem, solution, .. } = solved;
    let (contact, moved) = (&problem.contacts[at], largest_displacement(solved));
    let boundary = &contact.boundary;
    let width = boundary.width(boundary.parameter_at(0.5 * boundary.length()));
    let modulus = contact.moduli.iter().copied().fold(0.0, f64::max);
    let force = solution.pressure(contact).force().abs();
    force > 0.0 && force < LEFT_BY_SOLVES * modulus * width * moved
}

/// Largest component of the displacement of any node (length). **Collective**
fn largest_displacement(Solved { problem, solution, .. }: &Solved) -> f64 {
    let [largest] = problem.session.max([solution.displacement.iter().fold(0.0, |most: f64, value| most.max(value.abs()))]);
    largest
}

/// The place of a contact among all.
fn contact_called(problem: &Discretisation, name: &str) -> Option<usize> {
    problem.contacts.iter().position(|contact| contact.pair.name == name)
}

/// Error in the energy norm of a solution that was there on the mesh before: what the solve leaves.
fn rounded(Solved { estimate, solution, .. }: &Solved) -> Option<f64> {
    let difference = estimate.difference.filter(|difference| *difference <= ROUNDING)?;
    Some(difference.max(solution.residual))
}
