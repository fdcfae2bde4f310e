//! A sequence of meshes that is adapted to an accuracy, on its way: what it is refined by, and what becomes of meshes that cannot
//! be solved.

use crate::accuracy::{Accuracy, Adaptation, Quantity, SequenceEnd};
use crate::contact::SegmentRule;
use crate::discretisation::{Scene, SystemError, node_count};
use crate::element::Order;
use crate::mesh::{BisectedMesh, Origin, levels};
use crate::procedure::ending::{Ending, Failure};
use crate::procedure::sequence::foreseen::{Foreseen, Indicators, Reach, next_mesh};
use crate::procedure::solved::Solved;
use std::time::Instant;

/// Refinements of each macro triangle, at least, where these are no more unknowns than are allowed: what two of them tell is what
/// the mesh is adapted by. One tells enough to go on by; without any next to nothing is estimated.
const USUAL_REFINE: usize = 2;

/// The same where the first mesh is refined on the width of contacts already, and no smaller error is asked for than `MOST_EXACT`:
/// cutting all of its triangles into sixteen would add unknowns far from the contacts (a roller to 1e-2: 36 thousand for 9).
const REFINE_OF_RESOLVED: usize = 1;
const MOST_EXACT: f64 = 2e-3;

/// A mesh of more triangles is not too coarse for a scene that is refused on it.
const MOST_REFUSED: usize = 5000;

/// Meshes at most that cannot be solved, one after the other, before the scene itself is taken for the reason.
const MOST_FAILED: usize = 4;

/// A sequence of meshes on its way.
pub(crate) struct MeshSequence {
    /// The scene on the present mesh.
    pub scene: Scene,
    /// Refinement that the case asks for at least.
    refine_of_case: usize,
    /// The present mesh.
    pub mesh: BisectedMesh,
    /// What was asked for, and every mesh so far.
    pub adaptation: Adaptation,
    /// What was foreseen for each goal on this mesh.
    pub foreseen: Vec<Option<Foreseen>>,
    /// The last mesh that could be solved, and where the triangles of the present one lie in it.
    last: Option<Solved>,
    origins: Vec<Origin>,
    /// The first mesh that was solved for, and not to an end, where none could be solved before.
    unsolved: Option<Solved>,
    /// Meshes that could not be solved since, and why the first of them was refused.
    failed: usize,
    refusal: Option<SystemError>,
    /// When the first mesh was begun.
    pub started: Instant,
}

impl MeshSequence {
    /// Before the first mesh: that of the scene.
    pub fn new(scene: Scene, accuracy: &Accuracy) -> Self {
        let mesh = BisectedMesh::new(scene.mesh.as_ref().clone());
        Self {
            origins: mesh.origins.clone(),
            refine_of_case: scene.refine,
            scene: prepared(scene, &mesh, accuracy.most_unknowns),
            mesh,
            adaptation: Adaptation::new(accuracy.clone()),
            foreseen: vec![None; accuracy.goals.len()],
            last: None,
            unsolved: None,
            failed: 0,
            refusal: None,
            started: Instant::now(),
        }
    }

    /// Whether a mesh leaves room for finer ones: half of the unknowns that are allowed.
    pub fn has_room_for(&self, mesh: &BisectedMesh) -> bool {
        self.adaptation.accuracy.most_unknowns.is_none_or(|most| 2 * self.unknowns(mesh, self.scene.refine) <= most)
    }

    /// Begins with a mesh on which these contacts are `resolved`, for errors of `tolerance` at least.
    pub fn begin_with_resolved(&mut self, resolved: Vec<String>, tolerance: f64) {
        self.adaptation.resolved = resolved;
        if tolerance >= MOST_EXACT {
            self.scene.refine = self.scene.refine.min(self.refine_of_case.max(REFINE_OF_RESOLVED));
        }
    }

    /// Begins with another mesh than that of the file.
    pub fn begin_with(&mut self, mesh: BisectedMesh) {
        (self.origins, self.mesh) = (mesh.origins.clone(), mesh);
    }

    /// The first mesh has no more unknowns than are allowed.
    ///
    /// # Errors
    /// In words otherwise.
    pub fn check_first(&self) -> Result<(), SystemError> {
        let unknowns = self.unknowns(&self.mesh, self.scene.refine);
        match self.adaptation.accuracy.most_unknowns {
            Some(most) if unknowns > most => Err(SystemError::Case(format!(
                "accuracy: the mesh of the file alone has {unknowns} unknowns with refine = {}, and max_unknowns, or half of the memory that is left, allows {most}; draw it coarser, or allow more",
                self.scene.refine
            ))),
            _ => Ok(()),
        }
    }

    /// The last mesh that could be solved, if there is any, and where the triangles of the present one lie in it.
    pub fn last(&self) -> Option<(&Solved, &[Origin])> {
        self.last.as_ref().map(|last| (last, self.origins.as_slice()))
    }

    /// Goes on from a mesh that is solved, unless it is the end, or the next mesh would be too large, or too many could not be
    /// solved: then gives what there is.
    pub fn go_on(&mut self, solved: Solved, end: Option<SequenceEnd>, missed: &[Indicators]) -> Option<Solved> {
        if let Some(end) = end {
            return Some(self.ended_or_last(solved, end));
        }
        if solved.ending.is_converged() {
            (self.failed, self.refusal) = (0, None);
            self.origins = self.mesh.as_first().origins;
        } else {
            self.failed += 1;
            let is_told_again = self.is_told_again(&solved.ending);
            self.refusal.get_or_insert(SystemError::Case(solved.ending.to_string()));
            if is_told_again || self.failed == MOST_FAILED {
                return Some(self.ended_or_last(solved, SequenceEnd::Unsolved));
            }
        }
        // Without a refinement there is nothing to judge by, and with one there would be too many unknowns.
        if self.scene.refine == 0 || !self.refine(missed) {
            return Some(self.ended_or_last(solved, SequenceEnd::Unknowns));
        }
        match solved.ending.is_converged() {
            true => self.last = Some(solved),
            false if self.last.is_none() => _ = self.unsolved.get_or_insert(solved),
            false => {}
        }
        None
    }

    /// Whether a body is not held, and the first mesh that could not be solved has told the same of it, but for the figures: what is so
    /// on two meshes, of which the second has edges half as long, is so of the scene.
    fn is_told_again(&self, ending: &Ending) -> bool {
        let letters = |words: &str| words.chars().filter(|letter| letter.is_alphabetic()).collect::<String>();
        match (ending, &self.refusal) {
            (Ending::NotConverged(Failure::NotHeld(words)), Some(SystemError::Case(first))) => letters(words) == letters(first),
            _ => false,
        }
    }

    /// Where the scene is refused on a mesh: that may be too coarse for it, and is refined all over, if that may help.
    pub fn goes_on_after(&mut self, error: SystemError) -> bool {
        self.failed += 1;
        self.refusal.get_or_insert(error);
        self.failed < MOST_FAILED && self.scene.mesh.triangles.len() <= MOST_REFUSED && self.refine(&[])
    }

    /// The last mesh that could be solved, after finer ones could not; without one the first whose solves came to no end.
    ///
    /// # Errors
    /// The first refusal, if there is no such mesh.
    pub fn given_up(&mut self) -> Result<Solved, SystemError> {
        if self.last.is_none()
            && let Some(unsolved) = self.unsolved.take()
        {
            return Ok(self.ended(unsolved, SequenceEnd::Unsolved));
        }
        match (self.last.take(), self.refusal.take()) {
            (None, Some(refusal)) => Err(refusal),
            (None, None) => Err(SystemError::Case("accuracy: no mesh could be solved".into())),
            (Some(last), refusal) => {
                self.refusal = refusal;
                Ok(self.without_later(last))
            }
        }
    }

    /// Whether the seconds that the case allows are over, by this rank's clock.
    pub fn is_late(&self) -> bool {
        self.adaptation.accuracy.most_seconds.is_some_and(|most| self.started.elapsed().as_secs_f64() > most)
    }

    /// A solution as the result of the sequence, unless it did not converge and an earlier one did.
    fn ended_or_last(&mut self, solved: Solved, end: SequenceEnd) -> Solved {
        match self.last.take().filter(|_| !solved.ending.is_converged()) {
            Some(last) => {
                self.refusal.get_or_insert(SystemError::Case(solved.ending.to_string()));
                self.without_later(last)
            }
            None => self.ended(solved, end),
        }
    }

    /// A solution as the result of the sequence.
    fn ended(&self, mut solved: Solved, end: SequenceEnd) -> Solved {
        solved.adaptation = Some(Adaptation { end, ..self.adaptation.clone() });
        solved
    }

    /// The last solution as the result of the sequence, which forgets the meshes after it.
    fn without_later(&mut self, last: Solved) -> Solved {
        let unknowns = last.problem.unknown_count();
        let meshes = &mut self.adaptation.meshes;
        meshes.truncate(meshes.iter().rposition(|mesh| mesh.unknowns == unknowns).map_or(0, |at| at + 1));
        self.adaptation.refusal = self.refusal.take().map(|refusal| refusal.to_string());
        self.ended(last, SequenceEnd::Refused)
    }

    /// Refines where the goals are missed, everywhere without any, if the next mesh then has no more unknowns than are allowed.
    fn refine(&mut self, missed: &[Indicators]) -> bool {
        let (most, refine) = (self.adaptation.accuracy.most_unknowns, self.scene.refine);
        let unknowns = |mesh: &BisectedMesh| self.unknowns(mesh, refine);
        let is_energy_alone = self.adaptation.missed().all(|(_, goal)| goal.quantity == Quantity::Energy);
        let reach = Reach::of(refine, is_energy_alone);
        let Some(next) = next_mesh(&self.mesh, &self.scene.pairs, (missed, reach), unknowns, most) else {
            return false;
        };
        self.origins = next.mesh.origins.iter().map(|origin| origin.within(&self.origins)).collect();
        self.mesh = next.mesh;
        let places: Vec<usize> = self.adaptation.missed().map(|(place, _)| place).collect();
        self.foreseen.fill(None);
        places.into_iter().zip(next.foreseen).for_each(|(place, foreseen)| self.foreseen[place] = foreseen);
        true
    }

    /// Displacement unknowns of a mesh.
    fn unknowns(&self, mesh: &BisectedMesh, refine: usize) -> usize {
        unknown_count(mesh, self.scene.order, refine)
    }
}

/// Displacement unknowns of a mesh.
fn unknown_count(mesh: &BisectedMesh, order: Order, refine: usize) -> usize {
    let levels = levels(order, refine);
    2 * node_count(&mesh.mesh, levels[levels.len() - 1]) as usize
}

/// The scene as the first mesh has it: fine enough to be judged, if it may be, with segments that follow the edges of each mesh.
fn prepared(mut scene: Scene, mesh: &BisectedMesh, most: Option<usize>) -> Scene {
    let usual = scene.refine.max(USUAL_REFINE);
    let fits = |refine: &usize| most.is_none_or(|most| unknown_count(mesh, scene.order, *refine) <= most);
    scene.refine = (0..=usual).rev().find(fits).unwrap_or(0);
    for pair in &mut scene.pairs {
        pair.segments = SegmentRule::Auto;
        pair.grading = [1.0, 1.0];
    }
    scene
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::accuracy::{AdaptedMesh, Goal};
    use crate::contact::MultiplierSpace;
    use crate::discretisation::samples::{blocks, pair};
    use crate::discretisation::{BoundaryMotion, Coupling, Discretisation, WithoutContact, spaces};
    use crate::geometry::Point;
    use crate::petsc::Session;
    use crate::procedure::ending::Standing;

    fn sequence() -> MeshSequence {
        let scene = blocks(pair(MultiplierSpace::P0, 4), |_| Point::zeros(), Vec::new());
        let goals = vec![Goal { quantity: Quantity::Energy, tolerance: 1e-3 }];
        MeshSequence::new(scene, &Accuracy { goals, most_unknowns: None, most_seconds: None })
    }

    /// The present mesh as if it had been solved, and kept among all.
    fn solved(sequence: &mut MeshSequence, ending: Ending) -> Solved {
        let scene = sequence.scene.clone();
        let spaces = spaces(&scene, 0).expect("a small mesh");
        let coupling = Coupling { rows: Vec::new(), gap: Vec::new(), owners: Vec::new(), lost: Vec::new() };
        let problem = Discretisation {
            session: Session::of_unit_tests(),
            scene,
            spaces,
            contacts: Vec::new(),
            coupling,
            motion: BoundaryMotion::default(),
            mean_forces: Vec::new(),
            without_contact: WithoutContact::default(),
        };
        sequence.adaptation.meshes.push(AdaptedMesh {
            number: sequence.adaptation.meshes.len() + 1,
            macro_triangles: problem.scene.mesh.triangles.len(),
            refine: 2,
            unknowns: problem.unknown_count(),
            cycles: Vec::new(),
            errors: vec![Some(1e-2)],
            true_errors: Vec::new(),
            seconds: 0.0,
        });
        Solved::nothing(problem, ending, Vec::new())
    }

    /// The next scene, on one rank.
    fn go_over(sequence: &mut MeshSequence) {
        let mesh = sequence.mesh.mesh.clone();
        let partition = crate::mesh::Partition::new(&mesh, &vec![0; mesh.triangles.len()], 1);
        sequence.scene = Scene { mesh: mesh.into(), partition: partition.into(), ..sequence.scene.clone() };
    }

    #[test]
    fn what_was_solved_to_no_end_is_the_result_where_the_next_meshes_are_refused() {
        let mut sequence = sequence();
        let failure = Failure::LinearSolver { reason: "KSP_DIVERGED_BREAKDOWN".into(), iterations: 120, residual: 1e3 };
        let first = solved(&mut sequence, Ending::NotConverged(failure));
        assert!(sequence.go_on(first, None, &[]).is_none(), "there is a next mesh");
        assert!(sequence.goes_on_after(SystemError::Case("the boundary is lost".into())), "and a next one");
        let found = sequence.given_up().expect("a result");
        assert!(matches!(found.ending, Ending::NotConverged(Failure::LinearSolver { .. })));
        assert_eq!(found.adaptation.expect("a sequence").end, SequenceEnd::Unsolved);
    }

    #[test]
    fn the_last_mesh_that_could_be_solved_is_the_result_where_finer_ones_are_refused() {
        let mut sequence = sequence();
        let first = solved(&mut sequence, Ending::Converged(Standing::Residual));
        let unknowns = first.problem.unknown_count();
        assert!(sequence.go_on(first, None, &[]).is_none(), "there is a next mesh");
        go_over(&mut sequence);
        let failure = || Ending::NotConverged(Failure::BoundaryLost("the boundary is lost".into()));
        let mut ended = None;
        for _ in 0..MOST_FAILED {
            let failed = solved(&mut sequence, failure());
            ended = sequence.go_on(failed, None, &[]);
            go_over(&mut sequence);
        }
        let ended = ended.expect("too many could not be solved");
        assert!(ended.ending.is_converged() && ended.problem.unknown_count() == unknowns);
        let adaptation = ended.adaptation.expect("a sequence");
        assert_eq!((adaptation.meshes.len(), adaptation.end), (1, SequenceEnd::Refused));
        assert_eq!(adaptation.refusal.as_deref(), Some("the boundary is lost"));
    }

    #[test]
    fn a_body_that_two_meshes_find_loose_alike_is_not_looked_at_again() {
        for (second, is_end) in [("body a has no balance at 0.26", true), ("body b has no balance at 0.25", false)] {
            let mut sequence = sequence();
            let ends = ["body a has no balance at 0.25", second].map(|words| {
                let failed = solved(&mut sequence, Ending::NotConverged(Failure::NotHeld(words.into())));
                let ended = sequence.go_on(failed, None, &[]).is_some();
                go_over(&mut sequence);
                ended
            });
            assert_eq!(ends, [false, is_end], "{second}");
        }
    }

    #[test]
    fn a_scene_that_no_mesh_can_solve_is_refused_with_the_first_reason() {
        let mut sequence = sequence();
        let mut refusals = 1..;
        while sequence.goes_on_after(SystemError::Case(format!("refusal {}", refusals.next().expect("more")))) {
            go_over(&mut sequence);
        }
        let refused = sequence.given_up().err().expect("nothing was solved").to_string();
        assert!(refused.contains("refusal 1"), "{refused}");
    }

    #[test]
    fn triangles_know_where_they_lie_in_the_last_mesh_that_was_solved() {
        let mut sequence = sequence();
        let whole = sequence.scene.mesh.triangles.len();
        let first = solved(&mut sequence, Ending::Converged(Standing::Residual));
        sequence.go_on(first, None, &[]);
        go_over(&mut sequence);
        assert!(sequence.goes_on_after(SystemError::Case("too coarse".into())));
        let (_, origins) = sequence.last().expect("the first one was solved");
        assert_eq!(origins.len(), 16 * whole, "refined twice since");
        assert!(origins.iter().all(|origin| (origin.area() - 1.0 / 16.0).abs() < 1e-12 && (origin.triangle as usize) < whole));
    }
}
