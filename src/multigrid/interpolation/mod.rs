//! Interpolation of displacements from one level to the next finer one.

mod halved_rows;
mod node_interpolation;
mod parents;
mod whole;

pub use node_interpolation::{InterpolationRoom, NodeInterpolation};

use crate::discretisation::{Discretisation, Scene, Space, SystemError};
use crate::multigrid::auxiliary::auxiliary_interpolations;
use crate::multigrid::user_options::want_entries;
use crate::petsc::{Index, Matrix, Session};
use node_interpolation::{InterpolationShell, turned};
use parents::NodeParents;
use std::rc::Rc;

/// The interpolation to a level from the next coarser one.
pub struct Interpolation {
    /// As PETSc's multigrid uses it (fine unknowns x coarse unknowns), with the unknowns of each rank.
    pub matrix: Matrix,
    /// As mezha's own cycle does; none between auxiliary levels, or where options of the user's ask for entries.
    pub nodes: Option<Rc<NodeInterpolation>>,
}

/// Interpolations between all levels, auxiliary ones among them: the first leads from the coarsest level to the next.
/// **Collective**
pub fn interpolations(problem: &Discretisation, session: &Session) -> Result<Vec<Interpolation>, SystemError> {
    let auxiliary = auxiliary_interpolations(problem, session)?.into_iter().map(|matrix| Interpolation { matrix, nodes: None });
    let mut all: Vec<Interpolation> = auxiliary.collect();
    for pair in problem.spaces.windows(2) {
        all.push(interpolation(&problem.scene, &pair[1], &pair[0], session)?);
    }
    Ok(all)
}

/// Of the nodes between two levels. **Collective**
fn interpolation(scene: &Scene, fine: &Space, coarse: &Space, session: &Session) -> Result<Interpolation, SystemError> {
    if want_entries(session) {
        return Ok(Interpolation { matrix: stored_rows(scene, fine, coarse, session)?, nodes: None });
    }
    let nodes = Rc::new(NodeInterpolation::new(scene, fine, coarse, session));
    let (rows, columns) = (fine.local_unknowns(), coarse.local_unknowns());
    let matrix = Matrix::transfer(session, rows, columns, Box::new(InterpolationShell(nodes.clone())))?;
    Ok(Interpolation { matrix, nodes: Some(nodes) })
}

/// With all its rows stored. **Collective**
fn stored_rows(scene: &Scene, fine: &Space, coarse: &Space, session: &Session) -> Result<Matrix, SystemError> {
    let rows = NodeParents::new(scene, fine, coarse, session.rank(), |_, _| 0..0);
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
    for (node, [a, b]) in rows.iter() {
        if a == b {
            insert(&mut matrix, fine, coarse, node, a, 1.0)?;
            continue;
        }
        for (parent, weight) in [a, b].into_iter().zip(rows.weights(node)) {
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
    let (row, column) = (2 * node as Index, 2 * parent as Index);
    if coarse.constraints.get(parent).is_none() && fine.constraints.get(node).is_none() {
        matrix.insert(&[row], &[column], &[weight])?;
        matrix.insert(&[row + 1], &[column + 1], &[weight])?;
        return Ok(());
    }
    let block = turned(fine, coarse, node, parent, weight);
    matrix.insert(&[row, row + 1], &[column, column + 1], block.as_flattened())?;
    Ok(())
}
