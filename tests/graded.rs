//! Refinement towards points: full orders in spite of corners, few iterations, stable segments, the same on all ranks.

use crate::support::{Ended, PAIRS, Run, difference, ranks_in_turn};

/// Strain energy of the inclined bars.
const ENERGY: f64 = 2.63511547e-3;

/// The inclined bars, refined so often towards both ends of the contact line.
fn bars(order: usize, space: &str, refine: usize) -> Run {
    let run = Run::case("bars_inclined/graded.toml").set("mesh.order", order).set("mesh.refine", refine);
    run.set("contact.seam.multiplier", space).set("exact.must_hold", false)
}

/// Error in the energy norm, from that of the strain energy.
fn energy_error(ended: &Ended) -> f64 {
    (ended.number("/energy/total") / ENERGY - 1.0).abs().sqrt()
}

/// Mean order over two refinements, with the errors.
fn order_of(run: impl Fn(usize) -> Run, finest: usize, words: &str) -> f64 {
    let errors = [2, 1, 0].map(|coarser| {
        let ended = run(finest - coarser).ranks(2).set("solver.tolerance", "1e-12").set("solver.inf_sup", false).converged();
        println!("{words}: {} unknowns, U off by {:.2e}", ended.number("/unknowns/displacement"), energy_error(&ended).powi(2));
        energy_error(&ended)
    });
    0.5 * (errors[0] / errors[2]).log2()
}

#[test]
fn linear_elements_have_their_full_order() {
    let order = order_of(|refine| bars(1, "p0", refine), 5, "P1/p0");
    assert!(order >= 0.95, "order {order}");
}

#[test]
fn quadratic_elements_come_near_their_full_order() {
    let order = order_of(|refine| bars(2, "p1-discontinuous", refine), 5, "P2/p1-discontinuous");
    assert!(order >= 1.7, "order {order}");
}

/// Three of four unknowns and more are saved, even before the error is small.
#[test]
fn an_even_mesh_with_four_times_the_unknowns_is_worse() {
    let graded = bars(2, "p1-discontinuous", 2).converged();
    let even = bars(2, "p1-discontinuous", 3).set("mesh.grade.ratio", 0.5).converged();
    let [unknowns, more] = [&graded, &even].map(|run| run.number("/unknowns/displacement"));
    assert!(more > 3.8 * unknowns);
    assert!(energy_error(&graded) < energy_error(&even), "{} {}", energy_error(&graded), energy_error(&even));
}

#[test]
fn iterations_stay_few_at_every_level() {
    for (order, space, levels) in [(1, "p0", [2, 3, 4]), (2, "p1-discontinuous", [1, 2, 3])] {
        for (ranks, refine) in
            levels.into_iter().flat_map(|refine| ranks_in_turn(refine).into_iter().map(move |ranks| (ranks, refine)))
        {
            let run = bars(order, space, refine).ranks(ranks).set("contact.seam.law", "bilateral");
            let count = run.set("solver.tolerance", "1e-8").converged().iterations();
            println!("P{order}/{space}, refine {refine}, {ranks} ranks: {count} iterations");
            assert!(count <= 15, "P{order}/{space}, refine {refine}, {ranks} ranks: {count} iterations");
        }
    }
}

/// Needles of 5 degrees, lying and standing, refined towards both corners: the solver finds a stronger preconditioner, and
/// says so.
#[test]
fn slivers_are_solved_within_sixty_iterations() {
    let scenes = [("flat.msh", 1, "p0"), ("flat.msh", 2, "p1-discontinuous"), ("upright.msh", 1, "p0")];
    for (at, (file, order, space)) in scenes.into_iter().enumerate() {
        for ranks in ranks_in_turn(at) {
            let run = Run::case("hard/bars.toml").ranks(ranks).set("mesh.file", file).set("mesh.refine", 4 - order);
            let run = run.set("mesh.grade.points", "[[0, 3], [6, 4]]").set("mesh.grade.exponent", "[0.818, 1.057]");
            let run = run.set("mesh.order", order).set("contact.seam.multiplier", space).set("exact.must_hold", false);
            let ended = run.set("solver.inf_sup", false).set("output.fields", false).converged();
            let (count, used) = (ended.iterations(), ended.value("/solver/krylov"));
            let words = format!("{file}, P{order}/{space}, {ranks} ranks: {count} iterations, {used}");
            println!("{words}");
            assert!(count <= 60 && used.as_str().expect("words").contains("CG steps"), "{words}");
            assert!(ended.said().contains("CG steps"), "{}", ended.said());
        }
    }
}

/// Segments that count edges are stable, whatever the ratio.
#[test]
fn automatic_segments_are_stable_for_all_spaces() {
    for (order, space) in PAIRS {
        for ratio in [0.15, 0.3] {
            let run = bars(order, space, 3 - order).set("mesh.grade.ratio", ratio).set("contact.seam.stabilise", false);
            let ended = run.set("solver.inf_sup", true).converged();
            let (constant, words) = (ended.number("/contact/seam/inf_sup"), format!("P{order}/{space}, ratio {ratio}"));
            println!("{words}: inf-sup constant {constant}");
            assert!(constant > 0.3, "{words}: inf-sup constant {constant}");
            assert!(!ended.said().contains("edges of the softer body"), "{}", ended.said());
        }
    }
}

#[test]
fn segments_shorten_towards_graded_points() {
    let ended = bars(2, "p1-discontinuous", 3).converged();
    let mut knots: Vec<f64> =
        ended.trace("seam").windows(2).filter(|pair| pair[0].s == pair[1].s).map(|pair| pair[0].s).collect();
    knots.insert(0, 0.0);
    knots.push(ended.number("/contact/seam/length"));
    let lengths: Vec<f64> = knots.windows(2).map(|ends| ends[1] - ends[0]).collect();
    let (middle, last) = (lengths[lengths.len() / 2], lengths[lengths.len() - 1]);
    assert!(lengths[0] < 0.15 * middle && last < 0.3 * middle, "{lengths:?}");
    assert!(ended.number("/contact/seam/h_ratio") >= 1.5 * (1.0 - 1e-9));
}

#[test]
fn all_ranks_give_the_same() {
    for (case, refine) in [("bars_inclined/graded.toml", 3), ("bars_parabola/graded.toml", 2)] {
        let run = |ranks| {
            let run = Run::case(case).ranks(ranks).set("mesh.refine", refine).set("exact.must_hold", false);
            let ended =
                run.set("solver.tolerance", "1e-12").set("probe.p", "{ point = [0.4, 0.3], body = \"lower\" }").converged();
            let probe = [0, 1].map(|k| ended.number(&format!("/probe/p/u/{k}")));
            let lambda: Vec<f64> = ended.trace("seam").iter().map(|point| point.lambda).collect();
            (ended.number("/energy/total"), ended.number("/contact/seam/force"), probe, lambda)
        };
        let first = run(1);
        for ranks in [2, 3] {
            let other = run(ranks);
            let off = [
                difference(&[other.0], &[first.0]),
                difference(&[other.1], &[first.1]),
                difference(&other.2, &first.2),
                difference(&other.3, &first.3),
            ];
            println!("{case}, {ranks} ranks: {off:?}");
            assert!(off.iter().all(|off| *off <= 1e-8), "{case}, {ranks} ranks: {off:?}");
        }
    }
}

/// Bent edges: the rings have nothing to be refined towards, and stay as exact as they are.
#[test]
fn bent_boundaries_can_be_graded() {
    let run = Run::case("rings").set("mesh.grade.points", "[[2, 0], [0, 3]]").set("mesh.grade.ratio", "[0.2, 0.4]");
    for ranks in ranks_in_turn(1) {
        let ended = run.clone().ranks(ranks).set("exact.must_hold", false).set("solver.tolerance", "1e-12").converged();
        for (name, limit) in [("energy", 1e-5), ("force_seam", 1e-5), ("displacement_inner", 1e-4), ("displacement_outer", 1e-4)]
        {
            let error = ended.number(&format!("/errors/{name}"));
            assert!(error <= limit, "{ranks} ranks: {name} {error:e}");
        }
        for name in ["force", "moment", "energy"] {
            let off = ended.number(&format!("/balance/{name}"));
            assert!(off <= 1e-9, "{ranks} ranks: balance of {name} {off:e}");
        }
    }
}

/// A contact boundary that follows the bodies keeps its segments in step with the edges.
#[test]
fn a_fitted_boundary_is_graded_too() {
    let run = Run::case("bars_parabola/graded.toml").set("mesh.refine", 2).set("exact.must_hold", false);
    let ended = run.set("contact.seam.curve", "fit").set("contact.seam.gap", "geometry").converged();
    assert!(ended.number("/contact/seam/h_ratio") >= 1.4, "{}", ended.value("/contact/seam"));
    assert!(ended.number("/errors/energy") < 2e-4, "{}", ended.value("/errors"));
}

#[test]
fn a_point_that_is_no_vertex_is_refused_with_the_nearest() {
    for ranks in [1, 2] {
        let ended = Run::case("bars_inclined/graded.toml").ranks(ranks).set("mesh.grade.points", "[[0, 3], [5.9, 4]]").ended();
        assert_eq!(ended.code, Some(2), "{}", ended.said());
        for words in ["graded.toml: mesh.grade.points: [5.9, 4] is no vertex of", "graded.msh", "the nearest is [6, 4]"] {
            assert!(ended.errors.contains(words), "no `{words}` in {}", ended.errors);
        }
    }
}
