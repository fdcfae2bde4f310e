//! Contact boundaries that follow the solution: fit, solve, move, and fit again, until everything stands.

use crate::contact::{Configuration, End, Known, SmoothSide, true_end};
use crate::discretisation::{BoundaryMotion, Contact, ContactPressure, Discretisation, Solution, SystemError};
use crate::geometry::Point;
use crate::mesh::EdgeNode;
use crate::petsc::Session;
use crate::procedure::ending::{Failure, HeldEnds, Standing};
use crate::procedure::sets::relative_change;
use crate::system::Start;

/// Boundaries placed at most.
const MOST_BOUNDARIES: usize = 30;

/// The same on meshes before the last one, which tell the next where its boundaries lie: their ends are aligned with the pressure twice.
const MOST_ON_THE_WAY: usize = 3;

/// From this one on, a boundary keeps the nodes it is fitted to and its segments, and its ends follow the pressure.
const FROZEN: usize = 3;

/// From this one on the ends are held where they are, should they still move.
const HELD: usize = 10;

/// Segments that press, at least, where an end is told by the pressure beside it: of a contact narrower than that the mesh knows the
/// force alone, and its ends would wander with the bend of the boundary from fit to fit.
const TELLING: usize = 3;

/// Where the force tells the width 2b, too (Hertz), it does so better as long as the segments that press, times b/R, are fewer: the
/// pressure of n segments misses the width by about .8/n² (11 - 14 % on three, 3 % on four, 1 - 4 % on nine; `packing/discs_3` and
/// `roller`), the force by some (b/R)².
const TELLING_BESIDE_A_FORCE: f64 = 0.9;

/// Change of the displacement, relative to its norm, at which it stands, by the relative residual of the last solve.
const STILL_DISPLACEMENT: f64 = 1e2;

/// The same of the boundary, relative to its length: less is lost in what the residual leaves of the pressure.
const STILL_BOUNDARY: f64 = 1e3;

/// Relative residual of the last solve below which boundaries stand by it alone, whatever the mesh is exact for.
const USUAL: f64 = 0.99e-8;

/// However loose the solves are.
const MOST_STILL: f64 = 1e-4;

/// Ends that moved by more than this share of the length just before are held where they have reached farthest, others
/// where they are.
const MOST_HELD: f64 = 1e-2;

/// Penetration beyond the ends, as a share of the length of Γ_C, that is no contact missed.
const MOST_BEYOND: f64 = 1e-3;

/// An end of Γ_C lies at the end of a body if less than this share of an edge is between them.
const AT_THE_END: f64 = 1e-2;

/// Error that the ends have on a mesh anyway, as a share of their way since the coarser one: a third, if it falls by four from
/// mesh to mesh, all of it, if by two.
const OWN_ERROR: f64 = 0.45;

/// The same by the segment beside them.
const OF_A_SEGMENT: f64 = 0.025;

/// Share of the length that ends may be left to move, however coarse the mesh is: force and peak feel the square of it.
const MOST_LEFT: f64 = 1.6e-3;

/// One boundary of the loop, in figures.
#[derive(Clone, Debug, PartialEq)]
pub struct BoundaryStep {
    /// Number of the boundary, from 1.
    pub iteration: usize,
    /// Length of all contact boundaries that follow (length).
    pub length: f64,
    /// Largest way of a segment end to the next boundary, of contacts that count, relative to the length; nothing if the segments are
    /// others.
    pub moved: Option<f64>,
    /// Change of the displacement since the boundary before, relative to its norm; nothing for the first.
    pub du: Option<f64>,
    /// Multipliers whose state has changed since the boundary before; nothing if there are others now.
    pub flipped: Option<usize>,
}

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

/// A position of an end and how far off it was found to be, in the parameter of Γ_C.
type FoundEnd = Option<(f64, f64)>;

/// State of the loop over boundaries.
pub struct Following {
    /// Number of the boundary from which on nodes and segments stay.
    frozen: usize,
    /// Boundaries after which what there is stands, however far it would still move.
    most: usize,
    /// Relative residual of the last solve.
    tolerance: f64,
    displacement: Vec<f64>,
    active: Vec<bool>,
    ends: Vec<[FoundEnd; 2]>,
    /// How far the boundary moved last before its ends were held.
    last_way: f64,
    /// How far each boundary has reached so far.
    widest: Vec<[f64; 2]>,
    /// Share of the largest force of all contacts below which one only touches: where it lies is no matter.
    nothing: f64,
    /// Ends of all boundaries, as the last solution has them.
    pub found: Vec<[Point; 2]>,
}

impl Following {
    /// Before the first solve; the last one goes to `tolerance`. Boundaries that a coarser mesh has found are `settled`; contacts that
    /// carry less than the share `nothing` of the largest force may lie anywhere.
    pub fn new(problem: &Discretisation, tolerance: f64, settled: bool, is_last: bool, nothing: f64) -> Self {
        Self {
            most: if is_last { MOST_BOUNDARIES } else { MOST_ON_THE_WAY },
            frozen: if settled { 1 } else { FROZEN },
            tolerance,
            displacement: Vec::new(),
            active: Vec::new(),
            ends: vec![[None; 2]; problem.contacts.len()],
            last_way: 0.0,
            widest: vec![[f64::INFINITY, f64::NEG_INFINITY]; problem.contacts.len()],
            nothing,
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
        session: &Session,
    ) -> Result<(BoundaryStep, NextBoundary), SystemError> {
        let du = self.change(&solution.displacement, session);
        let flipped = (self.active.len() == solution.active.len())
            .then(|| self.active.iter().zip(&solution.active).filter(|(a, b)| a != b).count());
        (self.displacement, self.active) = (solution.displacement.clone(), solution.active.clone());
        let motion = BoundaryMotion::new(&problem.scene, problem.finest(), &solution.displacement, session);
        let known = self.proposals(problem, solution, number);
        let (mesh, space) = (&problem.scene.mesh, problem.finest());
        let displacement = |node: EdgeNode| motion.at(node, mesh, space);
        let next = Contact::all_again(&problem.scene, &space.numbering, session.rank(), &known, &displacement)?;
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
        let left = left_to_the_mesh(&pairs, still_boundary).filter(|_| may_be_left);
        let next_boundary = match moved {
            // The same boundary has the same solution.
            Some(0.0) => self.beyond(problem, solution, &motion, None),
            Some(way) if way <= still_boundary && still => self.beyond(problem, solution, &motion, None),
            _ if left.is_some() => self.beyond(problem, solution, &motion, left),
            _ if number >= self.most && self.most == MOST_ON_THE_WAY => self.beyond(problem, solution, &motion, moved),
            _ if number >= self.most => NextBoundary::GivenUp(moves(&step)),
            _ => NextBoundary::Again(next, motion),
        };
        Ok((step, next_boundary))
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

    /// What stands must not leave contact out: bodies that penetrate each other beyond the ends of Γ_C.
    fn beyond(&self, problem: &Discretisation, solution: &Solution, motion: &BoundaryMotion, way: Option<f64>) -> NextBoundary {
        // Edges wider than the contact bend into each other beside it, on meshes before the last one.
        if self.most == MOST_ON_THE_WAY {
            return NextBoundary::Stands(way);
        }
        let (mesh, space) = (&problem.scene.mesh, problem.finest());
        let displacement = |node: EdgeNode| motion.at(node, mesh, space);
        let fitted =
            problem.contacts.iter().filter_map(|contact| contact.known.meeting.as_ref().map(|meeting| (contact, meeting)));
        let least = self.least_force(problem, solution);
        // Where the force tells the ends, edges about as wide as the contact bend into each other beside it.
        let fitted = fitted.filter(|(contact, _)| ends_by_force(&solution.pressure(contact), least).is_none());
        for (contact, meeting) in fitted {
            let mut sides = SmoothSide::of_pair(mesh, &space.numbering, &contact.pair, &displacement);
            meeting.begin(&mut sides);
            let depth = meeting.depth_beyond(&sides, &contact.pair, &contact.boundary, contact.edge_length());
            if depth > MOST_BEYOND * contact.boundary.length() {
                return NextBoundary::GivenUp(Failure::Beyond { contact: contact.pair.name.clone(), depth });
            }
        }
        NextBoundary::Stands(way)
    }

    /// Change of the displacement since the boundary before, relative to its norm. **Collective**
    fn change(&self, displacement: &[f64], session: &Session) -> Option<f64> {
        // A rank may have no unknowns; all know the same active set.
        (!self.active.is_empty()).then(|| relative_change(displacement, &self.displacement, session))
    }

    /// What the next boundary of each contact is placed by.
    fn proposals(&mut self, problem: &Discretisation, solution: &Solution, number: usize) -> Vec<Known> {
        let mut all = Vec::new();
        let (settled, least) = (number >= self.frozen, self.least_force(problem, solution));
        for ((contact, ends), widest) in problem.contacts.iter().zip(&mut self.ends).zip(&mut self.widest) {
            let mut known = contact.known.clone();
            let knots = contact.boundary.knots();
            *widest = [widest[0].min(knots[0]), widest[1].max(knots[knots.len() - 1])];
            if contact.has_free_ends() && number == HELD && self.last_way > MOST_HELD {
                // Ends that find no rest, as where contact has several zones, are left to the active set.
                all.push(Known { ends: Some(*widest), segments: None, ..known });
                continue;
            }
            if contact.has_free_ends() && number < HELD {
                known.ends = Some(free_ends(&solution.pressure(contact), ends, least));
                if !settled {
                    known.segments = None;
                }
            }
            if contact.boundary.is_closed()
                && contact.pair.has_free_ends()
                && !settled
                && let Some(ends) = ends_of_a_part(&solution.pressure(contact))
            {
                (known.ends, known.segments) = (Some(ends), None);
            }
            all.push(known);
        }
        all
    }
}

/// Ends of a Γ_C that is to be a part of a closed one: half a segment beyond the only zone that presses. Nothing if that goes all
/// around, or if there are several, which the active set keeps apart.
fn ends_of_a_part(pressure: &ContactPressure) -> Option<[f64; 2]> {
    let boundary = &pressure.contact.boundary;
    let zones = pressure.zones();
    let [zone] = &zones[..] else { return None };
    let half = |k: usize| 0.5 * boundary.segment_length(k);
    let ends = [zone.arcs[0] - half(zone.segments.start), zone.arcs[1] + half(zone.segments.end - 1)];
    (ends[1] - ends[0] < boundary.length()).then(|| ends.map(|arc| boundary.parameter_at(arc)))
}

/// Where the ends of a contact go: by the pressure next to them, with the secant through the last two findings; not
/// beyond the bodies' boundaries.
fn free_ends(pressure: &ContactPressure, history: &mut [FoundEnd; 2], least: f64) -> [f64; 2] {
    let ContactPressure { contact, values: lambda, active } = *pressure;
    let boundary = &contact.boundary;
    let knots = boundary.knots();
    let now = [knots[0], knots[knots.len() - 1]];
    let mut next = now;
    let edge = contact.edge_length() / boundary.speed(now[0]);
    if let Some(ends) = ends_by_force(pressure, least) {
        return ends;
    }
    // What presses up to both ends lies on too short a boundary.
    if pressing_segments(pressure) < TELLING && active.contains(&false) {
        return now;
    }
    for (k, end) in [End::First, End::Last].into_iter().enumerate() {
        // At the end of a body contact may end with any pressure: it stays there, wherever the body goes.
        let last = multipliers_at(contact, end);
        if (now[k] - contact.limits[k]).abs() < AT_THE_END * edge && last.iter().all(|&i| active[i]) {
            next[k] = contact.limits[k] + if end == End::First { -edge } else { edge };
            continue;
        }
        let Some(arc) = true_end(boundary, &contact.multipliers, lambda, active, end) else { continue };
        let off = boundary.parameter_at(arc) - now[k];
        let step = match history[k] {
            Some((before, was)) if now[k] != before => {
                let slope = (off - was) / (now[k] - before);
                if (-4.0..-0.25).contains(&slope) { -off / slope } else { off }
            }
            _ => off,
        };
        history[k] = Some((now[k], off));
        let found = now[k] + step;
        next[k] = if end == End::First { found.max(contact.limits[0]) } else { found.min(contact.limits[1]) };
    }
    // A contact smaller than an edge is none that the mesh can tell.
    if next[1].min(contact.limits[1]) - next[0].max(contact.limits[0]) > edge { next } else { now }
}

/// Ends as far from the middle of the pressure as its force presses sides that touch at a point (Hertz), or where they are if it is
/// smaller than the `least` one that counts; nothing if the sides conform, or the pressure tells the ends better.
fn ends_by_force(pressure: &ContactPressure, least: f64) -> Option<[f64; 2]> {
    let Contact { boundary, multipliers, limits, known, .. } = pressure.contact;
    let touch = known.touch?;
    let force = pressure.force();
    if force.abs() <= least {
        let knots = boundary.knots();
        return Some([knots[0], knots[knots.len() - 1]]);
    }
    let half = touch.half_width(force, pressure.contact.compliance)?;
    let pressing = pressing_segments(pressure);
    if pressing as f64 * half * touch.roundest > TELLING_BESIDE_A_FORCE {
        return None;
    }
    let of_segment = |k: usize| {
        let [start, end] = boundary.segment_arcs(k);
        let [a, b] = [0.0, 1.0].map(|z| multipliers.value(pressure.values, k, z));
        (end - start) * (0.5 * (a + b) * start + (end - start) * (a + 2.0 * b) / 6.0)
    };
    let knots = boundary.knots();
    let now = [knots[0], knots[knots.len() - 1]];
    let segment = boundary.length() / boundary.segments() as f64;
    let middle = (0..boundary.segments()).map(of_segment).sum::<f64>() / force;
    let at = |arc: f64| boundary.parameter_at(arc).clamp(limits[0], limits[1]);
    let place = |middle: f64| [at(middle - half), at(middle + half)];
    if pressing >= TELLING {
        return Some(place(middle));
    }
    // The place within a segment is not known any better: where few press, the ends would go to and fro.
    let here = 0.5 * boundary.length();
    let ends = place(if (middle - here).abs() <= 0.5 * segment { here } else { middle });
    let stays = ends.iter().zip(now).all(|(end, now)| (end - now).abs() * boundary.speed(now) <= OF_A_SEGMENT * segment);
    Some(if stays { now } else { ends })
}

/// Segments from the first that presses to the last.
fn pressing_segments(pressure: &ContactPressure) -> usize {
    let ContactPressure { contact, active, .. } = *pressure;
    let all = (0..active.len()).filter(|&i| active[i]).map(|i| contact.multipliers.segment_of(i));
    let [first, last] = all.fold([usize::MAX, 0], |[first, last], k| [first.min(k), last.max(k)]);
    (last + 1).saturating_sub(first)
}

/// Multipliers of the segment at an end.
fn multipliers_at(contact: &Contact, end: End) -> Vec<usize> {
    let segment = if end == End::First { 0 } else { contact.boundary.segments() - 1 };
    let rows = contact.multipliers.on_segment(segment, 0.0).0;
    rows[..contact.multipliers.per_segment()].to_vec()
}

/// By how much the ends of the boundaries would still move, as a share of the length, if that is less than they are exact
/// for: by their way since the coarser mesh and the segments beside them, or by what is `still`.
fn left_to_the_mesh(contacts: &[[&Contact; 2]], still: f64) -> Option<f64> {
    let mut most: f64 = 0.0;
    for [old, new] in contacts {
        let (boundary, last) = (&old.boundary, old.boundary.segments() - 1);
        let (now, next, coarser) = (old.ends(), new.ends(), new.known.coarser?);
        for (k, segment) in [0, last].into_iter().enumerate() {
            let (way, since) = ((next[k] - now[k]).norm(), (next[k] - coarser[k]).norm());
            let own = (OWN_ERROR * since).max(OF_A_SEGMENT * boundary.segment_length(segment));
            if way > own.min(MOST_LEFT * boundary.length()).max(still * boundary.length()) {
                return None;
            }
            most = most.max(way / boundary.length());
        }
    }
    Some(most)
}

/// Largest way of a segment end between two placings of some contacts, relative to the length.
fn way(contacts: &[[&Contact; 2]]) -> Option<f64> {
    let mut most: f64 = 0.0;
    for [old, new] in contacts {
        if old.boundary.segments() != new.boundary.segments() {
            return None;
        }
        let ends = old.boundary.knots().iter().zip(new.boundary.knots());
        let ways = ends.map(|(&s, &t)| (old.boundary.point(s) - new.boundary.point(t)).norm() / old.boundary.length());
        most = ways.fold(most, f64::max);
        // Corresponding points and distances move with the bodies, even if the curve does not.
        if old.pair.configuration == Configuration::Deformed {
            most = most.max(f64::MIN_POSITIVE);
        }
    }
    Some(most)
}

fn moves(&BoundaryStep { moved, du, flipped, .. }: &BoundaryStep) -> Failure {
    Failure::BoundaryMoves { fits: MOST_BOUNDARIES, moved, du, flipped }
}

/// What stands after these boundaries of some contacts: to what the mesh is exact for if there is a `way` left; `within` is
/// what stands on the last of them.
pub fn standing(contacts: &[Contact], steps: &[BoundaryStep], way: Option<f64>, within: Standing) -> Standing {
    let may_be_held = contacts.iter().any(|contact| contact.pair.has_free_ends());
    let held = steps.get(HELD - 1).filter(|_| may_be_held).map(|_| {
        let way = steps[HELD - 2].moved;
        HeldEnds { fit: HELD - 1, way, farthest: way.is_some_and(|way| way > MOST_HELD) }
    });
    Standing::Boundary { fits: steps.len(), held, way, within: Box::new(within) }
}

/// A start from a solution, on the boundary it was found on.
pub fn start_from(solution: &Solution) -> Start {
    let Solution { displacement, multipliers, active, .. } = solution;
    Start { displacement: displacement.clone(), pressures: multipliers.clone(), active: active.clone() }
}

/// The same on the next boundary, where the segments are as many as before.
pub fn carried(before: &[Contact], after: &[Contact], solution: &Solution) -> Option<Start> {
    let alike = before.iter().zip(after).all(|(a, b)| a.multipliers.count() == b.multipliers.count());
    alike.then(|| start_from(solution))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::{EndRule, Known, MultiplierSpace, Pair};
    use crate::discretisation::samples::{blocks, contact, pair};

    /// Between two places of Γ_C on the seam, which is 2 long; the first is 0.5 long.
    fn way_to(ends: [f64; 2], segments: usize, rule: EndRule) -> Option<f64> {
        let place = |ends, segments| {
            let pair = Pair { ends: rule, ..pair(MultiplierSpace::P0, segments) };
            contact(&blocks(pair, |_| Point::zeros(), Vec::new()), Known { ends: Some(ends), ..Known::default() })
        };
        way(&[[&place([0.25, 0.5], 5), &place(ends, segments)]])
    }

    #[test]
    fn the_way_of_free_ends_is_measured_by_the_length() {
        let near = |found: Option<f64>, wanted: f64| assert!((found.expect("as many") - wanted).abs() < 1e-12, "{found:?}");
        near(way_to([0.25, 0.5], 5, EndRule::Free), 0.0);
        near(way_to([0.2, 0.5], 5, EndRule::Free), 0.1 / 0.5);
        near(way_to([0.3, 0.8], 5, EndRule::Free), 0.6 / 0.5);
        assert_eq!(way_to([0.25, 0.5], 4, EndRule::Free), None, "other segments");
    }
}
