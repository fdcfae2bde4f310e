//! Multiplier spaces too rich for the displacements: told, and healed by the jump term. Example 1 with even segments.

use crate::support::{Ended, Run};

fn bars(order: usize, space: &str, segments: usize, solver: &str) -> Run {
    let run = Run::case("bars_inclined/even.toml").ranks(2).set("exact.must_hold", false).set("solver.tolerance", "1e-8");
    let run = run.set("contact.seam.law", "bilateral").set("mesh.order", order).set("mesh.refine", 5 - order);
    run.set("contact.seam.multiplier", space).set("contact.seam.segments", segments).set("solver.name", solver)
}

fn trusted(ended: &Ended) -> bool {
    ended.value("/contact/seam/trust").as_bool().expect("a figure of trust")
}

#[test]
fn good_spaces_are_trusted() {
    for (order, space) in crate::support::PAIRS {
        let ended = bars(order, space, 24, "direct").converged();
        assert!(trusted(&ended), "P{order} and {space}");
        assert!(ended.number("/contact/seam/oscillation") < 0.02);
    }
}

#[test]
fn spaces_twice_too_rich_are_not_and_the_words_say_so() {
    for (order, space, segments) in [(1, "p0", 176), (2, "p0", 176), (2, "p1-discontinuous", 120), (2, "p1-continuous", 176)] {
        let ended = bars(order, space, segments, "direct").set("contact.seam.stabilise", false).converged();
        assert!(!trusted(&ended), "P{order} and {space}");
        assert!(ended.number("/contact/seam/oscillation") > 0.05);
        assert!(ended.errors.contains("pressure unreliable"), "{}", ended.errors);
    }
}

#[test]
fn the_jump_term_heals_them_with_both_solvers() {
    for (order, space) in [(1, "p0"), (2, "p0"), (2, "p1-discontinuous"), (2, "p1-continuous")] {
        let [split, direct] = ["fieldsplit", "direct"].map(|solver| {
            let ended = bars(order, space, 176, solver).set("contact.seam.stabilise", true).converged();
            assert!(trusted(&ended), "P{order} and {space}");
            assert!(ended.number("/errors/lambda_seam") <= 0.01, "P{order} and {space}: {}", ended.number("/errors/lambda_seam"));
            assert!(ended.number("/balance/energy") <= 1e-9);
            ended
        });
        assert!(split.iterations() <= 20, "{} iterations", split.iterations());
        let [a, b] = [&split, &direct].map(|ended| ended.number("/energy/total"));
        assert!((a / b - 1.0).abs() < 1e-6);
    }
}

/// The approximate Schur complement has entries as large as E: in other units PETSc took its pivots for zero, no solve moved, and the
/// run ended as converged without any force.
#[test]
fn the_jump_term_knows_no_unit_of_stress() {
    for ranks in [1, 2] {
        let run = bars(2, "p1-discontinuous", 176, "fieldsplit").set("exact.must_hold", false).ranks(ranks);
        let run = run.set("body.lower.young", 7e-15).set("body.upper.young", 7e-15).set("load.top.pressure", 1e-18);
        let ended = run.set("contact.seam.stabilise", true).converged();
        let force = ended.number("/contact/seam/force") / 1e-18;
        assert!((force / 37.0_f64.sqrt() - 1.0).abs() < 1e-6, "{ranks} ranks: {force}");
    }
}

/// With every pivot taken for zero no solve moves: then the solver is told, and no contact condition is asked of what it has left.
#[test]
fn a_solve_that_fails_is_told_as_such() {
    let run = bars(2, "p1-discontinuous", 176, "fieldsplit").set("contact.seam.stabilise", true).ranks(1);
    let ended = run.petsc("-fieldsplit_lambda_pc_factor_zeropivot 1e30").ended();
    assert_eq!(ended.code, Some(3), "{}", ended.said());
    assert!(ended.value("/reason").to_string().contains("linear solver: KSP_DIVERGED_PC_FAILED"), "{}", ended.said());
}

#[test]
fn auto_adds_the_jump_term_where_segments_are_short_and_says_so() {
    let ended = bars(2, "p1-discontinuous", 176, "fieldsplit").converged();
    assert!(ended.errors.contains("the jump term is added"), "{}", ended.errors);
    assert!(trusted(&ended) && ended.number("/errors/lambda_seam") <= 0.01);
    let ended = bars(2, "p1-discontinuous", 24, "fieldsplit").converged();
    assert!(!ended.errors.contains("jump term"), "{}", ended.errors);
}

#[test]
fn the_inf_sup_constant_falls_with_the_segments_and_does_not_depend_on_ranks() {
    let beta = |segments: usize, ranks: usize| {
        let run = bars(1, "p0", segments, "fieldsplit").ranks(ranks).set("mesh.refine", 3).set("contact.seam.stabilise", false);
        run.set("solver.inf_sup", true).ended().number("/contact/seam/inf_sup")
    };
    let safe = beta(30, 1);
    assert!(safe > 0.3, "H/h = 1.6: {safe}");
    for ranks in [2, 3] {
        assert!((beta(30, ranks) / safe - 1.0).abs() < 0.02, "{ranks} ranks: {} against {safe}", beta(30, ranks));
    }
    assert!(beta(88, 1) < 0.05, "H/h = 0.55: {}", beta(88, 1));
}

/// On a graded mesh the jump term is that of the edges beside it; weighed by the longest edge everywhere, it leaves ten times
/// this error.
#[test]
fn the_jump_term_costs_a_graded_mesh_nothing() {
    let run = Run::case("bars_inclined/graded.toml").ranks(2).set("exact.must_hold", false).set("contact.seam.segments", 400);
    let ended = run.set("contact.seam.stabilise", true).converged();
    assert!(trusted(&ended) && ended.number("/errors/energy") < 2e-8, "{:e}", ended.number("/errors/energy"));
}

/// Edges in contact are counted where they are, however they are graded: `auto` gives each segment as many.
#[test]
fn edges_in_contact_are_counted_on_a_graded_mesh() {
    let run = Run::case("bars_inclined/graded.toml").ranks(2).set("exact.must_hold", false).set("contact.seam.segments", "auto");
    let ended = run.set("mesh.refine", 2).converged();
    let [edges, segments, ratio] =
        ["closed_edges", "segments", "h_ratio"].map(|key| ended.number(&format!("/contact/seam/{key}")));
    assert!((edges / (segments * ratio) - 1.0).abs() < 1e-6, "{edges} edges on {segments} segments of {ratio}");
}

/// Contact along less than an edge under segments much shorter: one solution, whoever finds it.
#[test]
fn beside_a_jump_term_the_active_set_does_not_depend_on_ranks_or_solver() {
    for (order, space) in [(1, "p0"), (2, "p0"), (2, "p1-discontinuous")] {
        let run = bars(order, space, 768, "fieldsplit").set("mesh.refine", 3).set("solver.tolerance", "1e-10");
        let run =
            run.set("contact.seam.law", "unilateral").set("load.top.pressure", 0.01).set("contact.seam.gap", "(x - 3)^2/240");
        let result = |run: Run| {
            // 768 segments lie on 48 edges: contact on ten of them is narrower than one.
            let ended = run.solved();
            (ended.value("/contact/seam/closed"), ended.number("/energy/total"))
        };
        let (closed, energy) = result(run.clone().ranks(1));
        for other in [run.clone().ranks(2), run.clone().ranks(3), run.set("solver.name", "direct")] {
            let found = result(other);
            assert_eq!(found.0, closed, "P{order} and {space}");
            assert!((found.1 / energy - 1.0).abs() < 1e-6, "P{order} and {space}: {} against {energy}", found.1);
        }
    }
}
