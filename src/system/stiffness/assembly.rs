//! Assembly of the stiffness of one level, with room for the contact couplings.

use super::lattice_operator::Strips;
use super::room::{ContactNeighbours, Counts, fill_room};
use super::strips::{Place, Stencil};
use crate::body::{Constraint, MacroStiffness, neighbours};
use crate::element::Block;
use crate::geometry::Point;
use crate::mesh::{Strip, TriangleNumbers, lattice};
use crate::petsc::{Matrix, Session};
use crate::system::solver::want_entries;
use crate::system::{Scene, Space, SystemError};
use std::collections::BTreeMap;

/// A level to assemble, and what need not be: the strips of each macro triangle of this rank.
pub struct Assembly<'a> {
    scene: &'a Scene,
    space: &'a Space,
    strips: BTreeMap<usize, Vec<Strip>>,
    has_strips: bool,
}

impl<'a> Assembly<'a> {
    /// With all rows stored.
    pub fn stored(scene: &'a Scene, space: &'a Space) -> Self {
        Self { scene, space, strips: BTreeMap::new(), has_strips: false }
    }

    /// With strips, if they hold most nodes of some rank and no option of the user's wants entries. **Collective**
    pub fn with_strips(scene: &'a Scene, space: &'a Space, session: &Session) -> Self {
        let own = scene.partition.triangles_of(session.rank()).iter().map(|&triangle| triangle as usize);
        let level = space.numbering.level;
        let strips: BTreeMap<usize, Vec<Strip>> = own.map(|triangle| (triangle, scene.mesh.strips(triangle, level))).collect();
        let count: usize = strips.values().flatten().map(|strip| strip.i.len()).sum();
        if session.any(2 * count > space.own.len()) && !want_entries(session) {
            Self { scene, space, strips, has_strips: true }
        } else {
            Self::stored(scene, space)
        }
    }

    /// Whether some rank has strips.
    pub fn has_strips(&self) -> bool {
        self.has_strips
    }

    /// An empty matrix with exact room for the rows that are stored, and their contact couplings. **Collective**
    pub fn prepare(&self, contact: &ContactNeighbours, session: &Session) -> Result<Matrix, SystemError> {
        let (scene, space) = (self.scene, self.space);
        let mut counts = Counts::new(space, contact);
        for (&triangle, strips) in &self.strips {
            for place in strips.iter().map(|strip| self.place(triangle, strip)) {
                counts.leave_out(place.first..place.first + place.count);
            }
        }
        let n = space.numbering.level.intervals;
        for triangle in 0..scene.mesh.triangles.len() {
            let numbers = space.numbering.triangle(&scene.mesh, triangle);
            if scene.partition.owner(triangle as u32) == session.rank() {
                let rows = outside(n, self.strips_of(triangle));
                rows.for_each(|node| count_row(scene, space, triangle, node, &mut counts));
            } else if touches(n, space, &numbers) {
                sides(n).for_each(|node| count_row(scene, space, triangle, node, &mut counts));
            }
        }
        let (diagonal, off_diagonal) = counts.finish();
        let mut matrix = Matrix::aij(session, space.local_unknowns(), space.local_unknowns(), 2, &diagonal, &off_diagonal)?;
        matrix.set_positive_definite(true)?;
        if self.has_strips {
            matrix.expect_empty_rows()?;
        }
        Ok(matrix)
    }

    /// Adds the stiffness of the macro triangles that this rank owns, keeps room for contact by explicit zeros, and assembles.
    /// Rows and columns of prescribed components are zero but for the diagonal; what their displacement does to free rows goes
    /// to `lift(node, force in the node's frame)`. Gives the rows that are not stored. **Collective**
    pub fn fill(
        &self,
        matrix: &mut Matrix,
        contact: &ContactNeighbours,
        session: &Session,
        mut lift: impl FnMut(usize, Point),
    ) -> Result<Strips, SystemError> {
        let laws = self.scene.laws();
        let mut strips = Strips::default();
        let mut fill = || -> Result<(), SystemError> {
            for &triangle in self.scene.partition.triangles_of(session.rank()) {
                let law = &laws[self.scene.mesh.triangles[triangle as usize].body as usize];
                let level = self.space.numbering.level;
                let stiffness = MacroStiffness::new(&self.scene.mesh, triangle as usize, level, law)?;
                self.add_triangle(matrix, triangle as usize, &stiffness, &mut lift)?;
                self.add_strips(triangle as usize, &stiffness, &mut strips);
            }
            Ok(())
        };
        match fill() {
            Err(SystemError::Petsc(error)) => return Err(error.into()),
            filled => session.agree(filled).map_err(SystemError::Case)?,
        }
        fill_room(matrix, self.space, contact)?;
        matrix.assemble()?;
        Ok(strips)
    }

    fn add_triangle(
        &self,
        matrix: &mut Matrix,
        triangle: usize,
        stiffness: &MacroStiffness,
        lift: &mut impl FnMut(usize, Point),
    ) -> Result<(), SystemError> {
        let n = self.space.numbering.level.intervals;
        let numbers = self.space.numbering.triangle(&self.scene.mesh, triangle);
        let constraint = |i: usize, j: usize, node: usize| match lattice::place(n, i, j) {
            lattice::Place::Inside(_) => None,
            _ => self.space.constraints.get(node),
        };
        let supported = sides(n).any(|(i, j)| constraint(i, j, numbers.node(i, j)).is_some());
        let mut columns: Vec<i32> = Vec::with_capacity(19);
        let mut values: Vec<f64> = vec![0.0; 4 * 19];
        for (i, j) in outside(n, self.strips_of(triangle)) {
            let row = numbers.node(i, j);
            let held = if supported { constraint(i, j, row) } else { None };
            columns.clear();
            let count = stiffness.row(i, j).count();
            for (slot, ((k, l), block)) in stiffness.row(i, j).enumerate() {
                let column = numbers.node(k, l);
                let block = match (held, if supported { constraint(k, l, column) } else { None }) {
                    (None, None) => *block,
                    (left, right) => constrained(block, left, right, row == column, |force| lift(row, force)),
                };
                columns.push(column as i32);
                for (a, parts) in block.iter().enumerate() {
                    values[2 * (a * count + slot)] = parts[0];
                    values[2 * (a * count + slot) + 1] = parts[1];
                }
            }
            matrix.add_blocks(&[row as i32], &columns, &values[..4 * count])?;
        }
        Ok(())
    }

    /// Adds the strips of a macro triangle: one stencil for each shape, and for P2 for even and odd rows.
    fn add_strips(&self, triangle: usize, stiffness: &MacroStiffness, strips: &mut Strips) {
        let order = self.space.numbering.level.order;
        let mut known = BTreeMap::new();
        for strip in self.strips_of(triangle) {
            let stencil = *known.entry((strip.shape, strip.j % order.degree())).or_insert_with(|| {
                strips.stencils.push(Stencil::of(stiffness, order, strip));
                strips.stencils.len() - 1
            });
            strips.places.push((self.place(triangle, strip), stencil));
        }
    }

    fn strips_of(&self, triangle: usize) -> &[Strip] {
        self.strips.get(&triangle).map_or(&[], Vec::as_slice)
    }

    /// Where a strip lies among the nodes of this rank.
    fn place(&self, triangle: usize, strip: &Strip) -> Place {
        let numbers = self.space.numbering.triangle(&self.scene.mesh, triangle);
        let first = numbers.node(strip.i.start, strip.j) - self.space.own.start;
        Place { first, count: strip.i.len(), width: self.space.numbering.level.intervals - 1 - strip.j }
    }
}

/// Counts the couplings of an owned node within one macro triangle; those along an edge with its first triangle alone.
fn count_row(scene: &Scene, space: &Space, triangle: usize, (i, j): (usize, usize), counts: &mut Counts) {
    let level = space.numbering.level;
    let n = level.intervals;
    let numbers = space.numbering.triangle(&scene.mesh, triangle);
    let row = numbers.node(i, j);
    if !space.own.contains(&row) {
        return;
    }
    let on_sides = [0, 1, 2].map(|side| on_side(n, side, i, j));
    let counted = |k: usize, l: usize| {
        let edges = scene.mesh.triangles[triangle].edges;
        let first = |side: usize| scene.mesh.edges[edges[side] as usize].triangles[0] == Some(triangle as u32);
        (0..3).any(|side| on_sides[side] && on_side(n, side, k, l) && !first(side))
    };
    for &(di, dj) in neighbours(level.order, i, j) {
        let (k, l) = (i.wrapping_add_signed(di), j.wrapping_add_signed(dj));
        if (di, dj) != (0, 0) && k <= n && l <= n && k + l <= n && !counted(k, l) {
            counts.add(row, numbers.node(k, l));
        }
    }
}

/// Whether this rank owns nodes of a macro triangle that it does not own itself.
fn touches(n: usize, space: &Space, numbers: &TriangleNumbers) -> bool {
    (0..3).any(|side| {
        let corner = lattice::side_node(n, side, 0);
        let middle = lattice::side_node(n, side, n / 2);
        [corner, middle].into_iter().any(|(i, j)| space.own.contains(&numbers.node(i, j)))
    })
}

/// Nodes on the sides of a lattice.
fn sides(n: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..3).flat_map(move |side| (0..n).map(move |position| lattice::side_node(n, side, position)))
}

/// Nodes of a lattice outside of its strips, row by row.
fn outside(n: usize, strips: &[Strip]) -> impl Iterator<Item = (usize, usize)> + '_ {
    (0..=n).flat_map(move |j| {
        let of_row = strips.partition_point(|strip| strip.j < j)..strips.partition_point(|strip| strip.j <= j);
        let starts = std::iter::once(0).chain(strips[of_row.clone()].iter().map(|strip| strip.i.end));
        let ends = strips[of_row].iter().map(|strip| strip.i.start).chain([n + 1 - j]);
        starts.zip(ends).flat_map(move |(start, end)| (start..end).map(move |i| (i, j)))
    })
}

/// Whether a lattice node lies on a side, corners included.
fn on_side(n: usize, side: usize, i: usize, j: usize) -> bool {
    match side {
        0 => j == 0,
        1 => i + j == n,
        _ => i == 0,
    }
}

/// A block in the frames of its nodes, without the couplings of prescribed components.
fn constrained(
    block: &Block,
    row: Option<&Constraint>,
    column: Option<&Constraint>,
    diagonal: bool,
    mut lift: impl FnMut(Point),
) -> Block {
    let mut k = nalgebra::Matrix2::new(block[0][0], block[0][1], block[1][0], block[1][1]);
    if let Some(row) = row {
        k = row.frame().transpose() * k;
    }
    if let Some(column) = column {
        k *= column.frame();
        let force = k * column.prescribed();
        if force != Point::zeros() {
            lift(row.map_or(force, |row| row.free_part(force)));
        }
    }
    let fixed = |constraint: Option<&Constraint>, a: usize| constraint.is_some_and(|c| c.fixed[a]);
    std::array::from_fn(|a| {
        std::array::from_fn(|b| {
            let kept = diagonal && a == b;
            if !kept && (fixed(row, a) || fixed(column, b)) { 0.0 } else { k[(a, b)] }
        })
    })
}
