//! Classical contacts whose end, or whose singular pressure, is known: what happens there, not only how large the pressure is.

use crate::support::{Ended, RANKS, Run, difference, ranks_in_turn};

/// Runs a case on 1, 2 and 3 ranks: force and energy must be the same, and so must the pressure, or where the boundary
/// follows it, its length. The run on one rank.
fn on_all_ranks(case: &str) -> Ended {
    let run = |ranks| Run::case(case).set("solver.tolerance", "1e-11").ranks(ranks).converged();
    let [one, others @ ..] = RANKS.map(run);
    let follows = case != "punch";
    for (other, ranks) in others.iter().zip(&RANKS[1..]) {
        let mut offs = ["/contact/seam/force", "/energy/total", "/contact/seam/length"]
            .map(|path| (path, difference(&[other.number(path)], &[one.number(path)]), 1e-8));
        if follows {
            // The boundary stands when it moves by less than 1e-5 of its length.
            offs[2].2 = 1e-6;
        } else {
            let pressure = |ended: &Ended| ended.trace("seam").iter().map(|point| point.lambda).collect::<Vec<f64>>();
            offs[2] = ("the pressure", difference(&pressure(other), &pressure(&one)), 1e-8);
        }
        for (name, off, limit) in offs {
            println!("{case}, {ranks} ranks: {name} differs by {off:.1e}");
            assert!(off <= limit, "{case}, {ranks} ranks: {name} differs by {off:e}, limit {limit:e}");
        }
    }
    one
}

fn near(found: f64, wanted: f64, tolerance: f64, words: &str) {
    println!("{words}: {found:.6}, known {wanted}");
    assert!((found - wanted).abs() <= tolerance, "{words}: {found}, known {wanted}, tolerance {tolerance}");
}

/// With ends that do not follow the pressure the active set alone finds the end, to within the segment that holds it.
fn ends_by_the_active_set(case: &str, segments: usize, end: f64) {
    let run = Run::case(case).ranks(2).set("contact.seam.ends", "fixed").set("contact.seam.segments", segments);
    let ended = run.converged();
    let segment = ended.number("/contact/seam/length") / segments as f64;
    near(ended.number("/contact/seam/closed/0/1"), end, segment, &format!("{case}: end by the active set"));
    let beyond: Vec<_> = ended.trace("seam").into_iter().filter(|point| point.s > end + segment).collect();
    assert!(!beyond.is_empty() && beyond.iter().all(|point| point.gap > 0.0 && point.lambda == 0.0), "{case} opens beyond");
}

/// A half cylinder on a block, from hp finite elements: vertical force, pressure in the middle, half width.
#[test]
fn a_cylinder_on_a_block_in_the_reference_configuration() {
    let one = on_all_ranks("hertz");
    near(one.number("/contact/seam/resultant/1"), 7.7777, 7.7777 * 3e-4, "force");
    near(one.trace("seam")[0].lambda, 135.326, 135.326 * 2e-3, "pressure in the middle");
    near(one.number("/contact/seam/ends/1/0"), 0.07316, 0.07316 * 1e-2, "half width");
}

/// The stiff body's own forces, by its prescribed displacement, are far above those of contact: these must be solved for all
/// the same. From 10⁴ on the cylinder is rigid, and its modulus changes nothing.
#[test]
fn a_cylinder_however_stiff_presses_as_a_rigid_one() {
    let force = |young: &str| {
        let run = Run::case("hertz").ranks(2).set("mesh.refine", 2).set("exact.must_hold", false);
        run.set("body.cylinder.young", young).converged().number("/contact/seam/force")
    };
    let stiff = force("7e7");
    for (young, tolerance) in [("7e8", 1e-3), ("7e10", 1e-3)] {
        near(force(young), stiff, stiff * tolerance, &format!("force, E = {young}"));
    }
}

#[test]
fn a_cylinder_on_a_block_in_the_deformed_configuration() {
    let one = on_all_ranks("hertz/deformed.toml");
    near(one.trace("seam")[0].lambda, 136.981, 136.981 * 2e-3, "pressure in the middle");
    near(one.number("/contact/seam/ends/1/0"), 0.07239, 0.07239 * 1e-2, "half width");
}

/// Hertz's formulas; Γ_C is the line of symmetry.
#[test]
fn two_discs_meet_as_hertz_says() {
    let one = on_all_ranks("hertz_discs");
    let trace = one.trace("seam");
    near(trace[0].lambda, 27.472527, 27.472527 * 2e-3, "pressure in the middle");
    near(one.number("/contact/seam/ends/1/0"), 0.05, 0.05 * 1e-2, "half width");
    assert!(trace.iter().all(|point| point.x[1].abs() < 2e-3 * 0.05), "the fit leaves the line of symmetry");
}

/// Persson's solution: 84.828 degrees and p(0) R/Q = .599629, whatever the load.
#[test]
fn a_pin_that_fits_touches_the_same_arc_under_any_load() {
    let one = on_all_ranks("pin");
    let force = "[0, \"-3000*(2 - (x^2 + y^2)/(2*0.15^2))*exp(-(x^2 + y^2)/(2*0.15^2))/(2*pi*0.15^2)\"]";
    let run = Run::case("pin").ranks(2).set("body.pin.body_force", force).set("exact.must_hold", false);
    for (ended, load) in [(&one, 1.0), (&run.converged(), 3000.0)] {
        near(ended.number("/contact/seam/length").to_degrees(), 84.8279456, 0.1, &format!("half angle, load {load}"));
        near(ended.trace("seam")[0].lambda / load, 0.599628669, 1e-3, &format!("pressure at the bottom, load {load}"));
        near(ended.number("/contact/seam/resultant/1") / load, 0.5, 1e-6, &format!("vertical force, load {load}"));
    }
    ends_by_the_active_set("pin", 64, 84.8279456_f64.to_radians());
}

/// All closed, as the loop begins, the pin would hang in its hole: every multiplier pulls, and none may let go of it.
/// Persson with the clearance ΔR, and E' = E/(1 - ν²): π E' ΔR/Q = (2 - 2b⁴ - ln(1 + b²))/(b²(1 + b²)), b = tan(θ/2).
#[test]
fn a_pin_with_clearance_falls_to_the_bottom_of_its_hole() {
    let clearance = 1e-4;
    let wanted = std::f64::consts::PI * 7000.0 / (1.0 - 0.227 * 0.227) * clearance;
    let load = |half: f64| {
        let square = (0.5 * half).tan().powi(2);
        (2.0 - 2.0 * square * square - (1.0 + square).ln()) / (square * (1.0 + square))
    };
    // `load` falls from infinity to zero at the half angle of a neat fit.
    let (mut low, mut high) = (0.1, 84.8279456_f64.to_radians());
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if load(middle) > wanted { low = middle } else { high = middle }
    }
    for ranks in ranks_in_turn(1) {
        let run = Run::case("pin").ranks(ranks).set("contact.seam.gap", clearance).set("exact.must_hold", false);
        let ended = run.set("solver.tolerance", "1e-11").converged();
        near(ended.number("/contact/seam/resultant/1"), 0.5, 1e-6, "vertical force");
        near(ended.number("/contact/seam/length").to_degrees(), low.to_degrees(), 0.2, "half angle");
    }
}

/// The layer's own integral equation: see its README.
#[test]
fn a_layer_lifts_off_where_it_is_known_to() {
    let one = on_all_ranks("receding_layer");
    near(one.number("/contact/seam/length"), 1.324165372, 0.005, "half width");
    near(one.trace("seam")[0].lambda, 0.713080551, 2e-3, "pressure below the load");
    ends_by_the_active_set("receding_layer", 48, 1.324165372);
}

/// p ~ r^(s - 1), where sin(πs)/(2 sin²(πs/2) - 2 s²) + cot(πs) = 0: s = .774013.
#[test]
fn pressure_at_the_corner_of_a_block_has_the_known_exponent() {
    // Nearer the corner the elements end, farther away the next term comes in: r^.573.
    let trace = on_all_ranks("punch").trace("seam");
    let logarithms = trace.iter().map(|point| (1.0 - point.s, point.lambda)).filter(|(r, _)| (3e-3..3e-2).contains(r));
    let points: Vec<(f64, f64)> = logarithms.map(|(r, lambda)| (r.ln(), lambda.ln())).collect();
    let mean = |of: fn(&(f64, f64)) -> f64| points.iter().map(of).sum::<f64>() / points.len() as f64;
    let (x, y) = (mean(|p| p.0), mean(|p| p.1));
    let slope = points.iter().map(|p| (p.0 - x) * (p.1 - y)).sum::<f64>() / points.iter().map(|p| (p.0 - x).powi(2)).sum::<f64>();
    near(slope, -0.225987, 2e-3, &format!("exponent from {} points", points.len()));
}
