mod markdown;

use std::fs;
use std::path::Path;

use super::*;
use crate::case::Case;
use crate::case::keys::{ValueForm, tables};

/// Around the table of keys of a page of the documentation.
const MARKS: [&str; 2] = ["<!-- keys: made by src/case/schema/tests.rs -->\n\n", "\n\n<!-- end of keys -->\n"];

/// The pages have the tables of keys; they are written if `MEZHA_WRITE` asks for that.
#[test]
fn documentation_is_made_of_the_table_of_keys() {
    for (table, page) in [(&CASE, "docs/case.md"), (&STUDY, "docs/studies.md")] {
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join(page);
        let found = fs::read_to_string(&file).expect("a page");
        let (before, rest) = found.split_once(MARKS[0]).expect("a mark before the keys");
        let (_, after) = rest.split_once(MARKS[1]).expect("a mark after the keys");
        let text = format!("{before}{}{}{}{after}", MARKS[0], markdown::markdown(table), MARKS[1]);
        if std::env::var_os("MEZHA_WRITE").is_some() {
            fs::write(&file, &text).expect("a file can be written");
        }
        let is_new = std::env::var_os("MEZHA_WRITE").is_some() || found == text;
        assert!(is_new, "{page} is old; MEZHA_WRITE=1 cargo test --release --lib schema:: writes it anew");
    }
}

/// A case with what no case of the project has.
const REST: &str = r#"
mesh = { file = "a.msh", grade = { points = [[0, 0]], exponent = 0.5 } }
thickness = 2
units = { length = "mm", force = "N" }
gravity.g = [0, -9.81]
body.a = { young = 1, poisson = 0.3, density = 1, plane = "stress" }
body.b.part.c = { young = 1, poisson = 0.3 }
geometry.g = { curves = "p", x = "t", y = 0, t = [0, 1] }
geometry.h = { curves = "q", circle = { centre = [0, 0], radius = 1 } }
support.mean = { body = "a", mean = true, angle = 0 }
support.springs = { on = "left", stiffness = { normal = 1 } }
support.more = { on = "left", stiffness = { x = 1, y = 1 } }
support.point = { at = [0, 0], body = "a", ux = 0 }
load.plate = { on = "top", rigid = true, force = [0, 1], moment = 0, about = [0, 0] }
load.point = { at = [0, 0], force = [0, 1] }
load.top = { on = "top", pressure = 1 }
rigid.line = { line = [[0, 0], [1, 0]], force = [0, 1], ux = 0 }
rigid.curve = { x = "t", y = 0, t = [0, 1] }
rigid.round = { circle = { centre = [0, 0], radius = 1 } }
contact.l = { between = ["p", "rigid.line"], quadrature = "segment", points = 5 }
contact.c = { between = ["p", "rigid.curve"] }
contact.r = { between = ["p", "rigid.round"] }
probe.p = { point = [0, 0], body = "a" }
accuracy = { force = 1e-3, contact.l.force = 1e-4 }
[exact]
energy = { value = 1, tolerance = 1 }
contact.l = { force = { value = 1, tolerance = 1 }, lambda = { formula = "1", tolerance = 1 } }
contact.c.lambda = { at = [[0, 0]], value = [1], tolerance = 1 }
body.a = { u = ["x", "y"], stress = [1, 1, 1], displacement = { at = [[0, 0]], value = [[0, 0]], tolerance = 1 } }
"#;

/// The readers ask for every key of the table, and [`crate::case::keys::Section`] panics where they ask for another one.
#[test]
fn readers_ask_for_every_key_of_the_table() {
    let read = |text: &str| Case::parse(text, Path::new("case.toml"), &[]).map(drop);
    never_asked(&CASE);
    read(REST).expect("a good case");
    read(&REST.replace("accuracy = ", "steps.s = { factors = [1], scales = [\"load.top\"] }\n# ")).expect("a good case");
    let missed = never_asked(&CASE);
    assert!(missed.is_empty(), "no reader asks for {missed:?}");
}

/// Each word of an enumeration has a meaning for its reader, and each default has the form of its key.
#[test]
fn words_have_meanings_and_defaults_their_form() {
    let least = "mesh.file = 'a.msh'\nbody.a = { young = 1, poisson = 0.3 }\nmesh.grade = { points = [[0, 0]], exponent = 1 }
        geometry.g = { curves = ['p', 'q'], circle = { centre = [0, 0], radius = 1 } }
        contact.c = { between = ['p', 'q'] }";
    let place = |table: &str| match table {
        "case" => "",
        "body" => "body.a.",
        "grade" => "mesh.grade.",
        "contact" => "contact.c.",
        "solver" => "solver.",
        other => panic!("say where a {other} stands"),
    };
    for (table, key) in tables(&CASE).into_iter().flat_map(|table| table.all().map(move |key| (table, key))) {
        if let Some(default) = key.default() {
            assert_eq!(key.refusal(&default), None, "{} of {}", key.name, table.name);
        }
        let forms = match &key.value {
            ValueForm::Either(forms, _) => forms,
            form => std::slice::from_ref(form),
        };
        for word in forms.iter().flat_map(|form| if let ValueForm::Word(words) = form { words } else { &[][..] }) {
            let set = format!("{}{}={word}", place(table.name), key.name);
            let words =
                Case::parse(least, Path::new("case.toml"), std::slice::from_ref(&set)).err().map(|error| error.to_string());
            let meant = words.as_ref().is_none_or(|words| !words.contains("meaning") && !words.contains("must be \""));
            assert!(meant, "{set}: {words:?}");
        }
    }
}

/// What the tables of keys refuse, in words for those who ask them alone.
#[test]
fn faults_are_those_of_the_form() {
    let faults = |text: &str| {
        let file = toml::from_str(text).expect("TOML");
        CASE.faults(&file).into_iter().map(|(key, words)| format!("{key}: {words}")).collect::<Vec<_>>()
    };
    let good = "mesh.file = 'a'\nbody.a = { young = 1, poisson = 0.3 }\n";
    assert_eq!(faults(good), [""; 0]);
    for (text, expected) in [
        ("mesh.file = 'a'\nbody = {}", "body: is empty"),
        ("body.a = { young = 1, poisson = 0.3 }", "mesh: missing"),
        (&format!("{good}load.l = {{ on = 'p', pressure = 1, traction = [0, 1] }}"), "load.l: pressure stands beside traction"),
        (&format!("{good}load.l = {{ on = 'p', pressure = 1, about = [0, 1] }}"), "load.l: about stands beside rigid only"),
        (&format!("{good}load.l.on = 'p'"), "load.l: wants pressure, or traction"),
        (&format!("{good}contact.'a/b' = {{ between = ['p', 'q'] }}"), "contact.\"a/b\": its name is part of a file name"),
        (&format!("{good}contact.'.' = {{ between = ['p', 'q'] }}"), "contact.\".\": its name is part of a file name"),
        (&format!("{good}accuracy.max_seconds = -1\naccuracy.energy = 0.1"), "accuracy.max_seconds: must be > 0"),
        (&format!("{good}exact.energy = {{ value = 0, tolerance = 1 }}"), "exact.energy.value: must not be 0"),
    ] {
        let found = faults(text);
        assert!(found.len() == 1 && found[0].starts_with(expected), "{text}: {found:?}");
    }
}
