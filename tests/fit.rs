//! A contact boundary that nobody gives: fitted through the boundary nodes, gaps between splines.

use crate::support::mesh::{GOOD, Mesh, grid, write_scene};
use crate::support::{Run, is_long, pairs_on_ranks, ranks_in_turn};

#[test]
fn patches_hold_on_a_fitted_line() {
    for (at, case) in ["patch_flat/case.toml", "patch_inclined/case.toml"].into_iter().enumerate() {
        // In short form each pair of spaces on one of both.
        for (_, (order, space, ranks)) in pairs_on_ranks().enumerate().filter(|(pair, _)| is_long() || pair % 2 == at) {
            let run = Run::case(case).ranks(ranks).set("mesh.order", order).set("contact.seam.multiplier", space);
            // The case's own expected values hold to 1e-9, or it would end with exit code 3.
            run.set("contact.seam.curve", "fit").set("contact.seam.gap", "geometry").converged();
        }
    }
}

#[test]
fn a_fit_through_bent_edges_is_as_good_as_the_declared_circle() {
    let rings =
        |curve: &str| Run::case("rings/case.toml").ranks(2).set("contact.seam.curve", curve).set("solver.tolerance", "1e-11");
    let [fitted, declared] = ["fit", "geometry"].map(|curve| rings(curve).converged().number("/errors/lambda_seam"));
    assert!(fitted < 1.05 * declared, "{fitted} against {declared}");
}

/// Splines of so many spans as are asked for: a cubic is off a circle by the fourth power of its span.
#[test]
fn a_fit_has_the_spans_that_are_asked_for() {
    let run =
        |spans: &str| Run::case("rings").set("mesh.refine", 2).set("contact.seam.curve", "fit").set("contact.seam.spans", spans);
    let errors = ["1", "2", "4", "auto"].map(|spans| {
        let ended = run(spans).set("exact.must_hold", false).set("output.fields", false).converged();
        ended.number("/errors/force_seam")
    });
    assert!(errors[1] < 0.3 * errors[0] && errors[2] < 0.3 * errors[1] && errors[3] < 1.05 * errors[2], "{errors:?}");
}

/// Two quarter rings of straight edges that overlap by 1e-3, `n` and `5/4 n` edges along the seam.
fn polygons(n: usize) -> Mesh {
    let ring = |nx: usize, ny: usize, seed: u64, inner: f64, outer: f64| {
        grid(nx, ny, seed, move |u, v| {
            let (r, angle) = (inner + u * (outer - inner), 0.5 * std::f64::consts::PI * v);
            [r * angle.cos(), r * angle.sin()]
        })
    };
    let inner = ring(n / 2, n, 1, 1.0, 2.0005);
    let outer = ring(n / 2, n + n / 4, 2, 1.9995, 3.0);
    Mesh {
        bodies: vec![
            ("inner", inner, ["flat", "inner.seam", "upright", "inner.rim"]),
            ("outer", outer, ["flat", "outer.rim", "upright", "outer.seam"]),
        ],
    }
}

const RINGS: &str = r#"
mesh = { file = "mesh.msh", order = 1 }
body.inner = { young = 7000.0, poisson = 0.227 }
body.outer = { young = 7000.0, poisson = 0.227 }
support.flat = { on = "flat", uy = 0.0 }
support.upright = { on = "upright", ux = 0.0 }
contact.seam = { between = ["inner.seam", "outer.seam"], multiplier = "p0" }
exact.contact.seam.lambda = { formula = "0.864878841841237", tolerance = 0.02 }
"#;

#[test]
fn polygons_get_their_gap_from_splines() {
    for ranks in [1, 2] {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let errors = [16, 32, 64].map(|n| {
            let file = write_scene(folder.path(), &polygons(n).text(), RINGS);
            Run::file(&file).ranks(ranks).converged().number("/errors/lambda_seam")
        });
        println!("{errors:?}");
        assert!(errors[2] <= 0.02 && (1..3).all(|k| errors[k] < 0.6 * errors[k - 1]), "{errors:?}");
    }
}

/// Two quarter rings that are drawn as touching, of `n` and `n + 1` chords along the seam, each cut into `parts`.
fn chords(n: usize, parts: usize) -> Mesh {
    let ring = |n: usize, seed: u64, inner: f64, outer: f64| {
        let at = move |k: f64| {
            [(k / n as f64 * std::f64::consts::FRAC_PI_2).cos(), (k / n as f64 * std::f64::consts::FRAC_PI_2).sin()]
        };
        grid(n * parts / 2, n * parts, seed, move |u, v| {
            let (k, r) = ((v * n as f64 + 1e-9).floor().min(n as f64 - 1.0), inner + u * (outer - inner));
            let (share, [a, b]) = (v * n as f64 - k, [at(k), at(k + 1.0)]);
            [0, 1].map(|i| r * (a[i] + share * (b[i] - a[i])))
        })
    };
    Mesh {
        bodies: vec![
            ("inner", ring(n, 1, 1.0, 2.0), ["flat", "inner.seam", "upright", "inner.rim"]),
            ("outer", ring(n + 1, 2, 2.0, 3.0), ["flat", "outer.rim", "upright", "outer.seam"]),
        ],
    }
}

const FINE_RINGS: [(&str, &str); 3] =
    [("mesh.order", "2"), ("contact.seam.gap", "-1e-3"), ("contact.seam.multiplier", "p1-continuous")];

/// Refined chords would keep the corners of 7 degrees between them, and λ would be 5 to 10 % off beside each.
#[test]
fn refined_polygons_follow_their_splines() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = write_scene(folder.path(), &chords(12, 1).text(), RINGS);
    for (refine, ranks) in [(1, 1), (2, 2), (3, 3)] {
        let run = Run::file(&file).ranks(ranks).set("mesh.refine", refine).set("exact.contact.seam.lambda.tolerance", 5e-3);
        let ended = FINE_RINGS.into_iter().fold(run, |run, (key, value)| run.set(key, value)).converged();
        assert!(ended.number("/errors/lambda_seam") < 4e-3, "{}", ended.number("/errors/lambda_seam"));
        assert_eq!((ended.value("/contact/seam/trust"), ended.number("/contact/seam/corner_angle")), (true.into(), 0.0));
        assert!(ended.output.contains("boundary inner.seam: no [geometry] gives its shape"), "{}", ended.output);
    }
}

/// Chords of several edges are straight pieces with corners, which are meant for all that anyone knows.
#[test]
fn corners_within_a_contact_are_told_with_what_they_do() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = write_scene(folder.path(), &chords(8, 2).text(), RINGS);
    let run = Run::file(&file).set("mesh.refine", 1).set("exact.contact.seam.lambda.tolerance", 1.0);
    let ended = FINE_RINGS.into_iter().fold(run, |run, (key, value)| run.set(key, value)).converged();
    assert_eq!(ended.value("/contact/seam/trust"), false);
    assert!((ended.number("/contact/seam/corner_angle") - 11.25).abs() < 0.1);
    assert!((0.04..0.1).contains(&ended.number("/contact/seam/corner_error")));
    for words in ["has corners of up to 11 degrees within the contact", "give the curve by a [geometry]"] {
        assert!(ended.errors.contains(words), "{}", ended.errors);
    }
    assert!(!ended.said().contains("grows without bound"), "{}", ended.said());
}

/// An interference that is declared and varies, between rings that are drawn as touching: the bodies as they lie deformed
/// are apart by it, and the fit must not take that for an end of contact.
#[test]
fn a_declared_gap_rules_where_a_fitted_boundary_reaches() {
    for ranks in ranks_in_turn(0) {
        let run = Run::case("rings_michell/stiff.toml").ranks(ranks).set("contact.seam.curve", "fit");
        // The case's own expected values hold, or it would end with exit code 3.
        let length = run.converged().number("/contact/seam/length");
        assert!((length - std::f64::consts::PI).abs() < 1e-4, "{length}");
    }
}

/// A sector of a cylinder of radius 1 above a block, a hundredth apart.
fn cylinder_on_block() -> Mesh {
    let block = grid(26, 8, 3, |u, v| {
        let x = 2.0 * u - 1.0;
        [0.5 * x + 0.7 * x * x * x, v - 1.0]
    });
    let sector = grid(22, 6, 4, |u, v| {
        let x = 2.0 * u - 1.0;
        let angle = (0.5 * x + 0.5 * x * x * x) * 0.7;
        let r = 1.0 - 0.5 * v;
        [r * angle.sin(), 1.01 - r * angle.cos()]
    });
    Mesh {
        bodies: vec![
            ("block", block, ["bottom", "", "block.top", ""]),
            ("cylinder", sector, ["cylinder.arc", "", "cylinder.inside", ""]),
        ],
    }
}

const CYLINDER: &str = r#"
mesh = { file = "mesh.msh", refine = 2 }
body.block = { young = 1000.0, poisson = 0.3 }
body.cylinder = { young = 1000.0, poisson = 0.3 }
geometry.circle = { curves = ["cylinder.arc"], circle = { centre = [0, 1.01], radius = 1 } }
support.bottom = { on = "bottom", ux = 0.0, uy = 0.0 }
support.press = { on = "cylinder.inside", ux = 0.0, uy = -0.02 }
contact.seam = { between = ["block.top", "cylinder.arc"] }
"#;

/// A cylinder that slides on a block presses as one that does not: there is no friction, and the block is flat. On
/// undeformed bodies this holds for small slip; a larger one is told, and the deformed bodies have it right.
#[test]
fn a_cylinder_that_slides_keeps_its_pressure_or_tells() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = write_scene(folder.path(), &cylinder_on_block().text(), CYLINDER);
    let run = |slip: f64| Run::file(&file).set("support.press.ux", slip);
    let figures = |run: Run| {
        let ended = run.converged();
        (["force", "pressure_max"].map(|key| ended.number(&format!("/contact/seam/{key}"))), ended)
    };
    let ([force, peak], at_rest) = figures(run(0.0));
    let width = at_rest.number("/contact/seam/length");
    let alike = |found: [f64; 2], tolerance: f64, words: &str| {
        assert!(
            (found[0] / force - 1.0).abs() < tolerance && (found[1] / peak - 1.0).abs() < 2.0 * tolerance,
            "{words}: {found:?}"
        );
    };
    for (ranks, order) in [(1, ["block.top", "cylinder.arc"]), (2, ["cylinder.arc", "block.top"])] {
        let between = format!("[\"{}\", \"{}\"]", order[0], order[1]);
        let (found, ended) = figures(run(0.12 * width).ranks(ranks).set("contact.seam.between", &between));
        alike(found, 0.01, "slid by a quarter of the half width");
        assert_eq!(ended.value("/contact/seam/trust"), true);
        let (found, _) = figures(run(0.5 * width).ranks(ranks).set("contact.seam.configuration", "deformed"));
        alike(found, 0.02, "slid by the half width, deformed");
        let (found, ended) = figures(run(0.5 * width).ranks(ranks).set("contact.seam.between", &between));
        let error = found[0] / force - 1.0;
        assert!((ended.number("/contact/seam/slip_error") / error - 1.0).abs() < 0.3, "error {error}");
        assert_eq!(ended.value("/contact/seam/trust"), false);
        assert!(ended.errors.contains("take configuration = \"deformed\""), "{}", ended.errors);
    }
}

/// A pad that slides on a wider flat presses up to its corners, wherever they have come to lie on the way.
#[test]
fn a_pad_that_slides_ends_at_its_own_corners() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let flat = grid(24, 6, 0, |u, v| [20.0 * u - 10.0, 4.0 * (v - 1.0)]);
    let pad = grid(13, 5, 0, |u, v| [10.0 * u - 5.0, 4.0 * v]);
    let bodies = vec![("flat", flat, ["base", "", "flat.top", ""]), ("pad", pad, ["pad.bottom", "", "pad.top", ""])];
    let case = r#"
mesh = { file = "mesh.msh", refine = 2 }
body.flat = { young = 3000.0, poisson = 0.3 }
body.pad = { young = 3000.0, poisson = 0.3 }
support.base = { on = "base", ux = 0.0, uy = 0.0 }
load.top = { on = "pad.top", rigid = true, force = [0.0, -40.0], angle = 0.0 }
contact.seam = { between = ["flat.top", "pad.bottom"], configuration = "deformed" }
"#;
    let file = write_scene(folder.path(), &Mesh { bodies }.text(), case);
    for (ranks, slip) in [(2, 1.0), (1, -0.9)] {
        let ended = Run::file(&file).ranks(ranks).set("load.top.ux", slip).converged();
        let [force, cut] = ["force", "zones/0/cut_off"].map(|key| ended.number(&format!("/contact/seam/{key}")));
        assert!((force - 40.0).abs() < 0.01 && cut == 0.0, "{force}, {cut}: {}", ended.said());
        assert_eq!(ended.value("/contact/seam/trust"), true, "{}", ended.said());
        assert_eq!(ended.value("/contact/seam/zones/0/corner"), true, "{}", ended.said());
    }
}

/// A block a third of its height above another.
#[test]
fn a_declared_gap_that_is_not_the_drawn_one_is_told() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for (height, gap, curve, told) in [
        (0.3, "-0.01", "line", true),
        (0.3, "\"-0.01-1e-3*x\"", "fit", true),
        (0.3, "0.29", "line", false),
        (0.0, "-0.01", "fit", false),
    ] {
        let lower = grid(6, 3, 1, |u, v| [2.0 * u, v]);
        let upper = grid(7, 3, 2, |u, v| [2.0 * u, 1.0 + height + v]);
        let bodies =
            vec![("lower", lower, ["bottom", "", "lower.seam", "left"]), ("upper", upper, ["upper.seam", "", "top", "left"])];
        let case = format!("{GOOD}support.lid = {{ on = \"top\", uy = -1e-3 }}\n")
            .replace("load.top = { on = \"top\", pressure = 1.0 }", "");
        let file = write_scene(folder.path(), &Mesh { bodies }.text(), &case);
        let ended = Run::file(&file).ranks(2).set("contact.seam.gap", gap).set("contact.seam.curve", curve).converged();
        let words = "but the boundaries are drawn 3.000e-1 apart";
        assert_eq!(ended.errors.matches(words).count(), usize::from(told), "{height} {gap}: {}", ended.errors);
    }
}

/// Whole rings of straight edges that overlap by 1e-3, bonded to a shaft and a housing: closed splines through their nodes.
#[test]
fn a_fit_goes_around_whole_rings() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let whole = |seed: u64, n: usize, inner: f64, outer: f64| {
        let mut ring = grid(n, 2, seed, move |u, v| {
            let (r, angle) = (outer - v * (outer - inner), 2.0 * std::f64::consts::PI * u);
            [r * angle.cos(), r * angle.sin()]
        });
        // The last column is the first.
        let first = |k: usize| if k % (n + 1) == n { k - n } else { k };
        ring.triangles.iter_mut().flatten().for_each(|k| *k = first(*k));
        ring.sides.iter_mut().flatten().flatten().for_each(|k| *k = first(*k));
        ring
    };
    let mut bodies = vec![
        ("inner", whole(1, 30, 1.0, 2.0005), ["inner.seam", "", "inner.rim", ""]),
        ("outer", whole(2, 36, 1.9995, 3.0), ["outer.rim", "", "outer.seam", ""]),
    ];
    // Points that nothing uses any more lie on the circle, and are left out of the file's triangles.
    bodies.iter_mut().for_each(|(_, ring, _)| ring.sides[1].clear());
    let bonded = RINGS
        .replace("\"flat\", uy", "[\"inner.rim\", \"outer.rim\"], uy")
        .replace("\"upright\", ux", "[\"inner.rim\", \"outer.rim\"], ux");
    let case = bonded.replace("0.864878841841237", "4.279306881880523");
    let file = write_scene(folder.path(), &Mesh { bodies }.text(), &case);
    for (order, refine, space, most) in [(1, 1, "p0", 0.02), (2, 0, "p1-discontinuous", 5e-3), (2, 0, "p1-continuous", 5e-3)] {
        let run = Run::file(&file).ranks(2).set("mesh.order", order).set("mesh.refine", refine);
        let ended = run.set("contact.seam.multiplier", space).converged();
        assert_eq!(ended.value("/contact/seam/trust"), true, "{}", ended.said());
        let closed = ended.value("/contact/seam/closed");
        assert!(closed.as_array().map(Vec::len) == Some(1) && closed[0][0] == 0.0, "{closed}");
        let error = ended.number("/errors/lambda_seam");
        assert!(error < most, "P{order}, {space}: {error}");
    }
}

/// A tooth with a sharp corner on a flank that rises by 3 degrees, on a half-plane in effect: pressure on it has no part along it, so that
/// the wall beside the tooth carries tan 3 of the load. A curve half-way has half of that.
#[test]
fn a_corner_on_an_oblique_flank_presses_along_the_normal_of_the_flank_or_tells() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let slope = 3f64.to_radians().tan();
    let top = |u: f64| slope * (6.0 * u - 3.0);
    let block = grid(12, 8, 0, |u, v| [6.0 * u - 3.0, -3.0 + v * (3.0 + top(u))]);
    let tooth = grid(4, 6, 0, |u, v| [2.0 * u - 2.0, 3.0 * v]);
    let bodies = vec![("block", block, ["floor", "", "block.flank", ""]), ("tooth", tooth, ["tooth.tip", "", "top", "back"])];
    let case = "mesh = { file = \"mesh.msh\", refine = 3 }\nbody.block = { young = 2000, poisson = 0.3 }\n\
                body.tooth = { young = 2000, poisson = 0.3 }\nsupport.floor = { on = \"floor\", ux = 0.0, uy = 0.0 }\n\
                support.back = { on = \"back\", ux = 0.0 }\nload.top = { on = \"top\", pressure = 50 }\n\
                contact.seam = { between = [\"tooth.tip\", \"block.flank\"] }\n";
    let file = write_scene(folder.path(), &Mesh { bodies }.text(), case);
    for (ranks, curve, configuration, trust, tolerance) in [
        (1, "fit", "reference", false, f64::INFINITY),
        (2, "fit", "reference", false, f64::INFINITY),
        (2, "block.flank", "reference", true, 1e-6),
        (1, "fit", "deformed", true, 0.05),
    ] {
        let run = Run::file(&file).ranks(ranks).set("contact.seam.curve", format!("\"{curve}\""));
        let ended = run.set("contact.seam.configuration", format!("\"{configuration}\"")).converged();
        let found = ended.number("/support/back/reaction/0") / (100.0 * slope);
        assert!((found - 1.0).abs() < tolerance, "{curve}, {configuration}: {found} of the true one");
        assert_eq!(ended.value("/contact/seam/trust_force"), trust, "{curve}, {configuration}: {}", ended.said());
        assert_eq!(ended.errors.contains("curve = \"BODY.SIDE\""), !trust, "{}", ended.errors);
    }
}

/// A bar whose two corners press on a round trough, opposite to each other.
#[test]
fn two_corners_of_one_contact_are_told_like_one() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let trough = |x: f64| 6.0 - (36.0 - x * x).sqrt();
    let block = grid(24, 8, 0, |u, v| {
        let x = 4.0 * u - 2.0;
        [x, -3.0 + v * (3.0 + trough(x))]
    });
    let bar = grid(12, 6, 0, |u, v| [2.0 * u - 1.0, trough(1.0) + v]);
    let bodies = vec![("block", block, ["floor", "", "trough", ""]), ("bar", bar, ["under", "", "top", ""])];
    let case = "mesh = { file = \"mesh.msh\", refine = 3 }\nbody.block = { young = 2000, poisson = 0.3 }\n\
                body.bar = { young = 2000, poisson = 0.3 }\nsupport.floor = { on = \"floor\", ux = 0.0, uy = 0.0 }\n\
                load.top = { on = \"top\", rigid = true, force = [0.0, -20.0], ux = 0.0 }\n\
                contact.seam = { between = [\"under\", \"trough\"] }\n";
    let file = write_scene(folder.path(), &Mesh { bodies }.text(), case);
    let told = Run::file(&file).converged();
    assert!(told.number("/contact/seam/slant") > 0.05, "{}", told.said());
    assert_eq!(told.value("/contact/seam/trust_force"), false, "{}", told.said());
    let right = Run::file(&file).ranks(2).set("contact.seam.curve", "\"trough\"").converged();
    assert!(right.number("/contact/seam/slant") < 0.01, "{}", right.said());
}

/// A pin that three leaves bend, with clearance: what presses is so small beside what moves that a solve on the way may leave all as it
/// was, while the ends go on.
#[test]
fn ends_of_small_contacts_come_to_rest() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for (cells, refine, ranks) in [(2, 2, 1), (2, 3, 2), (3, 2, 2), (4, 2, 1)] {
        let leaf = |x: f64, width: f64, y: f64| {
            let columns = (width * cells as f64).round() as usize;
            grid(columns, 3 * cells, 0, move |u, v| [x + width * u, y + 3.0 * v])
        };
        let pin = grid(12 * cells, 2 * cells, 0, |u, v| [12.0 * u - 6.0, 2.0 * v - 1.0]);
        let bodies = vec![
            ("pin", pin, ["pin.bottom", "", "pin.top", ""]),
            ("left", leaf(-5.0, 2.0, 1.02), ["left.bore", "", "fixed", ""]),
            ("right", leaf(3.0, 2.0, 1.02), ["right.bore", "", "fixed", ""]),
            ("middle", leaf(-2.2, 4.4, -4.02), ["pulled", "", "middle.bore", ""]),
        ];
        let mut case = String::from("mesh.file = \"mesh.msh\"\nsupport.fixed = { on = \"fixed\", ux = 0.0, uy = 0.0 }\n");
        for name in ["pin", "left", "right", "middle"] {
            case += &format!("body.{name} = {{ young = 200000.0, poisson = 0.3 }}\n");
        }
        for name in ["pin", "middle"] {
            case += &format!("support.{name} = {{ body = \"{name}\", mean = true, ux = 0.0 }}\n");
        }
        for (name, side) in [("left", "top"), ("right", "top"), ("middle", "bottom")] {
            case += &format!("contact.{name} = {{ between = [\"{name}.bore\", \"pin.{side}\"] }}\n");
        }
        case += "load.pull = { on = \"pulled\", pressure = 20.0 }\n";
        let file = write_scene(folder.path(), &Mesh { bodies }.text(), &case);
        let ended = Run::file(&file).ranks(ranks).set("mesh.refine", refine).converged();
        for (name, wanted) in [("left", 44.0), ("right", 44.0), ("middle", 88.0)] {
            let force = ended.number(&format!("/contact/{name}/force"));
            assert!((force / wanted - 1.0).abs() < 1e-3, "{cells} cells: {name} {force}");
        }
    }
}
