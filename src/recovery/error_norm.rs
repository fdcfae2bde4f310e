//! Error of the stress in the energy norm, against formulas.

use crate::body::NodePositions;
use crate::discretisation::agreed;
use crate::discretisation::{Discretisation, Field, SystemError};
use crate::element::{Order, PlaneLaw, SIX_POINTS, jacobian, six_points, stress};
use crate::geometry::Formula;
use crate::mesh::{Region, lattice};
use crate::petsc::Session;

/// Integrals over a body or a part of one (`∫(σ_h - σ):C⁻¹(σ_h - σ)`, `∫σ:C⁻¹σ`) of the computed stress against formulas
/// `xx, yy, xy` of `x, y`. Summed over bodies, the root of their ratio is the relative energy-norm error. **Collective**
///
/// # Errors
/// [`SystemError`] where a triangle is inverted.
pub fn energy_error(
    problem: &Discretisation,
    u: &Field<2>,
    region: Region,
    exact: &[Formula; 3],
    session: &Session,
) -> Result<[f64; 2], SystemError> {
    let (mesh, laws) = (&problem.scene.mesh, problem.scene.laws());
    let mut sums = [0.0; 2];
    let own = problem.scene.partition.triangles_of(session.rank()).iter().map(|&triangle| triangle as usize);
    let added = own.filter(|&triangle| region.holds(&mesh.triangles[triangle])).try_for_each(|triangle| {
        let law = &laws[mesh.triangles[triangle].part as usize];
        match problem.finest().numbering.level.order {
            Order::P1 => add::<3>(problem, u, triangle, law, exact, &mut sums),
            Order::P2 => add::<6>(problem, u, triangle, law, exact, &mut sums),
        }
    });
    agreed(session, added)?;
    session.sum(&mut sums);
    Ok(sums)
}

fn add<const N: usize>(
    problem: &Discretisation,
    u: &Field<2>,
    triangle: usize,
    law: &PlaneLaw,
    exact: &[Formula; 3],
    sums: &mut [f64; 2],
) -> Result<(), SystemError> {
    let level = problem.finest().numbering.level;
    let all = NodePositions::new(&problem.scene.mesh, triangle, level);
    for small in lattice::triangles(level.intervals, level.order) {
        let x = all.of(&small.nodes::<N>());
        let u = u.of_triangle::<N>(problem, triangle, &small);
        // Also for P1: the exact stress is no polynomial.
        let wanted = exact.each_ref().map(|formula| formula.values(&six_points(&x)));
        for (k, &(l, weight)) in SIX_POINTS.iter().enumerate() {
            let (_, determinant) = jacobian(&x, l)?;
            let (found, wanted) = (stress(&x, &u, l, law)?, wanted.map(|values| values[k]));
            let area = 0.5 * weight * determinant;
            sums[0] += area * law.compliance([found[0] - wanted[0], found[1] - wanted[1], found[2] - wanted[2]]);
            sums[1] += area * law.compliance(wanted);
        }
    }
    Ok(())
}
