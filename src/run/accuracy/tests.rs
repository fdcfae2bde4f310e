//! What is asked for, what is reached, and what it would take, in words and in the summary.

use super::*;
use crate::accuracy::ProbePoint;
use std::collections::BTreeMap;

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

/// The line of a mesh says by itself why there is a next one: the first one wants a quarter of what is asked, but of the energy and
/// of contacts whose width was known before.
#[test]
fn the_line_of_a_mesh_says_why_the_run_goes_on() {
    let lines = |adaptation: &Adaptation| -> Vec<String> {
        let (goals, mesh) = (&adaptation.accuracy.goals, adaptation.meshes.last().expect("a mesh"));
        let line = |((goal, error), wanted): ((&Goal, &Option<f64>), f64)| estimate(goal, *error, wanted);
        goals.iter().zip(&mesh.errors).zip(adaptation.wanted()).map(line).collect()
    };
    let both = adapted([Some(8e-5), Some(4e-4)]);
    assert_eq!(lines(&both), ["energy 8.0e-5", "pressure of seam 4.0e-4"]);
    assert!(both.is_reached());
    let first = Adaptation { meshes: vec![both.meshes[1].clone()], ..both };
    let why = "it takes one more mesh, because an estimate above 2.5e-4 on the first one may be so small by luck";
    assert_eq!(lines(&first), ["energy 8.0e-5".into(), format!("pressure of seam 4.0e-4 (asked 1e-3: {why})")]);
    assert!(!first.is_reached() && Adaptation { resolved: vec!["seam".into()], ..first }.is_reached());
    let missed = adapted([Some(2e-4), None]);
    assert_eq!(lines(&missed), ["energy 2.0e-4 (asked 1e-4)", "pressure of seam unknown (asked 1e-3)"]);
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
    assert_eq!(
        (last.energy.as_ref(), last.contact["seam"].get("pressure")),
        (goal(Some(8e-5), 1e-4).as_ref(), goal(None, 1e-3).as_ref())
    );
    let of = |goals: &BTreeMap<String, GoalSummary>, word: &str| goals.get(word).cloned();
    assert_eq!(
        [of(&last.contact["seam"], "force"), of(&last.contact["glue"], "ends")],
        [0.01, 0.02].map(|at| goal(Some(at), 0.1))
    );
    assert_eq!(of(&last.contact["glue"], "peak"), goal(Some(0.05), 0.1));
    assert_eq!(of(&last.contact["glue"], "pressure"), None, "only what is asked for");
    let tip = &last.probe["tip"];
    assert_eq!([of(tip, "displacement"), of(tip, "stress")], [0.03, 0.04].map(|at| goal(Some(at), 0.1)));
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
