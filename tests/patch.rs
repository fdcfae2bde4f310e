//! Patch tests: a constant stress field is met exactly by every pair of spaces, on any mesh, on any number of ranks.

mod support;

use support::{Ended, PAIRS, RANKS, Run, difference};

const EXACT: f64 = 1e-9;

/// λ = 1 and n·σn = -1 from both sides, at every point of the trace.
fn pressed_evenly(ended: &Ended, contact: &str, words: &str) {
    let points = ended.trace(contact);
    assert!(points.len() > 10, "{words}: {} points", points.len());
    for point in points {
        let errors = [point.lambda - 1.0, point.sigma[0] + 1.0, point.sigma[1] + 1.0];
        assert!(errors.iter().all(|error| error.abs() <= EXACT), "{words}: contact {contact}: {point:?}");
    }
}

fn holds(case: &str, contacts: &[&str], refine: usize) {
    holds_on(case, contacts, refine, |run| run);
}

fn holds_on(case: &str, contacts: &[&str], refine: usize, change: impl Fn(Run) -> Run) {
    for (order, space) in PAIRS {
        for ranks in RANKS {
            let words = format!("{case}, P{order} and {space}, refine {refine}, {ranks} ranks");
            let mut run = change(Run::case(case).ranks(ranks).set("mesh.order", order).set("mesh.refine", refine));
            for contact in contacts {
                run = run.set(&format!("contact.{contact}.multiplier"), space);
            }
            let ended = run.set("solver.tolerance", "1e-12").converged();
            contacts.iter().for_each(|contact| pressed_evenly(&ended, contact, &words));
            let errors = ended.value("/errors");
            let errors = errors.as_object().expect("errors by name");
            assert!(errors.len() >= 8, "{errors:?}");
            for (name, error) in errors {
                assert!(error.as_f64().is_some_and(|error| error <= EXACT), "{words}: {name} {error}");
            }
            for balance in ["force", "moment", "energy"] {
                let off = ended.number(&format!("/balance/{balance}"));
                assert!(off <= EXACT, "{words}: balance of {balance} {off:e}");
            }
        }
    }
}

#[test]
fn flat_line_on_the_meshes_of_the_file() {
    holds("patch_flat", &["seam"], 0);
}

#[test]
fn flat_line_on_refined_meshes() {
    holds("patch_flat", &["seam"], 2);
}

#[test]
fn inclined_line_on_the_meshes_of_the_file() {
    holds("patch_inclined", &["seam"], 0);
}

#[test]
fn inclined_line_on_refined_meshes() {
    holds("patch_inclined", &["seam"], 2);
}

#[test]
fn three_blocks_on_the_meshes_of_the_file() {
    holds("stack", &["first", "second"], 0);
}

#[test]
fn three_blocks_on_refined_meshes() {
    holds("stack", &["first", "second"], 2);
}

/// Refinement towards some vertices; the seam has two such ends, and other edges, too.
#[test]
fn flat_line_on_graded_meshes() {
    let points = "[[0, 1], [2, 1], [2, 2], [0, 0]]";
    holds_on("patch_flat", &["seam"], 2, |run| {
        run.set("mesh.grade.points", points).set("mesh.grade.ratio", "[0.15, 0.2, 0.4, 0.3]")
    });
}

#[test]
fn inclined_line_on_graded_meshes() {
    let points = "[[0, 3], [6, 4]]";
    holds_on("patch_inclined", &["seam"], 3, |run| run.set("mesh.grade.points", points).set("mesh.grade.exponent", "[0.8, 1.1]"));
}

/// Exact also by the direct solver, which sees no levels and no augmentation.
#[test]
fn by_the_direct_solver() {
    for ranks in RANKS {
        let ended = Run::case("patch_inclined").ranks(ranks).set("solver.name", "direct").converged();
        pressed_evenly(&ended, "seam", &format!("direct, {ranks} ranks"));
    }
}

/// Uncut quadrature misses the patch test, by per cents of λ, on any number of ranks alike; the bodies still feel the same forces.
#[test]
fn not_by_points_fixed_on_the_segments() {
    for (order, space) in PAIRS {
        let run = |ranks: usize| {
            let run = Run::case("patch_flat").ranks(ranks).set("mesh.order", order).set("contact.seam.multiplier", space);
            run.set("contact.seam.quadrature", "segment").set("exact.must_hold", false).converged()
        };
        let runs = RANKS.map(run);
        for ended in &runs {
            let words = format!("P{order} and {space}");
            let off = ended.number("/errors/lambda_seam");
            println!("{words}: λ is off by {off:.1e}");
            assert!((1e-3..5e-2).contains(&off), "{words}: λ is off by {off:e}");
            assert_eq!(ended.number("/contact/seam/lost_points"), 0.0, "{words}");
            for balance in ["force", "moment", "energy"] {
                assert!(ended.number(&format!("/balance/{balance}")) <= EXACT, "{words}: balance of {balance}");
            }
            let lambda = [ended, &runs[0]].map(|ended| ended.trace("seam").iter().map(|point| point.lambda).collect::<Vec<_>>());
            assert!(difference(&lambda[0], &lambda[1]) <= 1e-8, "{words}: λ depends on the ranks");
        }
    }
}
