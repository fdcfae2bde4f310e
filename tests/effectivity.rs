//! Estimated errors of λ, its peak and the force against true ones, over cases with a known answer; and scenes whose pressure is
//! wrong, or right where it seems not.

use crate::support::mesh::{Block, Mesh, grid, write_scene};
use crate::support::{Ended, PAIRS, Run, TracePoint, is_long, ranks_in_turn};
use std::fmt::Write;

/// A case whose pressure is known along its contact, from a point (x, y).
struct Known {
    case: &'static str,
    pressure: fn([f64; 2]) -> f64,
    /// `∫λ ds`.
    force: f64,
}

const KNOWN: [Known; 4] = [
    Known { case: "rings", pressure: |_| 0.864878841841237, force: 2.717097015773679 },
    Known {
        case: "rings_michell",
        pressure: |[x, y]| 1.7086288418412372 + 0.5884994128949614 * (x * x - y * y) / (x * x + y * y),
        force: 5.367815817240067,
    },
    Known {
        case: "rings_michell/stiff.toml",
        pressure: |[x, y]| 15.759215989510665 + 1.3674290870520769 * (x * x - y * y) / (x * x + y * y),
        force: 49.50903717898151,
    },
    Known { case: "open_zone", pressure: |[x, _]| 1.5 * (x - 0.3).max(0.0).powi(2), force: 2.775997186990461 },
];

/// Root mean square of λ minus the exact one over that of λ, in the middle 60 % of the only zone, by the trapezoidal rule.
fn true_error(trace: &[TracePoint], [from, to]: [f64; 2], exact: fn([f64; 2]) -> f64) -> f64 {
    let inside: Vec<&TracePoint> = trace.iter().filter(|p| ((p.s - from) / (to - from) - 0.5).abs() <= 0.3).collect();
    let mut sums = [0.0; 2];
    for ends in inside.windows(2) {
        for point in ends {
            let half = 0.5 * (ends[1].s - ends[0].s);
            sums[0] += half * (point.lambda - exact(point.x)).powi(2);
            sums[1] += half * point.lambda.powi(2);
        }
    }
    (sums[0] / sums[1]).sqrt()
}

fn zone_ends(ended: &Ended) -> [f64; 2] {
    assert_eq!(ended.value("/contact/seam/zones").as_array().map(Vec::len), Some(1));
    [0, 1].map(|k| ended.number(&format!("/contact/seam/zones/0/ends/{k}")))
}

/// Effectivities of λ, of the peak and of the force, with the run's name.
fn effectivities(known: &Known, order: usize, space: &str, refine: usize) -> (String, [Option<f64>; 3]) {
    let run = Run::case(known.case).set("mesh.order", order).set("mesh.refine", refine).set("exact.must_hold", false);
    let run = run.set("contact.seam.multiplier", space).set("output.fields", false);
    let ended = run.converged();
    let trace = ended.trace("seam");
    let error = true_error(&trace, zone_ends(&ended), known.pressure);
    let highest = trace.iter().map(|point| (known.pressure)(point.x)).fold(0.0, f64::max);
    let peak = 1.0 - highest / ended.number("/contact/seam/pressure_max");
    let force = 1.0 - known.force / ended.number("/contact/seam/force");
    let ratio = |key: &str, truth: f64| {
        // Errors of a few parts in 10⁴ are not asked for: some are zero by chance.
        let estimate = ended.value(&format!("/estimate/seam/{key}")).as_f64();
        estimate.filter(|_| truth.abs() > 3e-4).map(|estimate| estimate / truth.abs())
    };
    let name = format!("{}, P{order}/{space}, refine {refine}", known.case);
    (name, [ratio("lambda", error), ratio("peak", peak), ratio("force", force)])
}

/// An estimate that is too large by some factor costs a refinement, one that is too small costs trust.
#[test]
fn estimates_are_of_the_size_of_the_errors() {
    let ([mut lambda, mut peak, mut force], mut table) = ([Vec::new(), Vec::new(), Vec::new()], String::new());
    for known in &KNOWN {
        for (order, space) in PAIRS {
            for refine in (1..=3).filter(|refine| is_long() || refine % 2 == 1) {
                let (name, found) = effectivities(known, order, space, refine);
                writeln!(table, "{name}: {found:.2?}").expect("a string grows");
                [&mut lambda, &mut peak, &mut force].into_iter().zip(found).for_each(|(all, ratio)| all.extend(ratio));
            }
        }
    }
    let share = |all: &[f64], good: &dyn Fn(f64) -> bool| all.iter().filter(|v| good(**v)).count() as f64 / all.len() as f64;
    let near = |all: &[f64]| share(all, &|ratio| (0.5..=3.0).contains(&ratio));
    writeln!(table, "within .5 to 3: {:?}", [&lambda, &peak, &force].map(|all| (all.len(), near(all)))).expect("a string grows");
    let asked = [&lambda, &peak, &force].map(Vec::len);
    let least = if is_long() { [40, 30, 30] } else { [26, 20, 20] };
    assert!(asked.iter().zip(least).all(|(asked, least)| *asked > least), "{table}");
    assert!(lambda.iter().chain(&force).all(|ratio| *ratio >= 0.3), "{table}");
    assert!(near(&lambda) >= 0.85 && near(&force) >= 0.9, "{table}");
    assert!(share(&peak, &|ratio| ratio >= 0.3) >= 0.95, "{table}");
}

/// Without a coarser mesh the stresses tell: too much where bodies are bent, never too little.
#[test]
fn a_mesh_without_levels_has_an_estimate_of_its_pressure() {
    for known in &KNOWN {
        for (order, space) in [(1, "p0"), (2, "p1-discontinuous"), (2, "p1-continuous")] {
            let (name, [lambda, ..]) = effectivities(known, order, space, 0);
            assert!(lambda.is_none_or(|ratio| ratio > 0.5), "{name}: {lambda:?}");
        }
    }
}

/// A run that has converged of [`blocks_ended`].
fn blocks(edges: [usize; 2], case: &str, ranks: usize) -> Ended {
    let ended = blocks_ended(edges, case, ranks);
    assert_ne!(ended.value("/status"), "not_converged", "{}", ended.said());
    ended
}

/// Two blocks of 6 x 2, one on the other, with `edges` on the line between them; E = 1000, ν = 0.3.
fn blocks_ended(edges: [usize; 2], case: &str, ranks: usize) -> Ended {
    let block =
        |n: usize, seed: u64, from: f64| -> Block { grid(n, n.div_ceil(3), seed, |u, v| [6.0 * u - 3.0, from + 2.0 * v]) };
    let bodies = vec![
        ("lower", block(edges[0], 1, -2.0), ["bottom", "side", "lower.seam", "side.l"]),
        ("upper", block(edges[1], 2, 0.0), ["upper.seam", "side", "top", "side.l"]),
    ];
    let text = format!(
        r#"
body.lower = {{ young = 1000.0, poisson = 0.3 }}
body.upper = {{ young = 1000.0, poisson = 0.3 }}
support.bottom = {{ on = "bottom", uy = 0.0 }}
support.sides = {{ on = ["side", "side.l"], ux = 0.0 }}
output.fields = false
{case}"#
    );
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = write_scene(folder.path(), &Mesh { bodies }.text(), &text);
    Run::file(&file).ranks(ranks).ended()
}

/// Two humps, one wide, one narrower than an edge: the wide one is fine, the whole is not.
#[test]
fn a_second_zone_narrower_than_an_edge_is_not_trusted() {
    let case = |width: f64| {
        // Two wide humps are given ten times the load, so that they are resolved.
        let load = if width > 0.5 { 3.0 } else { 0.3 };
        format!(
            r#"mesh = {{ file = "mesh.msh", refine = 2 }}
load.top = {{ on = "top", pressure = {load} }}
contact.seam = {{ between = ["lower.seam", "upper.seam"], curve = "line", gap = "0.01*(1-exp(-((x+1.5)/0.8)^2)-exp(-((x-1.5)/{width})^2))" }}"#
        )
    };
    let trust = |width: f64, ranks: usize| {
        let ended = blocks([12, 14], &case(width), ranks);
        (ended.value("/contact/seam/trust"), ended.value("/reason").to_string())
    };
    for ranks in ranks_in_turn(0) {
        let (trusted, reason) = trust(0.08, ranks);
        assert!(trusted == false && reason.contains("contact at s = 4."), "{ranks} ranks: {reason}");
    }
    let (trusted, reason) = trust(0.8, 1);
    assert!(trusted == true, "{reason}");
}

/// Contact on a fifth of the length, under segments as long as that.
#[test]
fn too_few_segments_are_told_whatever_their_space() {
    for space in ["p0", "p1-discontinuous", "p1-continuous"] {
        for segments in [3, 5, 8] {
            let case = format!(
                r#"mesh = {{ file = "mesh.msh", refine = 2 }}
load.top = {{ on = "top", pressure = 0.3 }}
contact.seam = {{ between = ["lower.seam", "upper.seam"], curve = "line", gap = "0.01*(1-cos(pi*x/3))", multiplier = "{space}", segments = {segments} }}"#
            );
            let ended = blocks([12, 14], &case, 1);
            assert!(ended.value("/contact/seam/trust") != true, "{space}, {segments}: {}", ended.output);
            assert!(ended.errors.contains("warning"), "{}", ended.errors);
        }
    }
}

/// Edges 1:10 across the line, few of them: λ is off by a sixth, and no coarser mesh is there to tell.
#[test]
fn a_coarse_mesh_is_told_by_the_stresses() {
    let case = |pressure: &str| {
        format!(
            r#"mesh = {{ file = "mesh.msh", order = 1 }}
load.top = {{ on = "top", pressure = "{pressure}" }}
contact.seam = {{ between = ["lower.seam", "upper.seam"], curve = "line", gap = "closed", multiplier = "p0" }}"#
        )
    };
    let trust = |pressure: &str| blocks([8, 80], &case(pressure), 1).value("/contact/seam/trust");
    assert!(trust("1 + 0.33*x") != true, "a steep pressure");
    assert!(trust("1") == true, "an even pressure");
}

/// A clamped beam over a base, with a gap that is small beside the clamp and at a bump: Γ_C is what presses on the first mesh, at the
/// bump, and a zone beside the clamp that finer meshes see lies beyond it, which the last mesh takes up again.
#[test]
fn a_zone_that_lies_beyond_the_contact_boundary_is_taken_up_again() {
    let mesh = Mesh {
        bodies: vec![
            ("base", grid(36, 7, 11, |u, v| [22.0 * u, 4.0 * v - 4.0]), ["base.foot", "", "base.top", ""]),
            ("beam", grid(37, 7, 12, |u, v| [22.0 * u, 4.0 * v]), ["beam.low", "", "beam.top", "clamp"]),
        ],
    };
    let case = r#"
mesh = { file = "mesh.msh", order = 2 }
body.base = { young = 2.1e5, poisson = 0.3 }
body.beam = { young = 2.1e5, poisson = 0.45 }
support.foot = { on = "base.foot", ux = 0.0, uy = 0.0 }
support.clamp = { on = "clamp", ux = 0.0, uy = 0.0 }
load.top = { on = "beam.top", pressure = 100.0 }
contact.seam = { between = ["beam.low", "base.top"], gap = "0.02*(1-exp(-((x-15)/1)^2))*(1-exp(-(x/2)^2))" }
output.fields = false
"#;
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = write_scene(folder.path(), &mesh.text(), case);
    let run = |ends: &str| Run::file(&file).set("mesh.refine", 2).set("contact.seam.ends", ends).ranks(2).converged();
    let [free, whole] = ["free", "fixed"].map(run);
    let [found, force] = [&free, &whole].map(|ended| ended.number("/contact/seam/force"));
    assert!((found / force - 1.0).abs() < 1e-3, "{found} and {force}");
    assert_eq!(free.number("/contact/seam/missing_beyond"), 0.0, "{}", free.said());
}

/// A clamped beam over a wavy base, apart from it at rest: where it comes to lie Γ_C is not on the first mesh, and nothing presses there.
/// All of the contact is taken up by the last mesh, however narrow it is beside an edge.
#[test]
fn a_contact_that_is_lost_as_a_whole_is_taken_up_again() {
    let wave = |x: f64| {
        let turn = |period: f64, phase: f64| 2.0 * std::f64::consts::PI * x / period + phase;
        -0.0263 * (1.0 + turn(2.5, 3.26).cos()) - 0.008 * (1.0 + turn(1.823, 0.0).sin()) - 0.03
    };
    let mesh = Mesh {
        bodies: vec![
            (
                "base",
                grid(60, 8, 11, move |u, v| [10.0 * u, -4.0 * (1.0 - v) + v * wave(10.0 * u)]),
                ["foot", "", "base.top", ""],
            ),
            ("beam", grid(50, 5, 12, |u, v| [10.0 * u, 1.2 * v]), ["beam.low", "tip", "", "clamp"]),
        ],
    };
    let case = r#"
mesh = { file = "mesh.msh", order = 2 }
body.base = { young = 2.1e5, poisson = 0.3 }
body.beam = { young = 2.1e5, poisson = 0.3 }
geometry.wave = { curves = ["base.top"], x = "t", y = "-0.0263*(1+cos(2*pi*t/2.5+3.26))-0.008*(1+sin(2*pi*t/1.823))-0.03", t = [0.0, 10.0] }
support.foot = { on = "foot", ux = 0.0, uy = 0.0 }
support.clamp = { on = "clamp", ux = 0.0, uy = 0.0 }
support.tip = { on = "tip", ux = 0.0 }
load.tip = { on = "tip", traction = [0.0, -16.6] }
contact.seam = { between = ["base.top", "beam.low"] }
output.fields = false
"#;
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = write_scene(folder.path(), &mesh.text(), case);
    let found = Run::file(&file).set("accuracy.force", 0.02).ranks(2).ended().number("/contact/seam/force");
    let wanted = Run::file(&file).set("contact.seam.ends", "fixed").set("accuracy.force", 0.005).converged();
    let wanted = wanted.number("/contact/seam/force");
    assert!(wanted > 0.0 && (found / wanted - 1.0).abs() < 0.02, "{found} and {wanted}");
}

/// A beam on two humps that are alike, in one contact: by statics each carries half of the load. The sides touch first at both: a force
/// on one of them alone would let the beam turn.
#[test]
fn a_beam_rests_on_two_humps_of_one_contact() {
    let hump = |x: f64| -0.03 * (1.0 + (0.5 * std::f64::consts::PI * x).cos());
    let along = |u: f64| 10.0 * u - 5.0;
    let mesh = Mesh {
        bodies: vec![
            ("base", grid(50, 8, 11, move |u, v| [along(u), -5.0 * (1.0 - v) + v * hump(along(u))]), ["foot", "", "humps", ""]),
            ("beam", grid(40, 6, 12, move |u, v| [along(u), 2.0 * v]), ["beam.low", "", "beam.top", ""]),
        ],
    };
    let case = r#"
mesh = { file = "mesh.msh", order = 2, refine = 1 }
body.base = { young = 2.1e5, poisson = 0.3 }
body.beam = { young = 2.1e5, poisson = 0.3 }
geometry.humps = { curves = ["humps"], x = "t", y = "-0.03*(1+cos(2*pi*t/4))", t = [-5.0, 5.0] }
support.foot = { on = "foot", ux = 0.0, uy = 0.0 }
support.beam = { body = "beam", mean = true, ux = 0.0 }
load.top = { on = "beam.top", pressure = 20.0 }
contact.seam = { between = ["humps", "beam.low"] }
output.fields = false
"#;
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = write_scene(folder.path(), &mesh.text(), case);
    for between in [["humps", "beam.low"], ["beam.low", "humps"]] {
        let ended = Run::file(&file).set("contact.seam.between", format!("{between:?}")).ranks(2).converged();
        assert!((ended.number("/contact/seam/force") / 200.0 - 1.0).abs() < 1e-4, "{}", ended.said());
        let zones = ended.value("/contact/seam/zones");
        let shares: Vec<f64> =
            zones.as_array().expect("zones").iter().map(|zone| zone["share"].as_f64().expect("a share")).collect();
        assert!((shares[..shares.len() / 2].iter().sum::<f64>() - 0.5).abs() < 0.005, "{shares:?}");
    }
}

/// An interference of 2e-3 on a hump of the declared gap that is a tenth of an edge wide: the run says that its mesh does not see it, or
/// takes meshes that do.
#[test]
fn a_hump_of_the_declared_gap_between_the_nodes_is_seen() {
    let run = |accuracy: &str, ranks: usize| {
        let gap = "1e-3 - 3e-3*exp(-((x-0.13)/0.03)^2)";
        let case = format!(
            r#"mesh.file = "mesh.msh"
{accuracy}
support.lid = {{ on = "top", uy = 0.0 }}
contact.seam = {{ between = ["lower.seam", "upper.seam"], curve = "line", gap = "{gap}" }}"#
        );
        blocks_ended([12, 14], &case, ranks)
    };
    for ranks in [1, 2] {
        let ended = run("", ranks);
        assert_eq!((ended.code, ended.value("/contact/seam/trust")), (Some(3), false.into()), "{ranks} ranks: {}", ended.said());
    }
    let force = |goal: &str, ranks: usize| {
        let ended = run(&format!("accuracy.{goal}"), ranks);
        assert_eq!(ended.code, Some(0), "{goal}: {}", ended.said());
        ended.number("/contact/seam/force")
    };
    let fine = force("force = 1e-3", 1);
    assert!(fine > 0.1, "{fine}");
    for ranks in [1, 2] {
        let found = force("pressure = 1e-2", ranks);
        assert!((found / fine - 1.0).abs() < 1e-2, "{ranks} ranks: {found} instead of {fine}");
    }
}

/// Waves of the gap that are half an edge long, pressed to .9 of what flattens them (Westergaard): the first mesh has the same pressure
/// everywhere, and no difference between its refinements.
#[test]
fn waves_shorter_than_an_edge_have_their_peaks() {
    let (young, poisson) = (1000.0, 0.3);
    let flattens = std::f64::consts::PI * 0.5 * young / (1.0 - poisson * poisson) * 1e-3 / 0.1875;
    let load = 0.9 * flattens;
    let case = format!(
        "mesh.file = \"mesh.msh\"\naccuracy.pressure = 5e-2\nload.top = {{ on = \"top\", pressure = {load} }}\n
         contact.seam = {{ between = [\"lower.seam\", \"upper.seam\"], curve = \"line\", gap = \"1e-3*(1-cos(2*pi*x/0.1875))\" }}"
    );
    for ranks in [1, 2] {
        let ended = blocks_ended([16, 16], &case, ranks);
        let peak = ended.number("/contact/seam/pressure_max") / (2.0 * (load * flattens).sqrt());
        assert!(ended.code == Some(0) && (peak - 1.0).abs() < 0.04, "{ranks} ranks: {peak}, {}", ended.said());
    }
}

/// A flat punch whose rounded edges are contacts of their own: each carries 1 % of the force, and the largest pressure. What is asked for
/// of them is found, or said to be missed. The force of an edge on edges of a fortieth of its radius is .97.
#[test]
fn rounded_edges_beside_a_flat_are_no_contacts_without_force() {
    let round = |k: usize| 0.25 * std::f64::consts::FRAC_PI_4 * k as f64;
    let bottom = |k: usize| match k {
        0..4 => [-0.95 - 0.05 * round(4 - k).sin(), 0.05 - 0.05 * round(4 - k).cos()],
        4..=20 => [0.95 * (std::f64::consts::FRAC_PI_2 * (k as f64 - 12.0) / 8.0).sin(), 0.0],
        _ => [0.95 + 0.05 * round(k - 20).sin(), 0.05 - 0.05 * round(k - 20).cos()],
    };
    let mut punch = grid(24, 8, 0, |_, _| [0.0, 0.0]);
    for (at, point) in punch.points.iter_mut().enumerate() {
        let ([x, y], v) = (bottom(at % 25), (at / 25) as f64 / 8.0);
        *point = [x, y + v * v * (1.0 - y)];
    }
    let right = punch.sides[0].split_off(20);
    let flat = punch.sides[0].split_off(4);
    punch.sides = [flat, right, punch.sides[2].clone(), punch.sides[0].clone()];
    let bodies = vec![
        ("base", grid(40, 12, 5, |u, v| [4.0 * u - 2.0, 2.0 * v - 2.0]), ["foot", "", "base.top", ""]),
        ("punch", punch, ["flat", "right", "top", "left"]),
    ];
    let case = r#"
mesh.file = "mesh.msh"
body.base = { young = 1e5, poisson = 0.3 }
body.punch = { young = 1e5, poisson = 0.3 }
geometry.left = { curves = ["left"], circle = { centre = [-0.95, 0.05], radius = 0.05 } }
geometry.right = { curves = ["right"], circle = { centre = [0.95, 0.05], radius = 0.05 } }
support.foot = { on = "foot", ux = 0.0, uy = 0.0 }
support.guide = { body = "punch", mean = true, ux = 0.0 }
load.top = { on = "top", pressure = 50.0 }
contact.flat = { between = ["base.top", "flat"] }
contact.left = { between = ["base.top", "left"] }
contact.right = { between = ["base.top", "right"] }
accuracy = { pressure = 1e-2, max_unknowns = 110000 }
output.fields = false
"#;
    let folder = tempfile::tempdir().expect("a temporary folder");
    let ended = Run::file(&write_scene(folder.path(), &Mesh { bodies }.text(), case)).ranks(2).ended();
    for name in ["left", "right"] {
        let force = ended.number(&format!("/contact/{name}/force"));
        let is_right = (force / 0.97 - 1.0).abs() < 0.1;
        let is_told = ended.value(&format!("/contact/{name}/trust")) != true;
        assert!(is_right || is_told && ended.code == Some(3), "{name}: {force}, {}", ended.said());
    }
}
