//! Stiffness of one macro triangle at one level, row by row of its lattice.

use crate::element::{BadJacobian, Block, Order, PlaneStrain, stiffness};
use crate::geometry::Point;
use crate::mesh::{Level, MacroMesh, lattice};

/// Steps from a node to the nodes that share a triangle with it; those outside the lattice do not exist.
///
/// A P2 node couples to 18 others at a triangle corner and to 8 at a midside, by the parity of its `(i, j)`.
pub fn neighbours(order: Order, i: usize, j: usize) -> &'static [(isize, isize)] {
    const LINEAR: [(isize, isize); 7] = [(0, 0), (1, 0), (-1, 0), (0, 1), (0, -1), (1, -1), (-1, 1)];
    const CORNER: [(isize, isize); 19] = [
        (0, 0),
        (1, 0),
        (-1, 0),
        (0, 1),
        (0, -1),
        (1, -1),
        (-1, 1),
        (2, 0),
        (-2, 0),
        (0, 2),
        (0, -2),
        (2, -2),
        (-2, 2),
        (1, 1),
        (-1, -1),
        (2, -1),
        (-2, 1),
        (1, -2),
        (-1, 2),
    ];
    const HORIZONTAL: [(isize, isize); 9] = [(0, 0), (1, 0), (-1, 0), (-1, 2), (0, 1), (-1, 1), (1, -2), (0, -1), (1, -1)];
    const VERTICAL: [(isize, isize); 9] = [(0, 0), (0, 1), (0, -1), (2, -1), (1, 0), (1, -1), (-2, 1), (-1, 0), (-1, 1)];
    const DIAGONAL: [(isize, isize); 9] = [(0, 0), (1, -1), (-1, 1), (-1, -1), (-1, 0), (0, -1), (1, 1), (1, 0), (0, 1)];
    match (order, i % 2, j % 2) {
        (Order::P1, ..) => &LINEAR,
        (_, 0, 0) => &CORNER,
        (_, 1, 0) => &HORIZONTAL,
        (_, 0, _) => &VERTICAL,
        _ => &DIAGONAL,
    }
}

/// Rows of the stiffness of a macro triangle. A straight one needs the rows of a lattice of three triangles per edge
/// only: all others repeat them, because a triangle's stiffness does not depend on its size.
pub struct MacroStiffness {
    /// Lattice intervals of the level.
    n: usize,
    /// Lattice intervals of the stored rows.
    stored: usize,
    order: Order,
    rows: Vec<Block>,
}

impl MacroStiffness {
    /// Integrates macro triangle `triangle` at a level.
    ///
    /// # Errors
    /// [`BadJacobian`] if one of its triangles is turned inside out.
    pub fn new(mesh: &MacroMesh, triangle: usize, level: Level, law: &PlaneStrain) -> Result<Self, BadJacobian> {
        let curved = mesh.is_curved(triangle);
        let n = level.intervals;
        let stored = if curved { n } else { n.min(3 * level.order.degree()) };
        let width = 2 * level.order.degree() + 1;
        let rows = vec![[[0.0; 2]; 2]; lattice::node_count(stored) * width * width];
        let mut all = Self { n, stored, order: level.order, rows };
        match level.order {
            Order::P1 => all.integrate::<3>(mesh, triangle, law, curved)?,
            Order::P2 => all.integrate::<6>(mesh, triangle, law, curved)?,
        }
        Ok(all)
    }

    fn integrate<const N: usize>(
        &mut self,
        mesh: &MacroMesh,
        triangle: usize,
        law: &PlaneStrain,
        curved: bool,
    ) -> Result<(), BadJacobian> {
        let mut same = None;
        for small in lattice::triangles(self.stored, self.order) {
            let nodes = small.nodes::<N>();
            let k = match same {
                Some(k) if !curved => k,
                _ => stiffness::<N>(&positions(mesh, triangle, self.stored, &nodes), law, !curved)?,
            };
            same = Some(k);
            for (a, row) in nodes.iter().zip(&k) {
                let start = lattice::index(self.stored, a.0, a.1) * self.width() * self.width();
                for (b, block) in nodes.iter().zip(row) {
                    let slot = self.slot(b.0 as isize - a.0 as isize, b.1 as isize - a.1 as isize);
                    let sum = &mut self.rows[start + slot];
                    for i in 0..2 {
                        for j in 0..2 {
                            sum[i][j] += block[i][j];
                        }
                    }
                }
            }
        }
        Ok(())
    }

    fn width(&self) -> usize {
        2 * self.order.degree() + 1
    }

    fn slot(&self, di: isize, dj: isize) -> usize {
        let reach = self.order.degree() as isize;
        ((dj + reach) * (2 * reach + 1) + di + reach) as usize
    }

    /// Couplings of node `(i, j)`: `(steps to the other node, block)`; only nodes of the lattice.
    #[inline]
    pub fn row(&self, i: usize, j: usize) -> impl Iterator<Item = ((usize, usize), &Block)> {
        let (ri, rj) = self.representative(i, j);
        let start = lattice::index(self.stored, ri, rj) * self.width() * self.width();
        neighbours(self.order, i, j).iter().filter_map(move |&(di, dj)| {
            let (i, j) = (i.wrapping_add_signed(di), j.wrapping_add_signed(dj));
            let inside = i <= self.n && j <= self.n && i + j <= self.n;
            inside.then(|| ((i, j), &self.rows[start + self.slot(di, dj)]))
        })
    }

    /// The stored node with the same surroundings as node `(i, j)`.
    fn representative(&self, i: usize, j: usize) -> (usize, usize) {
        if self.stored == self.n {
            return (i, j);
        }
        let (d, m) = (self.order.degree(), self.stored);
        // Coordinate of a node inside an interval range: the same parity, one triangle from the near end.
        let inner = |c: usize| if d == 1 { 1 } else { 2 + c % 2 };
        match lattice::place(self.n, i, j) {
            lattice::Place::Corner(corner) => lattice::side_node(m, corner, 0),
            lattice::Place::Side { side, position } => lattice::side_node(m, side, inner(position)),
            lattice::Place::Inside(_) if d == 2 && i % 2 == 1 && j % 2 == 1 => (1, 1),
            lattice::Place::Inside(_) => (inner(i), inner(j)),
        }
    }
}

/// Positions of lattice nodes of a macro triangle.
pub fn positions<const N: usize>(mesh: &MacroMesh, triangle: usize, n: usize, nodes: &[(usize, usize); N]) -> [Point; N] {
    nodes.map(|(i, j)| mesh.position(triangle, i as f64 / n as f64, j as f64 / n as f64))
}
