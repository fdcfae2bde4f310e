//! Every hard case of cases/hard/study.toml, on coarse meshes, with one pair of spaces, on 1, 2 and 3 ranks: an exit code and
//! words that are true, the same for every number of ranks.

use crate::support::mesh::{GOOD, Mesh, grid, write_scene};
use crate::support::{Ended, Run, ranks_in_turn};
use toml::{Table, Value};

/// How a row must end.
struct Ending {
    code: i32,
    /// Whether it may converge all the same. Without an inf-sup constant it is chance whether an active set stands: that hangs
    /// on rounding, and on three ranks a factor is not added up in the same order each time.
    or_converges: bool,
    /// Pieces of the reason, or of what stands on standard error.
    words: &'static [&'static str],
    /// Whether the pressure is to be trusted, where that is asked.
    trust: Option<bool>,
    /// Largest relative error of ∫λ ds, where there is one to compare with.
    force: Option<f64>,
    /// The same of λ.
    lambda: Option<f64>,
}

/// The endings of all rows, by their names in the study. One that is not here must be good.
fn ending(row: &str) -> Ending {
    let stands = &["the active set stands and the residual is below its tolerance"];
    let idle = &["nothing presses on contact seam"];
    let good = |lambda| Ending { code: 0, or_converges: false, words: stands, trust: Some(true), force: Some(1e-6), lambda };
    let bad = |code, words, trust| Ending { code, or_converges: false, words, trust, force: None, lambda: None };
    match row {
        // Coordinates are rounded to 1e-8 of the length.
        "moved by 1e8 L, patch" => good(Some(1e-5)),
        _ if row.ends_with("patch") => good(Some(1e-7)),
        // A floating body a million times stiffer than the other.
        // The soft body is strained a hundred times its length: λ of the linear model stands, but is not one to trust.
        "E2/E1 = 1e-6" | "lower floats, E2/E1 = 1e-6" => {
            Ending { words: &["body upper strained by"], trust: Some(false), ..good(Some(0.03)) }
        }
        "E2/E1 = 1e6" => Ending { words: &["rounding allows no less"], ..good(Some(0.03)) },
        "H/h = 1/2, stabilise = false" | "H/h = 1/4, stabilise = false" => {
            let lost = bad(3, &["pressure unreliable: contact seam (inf-sup constant 0.0"], Some(false));
            Ending { or_converges: true, ..lost }
        }
        "matching, segments = edges, stabilise = false" | "a segment of 1e-6 h, stabilise = false" => {
            bad(0, &["pressure unreliable: contact seam (inf-sup constant 0.0"], Some(false))
        }
        _ if row.starts_with("H/h") => good(Some(0.05)),
        "just touching, no load" | "load reversed, upper bar held" => bad(0, idle, None),
        "load reversed" => bad(3, &["body upper can move by (0, 1): load.top drives it there", "turn the load round"], None),
        // On these meshes it is narrower than an edge.
        "contact 0.8 edges wide" | "contact 0.8 edges wide, 768 segments" | "contact 3.2 edges wide" => {
            Ending { code: 3, words: &["contact seam", "take mesh.refine = "], trust: Some(false), ..good(None) }
        }
        // Contact on few edges, so coarse, and on four edges between two singular corners: λ is rough.
        _ if row.starts_with("contact ") || row == "corners on an edge" => Ending { words: &[], trust: None, ..good(None) },
        _ if row.contains("across the line") => good(Some(0.1)),
        _ => good(Some(0.03)),
    }
}

/// A row of the study: its name, the file of its case, and what is set.
struct Row {
    name: String,
    case: String,
    set: Vec<(String, Value)>,
}

fn rows() -> Vec<Row> {
    let text = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/cases/hard/study.toml")).expect("the study");
    let study: Table = toml::from_str(&text).expect("TOML");
    let table = |value: Option<&Value>| value.and_then(Value::as_table).cloned().unwrap_or_default();
    let row = |curve: &Value| {
        let mut set = table(study.get("set"));
        set.extend(table(curve.get("set")));
        let [name, case] = [&curve["name"], &curve["cases"][0]].map(|value| value.as_str().expect("a text").to_string());
        Row { name, case: format!("hard/{case}"), set: set.into_iter().collect() }
    };
    study["curve"].as_array().expect("curves").iter().map(row).collect()
}

impl Row {
    /// So many refinements less than the case has, and segments as many times fewer.
    fn coarser(&self, by: u32, ranks: usize) -> Ended {
        let fewer = |key: &str, value: &Value| match value.as_integer() {
            Some(count) if key == "contact.seam.segments" => Value::Integer(count >> by),
            _ => value.clone(),
        };
        let run = Run::case(&self.case).set("mesh.refine", 3 - by);
        let run = if ranks == 1 { run.alone() } else { run.ranks(ranks) };
        self.set.iter().fold(run, |run, (key, value)| run.set(key, fewer(key, value))).ended()
    }

    /// Ends as it must; gives the strain energy, if there is one.
    fn check(&self, ended: &Ended, ranks: usize) -> Option<f64> {
        let (name, must) = (&self.name, ending(&self.name));
        let expected = ended.code == Some(must.code) || must.or_converges && ended.code == Some(0);
        assert!(expected, "{name}, {ranks} ranks, exit code {:?}:\n{}", ended.code, ended.said());
        let reason = if must.code == 2 { String::new() } else { ended.value("/reason").to_string() };
        for words in must.words {
            let found = reason.contains(words) || ended.errors.contains(words);
            assert!(found, "{name}, {ranks} ranks: no `{words}` in:\n{reason}\n{}", ended.errors);
        }
        if must.code == 2 {
            assert_eq!(ended.left_behind(), Vec::<String>::new(), "{name}: a result is left");
            return None;
        }
        if must.trust.is_some() {
            assert_eq!(ended.value("/contact/seam/trust").as_bool(), must.trust, "{name}, {ranks} ranks: {reason}");
        }
        for (key, most) in [("force_seam", must.force), ("lambda_seam", must.lambda)] {
            let Some(most) = most else { continue };
            let error = ended.number(&format!("/errors/{key}"));
            assert!(error <= most, "{name}, {ranks} ranks: {key} {error:e}");
        }
        ended.summary().pointer("/energy/total").and_then(serde_json::Value::as_f64)
    }
}

/// The ranks of a row run at the same time: they wait for each other more than for the processor.
#[test]
fn every_row_ends_as_it_must_on_any_number_of_ranks() {
    let rows = rows();
    assert!(rows.len() >= 60, "{} rows", rows.len());
    for (at, row) in rows.iter().enumerate() {
        let all = ranks_in_turn(at);
        let ended: Vec<_> = std::thread::scope(|scope| {
            let runs: Vec<_> = all.iter().map(|ranks| scope.spawn(|| row.coarser(2, *ranks))).collect();
            runs.into_iter().map(|run| run.join().expect("a run ends")).collect()
        });
        let energies: Vec<_> = ended.iter().zip(&all).map(|(ended, ranks)| row.check(ended, *ranks)).collect();
        if ending(&row.name).code == 0 {
            let [one, others @ ..] = &energies[..] else { unreachable!() };
            let size = one.expect("an energy").abs();
            let same = others.iter().all(|other| (other.expect("an energy") - size).abs() <= 1e-6 * size);
            assert!(same, "{}: energies {energies:?} on {all:?} ranks", row.name);
        }
    }
}

/// The motion is told in the axes of the scene, however it is turned.
#[test]
fn a_body_that_is_free_is_told_with_its_motion() {
    for (mesh, words) in
        [("small.msh", "can move by (0, 1): load.top drives it"), ("turned.msh", "can move by (-0.7536, 1): load.top drives it")]
    {
        for ranks in ranks_in_turn(0) {
            let run = Run::case("hard/bars.toml").set("mesh.refine", 0).set("mesh.file", mesh).set("load.top.pressure", -1.0);
            // What is expected there is of another mesh.
            let ended = run.set("exact", "{}").ranks(ranks).ended();
            assert_eq!(ended.code, Some(3), "{}", ended.said());
            let reason = ended.value("/reason").to_string();
            assert!(reason.contains(words), "{mesh}, {ranks} ranks: {reason}");
        }
    }
}

/// The resultant is right, and no figure of stability sees anything; the width and the estimate do.
#[test]
fn a_contact_narrower_than_an_edge_is_told_by_its_estimate() {
    let rows = rows();
    let estimates = |name: &str, ranks: usize| {
        let row = rows.iter().find(|row| row.name == name).expect("a row of the study");
        let ended = row.coarser(0, ranks);
        row.check(&ended, ranks);
        (
            ended.number("/estimate/energy"),
            ended.value("/estimate/seam/lambda").as_f64(),
            ended.number("/contact/seam/zones/0/worst"),
            ended.value("/contact/seam/trust") == true,
        )
    };
    for ranks in ranks_in_turn(1) {
        // All signs of a zone that narrow may be small beside its error: none of them is an estimate.
        let (energy, lambda, worst, trust) = estimates("contact 0.8 edges wide", ranks);
        assert!(energy > 0.3 && lambda.is_none() && worst > 0.1 && !trust, "{ranks} ranks: {energy}, {lambda:?}, {worst}");
        let (energy, lambda, worst, trust) = estimates("as it stands", ranks);
        let good = energy < 0.02 && lambda.is_some_and(|lambda| lambda < 0.01) && trust;
        assert!(good, "{ranks} ranks: {energy}, {lambda:?}, {worst}");
    }
}

/// A square that stands on its corner touches in a point; there is no line to be had, and no curve to be fitted.
#[test]
fn a_corner_that_points_at_an_edge_is_refused() {
    let mesh = Mesh {
        bodies: vec![
            ("lower", grid(4, 2, 1, |u, v| [4.0 * u, v]), ["bottom", "right", "lower.seam", "left"]),
            ("upper", grid(2, 2, 2, |u, v| [2.1 + u - v, 1.0 + u + v]), ["upper.seam", "top", "top", "left"]),
        ],
    };
    let folder = tempfile::tempdir().expect("a temporary folder");
    let fitted = GOOD.replace("curve = \"line\", gap = \"closed\"", "curve = \"fit\"");
    for (scene, words) in [
        (GOOD, "\"lower.seam\" and \"upper.seam\" are not parallel"),
        (&fitted, "\"lower.seam\" and \"upper.seam\" come near each other at one node only, at (2, 1)"),
    ] {
        let file = write_scene(folder.path(), &mesh.text(), scene);
        for ranks in ranks_in_turn(0) {
            let ended = Run::file(&file).ranks(ranks).ended();
            assert_eq!(ended.code, Some(2), "{}", ended.said());
            assert!(ended.errors.contains(words), "{}", ended.errors);
        }
    }
}

/// More spans than the nodes bear, or segments than the edges: words with a number that will do.
#[test]
fn spans_and_segments_without_measure_are_refused() {
    for (case, key, words) in [
        ("hertz", "contact.seam.spans", "nodes, which bear"),
        ("hertz", "contact.seam.segments", "32 segments to an edge are none too few; give"),
        (
            "hard/bars.toml",
            "contact.seam.segments",
            "have 56 edges at most, 32 segments to an edge are none too few; give 1792 or fewer",
        ),
    ] {
        let ended = Run::case(case).set(key, 100_000).ended();
        assert_eq!((ended.code, ended.left_behind().len()), (Some(2), 0), "{}", ended.said());
        assert!(ended.errors.contains(words) && ended.errors.contains("or \"auto\""), "{}", ended.errors);
    }
}

/// A block with a round foot of radius 5 on a plate.
const FOOT: &str = r#"
mesh = { file = "mesh.msh", refine = 3 }
body.plate = { young = 210000.0, poisson = 0.3 }
body.foot = { young = 210000.0, poisson = 0.3 }
geometry.round = { curves = ["round"], circle = { centre = [0, 5], radius = 5 } }
support.ground = { on = "ground", ux = 0.0, uy = 0.0 }
support.top = { on = "top", ux = 0.0 }
load.top = { on = "top", pressure = 125.0 }
contact.seam = { between = ["table", "round"] }
"#;

/// The foot and the plate in a file of a folder.
fn foot(folder: &std::path::Path, case: &str) -> std::path::PathBuf {
    let plate = grid(4, 2, 1, |u, v| [20.0 * u - 10.0, 10.0 * v - 10.0]);
    let round = |x: f64| 5.0 - (25.0 - x * x).sqrt();
    let foot = grid(2, 2, 2, |u, v| [8.0 * u - 4.0, round(8.0 * u - 4.0) * (1.0 - v) + 4.0 * v]);
    let bodies = vec![("plate", plate, ["ground", "", "table", ""]), ("foot", foot, ["round", "", "top", ""])];
    write_scene(folder, &Mesh { bodies }.text(), case)
}

/// Edges of .6 where the contact is .47 wide: Γ_C lies as its force has it, and the mesh cannot hold its pressure.
#[test]
fn a_contact_narrower_than_an_edge_is_not_resolved() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = foot(folder.path(), FOOT);
    for ranks in ranks_in_turn(1) {
        let ended = Run::file(&file).ranks(ranks).ended();
        assert_eq!((ended.code, ended.value("/status")), (Some(3), "unresolved".into()), "{}", ended.said());
        let reason = ended.value("/reason").to_string();
        assert!(reason.contains("wide by its force, less than an edge") && reason.contains("take mesh.refine ="), "{reason}");
        assert!(ended.output.contains("mezha: NOT resolved: contact seam"), "{}", ended.said());
        assert_eq!(ended.value("/contact/seam/trust"), false);
        let width = ended.number("/contact/seam/length");
        assert!((0.4..0.6).contains(&width), "Γ_C is {width} long, the contact .47 wide");
    }
}

/// Wavy bodies that touch along a part of a single segment: where λ presses in the mean, they lie in each other.
#[test]
fn bodies_in_each_other_are_not_resolved() {
    let seam = |low: f64, high: f64, cells, seed| grid(cells, 2, seed, move |u, v| [2.0 * u, low + v * (high - low)]);
    let bodies = vec![
        ("lower", seam(0.0, 1.0, 5, 1), ["bottom", "", "lower.seam", "left"]),
        ("upper", seam(1.0, 2.0, 6, 2), ["upper.seam", "", "top", "left"]),
    ];
    let wavy = GOOD.replace("gap = \"closed\"", "gap = \"1e-3*(1 - cos(pi*x))\", segments = 1");
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = write_scene(folder.path(), &Mesh { bodies }.text(), &wavy);
    for ranks in ranks_in_turn(0) {
        let ended = Run::file(&file).ranks(ranks).set("mesh.refine", 2).ended();
        assert_eq!((ended.code, ended.value("/status")), (Some(3), "unresolved".into()), "{}", ended.said());
        assert!(ended.value("/reason").to_string().contains("the bodies lie in each other by"), "{}", ended.said());
        assert!(ended.number("/contact/seam/depth") > 0.1 * ended.number("/contact/seam/approach"), "{}", ended.said());
    }
}

/// Lengths of 1e-60: the right-hand side lies below PETSc's own absolute tolerance.
#[test]
fn the_smallest_right_hand_side_is_solved() {
    let seam = |low: f64, high: f64, cells, seed| grid(cells, 2, seed, move |u, v| [2e-60 * u, 1e-60 * (low + v * (high - low))]);
    let bodies = vec![
        ("lower", seam(0.0, 1.0, 5, 1), ["bottom", "", "lower.seam", "left"]),
        ("upper", seam(1.0, 2.0, 6, 2), ["upper.seam", "", "top", "left"]),
    ];
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = write_scene(folder.path(), &Mesh { bodies }.text(), GOOD);
    for ranks in ranks_in_turn(1) {
        let ended = Run::file(&file).ranks(ranks).set("mesh.refine", 1).ended();
        assert_eq!(ended.code, Some(0), "{}", ended.said());
        assert!((ended.number("/contact/seam/force") / 2e-60 - 1.0).abs() < 1e-6, "{}", ended.said());
    }
}
