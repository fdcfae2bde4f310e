//! Interpolation of displacements from one level to the next finer one: stored rows, and halved rows that need not be.

mod halved_rows;

use super::auxiliary::auxiliary_interpolations;
use super::user_options::want_entries;
use super::{Discretisation, Scene, Space, SystemError};
use crate::geometry::Point;
use crate::mesh::lattice::{self, Place};
use crate::petsc::{Matrix, Session};
use halved_rows::{HalvedRow, LatticeInterpolation, halved_rows};
use std::collections::HashMap;

/// Interpolations between all levels, auxiliary ones among them: the first leads from the coarsest level to the next.
/// **Collective**
pub fn interpolations(problem: &Discretisation, session: &Session) -> Result<Vec<Matrix>, SystemError> {
    let mut all = auxiliary_interpolations(problem, session)?;
    for pair in problem.spaces.windows(2) {
        all.push(interpolation(&problem.scene, &pair[1], &pair[0], session)?);
    }
    Ok(all)
}

/// Weights of the parents of most nodes.
const EVEN: [f64; 2] = [0.5; 2];

/// Linear interpolation `P` (fine unknowns x coarse unknowns): a node takes over the value of its coarse twin, or the
/// weighted mean of its two parents, turned from their frames into its own. Rows of prescribed fine components and columns of
/// prescribed coarse ones are zero. **Collective**
fn interpolation(scene: &Scene, fine: &Space, coarse: &Space, session: &Session) -> Result<Matrix, SystemError> {
    let halved = halved_rows(scene, fine, coarse, session);
    let count: usize = halved.iter().map(|row| row.count).sum();
    if !session.any(2 * count > fine.own.len()) || want_entries(session) {
        return stored_rows(scene, fine, coarse, false, session);
    }
    let stored = stored_rows(scene, fine, coarse, true, session)?;
    let (rows, columns) = (fine.local_unknowns(), coarse.local_unknowns());
    Ok(Matrix::transfer(session, rows, columns, Box::new(LatticeInterpolation::new(stored, halved)))?)
}

/// The rows that are stored: all, or those that are not `halved`. **Collective**
fn stored_rows(scene: &Scene, fine: &Space, coarse: &Space, halved: bool, session: &Session) -> Result<Matrix, SystemError> {
    let rows = NodeParents::new(scene, fine, coarse, halved, session);
    let mut diagonal = vec![0; fine.local_unknowns()];
    let mut off_diagonal = vec![0; fine.local_unknowns()];
    for (node, parents) in rows.iter() {
        let at = 2 * (node - fine.own.start);
        for parent in distinct(parents) {
            let turned = fine.constraints.get(node).is_some() || coarse.constraints.get(parent).is_some();
            let counts = if coarse.own.contains(&parent) { &mut diagonal } else { &mut off_diagonal };
            counts[at] += if turned { 2 } else { 1 };
            counts[at + 1] += if turned { 2 } else { 1 };
        }
    }
    let mut matrix = Matrix::aij(session, fine.local_unknowns(), coarse.local_unknowns(), 1, &diagonal, &off_diagonal)?;
    if halved {
        matrix.expect_empty_rows()?;
    }
    for (node, [a, b]) in rows.iter() {
        if a == b {
            insert(&mut matrix, fine, coarse, node, a, 1.0)?;
            continue;
        }
        for (parent, weight) in [a, b].into_iter().zip(rows.parent_weights(node)) {
            insert(&mut matrix, fine, coarse, node, parent, weight)?;
        }
    }
    matrix.assemble()?;
    Ok(matrix)
}

fn distinct([a, b]: [usize; 2]) -> impl Iterator<Item = usize> {
    [Some(a), (a != b).then_some(b)].into_iter().flatten()
}

fn insert(matrix: &mut Matrix, fine: &Space, coarse: &Space, node: usize, parent: usize, weight: f64) -> Result<(), SystemError> {
    let (row, column) = (2 * node as i32, 2 * parent as i32);
    let constraint = coarse.constraints.get(parent);
    if constraint.is_none() && fine.constraints.get(node).is_none() {
        matrix.insert(&[row], &[column], &[weight])?;
        matrix.insert(&[row + 1], &[column + 1], &[weight])?;
        return Ok(());
    }
    let image = |k: usize| {
        let axis = Point::new(if k == 0 { 1.0 } else { 0.0 }, if k == 1 { 1.0 } else { 0.0 });
        let free = constraint.map_or(axis, |c| c.free_part(axis));
        fine.free_part(node, coarse.to_global(parent, free)) * weight
    };
    let (x, y) = (image(0), image(1));
    matrix.insert(&[row, row + 1], &[column, column + 1], &[x.x, y.x, x.y, y.y])?;
    Ok(())
}

/// Owned fine nodes with their coarse parents, each node once; without those in halved rows if there are such rows.
struct NodeParents {
    nodes: Vec<[u32; 3]>,
    /// Weights of the parents, for the few nodes that are not in their middle.
    graded: HashMap<usize, [f64; 2]>,
}

impl NodeParents {
    fn new(scene: &Scene, fine: &Space, coarse: &Space, halved: bool, session: &Session) -> Self {
        let n = fine.numbering.level.intervals;
        let mut seen = vec![false; fine.own.len()];
        let mut rows = Self { nodes: Vec::new(), graded: HashMap::new() };
        // Nodes of row j that stay out.
        let left_out = |j: usize| if halved { HalvedRow::places(n, j) } else { 0..0 };
        for &triangle in scene.partition.triangles_of(session.rank()) {
            let numbers = fine.numbering.triangle(&scene.mesh, triangle as usize);
            let below = coarse.numbering.triangle(&scene.mesh, triangle as usize);
            let rest = (0..=n).flat_map(|j| {
                let out = left_out(j);
                (0..out.start).chain(out.end..=n - j).map(move |i| (i, j))
            });
            for (i, j) in rest {
                let node = numbers.node(i, j);
                if !matches!(lattice::place(n, i, j), Place::Inside(_)) {
                    if !fine.own.contains(&node) || seen[node - fine.own.start] {
                        continue;
                    }
                    seen[node - fine.own.start] = true;
                    let weights = scene.mesh.parent_weights(triangle as usize, fine.numbering.level, (i, j));
                    if weights != EVEN {
                        rows.graded.insert(node, weights);
                    }
                }
                let [a, b] = lattice::parents(i, j).map(|(i, j)| below.node(i, j) as u32);
                rows.nodes.push([node as u32, a, b]);
            }
        }
        rows
    }

    fn parent_weights(&self, node: usize) -> [f64; 2] {
        self.graded.get(&node).copied().unwrap_or(EVEN)
    }

    fn iter(&self) -> impl Iterator<Item = (usize, [usize; 2])> {
        self.nodes.iter().map(|&[node, a, b]| (node as usize, [a as usize, b as usize]))
    }
}
