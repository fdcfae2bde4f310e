//! What a displacement does inside the bodies: the forces `K u` of their stresses at the nodes, and strain energies.

use crate::body::MacroStiffness;
use crate::discretisation::error::{SystemError, agreed};
use crate::discretisation::field::Field;
use crate::discretisation::levels::Discretisation;
use crate::element::{self, by_order, times};
use crate::geometry::Point;
use crate::mesh::lattice;

/// Strain energy of each macro triangle of this rank, in its order. **Collective**
///
/// # Errors
/// [`SystemError`] from PETSc or an inverted triangle.
pub fn local_strain_energy(problem: &Discretisation, u: &Field<2>) -> Result<Vec<f64>, SystemError> {
    let own = problem.own_triangles();
    let energy = |&triangle: &u32| {
        let mut energy = 0.0;
        each_force(problem, u, triangle as usize, |_, force, u| energy += 0.5 * force.dot(&u))?;
        // Rounding may leave a rigid motion a little less than nothing.
        Ok(energy.max(0.0))
    };
    agreed(&problem.session, own.iter().map(energy).collect())
}

/// Strain energy of each body (this rank's part) and the internal forces `∫σ:∇N` at the nodes, in global axes. **Collective**
///
/// # Errors
/// [`SystemError`] from PETSc or an inverted triangle.
pub fn internal_forces(problem: &Discretisation, u: &Field<2>) -> Result<(Vec<f64>, Field<2>), SystemError> {
    let scene = &problem.scene;
    let mut strain = vec![0.0; scene.mesh.parts.len()];
    let mut forces = Field::<2>::zeros(&problem.scene, problem.finest(), &problem.session);
    let added = problem.own_triangles().iter().try_for_each(|&triangle| {
        let part = scene.mesh.triangles[triangle as usize].part as usize;
        each_force(problem, u, triangle as usize, |node, force, u| {
            strain[part] += 0.5 * force.dot(&u);
            forces.add_at(node, force);
        })
    });
    agreed(&problem.session, added)?;
    Ok((strain, forces.sum(&problem.session)))
}

/// Internal forces of one macro triangle: number, force and displacement of each of its nodes.
fn each_force(
    problem: &Discretisation,
    u: &Field<2>,
    triangle: usize,
    mut take: impl FnMut(usize, Point, Point),
) -> Result<(), SystemError> {
    let (mesh, numbering) = (&problem.scene.mesh, &problem.finest().numbering);
    let n = numbering.level.intervals;
    if numbering.level.is_one_triangle() {
        return by_order!(numbering.level.order, each_force_of_one(problem, u, triangle, take));
    }
    let stiffness = MacroStiffness::new(mesh, triangle, numbering.level, &problem.material(triangle).0)?;
    let numbers = numbering.triangle(mesh, triangle);
    let local = problem.on_lattice(triangle, u);
    for (at, (i, j)) in lattice::nodes(n).enumerate() {
        let force = stiffness.row(i, j).map(|((k, l), block)| times(block, &local[lattice::index(n, k, l)])).sum();
        take(numbers.node(i, j), force, local[at]);
    }
    Ok(())
}

/// Internal forces of a macro triangle that is a single triangle: number, force and displacement of each of its nodes.
fn each_force_of_one<const N: usize>(
    problem: &Discretisation,
    u: &Field<2>,
    triangle: usize,
    mut take: impl FnMut(usize, Point, Point),
) -> Result<(), SystemError> {
    let ((law, _), is_straight) = (problem.material(triangle), !problem.scene.mesh.is_curved(triangle));
    problem.each_element::<N, _>(triangle, |element| {
        let local = u.on(element);
        let forces = element::internal_forces(&element.x, &local, &law, is_straight)?;
        (0..N).for_each(|a| take(element.nodes[a], forces[a], local[a]));
        Ok(())
    })
}
