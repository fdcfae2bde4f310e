//! Bad cases are refused with words that name file, key, value and remedy; no result folder is left behind.

use crate::support::mesh::{GOOD, Mesh, grid, two_blocks, write_scene};
use crate::support::{Ended, Run, names_in};

fn blocks() -> Mesh {
    two_blocks([(3, 2, 1), (4, 2, 2)])
}

/// A case and a mesh in a folder of their own, run alone and on 2 ranks.
fn ended(mesh: &str, case: &str, change: impl Fn(Run) -> Run) -> [Ended; 2] {
    [None, Some(2)].map(|ranks| {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let file = write_scene(folder.path(), mesh, case);
        let run = change(Run::file(&file));
        let ended = ranks.map_or_else(|| run.clone().alone(), |ranks| run.clone().ranks(ranks)).ended();
        assert_eq!(names_in(folder.path()), ["case.toml", "mesh.msh"], "nothing beside the case");
        ended
    })
}

/// Refused with exit code 2 and these words, with nothing written.
fn refused(mesh: &str, case: &str, change: impl Fn(Run) -> Run, words: &[&str]) {
    for ended in ended(mesh, case, change) {
        assert_eq!(ended.code, Some(2), "{}", ended.said());
        for word in words {
            assert!(ended.errors.contains(word), "no `{word}` in:\n{}", ended.errors);
        }
        let told = ended.errors.lines().filter(|line| line.starts_with("mezha: ")).count();
        assert_eq!(told, 1, "told once, by one rank:\n{}", ended.errors);
        assert_eq!(ended.left_behind(), Vec::<String>::new(), "a result folder is left");
    }
}

/// A key of the good case set to something bad.
fn bad_key(key: &str, value: &str, words: &[&str]) {
    refused(&blocks().text(), GOOD, |run| run.set(key, value), &[words, &["case.toml"]].concat());
}

/// A piece of the good mesh in place of another.
fn bad_mesh(from: &str, to: &str, words: &[&str]) {
    let good = blocks().text();
    let text = good.replacen(from, to, 1);
    assert_ne!(text, good, "the mesh has no `{from}`");
    refused(&text, GOOD, |run| run, &[words, &["mesh.msh"]].concat());
}

/// Such moduli ended in a panic.
#[test]
fn moduli_without_a_common_measure_are_refused() {
    bad_key("body.upper.young", "1e-80", &["body.upper: young = 1e-80 beside 7e3", "take a rigid tool for what is so hard"]);
}

/// Points and springs, against the mesh.
#[test]
fn points_outside_and_springs_that_push_away_are_refused() {
    bad_key(
        "support.pin",
        "{ at = [9, 9], ux = 0 }",
        &["support.pin.at = [9, 9]", "outside every body", "nearest vertex is [2, 2]"],
    );
    bad_key("support.pin", "{ at = [1, 1], ux = 0 }", &["support.pin.at", "write body = \"lower\" beside it"]);
    bad_key("load.pull", "{ at = [1, 2.5], body = \"upper\", force = [0, 1] }", &["load.pull.at", "outside body \"upper\""]);
    bad_key("load.pull", "{ at = [1, 2], force = [\"sqrt(x-2)\", 1] }", &["load.pull.force", "finite", "(1, 2)"]);
    bad_key("support.bed", "{ on = \"right\", stiffness = { x = \"y-1\" } }", &["support.bed.stiffness: is -1 at (2, 0)"]);
    bad_key(
        "contact.seam.between",
        "[[\"lower.seam\", \"right\"], \"upper.seam\"]",
        &["\"lower.seam + right\" lies on 2 bodies"],
    );
}

/// Load steps, against the case and in one step.
#[test]
fn steps_that_scale_nothing_or_are_not_alike_are_refused() {
    let steps = |words: &str, expected: &[&str]| bad_key("steps", words, expected);
    steps("{ p = { factors = [], scales = [\"load.top\"] } }", &["steps.p.factors = []", "must not be empty"]);
    steps("{ p = { factors = [0.5, nan], scales = [\"load.top\"] } }", &["steps.p.factors", "entry 2: must be a finite number"]);
    steps("{ p = { factors = [1], scales = [\"load.topp\"] } }", &["steps.p.scales", "did you mean \"load.top\"?"]);
    steps("{ p = { factors = [1], scales = [\"contact.seam.gap\"] } }", &["steps.p.scales", "gap = \"closed\""]);
    steps(
        "{ p = { factors = [1, 2], scales = [\"load.top\"] }, q = { factors = [1], scales = [\"support.wall\"] } }",
        &["steps.q.factors", "lists 1 steps, but steps.p lists 2"],
    );
    // Two supports meet in a corner, and one of them is scaled: they contradict each other in the second step alone.
    let corner = |run: Run| {
        let run = run.set("support.push", "{ on = \"left\", uy = 0.1 }").set("support.table.uy", 0.1);
        run.set("steps.p", "{ factors = [1, 2, 1], scales = [\"support.push\"] }")
    };
    refused(&blocks().text(), GOOD, corner, &["case.toml", "step 2 of 3 (p = 2)", "support.push", "support.table"]);
}

#[test]
fn the_good_case_runs() {
    for ended in ended(&blocks().text(), GOOD, |run| run) {
        assert_eq!(ended.code, Some(0), "{}", ended.said());
    }
}

#[test]
fn an_unknown_key() {
    bad_key("body.lower.yuong", "1.0", &["body.lower.yuong", "young"]);
    bad_key("mesh.refin", "1", &["mesh.refin", "refine"]);
}

#[test]
fn a_value_out_of_range() {
    bad_key("body.upper.young", "-3000.0", &["body.upper.young", "-3000"]);
    bad_key("body.upper.poisson", "0.5", &["body.upper.poisson", "0.5", "0.49"]);
    bad_key("body.upper.poisson", "0.7", &["body.upper.poisson", "0.7"]);
    bad_key("solver.tolerance", "0", &["solver.tolerance"]);
}

#[test]
fn a_missing_file() {
    bad_key("mesh.file", "\"nothing.msh\"", &["mesh.file", "nothing.msh", "name a Gmsh file"]);
    let file = std::path::Path::new("no/such/case.toml");
    for run in [Run::file(file).alone(), Run::file(file).ranks(2)] {
        let ended = run.ended();
        assert_eq!(ended.code, Some(2), "{}", ended.said());
        assert!(ended.errors.contains("no/such/case.toml: cannot be read"), "{}", ended.errors);
    }
}

#[test]
fn an_unknown_name() {
    bad_key("support.table.on", "\"botom\"", &["support.table.on", "botom", "did you mean \"bottom\""]);
    bad_key("contact.seam.between", "[\"lower.seam\", \"uper.seam\"]", &["contact.seam.between", "uper.seam", "\"upper.seam\""]);
    bad_key("body.middle", "{ young = 1.0, poisson = 0.3 }", &["body.middle", "\"lower\"", "\"upper\""]);
}

#[test]
fn contradicting_supports() {
    bad_key("support.pull", "{ on = \"bottom\", uy = 0.1 }", &["support.pull", "support.table", "0.1", "leave one"]);
}

#[test]
fn contact_of_a_body_with_itself() {
    bad_key("contact.seam.between", "[\"lower.seam\", \"bottom\"]", &["contact.seam.between", "lower", "itself"]);
}

#[test]
fn boundaries_that_do_not_face_each_other() {
    let mut apart = blocks();
    apart.bodies[1].1.points.iter_mut().for_each(|x| x[0] += 5.0);
    refused(&apart.text(), GOOD, |run| run, &["case.toml", "contact.seam", "do not face each other"]);
}

#[test]
fn deformed_bodies_with_a_declared_curve() {
    bad_key("contact.seam.configuration", "\"deformed\"", &["contact.seam.configuration", "wants curve = \"fit\""]);
}

/// Nothing holds the upper block in x: exit code 3, and a summary that says so.
#[test]
fn a_body_that_nothing_holds() {
    let mut mesh = blocks();
    mesh.bodies[1].2[3] = "upper.left";
    for ended in ended(&mesh.text(), GOOD, |run| run) {
        assert_eq!(ended.code, Some(3), "{}", ended.said());
        assert_eq!(ended.value("/status"), "not_converged");
        let reason = ended.value("/reason").as_str().expect("words").to_string();
        for word in ["upper", "move by (1, 0)"] {
            assert!(reason.contains(word), "{reason}");
        }
        assert!(ended.output.contains("mezha: NOT converged: "), "{}", ended.output);
    }
}

/// Contact may not pull: a body that is lifted off has nothing left that holds it.
#[test]
fn a_body_that_is_lifted_off() {
    for ended in ended(&blocks().text(), GOOD, |run| run.set("load.top.pressure", "-1.0")) {
        assert_eq!(ended.code, Some(3), "{}", ended.said());
        let reason = ended.value("/reason").as_str().expect("words").to_string();
        assert!(
            ["upper", "move by (0, 1)", "load.top", "turn the load round"].iter().all(|word| reason.contains(word)),
            "{reason}"
        );
    }
}

#[test]
fn meshes_of_other_kinds() {
    bad_mesh("4.1 0 8", "4 0 8", &["line 2", "mesh format 4", "-format msh41"]);
    bad_mesh("4.1 0 8", "4.1 1 8", &["line 2", "binary", "gmsh mesh.msh"]);
    bad_mesh("$MeshFormat\n", "# a comment\n", &["line 1", "$MeshFormat"]);
    let triangles = blocks().text().lines().find(|line| line.starts_with("2 1 2 ")).expect("a block of triangles").to_string();
    bad_mesh(&format!("\n{triangles}\n"), &format!("\n{}\n", triangles.replacen("2 1 2", "2 1 4", 1)), &["volume elements"]);
    bad_mesh(&format!("\n{triangles}\n"), &format!("\n{}\n", triangles.replacen("2 1 2", "2 1 21", 1)), &["-order 1"]);
    bad_mesh("$EndElements\n", "", &["cut off"]);
}

#[test]
fn a_binary_mesh_is_not_taken_for_text() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = write_scene(folder.path(), "", GOOD);
    let bytes = [b"$MeshFormat\n4.1 1 8\n".as_slice(), &[1, 0, 0, 0, 255, 254, 0, 10, 128]].concat();
    std::fs::write(folder.path().join("mesh.msh"), bytes).expect("a mesh can be written");
    let ended = Run::file(&file).alone().ended();
    assert_eq!(ended.code, Some(2), "{}", ended.said());
    assert!(ended.errors.contains("mesh.msh, byte"), "{}", ended.errors);
}

#[test]
fn a_degenerate_triangle() {
    let mut mesh = blocks();
    let [a, b, c] = mesh.bodies[0].1.triangles[3];
    let points = &mut mesh.bodies[0].1.points;
    points[c] = [0.5 * (points[a][0] + points[b][0]), 0.5 * (points[a][1] + points[b][1])];
    refused(&mesh.text(), GOOD, |run| run, &["mesh.msh, line", "degenerate triangle", "mesh the scene again"]);
}

#[test]
fn clockwise_triangles_are_turned_round() {
    let mut mesh = blocks();
    mesh.bodies[1].1.triangles.iter_mut().step_by(2).for_each(|corners| corners.swap(0, 2));
    for ended in ended(&mesh.text(), GOOD, |run| run.set("solver.tolerance", "1e-12")) {
        assert_eq!(ended.code, Some(0), "{}", ended.said());
        assert!((ended.number("/contact/seam/force") - 2.0).abs() < 1e-9);
    }
}

/// Gmsh makes one if both bodies are drawn on one line.
#[test]
fn bodies_that_share_nodes() {
    let block = grid(3, 4, 1, |u, v| [2.0 * u, 2.0 * v]);
    let text = Mesh { bodies: vec![("lower", block, ["bottom", "right", "top", "left"])] }.text();
    let upper = text.lines().rfind(|line| line.starts_with("2 1 2 ")).expect("triangles");
    let shared = text
        .replace("\n1 \"lower\"", "")
        .replace("2 1 \"lower\"", "2 1 \"lower\"\n2 2 \"upper\"")
        .replace("$PhysicalNames\n5", "$PhysicalNames\n6")
        .replace("0 4 1 0\n", "0 4 2 0\n")
        .replace("\n$EndEntities", "\n2 0 0 0 0 0 0 1 2 0\n$EndEntities")
        .replace(upper, "2 1 2 12")
        .replace("\n5 38 1 38\n", "\n6 38 1 38\n");
    let lines: Vec<&str> = shared.lines().collect();
    let at = lines.iter().position(|line| *line == "2 1 2 12").expect("triangles") + 13;
    let shared = [&lines[..at], &["2 2 2 12"], &lines[at..]].concat().join("\n") + "\n";
    refused(&shared, GOOD, |run| run, &["mesh.msh", "\"lower\" and \"upper\" share the node", "of its own"]);
}

#[test]
fn an_option_that_nothing_uses() {
    for ended in ended(&blocks().text(), GOOD, |run| run.petsc("-fieldsplit_u_pc_typ lu")) {
        assert_eq!(ended.code, Some(2), "{}", ended.said());
        assert!(ended.errors.contains("-fieldsplit_u_pc_typ"), "{}", ended.errors);
        assert_eq!(ended.left_behind(), Vec::<String>::new());
    }
}

#[test]
fn a_result_is_not_overwritten() {
    let first = Run::case("patch_flat").set("mesh.refine", 0).converged();
    let before = std::fs::read_to_string(first.out.join("summary.json")).expect("a summary");
    let second = Run::case("patch_flat").set("mesh.refine", 1).ranks(2).ended_in(first.into_folder());
    assert_eq!(second.code, Some(2), "{}", second.said());
    assert!(second.errors.contains("--force") && second.errors.contains("result"), "{}", second.errors);
    assert_eq!(std::fs::read_to_string(second.out.join("summary.json")).expect("a summary"), before);
    let third = Run::case("patch_flat").set("mesh.refine", 1).word("--force").ended_in(second.into_folder());
    assert_eq!(third.code, Some(0), "{}", third.said());
    assert_ne!(std::fs::read_to_string(third.out.join("summary.json")).expect("a summary"), before);
    assert_eq!(third.left_behind(), ["result"]);
}

#[test]
fn two_contacts_of_the_same_boundaries_are_refused() {
    let case =
        format!("{GOOD}contact.again = {{ between = [\"upper.seam\", \"lower.seam\"], curve = \"line\", gap = \"closed\" }}\n");
    refused(&blocks().text(), &case, |run| run, &["contact.", "joins the same boundaries", "case.toml"]);
}

#[test]
fn a_contact_forced_shut_and_then_released_converges() {
    let change = |run: Run| run.set("support.lid.on", "top").set("support.lid.uy", 0.0).set("contact.seam.gap", 0.1);
    for ended in ended(&blocks().text(), GOOD, change) {
        assert_eq!(ended.code, Some(0), "{}", ended.said());
        assert_eq!(ended.number("/contact/seam/force"), 0.0);
    }
}

#[test]
fn a_formula_without_a_value_is_refused_with_its_key() {
    bad_key("contact.seam.gap", "sqrt(x-1)", &["contact.seam.gap", "finite"]);
    bad_key("load.top.pressure", "sqrt(x-1)", &["load", "finite"]);
    for gap in ["sqrt(x-5)", "1/(x-x)", "sqrt(x-1)"] {
        let words = [format!("gap = {gap} is no number at (0, 1)"), "correct the formula".into()];
        let fitted = |run: Run| run.set("contact.seam.curve", "fit").set("contact.seam.gap", gap);
        refused(&blocks().text(), GOOD, fitted, &words.each_ref().map(String::as_str));
    }
}

#[test]
fn a_boundary_in_pieces_is_not_one_with_corners() {
    let fitted = |run: Run| run.set("contact.seam.curve", "fit");
    let mut mesh = blocks();
    mesh.bodies[1].1.sides[0].remove(1);
    refused(&mesh.text(), GOOD, fitted, &["\"upper.seam\" is of pieces that do not hang together, 2 of which touch"]);
    let steps = blocks().map(|[x, y]| [x, if y == 1.0 { y + 0.3 * (x - 1.0).abs() } else { y }]);
    refused(&steps.text(), GOOD, fitted, &["has corners of more than 20 degrees, and 2 of its smooth stretches touch"]);
}

#[test]
fn too_fine_a_mesh_and_options_without_effect_are_refused() {
    refused(&blocks().text(), GOOD, |run| run.set("mesh.refine", 12), &["mesh.refine = 12", "32-bit"]);
    refused(&blocks().text(), GOOD, |run| run.petsc("-ksp_rtol 1e-3"), &["-ksp_rtol", "solver.tolerance"]);
    refused(&blocks().text(), GOOD, |run| run.petsc("ksp_monitor"), &["begin with a minus"]);
}

/// A boundary so bent that it cuts through its own body.
#[test]
fn a_triangle_that_a_geometry_turns_inside_out() {
    let lower = grid(1, 1, 1, |u, v| [2.0 * u, 0.5 * v]);
    let upper = grid(1, 1, 2, |u, v| [2.0 * u, 0.5 + v]);
    let mesh = Mesh {
        bodies: vec![
            ("lower", lower, ["bottom", "right", "lower.seam", "left"]),
            ("upper", upper, ["upper.seam", "right", "top", "left"]),
        ],
    };
    let circle = "geometry.arc = { curves = [\"lower.seam\", \"upper.seam\"], circle = { centre = [1.0, 0.8201562118716424], radius = 1.05 } }\n";
    let case = GOOD.replace("curve = \"line\"", "curve = \"geometry\"") + circle;
    refused(
        &mesh.text(),
        &case,
        |run| run.set("mesh.refine", 2),
        &["turned inside out", "triangle around", "[geometry]", "case.toml"],
    );
}
