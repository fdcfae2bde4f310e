//! What a run says of the accuracy that was asked for: goals in words, which of many are told, how their estimates fall from mesh to
//! mesh, on how many unknowns they would hold, and whether they are reached.

use super::memory;
use crate::accuracy::{Accuracy, Adaptation, AdaptedMesh, Goal, Quantity, SequenceEnd};
use crate::case::Case;
use crate::output::plot::{Sequence, grouped};
use crate::output::summary::{AccuracyStep, Cycles, GoalSummary, MOST_TOLD, Status, WORST};
use crate::petsc::Session;
use crate::procedure::Solved;
use crate::run::words::{figure, plain, rounded_up};

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

/// The goals that are told one by one: all of a few, of many those whose estimates on a mesh, or what is asked, leave least room.
pub fn told(Accuracy { goals, .. }: &Accuracy, mesh: Option<&AdaptedMesh>) -> Vec<usize> {
    let mut places: Vec<usize> = (0..goals.len()).collect();
    if goals.len() > MOST_TOLD {
        let excess = |place: usize| {
            let estimate = mesh.and_then(|mesh| mesh.errors.get(place).copied().flatten()).filter(|error| !error.is_nan());
            estimate.map_or(f64::INFINITY, |estimate| estimate / goals[place].tolerance)
        };
        places.sort_by(|&a, &b| excess(b).total_cmp(&excess(a)));
        places.truncate(WORST);
    }
    places
}

/// What stands before the goals that are told of many: `the worst of 297 goals, of which 12 hold: `.
pub fn of_how_many(accuracy: &Accuracy, mesh: Option<&AdaptedMesh>) -> String {
    let goals = &accuracy.goals;
    if goals.len() <= MOST_TOLD {
        return String::new();
    }
    let errors = mesh.map_or(&[][..], |mesh| &mesh.errors);
    let holding = errors.iter().zip(goals).filter(|(error, goal)| error.is_some_and(|error| error <= goal.tolerance)).count();
    format!("the worst of {} goals, of which {holding} hold: ", goals.len())
}

/// What is asked for, on one line: `energy to 1e-4, pressure of seam to 1e-3; at most 100 000 unknowns`.
pub fn request(accuracy: &Accuracy) -> String {
    let mut alike: Vec<(&Goal, usize)> = Vec::new();
    for goal in &accuracy.goals {
        let key = |goal: &Goal| (goal.quantity.word(), goal.tolerance);
        match alike.iter_mut().find(|(known, _)| accuracy.goals.len() > MOST_TOLD && key(known) == key(goal)) {
            Some((_, count)) => *count += 1,
            None => alike.push((goal, 1)),
        }
    }
    let goals = alike.iter().map(|(goal, count)| match count {
        1 => format!("{} to {:e}", name(&goal.quantity), goal.tolerance),
        _ => format!("{} of {count} to {:e}", goal.quantity.word(), goal.tolerance),
    });
    let unknowns = accuracy.most_unknowns.map(|most| format!("; at most {} unknowns", grouped(most)));
    let seconds = accuracy.most_seconds.map(|most| format!("; no further mesh after {} s", plain(most)));
    [goals.collect::<Vec<_>>().join(", ")].into_iter().chain(unknowns).chain(seconds).collect()
}

/// The estimate of a goal on a mesh, and what is asked if that is more than what is `wanted` there: `energy 1.3e-2`,
/// `pressure of seam 4.0e-2 (asked 1e-2)`. A first mesh on which less than that is wanted says why.
pub fn estimate(goal: &Goal, error: Option<f64>, wanted: f64) -> String {
    let words = format!("{} {}", name(&goal.quantity), error.map_or("unknown".into(), |error| format!("{error:.1e}")));
    match error {
        Some(error) if error <= wanted => words,
        Some(error) if error <= goal.tolerance => format!(
            "{words} (asked {:e}: it takes one more mesh, because an estimate above {} on the first one may be so small by luck)",
            goal.tolerance,
            figure(wanted)
        ),
        _ => format!("{words} (asked {:e})", goal.tolerance),
    }
}

/// `energy`, `pressure of seam`, `stress at tip`
pub fn name(quantity: &Quantity) -> String {
    let word = quantity.word();
    match (quantity, quantity.of()) {
        (Quantity::Displacement(_) | Quantity::Stress(_), Some(probe)) => format!("{word} at {probe}"),
        (_, Some(contact)) => format!("{word} of {contact}"),
        (_, None) => word.into(),
    }
}

/// So many meshes tell how an error falls.
const LAST: usize = 3;

/// Beyond so many unknowns an extrapolation says no more than that there are more.
const MOST_FORETOLD: f64 = 1e12;

/// The estimates on each mesh as a figure shows them, and the true errors as far as they are known: for each goal that is told.
pub fn sequences(adaptation: &Adaptation) -> Vec<Sequence> {
    told(&adaptation.accuracy, adaptation.meshes.last()).into_iter().map(|place| sequence(adaptation, place)).collect()
}

fn sequence(Adaptation { accuracy, meshes, .. }: &Adaptation, place: usize) -> Sequence {
    let goal = &accuracy.goals[place];
    let points = |of: fn(&AdaptedMesh) -> &[Option<f64>]| {
        meshes.iter().filter_map(|mesh| Some((mesh.unknowns as f64, of(mesh).get(place).copied()??))).collect()
    };
    let (estimates, errors) = (points(|mesh| &mesh.errors), points(|mesh| &mesh.true_errors));
    Sequence { name: name(&goal.quantity), asked: goal.tolerance, estimates, errors }
}

/// Unknowns on which a goal that is missed would hold, if its estimate falls on like `unknowns^-p`, with p from the last three
/// meshes. Nothing if it holds, if one of these meshes does not tell the error, or if it does not fall.
pub fn unknowns_needed(adaptation: &Adaptation, place: usize) -> Option<f64> {
    let Adaptation { accuracy, meshes, .. } = adaptation;
    let last = Adaptation { meshes: meshes[meshes.len().checked_sub(LAST)?..].to_vec(), ..Adaptation::new(accuracy.clone()) };
    let sequence = sequence(&last, place);
    let order = sequence.order().filter(|order| *order > 0.0)?;
    let (unknowns, error) = *sequence.estimates.last()?;
    let excess = error / sequence.asked;
    (excess > 1.0).then(|| unknowns * excess.powf(1.0 / order))
}

/// What a goal that is missed would take: `, which would take some 300 000 unknowns`.
pub fn would_take(adaptation: &Adaptation, place: usize) -> Option<String> {
    let needed = unknowns_needed(adaptation, place)?;
    Some(if needed > MOST_FORETOLD {
        format!(", which would take more than {} unknowns", grouped(MOST_FORETOLD as usize))
    } else {
        format!(", which would take some {} unknowns", grouped(rounded_up(needed).round() as usize))
    })
}

/// Status and reason of a run that was asked for an accuracy: it has converged only if that is reached.
pub fn judge(adaptation: &Adaptation, status: Status, reason: &str) -> (Status, String) {
    match (status, adaptation.is_reached()) {
        (Status::Converged, true) => (status, format!("{}; {reason}", words(adaptation))),
        (Status::Converged, false) => {
            let words = format!("{}{}", words(adaptation), limits(adaptation));
            (Status::NotConverged, format!("the accuracy is not reached: {words}; {reason}"))
        }
        (Status::NotConverged, _) if adaptation.meshes.is_empty() => (status, reason.into()),
        (Status::NotConverged | Status::Unresolved | Status::Interrupted, _) => {
            (status, format!("{reason}; {}", words(adaptation)))
        }
    }
}

/// What is reached, and on what: `energy to 8.1e-5 (asked 1e-4): 21 868 unknowns on 7 meshes, 0.31 s`; beside what is missed,
/// what it would take.
fn words(adaptation: &Adaptation) -> String {
    let goal = |place: usize| {
        let goal = &adaptation.accuracy.goals[place];
        let reached = match adaptation.error(place) {
            // What is missed must not look like what was asked for.
            Some(error) if error > goal.tolerance => figure(rounded_up(error)),
            Some(error) => figure(error),
            None => "an unknown error".into(),
        };
        let would_take = would_take(adaptation, place).unwrap_or_else(|| first_mesh_words(adaptation, place).into());
        format!("{} to {reached} (asked {:e}{would_take})", name(&goal.quantity), goal.tolerance)
    };
    let last = adaptation.meshes.last();
    let goals = told(&adaptation.accuracy, last).into_iter().map(goal).collect::<Vec<_>>().join(", ");
    let goals = of_how_many(&adaptation.accuracy, last) + &goals;
    let meshes = match adaptation.meshes.len() {
        1 => "1 mesh".into(),
        count => format!("{count} meshes"),
    };
    match last {
        Some(last) => format!("{goals}: {} unknowns on {meshes}, {:.2} s", grouped(last.unknowns), last.seconds),
        None => format!("{goals}: no mesh was adapted"),
    }
}

/// The limits that the case sets, and what else has ended the sequence: `; the case allows 2 000 unknowns and 5 s`.
fn limits(adaptation: &Adaptation) -> String {
    let Adaptation { accuracy, end, refusal, .. } = adaptation;
    let is_at_probe = |goal: &Goal| matches!(goal.quantity, Quantity::Stress(_) | Quantity::Displacement(_));
    let has_no_value = |(place, goal): (usize, &Goal)| is_at_probe(goal) && adaptation.error(place).is_none();
    let unknowns = accuracy.most_unknowns.map(|most| format!("{} unknowns", grouped(most)));
    let seconds = accuracy.most_seconds.map(|most| format!("{} s", plain(most)));
    let all: Vec<String> = unknowns.iter().cloned().chain(seconds).collect();
    let allowed = if all.is_empty() { String::new() } else { format!("; the case allows {}", all.join(" and ")) };
    let end = match end {
        SequenceEnd::Unknowns if unknowns.is_none() => "; the next mesh would take more than half of the memory that is left",
        SequenceEnd::Stuck => "; an estimate no longer falls, or cannot be had",
        SequenceEnd::Meshes => "; there are no more meshes than that",
        SequenceEnd::Unbounded if adaptation.missed().any(has_no_value) => {
            "; what is asked for at a probe has no value: a stress at a re-entrant corner, at an end of what holds a body, where materials meet or under a pressing corner, or the displacement of a point that carries a force; ask for it at another point"
        }
        SequenceEnd::Unbounded => {
            "; a largest λ that is asked for grows without bound, towards an end of its contact, where materials meet, or at a corner of a side: it has no value, ask for pressure or force instead"
        }
        _ => "",
    };
    let refusal = refusal.as_ref().map(|words| format!("; no finer mesh could be solved: {words}")).unwrap_or_default();
    allowed + end + &refusal
}

/// Why a goal is missed whose estimate is what was asked for: on the first mesh that may be luck.
fn first_mesh_words(adaptation: &Adaptation, place: usize) -> &'static str {
    let is_missed = adaptation.missed().any(|(missed, _)| missed == place);
    let is_small = adaptation.error(place).is_some_and(|error| error <= adaptation.accuracy.goals[place].tolerance);
    if is_missed && is_small { ", and a quarter of it on the first mesh" } else { "" }
}

#[cfg(test)]
mod tests;
