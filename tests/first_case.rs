//! `mezha new` and what `mezha check` draws and proposes, from meshes to results.

use crate::support::mesh::{GOOD, Mesh, grid, two_blocks, write_scene};
use crate::support::{Run, mezha, mezha_in};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

fn mesh(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/meshes").join(format!("{name}.msh"))
}

/// What `mezha new` says of a mesh, written to a file beside it as a shell would.
fn new_case(folder: &Path, mesh: &str) -> PathBuf {
    let case = folder.join("case.toml");
    let output = std::fs::File::create(&case).expect("a case can be written");
    let mut command = Command::new(env!("CARGO_BIN_EXE_mezha"));
    let ended = command.args(["new", mesh]).current_dir(folder).stdout(Stdio::from(output)).output().expect("mezha starts");
    assert!(ended.status.success(), "{}", String::from_utf8_lossy(&ended.stderr));
    case
}

/// A disc on a block: two commands lead to a result that is right.
#[test]
fn a_first_case_runs_as_it_comes() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    std::fs::create_dir(folder.path().join("meshes")).expect("a folder");
    std::fs::copy(mesh("disc_2.2_order2_binary"), folder.path().join("meshes/disc.msh")).expect("a mesh can be copied");
    let case = new_case(folder.path(), "meshes/disc.msh");
    let text = std::fs::read_to_string(&case).expect("a case");
    for words in [
        "file = \"meshes/disc.msh\"",
        "[body.block]",
        "[body.\"half disc\"]",
        "between = [\"block.top\", \"disc.rim\"]   # they are drawn touching",
        "[support.bottom]       # held: by its name",
        "[load.top]          # pressed: by its name",
        "#   \"disc.rim\": of \"half disc\"",
    ] {
        assert!(text.contains(words), "{words} in\n{text}");
    }
    let (code, output, errors) = mezha_in(folder.path(), None, &["check", "case.toml"]);
    assert_eq!(code, Some(0), "{output}{errors}");
    let ended = Run::file(&case).ranks(2).converged();
    assert!(!text.contains("axisymmetric"), "the mesh lies on both sides of x = 0\n{text}");
    // The force of the plate, and the pressure of Hertz's contact of these bodies to a few per cent: the block is no half-plane.
    let force = 20.0;
    assert!((ended.number("/contact/block-top-disc-rim/force") / force - 1.0).abs() < 1e-3, "{text}");
    let stiffness = 0.5 * 210e3 / (1.0 - 0.09);
    let hertz = (force * stiffness / std::f64::consts::PI).sqrt();
    let found = ended.number("/contact/block-top-disc-rim/pressure_max");
    assert!((found / hertz - 1.0).abs() < 0.06, "{found} instead of {hertz}");
    assert_eq!(ended.value("/contact/block-top-disc-rim/trust"), true);
}

/// A bearing whose rings both have names of what is held: the inner ring is loaded then, no weight drives its rollers, and these are held
/// around its centre, as no coordinate could. The adapted mesh goes on though rollers lie loose, until what carries is good.
#[test]
fn a_first_case_of_a_bearing_loads_a_ring_and_holds_rollers_around_its_centre() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let drawn = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/bearing/bearing.msh");
    std::fs::copy(drawn, folder.path().join("mesh.msh")).expect("a mesh");
    let case = new_case(folder.path(), "mesh.msh");
    let text = std::fs::read_to_string(&case).expect("a case");
    assert!(text.contains("on = \"bore\"\nrigid = true") && !text.contains("\nbody_force"), "{text}");
    assert_eq!(text.matches("about = [0, 0]\ntangential = 0.0\nangle = 0.0").count(), 10, "two lie beside the middle\n{text}");
    let ended = Run::file(&case).ranks(2).set("accuracy.pressure", 0.02).set("output.fields", false).converged();
    assert!(ended.value("/accuracy").as_array().is_some_and(|meshes| meshes.len() > 1), "{}", ended.said());
    // The case of the bearing has .340 of a load that is five times as large.
    let share = ended.number("/contact/outer-track-roller01-rim/force") / 200.0;
    assert!((share - 0.339).abs() < 0.003, "{share}");
    assert!(!ended.errors.contains("is driven by"), "{}", ended.errors);
}

/// A wheel is drawn on the shoulder of a rail, and a little above its crown, which a larger load presses, too: a contact of each. What
/// was found beyond one contact alone was 5144 for 1351 on a rail like this.
#[test]
fn what_goes_on_along_a_boundary_beside_a_contact_is_proposed() {
    let mut rail = grid(24, 6, 1, |u, v| {
        let x = 20.0 * u - 10.0;
        [x, (v - 1.0) * 10.0 - v * x * x / if x < 0.0 { 600.0 } else { 160.0 }]
    });
    let wheel = grid(22, 5, 2, |u, v| {
        let x = 19.8 * u - 9.9;
        [x, (1.0 - v) * (0.1 - 0.05 * x) + 8.0 * v]
    });
    let [bottom, right, top, left] = rail.sides;
    let is_crown = |edge: &[usize; 2]| rail.points[edge[0]][0] + rail.points[edge[1]][0] < 0.0;
    let (crown, shoulder) = top.into_iter().partition(is_crown);
    rail.sides = [[bottom, right, left].concat(), shoulder, crown, Vec::new()];
    let bodies = vec![("rail", rail, ["base", "shoulder", "crown", ""]), ("wheel", wheel, ["tread", "", "load", ""])];
    let folder = tempfile::tempdir().expect("a temporary folder");
    std::fs::write(folder.path().join("mesh.msh"), Mesh { bodies }.text()).expect("a mesh can be written");
    let text = std::fs::read_to_string(new_case(folder.path(), "mesh.msh")).expect("a case");
    for side in ["shoulder", "crown"] {
        assert!(text.contains(&format!("\nbetween = [\"{side}\", \"tread\"]")), "{side} in\n{text}");
    }
}

/// Two discs side by side, neither of which is held by name: the weight of the example presses the one against the other, not along it.
#[test]
fn an_example_of_a_weight_presses_bodies_against_each_other() {
    let disc = |x: f64| {
        grid(8, 8, 3, move |u, v| {
            let [a, b] = [2.0 * u - 1.0, 2.0 * v - 1.0];
            [x + a * (1.0 - 0.5 * b * b).sqrt(), b * (1.0 - 0.5 * a * a).sqrt()]
        })
    };
    let bodies = vec![("a", disc(0.0), ["a.s"; 4]), ("b", disc(2.0), ["b.s"; 4])];
    let folder = tempfile::tempdir().expect("a temporary folder");
    std::fs::write(folder.path().join("mesh.msh"), Mesh { bodies }.text()).expect("a mesh can be written");
    let case = new_case(folder.path(), "mesh.msh");
    let text = std::fs::read_to_string(&case).expect("a case");
    let line = text.lines().find(|line| line.starts_with("body_force")).unwrap_or_else(|| panic!("no load in\n{text}"));
    assert!(line.starts_with("body_force = [-") && line.contains(", 0.0]") && line.contains("to the left"), "{line}");
    let ended = Run::file(&case).ranks(2).set("output.fields", false).converged();
    assert!(ended.value("/contact/s/trust") == true && !ended.errors.contains("support b-still"), "{}", ended.said());
}

/// A block under another one, whose sides on x = 0 are called axis, the held one on top: the example presses the lower one up, along that
/// line, in the plane and around it.
#[test]
fn an_example_of_a_weight_is_not_carried_by_a_line_of_symmetry() {
    let block = |cells: usize, from: f64| grid(cells, 3, 5, move |u, v| [2.0 * u, from + v]);
    let bodies = vec![
        ("lower", block(6, -1.0), ["", "", "lower.seam", "lower.axis"]),
        ("upper", block(5, 0.0), ["upper.seam", "", "base", "upper.axis"]),
    ];
    let folder = tempfile::tempdir().expect("a temporary folder");
    std::fs::write(folder.path().join("mesh.msh"), Mesh { bodies }.text()).expect("a mesh can be written");
    let case = new_case(folder.path(), "mesh.msh");
    let text = std::fs::read_to_string(&case).expect("a case");
    let line = text.lines().find(|line| line.starts_with("body_force")).unwrap_or_else(|| panic!("no load in\n{text}"));
    assert!(line.starts_with("body_force = [0.0, ") && line.contains("presses the body up"), "{line}");
    for plane in ["strain", "axisymmetric"] {
        let run = Run::file(&case).ranks(2).set("plane", format!("\"{plane}\"")).set("output.fields", false);
        assert!(run.converged().number("/contact/seam/force") > 0.0, "{plane}");
    }
}

/// A plate on a plate with a coarse disc on top, none of which is held by name: a case all the same, and one that is solved.
#[test]
fn three_free_bodies_make_a_case_that_runs() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    std::fs::copy(mesh("stack_of_three"), folder.path().join("stack.msh")).expect("a mesh can be copied");
    let case = new_case(folder.path(), "stack.msh");
    let text = std::fs::read_to_string(&case).expect("a case");
    for words in [
        "#:schema case.schema.json\n\n#",
        "[geometry.disc-rim]",
        "circle = { centre = [5.0, 5.0], radius = 1.5 }",
        "body_force = [0.0, -",
        "[support.lower-still]\nbody = \"lower\"\nmean = true\nux = 0.0\nuy = 0.0\nangle = 0.0\n",
        "[support.plate-still]",
        "[support.disc-still]",
    ] {
        assert!(text.contains(words), "{words} in\n{text}");
    }
    assert!(!text.contains("does not pass"), "{text}");
    // An accuracy that one mesh has: that the case can be solved is what is asked here.
    let ended = Run::file(&case).set("accuracy.pressure", 0.3).converged();
    let force = |name: &str| ended.number(&format!("/contact/{name}/force"));
    assert!((force("plate-top-disc-rim") / force("lower-top-plate-bottom") - 1.0).abs() < 0.01, "both carry the disc");
}

/// A disc over a block of which no curve has a name: the case is one, and says which names it wants.
#[test]
fn names_that_a_mesh_lacks_are_told_in_the_case_and_beside_it() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = folder.path().join("mesh.msh");
    let bare = two_blocks([(3, 2, 1), (2, 2, 2)]).text().lines().fold(String::new(), |text, line| {
        let is_named = line.starts_with("1 ") && line.ends_with('"');
        if is_named { text } else { text + line + "\n" }
    });
    // Names without curves, and groups without names, are known by their numbers.
    std::fs::write(&file, bare.replace("$PhysicalNames\n8", "$PhysicalNames\n2")).expect("a mesh can be written");
    let text = std::fs::read_to_string(new_case(folder.path(), "mesh.msh")).expect("a case");
    assert!(text.contains("on = \"") && !text.contains("Physical Curve("), "numbers are names\n{text}");
    std::fs::copy(mesh("no_curves"), &file).expect("a mesh can be copied");
    let (code, text, errors) = mezha_in(folder.path(), None, &["new", "mesh.msh"]);
    assert!(code == Some(0) && errors.contains("warning: no curve of the mesh bounds a body and has a name"), "{errors}");
    for words in [
        "#   Physical Curve(\"rail.wheel\") = {...};   // where \"rail\" may touch \"wheel\", which lies close",
        "#   Physical Curve(\"wheel.rail\") = {...};",
        "#   Physical Curve(\"bottom\") = {...};   // what is held",
    ] {
        assert!(text.contains(words), "{words} in\n{text}");
    }
}

/// Every case of the project has a mesh that a first case can be made of.
#[test]
fn first_cases_of_many_meshes_can_be_checked() {
    let cases = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases");
    let folder = tempfile::tempdir().expect("a temporary folder");
    for name in ["hertz", "rings", "stack", "coating", "wedge", "pin"] {
        std::fs::copy(cases.join(name).join(format!("{name}.msh")), folder.path().join("mesh.msh")).expect("a mesh");
        let case = new_case(folder.path(), "mesh.msh");
        let (code, _, errors) = mezha_in(folder.path(), None, &["check", &case.to_string_lossy()]);
        assert_eq!(code, Some(0), "{name}: {errors}\n{}", std::fs::read_to_string(&case).expect("a case"));
    }
}

/// A boundary that turns from a flat over into an arc: no contact can be made of it as it is drawn. The case says why, and has no contact.
#[test]
fn contacts_that_check_refuses_are_left_out_of_first_cases() {
    let cases = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases");
    let folder = tempfile::tempdir().expect("a temporary folder");
    std::fs::copy(cases.join("bars_parabola/bars.msh"), folder.path().join("mesh.msh")).expect("a mesh");
    let text = std::fs::read_to_string(new_case(folder.path(), "mesh.msh")).expect("a case");
    for words in [
        "\n# Left out, since `mezha check` refuses it:\n",
        "# [contact.seam]\n# between = [\"lower.seam\", \"upper.seam\"]",
        "like chords of an arc; tell its shape by a [geometry]",
        // No support is made up for a body that has neither contact nor support: what would hold it is told.
        "# This case does not pass `mezha check` yet:\n#   body \"upper\" has neither contact nor support; mend the contact",
        "# Body \"upper\" has neither contact nor support. This would hold it:\n# [support.upper-still]\n",
        // Nothing would carry a load of it.
        "Nothing presses yet: the contact that would carry a load of \"upper\" is left out.",
    ] {
        assert!(text.contains(words), "no `{words}` in:\n{text}");
    }
    for words in ["\n[contact.", "\n[support.upper", "\n[load.", "000000"] {
        assert!(!text.contains(words), "`{words}` in:\n{text}");
    }
    let (code, output, errors) = mezha_in(folder.path(), None, &["check", "case.toml"]);
    let told = format!("{output}{errors}");
    assert!(code == Some(3) && told.contains("no contact can be made of them: ") && !told.contains("paste this"), "{told}");
    let (_, _, errors) = mezha_in(folder.path(), None, &["new", "mesh.msh"]);
    let words = ["is left out: ", "like chords of an arc", "body \"upper\" has neither contact nor support"];
    assert!(words.iter().all(|words| errors.contains(words)), "{errors}");
}

/// Three sectors of a disc, which face each other along their cuts, and meet with other boundaries at the middle alone: no contact is made
/// of these.
#[test]
fn boundaries_that_meet_at_a_corner_alone_are_no_contacts_of_first_cases() {
    let mesh = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/three_bodies/sectors.msh");
    let folder = tempfile::tempdir().expect("a temporary folder");
    std::fs::copy(mesh, folder.path().join("mesh.msh")).expect("a mesh");
    let text = std::fs::read_to_string(new_case(folder.path(), "mesh.msh")).expect("a case");
    assert_eq!(text.matches("\n[contact.").count(), 3, "{text}");
    assert!(!text.contains("Left out") && !text.contains("000000"), "{text}");
    let (code, output, errors) = mezha_in(folder.path(), None, &["check", "case.toml"]);
    assert!(code == Some(0) && !format!("{output}{errors}").contains("paste this"), "{output}{errors}");
}

/// A shaft with a bore is drawn into a hub all round: a bore that is held would carry what its interference presses by.
#[test]
fn the_bore_of_a_shaft_that_is_pressed_in_is_free() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let text = |overlap: f64| {
        let ring = |chords: usize, radii: [f64; 2]| {
            grid(chords, 2, 0, move |u, v| {
                let (angle, radius) = (2.0 * std::f64::consts::PI * (1.0 - u), radii[0] + (radii[1] - radii[0]) * v);
                [radius * angle.cos(), radius * angle.sin()]
            })
        };
        let shaft = ("shaft", ring(32, [4.0, 10.0 + overlap]), ["shaft.bore", "", "shaft.out", ""]);
        let hub = ("hub", ring(32, [10.0, 20.0]), ["hub.in", "", "hub.rim", ""]);
        std::fs::write(folder.path().join("mesh.msh"), Mesh { bodies: vec![shaft, hub] }.text()).expect("a mesh can be written");
        std::fs::read_to_string(new_case(folder.path(), "mesh.msh")).expect("a case")
    };
    assert!(text(-0.02).contains("[support.shaft-bore]       # held: by its name"));
    let pressed = text(0.05);
    assert!(pressed.contains("into each other") && !pressed.contains("[support.shaft-bore]"), "{pressed}");
}

/// Roots of which a body has several are no supports, nor are slopes of a foot, and a load is along what contact resists: along the normal of
/// an oblique face, across a shaft beside a hub.
#[test]
fn holds_and_loads_are_those_that_an_engineer_would_mean() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let new = |turn: f64, lower: [&'static str; 3], upper: [&'static str; 3]| {
        let mut mesh = two_blocks([(3, 2, 1), (4, 2, 2)]);
        let [bottom, right, left] = lower;
        mesh.bodies[0].2 = [bottom, right, "lower.seam", left];
        let [right, top, left] = upper;
        mesh.bodies[1].2 = ["upper.seam", right, top, left];
        let (sin, cos) = turn.sin_cos();
        let mesh = mesh.map(|[x, y]| [5.0 + cos * x - sin * y, sin * x + cos * y]);
        std::fs::write(folder.path().join("mesh.msh"), mesh.text()).expect("a mesh can be written");
        let text = std::fs::read_to_string(new_case(folder.path(), "mesh.msh")).expect("a case");
        assert_eq!(mezha_in(folder.path(), None, &["check", "case.toml"]).0, Some(0), "{text}");
        text
    };
    let text = new(0.0, ["base", "", ""], ["t1.root", "t2.root", "t3.root"]);
    assert_eq!(text.matches("# held: by its name").count(), 1, "{text}");
    assert!(!text.contains("\n[support.t"), "{text}");
    let text = new(0.0, ["base", "", ""], ["foot.side", "top", ""]);
    assert!(text.contains("\n[load.top]") && !text.contains("\n[support.foot"), "{text}");
    let text = new(0.5 * std::f64::consts::PI, ["", "", "hub.end"], ["shaft.end", "", ""]);
    assert!(text.contains("[load.shaft-end]") && text.contains("force = [20.0, 0.0]") && !text.contains("-still"), "{text}");
    let text = new(0.5, ["base", "", ""], ["", "pushed.press", ""]);
    assert!(text.contains("[load.pushed-press]") && text.contains("\npressure = "), "{text}");
}

/// What a mesh says by its names and by how it is drawn: a case without a load for bodies that reach into each other, one that pulls
/// where a name says so and contact holds the body, or where a push would open every contact, and one that holds a grip, whatever its side.
#[test]
fn loads_are_those_that_names_and_the_drawing_tell() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let new = |seam: f64, names: [&'static str; 3]| {
        let mut mesh = two_blocks([(3, 2, 1), (4, 2, 2)]);
        mesh.bodies[1].1 = grid(4, 2, 2, |u, v| [2.0 * u, seam + v]);
        let [base, right, top] = names;
        (mesh.bodies[0].2[0], mesh.bodies[1].2[1], mesh.bodies[1].2[2]) = (base, right, top);
        std::fs::write(folder.path().join("mesh.msh"), mesh.text()).expect("a mesh can be written");
        std::fs::read_to_string(new_case(folder.path(), "mesh.msh")).expect("a case")
    };
    let text = new(0.95, ["bottom", "right", "gripTop"]);
    assert!(
        text.contains("# Bodies are drawn into each other: that interference is the load.") && text.contains("0.05 into each")
    );
    assert!(!text.lines().any(|line| line.starts_with("[load.") || line.starts_with("body_force")), "{text}");
    // However deep they do.
    assert!(new(0.6, ["bottom", "right", "gripTop"]).contains("0.4 into each"));
    // A body that its interference pushes off without a load is pressed as well, and `check` says so of a case that has none.
    let text = new(0.95, ["bottom", "right", "upper.end"]);
    assert!(text.contains("\n[load.upper-end]") && text.contains("0.05 into each"), "{text}");
    let (bare, _) = text.split_once("[load.").expect("a load");
    let slides = "[support.slide]\nbody = \"upper\"\nmean = true\nux = 0.0\n";
    std::fs::write(folder.path().join("bare.toml"), bare.to_owned() + slides).expect("a case can be written");
    for command in ["check", "run"] {
        let (code, output, errors) = mezha_in(folder.path(), None, &[command, "bare.toml"]);
        assert_eq!(code, Some(3), "{output}{errors}");
        let said = output + &errors;
        assert!(said.contains("body upper can move by (0, 1): interference drives it there"), "{command}: {said}");
    }
    let text = new(1.0, ["gripBelow", "bolt.pull", "upper.end"]);
    assert!(text.contains("# held: by its name") && text.contains("# pulled: by its name"), "{text}");
    assert!(text.lines().any(|line| line.starts_with("pressure = -")), "{text}");
    // A pull that lifts the body off its only contact is none that `check` passes.
    let text = new(1.0, ["gripBelow", "right", "bolt.pull"]);
    assert!(text.contains("`mezha check` refuses a load on \"bolt.pull\"") && !text.contains("\n[load."), "{text}");
    let text = new(1.0, ["bottom", "right", "top"]);
    // A strain of 1e-4 over the narrowest body, which is 1 wide; a mesh beside its axis may be a section.
    assert!(text.contains("# pressed: by its name") && text.contains("force = [0.0, -20.0]"), "{text}");
    assert!(text.contains("change no number\n# plane = \"axisymmetric\""), "{text}");
    // Beside an interference the load of a name is a comment, and each body is held that a name holds.
    let text = new(0.95, ["bottom", "load", "gripTop"]);
    assert!(!text.contains("\n[load.") && text.contains("\n# [load.NAME]\n# on = \"load\"\n"), "{text}");
    assert_eq!(text.matches("# held: by its name").count(), 2, "{text}");
    // If all are held nothing would act.
    let text = new(1.0, ["foot", "right", "axle"]);
    assert!(
        text.contains("[load.axle]          # pressed: its name says that it is held, but") && !text.contains("-still"),
        "{text}"
    );
}

/// Whoever takes the comment sign from the line of bodies of revolution has a case of them, whatever presses or is held in the plane.
#[test]
fn half_sections_become_bodies_of_revolution_by_one_line() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for (names, words) in [
        (["bottom", "right", "top"], "angle = 0.0               # and does not turn"),
        (["bottom", "load", "upper.end"], "[load.load]"),
        (["", "right", ""], "mean = true\nux = 0.0"),
    ] {
        let mut mesh = two_blocks([(3, 2, 1), (4, 2, 2)]);
        (mesh.bodies[0].2[0], mesh.bodies[1].2[1], mesh.bodies[1].2[2]) = (names[0], names[1], names[2]);
        std::fs::write(folder.path().join("mesh.msh"), mesh.text()).expect("a mesh can be written");
        let file = new_case(folder.path(), "mesh.msh");
        let text = std::fs::read_to_string(&file).expect("a case");
        assert!(text.contains(words), "{words} in\n{text}");
        let round = text.replace("\n# plane = \"axisymmetric\"", "\nplane = \"axisymmetric\"");
        assert_ne!(text, round);
        for text in [text, round] {
            std::fs::write(&file, &text).expect("a case can be written");
            let (code, output, errors) = mezha_in(folder.path(), None, &["check", "case.toml"]);
            assert_eq!(code, Some(0), "{output}{errors}\n{text}");
        }
    }
}

/// A polygon for an arc that touches a line between two of its nodes is drawn touching, and two pieces of a body that meet at a point are
/// not held there.
#[test]
fn curves_are_taken_as_they_are_meant_and_points_of_one_piece() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let new = |mesh: &Mesh| {
        std::fs::write(folder.path().join("mesh.msh"), mesh.text()).expect("a mesh can be written");
        std::fs::read_to_string(new_case(folder.path(), "mesh.msh")).expect("a case")
    };
    let mut mesh = two_blocks([(3, 2, 1), (4, 2, 2)]);
    mesh.bodies[1].1 = grid(7, 2, 2, |u, v| {
        let (angle, radius) = (2.0 * u - 1.0, 1.0 - 0.5 * v);
        [1.0 + radius * angle.sin(), 2.0 - radius * angle.cos()]
    });
    let text = new(&mesh);
    assert!(text.contains("# they are drawn touching") && text.contains("radius = 1.0"), "{text}");
    // Two squares that meet at (4, 2), the corner that moves most when either turns about its other end.
    let mut squares = grid(2, 2, 2, |u, v| [2.0 + 2.0 * u, 4.0 * v - 2.0]);
    let other = grid(2, 2, 3, |u, v| [4.0 + 2.0 * u, 2.0 + 4.0 * v]);
    let count = squares.points.len();
    squares.points.extend(other.points);
    squares.triangles.extend(other.triangles.into_iter().map(|triangle| triangle.map(|k| count + k)));
    mesh.bodies = vec![("squares", squares, ["under", "", "", ""])];
    let text = new(&mesh);
    assert!(text.contains("\nat = [") && !text.contains("at = [4.0, 2.0]"), "{text}");
    let (code, _, errors) = mezha_in(folder.path(), None, &["check", "case.toml"]);
    assert_eq!(code, Some(0), "{errors}\n{text}");
}

/// `check` lists what loads and holds the bodies, with resultants, and how the sides of contacts are drawn.
#[test]
fn check_lists_what_acts() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let case = GOOD.replace(", gap = \"closed\"", "");
    let file = write_scene(folder.path(), &two_blocks([(3, 2, 1), (4, 2, 2)]).text(), &case).display().to_string();
    let told = |sets: &[&str]| {
        let words: Vec<&str> = ["check", &file].into_iter().chain(sets.iter().flat_map(|set| ["--set", set])).collect();
        let (code, output, errors) = mezha_in(folder.path(), None, &words);
        assert_eq!(code, Some(0), "{output}{errors}");
        output + &errors
    };
    let said = told(&["load.side={ on = \"right\", traction = [\"0.5*y\", 0] }"]);
    for words in [
        "load top: pressure = 1, resultant (0, -2)",
        "load side: tx = …, ty = 0, resultant (1, 0)",
        "support table: uy = 0",
        "contact seam: its sides are drawn touching",
    ] {
        assert!(said.lines().any(|line| line.starts_with(words)), "{words} in\n{said}");
    }
    assert!(!said.contains("nothing loads"), "{said}");
    let plate = told(&["load.top={ on = \"top\", rigid = true, force = [0, -3], ux = 0, angle = 0 }", "contact.seam.gap=-0.001"]);
    assert!(plate.contains("load top: stiff plate, force (0, -3)") && plate.contains("a gap of -0.001 is given"), "{plate}");
    assert!(plate.contains("ux = 0, angle = 0"), "how a plate may move is told: {plate}");
    // Forces of a case with a thickness are whole ones.
    let plate = "load.top={ on = \"top\", rigid = true, force = [0, -3], moment = 2, ux = 0 }";
    let thick = told(&["thickness=5", plate, "body.lower.body_force=[0, \"-3*x\"]", "units={ length = \"mm\", force = \"N\" }"]);
    for words in [
        "load top: stiff plate, force (0, -3) N, moment 2 about (1, 2), ux = 0",
        "load force in lower: (0, …) for each volume, resultant (0, -30) N",
        "body lower: E = 7000 MPa",
    ] {
        assert!(thick.contains(words), "{words} in\n{thick}");
    }
    let round = told(&["plane=\"axisymmetric\""]);
    assert!(round.contains("resultant (0, -12.57)"), "the whole disc: {round}");
}

/// Rigid tools and plates are listed as such, and as what stays where it is drawn.
#[test]
fn check_tells_what_stays() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = write_scene(folder.path(), &two_blocks([(3, 2, 1), (4, 2, 2)]).text(), GOOD).display().to_string();
    for (motion, words) in [("uy = 0", "body rigid.die: rigid, stays"), ("uy = -0.1", "body rigid.die: rigid")] {
        let die = format!("rigid.die={{ line = [[0, 2], [1, 2]], ux = 0, {motion}, angle = 0 }}");
        let sets = [die.as_str(), "load={}", "contact.die.between=[\"top\", \"rigid.die\"]"];
        let told: Vec<&str> = ["check", &file].into_iter().chain(sets.iter().flat_map(|set| ["--set", set])).collect();
        let (code, output, errors) = mezha_in(folder.path(), None, &told);
        assert!(code == Some(0) && output.lines().any(|line| line == words), "{output}{errors}");
        assert!(!output.contains("rigid.die: E"), "{output}");
    }
}

/// Without contacts a goal of contacts is refused, and the contacts that would be are proposed all the same.
#[test]
fn contacts_are_proposed_beside_a_goal_that_lacks_them() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let case = format!("accuracy.pressure = 0.1\n{CASE}[support.high]\nbody = \"upper\"\nmean = true\nux = 0.0\nangle = 0.0\n");
    let file = write_scene(folder.path(), &two_blocks([(3, 2, 1), (2, 2, 2)]).text(), &case);
    let check = || mezha_in(folder.path(), None, &["check", &file.to_string_lossy()]);
    let (code, _, errors) = check();
    assert!(code == Some(2) && errors.contains("there is no contact in this case; leave it out"), "{errors}");
    assert!(errors.contains(CONTACT.trim_end()), "{errors}");
    std::fs::write(&file, case + CONTACT).expect("a case can be written");
    let (code, output, errors) = check();
    assert_eq!((code, output.contains("paste")), (Some(0), false), "{output}{errors}");
}

/// A mesh of a block, with curves above it that bound nothing: 4 × 1, and the curves through these points.
fn with_curves(curves: &[(&str, &[[f64; 2]])]) -> String {
    let mut text = String::from("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n");
    text += &format!("{}\n1 1 \"bottom\"\n1 2 \"face\"\n2 3 \"low\"\n", curves.len() + 3);
    curves.iter().enumerate().for_each(|(k, (name, _))| text += &format!("1 {} \"{name}\"\n", k + 10));
    let block = (0..=8).flat_map(|k| [[0.5 * k as f64, 0.0], [0.5 * k as f64, 1.0]]);
    let points: Vec<[f64; 2]> = block.chain(curves.iter().flat_map(|(_, points)| points.iter().copied())).collect();
    text += &format!("$EndPhysicalNames\n$Nodes\n{}\n", points.len());
    points.iter().enumerate().for_each(|(k, [x, y])| text += &format!("{} {x:?} {y:?} 0\n", k + 1));
    let mut elements: Vec<String> = Vec::new();
    for a in (1..=15).step_by(2) {
        let [b, c, d] = [a + 1, a + 2, a + 3];
        elements.extend([format!("2 2 3 1 {a} {c} {d}"), format!("2 2 3 1 {a} {d} {b}")]);
        elements.extend([format!("1 2 1 1 {a} {c}"), format!("1 2 2 1 {b} {d}")]);
    }
    let mut next = 19;
    for (k, (_, points)) in curves.iter().enumerate() {
        elements.extend((next..next + points.len() - 1).map(|at| format!("1 2 {} 1 {at} {}", k + 10, at + 1)));
        next += points.len();
    }
    text += &format!("$EndNodes\n$Elements\n{}\n", elements.len());
    elements.iter().enumerate().for_each(|(k, element)| text += &format!("{} {element}\n", k + 1));
    text + "$EndElements\n"
}

/// What is drawn without triangles is a rigid tool that a first case has, and that `check` proposes as it can be pasted.
#[test]
fn curves_without_triangles_are_proposed_as_rigid_tools() {
    let roller: Vec<[f64; 2]> =
        (0..=12).map(|k| (std::f64::consts::PI * f64::from(k) / 12.0).sin_cos()).map(|(y, x)| [2.0 + x, 2.0 - y]).collect();
    let curves: [(&str, &[[f64; 2]], &str); 2] = [
        ("die", &[[1.0, 1.02], [2.0, 1.02], [3.0, 1.02]], "line = [[1.0, 1.02], [3.0, 1.02]]"),
        ("roller", &roller, "circle = { centre = [2.0, 2.0], radius = 1.0 }"),
    ];
    for (name, points, shape) in curves {
        let folder = tempfile::tempdir().expect("a temporary folder");
        std::fs::write(folder.path().join("block.msh"), with_curves(&[(name, points)])).expect("a mesh can be written");
        let case = new_case(folder.path(), "block.msh");
        let text = std::fs::read_to_string(&case).expect("a case");
        let tables = format!("[contact.face-{name}]\nbetween = [\"face\", \"rigid.{name}\"]\n");
        assert!(text.contains(shape) && text.contains(&tables) && !text.contains("\n[load"), "{text}");
        let check = || mezha_in(folder.path(), None, &["check", &case.to_string_lossy()]);
        let (code, output, errors) = check();
        assert!(code == Some(0) && !output.contains("paste") && !errors.contains("nothing loads"), "{output}{errors}");
        // Without the tool it is proposed, and heals the case.
        let (head, rest) = text.split_once("# Curves of the mesh").expect("the tools");
        let bare =
            format!("{head}\n{}", &rest[rest.find("[support").expect("a support")..]).replace("pressure = 0.01", "energy = 0.01");
        std::fs::write(&case, &bare).expect("a case can be written");
        let (code, output, errors) = check();
        assert!(code == Some(0) && output.contains("these curves of the mesh bound no body"), "{output}{errors}");
        let pasted: Vec<&str> =
            output.lines().skip_while(|line| !line.starts_with('[')).filter(|line| !line.starts_with("figure")).collect();
        std::fs::write(&case, format!("{bare}\n{}\n", pasted.join("\n"))).expect("a case can be written");
        let (code, output, errors) = check();
        assert!(code == Some(0) && !output.contains("paste") && !errors.contains("nothing loads"), "{output}{errors}");
        let wrong = ["check", &case.to_string_lossy(), "--set", &format!("support.bottom.on=\"{name}\"")].map(String::from);
        let (code, _, errors) = mezha(None, &wrong);
        assert!(code == Some(2) && errors.contains(&format!("\"{name}\" bounds no body")), "{errors}");
    }
}

/// A curve that `check` refuses as a tool, or that is none, is told with the reason, and neither command proposes it.
#[test]
fn curves_that_can_be_no_tools_are_left_out_with_the_reason() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for (points, why) in [
        ([[1.0, 4.0], [2.0, 4.0], [3.0, 4.0]], "is wider than 6 % of their length"),
        ([[1.0, 0.5], [2.0, 0.5], [3.0, 0.5]], "it lies inside of body \"low\""),
        ([[1.0, 1.02], [3.0, 1.02], [3.0, 2.0]], "it is neither straight nor a circle"),
        ([[2.0, 1.1], [2.0, 1.5], [2.0, 2.0]], "it faces no boundary that has a name"),
    ] {
        std::fs::write(folder.path().join("block.msh"), with_curves(&[("die", &points)])).expect("a mesh can be written");
        let text = std::fs::read_to_string(new_case(folder.path(), "block.msh")).expect("a case");
        let told = "curve \"die\" bounds no body, and is not taken for a rigid tool: ";
        assert!(text.contains(&format!("\n# Left out: {told}")) && text.contains(why), "{text}");
        assert!(!text.contains("\n[rigid") && text.contains("\n[load.face]") && !text.contains("does not pass"), "{text}");
        let (code, output, errors) = mezha_in(folder.path(), None, &["check", "case.toml"]);
        assert!(code == Some(0) && !output.contains("paste"), "{output}{errors}");
        let (_, _, errors) = mezha_in(folder.path(), None, &["new", "block.msh"]);
        assert!(errors.contains(told) && errors.contains(why), "{errors}");
    }
}

/// A pin that shrinks in its hole: contact opens all around, which the run says on any mesh, with a hold that heals the case.
#[test]
fn a_cooled_pin_that_nothing_holds_is_told() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let case = r#"
mesh = { file = "mesh.msh", order = 2, refine = 1 }
body.plate = { young = 210e3, poisson = 0.3 }
body.pin = { young = 210e3, poisson = 0.3, expansion = 1e-5, temperature = -100.0 }
geometry.bore = { curves = ["plate.in", "pin.out"], circle = { centre = [0, 0], radius = 1.0 } }
contact.seam = { between = ["plate.in", "pin.out"] }
support.frame = { on = "plate.out", ux = 0.0, uy = 0.0 }
support.turn = { body = "pin", mean = true, angle = 0.0 }
"#;
    let file = write_scene(folder.path(), include_str!("meshes/pin_in_plate.msh"), case);
    let check = |sets: &[&str]| {
        let words: Vec<String> = ["check".to_owned(), file.display().to_string()]
            .into_iter()
            .chain(sets.iter().flat_map(|set| ["--set".to_owned(), (*set).to_owned()]))
            .collect();
        mezha_in(folder.path(), None, &words.iter().map(String::as_str).collect::<Vec<_>>())
    };
    for (refine, ranks) in [(1, 1), (2, 2), (3, 1)] {
        let run = Run::file(&file).set("mesh.refine", refine).ranks(ranks).ended();
        let reason = run.value("/reason").to_string();
        let is_told = reason.contains("what presses is rounding, so that where its bodies lie is not told: body pin can move by");
        assert!(
            run.code == Some(3) && is_told && reason.contains("hold it by ux = 0.0 and uy = 0.0 in support.turn, too"),
            "{reason}"
        );
    }
    Run::file(&file).set("support.turn.ux", 0.0).set("support.turn.uy", 0.0).converged();
    for set in [
        "body.pin.temperature=100.0",
        "body.plate={ young = 210e3, poisson = 0.3, expansion = 2e-5, temperature = -100.0 }",
        "contact.seam.gap=-0.01",
    ] {
        let (code, output, errors) = check(&[set]);
        assert!(code == Some(0), "{set}: {output}{errors}");
    }
}

/// Without a support the first thing to mend is the load: a hold would carry it unseen.
#[test]
fn a_load_that_opens_all_contacts_is_told_before_what_does_not_hold() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let free = GOOD.lines().filter(|line| !line.starts_with("support")).map(|line| format!("{line}\n")).collect::<String>();
    let file = write_scene(folder.path(), &two_blocks([(3, 2, 1), (4, 2, 2)]).text(), &free).display().to_string();
    for (pressure, is_pulled) in [("-1.0", true), ("1.0", false)] {
        let (code, _, errors) =
            mezha_in(folder.path(), None, &["check", &file, "--set", &format!("load.top.pressure={pressure}")]);
        let pulled = "load.top pulls body upper off all its contacts, which only push: turn the load round";
        assert_eq!((code, errors.contains(pulled)), (Some(3), is_pulled), "{errors}");
        assert!(errors.contains("supports and contact do not hold it"), "{errors}");
    }
    let held = ["check", &file, "--set", "support.high={ on = \"top\", uy = 0 }", "--set", "load.top.pressure=-1.0"];
    let (_, _, errors) = mezha_in(folder.path(), None, &held);
    assert!(!errors.contains("off all its contacts"), "a support may carry it: {errors}");
}

/// A scene without loads is told before and after it is run, and its mesh is not adapted.
#[test]
fn nothing_that_acts_is_told() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file =
        write_scene(folder.path(), &two_blocks([(3, 2, 1), (4, 2, 2)]).text(), &GOOD.replace("pressure = 1.0", "pressure = 0.0"));
    let (code, _, errors) = mezha(None, &["check", &file.display().to_string()]);
    assert!(code == Some(0) && errors.contains("nothing loads, moves or presses the bodies"), "{errors}");
    for (key, value) in [("mesh.refine", "1"), ("accuracy", "{ pressure = 1e-2 }")] {
        let ended = Run::file(&file).ranks(2).set(key, value).converged();
        assert!(ended.value("/reason").to_string().contains("nothing loads, moves or presses the bodies"), "{}", ended.said());
        assert_eq!(ended.number("/energy/total"), 0.0);
        let summary = ended.summary();
        let meshes = summary["accuracy"].as_array().map_or(1, Vec::len);
        assert_eq!(meshes, 1, "{}", ended.said());
    }
    for (key, value) in [("contact.seam.gap", "-1e-3"), ("support.table.uy", "1e-3"), ("load.top.pressure", "1.0")] {
        let mut words = vec!["check".into(), file.display().to_string(), "--set".into(), format!("{key}={value}")];
        if key == "contact.seam.gap" {
            // Else it pushes the upper body off.
            words.extend(["--set".into(), "support.roof={ on = \"top\", uy = 0.0 }".into()]);
        }
        let words: Vec<&str> = words.iter().map(String::as_str).collect();
        let (code, _, errors) = mezha(None, &words);
        assert!(code == Some(0) && !errors.contains("nothing loads"), "{key}: {errors}");
    }
}

#[test]
fn what_is_no_mesh_is_told() {
    let (code, output, errors) = mezha(None, &["new", "nowhere.msh"]);
    assert!(code == Some(2) && output.is_empty() && errors.contains("nowhere.msh: cannot be read"), "{errors}");
    let (code, _, errors) = mezha(None, &["new", &mesh("refused_order3").to_string_lossy()]);
    assert!(code == Some(2) && errors.contains("-order 2"), "{errors}");
}

const CASE: &str = r#"
[mesh]
file = "mesh.msh"
[body.lower]
young = 1000.0
poisson = 0.3
[body.upper]
young = 1000.0
poisson = 0.3
[support.table]
on = "bottom"
ux = 0.0
uy = 0.0
[load.top]
on = "top"
pressure = 1.0
"#;

const CONTACT: &str = "[contact.seam]\nbetween = [\"lower.seam\", \"upper.seam\"]\n";

#[test]
fn a_missing_contact_and_missing_supports_are_proposed_and_heal_the_case() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let mesh = two_blocks([(3, 2, 1), (2, 2, 2)]).text();
    let file = write_scene(folder.path(), &mesh, CASE);
    let check = || mezha_in(folder.path(), None, &["check", &file.to_string_lossy()]);
    let (code, output, errors) = check();
    assert_eq!(code, Some(3), "{output}{errors}");
    assert!(output.contains(CONTACT.trim_end()), "{output}");
    assert!(output.contains("[support.upper-still]") && output.contains("mean = true"), "{output}");
    // What is proposed is pasted.
    let pasted: String = output
        .lines()
        .skip_while(|line| !line.starts_with('['))
        .filter(|line| !line.ends_with(':') && !line.starts_with("figure"))
        .map(|line| format!("{line}\n"))
        .collect();
    std::fs::write(&file, format!("{CASE}{pasted}")).expect("a case can be written");
    let (code, output, errors) = check();
    assert_eq!((code, output.contains("paste")), (Some(0), false), "{output}{errors}");
}

/// A block with a keel in a groove, which touch along two flanks; those of the keel have these names.
fn keel_in_groove(flanks_of_keel: [&'static str; 2]) -> Mesh {
    let fold = |x: f64, v: f64| [4.0 * x, v + (4.0 * x - 2.0).abs()];
    let mut bodies = [grid(8, 2, 1, move |u, v| fold(u, v - 1.0)), grid(6, 2, 2, move |u, v| fold(u, 2.0 * v))];
    for (body, along) in bodies.iter_mut().zip([2, 0]) {
        let points = &body.points;
        let is_left = |edge: &[usize; 2]| points[edge[0]][0] + points[edge[1]][0] < 4.0;
        let (left, right) = std::mem::take(&mut body.sides[along]).into_iter().partition(is_left);
        // A flank takes the place of a wall, which has no name.
        body.sides = match along {
            2 => [std::mem::take(&mut body.sides[0]), right, left, Vec::new()],
            _ => [left, right, std::mem::take(&mut body.sides[2]), Vec::new()],
        };
    }
    let [groove, keel] = bodies;
    let [left, right] = flanks_of_keel;
    Mesh {
        bodies: vec![("groove", groove, ["bottom", "groove.right", "groove.left", ""]), ("keel", keel, [left, right, "top", ""])],
    }
}

/// Two bodies that share a contact may touch elsewhere, too, and a boundary may touch in two places; what is in contact already is not
/// proposed a second time, by none of its names.
#[test]
fn a_second_contact_of_two_bodies_is_proposed_where_they_touch_elsewhere() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let bodies =
        "[mesh]\nfile = \"mesh.msh\"\n[body.groove]\nyoung = 1.0\npoisson = 0.3\n[body.keel]\nyoung = 1.0\npoisson = 0.3\n";
    let acting = "[support.base]\non = \"bottom\"\nux = 0.0\nuy = 0.0\n[load.top]\non = \"top\"\ntraction = [0.0, -1e-3]\n";
    let proposed = |mesh: &Mesh, contacts: &[[&str; 2]]| -> Vec<String> {
        let table = |(at, [a, b]): (usize, &[&str; 2])| format!("[contact.c{at}]\nbetween = [\"{a}\", \"{b}\"]\n");
        let contacts: String = contacts.iter().enumerate().map(table).collect();
        write_scene(folder.path(), &mesh.text(), &format!("{bodies}{acting}{contacts}"));
        let (_, output, _) = mezha_in(folder.path(), None, &["check", "case.toml"]);
        let line = |line: &str| line.split("   #").next().unwrap_or(line).to_owned();
        output.lines().filter(|line| line.starts_with("between = ")).map(line).collect()
    };
    let (right, nothing) = ("between = [\"groove.right\", \"keel.right\"]", Vec::<String>::new());
    let both = keel_in_groove(["keel.left", "keel.right"]);
    assert_eq!(proposed(&both, &[["groove.left", "keel.left"]]), [right]);
    assert_eq!(proposed(&both, &[["keel.left", "groove.left"], ["groove.right", "keel.right"]]), nothing);
    let one = keel_in_groove(["keel.both", "keel.both"]);
    assert_eq!(proposed(&one, &[["groove.left", "keel.both"]]), ["between = [\"groove.right\", \"keel.both\"]"]);
    assert_eq!(proposed(&one, &[["groove.left", "keel.both"], ["keel.both", "groove.right"]]), nothing);
}

/// A roller lies in a seat from which a flank goes on: that comes close at its lower end, and is proposed whether the sides are drawn with
/// straight edges or with their circles. A keel that is drawn deep into its groove presses on both flanks.
#[test]
fn a_flank_beside_a_seat_and_both_of_a_sunk_keel_are_proposed() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let ([radius, seat], [bend, end]) = ([1.0, 1.02], [0.6f64, 1.0]);
    let [centre, out] = [[1.0, 2.0], [1.0, 2.0 + seat - radius]];
    let valley = |angle: f64| {
        let turn = angle.clamp(-bend, bend);
        let along = seat * (angle - turn);
        [out[0] + seat * turn.sin() + along * turn.cos(), out[1] - seat * turn.cos() + along * turn.sin()]
    };
    let mut lower = grid(16, 2, 1, |u, v| {
        let [x, y] = valley(2.0 * u - 1.0);
        [x, v * y]
    });
    let is_seat = |edge: &[usize; 2]| edge.iter().all(|&point| (lower.points[point][0] - out[0]).abs() < seat * 0.65f64.sin());
    let (on_seat, flanks): (Vec<_>, Vec<_>) = lower.sides[2].iter().partition(|edge| is_seat(edge));
    let right = flanks.into_iter().filter(|edge: &[usize; 2]| lower.points[edge[0]][0] > centre[0]).collect();
    (lower.sides[1], lower.sides[2]) = (right, on_seat);
    let roller = grid(7, 2, 2, |u, v| {
        let (angle, radius) = (2.0 * u - 1.0, radius * (1.0 - 0.5 * v));
        [centre[0] + radius * (end * angle).sin(), centre[1] - radius * (end * angle).cos()]
    });
    let mesh =
        Mesh { bodies: vec![("lower", lower, ["bottom", "flank", "seat", ""]), ("upper", roller, ["rim", "", "top", ""])] };
    let case = format!("{CASE}[contact.seat]\nbetween = [\"seat\", \"rim\"]\n");
    let round = "geometry.rim={ curves = \"rim\", circle = { centre = [1.0, 2.0], radius = 1.0 } }";
    write_scene(folder.path(), &mesh.text(), &case);
    for sets in [&[][..], &["--set", round]] {
        let (_, output, errors) = mezha_in(folder.path(), None, &[&["check", "case.toml"], sets].concat());
        assert!(output.contains("between = [\"flank\", \"rim\"]"), "{sets:?}: {output}{errors}");
    }
    let mut keel = keel_in_groove(["keel.left", "keel.right"]);
    keel.bodies[1].1.points.iter_mut().for_each(|point| point[1] -= 0.4);
    std::fs::write(folder.path().join("mesh.msh"), keel.text()).expect("a mesh can be written");
    let text = std::fs::read_to_string(new_case(folder.path(), "mesh.msh")).expect("a case");
    assert!(text.matches("\n[contact.").count() == 2 && text.matches("into each other\n").count() == 2, "{text}");
}

/// A pin whose mesh is not quite even about its centre turns in its hole: its turn is proposed to be held, and no shift, which its load
/// drives.
#[test]
fn the_turn_alone_of_a_loaded_pin_is_proposed_to_be_held() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let place = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/lug");
    std::fs::copy(place.join("lug.msh"), folder.path().join("lug.msh")).expect("a mesh");
    let case = std::fs::read_to_string(place.join("case.toml")).expect("the case");
    let (before, after) = case.split_once("[support.pin]").expect("a hold");
    let (_, after) = after.split_once("[contact.seam]").expect("a contact");
    std::fs::write(folder.path().join("case.toml"), format!("{before}[contact.seam]{after}")).expect("a case can be written");
    let (code, output, errors) = mezha_in(folder.path(), None, &["check", "case.toml"]);
    let (_, table) = output.split_once("[support.pin-still]\n").expect("a proposal");
    let keys = |table: &str| table.lines().take_while(|line| line.contains(" = ")).skip(2).map(str::to_owned).collect::<Vec<_>>();
    assert_eq!((code, keys(table)), (Some(3), vec!["angle = 0.0".to_owned()]), "{output}{errors}");
    let first = std::fs::read_to_string(new_case(folder.path(), "lug.msh")).expect("a case");
    assert_eq!(
        first.split_once("[support.pin-still]\n").map(|(_, table)| keys(table)),
        Some(vec!["angle = 0.0".into()]),
        "{first}"
    );
}

/// The figure has every name, also where the case names a boundary that is not there.
#[test]
fn a_check_draws() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let mesh = two_blocks([(3, 2, 1), (2, 2, 2)]).text();
    let file = write_scene(folder.path(), &mesh, &format!("{CASE}{CONTACT}[support.guide]\non = \"top\"\nux = 0.0\n"));
    let name = folder.path().file_name().expect("a name").to_string_lossy().into_owned();
    let case = file.to_string_lossy().into_owned();
    let (code, output, errors) = mezha_in(folder.path(), None, &["check", &case]);
    assert_eq!(code, Some(0), "{output}{errors}");
    assert!(output.ends_with(&format!("figure: out/{name}.check.svg\n")), "{output}");
    let figure = std::fs::read_to_string(folder.path().join("out").join(format!("{name}.check.svg"))).expect("a figure");
    for words in
        [">lower<", ">upper<", ">contact seam<", ">table: ux = 0, uy = 0<", ">top: pressure = 1<", ">bottom<", ">lower.seam<"]
    {
        assert!(figure.contains(words), "{words}");
    }
    let (code, _, errors) =
        mezha_in(folder.path(), None, &["check", &case, "--set", "support.table.on=botom", "--draw", "wrong.svg"]);
    assert!(code == Some(2) && errors.contains("the figure wrong.svg shows what could be read"), "{errors}");
    let figure = std::fs::read_to_string(folder.path().join("wrong.svg")).expect("a figure");
    assert!(figure.contains(">bottom<") && figure.contains("no physical curve &quot;botom&quot;"), "{figure}");
    // A figure takes the place of a figure at most, and of no file of the user's; folders are not made.
    let before = std::fs::read_to_string(&file).expect("the case");
    for (draw, words) in
        [("wrong.svg/a.svg", "cannot be written"), ("nowhere/a.svg", "cannot be written"), (case.as_str(), "no figure")]
    {
        let (code, _, errors) = mezha_in(folder.path(), None, &["check", &case, "--draw", draw]);
        assert!(code == Some(2) && errors.contains(words), "{draw}: {code:?} {errors}");
    }
    assert_eq!(std::fs::read_to_string(&file).expect("the case"), before);
}

/// Nodes on an inner line that are not merged are no error: a slit may be meant.
#[test]
fn a_slit_is_told_by_check_and_run() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let mesh = two_blocks([(3, 2, 1), (3, 2, 2)]).text();
    // One body of both blocks: the seam is then a slit in it.
    let mesh = mesh.replace("2 2 \"upper\"\n", "").replace("$PhysicalNames\n8", "$PhysicalNames\n7");
    let one = mesh.replace("\n2 0 0 0 0 0 0 1 2 0\n$EndEntities", "\n2 0 0 0 0 0 0 1 1 0\n$EndEntities");
    assert_ne!(mesh, one);
    let case = CASE.split("[body.upper]").next().expect("a start").to_owned()
        + "[support.both]\non = [\"bottom\", \"top\"]\nux = 0.0\nuy = 0.0\n";
    let file = write_scene(folder.path(), &one, &case);
    let words = "warning: body \"lower\" has 3 pairs of boundary edges that lie on each other, near (";
    for command in [["check"].as_slice(), &["run", "--out", "result"]] {
        let (code, _, errors) = mezha_in(folder.path(), None, &[command, &[&file.to_string_lossy()]].concat());
        assert!(
            code == Some(0) && errors.matches(words).count() == 1 && errors.contains("Coherence Mesh"),
            "{command:?}: {code:?} {errors}"
        );
    }
}
