//! What elastic supports do: their forces on the bodies, and the energy in them.

use crate::discretisation::field::Field;
use crate::discretisation::levels::Discretisation;
use crate::geometry::Point;

/// Forces and energy of all springs.
pub struct SpringForces {
    /// Forces on the nodes.
    pub nodes: Field<2>,
    /// Force of each elastic support on the bodies (per thickness).
    pub reactions: Vec<Point>,
    /// `½∫k u²`, of all of them.
    pub energy: f64,
}

impl SpringForces {
    /// Those of a displacement. **Collective**
    pub fn new(problem: &Discretisation, u: &Field<2>) -> Self {
        let (scene, numbering) = (&problem.scene, &problem.finest().numbering);
        let mesh = &scene.mesh;
        let mut nodes = Field::<2>::zeros(&problem.scene, problem.finest(), &problem.session);
        let mut sums = vec![0.0; 2 * scene.springs.len() + 1];
        for (at, springs) in scene.springs.iter().enumerate() {
            let is_own = |edge: &u32| scene.partition.owner(mesh.beside(*edge).0) == problem.session.rank();
            for edge in springs.edges(mesh).into_iter().filter(is_own) {
                springs.stiffness(mesh, edge, numbering, |a, b, block| {
                    let (moved, [ux, uy]) = (u.at(a), u.at(b));
                    let force = block.map(|row| -(row[0] * ux + row[1] * uy));
                    let sum = nodes.at_mut(a);
                    for axis in 0..2 {
                        sum[axis] += force[axis];
                        sums[2 * at + axis] += force[axis];
                    }
                    *sums.last_mut().expect("the energy") -= 0.5 * (force[0] * moved[0] + force[1] * moved[1]);
                });
            }
        }
        problem.session.sum(&mut sums);
        let energy = sums[2 * scene.springs.len()];
        let reactions = sums.chunks_exact(2).map(|force| Point::new(force[0], force[1])).collect();
        Self { nodes: nodes.sum(&problem.session), reactions, energy }
    }
}
