//! The stiffness of strips: rows of a lattice inside a straight macro triangle, whose couplings repeat and are not stored.
//!
//! A P1 node has six neighbours, all of the same kind; a P2 row alternates between two kinds of nodes with 18 or 8. Node
//! numbers of lattice rows are contiguous, so a neighbour lies at the same distance from each node of a strip. After the
//! stencils of hierarchical hybrid grids (Bergen, Hülsemann 2004).

use crate::body::MacroStiffness;
use crate::element::{Block, Order};
use crate::mesh::Strip;
use crate::system::space::Components;
use std::cell::Cell;
use std::ops::Range;

/// Couplings of the nodes of a strip. Of vectors, `y`, `b` and `r` hold the nodes of the strip alone, `x` all of the rank.
pub trait Stencil {
    /// `y = K x`.
    fn multiply(&self, nodes: StripNodes, x: &[Components], y: &mut [Components]);

    /// `r = b - K x`.
    fn residual(&self, nodes: StripNodes, b: &[Components], x: &[Components], r: &mut [Components]);

    /// Relaxes the nodes one after the other.
    fn forward(&self, nodes: StripNodes, b: &[Components], x: &[Cell<Components>]);

    /// The same from the last to the first.
    fn backward(&self, nodes: StripNodes, b: &[Components], x: &[Cell<Components>]);

    /// Couplings as distances in node numbers: of every first and every second node.
    fn couplings(&self, width: usize) -> [Vec<(isize, Block)>; 2];

    /// Largest sum of magnitudes in a row.
    fn norm_infinity(&self) -> f64;
}

/// P1: nodes of one kind; their first coupling is with themselves.
struct NodeStencil<const N: usize> {
    /// Steps `(di, dj)` in the lattice.
    steps: [(i32, i32); N],
    blocks: [Block; N],
    /// The inverse of the first block.
    inverse: Block,
    /// That inverse times each of the others.
    scaled: [Block; N],
}

/// P2: nodes of two kinds in turn.
struct Alternating<const N: usize, const M: usize> {
    even: NodeStencil<N>,
    odd: NodeStencil<M>,
}

/// Where a strip lies among the nodes of its rank.
#[derive(Clone, Copy, Debug)]
pub struct StripNodes {
    /// Its first node.
    pub first: usize,
    /// How many.
    pub count: usize,
    /// Inner nodes of its lattice row: the way to the next row.
    pub width: usize,
}

impl StripNodes {
    /// Its nodes.
    pub fn range(self) -> Range<usize> {
        self.first..self.first + self.count
    }
}

/// The stencil of a strip.
///
/// # Panics
/// If a row has not the couplings of a strip: those of its macro triangle have.
pub fn stencil(stiffness: &MacroStiffness, order: Order, strip: &Strip) -> Box<dyn Stencil> {
    let [first, second] = [0, 1].map(|k| couplings(stiffness, strip.i.start + k, strip.j));
    let made: Option<Box<dyn Stencil>> = match (order, strip.j % 2) {
        (Order::P1, _) => NodeStencil::<7>::new(&first).map(|stencil| Box::new(stencil) as _),
        // Corners of triangles and the midsides between them.
        (Order::P2, 0) => Alternating::<19, 9>::new(&first, &second).map(|stencil| Box::new(stencil) as _),
        // Midsides alone.
        (Order::P2, _) => Alternating::<9, 9>::new(&first, &second).map(|stencil| Box::new(stencil) as _),
    };
    made.expect("the couplings of a strip")
}

impl<const N: usize> Stencil for NodeStencil<N> {
    fn multiply(&self, nodes: StripNodes, x: &[Components], y: &mut [Components]) {
        self.multiply_every::<1>(0, nodes, x, y);
    }

    fn residual(&self, nodes: StripNodes, b: &[Components], x: &[Components], r: &mut [Components]) {
        self.residual_every::<1>(0, nodes, b, x, r);
    }

    fn forward(&self, nodes: StripNodes, b: &[Components], x: &[Cell<Components>]) {
        let near = self.runs(nodes, x);
        (0..nodes.count).for_each(|k| self.relax(&near, b[k], k));
    }

    fn backward(&self, nodes: StripNodes, b: &[Components], x: &[Cell<Components>]) {
        let near = self.runs(nodes, x);
        (0..nodes.count).rev().for_each(|k| self.relax(&near, b[k], k));
    }

    fn couplings(&self, width: usize) -> [Vec<(isize, Block)>; 2] {
        [self.row(width), self.row(width)]
    }

    fn norm_infinity(&self) -> f64 {
        self.largest_row()
    }
}

impl<const N: usize, const M: usize> Stencil for Alternating<N, M> {
    fn multiply(&self, nodes: StripNodes, x: &[Components], y: &mut [Components]) {
        self.even.multiply_every::<2>(0, nodes, x, y);
        self.odd.multiply_every::<2>(1, nodes, x, y);
    }

    fn residual(&self, nodes: StripNodes, b: &[Components], x: &[Components], r: &mut [Components]) {
        self.even.residual_every::<2>(0, nodes, b, x, r);
        self.odd.residual_every::<2>(1, nodes, b, x, r);
    }

    fn forward(&self, nodes: StripNodes, b: &[Components], x: &[Cell<Components>]) {
        self.relax(nodes, b, x, 0..nodes.count);
    }

    fn backward(&self, nodes: StripNodes, b: &[Components], x: &[Cell<Components>]) {
        self.relax(nodes, b, x, (0..nodes.count).rev());
    }

    fn couplings(&self, width: usize) -> [Vec<(isize, Block)>; 2] {
        [self.even.row(width), self.odd.row(width)]
    }

    fn norm_infinity(&self) -> f64 {
        self.even.largest_row().max(self.odd.largest_row())
    }
}

impl<const N: usize, const M: usize> Alternating<N, M> {
    /// From the couplings of two nodes side by side; `None` if these have not as many.
    fn new(first: &[((i32, i32), Block)], second: &[((i32, i32), Block)]) -> Option<Self> {
        Some(Self { even: NodeStencil::new(first)?, odd: NodeStencil::new(second)? })
    }

    /// Gauss-Seidel over the nodes in some order.
    #[inline(always)]
    fn relax(&self, nodes: StripNodes, b: &[Components], x: &[Cell<Components>], order: impl Iterator<Item = usize>) {
        let (even, odd) = (self.even.runs(nodes, x), self.odd.runs(nodes, x));
        for k in order {
            if k % 2 == 0 { self.even.relax(&even, b[k], k) } else { self.odd.relax(&odd, b[k], k) }
        }
    }
}

impl<const N: usize> NodeStencil<N> {
    /// From the couplings of one node; `None` if it has not `N` of them.
    fn new(couplings: &[((i32, i32), Block)]) -> Option<Self> {
        let mut couplings = couplings.to_vec();
        // Couplings to nodes that a forward sweep has just changed come last: while those values are still being written, the
        // processor works on the others.
        couplings.sort_by_key(|&((di, dj), _)| ((di, dj) != (0, 0), dj == 0 && di < 0, di));
        let steps: [(i32, i32); N] = couplings.iter().map(|c| c.0).collect::<Vec<_>>().try_into().ok()?;
        let blocks: [Block; N] = couplings.iter().map(|c| c.1).collect::<Vec<_>>().try_into().ok()?;
        let inverse = inverse(&blocks[0])?;
        Some(Self { steps, blocks, inverse, scaled: blocks.map(|block| product(&inverse, &block)) })
    }

    /// Distances to the neighbours in node numbers.
    fn distances(&self, width: usize) -> [isize; N] {
        let width = width as isize;
        self.steps.map(|(di, dj)| {
            let rows = match dj {
                0 => 0,
                1 => width,
                2 => 2 * width - 1,
                -1 => -(width + 1),
                _ => -(2 * width + 3),
            };
            rows + di as isize
        })
    }

    /// Couplings as distances in node numbers.
    fn row(&self, width: usize) -> Vec<(isize, Block)> {
        self.distances(width).into_iter().zip(self.blocks).collect()
    }

    fn largest_row(&self) -> f64 {
        (0..2).map(|a| self.blocks.iter().map(|k| k[a][0].abs() + k[a][1].abs()).sum::<f64>()).fold(0.0, f64::max)
    }

    /// For each neighbour, the nodes that it runs through while the node runs through a strip.
    #[inline(always)]
    fn runs<'x, T>(&self, nodes: StripNodes, x: &'x [T]) -> [&'x [T]; N] {
        self.distances(nodes.width).map(|distance| &x[nodes.first.wrapping_add_signed(distance)..][..nodes.count])
    }

    /// `y = K x` at every `STEP`-th node of a strip from `start` on.
    fn multiply_every<const STEP: usize>(&self, start: usize, nodes: StripNodes, x: &[Components], y: &mut [Components]) {
        let (near, y) = (self.runs(nodes, x), &mut y[..nodes.count]);
        for k in (start..nodes.count).step_by(STEP) {
            let mut sum = [0.0; 2];
            for (near, block) in near.iter().zip(&self.blocks) {
                add(&mut sum, block, near[k]);
            }
            y[k] = sum;
        }
    }

    /// `r = b - K x` at every `STEP`-th node of a strip from `start` on.
    fn residual_every<const STEP: usize>(
        &self,
        start: usize,
        nodes: StripNodes,
        b: &[Components],
        x: &[Components],
        r: &mut [Components],
    ) {
        let (near, b, r) = (self.runs(nodes, x), &b[..nodes.count], &mut r[..nodes.count]);
        for k in (start..nodes.count).step_by(STEP) {
            let mut sum = b[k];
            for (near, block) in near.iter().zip(&self.blocks) {
                subtract(&mut sum, block, near[k]);
            }
            r[k] = sum;
        }
    }

    /// `x_k = D⁻¹ (b_k - (K - D) x)` at node `k` of a strip; `near` are the runs of the neighbours.
    #[inline(always)]
    fn relax(&self, near: &[&[Cell<Components>]; N], b: Components, k: usize) {
        let mut sum = [0.0; 2];
        add(&mut sum, &self.inverse, b);
        for (near, scaled) in near.iter().zip(&self.scaled).skip(1) {
            subtract(&mut sum, scaled, near[k].get());
        }
        near[0][k].set(sum);
    }
}

/// Couplings of lattice node `(i, j)` as steps.
fn couplings(stiffness: &MacroStiffness, i: usize, j: usize) -> Vec<((i32, i32), Block)> {
    stiffness.row(i, j).map(|((k, l), block)| ((k as i32 - i as i32, l as i32 - j as i32), *block)).collect()
}

/// Inverse of a block, if it has one.
pub fn inverse(k: &Block) -> Option<Block> {
    let determinant = k[0][0] * k[1][1] - k[0][1] * k[1][0];
    let inverse = [[k[1][1], -k[0][1]], [-k[1][0], k[0][0]]].map(|row| row.map(|v| v / determinant));
    inverse.iter().flatten().all(|v| v.is_finite()).then_some(inverse)
}

fn product(a: &Block, b: &Block) -> Block {
    a.map(|row| [0, 1].map(|j| row[0] * b[0][j] + row[1] * b[1][j]))
}

/// `sum += k x`.
#[inline(always)]
fn add(sum: &mut Components, k: &Block, x: Components) {
    sum[0] += k[0][0] * x[0] + k[0][1] * x[1];
    sum[1] += k[1][0] * x[0] + k[1][1] * x[1];
}

/// `sum -= k x`.
#[inline(always)]
pub fn subtract(sum: &mut Components, k: &Block, x: Components) {
    sum[0] -= k[0][0] * x[0] + k[0][1] * x[1];
    sum[1] -= k[1][0] * x[0] + k[1][1] * x[1];
}
