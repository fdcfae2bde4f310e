//! Elastic supports: springs all along physical curves.
//!
//! The stiffness along the true boundary makes multigrid as quick with springs as with supports: at most 11 iterations on
//! straight boundaries for `k h/E` from 1e-6 to 1e6; on arcs 26 at 1e6, where a support is the better word.

use crate::element::{Block, edge_shape};
use crate::geometry::{AXES, Formula, Point, gauss_points};
use crate::mesh::{BoundaryEdge, MacroMesh, Numbering, each_once};

/// Gauss points on an element edge: exact for P2 and a stiffness of degree 3.
const POINTS: usize = 4;

/// Springs on physical curves that hold a body to where it was drawn.
#[derive(Clone, Debug)]
pub struct Springs {
    /// Name in the case file.
    pub name: String,
    /// Physical curves they stand on.
    pub on: Vec<String>,
    /// What they resist.
    pub stiffness: SpringStiffness,
}

/// Stiffness of springs: force per length of the boundary and per displacement (stress per length), formulas of `x, y`.
#[derive(Clone, Debug)]
pub enum SpringStiffness {
    /// Along the normal of the boundary.
    Normal(Formula),
    /// Along x and along y.
    Axes([Option<Formula>; 2]),
}

impl SpringStiffness {
    /// Directions and stiffnesses at a point of the boundary with this normal.
    pub fn at(&self, x: Point, normal: Point) -> Vec<(Point, f64)> {
        let value = |formula: &Formula| formula.value(&[x.x, x.y]);
        match self {
            Self::Normal(formula) => vec![(normal, value(formula))],
            Self::Axes(both) => {
                let axes = AXES.into_iter().zip(both);
                axes.filter_map(|(axis, formula)| Some((axis, value(formula.as_ref()?)))).collect()
            }
        }
    }
}

impl Springs {
    /// The macro edges that they stand on, each once.
    pub fn edges(&self, mesh: &MacroMesh) -> Vec<u32> {
        each_once(mesh.edges_on(&self.on))
    }

    /// Hands the stiffness of each pair of nodes on a macro edge, `∫ N_a N_b k ds` in global axes, to `add(a, b, block)`. Place,
    /// normal and length are those of the true edge on every level, so that coarse levels are as stiff as fine ones.
    pub fn stiffness(&self, mesh: &MacroMesh, edge: u32, numbering: &Numbering, mut add: impl FnMut(usize, usize, Block)) {
        for small in BoundaryEdge::all_of(mesh, edge, numbering) {
            let numbers: Vec<usize> = small.nodes.iter().map(|node| node.number(mesh, numbering)).collect();
            let [from, to] = [0, 1].map(|k| small.nodes[k].fraction(mesh, numbering));
            let count = numbers.len();
            let mut blocks = [[[[0.0; 2]; 2]; 3]; 3];
            for &(t, weight) in gauss_points(POINTS) {
                let at = from + t * (to - from);
                let x = mesh.edge_position(edge, at);
                let area = weight * (mesh.edge_slope(edge, at) * (to - from)).norm() * mesh.plane.width(x);
                let shape = edge_shape(count, t);
                let all = self.stiffness.at(x, mesh.edge_normal(edge, at));
                for (a, b) in (0..count).flat_map(|a| (0..count).map(move |b| (a, b))) {
                    for (direction, k) in &all {
                        let stiffness = direction * direction.transpose() * (k * area * shape[a] * shape[b]);
                        for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                            blocks[a][b][i][j] += stiffness[(i, j)];
                        }
                    }
                }
            }
            for (a, b) in (0..count).flat_map(|a| (0..count).map(move |b| (a, b))) {
                add(numbers[a], numbers[b], blocks[a][b]);
            }
        }
    }
}
