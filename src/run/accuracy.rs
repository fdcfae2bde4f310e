//! What a run says of the accuracy that was asked for.

use crate::accuracy::{Accuracy, Adaptation, AdaptedMesh, Goal, Quantity};
use crate::case::Case;
use crate::output::plot::Sequence;
use crate::output::summary::{AccuracyStep, GoalSummary, Status};
use crate::system::Solved;

/// File of the last mesh, in the result folder.
pub const ADAPTED_MESH: &str = "adapted.msh";

/// How the mesh was adapted, if an accuracy was asked for; without any mesh if the run ended before.
pub fn adaptation(case: &Case, solved: &Solved) -> Option<Adaptation> {
    let none = || case.accuracy.clone().map(|accuracy| Adaptation { accuracy, meshes: Vec::new() });
    solved.adaptation.clone().or_else(none)
}

/// The same in the terms of `summary.json`: a step for each mesh.
pub fn summarise(Adaptation { accuracy, meshes }: &Adaptation) -> Vec<AccuracyStep> {
    meshes.iter().map(|mesh| step(&accuracy.goals, mesh)).collect()
}

fn step(goals: &[Goal], mesh: &AdaptedMesh) -> AccuracyStep {
    let mut step = AccuracyStep {
        macro_triangles: mesh.macro_triangles,
        refine: mesh.refine,
        unknowns: mesh.unknowns,
        seconds: mesh.seconds,
        ..AccuracyStep::default()
    };
    for (goal, &estimate) in goals.iter().zip(&mesh.errors) {
        *place_of(&goal.quantity, &mut step) = Some(GoalSummary { estimate, asked: goal.tolerance });
    }
    step
}

/// Where a step tells of a quantity.
fn place_of<'a>(quantity: &Quantity, step: &'a mut AccuracyStep) -> &'a mut Option<GoalSummary> {
    match quantity {
        Quantity::Energy => &mut step.energy,
        Quantity::Force(name) => &mut step.contact.entry(name.clone()).or_default().force,
        Quantity::Pressure(name) => &mut step.contact.entry(name.clone()).or_default().pressure,
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
            (Status::NotConverged, format!("the accuracy is not reached: {}; {reason}", words(adaptation)))
        }
        (Status::NotConverged, _) => (status, reason.into()),
    }
}

/// The estimates on each mesh as a figure shows them: one line for each goal.
pub fn sequences(adaptation: &Adaptation) -> Vec<Sequence> {
    let goals = adaptation.accuracy.goals.iter().enumerate();
    let points = |place: usize| {
        let known =
            adaptation.meshes.iter().filter_map(move |mesh| Some((mesh.unknowns as f64, mesh.errors.get(place).copied()??)));
        known.collect()
    };
    goals.map(|(place, goal)| Sequence { name: name(&goal.quantity), asked: goal.tolerance, points: points(place) }).collect()
}

/// What is asked for, on one line: `energy to 1e-4, pressure of seam to 1e-3; at most 100 000 unknowns`.
pub fn request(accuracy: &Accuracy) -> String {
    let goals = accuracy.goals.iter().map(|goal| format!("{} to {:e}", name(&goal.quantity), goal.tolerance));
    let unknowns = accuracy.most_unknowns.map(|most| format!("; at most {} unknowns", grouped(most)));
    let seconds = accuracy.most_seconds.map(|most| format!("; no further mesh after {most} s"));
    [goals.collect::<Vec<_>>().join(", ")].into_iter().chain(unknowns).chain(seconds).collect()
}

/// What is reached, and on what: `energy to 8.1e-5 (asked 1e-4): 21 868 unknowns on 7 meshes, 0.31 s`.
fn words(adaptation: &Adaptation) -> String {
    let goal = |(place, goal): (usize, &Goal)| {
        let name = name(&goal.quantity);
        match estimate(adaptation, place) {
            Some(error) => format!("{name} to {} (asked {:e})", figure(error), goal.tolerance),
            None => format!("{name} to an unknown error (asked {:e})", goal.tolerance),
        }
    };
    let goals = adaptation.accuracy.goals.iter().enumerate().map(goal).collect::<Vec<_>>().join(", ");
    let meshes = match adaptation.meshes.len() {
        1 => "1 mesh".into(),
        count => format!("{count} meshes"),
    };
    match adaptation.meshes.last() {
        Some(last) => format!("{goals}: {} unknowns on {meshes}, {:.2} s", grouped(last.unknowns), last.seconds),
        None => format!("{goals}: no mesh was adapted"),
    }
}

/// Estimated error of a goal on the last mesh.
fn estimate(adaptation: &Adaptation, place: usize) -> Option<f64> {
    adaptation.meshes.last().and_then(|mesh| mesh.errors.get(place).copied().flatten())
}

/// `energy`, `pressure of seam`, `stress at tip`
fn name(quantity: &Quantity) -> String {
    let word = quantity.word();
    match (quantity, quantity.of()) {
        (Quantity::Displacement(_) | Quantity::Stress(_), Some(probe)) => format!("{word} at {probe}"),
        (_, Some(contact)) => format!("{word} of {contact}"),
        (_, None) => word.into(),
    }
}

/// Two digits at most: `8.1e-5`, `4e-4`.
fn figure(error: f64) -> String {
    format!("{error:.1e}").replace(".0e", "e")
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
            errors: errors.into(),
            seconds,
        };
        let meshes = vec![mesh(1, 600, [Some(1e-2), None], 0.02), mesh(2, 21_868, last, 0.314)];
        Adaptation { accuracy: Accuracy { goals, most_unknowns: None, most_seconds: None }, meshes }
    }

    #[test]
    fn the_verdict_says_what_is_reached() {
        let reached = adapted([Some(8.14e-5), Some(4e-4)]);
        let words = "energy to 8.1e-5 (asked 1e-4), pressure of seam to 4e-4 (asked 1e-3): 21 868 unknowns on 2 meshes, 0.31 s";
        let (status, reason) = judge(&reached, Status::Converged, "the set stands");
        assert_eq!((status, reason), (Status::Converged, format!("{words}; the set stands")));
        assert_eq!(judge(&reached, Status::NotConverged, "a mechanism"), (Status::NotConverged, "a mechanism".into()));
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

    #[test]
    fn the_summary_has_every_mesh_and_goal() {
        let mut adaptation = adapted([Some(8e-5), None]);
        let probe = ProbePoint { name: "tip".into(), body: "a".into(), point: crate::geometry::Point::new(0.0, 0.0) };
        let goals = [
            Quantity::Force("seam".into()),
            Quantity::Ends("glue".into()),
            Quantity::Displacement(probe.clone()),
            Quantity::Stress(probe),
        ];
        adaptation.accuracy.goals.extend(goals.map(|quantity| Goal { quantity, tolerance: 0.1 }));
        adaptation.meshes[1].errors.extend([0.01, 0.02, 0.03, 0.04].map(Some));
        let told = summarise(&adaptation);
        assert_eq!(told.iter().map(|step| (step.macro_triangles, step.unknowns)).collect::<Vec<_>>(), [(8, 600), (16, 21_868)]);
        let goal = |estimate, asked| Some(GoalSummary { estimate, asked });
        let last = &told[1];
        assert_eq!((&last.energy, &last.contact["seam"].pressure), (&goal(Some(8e-5), 1e-4), &goal(None, 1e-3)));
        assert_eq!((&last.contact["seam"].force, &last.contact["glue"].ends), (&goal(Some(0.01), 0.1), &goal(Some(0.02), 0.1)));
        assert_eq!(last.contact["glue"].pressure, None, "only what is asked for");
        let tip = &last.probe["tip"];
        assert_eq!((&tip.displacement, &tip.stress), (&goal(Some(0.03), 0.1), &goal(Some(0.04), 0.1)));
        assert!(summarise(&Adaptation { meshes: Vec::new(), ..adaptation }).is_empty());
    }

    #[test]
    fn a_figure_shows_what_is_known() {
        let shown = sequences(&adapted([Some(8e-5), Some(4e-4)]));
        assert_eq!((&shown[0].name[..], &shown[0].points[..]), ("energy", &[(600.0, 1e-2), (21_868.0, 8e-5)][..]));
        assert_eq!((shown[1].asked, &shown[1].points[..]), (1e-3, &[(21_868.0, 4e-4)][..]));
    }

    #[test]
    fn a_request_is_one_line() {
        let mut accuracy = adapted([None; 2]).accuracy;
        assert_eq!(request(&accuracy), "energy to 1e-4, pressure of seam to 1e-3");
        let probe = ProbePoint { name: "tip".into(), body: "a".into(), point: crate::geometry::Point::new(0.0, 0.0) };
        accuracy.goals = vec![Goal { quantity: Quantity::Stress(probe), tolerance: 0.05 }];
        (accuracy.most_unknowns, accuracy.most_seconds) = (Some(1_100_000), Some(2.5));
        assert_eq!(request(&accuracy), "stress at tip to 5e-2; at most 1 100 000 unknowns; no further mesh after 2.5 s");
        assert_eq!([7, 999, 1000].map(grouped), ["7", "999", "1 000"]);
    }
}
