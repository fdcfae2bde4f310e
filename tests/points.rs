//! Bodies that are held, and loaded, at a point: any point of a body, against exact solutions.

mod support;

use support::mesh::{Mesh, grid, write_scene};
use support::{Ended, RANKS, Run, mezha};

const EXACT: f64 = 1e-9;

fn close(found: f64, wanted: f64, size: f64, words: &str) {
    assert!((found - wanted).abs() <= EXACT * size, "{words}: {found} instead of {wanted}");
}

fn numbers(ended: &Ended, pointer: &str) -> [f64; 2] {
    [0, 1].map(|k| ended.number(&format!("{pointer}/{k}")))
}

/// Runs a case with P1 and P2, on 1, 2 and 3 ranks.
fn run(mesh: &Mesh, case: &str, check: impl Fn(&str, Ended)) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = write_scene(folder.path(), &mesh.text(), case);
    for (order, ranks) in [(1, 1), (1, 3), (2, 1), (2, 2), (2, 3)] {
        let ended = Run::file(&file).ranks(ranks).set("mesh.order", order).converged();
        check(&format!("P{order}, {ranks} ranks"), ended);
    }
}

const BAR: &str = r#"
mesh = { file = "mesh.msh", refine = 2 }
body.bar = { young = 200.0, poisson = 0.3 }
load.left = { on = "left", traction = [-10.0, 0.0] }
load.right = { on = "right", traction = [10.0, 0.0] }
support.pin = { at = [0.33, 0.41], ux = 0.0, uy = 0.0 }
support.roller = { at = [1.71, 0.35], body = "bar", uy = 0.0 }
probe.corner = { point = [2.0, 1.0], body = "bar" }
solver.tolerance = 1e-13
"#;

/// A bar under even tension, held by two points inside it that are no vertices of its mesh: one strain everywhere, and no force
/// at the points.
#[test]
fn a_bar_that_is_held_by_points_inside_it_stretches_evenly() {
    let mesh = Mesh { bodies: vec![("bar", grid(5, 3, 11, |u, v| [2.0 * u, v]), ["bottom", "right", "top", "left"])] };
    run(&mesh, BAR, |words, ended| {
        let (e, nu) = (200.0, 0.3);
        let [along, across] = [10.0 * (1.0 - nu * nu) / e, -10.0 * nu * (1.0 + nu) / e];
        // The bar turns until its second point is as high as it was.
        let turn = -across * (0.35 - 0.41) / (1.71 - 0.33);
        let [dx, dy] = [2.0 - 0.33, 1.0 - 0.41];
        let u = numbers(&ended, "/probe/corner/u");
        close(u[0], along * dx - turn * dy, along, words);
        close(u[1], across * dy + turn * dx, along, words);
        let stress = numbers(&ended, "/probe/corner/stress");
        close(stress[0], 10.0, 10.0, words);
        close(stress[1], 0.0, 10.0, words);
        for support in ["pin", "roller"] {
            let reaction = numbers(&ended, &format!("/support/{support}/reaction"));
            reaction.iter().for_each(|force| close(*force, 0.0, 10.0, &format!("{words}: {support}")));
        }
        assert!(!ended.errors.contains("carries a force"), "{words}: {}", ended.errors);
        assert!(ended.number("/balance/bodies") < EXACT && ended.number("/balance/energy") < EXACT, "{words}");
    });
}

const BLOCKS: &str = r#"
mesh = { file = "mesh.msh", refine = 1 }
body.lower = { young = 7000.0, poisson = 0.227 }
body.upper = { young = 3000.0, poisson = 0.3 }
support.table = { on = "bottom", uy = 0.0 }
support.below = { at = [1.0, 1.0], body = "lower", ux = 0.0 }
support.above = { at = [0.6, 2.0], ux = 0.0 }
load.top = { on = "top", pressure = 3.0 }
contact.seam = { between = ["lower.seam", "upper.seam"], curve = "line", gap = "closed" }
solver.tolerance = 1e-12
"#;

/// Two blocks, of unequal meshes, that a pressure holds together; each is kept from sliding by a point of its boundary, one of
/// them on the contact.
fn blocks() -> Mesh {
    let lower = grid(5, 3, 11, |u, v| [2.0 * u, v]);
    let upper = grid(6, 3, 12, |u, v| [2.0 * u, 1.0 + v]);
    Mesh {
        bodies: vec![
            ("lower", lower, ["bottom", "right", "lower.seam", "left"]),
            ("upper", upper, ["upper.seam", "right", "top", "left"]),
        ],
    }
}

#[test]
fn blocks_that_points_keep_from_sliding_press_evenly() {
    run(&blocks(), BLOCKS, |words, ended| {
        for point in ended.trace("seam") {
            close(point.lambda, 3.0, 3.0, words);
        }
        for support in ["below", "above"] {
            let reaction = numbers(&ended, &format!("/support/{support}/reaction"));
            reaction.iter().for_each(|force| close(*force, 0.0, 6.0, &format!("{words}: {support}")));
        }
        let table = numbers(&ended, "/support/table/reaction");
        close(table[1], 6.0, 6.0, words);
        assert!(["force", "bodies", "energy"].iter().all(|key| ended.number(&format!("/balance/{key}")) < EXACT), "{words}");
    });
}

/// The words for a body that is loose name a support; with it the case is right, in any unit.
#[test]
fn the_support_that_is_proposed_holds() {
    for scale in [1e-6, 0.3, 1e6] {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let case = BLOCKS.lines().filter(|line| !line.contains("at = ")).collect::<Vec<_>>().join("\n");
        let mesh = blocks().map(|[x, y]| [scale * (0.8 * x - 0.6 * y), scale * (0.6 * x + 0.8 * y)]);
        let mut file = write_scene(folder.path(), &mesh.text(), &format!("{case}\nsupport.normal = {{ on = \"bottom\", normal = 0.0 }}").replace("support.table = { on = \"bottom\", uy = 0.0 }", ""));
        for round in 0.. {
            let (code, output, errors) = mezha(None, &["check", &file.display().to_string()]);
            if code == Some(0) {
                assert!(round == 2, "{round} supports");
                break;
            }
            assert!(code == Some(3) && round < 2, "{output}\n{errors}");
            let words = errors.split("a support with ").nth(1).expect("a remedy").split(", which is").next().expect("words");
            let text = std::fs::read_to_string(&file).expect("the case");
            file = write_scene(folder.path(), &mesh.text(), &format!("{text}\nsupport.s{round} = {{ {} }}", words.replace(" and ", ", ").replace(" = 0", " = 0.0")));
        }
    }
}

/// A body that stands on a point: equilibrium is met, and a warning says what the point does.
#[test]
fn a_point_that_carries_a_body_is_told() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let case = BAR.replace("load.left = { on = \"left\", traction = [-10.0, 0.0] }\n", "");
    let mesh = Mesh { bodies: vec![("bar", grid(5, 3, 11, |u, v| [2.0 * u, v]), ["bottom", "right", "top", "left"])] };
    let file = write_scene(folder.path(), &mesh.text(), &case);
    let ended = Run::file(&file).ended();
    assert!(ended.errors.contains("support pin: the point at (0.33, 0.41) carries a force of (-10.00, "), "{}", ended.said());
    close(numbers(&ended, "/support/pin/reaction")[0], -10.0, 10.0, "pin");
}

/// Adaptive meshes keep the point, and a resolved case repeats the run.
#[test]
fn a_point_stays_where_the_mesh_adapts() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let case = format!("accuracy = 1e-2\n{}", BLOCKS.replace("pressure = 3.0", "pressure = \"3 + x\""));
    let file = write_scene(folder.path(), &blocks().text(), &case);
    let mut forces = Vec::new();
    for ranks in RANKS {
        let ended = Run::file(&file).ranks(ranks).converged();
        for support in ["below", "above"] {
            let reaction = numbers(&ended, &format!("/support/{support}/reaction"));
            assert!(reaction.iter().all(|force| force.abs() < 1e-7), "{ranks} ranks: {support} {reaction:?}");
        }
        forces.push(ended.number("/energy/total"));
        if ranks == 1 {
            let again = Run::file(&ended.out.join("case.toml")).converged();
            assert_eq!(again.number("/energy/total"), forces[0], "the resolved case");
        }
    }
    forces.iter().for_each(|force| assert!((force / forces[0] - 1.0).abs() < 1e-8, "{forces:?}"));
}
