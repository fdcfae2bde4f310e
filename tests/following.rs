//! Contact boundaries that follow the bodies: every run of a grid ends, and what does not move is not solved again.

use crate::support::mesh::{Mesh, grid, write_scene};
use crate::support::{Ended, PAIRS, Run, is_long};

/// Contact boundaries that were solved for.
fn fits(ended: &Ended) -> usize {
    ended.value("/boundaries").as_array().expect("a list").len()
}

/// Largest pressure by that of Hertz for the same force, `p₀² = 2 F E* / (π R)` with `F` the force on half of the bodies.
fn by_hertz(ended: &Ended) -> f64 {
    let modulus = 7000.0 / (2.0 * (1.0 - 0.227 * 0.227));
    let peak = (2.0 * ended.number("/contact/seam/force") * modulus / std::f64::consts::PI).sqrt();
    ended.number("/contact/seam/pressure_max") / peak
}

/// Mesh sizes, segments, spaces and loads; 60 runs, half of them if not all is asked for, each in at most 12 fits. Forces of the
/// same load agree, and pressures that are to be trusted with Hertz.
#[test]
fn a_cylinder_on_a_block_converges_for_all_meshes_segments_spaces_and_loads() {
    for load in [0.015, 0.006].into_iter().take(if is_long() { 2 } else { 1 }) {
        let (mut forces, mut trusted) = (Vec::new(), 0);
        for (order, space) in PAIRS.into_iter().filter(|pair| *pair != (1, "p1-discontinuous")) {
            for refine in 1..=3 {
                for segments in ["auto", "6"] {
                    let run = Run::case("hertz").set("exact.must_hold", false).set("support.press.uy", -load);
                    let run = run.set("mesh.order", order).set("mesh.refine", refine);
                    let ended = run.set("contact.seam.multiplier", space).set("contact.seam.segments", segments).converged();
                    let found = ended.number("/contact/seam/force");
                    let words = format!("P{order}/{space}, refine {refine}, {segments} segments, load {load}: {found}");
                    println!("{words}, {} fits, {} times Hertz", fits(&ended), by_hertz(&ended));
                    assert!(fits(&ended) <= 12, "{words}");
                    let is_trusted = ended.value("/contact/seam/trust") == true;
                    trusted += usize::from(is_trusted);
                    assert!(!is_trusted || (by_hertz(&ended) - 1.0).abs() < 0.03, "{words}: {} times Hertz", by_hertz(&ended));
                    forces.push(found);
                }
            }
        }
        // The last run is one of P2 on the finest mesh.
        let last = forces[forces.len() - 1];
        assert!(forces.iter().all(|force| (force / last - 1.0).abs() < 0.04), "load {load}: {forces:?}");
        assert!(3 * trusted > forces.len(), "load {load}: {trusted} of {} pressures are to be trusted", forces.len());
    }
}

/// Coarser meshes find boundary and set: about one linear solve is left for the finest.
#[test]
fn the_finest_mesh_costs_about_one_linear_solve() {
    // One linear problem takes 9 to 12 iterations to the same tolerance.
    for (case, refine, most_fits, most_iterations) in [
        ("hertz", 4, 1, 8),
        ("hertz/deformed.toml", 3, 2, 12),
        ("hertz_discs", 3, 2, 16),
        ("pin", 3, 1, 14),
        ("bars_parabola", 5, 0, 16),
    ] {
        let ended = Run::case(case).set("mesh.refine", refine).set("output.fields", false).converged();
        let (fits, iterations) = (fits(&ended), ended.iterations());
        assert!(fits <= most_fits && iterations <= most_iterations, "{case}: {fits} fits, {iterations} iterations");
    }
}

/// Bodies that touch from the start along the whole of their boundaries: one fit is all.
#[test]
fn a_closed_contact_is_fitted_once() {
    for case in ["patch_inclined", "rings"] {
        let ended = Run::case(case).set("exact.must_hold", false).set("contact.seam.curve", "fit").ranks(2).converged();
        assert_eq!(fits(&ended), 1, "{case}");
    }
}

/// A declared straight line over a closed contact is one linear solve.
#[test]
fn a_declared_bilateral_contact_is_one_solve() {
    let ended = Run::case("bars_inclined").set("contact.seam.law", "bilateral").ranks(2).converged();
    assert_eq!((fits(&ended), ended.value("/outer").as_array().expect("a list").len()), (0, 1));
}

/// The end of contact of the parabola, far from any mesh node, by the pressure next to it.
#[test]
fn a_free_end_lies_where_contact_ends() {
    let run = Run::case("bars_parabola").set("exact.must_hold", false).set("contact.seam.ends", "free").ranks(2);
    let ended = run.set("contact.seam.segments", 140).converged();
    let end = ended.number("/contact/seam/ends/1/0");
    assert!((end - 3.910056179).abs() < 0.004, "{end}");
    assert!((ended.number("/contact/seam/force") / 4.4606591682 - 1.0).abs() < 2e-4);
}

/// Bodies that are drawn apart while contact follows them: they part, and the pressure is zero.
#[test]
fn held_bodies_that_part_have_no_pressure() {
    let ended = Run::case("hertz").set("exact.must_hold", false).set("support.press.uy", 0.01).set("mesh.refine", 1).converged();
    assert!(ended.trace("seam").iter().all(|point| point.lambda == 0.0 && point.gap > 0.0));
}

/// Moments and forces of both bodies balance on the deformed bodies too.
#[test]
fn forces_balance_in_the_deformed_configuration() {
    let run =
        Run::case("hertz/deformed.toml").set("exact.must_hold", false).set("mesh.refine", 2).set("solver.tolerance", "1e-11");
    let ended = run.ranks(2).converged();
    for balance in ["force", "moment", "energy", "bodies"] {
        let found = ended.number(&format!("/balance/{balance}"));
        assert!(found < 1e-8, "{balance}: {found}");
    }
}

/// Graded segments resolve the end of contact better than as many even ones.
#[test]
fn graded_segments_are_shorter_at_the_end_that_asks() {
    let run = Run::case("hertz").set("exact.must_hold", false).set("mesh.refine", 2).set("contact.seam.segments", 8);
    let ended = run.set("contact.seam.grading", "[1, 4]").set("contact.seam.stabilise", false).converged();
    let mut ends: Vec<f64> = ended.trace("seam").windows(2).filter(|pair| pair[0].s == pair[1].s).map(|pair| pair[0].s).collect();
    ends.insert(0, 0.0);
    ends.push(ended.number("/contact/seam/length"));
    assert_eq!(ends.len(), 9);
    let length = |k: usize| ends[k + 1] - ends[k];
    assert!(length(0) > 2.5 * length(7) && (length(0) / length(3) - 1.0).abs() < 1e-6, "{ends:?}");
}

/// Half of a parabola of radius 1 on half of a block.
const PARABOLA: &str = r#"
mesh = { file = "mesh.msh", order = 2, refine = 0 }
body.lower = { young = 7000.0, poisson = 0.227 }
body.upper = { young = 7000.0, poisson = 0.227 }
support.table = { on = "bottom", uy = 0.0 }
support.symmetry = { on = "left", ux = 0.0 }
load.top = { on = "top", pressure = 3.6 }
contact.seam = { between = ["lower.seam", "upper.seam"], curve = "fit" }
output.fields = false
"#;

/// On a mesh too fine for the programme of the first mesh, Γ_C begins as narrow as two edges, and forces place it.
#[test]
fn forces_place_the_boundary_where_the_programme_is_dear() {
    let graded = |v: f64| 0.1 * v + 0.9 * v * v;
    let lower = grid(110, 100, 1, |u, v| [2.0 * graded(u), -2.0 * graded(1.0 - v)]);
    let upper = grid(100, 100, 2, |u, v| {
        let foot = 0.5 * graded(u) * graded(u);
        [graded(u), foot + (1.0 - foot) * graded(v)]
    });
    let bodies =
        vec![("lower", lower, ["bottom", "", "lower.seam", "left"]), ("upper", upper, ["upper.seam", "", "top", "left"])];
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = write_scene(folder.path(), &Mesh { bodies }.text(), PARABOLA);
    let ended = Run::file(&file).ranks(2).converged();
    let (peak, force) = (by_hertz(&ended), ended.number("/contact/seam/resultant/1").abs());
    assert!((force / 3.6 - 1.0).abs() < 1e-6, "{force}");
    // The parabola is 20 half widths high.
    assert!((peak - 1.0).abs() < 0.02, "{peak}");
    assert!(fits(&ended) <= 4, "{} boundaries", fits(&ended));
}

/// A tee on a base, its flange under two heads, is drawn up by its web: each head presses from its one edge to the other, and its boundary begins
/// with a part of that on the first mesh. Both find all of it in a few fits.
#[test]
fn heads_on_a_flange_press_over_all_of_their_width() {
    let case = r#"
mesh = { file = "mesh.msh", order = 2, refine = 2 }
body."*" = { young = 210e3, poisson = 0.3 }
contact.base = { between = ["base.top", "tee.low"] }
contact.left = { between = ["flange.left", "left.low"] }
contact.right = { between = ["flange.right", "right.low"] }
support.base = { on = "base.bottom", ux = 0.0, uy = 0.0 }
support.heads = { on = "*.high", ux = 0.0, uy = -0.004 }
support.tee = { body = "tee", mean = true, ux = 0.0 }
load.web = { on = "web.top", traction = [0.0, 80.0] }
output.fields = false
"#;
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = write_scene(folder.path(), include_str!("meshes/tee_under_heads.msh"), case);
    for ranks in [1, 2] {
        let ended = Run::file(&file).ranks(ranks).converged();
        // The same scene on edges of a quarter.
        for name in ["left", "right"] {
            let force = ended.number(&format!("/contact/{name}/force"));
            assert!((force / 886.06 - 1.0).abs() < 2e-3, "{name} {force}: {}", ended.said());
        }
        assert!(fits(&ended) <= 8, "{} fits: {}", fits(&ended), ended.said());
    }
}
