//! Rings pressed into one another, whose exact solution is smooth: errors fall with the order of the elements.

use crate::support::{Run, ranks_in_turn};

/// Energy-norm errors of both bodies (inner, outer) and the L2 error of λ.
fn errors(order: usize, space: &str, refine: usize, ranks: usize) -> [f64; 3] {
    let run = Run::case("rings").ranks(ranks).set("mesh.order", order).set("mesh.refine", refine);
    let ended = run.set("contact.seam.multiplier", space).set("exact.must_hold", false).set("solver.tolerance", "1e-10");
    let ended = ended.converged();
    ["energy_norm_inner", "energy_norm_outer", "lambda_seam"].map(|name| ended.number(&format!("/errors/{name}")))
}

/// Mean orders over three refinements.
fn orders(order: usize, space: &str, coarsest: usize, least: f64) {
    for ranks in ranks_in_turn(1) {
        let all = [0, 1, 2, 3].map(|r| errors(order, space, coarsest + r, ranks));
        for (k, name) in ["energy, inner", "energy, outer", "pressure"].into_iter().enumerate() {
            let found = (all[0][k] / all[3][k]).log2() / 3.0;
            println!("P{order}, {space}, {ranks} ranks: {name} of order {found:.3}: {:.2e}", all.map(|e| e[k])[3]);
            assert!(found >= least, "P{order}, {space}, {ranks} ranks: {name} of order {found:.3}: {:?}", all.map(|e| e[k]));
        }
    }
}

#[test]
fn p2_with_discontinuous_p1_is_of_second_order() {
    orders(2, "p1-discontinuous", 1, 1.8);
}

#[test]
fn p1_with_p0_is_of_first_order() {
    orders(1, "p0", 2, 0.9);
}
