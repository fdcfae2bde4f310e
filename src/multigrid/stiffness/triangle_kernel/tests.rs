//! Every kind of register against one node after the other.

use super::*;
use crate::body::MacroStiffness;
use crate::discretisation::samples::vector;
use crate::element::block::inverse;
use crate::element::{Order, Plane, PlaneLaw};
use crate::mesh::Level;
use crate::mesh::samples::two_blocks;
use crate::multigrid::stiffness::lanes::PlainLanes;

/// One macro triangle: its couplings, its inner nodes in the vectors, the values of its lattice before the work.
struct Sample {
    n: usize,
    couplings: Vec<Couplings>,
    first: usize,
    lattice: Vec<[f64; 2]>,
}

impl Sample {
    fn nodes(&self) -> impl DoubleEndedIterator<Item = (usize, usize)> + use<> {
        let n = self.n;
        (1..n - 1).flat_map(move |j| (1..n - j).map(move |i| (i, j))).collect::<Vec<_>>().into_iter()
    }

    /// `b - K x` of a node, with or without its coupling to itself.
    fn residual(&self, (i, j): (usize, usize), b: [f64; 2], x: &[[f64; 2]], own: bool) -> [f64; 2] {
        let couplings = self.couplings[j % self.couplings.len()].of(i);
        let mut sum = b;
        for ((di, dj), block) in couplings.iter().filter(|(step, _)| own || *step != (0, 0)) {
            let (k, l) = (i.wrapping_add_signed(*di as isize), j.wrapping_add_signed(*dj as isize));
            let y = x[lattice::index(self.n, k, l)];
            (0..2).for_each(|a| sum[a] -= block[a][0] * y[0] + block[a][1] * y[1]);
        }
        sum
    }

    /// Relaxes a node as its equation says.
    fn relax(&self, x: &mut [[f64; 2]], (i, j): (usize, usize), b: &[[f64; 2]]) {
        let sum = self.residual((i, j), b[self.place(i, j)], x, false);
        let inverse = inverse(&self.couplings[j % self.couplings.len()].of(i)[0].1).expect("a diagonal");
        x[lattice::index(self.n, i, j)] = [0, 1].map(|a| inverse[a][0] * sum[0] + inverse[a][1] * sum[1]);
    }

    /// Place of an inner node in the vectors.
    fn place(&self, i: usize, j: usize) -> usize {
        self.first + lattice::row_start(self.n, j) + i - 1
    }
}

/// As many macro triangles as fill a register, and one less: each has another stiffness, and they lie apart and in no order.
fn check<L: Lanes>(lanes: L, tolerance: f64) {
    let sizes = [8, 11, 16, 33].map(|n| (Order::P1, n)).into_iter().chain([16, 18, 38].map(|n| (Order::P2, n)));
    for ((order, n), count) in sizes.flat_map(|size| [(size, L::COUNT), (size, L::COUNT - 1)]) {
        let apart = lattice::inner_count(n) + 3;
        let sample = |k: usize| {
            let law = PlaneLaw { lambda: 3.0 + k as f64, mu: 2.0, across: 3.0, plane: Plane::Strain };
            let level = Level { intervals: n, order };
            let stiffness = MacroStiffness::new(&two_blocks(), 1, level, &law).expect("a good triangle");
            let lattice = vector(lattice::node_count(n), 31 * k);
            Sample { n, couplings: Couplings::of_rows(&stiffness, order), first: (k + 1) % count * apart + 1, lattice }
        };
        let samples: Vec<Sample> = (0..count).map(sample).collect();
        let couplings: Vec<&[Couplings]> = samples.iter().map(|sample| sample.couplings.as_slice()).collect();
        let first: Vec<usize> = samples.iter().map(|sample| sample.first).collect();
        let (kernel, nodes) = (triangle_kernel(lanes, &couplings), InnerNodes { n, first: &first });
        assert_eq!(kernel.width(), L::COUNT);
        let (b, mut start) = (vector(count * apart, 5), vector(count * apart, 99));
        // Inner nodes come from the vector: what the lattice has of them before is nothing.
        let mut sides = vec![[77.0; 2]; lattice::node_count(n) * L::COUNT];
        for (lane, sample) in (0..L::COUNT).map(|lane| (lane, &samples[lane.min(count - 1)])) {
            (0..lattice::node_count(n)).for_each(|k| sides[k * L::COUNT + lane] = sample.lattice[k]);
            for (i, j) in sample.nodes() {
                start[sample.place(i, j)] = sample.lattice[lattice::index(n, i, j)];
                sides[lattice::index(n, i, j) * L::COUNT + lane] = [77.0; 2];
            }
        }
        let near = |words: &str, found: &[[f64; 2]], expected: &[[f64; 2]]| {
            for (node, (found, expected)) in found.iter().zip(expected).enumerate() {
                let apart = (0..2).map(|a| (found[a] - expected[a]).abs()).fold(0.0, f64::max);
                assert!(apart < tolerance, "{order:?}, n = {n}, {count} triangles, {words}, node {node}: {apart:e}");
            }
        };
        for sweep in [SweepHalves::Forward, SweepHalves::ForwardFromZero, SweepHalves::Both] {
            let (mut x, mut expected) = (start.clone(), start.clone());
            kernel.work(nodes, &mut sides.clone(), TriangleTask::Relax { sweep, b: &b, x: &mut x });
            for sample in &samples {
                let mut own = sample.lattice.clone();
                if sweep == SweepHalves::ForwardFromZero {
                    sample.nodes().for_each(|(i, j)| own[lattice::index(n, i, j)] = [0.0; 2]);
                }
                sample.nodes().for_each(|node| sample.relax(&mut own, node, &b));
                if sweep == SweepHalves::Both {
                    sample.nodes().rev().for_each(|node| sample.relax(&mut own, node, &b));
                }
                sample.nodes().for_each(|(i, j)| expected[sample.place(i, j)] = own[lattice::index(n, i, j)]);
            }
            near("sweep", &x, &expected);
        }
        let (mut y, mut product) = (start.clone(), start.clone());
        let (mut room, mut r) = (sides.clone(), sides.clone());
        kernel.work(nodes, &mut sides.clone(), TriangleTask::Multiply { x: &start, room: &mut room, y: &mut y });
        kernel.work(nodes, &mut sides.clone(), TriangleTask::Residual { b: &b, x: &start, r: &mut r });
        for (lane, sample) in samples.iter().enumerate() {
            for (i, j) in sample.nodes() {
                let place = sample.place(i, j);
                product[place] = sample.residual((i, j), [0.0; 2], &sample.lattice, true).map(|v| -v);
                let residual = sample.residual((i, j), b[place], &sample.lattice, true);
                near("residual", &[r[lattice::index(n, i, j) * L::COUNT + lane]], &[residual]);
            }
        }
        near("product", &y, &product);
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
