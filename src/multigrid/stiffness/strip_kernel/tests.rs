//! Every kind of register against one node after the other.

use super::*;
use crate::body::MacroStiffness;
use crate::discretisation::samples::vector;
use crate::element::{Order, Plane, PlaneLaw};
use crate::mesh::Level;
use crate::mesh::samples::two_blocks;
use crate::multigrid::stiffness::lanes::PlainLanes;
use crate::multigrid::stiffness::strips::inverse;

const LAW: PlaneLaw = PlaneLaw { lambda: 3.0, mu: 2.0, across: 3.0, plane: Plane::Strain };

/// Strips of one macro triangle, its inner nodes being all nodes of a rank: couplings, and the strips that have them.
fn strips(order: Order, intervals: usize) -> (usize, Vec<(Couplings, StripNodes)>) {
    let (mesh, level) = (two_blocks(), Level { intervals, order });
    let stiffness = MacroStiffness::new(&mesh, 1, level, &LAW).expect("a good triangle");
    let row_start = |j: usize| crate::mesh::lattice::row_start(intervals, j);
    let strip = |strip: &crate::mesh::Strip| {
        let nodes =
            StripNodes { first: row_start(strip.j) + strip.i.start - 1, count: strip.i.len(), width: intervals - 1 - strip.j };
        (Couplings::new(&stiffness, order, strip), nodes)
    };
    (crate::mesh::lattice::inner_count(intervals), mesh.strips(1, level).iter().map(strip).collect())
}

/// `b - K x` of node `k` of a strip, with or without its coupling to itself.
fn residual(couplings: &Couplings, nodes: StripNodes, k: usize, b: &[[f64; 2]], x: &[[f64; 2]], own: bool) -> [f64; 2] {
    let mut sum = b[nodes.first + k];
    for (step, block) in couplings.of(k).iter().filter(|(step, _)| own || *step != (0, 0)) {
        let y = x[(nodes.first + k).wrapping_add_signed(nodes.distance(*step))];
        (0..2).for_each(|a| sum[a] -= block[a][0] * y[0] + block[a][1] * y[1]);
    }
    sum
}

/// Relaxes a node as its equation says.
fn relax(couplings: &Couplings, nodes: StripNodes, k: usize, b: &[[f64; 2]], x: &mut [[f64; 2]]) {
    let sum = residual(couplings, nodes, k, b, x, false);
    let inverse = inverse(&couplings.of(k)[0].1).expect("a diagonal");
    x[nodes.first + k] = [0, 1].map(|a| inverse[a][0] * sum[0] + inverse[a][1] * sum[1]);
}

fn check<L: Lanes>(lanes: L, tolerance: f64) {
    for (order, intervals) in
        [(Order::P1, 16), (Order::P1, 23), (Order::P1, 32), (Order::P2, 16), (Order::P2, 32), (Order::P2, 38)]
    {
        let (count, strips) = strips(order, intervals);
        assert!(strips.len() > 3);
        let (b, start) = (vector(count, 5), vector(count, 99));
        let near = |words: &str, found: &[[f64; 2]], expected: &[[f64; 2]]| {
            for (node, (found, expected)) in found.iter().zip(expected).enumerate() {
                let apart = (0..2).map(|a| (found[a] - expected[a]).abs()).fold(0.0, f64::max);
                assert!(apart < tolerance, "{order:?}, n = {intervals}, {words}, node {node}: {apart:e}");
            }
        };
        let (mut x, mut expected) = (start.clone(), start.clone());
        for (couplings, nodes) in &strips {
            kernel(lanes, couplings).forward(&[*nodes], &b, &mut x);
            (0..nodes.count).for_each(|k| relax(couplings, *nodes, k, &b, &mut expected));
        }
        near("forward", &x, &expected);
        for (couplings, nodes) in strips.iter().rev() {
            kernel(lanes, couplings).backward(&[*nodes], &b, &mut x);
            (0..nodes.count).rev().for_each(|k| relax(couplings, *nodes, k, &b, &mut expected));
        }
        near("backward", &x, &expected);
        let (zero, mut r, mut y) = (vec![[0.0; 2]; count], start.clone(), start.clone());
        let (mut difference, mut minus) = (start.clone(), start.clone());
        for (couplings, nodes) in &strips {
            kernel(lanes, couplings).residual(&[*nodes], &b, &start, &mut r);
            kernel(lanes, couplings).multiply(&[*nodes], &start, &mut y);
            for k in 0..nodes.count {
                difference[nodes.first + k] = residual(couplings, *nodes, k, &b, &start, true);
                minus[nodes.first + k] = residual(couplings, *nodes, k, &zero, &start, true).map(|v| -v);
            }
        }
        near("residual", &r, &difference);
        near("product", &y, &minus);
    }
}

#[test]
fn arrays_do_what_one_node_after_the_other_does() {
    check(PlainLanes, 1e-13);
}

#[cfg(target_arch = "x86_64")]
#[test]
fn registers_that_this_processor_has_do_what_one_node_after_the_other_does() {
    use crate::multigrid::stiffness::lanes::{Avx2Lanes, Avx512Lanes};
    if let Some(simd) = pulp::x86::V3::try_new() {
        check(Avx2Lanes(simd), 1e-13);
    }
    if let Some(simd) = pulp::x86::V4::try_new() {
        check(Avx512Lanes(simd), 1e-13);
    }
}
