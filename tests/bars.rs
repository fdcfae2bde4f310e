//! The two bars: known values, balances, and results that do not depend on ranks, on the order of the bodies, or on the solver.

use crate::support::{Ended, RANKS, Run, difference, ranks_in_turn};

/// Corners of the bars, each with its body.
const INCLINED: [(&str, [f64; 2]); 5] =
    [("lower", [6., 0.]), ("lower", [6., 4.]), ("upper", [6., 4.]), ("upper", [6., 6.]), ("upper", [0., 6.])];
const PARABOLA: [(&str, [f64; 2]); 5] =
    [("lower", [4., 0.]), ("lower", [4., 4.]), ("upper", [4., 4.]), ("upper", [4., 8.]), ("upper", [0., 8.])];
const RINGS: [(&str, [f64; 2]); 4] = [("inner", [1., 0.]), ("inner", [0., 2.]), ("outer", [2., 0.]), ("outer", [0., 3.])];

/// A run to rounding that reports the displacement of some points.
fn probed(case: &str, corners: &[(&str, [f64; 2])]) -> Run {
    let mut run = Run::case(case).set("solver.tolerance", "1e-12");
    for (k, (body, point)) in corners.iter().enumerate() {
        run = run.set(&format!("probe.p{k}.body"), body).set(&format!("probe.p{k}.point"), format!("{point:?}"));
    }
    run
}

/// The same on meshes half as fine, where the known values are not met but everything else is.
fn coarser(case: &str, corners: &[(&str, [f64; 2])]) -> Run {
    let refine = if case.starts_with("bars_parabola") { 4 } else { 3 };
    probed(case, corners).set("mesh.refine", refine).set("exact.must_hold", false)
}

/// U, ∫λ ds, λ along the contact boundary from its lower left end, displacements of the corners.
fn results(ended: &Ended, corners: usize) -> [Vec<f64>; 4] {
    let mut trace = ended.trace("seam");
    if trace[0].x[0] > trace[trace.len() - 1].x[0] {
        trace.reverse();
    }
    let corner = |k: usize| [0, 1].map(|c| ended.number(&format!("/probe/p{k}/u/{c}")));
    [
        vec![ended.number("/energy/total")],
        vec![ended.number("/contact/seam/force")],
        trace.iter().map(|point| point.lambda).collect(),
        (0..corners).flat_map(corner).collect(),
    ]
}

fn agree(a: &Ended, b: &Ended, corners: usize, limit: f64, words: &str) {
    let (a, b) = (results(a, corners), results(b, corners));
    for (k, name) in ["strain energy", "force", "pressure", "corners"].into_iter().enumerate() {
        let off = difference(&a[k], &b[k]);
        println!("{words}: {name} differs by {off:.1e}");
        assert!(off <= limit, "{words}: {name} differs by {off:e}");
    }
}

fn at_most(ended: &Ended, path: &str, limit: f64, words: &str) {
    let found = ended.number(path);
    println!("{words}: {path} = {found:.2e}, limit {limit:.0e}");
    assert!(found <= limit, "{words}: {path} = {found:e}, limit {limit:e}");
}

/// Runs a case on 1, 2 and 3 ranks: each must balance and give what 1 rank gives.
fn on_all_ranks(case: &str, corners: &[(&str, [f64; 2])], check: impl Fn(&Ended, &str)) {
    let runs = RANKS.map(|ranks| probed(case, corners).ranks(ranks).ended());
    for (run, ranks) in runs.iter().zip(RANKS) {
        let words = format!("{case}, {ranks} ranks");
        check(run, &words);
        for name in ["force", "moment", "energy"] {
            at_most(run, &format!("/balance/{name}"), 1e-9, &words);
        }
        agree(run, &runs[0], corners.len(), 1e-8, &words);
        assert_eq!(run.code, Some(0), "{}", run.said());
    }
}

#[test]
fn inclined_bars_have_the_known_values() {
    on_all_ranks("bars_inclined", &INCLINED, |run, words| {
        for (name, limit) in [("energy", 2e-5), ("force_seam", 1e-9), ("lambda_seam", 1e-3)] {
            at_most(run, &format!("/errors/{name}"), limit, words);
        }
        at_most(run, "/errors/displacement_lower", 1e-4, words);
        at_most(run, "/errors/displacement_upper", 1e-4, words);
    });
}

#[test]
fn rings_balance_on_any_number_of_ranks() {
    on_all_ranks("rings", &RINGS, |_, _| {});
}

/// Contact ends within one segment of the known place.
fn parabolic_bars(case: &str) {
    on_all_ranks(case, &PARABOLA, |run, words| {
        for (name, limit) in [("energy", 3e-4), ("force_seam", 1e-3), ("lambda_seam", 2e-3)] {
            at_most(run, &format!("/errors/{name}"), limit, words);
        }
        let segment = run.number("/contact/seam/length") / run.number("/contact/seam/segments");
        let closed = run.value("/contact/seam/closed_points");
        assert_eq!(closed.as_array().map(Vec::len), Some(1), "{words}: {closed}");
        let ends = [0, 1].map(|k| run.number(&format!("/contact/seam/closed_points/0/{k}/0")));
        println!("{words}: contact from x = {} to {}, segment {segment}", ends[0], ends[1]);
        assert!(ends[0].min(ends[1]).abs() < 1e-12, "{words}: contact begins at the wall, not {ends:?}");
        assert!((ends[0].max(ends[1]) - 3.9101).abs() <= segment, "{words}: contact from {ends:?}, segment {segment}");
    });
}

#[test]
fn parabolic_bars_have_the_known_values() {
    parabolic_bars("bars_parabola");
}

#[test]
fn parabolic_bars_on_matching_meshes_have_the_known_values() {
    parabolic_bars("bars_parabola/matching.toml");
}

#[test]
fn bodies_1_and_2_can_change_places() {
    let cases = [("bars_inclined/even.toml", &INCLINED[..], "lower", "upper"), ("bars_parabola", &PARABOLA, "lower", "upper")];
    for (at, (case, corners, first, second)) in cases.into_iter().chain([("rings", &RINGS[..], "inner", "outer")]).enumerate() {
        for ranks in ranks_in_turn(at) {
            let run = coarser(case, corners).ranks(ranks);
            let between = format!("[\"{second}.seam\", \"{first}.seam\"]");
            let exchanged = run.clone().set("contact.seam.between", between).converged();
            agree(&exchanged, &run.converged(), corners.len(), 1e-8, &format!("{case}, exchanged, {ranks} ranks"));
        }
    }
}

/// Segments given as fractions lie where they lay, whichever body is named first.
#[test]
fn bodies_can_change_places_over_given_segments() {
    let run = probed("bars_inclined", &INCLINED);
    let exchanged = run.clone().set("contact.seam.between", "[\"upper.seam\", \"lower.seam\"]").converged();
    agree(&exchanged, &run.converged(), INCLINED.len(), 1e-8, "given segments, exchanged");
}

#[test]
fn field_split_and_direct_solver_agree() {
    let cases = [("bars_inclined", &INCLINED[..]), ("bars_parabola", &PARABOLA), ("rings", &RINGS)];
    for (at, (case, corners)) in cases.into_iter().enumerate() {
        for ranks in ranks_in_turn(at) {
            let run = |solver| coarser(case, corners).ranks(ranks).set("solver.name", solver).converged();
            let words = format!("{case}, field split against direct, {ranks} ranks");
            agree(&run("fieldsplit"), &run("direct"), corners.len(), 1e-6, &words);
        }
    }
}

/// At the tolerance that users get by default, too.
#[test]
fn field_split_and_direct_solver_agree_at_the_default_tolerance() {
    let run = |solver| probed("bars_inclined", &INCLINED).set("solver.tolerance", "1e-8").set("solver.name", solver);
    let run = |solver| run(solver).set("exact.must_hold", false).ranks(2).converged();
    agree(&run("fieldsplit"), &run("direct"), INCLINED.len(), 1e-6, "default tolerance");
}
