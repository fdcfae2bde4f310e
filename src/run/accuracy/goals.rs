//! Goals of an accuracy in words: what is asked for, which of many goals are told, how their estimates fall from mesh to mesh, and on
//! how many unknowns they would hold.

use crate::accuracy::{Accuracy, Adaptation, AdaptedMesh, Goal, Quantity};
use crate::output::plot::{Sequence, grouped};
use crate::output::summary::{MOST_TOLD, WORST};
use crate::run::words::{figure, plain, rounded_up};

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
