//! The loop over meshes that are adapted to an accuracy: solved, judged, refined where the error is, until all goals are
//! reached.

use crate::accuracy::{Accuracy, Adaptation, AdaptedMesh, Goal, ProbePoint, Quantity, SequenceEnd};
use crate::body::Unbounded;
use crate::discretisation::{Contact, ContactPressure, Scene, SystemError};
use crate::geometry::Point;
use crate::mesh::{Cells, Partition};
use crate::petsc::StageGuard;
use crate::procedure::ending::MOVES;
use crate::procedure::estimates::{Duals, Estimate, weighted};
use crate::procedure::one_mesh::OneMesh;
use crate::procedure::predecessor::Predecessor;
use crate::procedure::sequence::{Indicators, LocalIndicator, MeshSequence};
use crate::procedure::settings::{Event, Observer, Procedure, Work};
use crate::procedure::solved::Solved;
use crate::recovery::unbounded_at;
use std::cell::Cell;
use std::collections::HashSet;

/// Meshes at most.
const MOST_MESHES: usize = 40;

/// Meshes within which the error of a goal must fall to this share, or it will not.
const STUCK: usize = 4;
const FALLS: f64 = 0.8;

/// Meshes in a row on which a largest λ is unknown, before it is asked whether it grows without bound.
const UNBOUNDED: usize = 4;

/// How much larger a mesh must be after so many, at least, if that is to be said.
const LARGER: f64 = 4.0;

/// Factor by which an indicator falls where nothing tells it: that of an even one.
const FALL_BESIDE: f64 = 0.25;

/// Tells what is known before the first mesh is solved; of the rest of a sequence it keeps the times alone.
struct BeforeTheFirst<'a> {
    observer: &'a dyn Observer,
    is_first: Cell<bool>,
}

impl Observer for BeforeTheFirst<'_> {
    fn observe(&self, event: Event) {
        if matches!(event, Event::AtRest { .. }) && self.is_first.replace(false) {
            self.observer.observe(event);
        }
    }

    fn enter(&self, work: Work) -> Option<StageGuard<'_>> {
        self.observer.enter(work)
    }
}

impl Procedure<'_> {
    /// Solves a scene on one mesh after the other, until the accuracy is reached or a limit is. **Collective**
    pub(super) fn adapt(&self, scene: Scene, accuracy: &Accuracy) -> Result<Solved, SystemError> {
        let observer = BeforeTheFirst { observer: self.observer, is_first: Cell::new(true) };
        let inf_sup = Some(self.inf_sup == Some(true));
        let one = Procedure { observer: &observer, inf_sup, ..*self };
        let mut sequence = MeshSequence::new(scene, accuracy);
        sequence.check_first()?;
        self.halve_by_forces(&mut sequence, accuracy)?;
        sequence.scene = sequence.scene.on(sequence.mesh.mesh.clone(), self.session)?;
        loop {
            match one.solve_next(&sequence) {
                Err(error @ SystemError::Case(_)) => {
                    let late = self.session.any(sequence.is_late());
                    if late || !sequence.goes_on_after(error) {
                        return sequence.given_up();
                    }
                }
                outcome => {
                    let solved = outcome?;
                    self.judge(&mut sequence, &solved)?;
                    let end = self.end(&sequence, &solved)?;
                    let missed = if end.is_none() { self.indicators(&sequence, &solved)? } else { Vec::new() };
                    if let Some(ended) = sequence.go_on(solved, end, &missed) {
                        return Ok(ended);
                    }
                }
            }
            sequence.scene = sequence.scene.on(sequence.mesh.mesh.clone(), self.session)?;
        }
    }

    /// The scene as it is solved first where its mesh is adapted to an accuracy.
    ///
    /// # Errors
    /// [`SystemError::Case`] if that has more unknowns than are allowed.
    pub fn first_of_sequence(scene: Scene, accuracy: &Accuracy) -> Result<Scene, SystemError> {
        let sequence = MeshSequence::new(scene, accuracy);
        sequence.check_first()?;
        Ok(sequence.scene)
    }

    /// Solves the next mesh of a sequence. **Collective**
    fn solve_next(&self, sequence: &MeshSequence) -> Result<Solved, SystemError> {
        let predecessor = sequence.last().map(|(last, origins)| Predecessor::new(last, origins));
        self.solve_on_mesh(sequence.scene.clone(), predecessor.as_ref())
    }

    /// Estimates the errors on a mesh. **Collective**
    fn judge(&self, sequence: &mut MeshSequence, solved: &Solved) -> Result<(), SystemError> {
        let goals = &sequence.adaptation.accuracy.goals;
        // What is estimated on a boundary that still moves is of another scene.
        let stands = solved.ending.is_converged() && solved.ending.still_moved().is_none_or(|way| way <= MOVES);
        let error = |goal: &Goal| if stands { self.goal_error(goal, solved) } else { Ok(None) };
        let errors = goals.iter().map(error).collect::<Result<_, _>>()?;
        let adapted = AdaptedMesh {
            number: sequence.adaptation.meshes.len() + 1,
            macro_triangles: sequence.scene.mesh.triangles.len(),
            refine: sequence.scene.refine,
            unknowns: solved.problem.unknown_count(),
            cycles: solved.cycles(),
            errors,
            true_errors: Vec::new(),
            seconds: sequence.started.elapsed().as_secs_f64(),
        };
        let adaptation = &mut sequence.adaptation;
        adaptation.meshes.push(adapted.clone());
        let wanted = adaptation.wanted();
        self.observer.observe(Event::Adapted { accuracy: &adaptation.accuracy, mesh: &adapted, wanted: &wanted, solved });
        Ok(())
    }

    /// Why there is no further mesh, if so: the accuracy is reached, or will not be. The same on every rank. **Collective**
    fn end(&self, MeshSequence { adaptation, .. }: &MeshSequence, solved: &Solved) -> Result<Option<SequenceEnd>, SystemError> {
        let meshes = &adaptation.meshes;
        let late = adaptation.accuracy.most_seconds.zip(meshes.last()).is_some_and(|(most, last)| last.seconds > most);
        // Clocks differ from rank to rank.
        let late = self.session.any(late);
        let all = [
            (!solved.is_solved(), SequenceEnd::Unsolved),
            (solved.is_idle() || adaptation.is_reached(), SequenceEnd::Reached),
            (late, SequenceEnd::Seconds),
            (self.is_unbounded(adaptation, solved), SequenceEnd::Unbounded),
            (
                is_stuck(adaptation) || !adaptation.is_reached() && self.is_adrift(solved, adaptation.missed())?,
                SequenceEnd::Stuck,
            ),
            (meshes.len() == MOST_MESHES, SequenceEnd::Meshes),
        ];
        Ok(all.into_iter().find(|(is_so, _)| *is_so).map(|(_, end)| end))
    }

    /// Whether something is asked for that has no value: a stress where that has no bound, the displacement of a point that carries a force,
    /// or the largest λ of a contact that was unknown on some meshes in a row, and grows without bound on the last.
    fn is_unbounded(&self, adaptation: &Adaptation, solved: &Solved) -> bool {
        let last = adaptation.meshes.iter().rev().take(UNBOUNDED);
        let never = |place: usize| last.len() == UNBOUNDED && last.clone().all(|mesh| mesh.errors[place].is_none());
        let Solved { problem, solution, .. } = solved;
        let unbounded = |probe: &ProbePoint| unbounded_at(problem, solution, (&probe.body, probe.point));
        let has_no_value = |(place, goal): (usize, &Goal)| match &goal.quantity {
            Quantity::Peak(name) => never(place) && self.has_unbounded_peak(solved, name),
            Quantity::Stress(probe) => unbounded(probe).is_some(),
            Quantity::Displacement(probe) => unbounded(probe) == Some(Unbounded::Point),
            _ => false,
        };
        adaptation.missed().any(has_no_value)
    }

    /// Where the errors of the goals that are missed lie. **Collective**
    fn indicators(&self, sequence: &MeshSequence, solved: &Solved) -> Result<Vec<Indicators>, SystemError> {
        // A rank may have no macro triangle: all of them know whether there is a difference.
        let Estimate { local: left, falls, energy_falls, difference, foreseen, .. } = &solved.estimate;
        let (scene, adaptation) = (&sequence.scene, &sequence.adaptation);
        let mut all = Vec::new();
        let mut duals = self.duals(adaptation, solved)?.into_iter();
        for (place, goal) in adaptation.missed() {
            let own = match duals.next().flatten() {
                Some(dual) if difference.is_some() => weighted(&solved.problem, left, &dual)?,
                _ => left.clone(),
            };
            let error = adaptation.error(place);
            let (falls, error) = match goal.quantity {
                Quantity::Energy => (energy_falls, foreseen.or(error)),
                _ => (falls, error),
            };
            let mut local = self.gathered(scene, &own, falls);
            let tells_nothing = |local: &[LocalIndicator]| local.iter().all(|indicator| indicator.cells.sum() == 0.0);
            if tells_nothing(&local) {
                local = self.gathered(scene, left, falls);
            }
            if let Some(contact) = self.not_held_by_mesh(solved, goal, tells_nothing(&local))? {
                let beside = beside(&solved.solution.pressure(contact), &scene.partition, self.session.rank());
                local = self.gathered(scene, &beside, &vec![FALL_BESIDE; beside.len()]);
            }
            let error = error.map(|error| error / goal.tolerance);
            let pace = sequence.foreseen[place].zip(error).map_or(1.0, |(foreseen, error)| foreseen.pace(error));
            all.push(Indicators { local, error, pace, is_norm: goal.quantity.is_norm() });
        }
        Ok(all)
    }

    /// The contact beside which the mesh is refined for a goal: one that it cannot hold, or of which nothing tells an error, or on which
    /// nothing presses though it may. **Collective**
    fn not_held_by_mesh<'s>(
        &self,
        solved: &'s Solved,
        goal: &Goal,
        tells_nothing: bool,
    ) -> Result<Option<&'s Contact>, SystemError> {
        if !solved.ending.is_converged() {
            return Ok(None);
        }
        if let Some(contact) = self.kept_by(goal, solved)? {
            return Ok(Some(contact));
        }
        let is_of_goal = |contact: &&Contact| goal.quantity.contact().is_some_and(|name| contact.pair.name == name);
        let counts = |contact: &&Contact| {
            let is_open = solved.solution.pressure(contact).zones().is_empty();
            is_open || tells_nothing && carries(solved, &contact.pair.name, goal.tolerance)
        };
        Ok(solved.problem.contacts.iter().find(is_of_goal).filter(counts))
    }

    /// The dual displacement of each goal that is missed, where the solution has one. **Collective**
    fn duals(&self, adaptation: &Adaptation, solved: &Solved) -> Result<Vec<Option<Vec<f64>>>, SystemError> {
        let Solved { problem, solution, preconditioning, is_hard, before, .. } = solved;
        if !solved.ending.is_converged() || adaptation.missed().all(|(_, goal)| goal.quantity == Quantity::Energy) {
            return Ok(Vec::new());
        }
        let mesh = OneMesh { procedure: self, tolerance: self.tolerance, is_last: false, is_hard: *is_hard };
        let mut system = mesh.system_again(problem, &solution.active, *preconditioning)?;
        let _stage = self.observer.enter(Work::Solve);
        let duals = Duals { solution, coarse: before.as_ref() };
        adaptation.missed().map(|(_, goal)| duals.solve(&mut system, goal)).collect()
    }

    /// Indicators of all macro triangles, from those of each rank. **Collective**
    fn gathered(&self, scene: &Scene, own: &[Cells], falls: &[f64]) -> Vec<LocalIndicator> {
        const COUNT: usize = 1 + Cells::COUNT;
        let mut all = vec![[0.0; COUNT]; scene.mesh.triangles.len()];
        for ((&triangle, cells), fall) in scene.partition.triangles_of(self.session.rank()).iter().zip(own).zip(falls) {
            all[triangle as usize][0] = *fall;
            all[triangle as usize][1..].copy_from_slice(cells.values());
        }
        self.session.sum(all.as_flattened_mut());
        all.iter().map(|values| LocalIndicator { fall: values[0], cells: Cells::new(|k| values[1 + k]) }).collect()
    }
}

/// Whether a contact carries more than a share of the largest force.
fn carries(Solved { problem, solution, .. }: &Solved, name: &str, share: f64) -> bool {
    let force = |contact: &Contact| solution.pressure(contact).force().abs();
    let largest = problem.contacts.iter().map(force).fold(0.0, f64::max);
    problem.contacts.iter().any(|contact| contact.pair.name == name && force(contact) > share * largest)
}

/// Indicators of the macro triangles of a rank that count those alone that lie where a contact presses, or a segment from there: the
/// mesh does not hold it, or nothing tells an error of it, and the mesh may be
/// too coarse to hold it. A disc spring whose edges press on plates had no estimate of its force with 446 thousand unknowns, refined all
/// over; refined beside its contacts it has one of 1.3e-2 with 88 thousand.
fn beside(pressure: &ContactPressure, partition: &Partition, rank: usize) -> Vec<Cells> {
    let (contact, boundary, zones) = (pressure.contact, &pressure.contact.boundary, pressure.zones());
    let is_near = |place: &Point| {
        let (segment, _) = boundary.locate(boundary.foot(*place));
        zones.is_empty() || zones.iter().any(|zone| (zone.segments.start..zone.segments.end + 2).contains(&(segment + 1)))
    };
    let edges = contact.edges.iter().flatten().filter(|edge| edge.places.iter().any(is_near));
    let touched: HashSet<usize> = edges.map(|edge| edge.triangle).collect();
    let counts = |triangle: &u32| f64::from(u8::from(touched.contains(&(*triangle as usize))));
    partition.triangles_of(rank).iter().map(|triangle| Cells::new(|_| counts(triangle))).collect()
}

/// Whether the estimate of a goal that is missed has not fallen for some meshes.
fn is_stuck(adaptation: &Adaptation) -> bool {
    let meshes = &adaptation.meshes;
    let Some(then) = meshes.len().checked_sub(STUCK + 1) else { return false };
    let last = &meshes[meshes.len() - 1];
    // The best of the meshes before, and the best of the last few.
    // An estimate that was small enough then was so by luck.
    let best = |meshes: &[AdaptedMesh], place: usize| {
        let tolerance = adaptation.accuracy.goals[place].tolerance;
        meshes.iter().filter_map(|mesh| mesh.errors[place]).filter(|error| *error > tolerance).fold(f64::INFINITY, f64::min)
    };
    let stuck = |place: usize| {
        let last = best(&meshes[then + 1..], place);
        last.is_infinite() || last > FALLS * best(&meshes[..=then], place)
    };
    last.unknowns as f64 > LARGER * meshes[then].unknowns as f64 && adaptation.missed().any(|(place, _)| stuck(place))
}
