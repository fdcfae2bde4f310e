//! Error of the stress in the energy norm, against formulas.

use crate::discretisation::{Discretisation, Field, SystemError, agreed};
use crate::element::{SIX_POINTS, by_order, six_points, strain};
use crate::geometry::Formula;
use crate::mesh::Region;
use crate::recovery::evaluation::Evaluation;

impl Evaluation<'_> {
    /// Error of the stress in a body or a part of one, and its size, both squared in the energy norm: integrals
    /// (`∫(σ_h - σ):C⁻¹(σ_h - σ)`, `∫σ:C⁻¹σ`) of the computed stress against formulas `xx, yy, xy, zz` of `x, y`, of which zz counts for
    /// bodies of revolution alone. Summed over bodies, the root of their ratio is the relative energy-norm error. **Collective**
    ///
    /// # Errors
    /// [`SystemError`] where a triangle is inverted.
    pub fn energy_error(&self, region: Region, exact: &[Formula; 4]) -> Result<[f64; 2], SystemError> {
        let (problem, triangles) = (self.problem, &self.problem.scene.mesh.triangles);
        let mut sums = [0.0; 2];
        let own = problem.scene.partition.triangles_of(self.session.rank()).iter().map(|&triangle| triangle as usize);
        let added = own.filter(|&triangle| region.holds(&triangles[triangle])).try_for_each(|triangle| {
            by_order!(problem.finest().numbering.level.order, add(problem, &self.u, triangle, exact, &mut sums))
        });
        agreed(self.session, added)?;
        self.session.sum(&mut sums);
        Ok(sums)
    }
}

fn add<const N: usize>(
    problem: &Discretisation,
    u: &Field<2>,
    triangle: usize,
    exact: &[Formula; 4],
    sums: &mut [f64; 2],
) -> Result<(), SystemError> {
    let (law, heat) = problem.material(triangle);
    problem.each_element::<N, _>(triangle, |element| {
        let (x, u) = (&element.x, u.on(element));
        // Also for P1: the exact stress is no polynomial.
        let points = six_points(x);
        let wanted = exact.each_ref().map(|formula| formula.values(&points));
        for (k, &(l, weight)) in SIX_POINTS.iter().enumerate() {
            let (strain, determinant) = strain(x, &u, l, &law)?;
            let (found, wanted) = (law.heated(law.stress(&strain), heat, points[k]), wanted.map(|values| values[k]));
            let volume = 0.5 * weight * determinant * law.plane.width(points[k]);
            sums[0] += volume * law.compliance(std::array::from_fn(|c| found[c] - wanted[c]));
            sums[1] += volume * law.compliance(wanted);
        }
        Ok(())
    })
}
