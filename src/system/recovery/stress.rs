//! Stress at the nodes.

use super::nodal;
use crate::body::positions;
use crate::element::{Order, PlaneStrain, jacobian, stress};
use crate::mesh::lattice;
use crate::petsc::Session;
use crate::system::{Field, Scene, Space, SystemError};

/// Stress (xx, yy, xy, zz) at the nodes: the mean over the triangles around each, weighted by their areas. **Collective**
///
/// # Errors
/// [`SystemError`] from PETSc or an inverted triangle.
pub fn nodal_stress(scene: &Scene, space: &Space, u: &Field<2>, session: &Session) -> Result<Field<5>, SystemError> {
    let laws = scene.laws();
    let mut sums = Field::<5>::zeros(scene, space, session);
    for &triangle in scene.partition.triangles_of(session.rank()) {
        let law = &laws[scene.mesh.triangles[triangle as usize].body as usize];
        match space.numbering.level.order {
            Order::P1 => add::<3>(scene, space, u, triangle as usize, law, &mut sums)?,
            Order::P2 => add::<6>(scene, space, u, triangle as usize, law, &mut sums)?,
        }
    }
    let mut sums = sums.sum(session)?;
    for &triangle in scene.partition.triangles_of(session.rank()) {
        let numbers = space.numbering.triangle(&scene.mesh, triangle as usize);
        for (i, j) in lattice::nodes(space.numbering.level.intervals) {
            let values = sums.at_mut(numbers.node(i, j));
            let area = std::mem::replace(&mut values[4], 1.0);
            values[..4].iter_mut().for_each(|value| *value /= area);
        }
    }
    Ok(sums)
}

fn add<const N: usize>(
    scene: &Scene,
    space: &Space,
    u: &Field<2>,
    triangle: usize,
    law: &PlaneStrain,
    sums: &mut Field<5>,
) -> Result<(), SystemError> {
    const NODES: [[f64; 3]; 6] = [[1., 0., 0.], [0., 1., 0.], [0., 0., 1.], [0.5, 0.5, 0.], [0., 0.5, 0.5], [0.5, 0., 0.5]];
    let n = space.numbering.level.intervals;
    let numbers = space.numbering.triangle(&scene.mesh, triangle);
    for small in lattice::triangles(n, space.numbering.level.order) {
        let nodes = small.nodes::<N>();
        let x = positions(&scene.mesh, triangle, n, &nodes);
        let u = nodal::<N>(scene, space, u, triangle, &small);
        for (&(i, j), l) in nodes.iter().zip(NODES) {
            let (_, area) = jacobian(&x, l)?;
            let s = stress(&x, &u, l, law)?;
            let sum = sums.at_mut(numbers.node(i, j));
            for k in 0..4 {
                sum[k] += area * s[k];
            }
            sum[4] += area;
        }
    }
    Ok(())
}
