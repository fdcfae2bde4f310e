//! Error of the stress in the energy norm, against formulas.

use crate::body::NodePositions;
use crate::discretisation::agreed;
use crate::discretisation::{Discretisation, Field, SystemError};
use crate::element::{Heat, Order, PlaneLaw, SIX_POINTS, six_points, strain};
use crate::geometry::Formula;
use crate::mesh::{Region, lattice};
use crate::petsc::Session;

/// Integrals over a body or a part of one (`∫(σ_h - σ):C⁻¹(σ_h - σ)`, `∫σ:C⁻¹σ`) of the computed stress against formulas
/// `xx, yy, xy, zz` of `x, y`, of which zz counts for bodies of revolution alone. Summed over bodies, the root of their ratio is the relative energy-norm error. **Collective**
///
/// # Errors
/// [`SystemError`] where a triangle is inverted.
pub fn energy_error(
    problem: &Discretisation,
    u: &Field<2>,
    region: Region,
    exact: &[Formula; 4],
    session: &Session,
) -> Result<[f64; 2], SystemError> {
    let (mesh, laws) = (&problem.scene.mesh, problem.scene.laws());
    let mut sums = [0.0; 2];
    let own = problem.scene.partition.triangles_of(session.rank()).iter().map(|&triangle| triangle as usize);
    let added = own.filter(|&triangle| region.holds(&mesh.triangles[triangle])).try_for_each(|triangle| {
        let part = mesh.triangles[triangle].part as usize;
        let (law, heat) = (&laws[part], problem.scene.heat(part));
        match problem.finest().numbering.level.order {
            Order::P1 => add::<3>(problem, u, triangle, (law, heat), exact, &mut sums),
            Order::P2 => add::<6>(problem, u, triangle, (law, heat), exact, &mut sums),
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
    (law, heat): (&PlaneLaw, Option<&Heat>),
    exact: &[Formula; 4],
    sums: &mut [f64; 2],
) -> Result<(), SystemError> {
    let level = problem.finest().numbering.level;
    let all = NodePositions::new(&problem.scene.mesh, triangle, level);
    for small in lattice::triangles(level.intervals, level.order) {
        let x = all.of(&small.nodes::<N>());
        let u = u.of_triangle::<N>(problem, triangle, &small);
        // Also for P1: the exact stress is no polynomial.
        let points = six_points(&x);
        let wanted = exact.each_ref().map(|formula| formula.values(&points));
        for (k, &(l, weight)) in SIX_POINTS.iter().enumerate() {
            let (strain, determinant) = strain(&x, &u, l, law)?;
            let (found, wanted) = (law.heated(law.stress(&strain), heat, points[k]), wanted.map(|values| values[k]));
            let volume = 0.5 * weight * determinant * law.plane.width(points[k]);
            sums[0] += volume * law.compliance(std::array::from_fn(|c| found[c] - wanted[c]));
            sums[1] += volume * law.compliance(wanted);
        }
    }
    Ok(())
}
