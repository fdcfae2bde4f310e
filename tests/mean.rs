//! Bodies whose mean motion is held: the mean is what was asked for, and what holds it carries nothing where the loads balance.

use crate::support::mesh::{Block, Mesh, grid, two_blocks, write_scene};
use crate::support::{Ended, RANKS, Run, close, mezha, numbers, with_both_orders};
use std::f64::consts::PI;

const EXACT: f64 = 1e-9;

fn carries_nothing(ended: &Ended, support: &str, size: f64, words: &str) {
    let [x, y] = numbers(ended, &format!("/support/{support}/reaction"));
    let moment = ended.number(&format!("/support/{support}/moment"));
    [x, y, moment].iter().for_each(|force| close(*force, 0.0, size, &format!("{words}: {support}")));
    assert!(!ended.errors.contains("is driven by"), "{words}: {}", ended.errors);
}

const BAR: &str = r#"
mesh = { file = "mesh.msh", refine = 2 }
body.bar = { young = 200.0, poisson = 0.3 }
load.left = { on = "left", traction = [-10.0, 0.0] }
load.right = { on = "right", traction = [10.0, 0.0] }
support.still = { body = "bar", mean = true, ux = 0.5, uy = -0.25, angle = 1e-3 }
probe.corner = { point = [2.0, 1.0], body = "bar" }
solver.tolerance = 1e-13
"#;

fn bar() -> Mesh {
    Mesh { bodies: vec![("bar", grid(5, 3, 11, |u, v| [2.0 * u, v]), ["bottom", "right", "top", "left"])] }
}

#[test]
fn a_bar_stretches_evenly_about_the_mean_motion_that_is_asked_for() {
    with_both_orders(&bar(), BAR, |words, ended| {
        let (e, nu) = (200.0, 0.3);
        let [along, across] = [10.0 * (1.0 - nu * nu) / e, -10.0 * nu * (1.0 + nu) / e];
        let u = numbers(&ended, "/probe/corner/u");
        close(u[0], 0.5 + along - 1e-3 * 0.5, 0.5, words);
        close(u[1], -0.25 + 0.5 * across + 1e-3, 0.5, words);
        close(ended.number("/probe/corner/stress/0"), 10.0, 10.0, words);
        carries_nothing(&ended, "still", 10.0, words);
        assert!(ended.number("/balance/bodies") < EXACT && ended.number("/balance/energy") < EXACT, "{words}");
    });
}

/// No contact knows of the held means. Where the load acted at a point of the body that is held while the system is solved, the
/// energy was 2.5 times as large (P1), and grew with every refinement.
#[test]
fn a_mean_without_contact_balances_a_load_by_a_force_all_over_the_body() {
    let pulled = BAR.replace("load.left = { on = \"left\", traction = [-10.0, 0.0] }", "");
    with_both_orders(&bar(), &pulled, |words, ended| {
        // σ = 5 x along the bar alone: quadratic displacements.
        let energy = (1.0 - 0.3 * 0.3) / (2.0 * 200.0) * 25.0 * 8.0 / 3.0;
        let size = energy * if words.starts_with("P2") { 1.0 } else { 0.02 / EXACT };
        close(ended.number("/energy/strain/bar"), energy, size, words);
        close(numbers(&ended, "/support/still/reaction")[0], -10.0, 10.0, words);
        assert!(ended.errors.contains("like a weight, all over it"), "{words}: {}", ended.errors);
    });
}

const BLOCKS: &str = r#"
mesh = { file = "mesh.msh", refine = 1 }
body.lower = { young = 7000.0, poisson = 0.227 }
body.upper = { young = 3000.0, poisson = 0.3 }
support.table = { on = "bottom", uy = 0.0 }
support.below = { body = "lower", mean = true, ux = 0.0 }
support.above = { body = "upper", mean = true, ux = 0.01 }
load.top = { on = "top", pressure = 3.0 }
contact.seam = { between = ["lower.seam", "upper.seam"], curve = "line", gap = "closed" }
probe.lower = { point = [1.0, 0.5], body = "lower" }
probe.upper = { point = [1.0, 1.5], body = "upper" }
solver.tolerance = 1e-12
"#;

fn blocks() -> Mesh {
    two_blocks([(5, 3, 11), (6, 3, 12)])
}

#[test]
fn blocks_whose_mean_shift_is_held_press_evenly() {
    with_both_orders(&blocks(), BLOCKS, |words, ended| {
        ended.trace("seam").iter().for_each(|point| close(point.lambda, 3.0, 3.0, words));
        carries_nothing(&ended, "below", 6.0, words);
        carries_nothing(&ended, "above", 6.0, words);
        // The middle of an evenly strained body moves as its mean does.
        close(numbers(&ended, "/probe/lower/u")[0], 0.0, 1e-2, words);
        close(numbers(&ended, "/probe/upper/u")[0], 0.01, 1e-2, words);
        assert!(["force", "bodies", "energy"].iter().all(|key| ended.number(&format!("/balance/{key}")) < EXACT), "{words}");
    });
}

/// Bodies that slide along each other where they end have another length in common: what presses is off by that.
#[test]
fn blocks_that_slide_by_a_twentieth_of_their_width_are_not_trusted() {
    with_both_orders(&blocks(), &BLOCKS.replace("ux = 0.01", "ux = 0.1"), |words, ended| {
        for share in ["slip_at_ends", "lost_at_ends"].map(|key| ended.number(&format!("/contact/seam/{key}"))) {
            assert!((share - 0.05).abs() < 1e-3, "{words}: {share}");
        }
        for trust in ["trust", "trust_force"] {
            assert_eq!(ended.value(&format!("/contact/seam/{trust}")), false, "{words}");
        }
        assert!(ended.errors.contains("sliding takes 0.050 of the contact"), "{words}: {}", ended.errors);
    });
}

/// A body that is held by its mean alone comes down through an open gap, flat or not, turned or not, onto another.
#[test]
fn a_mean_motion_closes_a_gap() {
    let pressed = |gap: &str, above: &str| {
        BLOCKS
            .replace("load.top = { on = \"top\", pressure = 3.0 }\n", "")
            .replace("refine = 1", "refine = 2")
            .replace("gap = \"closed\"", &format!("gap = {gap}"))
            .replace("ux = 0.01", above)
    };
    let force = |gap: &str, above: &str, ranks: usize| {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let file = write_scene(folder.path(), &blocks().text(), &pressed(gap, above));
        Run::file(&file).ranks(ranks).converged().number("/contact/seam/force")
    };
    for ranks in [1, 2] {
        let closed = force("\"closed\"", "ux = 0.0, angle = 0.0, uy = -0.002", ranks);
        let open = force("0.01", "ux = 0.0, angle = 0.0, uy = -0.012", ranks);
        assert!((open / closed - 1.0).abs() < 1e-6, "{ranks} ranks: {open} instead of {closed}");
        let uneven = force("\"0.01 + 0.001*(x - 1)^2\"", "ux = 0.0, angle = 0.0, uy = -0.012", ranks);
        assert!(uneven > 0.3 * closed && uneven < closed, "{ranks} ranks: {uneven} beside {closed}");
    }
}

/// A wall holds the turn that a mean hold is to hold, so that the body may fall: nothing that would carry its load is a result.
#[test]
fn a_mean_turn_that_contact_holds_already_leaves_no_result() {
    let block = |x: f64, y: f64, seed: u64| grid(3, 3, seed, move |u, v| [x + u, y + v]);
    let mesh = Mesh {
        bodies: vec![
            ("base", block(0.0, -1.05, 1), ["table", "", "base.top", ""]),
            ("block", block(0.0, 0.0, 2), ["block.bottom", "side", "block.top", "block.left"]),
            ("wall", block(-1.0, 0.0, 3), ["", "wall.right", "", "wall.left"]),
        ],
    };
    let case = "mesh = { file = \"mesh.msh\", refine = 2 }
         support.table = { on = [\"table\", \"wall.left\"], ux = 0.0, uy = 0.0 }
         support.turn = { body = \"block\", mean = true, angle = 0.0 }
         load.down = { on = \"block.top\", pressure = 10.0 }
         load.side = { on = \"side\", pressure = 5.0 }
         contact.below = { between = [\"base.top\", \"block.bottom\"], curve = \"line\", gap = \"geometry\" }
         contact.beside = { between = [\"wall.right\", \"block.left\"], curve = \"line\" }
         body.base = { young = 1000.0, poisson = 0.3 }
         body.block = { young = 1000.0, poisson = 0.3 }
         body.wall = { young = 1000.0, poisson = 0.3 }\n";
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = write_scene(folder.path(), &mesh.text(), case);
    for ranks in [1, 2] {
        let ended = Run::file(&file).ranks(ranks).ended();
        let force = ended.number("/contact/below/force");
        let is_right = (force - 10.0).abs() < 1e-3;
        assert!(ended.code == Some(3) || ended.code == Some(0) && is_right, "{force}: {}", ended.said());
        assert!(is_right || ended.value("/contact/below/trust") == false, "{}", ended.said());
    }
}

/// A load that a mean motion carries is told, with what to hold instead: what `check` proposes without that support, and a place where
/// contact cannot carry it; the sides of the block are named together with those of the other one.
#[test]
fn a_loaded_body_is_told_to_let_contact_carry_its_load() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let write = |case: &str| write_scene(folder.path(), &blocks().text(), case);
    let ended = Run::file(&write(&BLOCKS.replace("ux = 0.01 }", "ux = 0.0, uy = -0.002, angle = 0.0 }"))).converged();
    let said = "support above: the mean motion that it holds is driven by a force of (0, -";
    let remedy = "leave this support out and hold what `mezha check` then proposes, of a pin in a hole angle = 0.0 alone; where contact cannot, hold a place of the body";
    assert!(ended.errors.contains(said) && ended.errors.contains(remedy), "{}", ended.said());
    // What it proposes carries nothing.
    let without: String =
        BLOCKS.lines().filter(|line| !line.starts_with("support.above")).map(|line| format!("{line}\n")).collect();
    let (code, output, errors) = mezha(None, &["check", &write(&without).display().to_string()]);
    let proposed = "[support.upper-still]\nbody = \"upper\"   # its mean motion: a hold that carries nothing where loads balance\nmean = true\nux = 0.0\n";
    assert!(code == Some(3) && output.contains(proposed), "{output}{errors}");
    let ended = Run::file(&write(&format!("{without}\n{proposed}"))).converged();
    close(ended.number("/contact/seam/force"), 6.0, 6.0, "contact carries it");
    assert!(!ended.errors.contains("is driven by"), "{}", ended.errors);
}

/// A disc of a pile that is kept from moving aside, too, takes the load off its neighbours: no force is trusted that is another one without
/// that hold, and all others are. Without it all are.
#[test]
fn a_hold_that_takes_the_load_off_contact_leaves_no_force_trusted_that_it_changes() {
    for ranks in [1, 2] {
        let pile = || Run::case("packing/groove.toml").ranks(ranks).set("exact.must_hold", false).set("output.fields", false);
        let (free, held) = (pile().converged(), pile().set("support.disc04.ux", 0.0).converged());
        let force = |ended: &Ended, contact: &str| ended.number(&format!("/contact/{contact}/force"));
        let all = free.value("/contact").as_object().expect("contacts").clone();
        let changes = |contact: &&String| (force(&held, contact) / force(&free, contact) - 1.0).abs() > 0.01;
        assert_eq!((all.len(), all.keys().filter(changes).count()), (14, 6));
        for contact in all.keys() {
            let is_taken = changes(&contact);
            assert_eq!(held.number(&format!("/contact/{contact}/held_force")) > 0.01, is_taken, "{contact}");
            for (ended, is_trusted) in [(&free, true), (&held, !is_taken)] {
                assert_eq!(ended.value(&format!("/contact/{contact}/trust_force")), is_trusted, "{contact}: {}", ended.said());
            }
        }
        let told = |ended: &Ended| ended.errors.contains("hold of these bodies no more than `mezha check` proposes");
        assert_eq!([told(&free), told(&held)], [false, true], "{}", held.said());
    }
}

/// The contact line is inclined: it resists the shift that is held, and a force along the line drives the upper block.
#[test]
fn a_mean_motion_that_contact_resists_is_as_asked_and_its_force_is_told() {
    let (sin, cos) = 30f64.to_radians().sin_cos();
    let turned = |mesh: Mesh| mesh.map(move |[x, y]| [cos * x - sin * y, sin * x + cos * y]);
    let case = BLOCKS
        .replace("support.table = { on = \"bottom\", uy = 0.0 }", "support.table = { on = \"bottom\", ux = 0.0, uy = 0.0 }")
        .replace("support.below = { body = \"lower\", mean = true, ux = 0.0 }\n", "")
        .replace("pressure = 3.0", "traction = [0.0, -3.0]")
        .replace("ux = 0.01 }", "ux = 0.01, angle = 0.0 }")
        .replace("[1.0, 0.5]", "[0.6, 0.9]")
        .replace("[1.0, 1.5]", "[0.2, 1.8]");
    with_both_orders(&turned(blocks()), &case, |words, ended| {
        // Two forces hold the block: that of the contact along its normal, and that of the hold along x.
        let force = ended.number("/contact/seam/force");
        close(force * cos, 6.0, 6.0, words);
        let reaction = numbers(&ended, "/support/above/reaction");
        close(reaction[0], force * sin, 6.0, words);
        let said = "support above: the mean motion that it holds is driven by a force of (3.464, 0) and a moment of ";
        let remedy = "to let contact carry that, leave this support out";
        assert!(ended.errors.contains(said) && ended.errors.contains(remedy), "{words}: {}", ended.errors);
        assert!(ended.number("/balance/bodies") < EXACT, "{words}");
    });
}

/// Shifts in any two directions are those along the axes: 0.5 along x, and 0.6 · 0.5 - 0.8 · 0.25 along (3, 4)/5. Around a centre
/// under the middle (1, 1/2) of the bar a shift to the left is one along x.
#[test]
fn a_bar_is_held_along_any_direction_and_around_a_centre() {
    let held = |shifts: &str| BAR.replace("ux = 0.5, uy = -0.25", shifts);
    for shifts in [
        "ux = 0.5, direction = [30, 40], along = 0.1",
        "about = [1, -3], tangential = -0.5, direction = [-3, -4], along = -0.1",
        "about = [5, 0.5], tangential = 0.25, ux = 0.5",
    ] {
        with_both_orders(&bar(), &held(shifts), |words, ended| {
            let (e, nu) = (200.0, 0.3);
            let [along, across] = [10.0 * (1.0 - nu * nu) / e, -10.0 * nu * (1.0 + nu) / e];
            let u = numbers(&ended, "/probe/corner/u");
            close(u[0], 0.5 + along - 1e-3 * 0.5, 0.5, &format!("{shifts}, {words}"));
            close(u[1], -0.25 + 0.5 * across + 1e-3, 0.5, &format!("{shifts}, {words}"));
            carries_nothing(&ended, "still", 10.0, words);
        });
    }
}

/// A heavy block on an incline, held along it: contact has the part of the weight across, the hold the part along, like a weight
/// itself, so that the block does not turn.
#[test]
fn a_weight_on_an_incline_is_held_along_it() {
    let (sin, cos) = 30f64.to_radians().sin_cos();
    let turned = |mesh: Mesh| mesh.map(move |[x, y]| [cos * x - sin * y, sin * x + cos * y]);
    for weight in ["body_force = [0.0, -3.0]", "density = 0.3"] {
        let case = BLOCKS
            .replace("uy = 0.0 }\nsupport.below", "ux = 0.0, uy = 0.0 }\nsupport.below")
            .replace("support.below = { body = \"lower\", mean = true, ux = 0.0 }\n", "")
            .replace("load.top = { on = \"top\", pressure = 3.0 }\n", "")
            .replace("young = 3000.0, poisson = 0.3", &format!("young = 3000.0, poisson = 0.3, {weight}"))
            .replace("ux = 0.01 }", &format!("direction = [{cos}, {sin}], along = 0.01 }}"))
            .replace("[1.0, 0.5]", "[0.6, 0.9]")
            .replace("[1.0, 1.5]", "[0.2, 1.8]");
        let case = if weight.starts_with("density") { format!("gravity.g = [0.0, -10.0]\n{case}") } else { case };
        with_both_orders(&turned(blocks()), &case, |words, ended| {
            close(ended.number("/contact/seam/force"), 6.0 * cos, 6.0, words);
            let [x, y] = numbers(&ended, "/support/above/reaction");
            close(x, 6.0 * sin * cos, 6.0, words);
            close(y, 6.0 * sin * sin, 6.0, words);
            close(ended.number("/support/above/moment"), 0.0, 6.0, words);
            assert!(ended.number("/balance/bodies") < EXACT, "{words}");
        });
    }
}

/// Rings that nothing but their means keeps from turning.
#[test]
fn rings_that_may_turn_are_held_by_their_mean_turn() {
    for ranks in [1, 2] {
        let held =
            Run::case("rings_full").set("support.shaft", "{ body = \"inner\", mean = true, ux = 0.0, uy = 0.0, angle = 0.0 }");
        let held = held.set("support.housing", "{ body = \"outer\", mean = true, angle = 0.0 }");
        let ended =
            held.set("exact.must_hold", false).set("mesh.refine", 3).set("solver.tolerance", 1e-12).ranks(ranks).converged();
        carries_nothing(&ended, "shaft", 60.0, "inner");
        carries_nothing(&ended, "housing", 60.0, "outer");
        let pressures: Vec<f64> = ended.trace("seam").iter().map(|point| point.lambda).collect();
        // Lamé: interference over the radial compliances of both rings at the seam, with free bore and rim.
        let (e, nu) = (7000.0, 0.3);
        let grow = |c: f64, a: f64| (1.0 + nu) / e * ((1.0 - 2.0 * nu) * a * 2.0 + c / 2.0);
        let inner = grow(1.0 * 4.0 / 3.0, 4.0 / 3.0);
        let outer = grow(4.0 * 9.0 / 5.0, 4.0 / 5.0);
        let exact = 1e-3 / (inner + outer);
        pressures.iter().for_each(|p| assert!((p / exact - 1.0).abs() < 3e-4, "{p} instead of {exact}"));
    }
}

/// A ring around a point, with so many edges around; its sides are the rim and the bore.
fn ring(edges: usize, middle: f64, [bore, rim]: [f64; 2]) -> Block {
    let around = |k: usize| 2.0 * PI * (k % edges) as f64 / edges as f64;
    let point = |r: f64, k: usize| [middle + r * around(k).cos(), r * around(k).sin()];
    let points =
        [bore, 0.5 * (bore + rim), rim].into_iter().flat_map(|r| (0..edges).map(move |k| (r, k))).map(|(r, k)| point(r, k));
    let at = |j: usize, k: usize| j * edges + k % edges;
    let quadrangles = (0..2).flat_map(|j| (0..edges).map(move |k| (j, k)));
    let cut = |(j, k)| [[at(j, k), at(j + 1, k), at(j + 1, k + 1)], [at(j, k), at(j + 1, k + 1), at(j, k + 1)]];
    let side = |j: usize| (0..edges).map(|k| [at(j, k), at(j, k + 1)]).collect();
    Block { points: points.collect(), triangles: quadrangles.flat_map(cut).collect(), sides: [side(2), side(0), vec![], vec![]] }
}

/// So many rings, shrunk into others that are held at their rims, and a case that holds their turns. They are as high as they are
/// wide, or by a factor less: then contact resists turns.
fn shrunk_rings(count: usize, height: f64) -> (Mesh, String) {
    let mut case = String::from("mesh = { file = \"mesh.msh\", refine = 1 }\nsolver.tolerance = 1e-10\n");
    let mut bodies = Vec::new();
    let name = |words: String| -> &'static str { words.leak() };
    for k in 0..count {
        let middle = 7.0 * k as f64;
        case += &format!(
            "body.in{k} = {{ young = 7000.0, poisson = 0.3 }}
             body.out{k} = {{ young = 7000.0, poisson = 0.3 }}
             geometry.seam{k} = {{ curves = [\"in{k}.rim\", \"out{k}.bore\"], x = \"{middle} + 2*cos(t)\", y = \"2*{height}*sin(t)\", t = [0, 6.283185307179586] }}
             contact.seam{k} = {{ between = [\"in{k}.rim\", \"out{k}.bore\"], curve = \"geometry\", gap = \"-1e-3*(1 + 0.3*(x - {middle}))\" }}
             support.out{k} = {{ on = \"out{k}.rim\", ux = 0.0, uy = 0.0 }}
             support.in{k} = {{ body = \"in{k}\", mean = true, angle = 0.0 }}\n"
        );
        let flattened = |mut block: Block| {
            block.points.iter_mut().for_each(|point| point[1] *= height);
            block
        };
        let inner = flattened(ring(9, middle, [1.0, 2.0]));
        bodies.push((name(format!("in{k}")), inner, [name(format!("in{k}.rim")), "", "", ""]));
        let outer = flattened(ring(11, middle, [2.0, 3.0]));
        bodies.push((name(format!("out{k}")), outer, [name(format!("out{k}.rim")), name(format!("out{k}.bore")), "", ""]));
    }
    (Mesh { bodies }, case)
}

#[test]
fn many_held_turns_take_no_more_iterations_than_one() {
    many_take_no_more_iterations_than_one(1.0, 100);
}

/// Contact resists them: where only eight are told to the preconditioner, sixty take 30 iterations instead of 23.
#[test]
fn many_held_turns_of_bodies_that_are_not_round_take_no_more_iterations_than_one() {
    many_take_no_more_iterations_than_one(0.8, 60);
}

fn many_take_no_more_iterations_than_one(height: f64, many: usize) {
    let ended = |count: usize, ranks: usize, solver: &str| {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let (mesh, case) = shrunk_rings(count, height);
        let file = write_scene(folder.path(), &mesh.text(), &case);
        Run::file(&file).set("solver.name", solver).set("output.fields", false).ranks(ranks).converged()
    };
    let most = |ended: &Ended| {
        let iterations = ended.value("/solver/iterations");
        iterations.as_array().expect("a list").iter().filter_map(serde_json::Value::as_u64).max().expect("a solve")
    };
    let one = ended(1, 1, "fieldsplit");
    let (iterations, energy) = (most(&one), one.number("/energy/total"));
    for (count, ranks, solver) in
        [(10, 1, "direct"), (many, 2, "fieldsplit")].into_iter().chain(RANKS.map(|n| (10, n, "fieldsplit")))
    {
        let many = ended(count, ranks, solver);
        let words = format!("{count} rings on {ranks} ranks, {solver}");
        close(many.number("/energy/total") / count as f64, energy, energy, &words);
        assert!(most(&many) <= iterations + 3, "{words}: {} iterations instead of {iterations}", most(&many));
    }
}

#[test]
fn a_mean_motion_adapts() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let case = BLOCKS.replace("refine = 1", "refine = 0").replace("pressure = 3.0", "pressure = \"exp(2*x)\"");
    let file = write_scene(folder.path(), &blocks().text(), &format!("accuracy = 4e-3\n{case}"));
    let energies = [1, 2].map(|ranks| {
        let ended = Run::file(&file).ranks(ranks).converged();
        carries_nothing(&ended, "above", 1e2, "adapted");
        assert!(ended.value("/accuracy").as_array().is_some_and(|meshes| meshes.len() > 1), "it adapts");
        ended.number("/energy/total")
    });
    assert!((energies[1] / energies[0] - 1.0).abs() < 1e-8, "{energies:?}");
}

#[test]
fn mistakes_are_told() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = write_scene(folder.path(), &blocks().text(), BLOCKS).display().to_string();
    for (value, words) in [
        ("{ body = \"upper\", mean = true }", "support.above: holds no mean motion; give uy = 0.0; in the plane ux, angle,"),
        (
            "{ body = \"uper\", mean = true, ux = 0.0 }",
            "support.above.body = \"uper\" (--set): no such body; did you mean \"upper\"?",
        ),
        ("{ mean = true, ux = 0.0 }", "support.above.body: missing"),
        ("{ body = \"upper\", mean = true, ux = \"x\" }", "support.above.ux"),
        (
            "{ body = \"upper\", mean = true, angle = 5.0 }",
            "support.above.angle = 5.0 (--set): must be a number from -0.1 to 0.1: radians",
        ),
        (
            "{ body = \"upper\", mean = false, ux = 0.0 }",
            "support.above.mean = false (--set): holds a mean motion only as mean = true",
        ),
        (
            "{ body = \"upper\", mean = true, on = \"top\", ux = 0.0 }",
            "support.above.on = \"top\" (--set): stands beside mean = true",
        ),
        (
            "{ body = \"upper\", mean = true, ux = 0.0, direction = [2, 0], along = 0.0 }",
            "support.above: ux and along hold one shift of \"upper\" twice; leave one of them out",
        ),
        (
            "{ body = \"upper\", mean = true, ux = 0.0, about = [1, 0], tangential = 0.0 }",
            "support.above: ux and tangential hold one shift of \"upper\" twice",
        ),
        (
            "{ body = \"upper\", mean = true, ux = 0.0, uy = 0.0, direction = [1, 1], along = 0.0 }",
            "ux, uy and along are three shifts of \"upper\", of which two tell the third",
        ),
        (
            "{ body = \"upper\", mean = true, along = 0.0 }",
            "support.above.along = 0.0 (--set): wants a way; give direction = [x, y]",
        ),
        ("{ body = \"upper\", mean = true, ux = 0.0, about = [0, 0] }", "holds nothing by itself; give tangential = 0.0"),
        ("{ body = \"upper\", mean = true, direction = [0, 0], along = 0.0 }", "must point somewhere"),
        ("{ body = \"upper\", mean = true, about = [1, 1.5], tangential = 0.0 }", "it goes around nothing; give angle"),
        ("{ on = \"top\", along = 0.0, direction = [0, 1], ux = 0.0 }", "support.above.along"),
        ("{ body = \"lower\", mean = true, ux = 0.0 }", "support.below holds a mean motion of this body, too"),
        ("{ body = \"lower\", mean = true, uy = 0.0 }", "holds a mean motion of this body, too"),
    ] {
        let (code, output, errors) = mezha(None, &["check", &file, "--set", &format!("support.above={value}")]);
        assert!(code == Some(2) && errors.contains(words), "{value}: {code:?} {output}{errors}");
    }
    let (code, output, errors) = mezha(None, &["check", &file, "--set", "support.below.uy=0.0"]);
    assert!(code == Some(2) && errors.contains("uy of \"lower\" is held at (0, 0) by support.table, too"), "{output}{errors}");
    // A plate holds nothing by itself, and what it moves is held by its own keys.
    let plate = "load.top={ on = \"top\", rigid = true, force = [0.0, -6.0] }";
    let (code, output, errors) = mezha(None, &["check", &file, "--set", plate]);
    assert!(code == Some(2) && errors.contains("load.top moves \"upper\" as a plate"), "{output}{errors}");
}

/// What a plate moves, and nothing holds, is to be held by the plate: a support of a point on it would be refused.
#[test]
fn no_support_is_proposed_for_what_a_plate_moves() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let case = BLOCKS.replace("support.above = { body = \"upper\", mean = true, ux = 0.01 }\n", "");
    let case = case.replace("pressure = 3.0", "rigid = true, force = [0.0, -6.0]");
    let file = write_scene(folder.path(), &blocks().text(), &case).display().to_string();
    let (code, output, errors) = mezha(None, &["check", &file]);
    assert!(code == Some(3) && errors.contains("prescribe ux, uy or angle of load.top"), "{output}{errors}");
    assert!(!output.contains("[support."), "{output}");
    let (code, output, errors) = mezha(None, &["check", &file, "--set", "load.top.ux=0.0"]);
    assert!(code == Some(0), "{output}{errors}");
}
