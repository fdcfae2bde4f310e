//! Stiffness of one macro triangle at one level, row by row of its lattice.

use super::node_positions::{NodePositions, positions, positions_of_one, with_midsides};
use crate::element::{BadJacobian, Block, Order, PlaneLaw, block, stiffness};
use crate::mesh::{Level, MacroMesh, Shapes, lattice};

/// Steps from a node to the nodes that share a triangle with it; those outside the lattice do not exist.
///
/// A P2 node couples to 18 others at a triangle corner and to 8 at a midside, by the parity of its `(i, j)`.
pub fn neighbours(order: Order, i: usize, j: usize) -> &'static [(isize, isize)] {
    const LINEAR: [(isize, isize); 7] = [(0, 0), (1, 0), (-1, 0), (0, 1), (0, -1), (1, -1), (-1, 1)];
    #[rustfmt::skip]
    const CORNER: [(isize, isize); 19] = [
        (0, 0), (1, 0), (-1, 0), (0, 1), (0, -1), (1, -1), (-1, 1),
        (2, 0), (-2, 0), (0, 2), (0, -2), (2, -2), (-2, 2), (1, 1), (-1, -1), (2, -1), (-2, 1), (1, -2), (-1, 2),
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

/// Rows of the stiffness of a macro triangle. A triangle's stiffness does not depend on its size: on a straight macro
/// triangle few are integrated, and of an even one the rows of a lattice of three triangles per edge stand for all others.
pub struct MacroStiffness {
    /// Lattice intervals of the level.
    n: usize,
    /// Lattice intervals of the stored rows.
    stored: usize,
    order: Order,
    /// Whether the rows are those of the nodes on the sides alone.
    sides: bool,
    rows: Vec<Block>,
}

impl MacroStiffness {
    /// Integrates macro triangle `triangle` at a level.
    ///
    /// # Errors
    /// [`BadJacobian`] if one of its triangles is turned inside out.
    pub fn new(mesh: &MacroMesh, triangle: usize, level: Level, law: &PlaneLaw) -> Result<Self, BadJacobian> {
        let shapes = mesh.repeats(triangle).then(|| mesh.shapes(triangle, level));
        Self::of_shapes(mesh, triangle, level, law, shapes, false)
    }

    /// The rows of the nodes on the sides alone, for work and memory that grow with their number. Of the triangles that are
    /// turned inside out it finds those with a node there.
    ///
    /// # Errors
    /// [`BadJacobian`] if one of those triangles is turned inside out.
    pub fn of_sides(mesh: &MacroMesh, triangle: usize, level: Level, law: &PlaneLaw) -> Result<Self, BadJacobian> {
        let shapes = mesh.repeats(triangle).then(|| mesh.shapes(triangle, level));
        let few = shapes.as_ref().is_some_and(Shapes::is_one);
        Self::of_shapes(mesh, triangle, level, law, shapes, !few)
    }

    /// Stiffness from the shapes of the small triangles; without shapes each small triangle is integrated by itself. With `sides` it has
    /// the rows of the nodes on the sides alone.
    fn of_shapes(
        mesh: &MacroMesh,
        triangle: usize,
        level: Level,
        law: &PlaneLaw,
        shapes: Option<Shapes>,
        sides: bool,
    ) -> Result<Self, BadJacobian> {
        let n = level.intervals;
        let even = shapes.as_ref().is_some_and(Shapes::is_one);
        let stored = if even { n.min(3 * level.order.degree()) } else { n };
        let width = 2 * level.order.degree() + 1;
        let count = if sides { 3 * n } else { lattice::node_count(stored) };
        let mut all = Self { n, stored, order: level.order, sides, rows: vec![[[0.0; 2]; 2]; count * width * width] };
        match (level.order, shapes) {
            (Order::P1, Some(shapes)) => all.repeat::<3>(mesh, triangle, law, &shapes)?,
            (Order::P2, Some(shapes)) => all.repeat::<6>(mesh, triangle, law, &shapes)?,
            (Order::P1, None) => all.integrate::<3>(mesh, triangle, law)?,
            (Order::P2, None) => all.integrate::<6>(mesh, triangle, law)?,
        }
        Ok(all)
    }

    /// Each triangle by itself.
    fn integrate<const N: usize>(&mut self, mesh: &MacroMesh, triangle: usize, law: &PlaneLaw) -> Result<(), BadJacobian> {
        let level = Level { intervals: self.n, order: self.order };
        let all = (!self.sides).then(|| NodePositions::new(mesh, triangle, level));
        for small in self.triangles() {
            let nodes = small.nodes::<N>();
            let x = all.as_ref().map_or_else(|| positions(mesh, triangle, level, &nodes), |all| all.of(&nodes));
            self.add(&nodes, &stiffness::<N>(&x, law, false)?);
        }
        Ok(())
    }

    /// One triangle of each shape, the largest there is: its corners have the fewest digits in common.
    fn repeat<const N: usize>(
        &mut self,
        mesh: &MacroMesh,
        triangle: usize,
        law: &PlaneLaw,
        shapes: &Shapes,
    ) -> Result<(), BadJacobian> {
        let mut known: [Option<[[Block; N]; N]>; Shapes::COUNT] = [None; Shapes::COUNT];
        for small in self.triangles() {
            let shape = shapes.of(small.nodes::<3>());
            let k = match known[shape] {
                Some(k) => k,
                None => {
                    let corners = shapes.corners(shape).map(|at| mesh.position(triangle, at.x, at.y));
                    stiffness::<N>(&with_midsides(corners), law, true)?
                }
            };
            known[shape] = Some(k);
            self.add(&small.nodes::<N>(), &k);
        }
        Ok(())
    }

    /// The triangles of the stored rows.
    fn triangles(&self) -> impl Iterator<Item = lattice::Triangle> + use<> {
        let sides = self.sides.then(|| lattice::side_triangles(self.stored, self.order));
        let all = (!self.sides).then(|| lattice::triangles(self.stored, self.order));
        sides.into_iter().flatten().chain(all.into_iter().flatten())
    }

    /// Place of a node's first block; nothing if its row is not stored.
    #[inline]
    fn start(&self, i: usize, j: usize) -> Option<usize> {
        let index = match self.sides {
            false => lattice::index(self.stored, i, j),
            true => match lattice::place(self.n, i, j) {
                lattice::Place::Corner(corner) => self.n * corner,
                lattice::Place::Side { side, position } => self.n * side + position,
                lattice::Place::Inside(_) => return None,
            },
        };
        Some(index * self.width() * self.width())
    }

    /// Adds the stiffness of one triangle to the rows of its nodes.
    fn add<const N: usize>(&mut self, nodes: &[(usize, usize); N], k: &[[Block; N]; N]) {
        for (a, row) in nodes.iter().zip(k) {
            let Some(start) = self.start(a.0, a.1) else { continue };
            for (b, coupling) in nodes.iter().zip(row) {
                let slot = self.slot(b.0 as isize - a.0 as isize, b.1 as isize - a.1 as isize);
                block::add(&mut self.rows[start + slot], coupling);
            }
        }
    }

    fn width(&self) -> usize {
        2 * self.order.degree() + 1
    }

    fn slot(&self, di: isize, dj: isize) -> usize {
        let reach = self.order.degree() as isize;
        ((dj + reach) * (2 * reach + 1) + di + reach) as usize
    }

    /// Couplings of node `(i, j)`: `(the other node, block)`; only nodes of the lattice.
    ///
    /// # Panics
    /// If the rows are those of the sides and the node lies on none.
    #[inline]
    pub fn row(&self, i: usize, j: usize) -> impl Iterator<Item = ((usize, usize), &Block)> {
        let (ri, rj) = self.representative(i, j);
        let start = self.start(ri, rj).expect("a row that is stored");
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

/// Stiffness of a macro triangle that is a single triangle: its corners, then its midsides.
///
/// # Errors
/// [`BadJacobian`] if it is turned inside out.
pub fn one_stiffness<const N: usize>(
    mesh: &MacroMesh,
    triangle: usize,
    level: Level,
    law: &PlaneLaw,
) -> Result<[[Block; N]; N], BadJacobian> {
    stiffness(&positions_of_one(mesh, triangle, level), law, !mesh.is_curved(triangle))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::element::Plane;
    use crate::geometry::{Curve, Point};
    use crate::mesh::samples::two_blocks;

    const LAW: PlaneLaw = PlaneLaw { lambda: 3.0, mu: 2.0, across: 3.0, plane: Plane::Strain };

    /// Rows of a macro triangle, once as they are made and once with every triangle integrated by itself.
    fn both(mesh: &MacroMesh, triangle: usize, level: Level) -> [MacroStiffness; 2] {
        [Some(mesh.shapes(triangle, level)), None]
            .map(|shapes| MacroStiffness::of_shapes(mesh, triangle, level, &LAW, shapes, false).expect("a good triangle"))
    }

    fn check_rows([few, all]: [MacroStiffness; 2], words: &str) {
        for (i, j) in lattice::nodes(all.n) {
            let pairs: Vec<_> = few.row(i, j).zip(all.row(i, j)).collect();
            assert_eq!(pairs.len(), all.row(i, j).count());
            for ((node, block), (other, exact)) in pairs {
                assert_eq!(node, other);
                let difference = (0..4).map(|k| (block[k / 2][k % 2] - exact[k / 2][k % 2]).abs()).fold(0.0, f64::max);
                assert!(difference < 1e-10, "{words}, node ({i}, {j}) to {node:?}: {difference:e}");
            }
        }
    }

    #[test]
    fn the_stored_rows_stand_for_all_rows() {
        let mesh = two_blocks();
        for (order, n) in [(Order::P1, 1), (Order::P1, 2), (Order::P1, 7), (Order::P2, 2), (Order::P2, 4), (Order::P2, 10)] {
            check_rows(both(&mesh, 3, Level { intervals: n, order }), &format!("{order:?}, n = {n}"));
        }
    }

    #[test]
    fn few_shapes_stand_for_all_triangles_of_a_graded_one() {
        for graded in [&[[0.9, 1.0]][..], &[[2.0, 2.0]], &[[0.9, 1.0], [2.0, 2.0]], &[[0.9, 1.0], [2.0, 1.0], [2.0, 2.0]]] {
            let mut mesh = two_blocks();
            graded.iter().zip([0.2, 0.35, 0.15]).for_each(|(&at, ratio)| mesh.grade(at.into(), ratio).expect("a vertex"));
            for (order, refine) in
                [(Order::P1, 0), (Order::P1, 1), (Order::P1, 4), (Order::P2, 0), (Order::P2, 1), (Order::P2, 3)]
            {
                let level = Level { intervals: order.degree() << refine, order };
                for triangle in (0..mesh.triangles.len()).filter(|&triangle| mesh.is_graded(triangle)) {
                    check_rows(both(&mesh, triangle, level), &format!("{graded:?}, triangle {triangle}, {level:?}"));
                }
            }
        }
    }

    #[test]
    fn rows_of_the_sides_are_those_of_the_whole() {
        let mut mesh = two_blocks();
        let circle = Curve::Circle { centre: [1.0, -2.0], radius: 10f64.sqrt() };
        mesh.bend("arc", &["lower.seam".into()], &circle).expect("the ends lie on it");
        mesh.grade([2.0, 2.0].into(), 0.2).expect("a vertex");
        for (order, n) in [(Order::P1, 1), (Order::P1, 2), (Order::P1, 8), (Order::P2, 2), (Order::P2, 4), (Order::P2, 16)] {
            let level = Level { intervals: n, order };
            for triangle in 0..mesh.triangles.len() {
                let all = MacroStiffness::new(&mesh, triangle, level, &LAW).expect("a good triangle");
                let sides = MacroStiffness::of_sides(&mesh, triangle, level, &LAW).expect("a good triangle");
                for (i, j) in lattice::nodes(n).filter(|&(i, j)| !matches!(lattice::place(n, i, j), lattice::Place::Inside(_))) {
                    assert!(all.row(i, j).eq(sides.row(i, j)), "triangle {triangle}, {level:?}, node ({i}, {j})");
                }
            }
        }
    }

    #[test]
    fn rigid_motions_have_no_force_on_a_bent_triangle() {
        let mut mesh = two_blocks();
        let circle = Curve::Circle { centre: [1.0, -2.0], radius: 10f64.sqrt() };
        mesh.bend("arc", &["lower.seam".into()], &circle).expect("the ends lie on it");
        let bent = (0..2).find(|&t| mesh.is_curved(t)).expect("one triangle has the arc");
        for (order, n) in [(Order::P1, 4), (Order::P2, 4)] {
            let level = Level { intervals: n, order };
            let k = MacroStiffness::new(&mesh, bent, level, &LAW).expect("a good triangle");
            for (i, j) in lattice::nodes(n) {
                let mut force = Point::zeros();
                for (node, block) in k.row(i, j) {
                    let x = mesh.node_position(bent, level, node);
                    let u = Point::new(0.3 - x.y, 0.1 + x.x);
                    force += Point::new(block[0][0] * u.x + block[0][1] * u.y, block[1][0] * u.x + block[1][1] * u.y);
                }
                assert!(force.norm() < 1e-12, "{order:?}: {force}");
            }
        }
    }
}
