//! The couplings of the inner nodes of an even macro triangle: they repeat, and are not stored.
//!
//! A P1 node has six neighbours, all of the same kind; a P2 row alternates between two kinds of nodes, with 12 or 6. After the
//! stencils of hierarchical hybrid grids (Bergen, Hülsemann 2004).

use crate::body::MacroStiffness;
use crate::element::{Block, Order};

/// A step `(di, dj)` in the lattice.
pub type Step = (i32, i32);

/// Couplings of the nodes of a row: of those at even places, and of those at odd ones; alike for P1. The first coupling of a node is
/// with itself.
#[derive(Clone, Debug)]
pub struct Couplings([Vec<(Step, Block)>; 2]);

impl Couplings {
    /// The couplings of the inner nodes of an even macro triangle: of rows with even and with odd `j`, or of all.
    pub fn of_rows(stiffness: &MacroStiffness, order: Order) -> Vec<Self> {
        (0..order.degree()).map(|k| Self([0, 1].map(|i| couplings(stiffness, 2 + i, 2 + k)))).collect()
    }

    /// Couplings of node `i` of the row.
    pub fn of(&self, i: usize) -> &[(Step, Block)] {
        &self.0[i % 2]
    }

    /// Steps from nodes of a kind to the next rows; the opposite ones lead to the rows before.
    pub fn up_of(&self, kind: usize) -> Vec<Step> {
        self.0[kind].iter().map(|c| c.0).filter(|&(_, dj)| dj > 0).collect()
    }

    /// The coupling of nodes of a kind along a step, zero if there is none. Opposite ones are alike: they are their mean.
    pub fn block(&self, kind: usize, (di, dj): Step) -> Block {
        let along = |step: Step| self.0[kind].iter().find(|c| c.0 == step).map_or([[0.0; 2]; 2], |c| c.1);
        let (there, back) = (along((di, dj)), along((-di, -dj)));
        std::array::from_fn(|a| std::array::from_fn(|b| 0.5 * (there[a][b] + back[a][b])))
    }

    /// Largest sum of magnitudes in a row.
    pub fn norm_infinity(&self) -> f64 {
        let row = |kind: &[(Step, Block)], a: usize| kind.iter().map(|(_, k)| k[a][0].abs() + k[a][1].abs()).sum::<f64>();
        self.0.iter().flat_map(|kind| [row(kind, 0), row(kind, 1)]).fold(0.0, f64::max)
    }
}

/// Couplings of lattice node `(i, j)` as steps, that with itself first. A corner and the midside across from it are not coupled: the
/// stiffness of a straight triangle is zero there, but for rounding. All other steps lead along sides.
fn couplings(stiffness: &MacroStiffness, i: usize, j: usize) -> Vec<(Step, Block)> {
    let step = |(k, l): (usize, usize)| (k as i32 - i as i32, l as i32 - j as i32);
    let along_sides = |&((di, dj), _): &(Step, Block)| di == 0 || dj == 0 || di + dj == 0;
    let mut all: Vec<(Step, Block)> = stiffness.row(i, j).map(|(node, block)| (step(node), *block)).filter(along_sides).collect();
    all.sort_by_key(|&(step, _)| step != (0, 0));
    all
}
