//! The loop over meshes that are adapted to an accuracy: solved, judged, refined where the error is, until all goals are
//! reached.

use super::duals::weighted;
use super::marking::marked;
use super::observer::{Event, Observer, Work};
use super::settings::Procedure;
use super::solved::Solved;
use crate::accuracy::{Accuracy, Adaptation, AdaptedMesh, Goal, Quantity, SequenceEnd};
use crate::contact::SegmentRule;
use crate::mesh::{BisectedMesh, levels};
use crate::petsc::StageGuard;
use crate::system::{Scene, SystemError, node_count};
use std::cell::Cell;
use std::time::Instant;

/// Refinements of each macro triangle, at least: what two of them tell is what the mesh is adapted by.
const LEAST_REFINE: usize = 2;

/// Meshes at most.
const MOST_MESHES: usize = 40;

/// Meshes within which the error of a goal must fall to this share, or it will not.
const STUCK: usize = 6;
const FALLS: f64 = 0.8;

/// Meshes in a row that tell that λ grows without bound.
const UNBOUNDED: usize = 4;

/// How much larger a mesh must be after so many, at least, if that is to be said.
const LARGER: f64 = 4.0;

/// A mesh of more triangles is not too coarse for a scene that is refused on it.
const MOST_REFUSED: usize = 5000;

/// Meshes at most that cannot be solved, one after the other, before the scene itself is taken for the reason.
const MOST_FAILED: usize = 4;

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

/// A sequence of meshes on its way.
struct MeshSequence {
    scene: Scene,
    mesh: BisectedMesh,
    adaptation: Adaptation,
    /// Meshes that could not be solved since the last one that could, and why the first of them was refused.
    failed: usize,
    refusal: Option<SystemError>,
    started: Instant,
}

impl Procedure<'_> {
    /// Solves a scene on one mesh after the other, until the accuracy is reached or a limit is. **Collective**
    pub(super) fn adapt(&self, scene: Scene, accuracy: &Accuracy) -> Result<Solved, SystemError> {
        let observer = BeforeTheFirst { observer: self.observer, is_first: Cell::new(true) };
        let inf_sup = Some(self.inf_sup == Some(true));
        let one = Procedure { observer: &observer, inf_sup, ..*self };
        let mut sequence = MeshSequence {
            mesh: BisectedMesh::new(scene.mesh.as_ref().clone()),
            scene: prepared(scene),
            adaptation: Adaptation { accuracy: accuracy.clone(), meshes: Vec::new(), end: SequenceEnd::Unsolved },
            failed: 0,
            refusal: None,
            started: Instant::now(),
        };
        sequence.check_first()?;
        loop {
            match one.solve_on_mesh(sequence.scene.clone()) {
                Err(error @ SystemError::Case(_)) => sequence.after_refusal(error)?,
                outcome => {
                    let mut solved = outcome?;
                    self.judge(&mut sequence, &solved)?;
                    let end = self.end(&sequence, &solved);
                    let marked = if end.is_none() { self.marked(&sequence, &solved)? } else { Vec::new() };
                    let end = end.or_else(|| (!sequence.refine(&marked)).then_some(SequenceEnd::Unknowns));
                    if let Some(end) = end {
                        solved.adaptation = Some(Adaptation { end, ..sequence.adaptation });
                        return Ok(solved);
                    }
                }
            }
            sequence.scene = sequence.scene.on(sequence.mesh.mesh.clone(), self.session)?;
        }
    }

    /// Estimates the errors on a mesh. **Collective**
    fn judge(&self, sequence: &mut MeshSequence, solved: &Solved) -> Result<(), SystemError> {
        let goals = &sequence.adaptation.accuracy.goals;
        let errors = if solved.ending.is_converged() { self.goal_errors(goals, solved)? } else { vec![None; goals.len()] };
        if solved.ending.is_converged() {
            (sequence.failed, sequence.refusal) = (0, None);
        } else {
            sequence.failed += 1;
        }
        let adapted = AdaptedMesh {
            number: sequence.adaptation.meshes.len() + 1,
            macro_triangles: sequence.scene.mesh.triangles.len(),
            refine: sequence.scene.refine,
            unknowns: solved.problem.unknown_count(),
            errors,
            true_errors: Vec::new(),
            seconds: sequence.started.elapsed().as_secs_f64(),
        };
        self.observer.observe(Event::Adapted { accuracy: &sequence.adaptation.accuracy, mesh: &adapted, solved });
        sequence.adaptation.meshes.push(adapted);
        Ok(())
    }

    /// Why there is no further mesh, if so: the accuracy is reached, or will not be. The same on every rank. **Collective**
    fn end(&self, MeshSequence { adaptation, failed, .. }: &MeshSequence, solved: &Solved) -> Option<SequenceEnd> {
        let meshes = &adaptation.meshes;
        let late = adaptation.accuracy.most_seconds.zip(meshes.last()).is_some_and(|(most, last)| last.seconds > most);
        // Clocks differ from rank to rank.
        let late = self.session.any(late);
        let all = [
            (!solved.is_solved() || *failed == MOST_FAILED, SequenceEnd::Unsolved),
            (adaptation.is_reached(), SequenceEnd::Reached),
            (late, SequenceEnd::Seconds),
            (self.is_unbounded(adaptation, solved), SequenceEnd::Unbounded),
            (is_stuck(adaptation), SequenceEnd::Stuck),
            (meshes.len() == MOST_MESHES, SequenceEnd::Meshes),
        ];
        all.into_iter().find(|(is_so, _)| *is_so).map(|(_, end)| end)
    }

    /// Whether the largest λ of a contact is asked for, and grows without bound, as some meshes in a row have told.
    fn is_unbounded(&self, adaptation: &Adaptation, solved: &Solved) -> bool {
        let Some(then) = adaptation.meshes.len().checked_sub(UNBOUNDED) else { return false };
        let never = |place: usize| adaptation.meshes[then..].iter().all(|mesh| mesh.errors[place].is_none());
        let grows = |goal: &Goal| matches!(&goal.quantity, Quantity::Peak(name) if self.has_unbounded_peak(solved, name));
        adaptation.missed().any(|(place, goal)| never(place) && grows(goal))
    }

    /// The macro triangles that hold most of the error of each goal that is missed; all, if nothing tells. **Collective**
    fn marked(&self, sequence: &MeshSequence, solved: &Solved) -> Result<Vec<u32>, SystemError> {
        // A rank may have no macro triangle: all of them know whether there is a difference.
        let (left, is_known) = (&solved.estimate.local, solved.estimate.difference.is_some());
        let (scene, adaptation) = (&sequence.scene, &sequence.adaptation);
        let mut all = Vec::new();
        for (place, _) in adaptation.missed() {
            let own = match solved.solution.duals.get(place) {
                Some(Some(dual)) if is_known => weighted(&solved.problem, left, dual, self.session)?,
                _ => left.clone(),
            };
            let mut indicators = self.gathered(scene, &own);
            if indicators.iter().all(|&value| value == 0.0) {
                indicators = self.gathered(scene, left);
            }
            all.extend(marked(&indicators));
        }
        if all.is_empty() {
            return Ok(sequence.all_triangles());
        }
        all.sort_unstable();
        all.dedup();
        Ok(all)
    }

    /// Values of all macro triangles, from those of each rank. **Collective**
    fn gathered(&self, scene: &Scene, own: &[f64]) -> Vec<f64> {
        let mut all = vec![0.0; scene.mesh.triangles.len()];
        for (&triangle, &value) in scene.partition.triangles_of(self.session.rank()).iter().zip(own) {
            all[triangle as usize] = value;
        }
        self.session.sum(&mut all);
        all
    }
}

impl MeshSequence {
    fn all_triangles(&self) -> Vec<u32> {
        (0..self.scene.mesh.triangles.len() as u32).collect()
    }

    /// The first mesh has no more unknowns than are allowed.
    ///
    /// # Errors
    /// In words otherwise.
    fn check_first(&self) -> Result<(), SystemError> {
        let unknowns = self.unknowns(&self.mesh);
        match self.adaptation.accuracy.most_unknowns {
            Some(most) if unknowns > most => Err(SystemError::Case(format!(
                "accuracy: the mesh of the file alone has {unknowns} unknowns with refine = {}, and max_unknowns, or half of the memory that is left, allows {most}; draw it coarser, or allow more",
                self.scene.refine
            ))),
            _ => Ok(()),
        }
    }

    /// Where the scene is refused on a mesh: that may be too coarse for it, and is refined all over.
    ///
    /// # Errors
    /// The first refusal, if finer meshes do not help.
    fn after_refusal(&mut self, error: SystemError) -> Result<(), SystemError> {
        self.failed += 1;
        self.refusal.get_or_insert(error);
        let helps =
            self.failed < MOST_FAILED && self.scene.mesh.triangles.len() <= MOST_REFUSED && self.refine(&self.all_triangles());
        if helps { Ok(()) } else { self.refusal.take().map_or(Ok(()), Err) }
    }

    /// Refines the marked triangles, if the next mesh then has no more unknowns than are allowed.
    fn refine(&mut self, marked: &[u32]) -> bool {
        let next = self.mesh.refined(marked.iter().copied());
        let fits = self.adaptation.accuracy.most_unknowns.is_none_or(|most| self.unknowns(&next) <= most);
        if fits {
            self.mesh = next;
        }
        fits
    }

    /// Displacement unknowns of a mesh.
    fn unknowns(&self, mesh: &BisectedMesh) -> usize {
        let levels = levels(self.scene.order, self.scene.refine);
        2 * node_count(&mesh.mesh, levels[levels.len() - 1]) as usize
    }
}

/// Whether the estimate of a goal that is missed has not fallen for some meshes.
fn is_stuck(adaptation: &Adaptation) -> bool {
    let meshes = &adaptation.meshes;
    let Some(then) = meshes.len().checked_sub(STUCK + 1) else { return false };
    let last = &meshes[meshes.len() - 1];
    // The best of the meshes before, and the best of the last few.
    let best =
        |meshes: &[AdaptedMesh], place: usize| meshes.iter().filter_map(|mesh| mesh.errors[place]).fold(f64::INFINITY, f64::min);
    let stuck = |place: usize| {
        let last = best(&meshes[then + 1..], place);
        last.is_infinite() || last > FALLS * best(&meshes[..=then], place)
    };
    last.unknowns as f64 > LARGER * meshes[then].unknowns as f64 && adaptation.missed().any(|(place, _)| stuck(place))
}

/// The scene as the first mesh has it: fine enough to be judged, with segments that follow the edges of each mesh.
fn prepared(mut scene: Scene) -> Scene {
    scene.refine = scene.refine.max(LEAST_REFINE);
    for pair in &mut scene.pairs {
        pair.segments = SegmentRule::Auto;
        pair.grading = [1.0, 1.0];
    }
    scene
}
