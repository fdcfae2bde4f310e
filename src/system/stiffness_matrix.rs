//! Assembly of the stiffness of one level, with room for the contact couplings.

use super::{Scene, Space, SystemError};
use crate::body::{Constraint, MacroStiffness, neighbours};
use crate::element::{Block, PlaneStrain};
use crate::geometry::Point;
use crate::mesh::lattice::{self, Place};
use crate::petsc::{Matrix, Session};
use std::collections::{BTreeMap, BTreeSet};

/// Nodes that contact couples to each node.
pub type ContactNeighbours = BTreeMap<usize, BTreeSet<usize>>;

/// An empty matrix with exact room for the stiffness of a level and its contact couplings. **Collective**
pub fn prepare_stiffness(
    scene: &Scene,
    space: &Space,
    contact: &ContactNeighbours,
    session: &Session,
) -> Result<Matrix, SystemError> {
    let mut counts = Counts::new(space, contact);
    let n = space.numbering.level.intervals;
    let order = space.numbering.level.order;
    let touches = |triangle: usize| {
        let numbers = space.numbering.triangle(&scene.mesh, triangle);
        (0..3).any(|side| {
            let corner = lattice::side_node(n, side, 0);
            let middle = lattice::side_node(n, side, n / 2);
            [corner, middle].into_iter().any(|(i, j)| space.own.contains(&numbers.node(i, j)))
        })
    };
    for triangle in 0..scene.mesh.triangles.len() {
        let inside = scene.partition.owner(triangle as u32) == session.rank();
        if !inside && !touches(triangle) {
            continue;
        }
        let numbers = space.numbering.triangle(&scene.mesh, triangle);
        let first =
            scene.mesh.triangles[triangle].edges.map(|e| scene.mesh.edges[e as usize].triangles[0] == Some(triangle as u32));
        for (i, j) in lattice::nodes(n) {
            let place = lattice::place(n, i, j);
            let row = numbers.node(i, j);
            if !space.own.contains(&row) {
                continue;
            }
            for &(di, dj) in neighbours(order, i, j) {
                let (k, l) = (i.wrapping_add_signed(di), j.wrapping_add_signed(dj));
                if (di, dj) == (0, 0) || k > n || l > n || k + l > n {
                    continue;
                }
                let shared =
                    !matches!(place, Place::Inside(_)) && (0..3).any(|s| !first[s] && on_side(n, s, i, j) && on_side(n, s, k, l));
                if !shared {
                    counts.add(row, numbers.node(k, l));
                }
            }
        }
    }
    let (diagonal, off_diagonal) = counts.finish();
    let mut matrix = Matrix::aij(session, space.local_unknowns(), space.local_unknowns(), 2, &diagonal, &off_diagonal)?;
    matrix.set_positive_definite(true)?;
    Ok(matrix)
}

/// A matrix of zeros at the couplings of contact alone. **Collective**
pub fn contact_room(space: &Space, contact: &ContactNeighbours, session: &Session) -> Result<Matrix, SystemError> {
    let counts = Counts::new(space, contact);
    let (mut diagonal, off_diagonal) = counts.finish();
    let untouched = |at: usize| !contact.contains_key(&(space.own.start + at));
    diagonal.iter_mut().enumerate().filter(|(at, _)| untouched(*at)).for_each(|(_, count)| *count = 0);
    let mut matrix = Matrix::aij(session, space.local_unknowns(), space.local_unknowns(), 2, &diagonal, &off_diagonal)?;
    fill_room(&mut matrix, space, contact)?;
    matrix.assemble()?;
    Ok(matrix)
}

/// Explicit zeros, which keep the room.
fn fill_room(matrix: &mut Matrix, space: &Space, contact: &ContactNeighbours) -> Result<(), SystemError> {
    for (&row, columns) in contact.range(space.own.clone()) {
        for &column in columns {
            matrix.add_blocks(&[row as i32], &[column as i32], &[0.0; 4])?;
        }
    }
    Ok(())
}

/// Whether a lattice node lies on a side, corners included.
fn on_side(n: usize, side: usize, i: usize, j: usize) -> bool {
    match side {
        0 => j == 0,
        1 => i + j == n,
        _ => i == 0,
    }
}

/// Numbers of stored blocks per owned node.
struct Counts<'a> {
    space: &'a Space,
    diagonal: Vec<i32>,
    off_diagonal: Vec<i32>,
    /// Columns of the rows that contact adds to, so that none is counted twice.
    contact: BTreeMap<usize, BTreeSet<usize>>,
}

impl<'a> Counts<'a> {
    fn new(space: &'a Space, contact: &ContactNeighbours) -> Self {
        let contact = contact.range(space.own.clone()).map(|(&node, others)| (node, others.clone())).collect();
        Self { space, diagonal: vec![1; space.own.len()], off_diagonal: vec![0; space.own.len()], contact }
    }

    fn add(&mut self, row: usize, column: usize) {
        let at = row - self.space.own.start;
        if !self.contact.is_empty()
            && let Some(columns) = self.contact.get_mut(&row)
        {
            columns.insert(column);
            return;
        }
        if self.space.own.contains(&column) { self.diagonal[at] += 1 } else { self.off_diagonal[at] += 1 }
    }

    fn finish(mut self) -> (Vec<i32>, Vec<i32>) {
        for (row, columns) in &self.contact {
            let at = row - self.space.own.start;
            let own = columns.iter().filter(|column| self.space.own.contains(column) && *column != row).count();
            let all = columns.iter().filter(|column| *column != row).count();
            self.diagonal[at] = 1 + own as i32;
            self.off_diagonal[at] = (all - own) as i32;
        }
        (self.diagonal, self.off_diagonal)
    }
}

/// Adds the stiffness of the macro triangles that this rank owns, keeps room for contact by explicit zeros, and assembles. Rows and columns of prescribed
/// components are zero but for the diagonal; what their displacement does to free rows goes to
/// `lift(node, force in the node's frame)`. **Collective**
pub fn fill_stiffness(
    matrix: &mut Matrix,
    scene: &Scene,
    space: &Space,
    contact: &ContactNeighbours,
    session: &Session,
    mut lift: impl FnMut(usize, Point),
) -> Result<(), SystemError> {
    let laws = scene.laws();
    let mut fill = || -> Result<(), SystemError> {
        for &triangle in scene.partition.triangles_of(session.rank()) {
            let law = &laws[scene.mesh.triangles[triangle as usize].body as usize];
            add_triangle(matrix, scene, space, triangle as usize, law, &mut lift)?;
        }
        Ok(())
    };
    match fill() {
        Err(SystemError::Petsc(error)) => return Err(error.into()),
        filled => session.agree(filled).map_err(SystemError::Case)?,
    }
    fill_room(matrix, space, contact)?;
    matrix.assemble()?;
    Ok(())
}

fn add_triangle(
    matrix: &mut Matrix,
    scene: &Scene,
    space: &Space,
    triangle: usize,
    law: &PlaneStrain,
    lift: &mut impl FnMut(usize, Point),
) -> Result<(), SystemError> {
    let n = space.numbering.level.intervals;
    let numbers = space.numbering.triangle(&scene.mesh, triangle);
    let stiffness = MacroStiffness::new(&scene.mesh, triangle, space.numbering.level, law)?;
    let constraint = |i: usize, j: usize, node: usize| match lattice::place(n, i, j) {
        Place::Inside(_) => None,
        _ => space.constraints.get(node),
    };
    let supported = lattice::nodes(n).any(|(i, j)| constraint(i, j, numbers.node(i, j)).is_some());
    let mut columns: Vec<i32> = Vec::with_capacity(19);
    let mut values: Vec<f64> = vec![0.0; 4 * 19];
    for (i, j) in lattice::nodes(n) {
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
