//! What a run says of the accuracy that was asked for.

use super::memory;
use crate::accuracy::{Accuracy, Adaptation, AdaptedMesh, Goal, Quantity, SequenceEnd};
use crate::case::Case;
use crate::output::plot::Sequence;
use crate::output::summary::{AccuracyStep, Cycles, GoalSummary, MOST_TOLD, Status, WORST};
use crate::petsc::Session;
use crate::procedure::Solved;

/// File of the last mesh, in the result folder.
pub const ADAPTED_MESH: &str = "adapted.msh";

/// So many meshes tell how an error falls.
const LAST: usize = 3;

/// Beyond so many unknowns an extrapolation says no more than that there are more.
const MOST_FORETOLD: f64 = 1e12;

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
        *place_of(&goal.quantity, &mut step) = Some(GoalSummary { estimate, error, asked: goal.tolerance });
    }
    step
}

/// Where a step tells of a quantity.
fn place_of<'a>(quantity: &Quantity, step: &'a mut AccuracyStep) -> &'a mut Option<GoalSummary> {
    match quantity {
        Quantity::Energy => &mut step.energy,
        Quantity::Force(name) => &mut step.contact.entry(name.clone()).or_default().force,
        Quantity::Pressure(name) => &mut step.contact.entry(name.clone()).or_default().pressure,
        Quantity::Peak(name) => &mut step.contact.entry(name.clone()).or_default().peak,
        Quantity::Ends(name) => &mut step.contact.entry(name.clone()).or_default().ends,
        Quantity::Displacement(probe) => &mut step.probe.entry(probe.name.clone()).or_default().displacement,
        Quantity::Stress(probe) => &mut step.probe.entry(probe.name.clone()).or_default().stress,
    }
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

/// What is reached, and on what: `energy to 8.1e-5 (asked 1e-4): 21 868 unknowns on 7 meshes, 0.31 s`; beside what is missed,
/// what it would take.
fn words(adaptation: &Adaptation) -> String {
    let goal = |place: usize| {
        let goal = &adaptation.accuracy.goals[place];
        let reached = match estimate(adaptation, place) {
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
fn limits(Adaptation { accuracy, end, refusal, .. }: &Adaptation) -> String {
    let unknowns = accuracy.most_unknowns.map(|most| format!("{} unknowns", grouped(most)));
    let seconds = accuracy.most_seconds.map(|most| format!("{} s", plain(most)));
    let all: Vec<String> = unknowns.iter().cloned().chain(seconds).collect();
    let allowed = if all.is_empty() { String::new() } else { format!("; the case allows {}", all.join(" and ")) };
    let end = match end {
        SequenceEnd::Unknowns if unknowns.is_none() => "; the next mesh would take more than half of the memory that is left",
        SequenceEnd::Stuck => "; an estimate no longer falls, or cannot be had",
        SequenceEnd::Meshes => "; there are no more meshes than that",
        SequenceEnd::Unbounded => {
            "; a largest λ that is asked for grows without bound towards an end of contact: it has no value, ask for pressure or force instead"
        }
        _ => "",
    };
    let refusal = refusal.as_ref().map(|words| format!("; no finer mesh could be solved: {words}")).unwrap_or_default();
    allowed + end + &refusal
}

/// Why a goal is missed whose estimate is what was asked for: on the first mesh that may be luck.
fn first_mesh_words(adaptation: &Adaptation, place: usize) -> &'static str {
    let is_missed = adaptation.missed().any(|(missed, _)| missed == place);
    let is_small = estimate(adaptation, place).is_some_and(|error| error <= adaptation.accuracy.goals[place].tolerance);
    if is_missed && is_small { ", and a quarter of it on the first mesh" } else { "" }
}

/// What a goal that is missed would take: `, which would take some 300 000 unknowns`.
fn would_take(adaptation: &Adaptation, place: usize) -> Option<String> {
    let needed = unknowns_needed(adaptation, place)?;
    Some(if needed > MOST_FORETOLD {
        format!(", which would take more than {} unknowns", grouped(MOST_FORETOLD as usize))
    } else {
        format!(", which would take some {} unknowns", grouped(rounded_up(needed).round() as usize))
    })
}

/// Unknowns on which a goal that is missed would hold, if its estimate falls on like `unknowns^-p`, with p from the last three
/// meshes. Nothing if it holds, if one of these meshes does not tell the error, or if it does not fall.
fn unknowns_needed(adaptation: &Adaptation, place: usize) -> Option<f64> {
    let Adaptation { accuracy, meshes, .. } = adaptation;
    let last = Adaptation { meshes: meshes[meshes.len().checked_sub(LAST)?..].to_vec(), ..Adaptation::new(accuracy.clone()) };
    let sequence = sequence(&last, place);
    let order = sequence.order().filter(|order| *order > 0.0)?;
    let (unknowns, error) = *sequence.estimates.last()?;
    let excess = error / sequence.asked;
    (excess > 1.0).then(|| unknowns * excess.powf(1.0 / order))
}

/// The next larger number of two digits and zeros; rounding makes no number larger.
fn rounded_up(number: f64) -> f64 {
    let unit = 10_f64.powf(number.log10().floor() - 1.0);
    (number / unit * (1.0 - 1e-9)).ceil() * unit
}

/// Estimated error of a goal on the last mesh.
fn estimate(adaptation: &Adaptation, place: usize) -> Option<f64> {
    adaptation.meshes.last().and_then(|mesh| mesh.errors.get(place).copied().flatten())
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

/// Two digits at most: `8.1e-5`, `4e-4`.
fn figure(error: f64) -> String {
    if error == 0.0 { "0".into() } else { format!("{error:.1e}").replace(".0e", "e") }
}

/// A number of the case, however large or small: `0.5`, `1e-300`.
fn plain(number: f64) -> String {
    if (1e-4..1e7).contains(&number) { number.to_string() } else { format!("{number:e}") }
}

/// A count in groups of three digits: `21 868`.
fn grouped(count: usize) -> String {
    let digits = count.to_string();
    let groups: Vec<&str> = digits.as_bytes().rchunks(3).rev().map(|group| std::str::from_utf8(group).expect("digits")).collect();
    groups.join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::accuracy::ProbePoint;

    fn adapted(last: [Option<f64>; 2]) -> Adaptation {
        let goal = |quantity, tolerance| Goal { quantity, tolerance };
        let goals = vec![goal(Quantity::Energy, 1e-4), goal(Quantity::Pressure("seam".into()), 1e-3)];
        let mesh = |number, unknowns, errors: [Option<f64>; 2], seconds| AdaptedMesh {
            number,
            macro_triangles: 8 * number,
            refine: 3,
            unknowns,
            cycles: vec![[unknowns, 12]],
            errors: errors.into(),
            true_errors: Vec::new(),
            seconds,
        };
        let meshes = vec![mesh(1, 600, [Some(1e-2), None], 0.02), mesh(2, 21_868, last, 0.314)];
        Adaptation {
            accuracy: Accuracy { goals, most_unknowns: None, most_seconds: None },
            resolved: Vec::new(),
            meshes,
            end: SequenceEnd::Reached,
            refusal: None,
        }
    }

    #[test]
    fn the_verdict_says_what_is_reached() {
        let reached = adapted([Some(8.14e-5), Some(4e-4)]);
        let words = "energy to 8.1e-5 (asked 1e-4), pressure of seam to 4e-4 (asked 1e-3): 21 868 unknowns on 2 meshes, 0.31 s";
        let (status, reason) = judge(&reached, Status::Converged, "the set stands");
        assert_eq!((status, reason), (Status::Converged, format!("{words}; the set stands")));
        let (status, reason) = judge(&reached, Status::NotConverged, "values are missed");
        assert_eq!((status, reason), (Status::NotConverged, format!("values are missed; {words}")));
        let none = Adaptation { meshes: Vec::new(), ..reached };
        assert_eq!(judge(&none, Status::NotConverged, "a mechanism"), (Status::NotConverged, "a mechanism".into()));
    }

    #[test]
    fn what_is_not_reached_has_not_converged() {
        for last in [[Some(1.1e-4), Some(4e-4)], [Some(8e-5), None], [Some(f64::NAN), Some(4e-4)]] {
            let (status, reason) = judge(&adapted(last), Status::Converged, "the set stands");
            assert!(status == Status::NotConverged && reason.starts_with("the accuracy is not reached: energy to "), "{reason}");
        }
        let none = Adaptation { meshes: Vec::new(), ..adapted([None; 2]) };
        let (status, reason) = judge(&none, Status::Converged, "the set stands");
        assert!(status == Status::NotConverged && reason.contains("no mesh was adapted"), "{reason}");
    }

    /// Estimates of the energy on meshes of 1000, 2000, 4000 ... unknowns; asked is 1e-4.
    fn falling(errors: &[f64]) -> Adaptation {
        let adapted = adapted([None; 2]);
        let mesh = |(k, &error): (usize, &f64)| AdaptedMesh {
            number: k + 1,
            unknowns: 1000 << k,
            errors: vec![Some(error), None],
            ..adapted.meshes[0].clone()
        };
        Adaptation {
            meshes: errors.iter().enumerate().map(mesh).collect(),
            accuracy: adapted.accuracy,
            resolved: Vec::new(),
            end: SequenceEnd::Seconds,
            refusal: None,
        }
    }

    #[test]
    fn what_is_missed_is_extrapolated_with_its_own_order() {
        for order in [0.25, 0.5, 0.9, 1.5] {
            // The first mesh is off the law, and does not count.
            let errors = [0.9, 0.03, 0.03 * 2_f64.powf(-order), 0.03 * 4_f64.powf(-order)];
            let needed = unknowns_needed(&falling(&errors), 0).unwrap();
            let expected = 2000.0 * 300_f64.powf(1.0 / order);
            assert!((needed / expected - 1.0).abs() < 1e-10, "order {order}: {needed} against {expected}");
        }
        let (status, reason) = judge(&falling(&[4e-4, 2e-4 * 2_f64.sqrt(), 2e-4]), Status::Converged, "the set stands");
        let words = "energy to 2e-4 (asked 1e-4, which would take some 16 000 unknowns), pressure of seam to an unknown error (asked 1e-3): 4 000 unknowns on 3 meshes, 0.02 s; the set stands";
        assert_eq!((status, reason), (Status::NotConverged, format!("the accuracy is not reached: {words}")));
    }

    #[test]
    fn nothing_is_extrapolated_without_an_order() {
        let none: [&[f64]; 7] = [
            &[],
            &[4e-3, 2e-3],
            &[1e-3, 1e-3, 1e-3],
            &[1e-3, 2e-3, 4e-3],
            &[4e-4, 2e-4, 1e-4],
            &[8e-3, 4e-3, 2e-3, f64::NAN],
            &[8e-3, f64::INFINITY, 4e-3, 2e-3],
        ];
        for errors in none {
            assert_eq!(unknowns_needed(&falling(errors), 0), None, "{errors:?}");
        }
        let mut unknown = falling(&[8e-3, 4e-3, 2e-3, 1e-3]);
        unknown.meshes[2].errors[0] = None;
        assert_eq!(unknowns_needed(&unknown, 0), None, "one of the last three does not tell");
    }

    #[test]
    fn what_is_missed_is_rounded_up() {
        for (number, words) in [(99.0, 99), (100.4, 110), (13_276.5, 14_000), (300_000.0, 300_000), (9.95e5, 1_000_000)] {
            assert_eq!(rounded_up(number).round() as usize, words);
        }
        assert_eq!([1.001e-4, 2e-4, 9.91e-3].map(|error| figure(rounded_up(error))), ["1.1e-4", "2e-4", "1e-2"]);
        let reason = judge(&falling(&[1.02e-4]), Status::Converged, "the set stands").1;
        assert!(reason.contains("energy to 1.1e-4 (asked 1e-4)"), "{reason}");
        let slow = would_take(&falling(&[1e-2, 0.999e-2, 0.998e-2]), 0);
        assert_eq!(slow.as_deref(), Some(", which would take more than 1 000 000 000 000 unknowns"));
    }

    #[test]
    fn limits_of_the_case_are_named() {
        let mut missed = falling(&[4e-4, 2e-4]);
        (missed.accuracy.most_unknowns, missed.accuracy.most_seconds) = (Some(2000), Some(0.5));
        let reason = judge(&missed, Status::Converged, "the set stands").1;
        assert!(reason.ends_with("0.02 s; the case allows 2 000 unknowns and 0.5 s; the set stands"), "{reason}");
    }

    #[test]
    fn the_summary_has_every_mesh_and_goal() {
        let mut adaptation = adapted([Some(8e-5), None]);
        let probe = ProbePoint { name: "tip".into(), body: "a".into(), point: crate::geometry::Point::new(0.0, 0.0) };
        let goals = [
            Quantity::Force("seam".into()),
            Quantity::Ends("glue".into()),
            Quantity::Peak("glue".into()),
            Quantity::Displacement(probe.clone()),
            Quantity::Stress(probe),
        ];
        adaptation.accuracy.goals.extend(goals.map(|quantity| Goal { quantity, tolerance: 0.1 }));
        adaptation.meshes[1].errors.extend([0.01, 0.02, 0.05, 0.03, 0.04].map(Some));
        let told = summarise(&adaptation);
        assert_eq!(told.iter().map(|step| (step.macro_triangles, step.unknowns)).collect::<Vec<_>>(), [(8, 600), (16, 21_868)]);
        let goal = |estimate, asked| Some(GoalSummary { estimate, error: None, asked });
        let last = &told[1];
        assert_eq!((&last.energy, &last.contact["seam"].pressure), (&goal(Some(8e-5), 1e-4), &goal(None, 1e-3)));
        assert_eq!((&last.contact["seam"].force, &last.contact["glue"].ends), (&goal(Some(0.01), 0.1), &goal(Some(0.02), 0.1)));
        assert_eq!(last.contact["glue"].peak, goal(Some(0.05), 0.1));
        assert_eq!(last.contact["glue"].pressure, None, "only what is asked for");
        let tip = &last.probe["tip"];
        assert_eq!((&tip.displacement, &tip.stress), (&goal(Some(0.03), 0.1), &goal(Some(0.04), 0.1)));
        assert!(summarise(&Adaptation { meshes: Vec::new(), ..adaptation }).is_empty());
    }

    #[test]
    fn a_figure_shows_what_is_known() {
        let mut adapted = adapted([Some(8e-5), Some(4e-4)]);
        adapted.meshes[1].true_errors = vec![Some(7e-5), None];
        let shown = sequences(&adapted);
        assert_eq!((&shown[0].name[..], &shown[0].estimates[..]), ("energy", &[(600.0, 1e-2), (21_868.0, 8e-5)][..]));
        assert_eq!((shown[1].asked, &shown[1].estimates[..]), (1e-3, &[(21_868.0, 4e-4)][..]));
        assert_eq!((&shown[0].errors[..], &shown[1].errors[..]), (&[(21_868.0, 7e-5)][..], &[][..]));
        let told = summarise(&adapted)[1].energy.clone();
        assert_eq!(told, Some(GoalSummary { estimate: Some(8e-5), error: Some(7e-5), asked: 1e-4 }));
    }

    #[test]
    fn of_many_goals_the_worst_are_told() {
        let mut many = adapted([None; 2]);
        let force = |k: usize| Goal { quantity: Quantity::Force(format!("c{k}")), tolerance: 1e-2 };
        many.accuracy.goals.extend((0..40).map(force));
        for mesh in &mut many.meshes {
            mesh.errors = vec![Some(2e-4), Some(5e-4)];
            mesh.errors.extend((0..40).map(|k| if k == 7 { None } else { Some(1e-3 * f64::from(k)) }));
        }
        let (_, reason) = judge(&many, Status::Converged, "the set stands");
        let words = "the worst of 42 goals, of which 11 hold: force of c7 to an unknown error (asked 1e-2), force of c39 to 3.9e-2 (asked 1e-2), force of c38 to 3.8e-2 (asked 1e-2): ";
        assert!(reason.contains(words), "{reason}");
        let shown: Vec<String> = sequences(&many).into_iter().map(|sequence| sequence.name).collect();
        assert_eq!(shown, ["force of c7", "force of c39", "force of c38"]);
        let asked = "energy to 1e-4, pressure of seam to 1e-3, force of 40 to 1e-2";
        assert_eq!(request(&many.accuracy), asked);
    }

    #[test]
    fn a_request_is_one_line() {
        let mut accuracy = adapted([None; 2]).accuracy;
        assert_eq!(request(&accuracy), "energy to 1e-4, pressure of seam to 1e-3");
        let probe = ProbePoint { name: "tip".into(), body: "a".into(), point: crate::geometry::Point::new(0.0, 0.0) };
        accuracy.goals = vec![Goal { quantity: Quantity::Stress(probe), tolerance: 0.05 }];
        (accuracy.most_unknowns, accuracy.most_seconds) = (Some(1_100_000), Some(2.5));
        assert_eq!(request(&accuracy), "stress at tip to 5e-2; at most 1 100 000 unknowns; no further mesh after 2.5 s");
        assert_eq!([0.001, 1000.0, 1e-300, 1e300].map(plain), ["0.001", "1000", "1e-300", "1e300"]);
        assert_eq!([7, 999, 1000].map(grouped), ["7", "999", "1 000"]);
    }
}
