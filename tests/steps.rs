//! Load steps: each against closed forms, and against the same scene by itself.

use crate::support::mesh::{GOOD, Mesh, grid, write_scene};
use crate::support::{Ended, PAIRS, Run, names_in, ranks_in_turn};
use serde_json::Value;

const EXACT: f64 = 1e-9;

fn close(found: f64, wanted: f64, size: f64, words: &str) {
    assert!((found - wanted).abs() <= EXACT * size, "{words}: {found} instead of {wanted}");
}

/// A number of a step by its path.
fn number(step: &Value, path: &str) -> f64 {
    step.pointer(path).and_then(Value::as_f64).unwrap_or_else(|| panic!("no number {path}: {step:#}"))
}

fn steps(ended: &Ended) -> Vec<Value> {
    ended.value("/steps").as_array().expect("a list").clone()
}

/// The blocks of `cases/closing_gap` under the pressure of a step, as its README derives them: nothing presses up to p = 1.
fn check_closing_gap(step: &Value, words: &str) {
    let p = 4.0 * number(step, "/factors/press");
    let pressure = ((p - 1.0) / 1.455).max(0.0);
    let way = if p < 1.0 { p / 50.0 } else { 0.02 + 2.0 * 0.00455 * pressure };
    let words = format!("{words}, p = {p}");
    assert_eq!(step["status"], "converged", "{words}");
    close(number(step, "/contact/seam/force"), 2.0 * pressure, 2.0, &words);
    close(number(step, "/contact/seam/pressure_max"), pressure, 1.0, &words);
    close(number(step, "/contact/seam/width"), if p < 1.0 { 0.0 } else { 2.0 }, 2.0, &words);
    close(number(step, "/contact/seam/resultant/1"), 2.0 * pressure, 2.0, &words);
    close(number(step, "/probe/top/u/1"), -way, 0.02, &words);
    close(number(step, "/support/bed/reaction/1"), 2.0 * 50.0 * way, 2.0, &words);
    close(number(step, "/support/bottom/reaction/1"), 2.0 * pressure, 2.0, &words);
    close(number(step, "/energy"), 0.0091 * pressure * pressure, 0.01, &words);
    close(number(step, "/external_work"), 2.0 * p * way, 0.01, &words);
    for balance in ["force", "moment", "energy", "bodies"] {
        let told = step["balance"][balance].as_f64();
        assert!(told.is_none_or(|told| told < EXACT), "{words}: {balance} {told:?}");
    }
    let most = step["iterations"].as_array().expect("a list").iter().filter_map(Value::as_u64).max();
    assert!(most.is_some_and(|most| most <= 20), "{words}: {most:?}");
}

#[test]
fn a_gap_closes_at_its_load_and_the_line_goes_on_stiffer() {
    for ranks in ranks_in_turn(0) {
        let ended = Run::case("closing_gap").ranks(ranks).converged();
        let all = steps(&ended);
        assert_eq!(all.len(), 6);
        all.iter().for_each(|step| check_closing_gap(step, &format!("{ranks} ranks")));
        check_files(&ended, ranks);
        assert!(ended.output.contains("mezha: converged: all 6 steps have converged"), "{}", ended.output);
    }
}

/// What a result of steps consists of, and that its series name files that are there.
fn check_files(ended: &Ended, ranks: usize) {
    let own = ["case.toml", "contact_seam.csv", "contacts.csv", "contact_seam.vtu"];
    for number in 1..=6 {
        let found = names_in(&ended.out.join(format!("steps/{number:04}")));
        let fields = found.iter().filter(|name| name.starts_with("fields")).count();
        let expected = match (number, ranks) {
            (6, _) => (&own[..3], 0),
            (_, 1) => (&own[..], 1),
            (_, ranks) => (&own[..], ranks + 1),
        };
        assert!(expected.0.iter().all(|name| found.iter().any(|other| other == name)), "{found:?}");
        assert_eq!((found.len(), fields), (expected.0.len() + expected.1, expected.1), "{found:?}");
    }
    for series in ["fields.pvd", "contact_seam.pvd"] {
        let text = std::fs::read_to_string(ended.out.join(series)).expect("a series");
        let files: Vec<&str> = text.split("file=\"").skip(1).filter_map(|rest| rest.split('"').next()).collect();
        assert_eq!(files.len(), 6, "{text}");
        assert!(files.iter().all(|file| ended.out.join(file).is_file()), "{files:?}");
        assert!((1..=6).all(|number| text.contains(&format!("timestep=\"{number}\""))), "{text}");
    }
    let table = std::fs::read_to_string(ended.out.join("steps.csv")).expect("a table");
    assert_eq!(table.lines().count(), 7);
    assert!(table.starts_with("step,status,iterations,factors.press,contact.seam.force,"), "{table}");
    let figure = std::fs::read_to_string(ended.out.join("steps.svg")).expect("a figure");
    assert!(figure.contains("displacement of probe top") && figure.contains("Force against displacement"));
    let both =
        ["contact_seam.csv", "steps/0006/contact_seam.csv"].map(|file| std::fs::read(ended.out.join(file)).expect("a file"));
    assert!(both[0] == both[1]);
}

#[test]
fn the_closing_gap_is_a_patch_test_of_all_spaces() {
    for (at, (order, space)) in PAIRS.into_iter().enumerate() {
        let run = Run::case("closing_gap").set("mesh.order", order).set("contact.seam.multiplier", space).ranks(1 + at % 3);
        let ended = run.set("mesh.refine", 0).set("output.fields", false).converged();
        steps(&ended).iter().for_each(|step| check_closing_gap(step, &format!("P{order} and {space}")));
        let mut names = names_in(&ended.out);
        names.retain(|name| name != "steps");
        assert_eq!(names, ["case.msh", "case.toml", "contact_seam.csv", "contacts.csv", "steps.csv", "summary.json"]);
    }
}

/// Hertz in each step: half width and largest pressure go with the root of the force. The width is found to an edge, or better.
#[test]
fn a_cylinder_presses_as_hertz_says_in_each_step() {
    let ended = Run::case("rigid_tools/steps.toml").ranks(2).converged();
    for step in steps(&ended) {
        let a = number(&step, "/factors/press").sqrt();
        let words = format!("a = {a}");
        close(number(&step, "/contact/seam/force"), 0.8630749048323608 * a * a, 1.0, &words);
        close(number(&step, "/rigid/cylinder/force/1"), -0.8630749048323608 * a * a, 1.0, &words);
        let (width, peak) = (number(&step, "/contact/seam/width"), number(&step, "/contact/seam/pressure_max"));
        assert!((width - a).abs() < 0.02, "{words}: {width}");
        assert!((peak / (1.0989010989010988 * a) - 1.0).abs() < 0.02, "{words}: {peak}");
        assert_eq!(step["contact"]["seam"]["trust"], true, "{words}");
    }
}

/// Everything that a step tells, against the run of its own case.
fn check_alone(ended: &Ended, change: impl Fn(Run) -> Run, tolerance: f64) {
    for step in steps(ended) {
        let file = ended.out.join(format!("steps/{:04}/case.toml", step["step"].as_u64().expect("a number")));
        let alone = change(Run::file(&file).ranks(2).set("output.fields", false)).converged();
        let near = |found: f64, path: &str| {
            let wanted = alone.number(path);
            assert!((found - wanted).abs() <= tolerance * wanted.abs().max(1e-12), "{path}: {found} and {wanted}, {step:#}");
        };
        for name in step["contact"].as_object().expect("contacts").keys() {
            near(number(&step, &format!("/contact/{name}/force")), &format!("/contact/{name}/force"));
            near(number(&step, &format!("/contact/{name}/pressure_max")), &format!("/contact/{name}/pressure_max"));
        }
        near(number(&step, "/energy"), "/energy/total");
        near(number(&step, "/displacement_max"), "/displacement_max");
        assert_eq!(step["status"], alone.value("/status"));
    }
}

/// Up, down, and with another gap: the path does not matter. A declared curve, a fitted one, and deformed bodies.
#[test]
fn each_step_is_the_same_scene_by_itself() {
    let same = |case: &str, steps: &str, refine: usize, tolerance: f64| {
        let change = |run: Run| run.set("exact", "{}").set("mesh.refine", refine).set("solver.tolerance", 1e-12);
        check_alone(&change(Run::case(case)).set("steps", steps).ranks(2).converged(), change, tolerance);
    };
    let down = "{ p = { factors = [1.0, 0.1, 0.6], scales = [\"load.press\"] } }";
    same("wedge", down, 1, 1e-8);
    same("rings", "{ p = { factors = [1.0, -0.5, 0.5], scales = [\"contact.seam.gap\"] } }", 1, 1e-8);
    let both = "{ p = { factors = [0.3, 1], scales = [\"load.top\"] }, q = { factors = [1, 0.5], scales = [\"contact.seam\"] } }";
    same("westergaard", both, 1, 1e-8);
    let press = "{ p = { factors = [0.5, 1.0], scales = [\"support.press.uy\"] } }";
    same("hertz", press, 1, 1e-8);
    same("hertz/deformed.toml", press, 1, 1e-8);
}

/// The lists of the gap are those of a block that is let down onto another by its weight, and lifted again.
#[test]
fn weights_and_gaps_are_scaled() {
    let lower = grid(3, 2, 1, |u, v| [2.0 * u, v]);
    let upper = grid(4, 2, 2, |u, v| [2.0 * u, 1.0 + v]);
    let mesh = Mesh {
        bodies: vec![
            ("lower", lower, ["bottom", "right", "lower.seam", "left"]),
            ("upper", upper, ["upper.seam", "right", "top", "left"]),
        ],
    };
    // Springs k = 10 hold the upper block; its weight is 2 per length of the seam at g = 2, its own strain of the order 1e-4.
    let case = format!(
        "{}gravity.g = [0.0, -2.0]\nsupport.bed = {{ on = \"top\", stiffness = {{ normal = 10.0 }} }}\nsolver.tolerance = 1e-12\n{}",
        GOOD.replace("poisson = 0.3 }", "poisson = 0.3, density = 1.0 }").replace("gap = \"closed\"", "gap = 0.1"),
        "[steps]\nweight = { factors = [0.0, 0.25, 1.0, 1.0], scales = [\"gravity\", \"load.top\"] }\ngap = { factors = [1, 1, 1, 10], scales = [\"contact.seam.gap\"] }\n"
    );
    let folder = tempfile::tempdir().expect("a temporary folder");
    let run = Run::file(&write_scene(folder.path(), &mesh.text(), &case)).set("load.top.pressure", 1.0);
    let ended = run.ranks(3).converged();
    let all = steps(&ended);
    let weight = |at: usize| 2.0 * 3.0 * number(&all[at], "/factors/weight");
    for (at, step) in all.iter().enumerate() {
        let (force, bed) = (number(step, "/contact/seam/force"), number(step, "/support/bed/reaction/1"));
        close(force + bed, weight(at), 6.0, "springs and contact carry the weight");
        assert_eq!(force > 0.0, at == 2, "the gap is closed at the whole weight alone");
    }
    assert!((number(&all[2], "/support/bed/reaction/1") - 2.0).abs() < 0.1, "springs are pressed by the gap");
    assert!((number(&all[3], "/displacement_max") - 0.3).abs() < 0.01, "the wide gap stays open");
}

/// A formula that a step multiplies by zero is a load of zero: nothing acts, and the block that contact alone holds stays as it is drawn.
#[test]
fn a_step_without_a_load_is_one_where_nothing_acts() {
    let block = |seed, y: f64| grid(3, 2, seed, move |u, v| [2.0 * u, y + v]);
    let mesh = Mesh {
        bodies: vec![
            ("lower", block(1, 0.0), ["bottom", "right", "lower.seam", "left"]),
            ("upper", block(2, 1.0), ["upper.seam", "right", "top", "left"]),
        ],
    };
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = write_scene(folder.path(), &mesh.text(), GOOD);
    let steps_of = "{ factors = [0.0, 1.0, 0.0], scales = [\"load.top\"] }";
    for (load, ranks) in [("\"1.0 + 0.1*x\"", 1), ("\"1.0 + 0.1*x\"", 2), ("1.0", 2)] {
        let ended = Run::file(&file).set("steps.p", steps_of).set("load.top.pressure", load).ranks(ranks).converged();
        let all = steps(&ended);
        for at in [0, 2] {
            let reason = all[at]["reason"].as_str().expect("words");
            assert!(reason.starts_with("nothing loads, moves or presses the bodies"), "{load}, {at}: {reason}");
        }
        close(number(&all[1], "/contact/seam/force"), if load == "1.0" { 2.0 } else { 2.2 }, 2.0, load);
    }
}

/// A roller that touches a block, and carries a force in the second step alone: in the others both lie as they are drawn.
#[test]
fn a_tool_without_a_force_stays_where_it_is() {
    let block = grid(12, 4, 1, |u, v| [60.0 * u - 30.0, 20.0 * v]);
    let mesh = Mesh { bodies: vec![("block", block, ["bottom", "", "block.top", ""])] };
    let case = r#"
mesh = { file = "mesh.msh", refine = 4 }
body.block = { young = 2e5, poisson = 0.3 }
support.table = { on = "bottom", ux = 0.0, uy = 0.0 }
rigid.roller = { circle = { centre = [2, 70], radius = 50 }, force = [0, -300], ux = 0.0 }
contact.seam = { between = ["block.top", "rigid.roller"] }
steps.p = { factors = [0.0, 1.0, 0.0], scales = ["rigid.roller"] }
"#;
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = write_scene(folder.path(), &mesh.text(), case);
    for ranks in [1, 2] {
        let all = steps(&Run::file(&file).ranks(ranks).converged());
        for (at, force) in [0.0, 300.0, 0.0].into_iter().enumerate() {
            close(number(&all[at], "/contact/seam/resultant/1").abs(), force, 300.0, "the force");
            assert_eq!(number(&all[at], "/displacement_max") == 0.0, force == 0.0, "{at}");
            assert!(force > 0.0 || all[at]["contact"]["seam"]["trust"] != false, "{at}: {:#}", all[at]["contact"]);
        }
    }
}

/// A block that nothing but contact holds is lifted in the second step: that is told, and the others are solved.
#[test]
fn a_step_that_comes_to_nothing_is_told_and_the_others_are_solved() {
    let bodies = |seed| Mesh {
        bodies: vec![
            ("lower", grid(3, 2, seed, |u, v| [2.0 * u, v]), ["bottom", "right", "lower.seam", "left"]),
            ("upper", grid(4, 2, seed + 1, |u, v| [2.0 * u, 1.0 + v]), ["upper.seam", "right", "top", "left"]),
        ],
    };
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = write_scene(folder.path(), &bodies(1).text(), GOOD);
    let lifted = "{ factors = [0.5, -1.0, 1.0], scales = [\"load.top\"] }";
    for ranks in [1, 3] {
        let ended = Run::file(&file).set("steps.p", lifted).set("solver.tolerance", 1e-12).ranks(ranks).ended();
        assert_eq!(ended.code, Some(3), "{}", ended.said());
        let reason = ended.value("/reason").as_str().expect("words").to_string();
        assert!(reason.starts_with("step 2 of 3 (p = -1): body upper can move"), "{reason}");
        let all = steps(&ended);
        let verdicts: Vec<&Value> = all.iter().map(|step| &step["status"]).collect();
        assert_eq!(verdicts, ["converged", "not_converged", "converged"]);
        close(number(&all[0], "/contact/seam/force"), 1.0, 1.0, "the first");
        close(number(&all[2], "/contact/seam/force"), 2.0, 1.0, "the last");
        assert_eq!(ended.value("/status"), "not_converged");
    }
    let check = crate::support::mezha(None, &["check", &file.display().to_string(), "--set", &format!("steps.p={lifted}")]);
    assert!(check.0 == Some(3) && check.2.starts_with("mezha: step 2 of 3 (p = -1): body upper can move"), "{check:?}");
    assert!(check.1.contains("3 load steps; the last one is step 3 of 3 (p = 1)"), "{}", check.1);
}
