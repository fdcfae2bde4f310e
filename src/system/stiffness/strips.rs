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

/// Couplings of the nodes of a strip.
pub enum Stencil {
    /// P1.
    Linear(Box<NodeStencil<7>>),
    /// P2, an even row: corners of triangles and the midsides between them.
    Corners(Box<(NodeStencil<19>, NodeStencil<9>)>),
    /// P2, an odd row: midsides alone.
    Midsides(Box<(NodeStencil<9>, NodeStencil<9>)>),
}

/// Couplings of one kind of node; the first is with itself.
pub struct NodeStencil<const N: usize> {
    /// Steps `(di, dj)` in the lattice.
    steps: [(i32, i32); N],
    blocks: [Block; N],
    /// The inverse of the first block.
    inverse: Block,
    /// That inverse times each of the others.
    scaled: [Block; N],
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

impl<const N: usize> NodeStencil<N> {
    /// From the couplings of one node; `None` if it has not `N` of them.
    pub fn new(couplings: &[((i32, i32), Block)]) -> Option<Self> {
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

    /// The couplings as [`NodeStencil::new`] takes them.
    fn couplings(&self) -> impl Iterator<Item = ((i32, i32), &Block)> {
        self.steps.iter().copied().zip(&self.blocks)
    }

    fn largest_row(&self) -> f64 {
        (0..2).map(|a| self.blocks.iter().map(|k| k[a][0].abs() + k[a][1].abs()).sum::<f64>()).fold(0.0, f64::max)
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

/// For each neighbour, the nodes that it runs through while the node runs through a strip.
#[inline(always)]
fn runs<const N: usize, T>(x: &[T], first: usize, count: usize, distances: [isize; N]) -> [&[T]; N] {
    distances.map(|distance| &x[first.wrapping_add_signed(distance)..][..count])
}

impl Stencil {
    /// Couplings of the nodes of a strip.
    ///
    /// # Panics
    /// If a row has not the couplings of a strip: those of its macro triangle have.
    pub fn of(stiffness: &MacroStiffness, order: Order, strip: &Strip) -> Self {
        let [first, second] = [0, 1].map(|k| couplings(stiffness, strip.i.start + k, strip.j));
        let made = match (order, strip.j % 2) {
            (Order::P1, _) => NodeStencil::new(&first).map(|kind| Self::Linear(Box::new(kind))),
            (Order::P2, 0) => NodeStencil::new(&first).zip(NodeStencil::new(&second)).map(|kinds| Self::Corners(Box::new(kinds))),
            (Order::P2, _) => {
                NodeStencil::new(&first).zip(NodeStencil::new(&second)).map(|kinds| Self::Midsides(Box::new(kinds)))
            }
        };
        made.expect("the couplings of a strip")
    }

    /// Calls `with` for each kind of node, first the one at the beginning of a strip: its couplings, and the steps from one of
    /// its nodes to the next.
    fn each_kind(&self, with: &mut impl EachKind) {
        match self {
            Self::Linear(kind) => with.kind(kind.as_ref(), 0, 1),
            Self::Corners(kinds) => {
                with.kind(&kinds.0, 0, 2);
                with.kind(&kinds.1, 1, 2);
            }
            Self::Midsides(kinds) => {
                with.kind(&kinds.0, 0, 2);
                with.kind(&kinds.1, 1, 2);
            }
        }
    }

    /// `y = K x` on a strip.
    pub fn multiply(&self, nodes: StripNodes, x: &[Components], y: &mut [Components]) {
        self.each_kind(&mut MultiplyOnStrip { nodes, x, y: &mut y[nodes.first..][..nodes.count] });
    }

    /// `r = b - K x` on a strip.
    pub fn residual(&self, nodes: StripNodes, b: &[Components], x: &[Components], r: &mut [Components]) {
        let (b, r) = (&b[nodes.first..][..nodes.count], &mut r[nodes.first..][..nodes.count]);
        self.each_kind(&mut ResidualOnStrip { nodes, b, x, r });
    }

    /// Relaxes the nodes of a strip one after the other.
    pub fn forward(&self, nodes: StripNodes, b: &[Components], x: &[Cell<Components>]) {
        match self {
            Self::Linear(kind) => one_kind(kind, nodes, b, x, 0..nodes.count),
            Self::Corners(kinds) => two_kinds(&kinds.0, &kinds.1, nodes, b, x, 0..nodes.count),
            Self::Midsides(kinds) => two_kinds(&kinds.0, &kinds.1, nodes, b, x, 0..nodes.count),
        }
    }

    /// The same from the last to the first.
    pub fn backward(&self, nodes: StripNodes, b: &[Components], x: &[Cell<Components>]) {
        match self {
            Self::Linear(kind) => one_kind(kind, nodes, b, x, (0..nodes.count).rev()),
            Self::Corners(kinds) => two_kinds(&kinds.0, &kinds.1, nodes, b, x, (0..nodes.count).rev()),
            Self::Midsides(kinds) => two_kinds(&kinds.0, &kinds.1, nodes, b, x, (0..nodes.count).rev()),
        }
    }

    /// Couplings of the nodes of a strip, as distances in node numbers: of every first and every second.
    pub fn couplings(&self, nodes: StripNodes) -> [Vec<(isize, Block)>; 2] {
        let mut all = Couplings { width: nodes.width, kinds: Vec::new() };
        self.each_kind(&mut all);
        let second = all.kinds.get(1).unwrap_or(&all.kinds[0]).clone();
        [all.kinds.swap_remove(0), second]
    }

    /// Largest sum of magnitudes in a row.
    pub fn norm_infinity(&self) -> f64 {
        let mut largest = LargestRow(0.0);
        self.each_kind(&mut largest);
        largest.0
    }
}

trait EachKind {
    fn kind<const N: usize>(&mut self, kind: &NodeStencil<N>, start: usize, step: usize);
}

struct MultiplyOnStrip<'a> {
    nodes: StripNodes,
    x: &'a [Components],
    y: &'a mut [Components],
}

impl EachKind for MultiplyOnStrip<'_> {
    fn kind<const N: usize>(&mut self, kind: &NodeStencil<N>, start: usize, step: usize) {
        let StripNodes { first, count, width } = self.nodes;
        let near = runs(self.x, first, count, kind.distances(width));
        for k in (start..count).step_by(step) {
            let mut sum = [0.0; 2];
            for (near, block) in near.iter().zip(&kind.blocks) {
                add(&mut sum, block, near[k]);
            }
            self.y[k] = sum;
        }
    }
}

struct ResidualOnStrip<'a> {
    nodes: StripNodes,
    b: &'a [Components],
    x: &'a [Components],
    r: &'a mut [Components],
}

impl EachKind for ResidualOnStrip<'_> {
    fn kind<const N: usize>(&mut self, kind: &NodeStencil<N>, start: usize, step: usize) {
        let StripNodes { first, count, width } = self.nodes;
        let near = runs(self.x, first, count, kind.distances(width));
        for k in (start..count).step_by(step) {
            let mut sum = self.b[k];
            for (near, block) in near.iter().zip(&kind.blocks) {
                subtract(&mut sum, block, near[k]);
            }
            self.r[k] = sum;
        }
    }
}

/// Gauss-Seidel over nodes of one kind.
#[inline(always)]
fn one_kind<const N: usize>(
    kind: &NodeStencil<N>,
    nodes: StripNodes,
    b: &[Components],
    x: &[Cell<Components>],
    order: impl Iterator<Item = usize>,
) {
    let b = &b[nodes.first..][..nodes.count];
    let near = runs(x, nodes.first, nodes.count, kind.distances(nodes.width));
    for k in order {
        relax(kind, &near, b[k], k);
    }
}

/// Gauss-Seidel over nodes of two kinds in turn.
#[inline(always)]
fn two_kinds<const N: usize, const M: usize>(
    even: &NodeStencil<N>,
    odd: &NodeStencil<M>,
    nodes: StripNodes,
    b: &[Components],
    x: &[Cell<Components>],
    order: impl Iterator<Item = usize>,
) {
    let b = &b[nodes.first..][..nodes.count];
    let near_even = runs(x, nodes.first, nodes.count, even.distances(nodes.width));
    let near_odd = runs(x, nodes.first, nodes.count, odd.distances(nodes.width));
    for k in order {
        if k % 2 == 0 { relax(even, &near_even, b[k], k) } else { relax(odd, &near_odd, b[k], k) }
    }
}

/// `x_k = D⁻¹ (b_k - (K - D) x)`.
#[inline(always)]
fn relax<const N: usize>(kind: &NodeStencil<N>, near: &[&[Cell<Components>]; N], b: Components, k: usize) {
    let mut sum = [0.0; 2];
    add(&mut sum, &kind.inverse, b);
    for (near, scaled) in near.iter().zip(&kind.scaled).skip(1) {
        subtract(&mut sum, scaled, near[k].get());
    }
    near[0][k].set(sum);
}

struct Couplings {
    width: usize,
    kinds: Vec<Vec<(isize, Block)>>,
}

impl EachKind for Couplings {
    fn kind<const N: usize>(&mut self, kind: &NodeStencil<N>, _: usize, _: usize) {
        let distances = kind.distances(self.width);
        self.kinds.push(distances.into_iter().zip(kind.couplings().map(|(_, block)| *block)).collect());
    }
}

struct LargestRow(f64);

impl EachKind for LargestRow {
    fn kind<const N: usize>(&mut self, kind: &NodeStencil<N>, _: usize, _: usize) {
        self.0 = self.0.max(kind.largest_row());
    }
}
