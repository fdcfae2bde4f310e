//! Classical contacts whose end, or whose singular pressure, is known: what the pressure does there, not only how large it is.

mod support;

use nalgebra::{DMatrix, DVector};
use support::{Ended, RANKS, Run, TracePoint, difference};

/// A load of `force` on the pin, written as in `cases/pin`.
fn force_on_pin(force: f64) -> String {
    format!("[0.0, \"-{force}*(2 - (x^2 + y^2)/(2*0.15^2))*exp(-(x^2 + y^2)/(2*0.15^2))/(2*pi*0.15^2)\"]")
}

/// Runs a case on 1, 2 and 3 ranks; pressure, force and energy must be the same. The run on one rank.
fn on_all_ranks(case: &str) -> Ended {
    let run = |ranks| Run::case(case).set("solver.tolerance", "1e-11").ranks(ranks).converged();
    let numbers = |ended: &Ended| {
        let lambda = ended.trace("seam").iter().map(|point| point.lambda).collect();
        [lambda, vec![ended.number("/contact/seam/force")], vec![ended.number("/energy/total")]]
    };
    let [one, others @ ..] = RANKS.map(run);
    for (other, ranks) in others.iter().zip(&RANKS[1..]) {
        for (name, (a, b)) in ["pressure", "force", "energy"].iter().zip(numbers(other).iter().zip(&numbers(&one))) {
            let off = difference(a, b);
            println!("{case}: {name} on {ranks} ranks differs by {off:.1e}");
            assert!(off <= 1e-8, "{case}: {name} on {ranks} ranks differs by {off:e}");
        }
    }
    one
}

/// Least squares: coefficients of the columns, and the norm of what they leave.
fn fit(columns: DMatrix<f64>, values: &DVector<f64>) -> (DVector<f64>, f64) {
    let coefficients = columns.clone().svd(true, true).solve(values, 1e-14).expect("both factors are there");
    let rest = (&columns * &coefficients - values).norm();
    (coefficients, rest)
}

/// Arc length at which the pressure falls to zero, for contact that begins at s = 0 and ends smoothly.
///
/// There λ = √d (c₀ + c₁ d + c₂ d² ...), d the distance to the end. Three terms are fitted to the ten segments before the
/// last two, which the end of contact disturbs; of all places for the end, the best fit tells.
fn end_of_contact(ended: &Ended) -> f64 {
    let closed = ended.number("/contact/seam/closed/0/1");
    let segment = ended.number("/contact/seam/length") / ended.number("/contact/seam/segments");
    let within = |point: &TracePoint| point.s >= closed - 12.0 * segment && point.s <= closed - 2.0 * segment;
    let points: Vec<TracePoint> = ended.trace("seam").into_iter().filter(within).collect();
    let lambda = DVector::from_iterator(points.len(), points.iter().map(|point| point.lambda));
    let rest = |end: &f64| {
        let distance = |row: usize| (end - points[row].s) / (10.0 * segment);
        fit(DMatrix::from_fn(points.len(), 3, |row, k| distance(row).powf(k as f64 + 0.5)), &lambda).1
    };
    let trials = (1..4000).map(|k| closed + (k as f64 / 1000.0 - 2.0) * segment);
    trials.min_by(|a, b| rest(a).total_cmp(&rest(b))).expect("there are trials")
}

fn near(found: f64, wanted: f64, tolerance: f64, words: &str) {
    println!("{words}: {found:.6}, known {wanted}");
    assert!((found - wanted).abs() <= tolerance, "{words}: {found}, known {wanted}, tolerance {tolerance}");
}

/// Persson's solution: 84.828 degrees and p(0) R/Q = .599629, whatever the load.
#[test]
fn a_pin_that_fits_touches_the_same_arc_under_any_load() {
    let one = on_all_ranks("pin");
    let run = Run::case("pin").ranks(2).set("solver.tolerance", "1e-11").set("exact.must_hold", false);
    let heavy = run.set("body.pin.body_force", force_on_pin(3000.0)).converged();
    for (ended, load) in [(&one, 1.0), (&heavy, 3000.0)] {
        near(end_of_contact(ended).to_degrees(), 84.8279456, 0.2, &format!("half angle, load {load}"));
        near(ended.trace("seam")[0].lambda / load, 0.599628669, 1e-3, &format!("pressure at the bottom, load {load}"));
        near(ended.number("/contact/seam/resultant/1") / load, 0.5, 1e-6, &format!("vertical force, load {load}"));
    }
}

/// The layer's own integral equation: see its README.
#[test]
fn a_layer_lifts_off_where_it_is_known_to() {
    let one = on_all_ranks("receding_layer");
    near(end_of_contact(&one), 1.324165372, 0.005, "half width of contact");
    let trace = one.trace("seam");
    near(trace[0].lambda, 0.713080551, 2e-3, "pressure below the load");
    assert!(trace.iter().filter(|point| point.s > 1.36).all(|point| point.gap > 0.0 && point.lambda == 0.0));
}

/// p ~ r^(s - 1), where sin(πs)/(2 sin²(πs/2) - 2 s²) + cot(πs) = 0: s = .774013.
#[test]
fn pressure_at_the_corner_of_a_block_has_the_known_exponent() {
    let trace = on_all_ranks("punch").trace("seam");
    // Nearer the corner the elements end, farther away the next term comes in: r^.573.
    let points: Vec<(f64, f64)> = trace.iter().map(|point| (1.0 - point.s, point.lambda)).collect();
    let points: Vec<(f64, f64)> = points.into_iter().filter(|(r, _)| (3e-3..3e-2).contains(r)).collect();
    let lambda = DVector::from_iterator(points.len(), points.iter().map(|(_, lambda)| lambda.ln()));
    let columns = DMatrix::from_fn(points.len(), 2, |row, k| if k == 0 { 1.0 } else { points[row].0.ln() });
    near(fit(columns, &lambda).0[1], -0.225987, 2e-3, &format!("exponent from {} points", points.len()));
}
