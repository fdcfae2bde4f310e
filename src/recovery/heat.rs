//! Energies of bodies that are heated.
//!
//! The strain energy is that of the elastic part of the strain, `½∫(ε - αϑI):C:(ε - αϑI) = ½ uᵀKu - f_ϑ·u + ½∫ d p α ϑ`, with the nodal
//! forces `f_ϑ` of the pressure `p` that keeps a part from growing and the number `d` of directions in which it would.

use crate::body::heat_forces;
use crate::discretisation::{Discretisation, Field, SystemError, agreed};
use crate::element::{BadJacobian, SIX_POINTS, by_order, jacobian, six_points};

/// What heat does in a part of a body (energies per thickness, or of the whole body of revolution).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct HeatEnergy {
    /// `f_ϑ·u`.
    pub work: f64,
    /// Strain energy of the part if it is kept from growing at all.
    pub kept: f64,
}

/// What heat does in each part of the mesh, in its order. **Collective**
///
/// # Errors
/// [`SystemError`] from an inverted triangle.
pub fn heat_energies(problem: &Discretisation, u: &Field<2>) -> Result<Vec<HeatEnergy>, SystemError> {
    let scene = &problem.scene;
    let mut sums = vec![[0.0; 2]; scene.mesh.parts.len()];
    if !scene.is_heated() {
        return Ok(sums.into_iter().map(|_| HeatEnergy::default()).collect());
    }
    let (parts, numbering) = (scene.parts(), &problem.finest().numbering);
    let added = problem.own_triangles().iter().try_for_each(|&triangle| {
        let at = scene.mesh.triangles[triangle as usize].part as usize;
        if parts[at].heat.is_none() {
            return Ok(());
        }
        let [work, kept] = &mut sums[at];
        heat_forces(&scene.mesh, triangle as usize, numbering, parts[at], &mut |node, force| *work += force.dot(&u.point(node)))?;
        *kept += by_order!(numbering.level.order, kept_energy(problem, triangle as usize))?;
        Ok::<(), SystemError>(())
    });
    agreed(&problem.session, added)?;
    problem.session.sum(sums.as_flattened_mut());
    Ok(sums.into_iter().map(|[work, kept]| HeatEnergy { work, kept }).collect())
}

/// `½∫ d p α ϑ` of a macro triangle; zero if nothing heats it.
fn kept_energy<const N: usize>(problem: &Discretisation, triangle: usize) -> Result<f64, BadJacobian> {
    let (law, Some(heat)) = problem.material(triangle) else { return Ok(0.0) };
    let mut sum = 0.0;
    problem.each_element::<N, _>(triangle, |element| {
        for (&(l, weight), x) in SIX_POINTS.iter().zip(six_points(&element.x)) {
            let volume = 0.5 * weight * jacobian(&element.x, l)?.1 * law.plane.width(x);
            sum += 0.5 * volume * law.growing() * law.pressure_by_growth() * heat.growth(x).powi(2);
        }
        Ok(())
    })?;
    Ok(sum)
}
