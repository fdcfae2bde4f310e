//! Where in the macro triangles the strain energy of a displacement lies.

use crate::discretisation::{Discretisation, Field, SystemError, agreed};
use crate::element::{BadJacobian, by_order, energies};
use crate::mesh::Cells;

/// Share of the energy of a triangle that lies in its middle quarter, if it lies evenly.
const MIDDLE: f64 = 0.25;

/// Strain energy of each macro triangle of this rank, in its order, by cells. **Collective**
///
/// # Errors
/// [`SystemError`] from an inverted triangle.
pub fn cell_energies(problem: &Discretisation, u: &Field<2>) -> Result<Vec<Cells>, SystemError> {
    let own = problem.own_triangles();
    let one = |&triangle: &u32| {
        by_order!(problem.finest().numbering.level.order, in_triangle(problem, u, triangle as usize)).map_err(SystemError::from)
    };
    agreed(&problem.session, own.iter().map(one).collect())
}

fn in_triangle<const N: usize>(problem: &Discretisation, u: &Field<2>, triangle: usize) -> Result<Cells, BadJacobian> {
    let (law, _) = problem.material(triangle);
    let intervals = problem.finest().numbering.level.intervals as f64;
    let mut cells = Cells::default();
    problem.each_element::<N, _>(triangle, |element| {
        let corners = element.small.nodes::<3>().map(|(i, j)| [i, j].map(|at| at as f64 / intervals));
        let place = |l: [f64; 3]| {
            let [x, y] = [0, 1].map(|axis| (0..3).map(|k| l[k] * corners[k][axis]).sum::<f64>());
            [1.0 - x - y, x, y]
        };
        for (l, energy) in energies(&element.x, &u.on(element), &law)? {
            cells.add(place(l), (1.0 - MIDDLE) * energy);
            cells.add(place([1.0 / 3.0; 3]), MIDDLE * energy);
        }
        Ok(())
    })?;
    Ok(cells)
}
