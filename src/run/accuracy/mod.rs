//! What a run says of the accuracy that was asked for.

mod goals;
mod verdict;

pub(super) use goals::{estimate, name, of_how_many, request, sequences, told, would_take};
pub(super) use verdict::judge;

use super::memory;
use crate::accuracy::{Accuracy, Adaptation, AdaptedMesh, Goal, Quantity};
use crate::case::Case;
use crate::output::summary::{AccuracyStep, Cycles, GoalSummary};
use crate::petsc::Session;
use crate::procedure::Solved;

/// File of the last mesh, in the result folder.
pub const ADAPTED_MESH: &str = "adapted.msh";

/// Memory that an unknown of the displacement takes on a mesh with many macro triangles (bytes).
const BYTES: f64 = 2000.0;

/// An accuracy with a limit to its unknowns: half of the memory that is left, if nobody has set another. **Collective**
pub fn limited(accuracy: &Accuracy, session: &Session) -> Accuracy {
    let most = memory::left(session) / (2.0 * BYTES);
    Accuracy { most_unknowns: accuracy.most_unknowns.or(Some(most as usize)), ..accuracy.clone() }
}

/// How the mesh was adapted, with true errors of the goals on each mesh, if an accuracy was asked for; without any mesh if the
/// run ended before.
pub fn adaptation(case: &Case, solved: &Solved, true_errors: &[Vec<Option<f64>>]) -> Option<Adaptation> {
    let accuracy = case.accuracy.clone()?;
    // The limit by memory is none of the case.
    Some(match solved.adaptation.clone() {
        Some(mut adaptation) => {
            adaptation.meshes.iter_mut().zip(true_errors).for_each(|(mesh, errors)| mesh.true_errors.clone_from(errors));
            Adaptation { accuracy, ..adaptation }
        }
        None => Adaptation::new(accuracy),
    })
}

/// The same in the terms of `summary.json`: a step for each mesh.
pub fn summarise(Adaptation { accuracy, meshes, .. }: &Adaptation) -> Vec<AccuracyStep> {
    meshes.iter().map(|mesh| step(&accuracy.goals, mesh)).collect()
}

fn step(goals: &[Goal], mesh: &AdaptedMesh) -> AccuracyStep {
    let mut step = AccuracyStep {
        macro_triangles: mesh.macro_triangles,
        refine: mesh.refine,
        unknowns: mesh.unknowns,
        cycles: mesh.cycles.iter().map(|&[unknowns, iterations]| Cycles { unknowns, iterations }).collect(),
        seconds: mesh.seconds,
        ..AccuracyStep::default()
    };
    for (place, (goal, &estimate)) in goals.iter().zip(&mesh.errors).enumerate() {
        let error = mesh.true_errors.get(place).copied().flatten();
        let told = GoalSummary { estimate, error, asked: goal.tolerance };
        let places = match goal.quantity {
            Quantity::Energy => {
                step.energy = Some(told);
                continue;
            }
            Quantity::Displacement(_) | Quantity::Stress(_) => &mut step.probe,
            Quantity::Force(_) | Quantity::Pressure(_) | Quantity::Peak(_) | Quantity::Ends(_) => &mut step.contact,
        };
        let of = goal.quantity.of().unwrap_or_default().to_owned();
        places.entry(of).or_default().insert(goal.quantity.word().into(), told);
    }
    step
}

#[cfg(test)]
mod tests;
