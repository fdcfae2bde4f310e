//! A scene solved.

use crate::accuracy::Adaptation;
use crate::discretisation::{Discretisation, Solution, adrift};
use crate::procedure::boundary::BoundaryStep;
use crate::procedure::coarse_solution::CoarseSolution;
use crate::procedure::ending::{Ending, Failure};
use crate::procedure::estimates::Estimate;
use crate::procedure::sets::Pass;
use crate::system::Preconditioning;
use serde::Serialize;

/// A coarser mesh that was solved first.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct CoarseSolve {
    /// Its refinement.
    pub refine: usize,
    /// Its displacement unknowns.
    pub unknowns: usize,
    /// Krylov iterations of each solve.
    pub iterations: Vec<usize>,
}

/// A scene solved.
pub struct Solved {
    /// The mesh of the case with its contacts as they lie in the end.
    pub problem: Discretisation,
    /// What was found on it.
    pub solution: Solution,
    /// How the procedure ended.
    pub ending: Ending,
    /// Every pass of the loop over active sets on it.
    pub passes: Vec<Pass>,
    /// Every contact boundary, where some follow the solution.
    pub boundaries: Vec<BoundaryStep>,
    /// What solved it, in words.
    pub solver: String,
    /// The preconditioner that it needed.
    pub preconditioning: Preconditioning,
    /// Whether its active set was hard to find, or that of a mesh before.
    pub is_hard: bool,
    /// Estimated errors of discretisation.
    pub estimate: Estimate,
    /// The largest von Mises stress of each part (stress) on the refinement before; nothing if none was solved.
    pub coarse_stress: Option<Vec<f64>>,
    /// Coarser meshes that were solved first.
    pub coarse: Vec<CoarseSolve>,
    /// The solution on the last of them, if an accuracy was asked for.
    pub(super) before: Option<CoarseSolution>,
    /// How the mesh was adapted, if an accuracy was asked for.
    pub adaptation: Option<Adaptation>,
}

impl Solved {
    /// A scene that cannot be solved: nothing moves.
    pub fn nothing(problem: Discretisation, ending: Ending, coarse: Vec<CoarseSolve>) -> Self {
        let solution = Solution::nothing(problem.finest(), &vec![true; problem.multiplier_count()]);
        Self {
            problem,
            solution,
            ending,
            passes: Vec::new(),
            boundaries: Vec::new(),
            solver: "none".into(),
            preconditioning: Preconditioning::Sweep,
            is_hard: false,
            estimate: Estimate::default(),
            coarse_stress: None,
            coarse,
            before: None,
            adaptation: None,
        }
    }

    /// Words for the motion that is free where some contacts, by their names, hold nothing; none without such contacts. **Collective**
    pub fn adrift_without(&self, names: &[String]) -> Option<String> {
        let (contacts, mut active) = (&self.problem.contacts, self.solution.active.clone());
        let loose = contacts.iter().filter(|contact| names.contains(&contact.pair.name));
        loose.for_each(|contact| active[contact.range()].fill(false));
        if names.is_empty() { None } else { adrift(&self.problem, &active) }
    }

    /// Displacement unknowns and Krylov iterations of all solves on each refinement of the last mesh, the coarsest first.
    pub fn cycles(&self) -> Vec<[usize; 2]> {
        let last = self.passes.iter().map(|pass| pass.krylov_iterations).sum();
        let coarse = self.coarse.iter().map(|solve| [solve.unknowns, solve.iterations.iter().sum()]);
        coarse.chain([[self.problem.unknown_count(), last]]).collect()
    }

    /// Krylov iterations on all meshes, each by its unknowns, in iterations on the last one: what the solves have cost.
    pub fn work(&self) -> f64 {
        let earlier = self.adaptation.iter().flat_map(|adaptation| &adaptation.meshes).flat_map(|mesh| mesh.cycles.clone());
        let all = if self.adaptation.is_some() { earlier.collect() } else { self.cycles() };
        all.iter().map(|[unknowns, iterations]| (unknowns * iterations) as f64).sum::<f64>() / self.problem.unknown_count() as f64
    }

    /// Whether nothing acts, so that nothing moves. The same on every rank.
    pub fn is_idle(&self) -> bool {
        self.is_solved() && !self.problem.scene.is_driven(&self.problem.finest().numbering)
    }

    /// Whether what was solved does not meet the contact conditions.
    pub fn violates_contact(&self) -> bool {
        matches!(self.ending, Ending::NotConverged(Failure::ConditionsViolated(_)))
    }

    /// Whether there are displacements to look at.
    pub fn is_solved(&self) -> bool {
        self.solution.residual.is_finite()
    }
}
