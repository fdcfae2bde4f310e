//! What solves cost, counted: active sets and solves on the finest mesh, and cycles of all meshes.

use crate::support::{Ended, Run};

/// Cycles of one linear problem to 1e-8 (docs/method.md).
const ONE: f64 = 12.0;

/// Cycles of all meshes, boundaries and sets together, each by its unknowns, as cycles on the finest mesh; and active sets and
/// solves on that mesh.
fn cost(ended: &Ended) -> (f64, [usize; 2]) {
    let passes = ended.value("/outer");
    let passes = passes.as_array().expect("a list");
    let count = |is: fn(&serde_json::Value) -> bool| passes.iter().filter(|pass| is(pass)).count();
    let changes = count(|pass| pass["added"] != 0 || pass["released"] != 0);
    (ended.number("/solver/cycles"), [1 + changes, count(|pass| pass["krylov_iterations"].as_u64() > Some(1))])
}

/// Bodies that hold each other cost what three linear problems do, and so do contacts that move.
#[test]
fn contact_costs_no_more_than_three_linear_problems() {
    let cases = ["roller", "roller/four.toml", "lug", "bending", "chain_5", "wheels", "hertz", "bars_parabola", "pin"];
    let packings = ["packing", "packing/discs_3.toml", "packing/groove.toml", "packing/pyramid.toml"];
    let cases = cases.into_iter().chain(packings).map(|case| (case, 3));
    // On the bearing's finest mesh, which is its first, what presses changes as the ends of 24 contacts are found.
    for (case, most) in cases.chain([("bearing", 5)]) {
        let ended = Run::case(case).ranks(2).set("output.fields", false).converged();
        let (cycles, [sets, solves]) = cost(&ended);
        assert!(cycles <= 3.0 * ONE, "{case}: {cycles} cycles");
        assert!(sets <= 3 && solves <= most, "{case}: {sets} sets, {solves} solves on the finest mesh");
    }
}

/// The summary tells each mesh of a sequence by its refinements, and adds them up.
#[test]
fn cycles_are_counted_by_mesh() {
    let ended = Run::case("bending").set("output.fields", false).converged();
    let meshes = ended.value("/accuracy");
    let mut work = 0.0;
    for mesh in meshes.as_array().expect("meshes") {
        let cycles = mesh["cycles"].as_array().expect("refinements");
        let unknowns: Vec<u64> = cycles.iter().map(|of| of["unknowns"].as_u64().expect("a number")).collect();
        assert!(unknowns.windows(2).all(|pair| pair[0] < pair[1]), "{unknowns:?}");
        assert_eq!(unknowns.last(), mesh["unknowns"].as_u64().as_ref());
        work += cycles.iter().map(|of| of["unknowns"].as_f64().unwrap() * of["iterations"].as_f64().unwrap()).sum::<f64>();
    }
    let told = ended.number("/solver/cycles") * ended.number("/unknowns/displacement");
    assert!((told / work - 1.0).abs() < 1e-12, "{told} instead of {work}");
}
