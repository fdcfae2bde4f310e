//! Contacts whose pressure is known in closed form, beside those of classics.rs: where they end, what they carry, and how the
//! error falls with the mesh.

use crate::support::{Ended, RANKS, Run, TracePoint, difference};
use std::f64::consts::{FRAC_PI_2, PI};

/// 1/E* of the two half-planes of `steuermann` and `rounded_punch`.
const COMPLIANCE: f64 = (1.0 - 0.227 * 0.227) / 7000.0 + (1.0 - 0.3 * 0.3) / 3000.0;

fn near(found: f64, wanted: f64, tolerance: f64, words: &str) {
    println!("{words}: {found:.6}, known {wanted:.6}");
    assert!((found - wanted).abs() <= tolerance, "{words}: {found}, known {wanted}, tolerance {tolerance}");
}

/// A case on 1, 2 and 3 ranks: force, energy and the length of the contact are the same. The run on one rank.
fn on_all_ranks(case: &str, contact: &str) -> Ended {
    let run = |ranks| Run::case(case).set("solver.tolerance", "1e-11").ranks(ranks).converged();
    let [one, others @ ..] = RANKS.map(run);
    for other in others {
        // The boundary stands when it moves by less than 1e-5 of its length; force and energy depend on it in the square.
        for (path, limit) in [("force", 1e-8), ("length", 1e-6)] {
            let path = format!("/contact/{contact}/{path}");
            let off = difference(&[other.number(&path)], &[one.number(&path)]);
            assert!(off <= limit, "{case}: {path} differs by {off:e}");
        }
        let off = difference(&[other.number("/energy/total")], &[one.number("/energy/total")]);
        assert!(off <= 1e-8, "{case}: energy differs by {off:e}");
    }
    one
}

/// Relative error of λ in the mean square, over the part of the trace where `within` holds.
fn pressure_error(trace: &[TracePoint], exact: impl Fn(&TracePoint) -> f64, within: impl Fn(&TracePoint) -> bool) -> f64 {
    let (mut off, mut size) = (0.0, 0.0);
    for ends in trace.windows(2).filter(|ends| ends.iter().all(&within)) {
        let weight = 0.5 * (ends[1].s - ends[0].s);
        for point in ends {
            let known = exact(point);
            off += weight * (point.lambda - known).powi(2);
            size += weight * known * known;
        }
    }
    assert!(size > 0.0, "some of the trace is within");
    (off / size).sqrt()
}

/// Mean order over the refinements from 1 to 3 of the error in the inner 60 per cent of a contact that ends at x = `end`.
fn inner_order(case: &str, end: f64, exact: impl Fn(f64) -> f64, least: f64) {
    let errors = [1, 2, 3].map(|refine| {
        let ended = Run::case(case).ranks(2).set("mesh.refine", refine).set("exact.must_hold", false).converged();
        pressure_error(&ended.trace("seam"), |point| exact(point.x[0]), |point| point.x[0] < 0.6 * end)
    });
    let order = (errors[0] / errors[2]).log2() / 2.0;
    println!("{case}: inner pressure of order {order:.2}: {errors:?}");
    assert!(order >= least, "{case}: inner pressure of order {order}: {errors:?}");
}

/// Where the contact of a half model ends.
fn end(ended: &Ended) -> f64 {
    ended.number("/contact/seam/ends/1/0")
}

/// Westergaard: p = 2 p̄ cos ψ √(sin²ψa - sin²ψ)/sin²ψa, ψ = πx/2, `share` = sin²ψa = p̄/p*.
fn wave(share: f64, x: f64) -> f64 {
    let full = PI * 1000.0 / (2.0 * (1.0 - 0.09)) * 0.01 / 2.0;
    let psi = FRAC_PI_2 * x;
    2.0 * full * psi.cos() * (share - psi.sin().powi(2)).max(0.0).sqrt()
}

#[test]
fn a_wave_is_pressed_flat_on_half_of_its_length() {
    let one = on_all_ranks("westergaard", "seam");
    near(end(&one), 0.5, 5e-3, "half width");
    near(one.trace("seam")[0].lambda, 12.2055, 12.2055 * 2e-3, "pressure at the crest");
    inner_order("westergaard", 0.5, |x| wave(0.5, x), 1.8);
}

/// An island of a tenth of the width is left open. The end is found to within an edge.
#[test]
fn a_wave_just_before_it_is_flat() {
    let one = on_all_ranks("westergaard/full.toml", "seam");
    near(end(&one), 0.98_f64.sqrt().asin() / FRAC_PI_2, 0.0157, "half width");
    assert!(end(&one) < 1.0, "an island is left");
    inner_order("westergaard/full.toml", 0.9097, |x| wave(0.98, x), 1.8);
}

/// Beyond the full pressure all is in contact, and the pressure is p̄ + p* cos 2πx/L.
#[test]
fn a_wave_that_is_flat() {
    let ended = Run::case("westergaard").ranks(2).set("load.top.pressure", 10.0).set("exact.must_hold", false).converged();
    near(end(&ended), 1.0, 1e-9, "half width");
    let full = PI * 1000.0 / (2.0 * 0.91) * 0.01 / 2.0;
    let error = pressure_error(&ended.trace("seam"), |point| 10.0 + full * (PI * point.x[0]).cos(), |_| true);
    assert!(error < 1e-3, "pressure off by {error:e}");
}

/// Steuermann, with A = 1e-4 and a = 1: p = 2E*A(a²/2 + x²)√(a² - x²).
#[test]
fn a_fourth_power_presses_most_beside_its_ends() {
    let one = on_all_ranks("steuermann", "seam");
    near(end(&one), 1.0, 1e-2, "half width");
    near(one.trace("seam")[0].lambda * COMPLIANCE, 1e-4, 2e-7, "pressure in the middle");
    near(one.number("/contact/seam/pressure_max") * COMPLIANCE, 2e-4 * 0.5_f64.sqrt(), 2e-6, "largest pressure");
    inner_order("steuermann", 1.0, |x| 2e-4 / COMPLIANCE * (0.5 + x * x) * (1.0 - x * x).sqrt(), 1.8);
}

/// Ciavarella, Hills, Monno, with the flat part to .6, contact to 1, R = 500.
fn rounded(x: f64) -> f64 {
    let (phi, first) = (x.asin(), 0.6_f64.asin());
    let logarithm = phi.sin() * ((phi + first).sin() / (phi - first).sin()).abs().ln()
        + first.sin() * ((0.5 * (phi + first)).tan() * (0.5 * (phi - first)).tan()).abs().ln();
    ((PI - 2.0 * first) * phi.cos() + logarithm) / (2.0 * PI * 500.0 * COMPLIANCE)
}

#[test]
fn a_punch_with_rounded_edges() {
    let one = on_all_ranks("rounded_punch", "seam");
    near(end(&one), 1.0, 1e-2, "half width");
    near(one.trace("seam")[0].lambda, rounded(0.0), 2e-3 * rounded(0.0), "pressure in the middle");
    near(one.number("/contact/seam/pressure_max"), 0.736781, 0.736781 * 2e-2, "largest pressure");
    inner_order("rounded_punch", 0.8, rounded, 1.8);
}

/// The same scene in other units, and half-planes of one stiffness or very different ones: the contact is the same.
#[test]
fn a_punch_with_rounded_edges_in_other_units() {
    let wanted = end(&Run::case("rounded_punch").ranks(2).set("mesh.refine", 2).set("exact.must_hold", false).converged());
    for (lower, upper, share) in [(7e9, 3e9, 1e6), (7e-3, 3e-3, 1e-6)] {
        let run = Run::case("rounded_punch").ranks(2).set("mesh.refine", 2).set("exact.must_hold", false);
        let load = format!("\"{share:?}*2*1.0192923071417261*y/(pi*100^2)\"");
        let run = run.set("body.lower.young", lower).set("body.upper.young", upper).set("load.far.pressure", load);
        near(end(&run.converged()), wanted, 1e-5, &format!("half width, loads times {share}"));
    }
}

/// NAFEMS R0094, benchmark 1. By meshes that adapt to 1e-4: p₀ = 3579.1 and a = 6.221 on the undeformed bodies, 3642.9 and
/// 6.136 on the deformed ones; Hertz has 3585.4 and 6.215.
#[test]
fn the_roller_of_nafems() {
    let one = on_all_ranks("nafems_roller", "seam");
    near(one.trace("seam")[0].lambda, 3579.1, 3579.1 * 1e-3, "pressure in the middle");
    near(end(&one), 6.221, 6.221 * 5e-3, "half width");
    let deformed = Run::case("nafems_roller/deformed.toml").ranks(2).converged();
    near(deformed.trace("seam")[0].lambda, 3642.9, 3642.9 * 1e-3, "pressure in the middle, deformed");
    near(end(&deformed), 6.136, 6.136 * 5e-3, "half width, deformed");
    for ended in [&one, &deformed] {
        near(ended.number("/contact/seam/resultant/1"), 17500.0, 17500.0 * 1e-6, "vertical force");
    }
}

/// Persson, materials alike: the load for a half angle, and the pressure at an angle from the bottom.
struct Pin {
    half: f64,
    load: f64,
}

impl Pin {
    fn new(degrees: f64) -> Self {
        let half = degrees.to_radians();
        let square = (0.5 * half).tan().powi(2);
        let stiffness = PI * 7000.0 / (1.0 - 0.227 * 0.227) * 1e-3;
        let load = stiffness * square * (1.0 + square) / (2.0 - 2.0 * square * square - (1.0 + square).ln());
        Self { half, load }
    }

    fn pressure(&self, angle: f64) -> f64 {
        let square = (0.5 * self.half).tan().powi(2);
        let y = (0.5 * angle).tan().powi(2);
        let (whole, part) = ((square + 1.0).sqrt(), (square - y).max(0.0).sqrt());
        let logarithm = ((whole + part) / (whole - part)).ln() / (2.0 * PI * square * (1.0 + square));
        self.load * (2.0 / (PI * whole) * part / (1.0 + y) + logarithm)
    }

    fn ended(&self, refine: usize) -> Ended {
        let square = "(x^2 + (y + 0.001)^2)/(2*0.15^2)";
        let force = format!("[0, \"-{:?}*(2 - {square})*exp(-{square})/(2*pi*0.15^2)\"]", self.load);
        let run = Run::case("conforming").ranks(2).set("mesh.refine", refine).set("exact.must_hold", false);
        run.set("body.pin.body_force", force).converged()
    }
}

fn angle(x: [f64; 2]) -> f64 {
    x[0].atan2(-x[1])
}

/// From a line contact to nearly the neat fit: five loads, from .38 to 58.
#[test]
fn a_pin_with_clearance_over_a_range_of_loads() {
    for degrees in [20.0, 35.0, 50.0, 65.0, 80.0] {
        let pin = Pin::new(degrees);
        let ended = pin.ended(3);
        let [x, y] = [0, 1].map(|k| ended.number(&format!("/contact/seam/ends/1/{k}")));
        let words = format!("load {:.4}", pin.load);
        near(angle([x, y]).to_degrees(), degrees, 0.2, &format!("{words}: half angle"));
        near(ended.number("/contact/seam/resultant/1") / pin.load, 0.5, 1e-6, &format!("{words}: vertical force"));
        let trace = ended.trace("seam");
        let error = pressure_error(&trace, |p| pin.pressure(angle(p.x)), |p| angle(p.x) < 0.6 * pin.half);
        println!("{words}: inner pressure off by {error:.1e}");
        assert!(error < 4e-3, "{words}: inner pressure off by {error:e}");
    }
    on_all_ranks("conforming", "seam");
}

#[test]
fn pressure_on_a_pin_with_clearance_has_its_order() {
    let pin = Pin::new(50.0);
    let errors = [1, 2].map(|refine| {
        let trace = pin.ended(refine).trace("seam");
        pressure_error(&trace, |p| pin.pressure(angle(p.x)), |p| angle(p.x) < 0.6 * pin.half)
    });
    let order = (errors[0] / errors[1]).log2();
    println!("inner pressure of order {order:.2}: {errors:?}");
    // From refine = 3 on it is the clearance of a thousandth that is seen, which Persson takes for small.
    assert!(order >= 1.8, "inner pressure of order {order}: {errors:?}");
}
