//! Scenes with smooth exact solutions beside the plain rings: errors fall with the order of the elements.

mod support;

use support::Run;

/// Largest error among those whose names start so.
fn largest(errors: &serde_json::Value, start: &str) -> f64 {
    let errors = errors.as_object().expect("errors by name").iter();
    errors.filter(|(name, _)| name.starts_with(start)).map(|(_, e)| e.as_f64().expect("a number")).fold(0.0, f64::max)
}

/// Largest energy-norm error of a body, and the L2 error of λ.
fn errors(case: &str, order: usize, space: &str, refine: usize) -> [f64; 2] {
    let run = Run::case(case).ranks(2).set("mesh.order", order).set("mesh.refine", refine);
    let run = run.set("contact.seam.multiplier", space).set("exact.must_hold", false).set("solver.tolerance", "1e-10");
    let errors = run.converged().value("/errors");
    ["energy_norm_", "lambda_"].map(|start| largest(&errors, start))
}

/// Mean orders over three refinements, of the energy norm and of λ, are at least these.
fn orders(case: &str, order: usize, space: &str, coarsest: usize, least: [f64; 2]) {
    let all = [0, 1, 2, 3].map(|r| errors(case, order, space, coarsest + r));
    for (k, name) in ["energy", "pressure"].into_iter().enumerate() {
        let found = (all[0][k] / all[3][k]).log2() / 3.0;
        println!("{case}, P{order}, {space}: {name} of order {found:.3}: {:?}", all.map(|e| e[k]));
        assert!(found >= least[k], "{case}, P{order}, {space}: {name} of order {found:.3}: {:?}", all.map(|e| e[k]));
    }
}

#[test]
fn rings_under_a_pressure_that_varies_around_them() {
    for case in ["rings_michell", "rings_michell/stiff.toml"] {
        orders(case, 2, "p1-discontinuous", 1, [1.8, 1.8]);
        orders(case, 2, "p1-continuous", 1, [1.8, 1.8]);
        orders(case, 1, "p0", 2, [0.9, 0.9]);
    }
}

#[test]
fn layers_bent_together() {
    orders("beam", 2, "p1-discontinuous", 1, [1.8, 1.8]);
    orders("beam", 2, "p1-continuous", 1, [1.8, 1.8]);
    orders("beam", 1, "p0", 2, [0.9, 0.9]);
}

#[test]
fn contact_that_ends_with_p1_continuous() {
    orders("open_zone", 2, "p1-discontinuous", 1, [1.8, 1.4]);
    orders("open_zone", 2, "p1-continuous", 1, [1.8, 1.4]);
}

#[test]
fn contact_that_ends_with_p0() {
    orders("open_zone", 1, "p0", 2, [0.9, 0.9]);
}

/// λ of Michell's rings at 0, 30, 45, 60 and 90 degrees.
#[test]
fn pressure_around_the_rings() {
    let points = "{ at = [[2, 0], [1.7320508075688772, 1], [1.4142135623730951, 1.4142135623730951], [1, 1.7320508075688772], [0, 2]], \
                  value = [2.2971282547, 2.0028785483, 1.7086288418, 1.4143791354, 1.1201294289], tolerance = 2e-3 }";
    let ended = Run::case("rings_michell").ranks(2).set("exact.contact.seam.lambda", points).converged();
    println!("largest error of the pressure at five points: {:.2e}", ended.number("/errors/lambda_seam"));
}
