//! Goals of an accuracy in words: what is asked for, and which of many goals are told.

use crate::accuracy::{Accuracy, AdaptedMesh, Goal, Quantity};
use crate::output::plot::grouped;
use crate::output::summary::{MOST_TOLD, WORST};
use crate::run::words::{figure, plain};

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
