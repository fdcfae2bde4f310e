//! Estimated discretisation errors against true ones, and solves that stop there.

use crate::support::mesh::{Mesh, grid, write_scene};
use crate::support::{Ended, Run, ranks_in_turn};
use std::path::Path;

fn effectivity(ended: &Ended, truth: f64) -> f64 {
    ended.number("/estimate/energy") / truth
}

/// Exact stresses: rings (interference) and the beam (tractions, a pressure that bends).
#[test]
fn the_energy_error_is_estimated_within_a_third_where_it_is_known() {
    for (case, body) in [("rings", "inner"), ("beam", "lower")] {
        for (order, space) in [(1, "p0"), (2, "p1-discontinuous"), (2, "p1-continuous")] {
            for refine in [2, 3] {
                let run = Run::case(case).set("mesh.order", order).set("mesh.refine", refine).set("exact.must_hold", false);
                let ended = run.set("contact.seam.multiplier", space).converged();
                let found = effectivity(&ended, ended.number(&format!("/errors/energy_norm_{body}")));
                assert!((0.7..1.5).contains(&found), "{case}, P{order}/{space}, refine {refine}: effectivity {found}");
            }
        }
    }
}

/// Corners: U - U_h is half the square of the error in the energy norm, because loads alone do the work.
#[test]
fn corners_are_seen() {
    for case in ["bars_inclined/even.toml", "bars_inclined/graded.toml"] {
        for (order, space) in [(1, "p0"), (2, "p1-discontinuous")] {
            let run = Run::case(case).set("mesh.order", order).set("contact.seam.segments", "auto").set("exact.must_hold", false);
            let ended = run.set("contact.seam.multiplier", space).ranks(2).converged();
            let found = effectivity(&ended, ended.number("/errors/energy").sqrt());
            assert!((0.7..1.5).contains(&found), "{case}, P{order}/{space}: effectivity {found}");
        }
    }
}

#[test]
fn the_verdict_tells_the_estimate_and_a_mesh_without_levels_has_one_of_its_pressure_alone() {
    let ended = Run::case("rings").set("exact.must_hold", false).converged();
    assert!(ended.value("/reason").as_str().expect("words").contains("estimated error"));
    let coarsest = Run::case("rings").set("exact.must_hold", false).set("mesh.refine", 0).converged();
    assert!(coarsest.value("/estimate/energy").is_null() && coarsest.value("/estimate/seam/force").is_null());
    assert!(coarsest.number("/estimate/seam/lambda") > ended.number("/estimate/seam/lambda"));
}

/// One difference between meshes tells what is left of an error by a share of itself, two by how they fall.
#[test]
fn the_error_of_the_force_follows_from_the_forces_on_coarser_meshes() {
    let runs = [0, 1, 2].map(|refine| {
        let run = Run::case("rings").set("mesh.order", 1).set("contact.seam.multiplier", "p0").set("mesh.refine", refine);
        run.set("exact.must_hold", false).set("output.fields", false).converged()
    });
    let force = runs.each_ref().map(|ended| ended.number("/contact/seam/force"));
    let [first, second] = [1, 2].map(|k| (1.0 - force[k - 1] / force[k]).abs());
    let falls = second / first;
    assert!((0.25..0.6).contains(&falls), "neither small by luck nor hardly falling: {falls}");
    let expected = [0.6 * first, second * falls / (1.0 - falls)];
    for (ended, expected) in runs[1..].iter().zip(expected) {
        let found = ended.number("/estimate/seam/force");
        assert!((found / expected - 1.0).abs() < 0.02, "{found} instead of {expected}");
    }
}

/// `tolerance = "discretisation"`: fewer iterations, and the same errors but for a tenth.
#[test]
fn a_solve_to_the_discretisation_error_is_as_good() {
    for case in ["bars_inclined", "rings", "beam"] {
        for (order, space) in [(1, "p0"), (2, "p1-discontinuous")] {
            let run = |tolerance: &str| {
                let run = Run::case(case).set("mesh.order", order).set("exact.must_hold", false).ranks(2);
                run.set("contact.seam.multiplier", space).set("solver.tolerance", tolerance).converged()
            };
            let [exact, enough] = ["1e-10", "discretisation"].map(run);
            assert!(enough.iterations() < exact.iterations(), "{case}, P{order}");
            let [a, b] = [&exact, &enough].map(|ended| ended.number("/errors/lambda_seam"));
            // Where λ is good to six digits the least tolerance, 1e-8, decides.
            assert!(b < 1.1 * a || b < 5e-5, "{case}, P{order}: error of lambda {a} becomes {b}");
            let [a, b] = [&exact, &enough].map(|ended| ended.number("/energy/total"));
            assert!((b / a - 1.0).abs() < 0.01 * exact.number("/estimate/energy"), "{case}, P{order}: {a} becomes {b}");
        }
    }
}

/// A half cylinder that touches a fifth of its boundary: λ is compared where it presses.
#[test]
fn the_pressure_of_a_contact_that_closes_in_part_is_measured_there() {
    let ended = Run::file(&Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/first/case.toml")).converged();
    assert!(ended.number("/estimate/seam/lambda") < 0.01);
    assert_eq!(ended.value("/contact/seam/trust"), true);
}

/// A narrow block joined to a wide one: λ is singular at both corners, whether it presses or pulls.
#[test]
fn what_pulls_is_judged_as_what_presses() {
    let lower = grid(8, 4, 5, |u, v| [4.0 * u, v]);
    let upper = grid(6, 4, 6, |u, v| [1.0 + 2.0 * u, 1.0 + v]);
    let mesh = Mesh {
        bodies: vec![("lower", lower, ["bottom", "", "lower.seam", ""]), ("upper", upper, ["upper.seam", "", "top", ""])],
    };
    let case = r#"
mesh = { file = "mesh.msh", refine = 3 }
body.lower = { young = 1000.0, poisson = 0.3 }
body.upper = { young = 1000.0, poisson = 0.3 }
support.bottom = { on = "bottom", ux = 0.0, uy = 0.0 }
support.mean = { body = "upper", mean = true, ux = 0.0 }
load.top = { on = "top", pressure = 1.0 }
contact.joint = { between = ["lower.seam", "upper.seam"], law = "bilateral" }
"#;
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = write_scene(folder.path(), &mesh.text(), case);
    for (at, space) in ["p0", "p1-discontinuous", "p1-continuous"].into_iter().enumerate() {
        for ranks in ranks_in_turn(at) {
            let [pressed, pulled] = [1.0, -1.0].map(|pressure| {
                let run = Run::file(&file).ranks(ranks).set("contact.joint.multiplier", space);
                run.set("load.top.pressure", pressure).converged()
            });
            let verdict = |ended: &Ended| ended.value("/contact/joint/verdict");
            assert_eq!(verdict(&pulled), verdict(&pressed), "{space}");
            assert_eq!(pulled.value("/contact/joint/trust"), true, "{space}");
            assert!(verdict(&pulled).as_str().is_some_and(|words| words.ends_with("towards an end")), "{}", verdict(&pulled));
            let peak = |ended: &Ended| ended.number("/contact/joint/zones/0/pressure_max");
            assert!((peak(&pulled) - peak(&pressed)).abs() < 1e-6 * peak(&pressed), "{space}");
        }
    }
}
