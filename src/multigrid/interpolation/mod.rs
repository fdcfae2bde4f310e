//! Interpolation of displacements from one level to the next finer one.

mod halved_rows;
mod node_interpolation;
mod parents;
mod whole;

pub use node_interpolation::{InterpolationRoom, NodeInterpolation};

use crate::discretisation::Discretisation;
use crate::multigrid::auxiliary::{Coarsening, coarsenings};
use crate::petsc::Session;
use parents::Parentage;
use std::ops::Range;
use std::rc::Rc;

/// The interpolation to a level from the next coarser one.
pub struct Interpolation {
    /// By nodes of this rank.
    pub nodes: Rc<NodeInterpolation>,
    /// Of a step to an auxiliary level: where it leads.
    pub coarsening: Option<Rc<Coarsening>>,
}

/// Interpolations between all levels, auxiliary ones among them: the first leads from the coarsest level to the next.
/// **Collective**
pub fn interpolations(problem: &Discretisation) -> Vec<Interpolation> {
    let (mut all, first) = (Vec::new(), &problem.spaces[0]);
    let coarsenings = coarsenings(problem);
    for (l, step) in coarsenings.iter().enumerate() {
        let fine = coarsenings.get(l + 1).map_or(first.own.clone(), |finer| finer.coarse.own(problem.session.rank()));
        let nodes = Rc::new(auxiliary_interpolation(step, fine, &problem.session));
        all.push(Interpolation { nodes, coarsening: Some(step.clone()) });
    }
    for pair in problem.spaces.windows(2) {
        let nodes = Rc::new(NodeInterpolation::new(&problem.scene, &pair[1], &pair[0], &problem.session));
        all.push(Interpolation { nodes, coarsening: None });
    }
    all
}

/// Of a step to an auxiliary level, from these nodes. **Collective**
fn auxiliary_interpolation(step: &Coarsening, fine: Range<usize>, session: &Session) -> NodeInterpolation {
    let own = step.coarse.own(session.rank());
    let couplings = fine.clone().flat_map(|node| {
        let row = step.row(node);
        row.map(move |(parent, weight)| Parentage { node, parent: parent as usize, weight, turned: step.turned(node, parent) })
    });
    NodeInterpolation::of_couplings(couplings, &fine, &own, session)
}
