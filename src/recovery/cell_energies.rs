//! Where in the macro triangles the strain energy of a displacement lies.

use crate::body::NodePositions;
use crate::discretisation::{Discretisation, Field, SystemError, agreed};
use crate::element::{BadJacobian, PlaneLaw, by_order, energies};
use crate::geometry::Point;
use crate::mesh::{Cells, lattice};
use crate::petsc::Session;

/// Share of the energy of a triangle that lies in its middle quarter, if it lies evenly.
const MIDDLE: f64 = 0.25;

/// Strain energy of each macro triangle of this rank, in its order, by cells. **Collective**
///
/// # Errors
/// [`SystemError`] from an inverted triangle.
pub fn cell_energies(problem: &Discretisation, u: &Field<2>, session: &Session) -> Result<Vec<Cells>, SystemError> {
    let (mesh, laws) = (&problem.scene.mesh, problem.scene.laws());
    let own = problem.scene.partition.triangles_of(session.rank());
    let one = |&triangle: &u32| {
        let law = &laws[mesh.triangles[triangle as usize].part as usize];
        by_order!(problem.finest().numbering.level.order, in_triangle(problem, u, triangle as usize, law))
    };
    agreed(session, own.iter().map(|triangle| one(triangle).map_err(SystemError::from)).collect())
}

fn in_triangle<const N: usize>(
    problem: &Discretisation,
    u: &Field<2>,
    triangle: usize,
    law: &PlaneLaw,
) -> Result<Cells, BadJacobian> {
    let (mesh, level) = (&problem.scene.mesh, problem.finest().numbering.level);
    let mut cells = Cells::default();
    let all = NodePositions::new(mesh, triangle, level);
    for small in lattice::triangles(level.intervals, level.order) {
        let nodes = small.nodes::<N>();
        let corner = |k: usize| [nodes[k].0, nodes[k].1].map(|at| at as f64 / level.intervals as f64);
        let corners = [corner(0), corner(1), corner(2)];
        let place = |l: [f64; 3]| {
            let [x, y] = [0, 1].map(|axis| (0..3).map(|k| l[k] * corners[k][axis]).sum::<f64>());
            [1.0 - x - y, x, y]
        };
        let (x, moved): (_, [Point; N]) = (all.of(&nodes), u.of_triangle(problem, triangle, &small));
        for (l, energy) in energies(&x, &moved, law)? {
            cells.add(place(l), (1.0 - MIDDLE) * energy);
            cells.add(place([1.0 / 3.0; 3]), MIDDLE * energy);
        }
    }
    Ok(cells)
}
