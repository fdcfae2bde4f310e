//! Interpolation of displacements from one level to the next finer one.

mod halved_rows;
mod node_interpolation;
mod parents;
mod whole;

pub use node_interpolation::{InterpolationRoom, NodeInterpolation};

use crate::discretisation::{Discretisation, Scene, Space, SystemError};
use crate::element::Block;
use crate::multigrid::auxiliary::{Coarsening, coarsenings};
use crate::multigrid::user_options::want_entries;
use crate::petsc::{Index, Matrix, Session};
use node_interpolation::{InterpolationShell, turned};
use parents::NodeParents;
use std::ops::Range;
use std::rc::Rc;

/// The interpolation to a level from the next coarser one.
pub struct Interpolation {
    /// As PETSc's multigrid uses it (fine unknowns x coarse unknowns), with the unknowns of each rank.
    pub matrix: Matrix,
    /// As mezha's own cycle does; none where options of the user's ask for entries.
    pub nodes: Option<Rc<NodeInterpolation>>,
    /// Of a step to an auxiliary level: where it leads.
    pub coarsening: Option<Rc<Coarsening>>,
}

/// Interpolations between all levels, auxiliary ones among them: the first leads from the coarsest level to the next.
/// **Collective**
pub fn interpolations(problem: &Discretisation, session: &Session) -> Result<Vec<Interpolation>, SystemError> {
    let (mut all, first) = (Vec::new(), &problem.spaces[0]);
    let coarsenings = coarsenings(problem, session.size());
    for l in 0..coarsenings.len() {
        let fine = coarsenings.get(l + 1).map_or(first.own.clone(), |finer| finer.coarse.own(session.rank()));
        all.push(auxiliary_interpolation(&coarsenings[l], fine, session)?);
    }
    for pair in problem.spaces.windows(2) {
        all.push(interpolation(&problem.scene, &pair[1], &pair[0], session)?);
    }
    Ok(all)
}

/// Of a step to an auxiliary level, from these nodes. **Collective**
fn auxiliary_interpolation(step: &Rc<Coarsening>, fine: Range<usize>, session: &Session) -> Result<Interpolation, SystemError> {
    let own = step.coarse.own(session.rank());
    let couplings = fine.clone().flat_map(|node| {
        step.row(node).map(move |(parent, value)| Coupling {
            node,
            parent: parent as usize,
            weight: value,
            turned: step.turned(node, parent),
        })
    });
    let coarsening = Some(step.clone());
    if want_entries(session) {
        return Ok(Interpolation { matrix: stored_rows(couplings, &fine, &own, session)?, nodes: None, coarsening });
    }
    let nodes = NodeInterpolation::of_couplings(couplings, &fine, &own, session);
    of_nodes(nodes, fine.len(), own.len(), coarsening, session)
}

/// Of the nodes between two levels. **Collective**
fn interpolation(scene: &Scene, fine: &Space, coarse: &Space, session: &Session) -> Result<Interpolation, SystemError> {
    if want_entries(session) {
        let rows = NodeParents::new(scene, fine, coarse, session.rank(), |_, _| 0..0);
        let couplings = rows.iter().flat_map(|(node, [a, b])| {
            let weights = if a == b { [1.0, 0.0] } else { rows.weights(node) };
            let parents = [a, b].into_iter().zip(weights).filter(|(_, weight)| *weight != 0.0);
            parents.map(move |(parent, weight)| Coupling { node, parent, weight, turned: turned(fine, coarse, node, parent) })
        });
        let matrix = stored_rows(couplings, &fine.own, &coarse.own, session)?;
        return Ok(Interpolation { matrix, nodes: None, coarsening: None });
    }
    let nodes = NodeInterpolation::new(scene, fine, coarse, session);
    of_nodes(nodes, fine.own.len(), coarse.own.len(), None, session)
}

/// **Collective**
fn of_nodes(
    nodes: NodeInterpolation,
    fine: usize,
    coarse: usize,
    coarsening: Option<Rc<Coarsening>>,
    session: &Session,
) -> Result<Interpolation, SystemError> {
    let nodes = Rc::new(nodes);
    let matrix = Matrix::transfer(session, 2 * fine, 2 * coarse, Box::new(InterpolationShell(nodes.clone())))?;
    Ok(Interpolation { matrix, nodes: Some(nodes), coarsening })
}

/// What a fine node takes over of a coarse one.
#[derive(Clone, Copy)]
pub struct Coupling {
    /// The fine node.
    pub node: usize,
    /// The coarse one.
    pub parent: usize,
    /// Its share.
    pub weight: f64,
    /// What the fine node would take over of all of it, in their frames; none if these are the axes of the plane, in which both move
    /// freely.
    pub turned: Option<Block>,
}

impl Coupling {
    fn block(&self) -> Block {
        self.turned.unwrap_or([[1.0, 0.0], [0.0, 1.0]]).map(|row| row.map(|value| self.weight * value))
    }
}

/// All rows of an interpolation. **Collective**
fn stored_rows(
    couplings: impl Iterator<Item = Coupling> + Clone,
    fine: &Range<usize>,
    coarse: &Range<usize>,
    session: &Session,
) -> Result<Matrix, SystemError> {
    let mut counts = [vec![0; 2 * fine.len()], vec![0; 2 * fine.len()]];
    for Coupling { node, parent, .. } in couplings.clone() {
        let at = 2 * (node - fine.start);
        counts[usize::from(!coarse.contains(&parent))][at..at + 2].iter_mut().for_each(|count| *count += 2);
    }
    let [diagonal, off_diagonal] = counts;
    let mut matrix = Matrix::aij(session, 2 * fine.len(), 2 * coarse.len(), 1, &diagonal, &off_diagonal)?;
    for coupling in couplings {
        let (row, column) = (2 * coupling.node as Index, 2 * coupling.parent as Index);
        matrix.insert(&[row, row + 1], &[column, column + 1], coupling.block().as_flattened())?;
    }
    matrix.assemble()?;
    Ok(matrix)
}
