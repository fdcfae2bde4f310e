//! The summary's names, its way to the disk, and what is read back.

use super::*;
use serde_json::{Value, json};

fn written(summary: &Summary) -> Value {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("summary.json");
    summary.write(&path).unwrap();
    serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap()
}

fn filled() -> Summary {
    let mut summary = Summary::new("bars", 2);
    summary.status = Status::Converged;
    summary.outer.push(Pass { iteration: 1, active: 60, du: 0.1, fallback: Some("another one".into()), ..Pass::default() });
    let contact = ContactSummary {
        ends: Some([[0.0, 3.0], [6.0, 4.0]]),
        closed: Some(vec![[0.0, 6.0]]),
        closed_points: Some(vec![[[0.0, 3.0], [6.0, 4.0]]]),
        resultant: Some([1.0, -6.0]),
        judged: ContactTrust { trust: Some(true), ..ContactTrust::default() },
        zones: vec![ZoneSummary { ends: Some([0.0, 6.0]), ..ZoneSummary::default() }],
        ..ContactSummary::default()
    };
    summary.contact.insert("seam".into(), contact);
    let part = BodySummary { von_mises_max: Some(2.0), place: Some([0.0, 3.0]), is_believed: true, ..BodySummary::default() };
    let body = BodySummary { part: Some("core".into()), parts: [("core".into(), part.clone())].into(), ..part.clone() };
    summary.body = [("lower".into(), part), ("upper".into(), body)].into();
    summary.energy.strain.insert("lower".into(), Some(1e-3));
    summary.estimate.contact.insert("seam".into(), ContactEstimate { force: Some(1e-9), ..ContactEstimate::default() });
    summary.probe.insert("corner".into(), ProbeSummary { x: Some([6.0, 4.0]), ..ProbeSummary::default() });
    summary.solver.iterations = vec![12, 7];
    summary.errors.insert("energy".into(), Some(1e-6));
    summary
}

/// Also where the summary is of another version, but not where nothing tells.
#[test]
fn provenance_reads_back_as_it_was() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("summary.json");
    assert_eq!(Provenance::of_result(folder.path()), None);
    filled().write(&path).unwrap();
    assert_eq!(Provenance::of_result(folder.path()), None);
    let provenance = Provenance { commit: Some("abc".into()), ranks: 2, ..Provenance::default() };
    Summary { provenance: Some(provenance.clone()), ..filled() }.write(&path).unwrap();
    assert_eq!(Provenance::of_result(folder.path()), Some(provenance));
    fs::write(&path, r#"{"provenance": {"ranks": 3}}"#).unwrap();
    assert_eq!(Provenance::of_result(folder.path()), Some(Provenance { ranks: 3, ..Provenance::default() }));
}

#[test]
fn keys_are_the_names_that_other_tools_rely_on() {
    let value = written(&filled());
    let keys = |pointer: &str| {
        let mut keys: Vec<String> = value.pointer(pointer).unwrap().as_object().unwrap().keys().cloned().collect();
        keys.sort();
        keys.join(" ")
    };
    let expected = [
        (
            "",
            "balance body boundaries case contact displacement_max energy errors estimate files memory_mib mesh mezha outer probe provenance ranks reason rigid rotation rotation_max solver status strain_max support time_s unknowns",
        ),
        ("/mesh", "h_max h_min order triangles vertices"),
        ("/unknowns", "displacement multiplier"),
        ("/outer/0", "active added boundary du iteration krylov_iterations max_penetration released residual"),
        (
            "/contact/seam",
            "approach closed closed_edges closed_points corner_angle corner_error cut_at_joint deepest depth direction_error ends force h_ratio held_force inf_sup length lost_at_ends lost_points missing missing_beyond missing_force moment multiplier oscillation place pressure_max resultant rotation_error segments shape_error shape_error_force shares_with slant slip slip_at_ends slip_error trust trust_force unresolved_force verdict zones",
        ),
        (
            "/contact/seam/zones/0",
            "corner cut_off edges ends force hertz_width lambda peak peak_at_end pressure_max segments share singular singular_at singular_at_end whole worst",
        ),
        ("/body/lower", "is_believed place verdict von_mises_max"),
        ("/body/upper", "is_believed part parts place verdict von_mises_max"),
        ("/body/upper/parts/core", "is_believed place verdict von_mises_max"),
        ("/energy", "external_work springs stationary strain total"),
        ("/estimate", "energy seam"),
        ("/estimate/seam", "force lambda peak"),
        ("/balance", "bodies energy force moment"),
        ("/probe/corner", "stress u x"),
        ("/solver", "blas coarse cycles iterations krylov name plain_residual residual"),
        ("/time_s", "assemble contact mesh output setup solve total"),
        ("/memory_mib", "max_rank sum"),
    ];
    for (pointer, names) in expected {
        assert_eq!(keys(pointer), names, "{pointer}");
    }
    assert_eq!(value["status"], json!("converged"));
    assert_eq!(value["mezha"], json!(env!("CARGO_PKG_VERSION")));
}

/// The key stands there only if an accuracy was asked for.
#[test]
fn an_accuracy_is_told_where_it_was_asked_for() {
    let without = written(&filled());
    assert!(without.get("accuracy").is_none());
    let goal = |estimate, asked| Some(GoalSummary { estimate, error: None, asked });
    let cycles = vec![Cycles { unknowns: 160, iterations: 21 }, Cycles { unknowns: 600, iterations: 12 }];
    let first = AccuracyStep { macro_triangles: 8, refine: 2, unknowns: 600, cycles, seconds: 0.25, ..AccuracyStep::default() };
    let by_word = |(word, goal): (&str, Option<GoalSummary>)| (word.to_owned(), goal.expect("a goal"));
    let seam = [("force", goal(Some(1e-3), 1e-2)), ("pressure", goal(None, 1e-3)), ("ends", goal(Some(f64::NAN), 0.02))];
    let tip = [("displacement", goal(Some(0.01), 0.05)), ("stress", goal(None, 0.1))];
    let all = AccuracyStep {
        energy: goal(Some(8.1e-5), 1e-4),
        contact: [("seam".into(), seam.map(by_word).into())].into(),
        probe: [("tip".into(), tip.map(by_word).into())].into(),
        ..first.clone()
    };
    let value = written(&Summary { accuracy: Some(vec![first, all]), ..filled() });
    let cycles = json!([{"unknowns": 160, "iterations": 21}, {"unknowns": 600, "iterations": 12}]);
    let size = json!({"macro_triangles": 8, "refine": 2, "unknowns": 600, "cycles": cycles, "seconds": 0.25});
    let mut told = size.clone();
    told["energy"] = json!({"estimate": 8.1e-5, "error": null, "asked": 1e-4});
    told["contact"] = json!({"seam": {
        "force": {"estimate": 1e-3, "error": null, "asked": 1e-2},
        "pressure": {"estimate": null, "error": null, "asked": 1e-3},
        "ends": {"estimate": null, "error": null, "asked": 0.02},
    }});
    told["probe"] = json!({"tip": {"displacement": {"estimate": 0.01, "error": null, "asked": 0.05}, "stress": {"estimate": null, "error": null, "asked": 0.1}}});
    assert_eq!(value["accuracy"], json!([size, told]), "goals that are not asked for are missing");
    let none = Summary { accuracy: Some(Vec::new()), ..filled() };
    assert_eq!(written(&none)["accuracy"], json!([]), "asked for, and ended before the first mesh");
}

/// The key stands there only if the case names units.
#[test]
fn units_are_repeated_where_the_case_names_them() {
    assert!(written(&filled()).get("units").is_none());
    let units = Units::new(Some("mm"), Some("N"), false);
    let value = written(&Summary { units, ..filled() });
    assert_eq!(value["units"], json!({"length": "mm", "force": "N", "stress": "MPa", "resultant": "N/mm"}));
}

#[test]
fn what_is_unknown_or_not_finite_is_null() {
    let mut summary = filled();
    summary.energy.total = Some(f64::NAN);
    summary.balance.force = Some(f64::INFINITY);
    summary.probe.insert("lost".into(), ProbeSummary { u: Some([f64::NAN, 1.0]), ..ProbeSummary::default() });
    let value = written(&summary);
    for pointer in ["/energy/total", "/balance/force", "/balance/moment", "/probe/lost/u/0", "/probe/lost/x", "/reason"] {
        assert_eq!(value.pointer(pointer), Some(&Value::Null), "{pointer}");
    }
}
