//! Patch tests: a constant stress field is met exactly by every pair of spaces, on any mesh, on any number of ranks.

use crate::support::mesh::read_gmsh;
use crate::support::{Ended, PAIRS, Run, difference, pairs_on_ranks, ranks_in_turn};
use std::path::Path;

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
    for (order, space, ranks) in pairs_on_ranks() {
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
fn layers_of_two_materials_on_the_meshes_of_the_file() {
    holds("patch_layers", &["seam"], 0);
}

#[test]
fn layers_of_two_materials_on_refined_meshes() {
    holds("patch_layers", &["seam"], 2);
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

/// What the summary says of a scene whose solution is known: λ = 1 from (0, 3) to (6, 4), the normal (-1, 6)/√37, all that is
/// prescribed zero, no gap. Counts and lengths are those of the mesh file, each triangle divided by 16.
#[test]
fn figures_of_an_even_pressure() {
    let mesh = read_gmsh(&Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/patch_inclined/bars.msh")).expect("a mesh");
    let place = |vertex: u32| mesh.vertices[vertex as usize];
    let edges = mesh.edges.iter().map(|edge| (place(edge.vertices[0]) - place(edge.vertices[1])).norm() / 4.0);
    let [shortest, longest] = edges.fold([f64::INFINITY, 0.0], |[low, high]: [f64; 2], h| [low.min(h), high.max(h)]);
    let triangles = 16 * mesh.triangles.len();
    let at_the_boundary = 4 * mesh.edges.iter().filter(|edge| edge.triangles.contains(&None)).count();
    let edges = (3 * triangles + at_the_boundary) / 2;
    // Euler: two bodies without holes.
    let vertices = 2 + edges - triangles;
    let (length, energy) = (37f64.sqrt(), 0.0023812545714286);
    for ranks in ranks_in_turn(0) {
        let ended = Run::case("patch_inclined").ranks(ranks).converged();
        for (path, expected) in [
            ("/mesh/triangles", triangles as f64),
            ("/mesh/vertices", vertices as f64),
            ("/mesh/order", 2.0),
            ("/mesh/h_min", shortest),
            ("/mesh/h_max", longest),
            ("/unknowns/displacement", 2.0 * (vertices + edges) as f64),
            ("/unknowns/multiplier", 2.0 * ended.number("/contact/seam/segments")),
            ("/contact/seam/length", length),
            ("/contact/seam/force", length),
            ("/contact/seam/resultant/0", -1.0),
            ("/contact/seam/resultant/1", 6.0),
            // (3, 3.5) × (-1, 6).
            ("/contact/seam/moment", 21.5),
            ("/contact/seam/pressure_max", 1.0),
            ("/contact/seam/zones/0/pressure_max", 1.0),
            ("/contact/seam/zones/0/share", 1.0),
            ("/contact/seam/closed/0/1", length),
            ("/contact/seam/closed_points/0/1/0", 6.0),
            ("/contact/seam/closed_points/0/1/1", 4.0),
            ("/contact/seam/ends/0/1", 3.0),
            ("/energy/total", energy),
            ("/energy/stationary", energy),
            ("/energy/external_work", 2.0 * energy),
        ] {
            let found = ended.number(path);
            assert!((found / expected - 1.0).abs() <= EXACT, "{path} on {ranks} ranks: {found} instead of {expected}");
        }
        for path in ["/contact/seam/closed/0/0", "/contact/seam/ends/0/0", "/contact/seam/oscillation"] {
            assert!(ended.number(path).abs() <= EXACT, "{path} on {ranks} ranks: {}", ended.number(path));
        }
    }
}

/// The largest pressure is that of the table, where it varies.
#[test]
fn the_largest_pressure_is_that_of_the_table() {
    for (case, space) in [("open_zone", "p0"), ("beam", "p0"), ("beam", "p1-discontinuous"), ("beam", "p1-continuous")] {
        let run = Run::case(case).set("contact.seam.multiplier", space).set("mesh.refine", 1);
        let ended = run.set("exact.must_hold", false).set("output.fields", false).ranks(2).converged();
        let highest = ended.trace("seam").iter().map(|point| point.lambda).fold(0.0, f64::max);
        for path in ["/contact/seam/pressure_max", "/contact/seam/zones/0/pressure_max"] {
            assert!((ended.number(path) / highest - 1.0).abs() <= EXACT, "{case}, {space}: {path} beside {highest}");
        }
    }
}

/// Exact also by the direct solver, which sees no levels and no augmentation.
#[test]
fn by_the_direct_solver() {
    for ranks in ranks_in_turn(1) {
        let ended = Run::case("patch_inclined").ranks(ranks).set("solver.name", "direct").converged();
        pressed_evenly(&ended, "seam", &format!("direct, {ranks} ranks"));
    }
}

/// Uncut quadrature misses the patch test, by per cents of λ, on any number of ranks alike; the bodies still feel the same forces.
#[test]
fn not_by_points_fixed_on_the_segments() {
    for (at, (order, space)) in PAIRS.into_iter().enumerate() {
        let run = |ranks: usize| {
            let run = Run::case("patch_flat").ranks(ranks).set("mesh.order", order).set("contact.seam.multiplier", space);
            run.set("contact.seam.quadrature", "segment").set("exact.must_hold", false).converged()
        };
        let runs: Vec<_> = ranks_in_turn(at).into_iter().map(run).collect();
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
