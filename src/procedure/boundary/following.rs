//! Contact boundaries that follow the solution: fit, solve, move, and fit again, until everything stands.

use super::ends::{FoundEnd, ends_by_force, ends_of_a_part, free_ends};
use super::rest::{BoundaryStep, HELD, MOST_BOUNDARIES, MOST_HELD, left_to_the_mesh, most_left, moves, way};
use crate::accuracy::{Accuracy, share_of_nothing};
use crate::contact::{Configuration, Displacement, Known, SmoothSide};
use crate::discretisation::{BoundaryMotion, Contact, Discretisation, Solution, SystemError};
use crate::geometry::Point;
use crate::mesh::EdgeNode;
use crate::procedure::ending::Failure;
use crate::procedure::sets::relative_change;
use crate::recovery::missing_beyond;

/// Boundaries placed at most on meshes before the last one, which tell the next where its boundaries lie: their ends are aligned
/// with the pressure twice.
const MOST_ON_THE_WAY: usize = 3;

/// Number of the boundary from which on it keeps the nodes it is fitted to and its segments, and only its ends follow the pressure; one
/// that is still closed then is not cut.
const FROZEN: usize = 3;

/// Change of the displacement, relative to its norm, at which it stands, by the relative residual of the last solve.
const STILL_DISPLACEMENT: f64 = 1e2;

/// Change of the boundary, relative to its length, at which it stands, by the relative residual of the last solve: less is lost in
/// what the residual leaves of the pressure.
const STILL_BOUNDARY: f64 = 1e3;

/// Relative residual of the last solve below which boundaries stand by it alone, whatever the mesh is exact for.
const USUAL: f64 = 0.99e-8;

/// Changes at which boundary and displacement stand at most, however loose the solves are.
const MOST_STILL: f64 = 1e-4;

/// Lengths of a boundary, by that of the one before, between which its segments stay.
const ALIKE: std::ops::Range<f64> = 0.5..2.0;

/// Penetration beyond the ends, as a share of the length of Γ_C, that is no contact missed.
const MOST_BEYOND: f64 = 1e-3;

/// Force that overlaps all beyond the ends may be worth, relative to that found, before Γ_C takes them in: a tenth of what lets a
/// force be doubted.
const MOST_LOST: f64 = 1e-3;

/// What follows from a solution.
pub enum NextBoundary {
    /// Everything stands: the solution is the one. Where it stands to what the mesh is exact for, with the share of its length
    /// by which it would still move.
    Stands(Option<f64>),
    /// It does not, and will not.
    GivenUp(Failure),
    /// The bodies have moved, and these are the boundaries now.
    Again(Vec<Contact>, BoundaryMotion),
}

/// State of the loop over boundaries.
pub struct Following {
    /// Number of the boundary from which on nodes and segments stay.
    frozen: usize,
    /// Boundaries after which what there is stands, however far it would still move.
    most: usize,
    /// Relative residual of the last solve.
    pub tolerance: f64,
    displacement: Vec<f64>,
    active: Vec<bool>,
    ends: Vec<[FoundEnd; 2]>,
    /// Whether each boundary has taken up again what it had lost.
    taken_up: Vec<bool>,
    /// How far the boundary moved last before its ends were held.
    last_way: f64,
    /// How far each boundary has reached so far.
    widest: Vec<[f64; 2]>,
    /// Share of the largest force of all contacts below which one only touches: where it lies is no matter.
    nothing: f64,
    /// Share of its length by which a boundary may be left to move.
    most_left: f64,
    /// Ends of all boundaries, as the last solution has them.
    pub found: Vec<[Point; 2]>,
}

impl Following {
    /// Before the first solve; the last one goes to `tolerance`. Boundaries of a start are `settled`; contacts that
    /// carry less of the largest force than the errors that are `asked` for may lie anywhere.
    pub fn new(problem: &Discretisation, tolerance: f64, settled: bool, is_last: bool, asked: Option<&Accuracy>) -> Self {
        Self {
            most: if is_last { MOST_BOUNDARIES } else { MOST_ON_THE_WAY },
            frozen: if settled { 1 } else { FROZEN },
            tolerance,
            displacement: Vec::new(),
            active: Vec::new(),
            ends: vec![[None; 2]; problem.contacts.len()],
            taken_up: vec![false; problem.contacts.len()],
            last_way: 0.0,
            widest: vec![[f64::INFINITY, f64::NEG_INFINITY]; problem.contacts.len()],
            nothing: share_of_nothing(asked),
            most_left: most_left(asked),
            found: Vec::new(),
        }
    }

    /// Changes of the boundary and of the displacement at which they stand.
    pub fn tolerances(&self) -> [f64; 2] {
        [STILL_BOUNDARY, STILL_DISPLACEMENT].map(|factor| (factor * self.tolerance).min(MOST_STILL))
    }

    /// Looks at the solution on boundary `number` (from 1) and places the boundaries again. **Collective**
    ///
    /// # Errors
    /// [`SystemError::Case`] if a boundary can no longer be placed.
    pub fn next(
        &mut self,
        problem: &Discretisation,
        solution: &Solution,
        number: usize,
    ) -> Result<(BoundaryStep, NextBoundary), SystemError> {
        let du = self.change(problem, &solution.displacement);
        let flipped = (self.active.len() == solution.active.len())
            .then(|| self.active.iter().zip(&solution.active).filter(|(a, b)| a != b).count());
        (self.displacement, self.active) = (solution.displacement.clone(), solution.active.clone());
        let motion = BoundaryMotion::new(&problem.scene, problem.finest(), &solution.displacement, &problem.session);
        let known = self.proposals(problem, solution, number);
        let (mesh, space) = (&problem.scene.mesh, problem.finest());
        let displacement = |node: EdgeNode| motion.at(node, mesh, space);
        let next = Contact::all_again(&problem.scene, &space.numbering, problem.session.rank(), &known, &displacement)?;
        let pairs = self.counting(problem, solution, &next, number);
        let moved = way(&pairs);
        self.found = next.iter().map(Contact::ends).collect();
        let length = problem.contacts.iter().filter(|c| c.pair.follows()).map(|c| c.boundary.length()).sum();
        let step = BoundaryStep { iteration: number, length, moved, du, flipped };
        let [still_boundary, still_displacement] = self.tolerances();
        let still = du.is_some_and(|du| du <= still_displacement) && flipped == Some(0);
        if let (true, Some(way)) = (number + 1 == HELD, moved) {
            self.last_way = way;
        }
        // Corresponding points and distances move with deformed bodies, even where the curve does not. Who asks for more than
        // the usual tolerance gets it.
        let is_deformed = problem.contacts.iter().any(|contact| contact.pair.configuration == Configuration::Deformed);
        let may_be_left = (!is_deformed || du.is_some_and(|du| du <= MOST_STILL)) && self.tolerance >= USUAL;
        let left = left_to_the_mesh(&pairs, self.most_left, still_boundary).filter(|_| may_be_left);
        let next_boundary = match moved {
            // The same boundary has the same solution.
            Some(0.0) => NextBoundary::Stands(None),
            Some(way) if way <= still_boundary && still => NextBoundary::Stands(None),
            _ if left.is_some() => NextBoundary::Stands(left),
            _ if number >= self.most && self.most == MOST_ON_THE_WAY => NextBoundary::Stands(moved),
            _ if number >= self.most => NextBoundary::GivenUp(moves(&step)),
            _ => return Ok((step, NextBoundary::Again(next, motion))),
        };
        // Edges wider than the contact bend into each other beside it, on meshes before the last one.
        if matches!(next_boundary, NextBoundary::GivenUp(_)) || self.most == MOST_ON_THE_WAY {
            return Ok((step, next_boundary));
        }
        match self.beyond(problem, solution, &displacement, known) {
            Ok(None) => Ok((step, next_boundary)),
            Ok(Some(known)) => {
                let next = Contact::all_again(&problem.scene, &space.numbering, problem.session.rank(), &known, &displacement)?;
                Ok((step, NextBoundary::Again(next, motion)))
            }
            Err(failure) => Ok((step, NextBoundary::GivenUp(failure))),
        }
    }

    /// The contacts that follow before and after, without those that only touch, and without those that are narrower than an edge once
    /// their force has placed them: the mesh does not feel where within an edge a force acts.
    fn counting<'c>(
        &self,
        problem: &'c Discretisation,
        solution: &Solution,
        next: &'c [Contact],
        number: usize,
    ) -> Vec<[&'c Contact; 2]> {
        let least = self.least_force(problem, solution);
        let counts = |contact: &Contact| {
            let pressure = solution.pressure(contact);
            let is_narrow = || contact.boundary.length() < contact.edge_length() && ends_by_force(&pressure, least).is_some();
            contact.pair.follows() && pressure.force().abs() >= least && (number == 1 || !is_narrow())
        };
        problem.contacts.iter().zip(next).filter(|(old, _)| counts(old)).map(|(old, new)| [old, new]).collect()
    }

    /// The force from which a contact does more than touch (per thickness).
    fn least_force(&self, problem: &Discretisation, solution: &Solution) -> f64 {
        let forces = problem.contacts.iter().map(|contact| solution.pressure(contact).force().abs());
        self.nothing * forces.fold(0.0, f64::max)
    }

    /// What stands must not leave contact out: bodies that penetrate each other beyond the ends of Γ_C. What a boundary has lost it
    /// takes up again, once on each mesh: then gives what the boundaries are placed by, as `known` but for those ends.
    ///
    /// # Errors
    /// The failure, where bodies penetrate each other too deep.
    fn beyond(
        &mut self,
        problem: &Discretisation,
        solution: &Solution,
        displacement: Displacement,
        mut known: Vec<Known>,
    ) -> Result<Option<Vec<Known>>, Failure> {
        let (mesh, space) = (&problem.scene.mesh, problem.finest());
        let least = self.least_force(problem, solution);
        let mut is_lost = false;
        for (at, contact) in problem.contacts.iter().enumerate() {
            let pressure = solution.pressure(contact);
            // Where the force tells the ends, edges about as wide as the contact bend into each other beside it.
            let meeting = contact.known.meeting.as_ref().filter(|_| ends_by_force(&pressure, least).is_none());
            let Some(meeting) = meeting else { continue };
            let mut sides = SmoothSide::of_pair(mesh, &space.numbering, &contact.pair, displacement);
            meeting.begin(&mut sides);
            let overlap = meeting.overlap_beyond(&sides, &contact.pair, &contact.boundary, contact.edge_length());
            let worth = missing_beyond(contact, overlap.lost, pressure.force());
            let counts = worth.map_or(overlap.lost > MOST_BEYOND * contact.boundary.length(), |worth| worth > MOST_LOST);
            if contact.has_free_ends() && !self.taken_up[at] && counts {
                (self.taken_up[at], self.ends[at], is_lost) = (true, [None; 2], true);
                known[at] = Known { ends: Some(overlap.ends), segments: None, ..known[at].clone() };
            } else if overlap.depth > MOST_BEYOND * contact.boundary.length() {
                return Err(Failure::Beyond { contact: contact.pair.name.clone(), depth: overlap.depth });
            }
        }
        Ok(is_lost.then_some(known))
    }

    /// Change of the displacement since the boundary before, relative to its norm. **Collective**
    fn change(&self, problem: &Discretisation, displacement: &[f64]) -> Option<f64> {
        // A rank may have no unknowns; all know the same active set.
        (!self.active.is_empty()).then(|| relative_change(displacement, &self.displacement, &problem.session))
    }

    /// What the next boundary of each contact is placed by.
    fn proposals(&mut self, problem: &Discretisation, solution: &Solution, number: usize) -> Vec<Known> {
        let mut all = Vec::new();
        let (settled, least) = (number >= self.frozen, self.least_force(problem, solution));
        // Around a body that rolls into its place ends find theirs late: cut, `lug` takes 48 cycles instead of 24 for the same force.
        let is_cut = number < FROZEN && problem.scene.means.is_empty();
        for ((contact, ends), widest) in problem.contacts.iter().zip(&mut self.ends).zip(&mut self.widest) {
            let mut known = contact.known.clone();
            let [first, last] = contact.boundary.ends();
            *widest = [widest[0].min(first), widest[1].max(last)];
            if contact.has_free_ends() && number == HELD && self.last_way > MOST_HELD {
                // Ends that find no rest, as where contact has several zones, are left to the active set.
                all.push(Known { ends: Some(*widest), segments: None, ..known });
                continue;
            }
            if contact.has_free_ends() && number < HELD {
                let next = free_ends(&solution.pressure(contact), ends, least);
                let ratio = (next[1] - next[0]) / (last - first);
                known.ends = Some(next);
                // Segments are kept for a boundary that is nearly what it was: of another length they would be slivers, or coarse.
                if !settled || !ALIKE.contains(&ratio) {
                    known.segments = None;
                }
            }
            if contact.boundary.is_closed()
                && contact.pair.has_free_ends()
                && is_cut
                && let Some(ends) = ends_of_a_part(&solution.pressure(contact))
            {
                (known.ends, known.segments) = (Some(ends), None);
            }
            all.push(known);
        }
        all
    }
}
