//! What everyday scenes need, against exact solutions: bodies that are held, or loaded, at a point, springs, weight, and sides of
//! contacts that are made of several curves.

use crate::support::mesh::{Block, Mesh, grid, two_blocks, write_scene};
use crate::support::{Run, close, mezha, numbers, ranks_in_turn, with_both_orders};

const EXACT: f64 = 1e-9;

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
    with_both_orders(&mesh, BAR, |words, ended| {
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
    two_blocks([(5, 3, 11), (6, 3, 12)])
}

#[test]
fn blocks_that_points_keep_from_sliding_press_evenly() {
    with_both_orders(&blocks(), BLOCKS, |words, ended| {
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
        let mut file = write_scene(
            folder.path(),
            &mesh.text(),
            &format!("{case}\nsupport.normal = {{ on = \"bottom\", normal = 0.0 }}")
                .replace("support.table = { on = \"bottom\", uy = 0.0 }", ""),
        );
        for round in 0.. {
            let (code, output, errors) = mezha(None, &["check", &file.display().to_string()]);
            if code == Some(0) {
                assert!(round == 2, "{round} supports");
                break;
            }
            assert!(code == Some(3) && round < 2, "{output}\n{errors}");
            let words = errors.split("a support with ").nth(1).expect("a remedy").split(", which is").next().expect("words");
            let text = std::fs::read_to_string(&file).expect("the case");
            file = write_scene(
                folder.path(),
                &mesh.text(),
                &format!(
                    "{text}\nsupport.s{round} = {{ {} }}",
                    words.trim().replace(" and ", ", ").replace(" = 0.0", " = 0").replace(" = 0", " = 0.0")
                ),
            );
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
    assert!(ended.errors.contains("support pin: the point at (0.33, 0.41) carries a force of (-10, "), "{}", ended.said());
    close(numbers(&ended, "/support/pin/reaction")[0], -10.0, 10.0, "pin");
}

/// Adaptive meshes keep the point, and a resolved case repeats the run.
#[test]
fn a_point_stays_where_the_mesh_adapts() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let case = BLOCKS.replace("refine = 1", "refine = 0").replace("pressure = 3.0", "pressure = \"exp(2*x)\"");
    let case = format!("accuracy = 4e-3\n{case}");
    let file = write_scene(folder.path(), &blocks().text(), &case);
    let mut forces = Vec::new();
    for ranks in ranks_in_turn(1) {
        let ended = Run::file(&file).ranks(ranks).converged();
        for support in ["below", "above"] {
            let reaction = numbers(&ended, &format!("/support/{support}/reaction"));
            assert!(reaction.iter().all(|force| force.abs() < 1e-7), "{ranks} ranks: {support} {reaction:?}");
        }
        forces.push(ended.number("/energy/total"));
        if ranks == 1 {
            assert!(ended.value("/accuracy").as_array().is_some_and(|meshes| meshes.len() > 1), "it adapts");
            let again = Run::file(&ended.out.join("case.toml")).converged();
            assert_eq!(again.number("/energy/total"), forces[0], "the resolved case");
        }
    }
    forces.iter().for_each(|force| assert!((force / forces[0] - 1.0).abs() < 1e-8, "{forces:?}"));
}

/// A disc under two opposite forces, at points of its rim that are no vertices of the mesh: the stresses of Timoshenko and
/// Goodier, Theory of Elasticity (1970), section 41.
#[test]
fn a_disc_under_two_forces_has_the_stress_of_timoshenko() {
    let stress = |x: f64, y: f64| {
        let of = |b: f64| [x * x * b, b.powi(3), b * b * x].map(|value| value / (x * x + b * b).powi(2));
        let ([xx, yy, xy], [xx2, yy2, xy2]) = (of(1.0 - y), of(1.0 + y));
        let factor = 2.0 / std::f64::consts::PI;
        [factor * (0.5 - xx - xx2), factor * (0.5 - yy - yy2), factor * (xy - xy2)]
    };
    for (order, refine, most) in [(1, 4, 0.05), (2, 2, 6e-3)] {
        for ranks in [1, 3] {
            let ended = Run::case("brazilian").set("mesh.order", order).set("mesh.refine", refine).set("exact.must_hold", false);
            let ended = ended.ranks(ranks).converged();
            for (probe, [x, y]) in [("centre", [0.0, 0.0]), ("side", [0.4, 0.3]), ("high", [0.0, 0.5])] {
                let exact = stress(x, y);
                let size = exact.iter().map(|value| value.abs()).fold(0.0, f64::max);
                for (k, exact) in exact.into_iter().enumerate() {
                    let found = ended.number(&format!("/probe/{probe}/stress/{k}"));
                    assert!((found - exact).abs() < most * size, "P{order}, {probe} {k}: {found} instead of {exact}");
                }
            }
            for support in ["centre", "turn"] {
                let reaction = numbers(&ended, &format!("/support/{support}/reaction"));
                assert!(reaction.iter().all(|force| force.abs() < 1e-7), "{support}: {reaction:?}");
            }
            assert!(ended.errors.contains("load top: a force at the point (0, 1) has an infinite energy"), "{}", ended.errors);
            assert!(ended.number("/balance/bodies") < EXACT && ended.number("/balance/energy") < 1e-8);
            assert!(ended.number("/estimate/energy") < 0.1, "the triangles at the forces are left out");
        }
    }
}

/// A force at a point on one of two blocks: the contact carries it, force and moment.
#[test]
fn a_contact_carries_a_force_at_a_point() {
    let case = BLOCKS.replace("{ on = \"top\", pressure = 3.0 }", "{ at = [0.95, 2.0], force = [0.0, -6.0] }");
    with_both_orders(&blocks(), &case, |words, ended| {
        assert!((ended.number("/contact/seam/force") - 6.0).abs() < 6e-9, "{words}");
        assert!((ended.number("/contact/seam/moment") - 6.0 * 0.95).abs() < 1e-7, "{words}");
        assert!(["force", "bodies", "energy"].iter().all(|key| ended.number(&format!("/balance/{key}")) < EXACT), "{words}");
    });
}

const ON_SPRINGS: &str = r#"
mesh = { file = "mesh.msh", refine = 3 }
body.block = { young = 200.0, poisson = 0.3 }
load.top = { on = "top", pressure = 4.0 }
support.side = { at = [0.0, 0.0], ux = 0.0 }
support.bed = { on = "bottom", stiffness = { normal = 50.0 } }
probe.corner = { point = [2.0, 1.0], body = "block" }
solver.tolerance = 1e-13
"#;

fn block() -> Mesh {
    Mesh { bodies: vec![("block", grid(5, 3, 11, |u, v| [2.0 * u, v]), ["bottom", "right", "top", "left"])] }
}

/// A block on springs under an even pressure: it sinks by p/k, and is in even compression, however soft or stiff the springs
/// are, along the normal or along y.
#[test]
fn a_block_on_springs_sinks_evenly() {
    for key in ["normal", "y"] {
        let case = ON_SPRINGS.replace("normal = 50.0", &format!("{key} = 50.0"));
        with_both_orders(&block(), &case, |words, ended| {
            let u = numbers(&ended, "/probe/corner/u");
            let (e, nu) = (200.0, 0.3);
            close(u[1], -4.0 / 50.0 - 4.0 * (1.0 - nu * nu) / e, 0.1, words);
            close(u[0], 2.0 * 4.0 * nu * (1.0 + nu) / e, 0.1, words);
            close(numbers(&ended, "/support/bed/reaction")[1], 8.0, 8.0, words);
            close(ended.number("/energy/springs"), 0.5 * 50.0 * 2.0 * (4.0f64 / 50.0).powi(2), 1.0, words);
            assert!(ended.number("/balance/bodies") < EXACT && ended.number("/balance/energy") < EXACT, "{words}");
        });
    }
}

#[test]
fn springs_may_be_soft_or_stiff() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = write_scene(folder.path(), &block().text(), ON_SPRINGS);
    // The finest edges are some 1/24 long.
    for share in [1e-6, 1e-3, 1.0, 1e3, 1e6] {
        for (order, refine) in [(1, 4), (2, 3)] {
            let k = share * 200.0 * 24.0;
            let run = Run::file(&file).set("mesh.order", order).set("mesh.refine", refine).set("solver.tolerance", 1e-8);
            let run =
                run.set("solver.name", "fieldsplit").set("support.bed.stiffness.normal", k).set("load.top.pressure", "4 + x");
            let ended = run.converged();
            let iterations = ended.number("/solver/iterations/0");
            assert!(iterations <= 20.0, "k h / E = {share}, P{order}: {iterations} iterations");
            let force = numbers(&ended, "/support/bed/reaction");
            assert!((force[1] / 10.0 - 1.0).abs() < 1e-6, "k h / E = {share}: {force:?}");
        }
    }
}

/// A column between smooth walls: quadratic displacements, which P2 has exactly.
#[test]
fn a_column_weighs_what_its_density_says() {
    let case = r#"
        mesh = { file = "mesh.msh", refine = 1 }
        gravity.g = [0.0, -9.81]
        body.block = { young = 200.0, poisson = 0.3, density = 2.5, body_force = ["0", "0.5*y"] }
        support.walls = { on = ["left", "right"], ux = 0.0 }
        support.floor = { on = "bottom", uy = 0.0 }
        probe.middle = { point = [1.0, 0.4], body = "block" }
        solver.tolerance = 1e-13
    "#;
    let even = case.replace(", body_force = [\"0\", \"0.5*y\"]", "");
    with_both_orders(&block(), &even, |words, ended| {
        let weight = 2.5 * 9.81;
        close(numbers(&ended, "/support/floor/reaction")[1], 2.0 * weight, weight, words);
        if words.starts_with("P2") {
            close(numbers(&ended, "/probe/middle/stress")[1], -0.6 * weight, weight, words);
        }
    });
    with_both_orders(&block(), case, |words, ended| {
        close(numbers(&ended, "/support/floor/reaction")[1], 2.0 * (2.5 * 9.81 - 0.25), 50.0, words);
    });
}

/// A punch with a flat and two round shoulders; its flat edges, its shoulders, its top and its walls.
fn punch() -> Block {
    let height = |x: f64| 1.0 + 0.5 * (x.abs() - 0.5f64).max(0.0).powi(2);
    let mut punch = grid(8, 3, 12, |u, v| {
        let x = 2.0 * u - 1.0;
        [x, height(x) * (1.0 - v) + 2.0 * v]
    });
    let [bottom, right, top, left] = punch.sides;
    let is_flat = |edge: &[usize; 2]| edge.iter().all(|&k| punch.points[k][0].abs() < 0.51);
    let (flat, round) = bottom.into_iter().partition(is_flat);
    punch.sides = [flat, round, top, [right, left].concat()];
    punch
}

const PUNCH: &str = r#"
mesh = { file = "mesh.msh", refine = 2 }
body.base = { young = 1000.0, poisson = 0.3 }
body.punch = { young = 1000.0, poisson = 0.3 }
support.table = { on = "bottom", ux = 0.0, uy = 0.0 }
support.upright = { at = [0.0, 2.0], ux = 0.0 }
load.top = { on = "top", pressure = 20.0 }
contact.seam = { between = ["base.top", "side"] }
"#;

/// A side that is made of a flat and of arcs is the same as one physical curve of them all.
#[test]
fn a_side_of_several_curves_is_one_side() {
    let with = |names: [&'static str; 4], side: &str, settings: &[(&str, &str)]| {
        let base = grid(14, 6, 11, |u, v| [4.0 * u - 2.0, 2.0 * v - 1.0]);
        let mesh = Mesh { bodies: vec![("base", base, ["bottom", "", "base.top", ""]), ("punch", punch(), names)] };
        let folder = tempfile::tempdir().expect("a temporary folder");
        let file = write_scene(folder.path(), &mesh.text(), &PUNCH.replace("\"side\"", side));
        let run = settings.iter().fold(Run::file(&file), |run, (key, value)| run.set(key, value));
        let ended = run.converged();
        let force = ["/contact/seam/force", "/contact/seam/pressure_max"].map(|key| ended.number(key));
        if settings.is_empty() {
            let again = Run::file(&ended.out.join("case.toml")).ranks(2).converged();
            assert!((again.number("/contact/seam/force") / force[0] - 1.0).abs() < 1e-8, "{side}: the resolved case");
        }
        let written = ended.out.join("adapted.msh");
        if written.exists() {
            let text = std::fs::read_to_string(written).expect("a mesh");
            let is_named = text.contains("\"side\"") || text.contains("\"flat\"") && text.contains("\"round\"");
            assert!(!text.contains(" + ") && is_named, "physical curves alone are written");
        }
        force
    };
    for settings in [&[][..], &[("mesh.order", "1")], &[("accuracy.force", "1e-2"), ("mesh.refine", "0")]] {
        let one = with(["side", "side", "top", ""], "\"side\"", settings);
        let several = with(["flat", "round", "top", ""], "[\"flat\", \"round\"]", settings);
        one.iter().zip(&several).for_each(|(one, several)| assert!((one / several - 1.0).abs() < 1e-8, "{one} and {several}"));
        assert!((one[0] / 40.0 - 1.0).abs() < 1e-2, "{one:?}");
    }
}

/// With a thickness the forces of the case and of the result are those of all of it; nothing else changes.
#[test]
fn a_thickness_multiplies_forces_and_energies() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let case = format!(
        "thickness = 2.5\n{}\nload.point = {{ at = [1.0, 2.0], force = [\"0.5*x\", -1.0] }}
exact = {{ must_hold = true, contact.seam.force = {{ value = 7.0, tolerance = 1e-8 }} }}",
        BLOCKS.replace("support.above = { at = [0.6, 2.0], ux = 0.0 }", "support.above = { on = \"left\", ux = 0.0 }")
    );
    let file = write_scene(folder.path(), &blocks().text(), &case);
    for ranks in [1, 2] {
        let one = Run::file(&file).ranks(ranks).set("thickness", 1.0).set("solver.tolerance", 1e-12).converged();
        let whole = Run::file(&file).ranks(ranks);
        let whole = whole.set("load.point.force", "[\"1.25*x\", -2.5]").set("exact.contact.seam.force.value", 17.5).converged();
        for path in [
            "/contact/seam/force",
            "/contact/seam/resultant/1",
            "/contact/seam/moment",
            "/support/table/reaction/1",
            "/energy/total",
            "/energy/strain/upper",
            "/energy/external_work",
        ] {
            close(whole.number(path) / 2.5, one.number(path), one.number(path).abs(), path);
        }
        let path = "/contact/seam/pressure_max";
        close(whole.number(path), one.number(path), one.number(path), path);
    }
    for value in ["0", "-1", "\"thin\"", "inf"] {
        let (code, _, errors) = mezha(None, &["check", &file.display().to_string(), "--set", &format!("thickness={value}")]);
        assert!(code == Some(2) && errors.contains("thickness = "), "{value}: {errors}");
    }
}

/// A block that is pressed down bulges into the one beside it: without a contact there it passes through, which is told.
#[test]
fn bodies_that_pass_through_each_other_without_a_contact_are_told() {
    let block = |cells: usize, from: f64| grid(cells, 5, cells as u64, move |u, v| [from + u, v]);
    let bodies =
        vec![("a", block(5, 0.0), ["a.bottom", "a.right", "a.top", ""]), ("c", block(4, 1.02), ["", "c.right", "", "c.left"])];
    let case = r#"
mesh = { file = "mesh.msh", refine = 1 }
body = { a = { young = 10.0, poisson = 0.3 }, c = { young = 10.0, poisson = 0.3 } }
support.a = { on = "a.bottom", ux = 0.0, uy = 0.0 }
support.c = { on = "c.right", ux = 0.0, uy = 0.0 }
load.a = { on = "a.top", pressure = 1.5 }
"#;
    let folder = tempfile::tempdir().expect("a folder");
    let file = write_scene(folder.path(), &Mesh { bodies }.text(), case);
    let words = "warning: \"a.right\" and \"c.left\" are in no contact, and lie in each other by ";
    for ranks in [1, 2] {
        let told = |set: Option<(&str, &str)>| {
            let run = set.into_iter().fold(Run::file(&file).ranks(ranks), |run, (key, value)| run.set(key, value));
            run.converged().errors.contains(words)
        };
        assert!(told(None), "{ranks} ranks");
        assert!(!told(Some(("load.a.pressure", "0.3"))), "the gap stays open");
        assert!(!told(Some(("contact.sides", "{ between = [\"a.right\", \"c.left\"] }"))), "they are in contact");
    }
}
