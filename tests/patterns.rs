//! Patterns of names: a case with them is the case that somebody would have written by hand, to the last digit.

use crate::support::mesh::{Block, Mesh, grid, write_scene};
use crate::support::{Run, mezha};
use serde_json::Value;
use std::f64::consts::TAU;
use std::path::{Path, PathBuf};

/// A disc, with its rim as first side.
fn disc(middle: [f64; 2], radius: f64, layers: usize) -> Block {
    let mut points = vec![middle];
    let first = |layer: usize| if layer == 0 { 0 } else { 1 + 3 * layer * (layer - 1) };
    for layer in 1..=layers {
        let (count, r) = (6 * layer, radius * layer as f64 / layers as f64);
        let angle = |k: usize| TAU * k as f64 / count as f64 + 0.1;
        points.extend((0..count).map(|k| [middle[0] + r * angle(k).cos(), middle[1] + r * angle(k).sin()]));
    }
    let at = |layer: usize, k: usize| first(layer) + if layer == 0 { 0 } else { k % (6 * layer) };
    let mut triangles = Vec::new();
    for (layer, sector) in (1..=layers).flat_map(|layer| (0..6).map(move |sector| (layer, sector))) {
        for k in 0..layer {
            let (outer, inner) = (sector * layer + k, sector * (layer - 1) + k);
            triangles.push([at(layer, outer), at(layer, outer + 1), at(layer - 1, inner)]);
            if k + 1 < layer {
                triangles.push([at(layer, outer + 1), at(layer - 1, inner + 1), at(layer - 1, inner)]);
            }
        }
    }
    let rim = (0..6 * layers).map(|k| [at(layers, k), at(layers, k + 1)]).collect();
    Block { points, triangles, sides: [rim, Vec::new(), Vec::new(), Vec::new()] }
}

/// Four blocks between two rails.
fn bearing() -> Mesh {
    let roller = |k: usize| grid(3, 2, 7 + k as u64, move |u, v| [2.0 * k as f64 + 0.25 + 1.5 * u, 1.0 + v]);
    Mesh {
        bodies: vec![
            ("inner", grid(11, 2, 1, |u, v| [8.0 * u, v]), ["bore", "", "inner.race", ""]),
            ("roller1", roller(0), ["roller1.foot", "", "roller1.head", ""]),
            ("roller2", roller(1), ["roller2.foot", "", "roller2.head", ""]),
            ("roller3", roller(2), ["roller3.foot", "", "roller3.head", ""]),
            ("roller4", roller(3), ["roller4.foot", "", "roller4.head", ""]),
            ("outer", grid(13, 2, 2, |u, v| [8.0 * u, 2.0 + v]), ["outer.race", "", "rim", ""]),
        ],
    }
}

const WITH_PATTERNS: &str = r#"
mesh = { file = "mesh.msh" }
gravity.g = [0.0, -10.0]
body."*er" = { young = 2000.0, poisson = 0.3 }
body."roller*" = { young = 1000.0, poisson = 0.3, density = 1e-4 }
body.roller3.young = 1200.0
support.rim = { on = "ri?", ux = 0.0, uy = 0.0 }
support.cage = { body = "roller*", mean = true, about = [4.0, -8.0], tangential = 0.0 }
support.inner = { body = "inner", mean = true, direction = [1.0, 0.1], along = 1e-3 }
load.bore = { on = "*bore", pressure = "0.2 + 0.01*x" }
contact.seat = { between = ["*race", "roller*"], law = "bilateral", segments = 3, curve = "line" }
probe.middle = { point = [1.0, 1.5], body = "roller*" }
exact.contact."seat.outer*".force = { value = 1.0, tolerance = 0.5 }
solver.tolerance = 1e-12
"#;

/// Rail, side of the block, number of the block.
fn contacts() -> impl Iterator<Item = (&'static str, &'static str, usize)> {
    [("inner", "foot"), ("outer", "head")].into_iter().flat_map(|(race, side)| (1..=4).map(move |k| (race, side, k)))
}

/// The same, written out.
fn written_out() -> String {
    let mut text = String::from(
        r#"
mesh = { file = "mesh.msh" }
gravity.g = [0.0, -10.0]
support.rim = { on = "rim", ux = 0.0, uy = 0.0 }
load.bore = { on = "bore", pressure = "0.2 + 0.01*x" }
probe.middle = { point = [1.0, 1.5], body = "roller1" }
solver.tolerance = 1e-12
body.inner = { young = 2000.0, poisson = 0.3 }
body.outer = { young = 2000.0, poisson = 0.3 }
"#,
    );
    for k in 1..=4 {
        let young = if k == 3 { 1200.0 } else { 1000.0 };
        text += &format!("body.roller{k} = {{ young = {young:?}, poisson = 0.3, density = 1e-4 }}\n");
        let held = "mean = true, about = [4.0, -8.0], tangential = 0.0";
        text += &format!("support.\"cage.roller{k}\" = {{ body = \"roller{k}\", {held} }}\n");
    }
    text += "support.inner = { body = \"inner\", mean = true, direction = [1.0, 0.1], along = 1e-3 }\n";
    for (race, side, k) in contacts() {
        let name = format!("seat.{race}.race.roller{k}.{side}");
        let sides = format!("between = [\"{race}.race\", \"roller{k}.{side}\"]");
        text += &format!("contact.\"{name}\" = {{ {sides}, law = \"bilateral\", segments = 3, curve = \"line\" }}\n");
        if race == "outer" {
            text += &format!("exact.contact.\"{name}\".force = {{ value = 1.0, tolerance = 0.5 }}\n");
        }
    }
    text
}

/// What a run comes to, without what differs from run to run.
fn result(file: &Path, ranks: usize) -> (Value, String) {
    let ended = Run::file(file).ranks(ranks).set("output.fields", false).converged();
    let mut summary = ended.value("").clone();
    let all = summary.as_object_mut().expect("a table");
    for key in ["provenance", "time_s", "memory_mib"] {
        all.remove(key);
    }
    let mut curves = String::new();
    for (race, side, k) in contacts() {
        let name = format!("contact_seat.{race}.race.roller{k}.{side}.csv");
        curves += &std::fs::read_to_string(ended.out.join(&name)).unwrap_or_else(|error| panic!("{name}: {error}"));
    }
    (summary, curves)
}

fn scene(folder: &Path, name: &str, case: &str) -> PathBuf {
    let folder = folder.join(name).join("bearing");
    std::fs::create_dir_all(&folder).expect("a folder");
    write_scene(&folder, &bearing().text(), case)
}

#[test]
fn a_ring_of_rollers_is_the_same_case_written_out() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let short = scene(folder.path(), "short", WITH_PATTERNS);
    let long = scene(folder.path(), "long", &written_out());
    for ranks in [1, 2] {
        let [with, without] = [&short, &long].map(|file| result(file, ranks));
        assert!(with.0 == without.0, "{ranks} ranks: {:#}\n{:#}", with.0, without.0);
        assert!(with.1 == without.1, "{ranks} ranks: {}\n{}", with.1, without.1);
    }
}

#[test]
fn the_resolved_case_reproduces_the_run() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = scene(folder.path(), "short", WITH_PATTERNS);
    let ended = Run::file(&file).set("output.fields", false).converged();
    let resolved = std::fs::read_to_string(ended.out.join("case.toml")).expect("the resolved case");
    assert!(!resolved.lines().any(|line| line.starts_with('[') && line.contains('*')), "{resolved}");
    let second = Run::file(&ended.out.join("case.toml")).converged();
    for key in ["/energy", "/contact", "/support", "/balance", "/probe", "/errors"] {
        assert_eq!(ended.value(key), second.value(key), "{key}");
    }
}

fn check(case: &str, words: &[&str]) -> (Option<i32>, String) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = write_scene(folder.path(), &bearing().text(), case).display().to_string();
    let all = [&["check", file.as_str()], words].concat();
    let (code, output, errors) = mezha(None, &all);
    (code, output + &errors)
}

#[test]
fn check_shows_what_patterns_stand_for() {
    let (code, said) = check(WITH_PATTERNS, &[]);
    for line in [
        "body.\"*er\": 2 bodies: inner, outer",
        "body.\"roller*\": 4 bodies: roller1, roller2, roller3, roller4",
        "support.rim.on = \"ri?\": 1 physical curve: rim",
        "support.cage.body = \"roller*\": 4 bodies: roller1, roller2, roller3, roller4",
        "contact.seat.between = [\"*race\", \"roller*\"]: 8 contacts: seat.inner.race.roller1.foot, ",
        "exact.contact.\"seat.outer*\": 4 contacts: seat.outer.race.roller1.head, ",
    ] {
        assert!(code == Some(0) && said.contains(line), "{line}: {said}");
    }
}

/// Discs that match both sides of a contact: each pair once, none with itself.
#[test]
fn one_pattern_on_both_sides_joins_each_pair_once() {
    let at = [[0.0, 0.0], [2.0, 0.0], [1.0, 3.0f64.sqrt()], [9.0, 0.0]];
    let bodies = ["disc1", "disc2", "disc3", "disc4"].into_iter().zip(at);
    let mesh = Mesh { bodies: bodies.map(|(name, at)| (name, disc(at, 1.0, 4), [name, "", "", ""])).collect() };
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = |sides: &str| {
        let case = format!(
            "mesh = {{ file = \"mesh.msh\", refine = 1 }}
             body.\"*\" = {{ young = 1.0, poisson = 0.3 }}
             support.still = {{ body = \"*\", mean = true, ux = 0.0, uy = 0.0, angle = 0.0 }}
             contact.all.between = {sides}\n"
        );
        write_scene(folder.path(), &mesh.text(), &case).display().to_string()
    };
    for (sides, wanted) in [
        ("[\"disc*\", \"disc*\"]", "3 contacts: all.disc1.disc2, all.disc1.disc3, all.disc2.disc3"),
        ("[\"disc1\", \"*\"]", "2 contacts: all.disc1.disc2, all.disc1.disc3"),
        ("[\"*\", \"disc1\"]", "2 contacts: all.disc2.disc1, all.disc3.disc1"),
    ] {
        let (_, output, errors) = mezha(None, &["check", &file(sides)]);
        assert!(output.contains(wanted), "{sides}: {output}{errors}");
    }
    let (code, _, errors) = mezha(None, &["check", &file("[\"disc4\", \"disc?\"]")]);
    assert!(code == Some(2) && errors.contains("no two of these lie close and face each other: \"disc4\", and"), "{errors}");
}

/// The command line speaks of what a pattern stands for, by its name, by the table that it stands in, and by patterns.
#[test]
fn what_is_set_of_one_of_many_holds_for_it() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = scene(folder.path(), "set", WITH_PATTERNS);
    let laws = |words: &[&str]| {
        let case = mezha::case::Case::read(&file, &words.iter().map(|word| (*word).to_owned()).collect::<Vec<_>>());
        let case = case.unwrap_or_else(|error| panic!("{error}"));
        case.contacts.iter().map(|pair| format!("{:?}", pair.law).starts_with('U')).collect::<Vec<bool>>()
    };
    let is_one = |k: usize| (0..8).map(|at| at == k).collect::<Vec<bool>>();
    assert_eq!(laws(&[]), [false; 8]);
    assert_eq!(laws(&["contact.seat.law=unilateral"]), [true; 8]);
    assert_eq!(laws(&["contact.\"seat.inner.race.roller3.foot\".law=unilateral"]), is_one(2));
    assert_eq!(laws(&["contact.\"*.outer.*4.*\".law=unilateral"]), is_one(7));
    let both = ["contact.\"*\".law=unilateral", "contact.\"seat.inner.race.roller1.foot\".law=bilateral"];
    assert_eq!(laws(&both), is_one(0).into_iter().map(|one| !one).collect::<Vec<bool>>());
    // A body of its own name, too.
    let young = |words: &[&str]| {
        let case = mezha::case::Case::read(&file, &words.iter().map(|word| (*word).to_owned()).collect::<Vec<_>>());
        let bodies = case.unwrap_or_else(|error| panic!("{error}")).bodies;
        bodies.iter().find(|body| body.name == "roller3").map(|body| body.parts[0].material.young)
    };
    assert_eq!((young(&[]), young(&["body.\"roller*\".young=7.0"])), (Some(1200.0), Some(7.0)));
    assert_eq!(young(&["body.roller*.young=7.0"]), Some(7.0), "a pattern needs no quotes");
}

#[test]
fn load_steps_scale_what_a_table_stands_for() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let case = format!("{WITH_PATTERNS}steps.turn = {{ factors = [0.0, 2.0], scales = [\"support.cage.tangential\"] }}\n");
    let file = scene(folder.path(), "steps", &case.replace("tangential = 0.0", "tangential = 1e-3"));
    let case = mezha::case::Case::read(&file, &[]).unwrap_or_else(|error| panic!("{error}"));
    let values = case.steps.iter().map(|step| step.case.means.iter().map(|mean| mean.held[0].2).collect::<Vec<f64>>());
    assert_eq!(values.collect::<Vec<_>>(), [vec![0.0, 0.0, 0.0, 0.0, 1e-3], vec![2e-3, 2e-3, 2e-3, 2e-3, 1e-3]]);
}

/// A name with a star or a question mark stands for itself wherever it is written, and for nothing else that it would match; where a
/// pattern matches it, its table has a name that is no pattern, and none of another body.
#[test]
fn names_with_stars_stand_for_themselves() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let block = |k: usize| grid(2, 2, 1 + k as u64, move |u, v| [2.0 * u, k as f64 + v]);
    let sides = [["aab.low", "", "aab.top", ""], ["a*b.low", "a*b.side", "a*b.top", ""], ["a-b.low", "", "a-b.top", ""]];
    let bodies = ["aab", "a*b", "a-b"].into_iter().zip(sides).enumerate();
    let mesh = Mesh { bodies: bodies.map(|(k, (name, sides))| (name, block(k), sides)).collect() };
    let case = r#"
mesh = { file = "mesh.msh" }
body."a*" = { young = 1.0, poisson = 0.3 }
body."a*b" = { poisson = 0.2, body_force = [0.0, -1e-3] }
support.own = { body = "a*b", mean = true, ux = 0.0 }
load.own = { on = "a*b.side", rigid = true, force = [0.0, 0.0] }
load.all = { on = ["a?b.side"], rigid = true, force = [0.0, 0.0] }
contact.own = { between = ["aab.top", "a*b.low"] }
probe.own = { point = [1.0, 1.5], body = "a*b" }
steps.own = { factors = [1.0, 2.0], scales = ["body.\"a*b\".body_force"] }
"#;
    let read = |text: &str| {
        let case = mezha::case::Case::read(&write_scene(folder.path(), &mesh.text(), text), &[]);
        case.unwrap_or_else(|error| panic!("{error}"))
    };
    let case = read(case);
    assert_eq!(case.contacts.iter().map(|pair| pair.name.as_str()).collect::<Vec<_>>(), ["own"]);
    assert_eq!(case.plates.iter().map(|plate| plate.name.as_str()).collect::<Vec<_>>(), ["own", "all.a-b"]);
    assert_eq!((case.means[0].name.as_str(), case.means[0].body.as_str()), ("own", "a*b"));
    assert!(!case.resolved().contains("body.aab.body_force"), "{}", case.resolved());
    let many = read(&case.resolved().replace("[support.own]\nbody = \"a*b\"", "[support.all]\nbody = \"a?b\""));
    for case in [&many, &read(&many.resolved())] {
        let names = case.means.iter().map(|mean| (mean.name.as_str(), mean.body.as_str()));
        assert_eq!(names.collect::<Vec<_>>(), [("all.aab", "aab"), ("all.a-b", "a*b"), ("all.a-b-", "a-b")]);
    }
}

#[test]
fn mistakes_are_told_where_they_are_written() {
    for (set, words) in [
        ("body.\"rolle?\".young=1.0", "body.\"rolle?\": no body has a name like \"rolle?\"; there are \"inner\", \"roller1\","),
        ("support.rim.on=\"rum*\"", "support.rim.on: no physical curve has a name like \"rum*\"; there are \"bore\","),
        ("contact.seat.between=[\"*race\", \"walls*\"]", "contact.seat.between: no physical curve has a name like \"walls*\""),
        ("contact.seat.between=[\"rice\", \"roller*\"]", "contact.seat.between: there is no physical curve \"rice\"; there are"),
        ("contact.seat.law=\"glue\"", "contact.seat.law = \"glue\" (--set): must be"),
        ("body.\"roller*\".poisson=0.9", "body.\"roller*\".poisson = 0.9"),
        ("support.cage.angle=5.0", "support.cage.angle = 5.0 (--set): must be a number from -0.1 to 0.1"),
        ("support.more={ body = \"*3\", mean = true, ux = 0.0 }", "support.cage.roller3 holds a mean motion of this body, too"),
        ("accuracy.contact.\"seet*\".force=0.1", "no contact has a name like \"seet*\""),
        ("probe.middle.point=[0.0, 9.0]", "none of these bodies has the point of the probe"),
        ("mesh.file=\"none.msh\"", "mesh.file: "),
    ] {
        let (code, said) = check(WITH_PATTERNS, &["--set", set]);
        let found = said.lines().filter(|line| line.contains(words)).count();
        assert!(code == Some(2) && found == 1, "{set}: {found} times {words}: {said}");
    }
}
