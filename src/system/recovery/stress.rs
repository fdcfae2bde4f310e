//! Stress at the nodes.

use super::{agreed, nodal};
use crate::body::positions;
use crate::element::{Order, PlaneStrain, jacobian, stress};
use crate::mesh::lattice;
use crate::petsc::Session;
use crate::system::{Discretisation, Field, SystemError};

/// Stress (xx, yy, xy, zz) at the nodes: the mean over the triangles around each, weighted by their areas. **Collective**
///
/// # Errors
/// [`SystemError`] from PETSc or an inverted triangle.
pub fn nodal_stress(problem: &Discretisation, u: &Field<2>, session: &Session) -> Result<Field<4>, SystemError> {
    let laws = problem.scene.laws();
    // Stress times area, and area.
    let mut sums = Field::<5>::zeros(problem, session);
    let own = problem.scene.partition.triangles_of(session.rank());
    let added = own.iter().try_for_each(|&triangle| {
        let law = &laws[problem.scene.mesh.triangles[triangle as usize].body as usize];
        match problem.finest().numbering.level.order {
            Order::P1 => add::<3>(problem, u, triangle as usize, law, &mut sums),
            Order::P2 => add::<6>(problem, u, triangle as usize, law, &mut sums),
        }
    });
    agreed(session, added)?;
    Ok(sums.sum(session)?.map(|[xx, yy, xy, zz, area]| [xx, yy, xy, zz].map(|sum| sum / area)))
}

fn add<const N: usize>(
    problem: &Discretisation,
    u: &Field<2>,
    triangle: usize,
    law: &PlaneStrain,
    sums: &mut Field<5>,
) -> Result<(), SystemError> {
    const NODES: [[f64; 3]; 6] = [[1., 0., 0.], [0., 1., 0.], [0., 0., 1.], [0.5, 0.5, 0.], [0., 0.5, 0.5], [0.5, 0., 0.5]];
    let level = problem.finest().numbering.level;
    let numbers = problem.finest().numbering.triangle(&problem.scene.mesh, triangle);
    for small in lattice::triangles(level.intervals, level.order) {
        let nodes = small.nodes::<N>();
        let x = positions(&problem.scene.mesh, triangle, level, &nodes);
        let u = nodal::<N>(problem, u, triangle, &small);
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
