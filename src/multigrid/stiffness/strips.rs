//! The stiffness of strips: rows of a lattice inside a straight macro triangle, whose couplings repeat and are not stored.
//!
//! A P1 node has six neighbours, all of the same kind; a P2 row alternates between two kinds of nodes with 18 or 8. Node
//! numbers of lattice rows are contiguous, so a neighbour lies at the same distance from each node of a strip. After the
//! stencils of hierarchical hybrid grids (Bergen, Hülsemann 2004).

use crate::body::MacroStiffness;
use crate::element::{Block, Order};
use crate::mesh::Strip;
use std::ops::Range;

/// A step `(di, dj)` in the lattice.
pub type Step = (i32, i32);

/// Couplings of the nodes of a strip: of the first node and every second one from there, and of the others; alike for P1.
/// The first coupling of a node is with itself.
#[derive(Clone, Debug)]
pub struct Couplings {
    kinds: [Vec<(Step, Block)>; 2],
    /// Whether some nodes couple to their second neighbours in the same row: P2 rows with corners of triangles.
    pub second: bool,
    /// Steps to the next rows; the opposite ones lead to the rows before.
    pub up: Vec<Step>,
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

    /// Distance in node numbers that a step makes.
    #[inline(always)]
    pub fn distance(self, (di, dj): Step) -> isize {
        let width = self.width as isize;
        let rows = match dj {
            0 => 0,
            1 => width,
            2 => 2 * width - 1,
            -1 => -(width + 1),
            _ => -(2 * width + 3),
        };
        rows + di as isize
    }
}

impl Couplings {
    /// The couplings of a strip.
    pub fn new(stiffness: &MacroStiffness, order: Order, strip: &Strip) -> Self {
        let kinds = [0, 1].map(|k| couplings(stiffness, strip.i.start + k, strip.j));
        let mut up: Vec<Step> = kinds.iter().flatten().map(|c| c.0).filter(|&(_, dj)| dj > 0).collect();
        up.extend(kinds.iter().flatten().map(|c| c.0).filter(|&(_, dj)| dj < 0).map(|(di, dj)| (-di, -dj)));
        up.sort_unstable_by_key(|&(di, dj)| (dj, di));
        up.dedup();
        Self { kinds, second: order == Order::P2 && strip.j.is_multiple_of(2), up }
    }

    /// The couplings of the inner nodes of an even macro triangle: of rows with even and with odd `j`, or of all.
    pub fn of_rows(stiffness: &MacroStiffness, order: Order) -> Vec<Self> {
        let row = |k: usize| Self::new(stiffness, order, &Strip { j: 2 + k, i: 2..4, shape: 0 });
        (0..order.degree()).map(row).collect()
    }

    /// Couplings of node `k` of a strip.
    pub fn of(&self, k: usize) -> &[(Step, Block)] {
        &self.kinds[k % 2]
    }

    /// Steps from nodes of a kind to the next rows; the opposite ones lead to the rows before.
    pub fn up_of(&self, kind: usize) -> Vec<Step> {
        self.kinds[kind].iter().map(|c| c.0).filter(|&(_, dj)| dj > 0).collect()
    }

    /// The coupling of nodes of a kind along a step, zero if there is none. Opposite ones are alike: they are their mean.
    pub fn block(&self, kind: usize, (di, dj): Step) -> Block {
        let along = |step: Step| self.kinds[kind].iter().find(|c| c.0 == step).map_or([[0.0; 2]; 2], |c| c.1);
        let (there, back) = (along((di, dj)), along((-di, -dj)));
        std::array::from_fn(|a| std::array::from_fn(|b| 0.5 * (there[a][b] + back[a][b])))
    }

    /// Largest sum of magnitudes in a row.
    pub fn norm_infinity(&self) -> f64 {
        let row = |kind: &[(Step, Block)], a: usize| kind.iter().map(|(_, k)| k[a][0].abs() + k[a][1].abs()).sum::<f64>();
        self.kinds.iter().flat_map(|kind| [row(kind, 0), row(kind, 1)]).fold(0.0, f64::max)
    }
}

/// Couplings of lattice node `(i, j)` as steps, that with itself first.
fn couplings(stiffness: &MacroStiffness, i: usize, j: usize) -> Vec<(Step, Block)> {
    let step = |(k, l): (usize, usize)| (k as i32 - i as i32, l as i32 - j as i32);
    let mut all: Vec<(Step, Block)> = stiffness.row(i, j).map(|(node, block)| (step(node), *block)).collect();
    all.sort_by_key(|&(step, _)| step != (0, 0));
    all
}

/// Inverse of a block, if it has one.
pub fn inverse(k: &Block) -> Option<Block> {
    // No product of entries leaves the range of numbers.
    let scale = 1.0 / k[0][0].abs().max(k[0][1].abs()).max(k[1][0].abs()).max(k[1][1].abs());
    let [[a, b], [c, d]] = [[k[0][0] * scale, k[0][1] * scale], [k[1][0] * scale, k[1][1] * scale]];
    let factor = scale / (a * d - b * c);
    let inverse = [[d * factor, -b * factor], [-c * factor, a * factor]];
    inverse.as_flattened().iter().all(|v| v.is_finite()).then_some(inverse)
}
