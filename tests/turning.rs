//! Bodies that turn: a linear theory makes them larger, and says how far that spoils the contact.

use crate::support::mesh::{Block, Mesh, grid, write_scene};
use crate::support::{Ended, Run};

/// A sector of a ring about the origin between two radii and two angles.
fn sector(n: usize, seed: u64, radii: [f64; 2], angles: [f64; 2]) -> Block {
    grid(n, 6, seed, move |u, v| {
        let angle = angles[1] - u * (angles[1] - angles[0]);
        let r = radii[0] + v * (radii[1] - radii[0]);
        [r * angle.cos(), r * angle.sin()]
    })
}

/// A pad of half a radian in a bore of radius 2.
fn pad_in_bore() -> Mesh {
    let pad = sector(14, 1, [1.5, 2.0], [0.7, 1.2]);
    let bore = sector(26, 2, [2.0, 3.0], [0.0, 2.0]);
    Mesh { bodies: vec![("pad", pad, ["hub", "", "pad.arc", ""]), ("bore", bore, ["bore.arc", "", "outside", ""])] }
}

const PAD: &str = r#"
mesh = { file = "mesh.msh", refine = 1 }
body.pad = { young = 1000.0, poisson = 0.3 }
body.bore = { young = 1000.0, poisson = 0.3 }
geometry.circle = { curves = ["pad.arc", "bore.arc"], circle = { centre = [0, 0], radius = 2 } }
support.hub = { on = "hub", ux = 0.0, uy = 0.0 }
support.outside = { on = "outside", ux = 0.0, uy = 0.0 }
contact.seam = { between = ["pad.arc", "bore.arc"] }
output.fields = false
"#;

/// The hub turned about the origin by an angle, and pushed outwards by a share of its radius.
fn turned(folder: &std::path::Path, angle: f64, push: f64, configuration: &str, ranks: usize) -> Ended {
    run(folder, angle, push, configuration, ranks).converged()
}

fn run(folder: &std::path::Path, angle: f64, push: f64, configuration: &str, ranks: usize) -> Run {
    let file = write_scene(folder, &pad_in_bore().text(), PAD);
    let (s, c) = angle.sin_cos();
    let (c, s) = ((1.0 + push) * c - 1.0, (1.0 + push) * s);
    Run::file(&file)
        .ranks(ranks)
        .set("support.hub.ux", format!("{c:?}*x - ({s:?})*y"))
        .set("support.hub.uy", format!("({s:?})*x + {c:?}*y"))
        .set("contact.seam.configuration", configuration)
}

/// A stiff flat, and a rocker of radius 4 on it.
fn flat_and_rocker() -> Vec<(&'static str, Block, [&'static str; 4])> {
    let flat = grid(12, 4, 0, |u, v| [4.0 * u - 2.0, v - 1.0]);
    let rocker = grid(24, 10, 0, |u, v| {
        let x = 3.0 * u - 1.5;
        [x, (1.0 - v) * (4.0 - (16.0 - x * x).sqrt()) + 2.0 * v]
    });
    vec![("flat", flat, ["base", "", "flat.top", ""]), ("rocker", rocker, ["arc", "side", "rocker.top", ""])]
}

/// The rocker under 20, off its centre as it will, and pushed onto a wall by .4, which by balance is the force of the wall, since the flat
/// stays level.
const ROCKER: &str = r#"
mesh = { file = "mesh.msh", refine = 2 }
body.flat = { young = 1e6, poisson = 0.3 }
body.rocker = { young = 1e4, poisson = 0.3 }
support.base = { on = "base", ux = 0.0, uy = 0.0 }
load.top = { on = "rocker.top", traction = ["0.4/3", "-20/3"] }
contact.foot = { between = ["flat.top", "arc"] }
accuracy = { force = 1e-2 }
"#;

const WALL: &str = r#"
rigid.wall = { x = "1.5 + t^2/40", y = "1 + t", t = [-0.6, 0.6], ux = 0.0, uy = 0.0, angle = 0.0 }
contact.wall = { between = ["side", "rigid.wall"] }
"#;

/// A force that should be `truth` is that, or is not trusted and says by how much it is off, to this share of it.
fn assert_told(ended: &Ended, contact: &str, truth: f64, share: f64, is_off: bool) {
    let [force, error] = ["force", "direction_error"].map(|key| ended.number(&format!("/contact/{contact}/{key}")));
    let off = truth - force;
    assert_eq!(off.abs() > 0.01 * truth, is_off, "{force}: {}", ended.said());
    assert!((error * force - off.abs()).abs() < share * truth, "{error} of {force} instead of {truth}");
    assert_eq!(ended.value(&format!("/contact/{contact}/trust_force")), !is_off, "{}", ended.said());
    assert_eq!(ended.errors.contains("forces on them with them"), is_off, "{}", ended.errors);
}

/// The rocker turns as it rolls, and normals half-way between the undeformed sides turn by half of that: the wall has an eighth too little,
/// and that is told, with what helps.
#[test]
fn a_small_force_beside_one_that_turns_is_told() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let case = format!("{ROCKER}{WALL}");
    let file = write_scene(folder.path(), &Mesh { bodies: flat_and_rocker() }.text(), &case);
    for (ranks, curve, configuration) in
        [(1, "fit", "reference"), (2, "fit", "reference"), (1, "fit", "deformed"), (1, "flat.top", "reference")]
    {
        let run = Run::file(&file).ranks(ranks).set("contact.foot.curve", curve).set("contact.foot.configuration", configuration);
        assert_told(&run.converged(), "wall", 0.4, 2e-3, curve == "fit" && configuration == "reference");
    }
}

/// Springs that are far softer than the bodies hold nothing, and take nothing up.
#[test]
fn soft_springs_do_not_hide_that_a_force_turns() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let springs = "support.soft = { on = \"rocker.top\", stiffness = { x = 1e-3, y = 1e-3 } }\n";
    let case = format!("{ROCKER}{WALL}{springs}");
    let file = write_scene(folder.path(), &Mesh { bodies: flat_and_rocker() }.text(), &case);
    let ended = Run::file(&file).converged();
    assert_told(&ended, "wall", 0.4, 2e-3, true);
    assert!(!ended.errors.contains("the bodies turn:"), "the force is set by balance: {}", ended.errors);
}

/// A free block between rocker and wall hands on what it has from the rocker: its force on the wall is off by as much.
#[test]
fn a_body_hands_on_what_is_off_to_the_next() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let spacer = grid(8, 8, 0, |u, v| {
        let (y, left) = (0.4 + 1.2 * v, 1.5 + 0.1 * (1.2 * v - 0.6).powi(2));
        [left + u * (2.5 - left), y]
    });
    let mut bodies = flat_and_rocker();
    bodies.push(("spacer", spacer, ["", "sp.right", "", "sp.left"]));
    let case = format!(
        "{ROCKER}{}",
        r#"
body.spacer = { young = 1e4, poisson = 0.3 }
support.spacer = { body = "spacer", mean = true, uy = 0.0, angle = 0.0 }
rigid.wall = { x = "2.5 + (t - 1)^2/40", y = "t", t = [0.4, 1.6], ux = 0.0, uy = 0.0, angle = 0.0 }
contact.middle = { between = ["side", "sp.left"] }
contact.wall = { between = ["sp.right", "rigid.wall"] }
"#
    );
    let file = write_scene(folder.path(), &Mesh { bodies }.text(), &case);
    for ranks in [1, 2] {
        let ended = Run::file(&file).ranks(ranks).converged();
        ["middle", "wall"].iter().for_each(|contact| assert_told(&ended, contact, 0.4, 2e-3, true));
    }
}

/// A round block on a round cap of the same radius that stands off by g under 20: the line between both centres is tilted by g/2. In the
/// contact, wider than g, the deformed sides lie flat on each other.
#[test]
fn sides_that_are_flattened_against_each_other_turn_their_force_too() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let turn = std::f64::consts::PI;
    let cap = grid(24, 6, 0, move |u, v| {
        let (r, angle) = (0.4 + 0.6 * v, turn * (0.85 - 0.7 * u));
        [r * angle.cos(), r * angle.sin() - 1.0]
    });
    let block = grid(16, 8, 0, |u, v| {
        let x = 1.4 * u - 0.7;
        [x, (1.0 - v) * (1.0 - (1.0 - x * x).sqrt()) + 1.2 * v]
    });
    let bodies = vec![("cap", cap, ["bore", "", "cap.top", ""]), ("block", block, ["arc", "side", "block.top", ""])];
    let case = r#"
mesh = { file = "mesh.msh", refine = 1 }
body.cap = { young = 1e4, poisson = 0.3 }
body.block = { young = 1e4, poisson = 0.3 }
support.bore = { on = "bore", ux = 0.0, uy = 0.0 }
support.level = { body = "block", mean = true, angle = 0.0 }
load.top = { on = "block.top", traction = ["0.4/1.4", "-20/1.4"] }
rigid.wall = { x = "0.71 + t^2/20", y = "0.8 + t", t = [-0.3, 0.3], ux = 0.0, uy = 0.0, angle = 0.0 }
contact.foot = { between = ["cap.top", "arc"] }
contact.wall = { between = ["side", "rigid.wall"] }
accuracy = { force = 2e-3 }
"#;
    let file = write_scene(folder.path(), &Mesh { bodies }.text(), case);
    for (ranks, configuration) in [(1, "reference"), (2, "deformed")] {
        let ended = Run::file(&file).ranks(ranks).set("contact.foot.configuration", configuration).converged();
        // The block goes as far as the wall lets it, less what it is strained.
        let truth = 0.4 + 20.0 * 0.005;
        assert_told(&ended, "wall", truth, 0.03, configuration == "reference");
    }
}

/// A lever on a shaft, which a flat presses by 20 through the shaft wherever the lever has turned to: the stop has what the arm is pushed
/// by. On undeformed bodies the force moves off the shaft, on deformed ones its moment is about where the rim was.
#[test]
fn a_moment_that_a_turn_makes_of_a_force_is_told() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let flat = grid(24, 8, 0, |u, v| [1.2 * u - 0.6, 0.5 * v - 1.5]);
    let turn = std::f64::consts::PI;
    let lever = sector(40, 0, [0.4, 1.0], [turn, 2.0 * turn]);
    let bodies = vec![("flat", flat, ["base", "", "flat.top", ""]), ("lever", lever, ["hole", "left", "rim", "right"])];
    let case = r#"
mesh = { file = "mesh.msh", refine = 1 }
body.flat = { young = 1e4, poisson = 0.3 }
body.lever = { young = 1e4, poisson = 0.3 }
geometry.rim = { curves = ["rim"], circle = { centre = [0, 0], radius = 1 } }
geometry.hole = { curves = ["hole"], circle = { centre = [0, 0], radius = 0.4 } }
support.shaft = { on = "hole", normal = 0.0 }
load.base = { on = "base", rigid = true, force = [0.0, 20.0], ux = 0.0, angle = 0.0 }
load.arm = { on = "right", traction = [0.0, "-0.4/0.6"] }
rigid.stop = { x = "t", y = "0.0028 + (t + 0.7)^2/4", t = [-1.1, -0.3], ux = 0.0, uy = 0.0, angle = 0.0 }
contact.foot = { between = ["flat.top", "rim"], curve = "fit" }
contact.stop = { between = ["left", "rigid.stop"] }
accuracy = { force = 2e-3 }
"#;
    let file = write_scene(folder.path(), &Mesh { bodies }.text(), case);
    for (ranks, curve, configuration) in [(1, "fit", "reference"), (2, "fit", "deformed"), (1, "rim", "reference")] {
        let run = Run::file(&file).ranks(ranks).set("contact.foot.curve", curve).set("contact.foot.configuration", configuration);
        assert_told(&run.converged(), "stop", 0.4, 0.02, curve == "fit");
    }
}

/// A pad presses on its bore with one force wherever it has been turned to. The program is off, and says by how much.
#[test]
fn a_pad_that_turns_in_its_bore_presses_as_before_or_tells() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let force = |ended: &Ended| ended.number("/contact/seam/force");
    for (ranks, configuration) in [(1, "reference"), (2, "deformed"), (3, "reference")] {
        let at_rest = turned(folder.path(), 0.0, 2e-3, configuration, ranks);
        assert_eq!(at_rest.value("/contact/seam/trust"), true, "{}", at_rest.said());
        let little = turned(folder.path(), 2e-3, 2e-3, configuration, ranks);
        assert_eq!(little.value("/contact/seam/trust"), true, "{}", little.said());
        assert!((force(&little) / force(&at_rest) - 1.0).abs() < 0.01);
        for angle in [0.02, -0.03] {
            let ended = turned(folder.path(), angle, 2e-3, configuration, ranks);
            let error = (force(&at_rest) / force(&ended) - 1.0).abs();
            let said = ended.number("/contact/seam/rotation_error");
            assert!(error > 0.03 && said > 0.4 * error && said < 2.5 * error, "{configuration} {angle}: {said} for {error}");
            assert!((ended.number("/rotation/pad") / angle - 1.0).abs() < 0.1);
            assert_eq!(ended.value("/contact/seam/trust"), false);
            assert_eq!(ended.value("/contact/seam/trust_force"), false);
            assert!(ended.errors.contains("the bodies turn"), "{}", ended.errors);
            assert!(!ended.errors.contains("deformed"), "{}", ended.errors);
        }
    }
}

/// Turned so far that most of its force is that of a pad which has grown, it is no result.
#[test]
fn a_pad_that_is_turned_too_far_is_not_resolved() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for ranks in [1, 2] {
        let ended = run(folder.path(), 0.055, 2e-3, "reference", ranks).ended();
        assert_eq!((ended.code, ended.value("/status").as_str()), (Some(3), Some("unresolved")), "{}", ended.said());
        let reason = ended.value("/reason").to_string();
        assert!(reason.contains("turn or slide so far") && reason.contains("body pad turns most, by 0.0"), "{reason}");
    }
}

/// A pad that would press if it did not shrink by being turned: nothing presses, and that is not believed.
#[test]
fn a_gap_that_turning_makes_is_told() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for ranks in [1, 2] {
        let ended = turned(folder.path(), 0.08, 1e-3, "reference", ranks);
        assert_eq!(ended.number("/contact/seam/force"), 0.0);
        assert_eq!(ended.value("/contact/seam/trust"), false);
        assert!(ended.errors.contains("nothing presses, but bodies that turn"), "{}", ended.errors);
        // Drawn back without being turned, nothing presses either, and that is right.
        let ended = turned(folder.path(), 0.0, -1e-3, "reference", ranks);
        assert!(!ended.errors.contains("turn"), "{}", ended.errors);
    }
}

/// Two rings with a slit, the one shrunk into the other: the forces of their contact cancel along the curve, and are in balance by what
/// they are, not by their sum, which is rounding.
#[test]
fn rings_with_a_slit_are_in_balance() {
    let angles = [0.2, 2.0 * std::f64::consts::PI - 0.2];
    let [inner, outer] = [([1.0, 1.5], 3), ([1.5, 2.0], 4)].map(|(radii, seed)| sector(40 + seed as usize, seed, radii, angles));
    let bodies = vec![("in", inner, ["", "", "in.rim", ""]), ("out", outer, ["out.bore", "", "", ""])];
    let case = r#"
mesh = { file = "mesh.msh", refine = 1 }
body.in = { young = 1000.0, poisson = 0.3 }
body.out = { young = 1000.0, poisson = 0.3 }
geometry.circle = { curves = ["in.rim", "out.bore"], circle = { centre = [0, 0], radius = 1.5 } }
support.out = { body = "out", mean = true, ux = 0.0, uy = 0.0, angle = 0.0 }
support.in = { body = "in", mean = true, angle = 0.0 }
contact.seam = { between = ["in.rim", "out.bore"], gap = -1e-3 }
solver.tolerance = 1e-10
output.fields = false
"#;
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = write_scene(folder.path(), &Mesh { bodies }.text(), case);
    for ranks in [1, 2] {
        // They come apart, but for short zones that this mesh does not resolve.
        let ended = Run::file(&file).ranks(ranks).ended();
        assert!(ended.number("/balance/bodies") < 1e-4 && !ended.said().contains("out of balance"), "{}", ended.said());
        assert!(ended.number("/contact/seam/force") > 1e-3, "{}", ended.said());
    }
}

/// A strip that two loads bend over a drum: both halves turn, and its mean does not.
#[test]
fn halves_that_turn_against_each_other_are_seen() {
    let strip = grid(48, 3, 5, |u, v| [12.0 * u - 6.0, 0.5 * v]);
    let mesh = Mesh { bodies: vec![("strip", strip, ["below", "right", "", "left"])] };
    let case = r#"
mesh = { file = "mesh.msh", refine = 1 }
body.strip = { young = 1000.0, poisson = 0.3 }
rigid.drum = { circle = { centre = [0.0, -10.0], radius = 10.0 } }
support.still = { body = "strip", mean = true, ux = 0.0, angle = 0.0 }
load.ends = { on = ["left", "right"], traction = [0.0, -0.4] }
contact.seam = { between = ["below", "rigid.drum"] }
output.fields = false
"#;
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = write_scene(folder.path(), &mesh.text(), case);
    for ranks in [1, 2] {
        let ended = Run::file(&file).ranks(ranks).ended();
        assert!(
            ended.number("/rotation/strip").abs() < 1e-6 && ended.number("/rotation_max/strip").abs() > 0.2,
            "{}",
            ended.said()
        );
        assert_eq!(ended.value("/contact/seam/trust"), false);
        assert!(ended.said().contains("body strip turns by"), "{}", ended.said());
    }
}

/// A leaf that is bent round a drum presses beside its wall and where it leaves the drum. It bends between these zones, so that
/// the one does not feel how the other turns: the force is that of deformed bodies.
#[test]
fn zones_that_bend_towards_each_other_are_judged_by_themselves() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let leaf = grid(30, 2, 0, |u, v| [15.0 * u, 0.5 * v]);
    let case = r#"
mesh = { file = "mesh.msh", refine = 2 }
body.leaf = { young = 1000.0, poisson = 0.3 }
support.wall = { on = "wall", ux = 0.0, uy = 0.0 }
rigid.drum.circle = { centre = [0.0, -200.0], radius = 200.0 }
load.tip = { on = "tip", traction = [0.0, -0.01] }
contact.seam = { between = ["below", "rigid.drum"], curve = "fit" }
accuracy = { pressure = 1e-2 }
"#;
    let file = write_scene(folder.path(), &Mesh { bodies: vec![("leaf", leaf, ["below", "tip", "", "wall"])] }.text(), case);
    let force = |ranks: usize, configuration: &str| {
        let ended = Run::file(&file).ranks(ranks).set("contact.seam.configuration", configuration).converged();
        let error = ended.number("/contact/seam/rotation_error");
        assert!(error < 0.1, "{error}: {}", ended.said());
        ended.number("/contact/seam/force")
    };
    let [reference, deformed] = [force(2, "reference"), force(1, "deformed")];
    assert!((reference / deformed - 1.0).abs() < 2e-3, "{reference} and {deformed}");
}
