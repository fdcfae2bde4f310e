//! Active sets that are hard to find, and contact that the multipliers do not see.

use crate::support::mesh::{Block, Mesh, grid, write_scene};
use crate::support::{Ended, Run, ranks_in_turn};
use std::f64::consts::PI;

/// A rectangle with its lower left corner at `(x, y)`.
fn rectangle([x, y]: [f64; 2], [width, height]: [f64; 2], cells: [usize; 2], seed: u64) -> Block {
    grid(cells[0], cells[1], seed, |u, v| [x + width * u, y + height * v])
}

fn passes(ended: &Ended) -> usize {
    ended.value("/outer").as_array().expect("a list").len()
}

/// A leaf spring, clamped on the left, bent by a force F on its tip onto a stiff seat with the curvature c: a beam lies on the
/// seat up to where F(L - a) = EI c, carries no load there, and presses with F at a. Lengths and moduli by factors.
fn leaf(length: f64, modulus: f64) -> (Mesh, String, f64) {
    let [span, depth, young, radius] = [100.0 * length, 2.0 * length, 210_000.0 * modulus, 2500.0 * length];
    let seat = rectangle([0.0, -20.0 * length], [span, 20.0 * length], [40, 4], 1);
    let leaf = rectangle([0.0, 0.0], [span, depth], [50, 1], 2);
    let mesh =
        Mesh { bodies: vec![("seat", seat, ["base", "", "seat.top", ""]), ("leaf", leaf, ["leaf.bottom", "tip", "", "wall"])] };
    let bending = young / (1.0 - 0.09) * depth.powi(3) / 12.0;
    let force = bending / radius / (0.5 * span);
    let case = format!(
        "mesh = {{ file = \"mesh.msh\", refine = 1, order = 2 }}
         body.seat = {{ young = {:?}, poisson = 0.3 }}
         body.leaf = {{ young = {young:?}, poisson = 0.3 }}
         support.base = {{ on = [\"base\", \"wall\"], ux = 0.0, uy = 0.0 }}
         load.tip = {{ on = \"tip\", traction = [0.0, {:?}] }}
         contact.c = {{ between = [\"seat.top\", \"leaf.bottom\"], curve = \"line\", gap = \"x^2/{:?}\" }}",
        100.0 * young,
        -force / depth,
        2.0 * radius
    );
    (mesh, case, force)
}

/// Force on the contact line beyond a fifth of its length, and the mean place where it acts, as a share of it. Before, the
/// clamped end keeps its thickness, which the bent leaf does not: it presses there, which no beam knows.
fn beyond_the_clamp(ended: &Ended) -> [f64; 2] {
    let length = ended.number("/contact/c/length");
    let points = ended.trace("c");
    let mut sums = [0.0; 2];
    for ends in points.windows(2).filter(|ends| ends[0].s > 0.2 * length) {
        let part = 0.5 * (ends[0].lambda + ends[1].lambda) * (ends[1].s - ends[0].s);
        sums[0] += part;
        sums[1] += part * ends[0].s / length;
    }
    [sums[0], sums[1] / sums[0]]
}

#[test]
fn a_leaf_spring_rolls_onto_its_seat_in_any_unit_space_and_number_of_ranks() {
    for (length, modulus) in [(1.0, 1.0), (1e-3, 1e6)] {
        let (mesh, case, force) = leaf(length, modulus);
        let folder = tempfile::tempdir().expect("a temporary folder");
        let file = write_scene(folder.path(), &mesh.text(), &case);
        for (at, space) in ["p0", "p1-discontinuous", "p1-continuous"].into_iter().enumerate() {
            let found = ranks_in_turn(at).into_iter().map(|ranks| {
                let run = Run::file(&file).ranks(ranks).set("contact.c.multiplier", space).set("output.fields", false);
                // A slender leaf bends much under a small residual: at 1e-8 the force is known to four digits.
                let ended = run.set("solver.tolerance", "1e-11").solved();
                let [found, place] = beyond_the_clamp(&ended);
                let words = format!("{space}, lengths by {length:e}, {ranks} ranks: force {}, at {place}", found / force);
                assert!(passes(&ended) <= 40, "{words}, {} passes", passes(&ended));
                assert!((found / force - 1.0).abs() < 0.05 && (place - 0.5).abs() < 0.03, "{words}");
                ended.number("/contact/c/force")
            });
            let found: Vec<f64> = found.collect();
            assert!(found.iter().all(|force| (force / found[0] - 1.0).abs() < 1e-4), "{space}: {found:?}");
        }
    }
}

/// A finer mesh begins with the active set of the coarser one, which is nearly its own: contact on two fifths of the line.
#[test]
fn a_finer_mesh_begins_with_the_set_of_the_coarser_one() {
    for space in ["p0", "p1-discontinuous", "p1-continuous"] {
        let run = Run::case("open_zone").set("contact.seam.multiplier", space).set("mesh.refine", 2);
        let ended = run.set("exact.must_hold", false).set("output.fields", false).converged();
        let active = |pass: usize| ended.number(&format!("/outer/{pass}/active"));
        let (first, last) = (active(0), active(passes(&ended) - 1));
        assert!((first - last).abs() <= 2.0, "{space}: {first} active multipliers at first, {last} at the end");
        assert!(last < 0.5 * ended.number("/unknowns/multiplier"), "{space}: {last}");
    }
}

/// Two columns of two blocks. One is pressed together; the other is squeezed from the side, and its lid is lifted by just what it
/// grows: it touches all along without any pressure, and what solves leave would open and close it for ever.
#[test]
fn contact_that_touches_without_pressure_comes_to_rest() {
    let column = |x: f64, y: f64, cells: usize, seed: u64| rectangle([x, y], [1.0, 1.0], [cells, cells], seed);
    let mesh = Mesh {
        bodies: vec![
            ("a", column(0.0, 0.0, 3, 1), ["table", "", "a.top", "wall"]),
            ("b", column(0.0, 1.0, 4, 2), ["b.bottom", "", "top", "wall"]),
            ("c", column(2.0, 0.0, 3, 3), ["table", "side", "c.top", "wall"]),
            ("d", column(2.0, 1.0, 4, 4), ["d.bottom", "side", "lid", "wall"]),
        ],
    };
    let (young, poisson) = (1000.0, 0.3);
    let lift = 2.0 * poisson * (1.0 + poisson) / young;
    let mut case = format!(
        "mesh = {{ file = \"mesh.msh\", refine = 2, order = 2 }}
         support = {{ table = {{ on = \"table\", uy = 0.0 }}, wall = {{ on = \"wall\", ux = 0.0 }}, lid = {{ on = \"lid\", uy = {lift:?} }} }}
         load = {{ top = {{ on = \"top\", pressure = 1.0 }}, side = {{ on = \"side\", pressure = 1.0 }} }}
         contact.pressed = {{ between = [\"a.top\", \"b.bottom\"], curve = \"line\" }}
         contact.touching = {{ between = [\"c.top\", \"d.bottom\"], curve = \"line\" }}\n"
    );
    ["a", "b", "c", "d"]
        .iter()
        .for_each(|name| case += &format!("body.{name} = {{ young = {young:?}, poisson = {poisson:?} }}\n"));
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = write_scene(folder.path(), &mesh.text(), &case);
    for space in ["p0", "p1-discontinuous", "p1-continuous"] {
        for ranks in ranks_in_turn(0) {
            let ended =
                Run::file(&file).ranks(ranks).set("contact.touching.multiplier", space).set("output.fields", false).converged();
            let [pressed, touching] = ["pressed", "touching"].map(|name| ended.number(&format!("/contact/{name}/force")));
            assert!((pressed - 1.0).abs() < 1e-6 && touching.abs() < 1e-5, "{space}, {ranks} ranks: {pressed} and {touching}");
            assert!(passes(&ended) <= 3, "{space}, {ranks} ranks: {} passes", passes(&ended));
        }
    }
}

/// A block comes down by just the gap below it, or both blocks are moved alike: they touch, and press by rounding alone.
#[test]
fn blocks_that_are_moved_until_they_touch_come_to_rest() {
    let block = |y: f64, cells: usize, seed: u64| rectangle([0.0, y], [1.0, 1.0], [cells, cells], seed);
    let mesh = Mesh {
        bodies: vec![
            ("base", block(0.0, 4, 1), ["bottom", "", "base.top", ""]),
            ("block", block(1.0, 5, 2), ["block.bottom", "", "top", ""]),
        ],
    };
    let folder = tempfile::tempdir().expect("a temporary folder");
    let case = "mesh = { file = \"mesh.msh\", refine = 2, order = 2 }
         body.base = { young = 1000.0, poisson = 0.3 }
         body.block = { young = 1000.0, poisson = 0.3 }
         support.bottom = { on = \"bottom\", ux = 0.0, uy = 0.0 }
         support.top = { on = \"top\", ux = 0.0, uy = -0.005 }
         contact.seam = { between = [\"base.top\", \"block.bottom\"], curve = \"line\", gap = 0.005 }\n";
    let file = write_scene(folder.path(), &mesh.text(), case);
    for ranks in [1, 2] {
        let come_down = Run::file(&file).ranks(ranks);
        let moved =
            |by: f64| come_down.clone().set("support.bottom.uy", by).set("support.top.uy", by).set("contact.seam.gap", "closed");
        for run in [come_down.clone(), moved(1e-6), moved(1e-3), moved(0.3)] {
            let ended = run.set("output.fields", false).converged();
            let force = ended.number("/contact/seam/force");
            assert!(force.abs() < 1e-6, "{ranks} ranks: {force}");
        }
    }
}

/// A start that is far off is looked at after a solve that is as loose as any may be, and no looser.
#[test]
fn a_contact_far_narrower_than_an_edge_on_far_too_many_segments_ends_in_order() {
    let ended = Run::file(std::path::Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/cases/hard/bars.toml")))
        .set("mesh.order", 2)
        .set("contact.seam.multiplier", "p1-continuous")
        .set("contact.seam.gap", "(x - 3)^2/240")
        .set("contact.seam.segments", 768)
        .set("load.top.pressure", 0.01)
        .set("exact.must_hold", false)
        .set("output.fields", false)
        .ranks(2)
        .ended();
    assert!([Some(0), Some(3)].contains(&ended.code), "{}", ended.said());
    assert_ne!(ended.value("/contact/seam/trust"), true, "{}", ended.said());
}

/// A pin, smaller than its hole by a thousandth, lies in it under a load that strains it by a millionth.
#[test]
fn a_pin_under_a_light_load_stays_in_its_hole() {
    let (clearance, load, young) = (1e-3, 1e-6, 7000.0);
    let radius = 1.0 - clearance;
    let turn = |r: f64, v: f64| [r * (PI * (v - 0.5)).cos(), r * (PI * (v - 0.5)).sin()];
    let plate = grid(6, 14, 1, |u, v| turn(1.0 + 1.8 * u * u + 1.2 * u, v));
    let pin = grid(5, 12, 2, |u, v| {
        let [x, y] = turn(radius * (0.25 + 0.75 * u), v);
        [x, y - clearance]
    });
    let mesh = Mesh { bodies: vec![("plate", plate, ["cut", "far", "cut", "hole"]), ("pin", pin, ["cut", "rim", "cut", ""])] };
    let area = 0.5 * PI * radius * radius * (1.0 - 0.0625);
    let case = format!(
        "mesh = {{ file = \"mesh.msh\", refine = 1, order = 2 }}
         body.plate = {{ young = {young:?}, poisson = 0.3 }}
         body.pin = {{ young = {young:?}, poisson = 0.3, body_force = [0.0, {:?}] }}
         geometry.hole = {{ curves = [\"hole\"], circle = {{ centre = [0, 0], radius = 1 }} }}
         geometry.rim = {{ curves = [\"rim\"], circle = {{ centre = [0, {:?}], radius = {radius:?} }} }}
         support.cut = {{ on = \"cut\", ux = 0.0 }}
         support.far = {{ on = \"far\", ux = 0.0, uy = 0.0 }}
         contact.c = {{ between = [\"hole\", \"rim\"], curve = \"fit\", gap = \"geometry\" }}",
        -load * young / area,
        -clearance
    );
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = write_scene(folder.path(), &mesh.text(), &case);
    for ranks in [1, 3] {
        // It presses on less than an edge, which is said.
        let ended = Run::file(&file).ranks(ranks).set("output.fields", false).ended();
        assert!(ended.code == Some(0) || ended.value("/status") == "unresolved", "{}", ended.said());
        // It is so narrow that its pressure acts downwards.
        let found = ended.number("/contact/c/force") / (load * young);
        assert!((found - 1.0).abs() < 0.02, "{found}, {ranks} ranks");
    }
}

/// A round block, pressed onto a flat one, touches it on a tenth of a segment: the mean gap of every segment is open.
#[test]
fn contact_that_is_narrower_than_a_segment_is_not_passed_over_in_silence() {
    let lower = rectangle([0.0, 0.0], [2.0, 1.0], [12, 6], 1);
    let upper = rectangle([0.0, 1.0], [2.0, 1.0], [14, 7], 2);
    let mesh = Mesh {
        bodies: vec![("lower", lower, ["bottom", "", "lower.top", ""]), ("upper", upper, ["upper.bottom", "", "top", ""])],
    };
    let case = "
        mesh = { file = \"mesh.msh\", refine = 1 }
        body.lower = { young = 1000.0, poisson = 0.3 }
        body.upper = { young = 1000.0, poisson = 0.3 }
        support.bottom = { on = \"bottom\", ux = 0.0, uy = 0.0 }
        support.top = { on = \"top\", ux = 0.0, uy = -0.04 }
        contact.c = { between = [\"lower.top\", \"upper.bottom\"], curve = \"line\", gap = \"0.5*(x-1)^2\" }";
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = write_scene(folder.path(), &mesh.text(), case);
    let run = |segments: &str| Run::file(&file).set("contact.c.segments", segments).set("output.fields", false);
    let (few, auto) = (run("2").ended(), run("auto").converged());
    let force = auto.number("/contact/c/force");
    assert!(auto.number("/contact/c/unresolved_force") < 0.1 * force, "{force}");
    assert_eq!((few.number("/contact/c/force"), few.value("/contact/c/trust")), (0.0, false.into()));
    assert_eq!(few.code, Some(3), "bodies that pass through each other are no converged result: {}", few.said());
    assert!(few.said().contains("penetrate each other within segments"), "{}", few.said());
    assert!(few.number("/contact/c/unresolved_force") > 0.2 * force);
}

/// Two layers, one on the other, between x = 0 and x = 4, of so many cells each, the lower one fixed on a base; a load on
/// the upper one, by a formula.
fn layers(pressure: &str, gap: &str, cells: [usize; 2]) -> (tempfile::TempDir, std::path::PathBuf) {
    let lower = rectangle([0.0, -1.0], [4.0, 1.0], [cells[0], 2], 1);
    let upper = rectangle([0.0, 0.0], [4.0, 0.5], [cells[1], 1], 2);
    let mesh = Mesh {
        bodies: vec![("lower", lower, ["base", "", "lower.seam", ""]), ("upper", upper, ["upper.seam", "", "top", "left"])],
    };
    let case = format!(
        "mesh.file = \"mesh.msh\"
         body.lower = {{ young = 7000.0, poisson = 0.227 }}
         body.upper = {{ young = 7000.0, poisson = 0.3 }}
         support.base = {{ on = \"base\", ux = 0.0, uy = 0.0 }}
         support.left = {{ on = \"left\", ux = 0.0 }}
         load.top = {{ on = \"top\", pressure = \"{pressure}\" }}
         contact.seam = {{ between = [\"lower.seam\", \"upper.seam\"], curve = \"line\", gap = \"{gap}\" }}
         output.fields = false"
    );
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = write_scene(folder.path(), &mesh.text(), &case);
    (folder, file)
}

/// The upper layer lifts off beside its load, however loose the solves are.
#[test]
fn a_loose_tolerance_finds_the_same_set() {
    let (_folder, file) = layers("exp(-((x-1)/0.3)^2)", "closed", [8, 7]);
    let closed = |tolerance: &str| {
        Run::file(&file)
            .set("mesh.refine", 2)
            .set("solver.tolerance", tolerance)
            .ranks(2)
            .converged()
            .value("/contact/seam/closed")
    };
    let exact = closed("1e-8");
    println!("closed: {exact}");
    assert!(exact[0][1].as_f64().is_some_and(|end| end < 2.5), "the layer lifts off: {exact}");
    for tolerance in ["1e-2", "1e-3", "1e-4", "\"discretisation\""] {
        assert_eq!(closed(tolerance), exact, "tolerance {tolerance}");
    }
}

/// A bump under the seam, or the top of a shallow hill, is narrower than the first segments: what is asked for is known when the
/// mesh shows it, not before.
#[test]
fn ends_are_not_known_where_the_pressure_is_not() {
    let (_folder, file) = layers("1.0", "2e-4*exp(-((x-2)/0.1)^2)", [4, 4]);
    let ended = Run::file(&file).set("accuracy", "{ ends = 2e-2, max_unknowns = 60000 }").ranks(2).converged();
    let closed = ended.value("/contact/seam/closed");
    println!("closed: {closed}");
    assert_eq!(closed.as_array().map(Vec::len), Some(2), "both sides of the bump: {closed}");
}

/// A leaf of sixty times its thickness, clamped at both ends, pressed through a gap onto its seat: its set is as symmetric as the scene,
/// and ends of contact press, as a beam has them.
#[test]
fn a_leaf_that_is_clamped_at_both_ends_lies_on_its_seat_in_its_middle() {
    let seat = rectangle([-3.5, -1.0], [7.0, 1.0], [14, 3], 1);
    let leaf = rectangle([-3.0, 0.0], [6.0, 0.1], [60, 1], 2);
    let mesh = Mesh {
        bodies: vec![("seat", seat, ["base", "", "seat.top", ""]), ("leaf", leaf, ["leaf.bottom", "ends", "leaf.top", "ends"])],
    };
    let case = r#"
mesh = { file = "mesh.msh", refine = 4 }
body.seat = { young = 1000.0, poisson = 0.3 }
body.leaf = { young = 1000.0, poisson = 0.3 }
support.base = { on = ["base", "ends"], ux = 0.0, uy = 0.0 }
load.top = { on = "leaf.top", pressure = 0.004 }
contact.c = { between = ["seat.top", "leaf.bottom"], curve = "line", gap = 0.02 }
"#;
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = write_scene(folder.path(), &mesh.text(), case);
    // Euler and Bernoulli: between a clamp and what lies flat, p a⁴ = 72 EI g, and each end presses with p a/3 as a line.
    let bending = 1000.0 / 0.91 * 0.1f64.powi(3) / 12.0;
    let free = (72.0 * bending * 0.02 / 0.004f64).powf(0.25);
    let force = 0.004 * (6.0 - 4.0 / 3.0 * free);
    for ranks in [1, 2] {
        let ended = Run::file(&file).ranks(ranks).converged();
        let [from, to] = [0, 1].map(|end| ended.number(&format!("/contact/c/closed/0/{end}")));
        let middle = 0.5 * ended.number("/contact/c/length");
        assert!((0.5 * (from + to) - middle).abs() < 1e-9 && to - from > 1.0, "{ranks} ranks: closed from {from} to {to}");
        let found = ended.number("/contact/c/force");
        assert!((found / force - 1.0).abs() < 0.01, "{ranks} ranks: {found} instead of {force}");
        assert_eq!(ended.value("/contact/c/trust_force"), true, "{}", ended.said());
    }
}

/// The programme of the first mesh moves the bodies, so that a boundary is cut into other segments than those that it has told of: what
/// it has told is of no use then. Such a scene ended with a panic.
#[test]
fn a_boundary_that_the_programme_has_moved_begins_anew() {
    let mesh = include_str!("meshes/three_blocks.msh");
    let case = r#"
mesh = { file = "mesh.msh" }
body.b0 = { young = 127.721807493897, poisson = 0.2 }
body.b1 = { young = 730.7069647627469, poisson = 0.49 }
body.b2 = { young = 390.2899486276203, poisson = 0.0 }
support.base = { on = "b0.b", uy = 0 }
support.side = { on = ["b0.l", "b1.l", "b2.l"], normal = 0 }
contact.c0 = { between = ["b0.t", "b1.b"] }
contact.c1 = { between = ["b1.t", "b2.b"], law = "bilateral" }
load.top = { on = "b2.t", pressure = 0.18 }
"#;
    let folder = tempfile::tempdir().expect("a temporary folder");
    for ranks in [1, 2] {
        let ended = Run::file(&write_scene(folder.path(), mesh, case)).ranks(ranks).converged();
        for name in ["c0", "c1"] {
            let force = ended.number(&format!("/contact/{name}/resultant/1")).abs();
            assert!((force - 3.0 * 0.18).abs() < 1e-6, "{name} carries {force} on {ranks} ranks");
        }
    }
}
