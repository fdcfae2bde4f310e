//! Bodies whose mean motion is held, as part of the border of unknown motions.
//!
//! The body is moved rigidly by `R q`, which strains nothing, so that its column of the border is that of the gaps alone; its row
//! is the mean, `M u = ∫ mode · u dA / ∫ |mode|² dA`.

use crate::body::{MeanHold, body_forces, rigid_mode};
use crate::geometry::Point;
use crate::mesh::lattice;
use crate::petsc::Session;
use crate::system::{Discretisation, Field, SystemError};
use nalgebra::{DMatrix, DVector};
use std::collections::BTreeMap;

/// Nodes of this rank in a body, and where they are.
pub fn nodes_of_body(problem: &Discretisation, body: &str, rank: usize) -> BTreeMap<usize, Point> {
    let (scene, space) = (&problem.scene, problem.finest());
    let level = space.numbering.level;
    let mut nodes = BTreeMap::new();
    let is_own = |triangle: &&u32| scene.mesh.bodies[scene.mesh.triangles[**triangle as usize].body as usize] == body;
    for &triangle in scene.partition.triangles_of(rank).iter().filter(is_own) {
        let numbers = space.numbering.triangle(&scene.mesh, triangle as usize);
        for (i, j) in lattice::nodes(level.intervals) {
            let node = numbers.node(i, j);
            if space.own.contains(&node) {
                nodes.entry(node).or_insert_with(|| scene.mesh.node_position(triangle as usize, level, (i, j)));
            }
        }
    }
    nodes
}

/// `M` of one component: what each node's displacement counts in the mean. **Collective**
///
/// # Errors
/// [`SystemError::Case`] if a triangle is turned inside out.
pub fn mean_weights(problem: &Discretisation, hold: &MeanHold, k: usize, session: &Session) -> Result<Field<2>, SystemError> {
    let (scene, numbering) = (&problem.scene, &problem.finest().numbering);
    let about = hold.middle(&scene.mesh);
    let mode = |x: Point| rigid_mode(about, k, x);
    let mut weights = Field::<2>::zeros(problem, session);
    let own = scene.partition.triangles_of(session.rank()).iter().map(|&triangle| triangle as usize);
    let mut all = own.filter(|&triangle| scene.mesh.bodies[scene.mesh.triangles[triangle].body as usize] == hold.body);
    let added = all.try_for_each(|triangle| {
        body_forces(&scene.mesh, triangle, numbering, |points| points.map(mode), &mut |node, weight: Point| {
            let sum = weights.at_mut(node);
            sum[0] += weight.x;
            sum[1] += weight.y;
        })
    });
    session.agree(added.map_err(SystemError::from)).map_err(SystemError::Case)?;
    let weights = weights.sum(session)?;
    let nodes = nodes_of_body(problem, &hold.body, session.rank());
    let whole = nodes.iter().map(|(&node, &x)| mode(x).dot(&weights.point(node)));
    let mut whole = [whole.sum::<f64>()];
    session.sum(&mut whole);
    Ok(weights.map(|weight| weight.map(|component| component / whole[0])))
}

/// How far a body has been moved rigidly, by the components of its motion that are held: from the displacements of its anchors on
/// this rank, in the nodes' frames. **Collective**
pub fn mean_motion(problem: &Discretisation, hold: &MeanHold, displacement: &[f64], session: &Session) -> Vec<f64> {
    let space = problem.finest();
    let anchors = hold.anchors(&problem.scene.mesh).unwrap_or_default();
    let about = hold.middle(&problem.scene.mesh);
    let mut moved: Vec<f64> = anchors
        .iter()
        .map(|anchor| {
            let node = space.numbering.vertex(anchor.vertex);
            if space.own.contains(&node) { displacement[2 * (node - space.own.start) + anchor.axis] } else { 0.0 }
        })
        .collect();
    session.sum(&mut moved);
    let held: Vec<usize> = hold.held().collect();
    let modes = DMatrix::from_fn(anchors.len(), held.len(), |i, j| rigid_mode(about, held[j], anchors[i].place)[anchors[i].axis]);
    modes.lu().solve(&DVector::from_vec(moved)).map_or_else(|| vec![0.0; held.len()], |q| q.as_slice().to_vec())
}
