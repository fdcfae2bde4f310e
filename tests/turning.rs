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
