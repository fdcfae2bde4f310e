//! The loop over meshes that are adapted to an accuracy: solved, judged, refined where the error is, until all goals are
//! reached.

use super::duals::weighted;
use super::marking::marked;
use super::observer::{Event, Observer, Work};
use super::settings::Procedure;
use super::solved::Solved;
use crate::accuracy::{Accuracy, Adaptation, AdaptedMesh};
use crate::contact::SegmentRule;
use crate::mesh::BisectedMesh;
use crate::petsc::StageGuard;
use crate::system::{Scene, SystemError};
use std::time::Instant;

/// Refinements of each macro triangle, at least: what two of them tell is what the mesh is adapted by.
const LEAST_REFINE: usize = 2;

/// Meshes at most.
const MOST_MESHES: usize = 40;

/// Displacement unknowns at most, if nobody has set a limit.
const MOST_UNKNOWNS: usize = 2_000_000;

/// Hears nothing of the single meshes of a sequence, but keeps their times.
struct Quiet<'a>(&'a dyn Observer);

impl Observer for Quiet<'_> {
    fn observe(&self, _: Event) {}

    fn enter(&self, work: Work) -> Option<StageGuard<'_>> {
        self.0.enter(work)
    }
}

impl Procedure<'_> {
    /// Solves a scene on one mesh after the other, until the accuracy is reached or a limit is. **Collective**
    pub(super) fn adapt(&self, scene: Scene, accuracy: &Accuracy) -> Result<Solved, SystemError> {
        let started = Instant::now();
        let mut mesh = BisectedMesh::new(scene.mesh.as_ref().clone());
        let mut scene = prepared(scene);
        let quiet = Quiet(self.observer);
        let one = Procedure { observer: &quiet, ..*self };
        let mut meshes = Vec::new();
        for number in 1.. {
            let mut solved = one.solve_on_mesh(scene.clone())?;
            let errors = one.goal_errors(&accuracy.goals, &solved)?;
            let adapted = AdaptedMesh {
                number,
                macro_triangles: scene.mesh.triangles.len(),
                refine: scene.refine,
                unknowns: solved.problem.unknown_count(),
                errors,
                seconds: started.elapsed().as_secs_f64(),
            };
            self.observer.observe(Event::Adapted { accuracy, mesh: &adapted });
            meshes.push(adapted);
            let adaptation = Adaptation { accuracy: accuracy.clone(), meshes };
            let over = self.is_over(&adaptation);
            if over || adaptation.is_reached() || number == MOST_MESHES {
                solved.adaptation = Some(adaptation);
                return Ok(solved);
            }
            let marked = self.marked(&scene, &solved, &adaptation)?;
            meshes = adaptation.meshes;
            mesh = mesh.refined(marked.into_iter()).0;
            scene = scene.on(mesh.mesh.clone(), self.session)?;
        }
        unreachable!("the loop has an end")
    }

    /// Whether a limit is reached; the same on every rank. **Collective**
    fn is_over(&self, Adaptation { accuracy, meshes }: &Adaptation) -> bool {
        let Some(last) = meshes.last() else { return false };
        let late = accuracy.most_seconds.is_some_and(|most| last.seconds > most);
        // Clocks differ from rank to rank.
        self.session.any(late) || last.unknowns > accuracy.most_unknowns.unwrap_or(MOST_UNKNOWNS)
    }

    /// The macro triangles that hold most of the error of each goal that is missed; all, if nothing tells. **Collective**
    fn marked(&self, scene: &Scene, solved: &Solved, adaptation: &Adaptation) -> Result<Vec<u32>, SystemError> {
        let left = &solved.estimate.local;
        let mut all = Vec::new();
        for (place, _) in adaptation.missed() {
            let own = match solved.solution.duals.get(place) {
                Some(Some(dual)) if !left.is_empty() => weighted(&solved.problem, left, dual, self.session)?,
                _ => left.clone(),
            };
            all.extend(marked(&self.gathered(scene, &own)));
        }
        if all.is_empty() {
            all.extend(0..scene.mesh.triangles.len() as u32);
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

/// The scene as the first mesh has it: fine enough to be judged, with segments that follow the edges of each mesh.
fn prepared(mut scene: Scene) -> Scene {
    scene.refine = scene.refine.max(LEAST_REFINE);
    for pair in &mut scene.pairs {
        pair.segments = SegmentRule::Auto;
        pair.grading = [1.0, 1.0];
    }
    scene
}
