//! Whether an accuracy is reached, and in which words.

use super::goals::{name, of_how_many, told, would_take};
use crate::accuracy::{Adaptation, Goal, Quantity, SequenceEnd};
use crate::output::plot::grouped;
use crate::output::summary::Status;
use crate::run::words::{figure, plain, rounded_up};

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
