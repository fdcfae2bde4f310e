//! Scenes with smooth exact solutions beside the plain rings: errors fall with the order of the elements.

use crate::support::{Run, TracePoint};

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

/// Errors of λ at the two Gauss points of each segment, in the mean square: there the linear function that is next to a smooth one
/// has an error of higher order.
fn error_at_gauss_points(trace: &[TracePoint], exact: impl Fn([f64; 2]) -> f64) -> f64 {
    let (mut square, mut length) = (0.0, 0.0);
    // Two points at one place are the end of a segment and the beginning of the next.
    for segment in trace.chunk_by(|a, b| b.s - a.s > 1e-12) {
        let [first, last] = [segment[0], segment[segment.len() - 1]];
        for gauss in [-1.0, 1.0].map(|sign: f64| 0.5 + sign * (1.0_f64 / 12.0).sqrt()) {
            let x = [0, 1].map(|k| first.x[k] + gauss * (last.x[k] - first.x[k]));
            let lambda = first.lambda + gauss * (last.lambda - first.lambda);
            square += 0.5 * (last.s - first.s) * (lambda - exact(x)).powi(2);
        }
        length += last.s - first.s;
    }
    (square / length).sqrt()
}

/// P2 with discontinuous linear multipliers, where all is smooth: the displacement is of third order (at the nodes of higher),
/// λ of second, as linear functions are, and at their Gauss points of order 2.5.
#[test]
fn rates_of_smooth_solutions() {
    type Lambda = fn([f64; 2]) -> f64;
    let upright: Lambda = |x| 0.8 + 0.3 * (2.0 * x[1]).cos();
    let under: Lambda = |x| 1.0 + 0.4 * x[0].sin();
    let contacts = [("upright", upright), ("under_left", under), ("under_right", under)];
    let of = |refine: usize| {
        let run = Run::case("three_bodies").ranks(2).set("mesh.refine", refine).set("exact.must_hold", false);
        let ended = run.set("solver.tolerance", "1e-11").converged();
        let errors = ended.value("/errors");
        let gauss = contacts.map(|(name, exact)| error_at_gauss_points(&ended.trace(name), exact));
        let gauss = gauss.into_iter().fold(0.0, f64::max);
        [largest(&errors, "u_"), largest(&errors, "energy_norm_"), largest(&errors, "lambda_"), gauss]
    };
    let (coarse, fine) = (of(1), of(4));
    for (k, (name, least)) in
        [("u", 3.0), ("energy", 1.95), ("pressure", 1.95), ("pressure at Gauss points", 2.3)].into_iter().enumerate()
    {
        let found = (coarse[k] / fine[k]).log2() / 3.0;
        println!("{name} of order {found:.3}: {:.2e}, {:.2e}", coarse[k], fine[k]);
        assert!(found >= least, "{name} of order {found:.3}: {:e}, {:e}", coarse[k], fine[k]);
    }
}

/// λ of Michell's rings at 0, 30, 45, 60 and 90 degrees.
#[test]
fn pressure_around_the_rings() {
    let points = "{ at = [[2, 0], [1.7320508075688772, 1], [1.4142135623730951, 1.4142135623730951], [1, 1.7320508075688772], [0, 2]], \
                  value = [2.2971282547, 2.0028785483, 1.7086288418, 1.4143791354, 1.1201294289], tolerance = 2e-3 }";
    let ended = Run::case("rings_michell").ranks(2).set("exact.contact.seam.lambda", points).converged();
    println!("largest error of the pressure at five points: {:.2e}", ended.number("/errors/lambda_seam"));
}
