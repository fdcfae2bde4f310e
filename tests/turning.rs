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

/// A rocker of radius 4 on a stiff flat, under 20 and pushed onto a wall by .4, which by balance is the force of the wall, since the flat
/// stays level. The rocker turns as it rolls, and normals half-way between the undeformed sides turn by half of that: the wall has
/// an eighth too little, and that is told, with what helps.
#[test]
fn a_small_force_beside_one_that_turns_is_told() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let flat = grid(12, 4, 0, |u, v| [4.0 * u - 2.0, v - 1.0]);
    let rocker = grid(24, 10, 0, |u, v| {
        let x = 3.0 * u - 1.5;
        [x, (1.0 - v) * (4.0 - (16.0 - x * x).sqrt()) + 2.0 * v]
    });
    let bodies = vec![("flat", flat, ["base", "", "flat.top", ""]), ("rocker", rocker, ["arc", "side", "rocker.top", ""])];
    let case = r#"
mesh = { file = "mesh.msh", refine = 2 }
body.flat = { young = 1e6, poisson = 0.3 }
body.rocker = { young = 1e4, poisson = 0.3 }
support.base = { on = "base", ux = 0.0, uy = 0.0 }
rigid.wall = { x = "1.5 + t^2/40", y = "1 + t", t = [-0.6, 0.6], ux = 0.0, uy = 0.0, angle = 0.0 }
load.top = { on = "rocker.top", traction = ["0.4/3", "-20/3"] }
contact.foot = { between = ["flat.top", "arc"] }
contact.wall = { between = ["side", "rigid.wall"] }
accuracy = { force = 1e-2 }
"#;
    let file = write_scene(folder.path(), &Mesh { bodies }.text(), case);
    for (ranks, curve, configuration) in
        [(1, "fit", "reference"), (2, "fit", "reference"), (1, "fit", "deformed"), (1, "flat.top", "reference")]
    {
        let run = Run::file(&file).ranks(ranks).set("contact.foot.curve", curve).set("contact.foot.configuration", configuration);
        let ended = run.converged();
        let [force, error] = ["force", "direction_error"].map(|key| ended.number(&format!("/contact/wall/{key}")));
        let is_off = curve == "fit" && configuration == "reference";
        let off = 0.4 - force;
        assert_eq!(off.abs() > 1e-3, is_off, "{force}: {}", ended.said());
        assert!((error * force - off).abs() < 1e-3, "{error} of {force}");
        assert_eq!(ended.value("/contact/wall/trust_force"), !is_off, "{}", ended.said());
        assert_eq!(ended.errors.contains("forces on them turn"), is_off, "{}", ended.errors);
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
