//! Stress at the nodes.

use crate::discretisation::{Discretisation, EvenTriangle, Field, SystemError, agreed};
use crate::element::{PlaneLaw, by_order, corner_slopes, nodal_stresses, straight_stresses};
use crate::mesh::{MacroMesh, lattice};

/// Stress at the nodes of each part of the bodies: where two parts meet it has two values, for some of its components jump.
///
/// Parts are dealt to as few fields as they take: those of one field lie in different bodies, and have no nodes in common.
pub struct NodalStress {
    fields: Vec<Field<4>>,
    /// The field of each part.
    of_part: Vec<usize>,
}

impl NodalStress {
    /// Stress (xx, yy, xy, zz) of a part at a node of one of its triangles.
    pub fn at(&self, part: usize, node: usize) -> [f64; 4] {
        self.fields[self.of_part[part]].at(node)
    }
}

/// Stress (xx, yy, xy, zz) at the nodes: the mean over the triangles of one part around each, weighted by their areas.
/// **Collective**
///
/// # Errors
/// [`SystemError`] from PETSc or an inverted triangle.
pub fn nodal_stress(problem: &Discretisation, u: &Field<2>) -> Result<NodalStress, SystemError> {
    let of_part = fields_of_parts(&problem.scene.mesh);
    let count = of_part.iter().max().map_or(0, |last| last + 1);
    let fields = (0..count).map(|field| stress_of_parts(problem, u, |part| of_part[part as usize] == field));
    Ok(NodalStress { fields: fields.collect::<Result<_, _>>()?, of_part })
}

/// The field of each part: its place among the parts of its body.
fn fields_of_parts(mesh: &MacroMesh) -> Vec<usize> {
    let place = |at: usize| mesh.parts[..at].iter().filter(|other| other.body == mesh.parts[at].body).count();
    (0..mesh.parts.len()).map(place).collect()
}

/// The stress of some parts, not a number at nodes of none of them. **Collective**
fn stress_of_parts(problem: &Discretisation, u: &Field<2>, is_in: impl Fn(u32) -> bool) -> Result<Field<4>, SystemError> {
    // Stress times area, and area.
    let mut sums = Field::<5>::zeros(&problem.scene, problem.finest(), &problem.session);
    let mut own = problem.own_triangles().iter();
    let added = own.try_for_each(|&triangle| {
        if !is_in(problem.scene.mesh.triangles[triangle as usize].part) {
            return Ok(());
        }
        by_order!(problem.finest().numbering.level.order, add(problem, u, triangle as usize, &mut sums))
    });
    agreed(&problem.session, added)?;
    Ok(sums.sum(&problem.session).map(|[xx, yy, xy, zz, area]| [xx, yy, xy, zz].map(|sum| sum / area)))
}

fn add<const N: usize>(problem: &Discretisation, u: &Field<2>, triangle: usize, sums: &mut Field<5>) -> Result<(), SystemError> {
    let (law, heat) = problem.material(triangle);
    if let Some(even) = problem.even_triangle::<N>(triangle, u).filter(|_| heat.is_none()) {
        return add_even(problem, triangle, &law, &even, sums);
    }
    problem.each_element::<N, _>(triangle, |element| {
        for (&node, (s, area)) in element.nodes.iter().zip(nodal_stresses(&element.x, &u.on(element), &law, heat)?) {
            let sum = sums.at_mut(node);
            for k in 0..4 {
                sum[k] += area * s[k];
            }
            sum[4] += area;
        }
        Ok(())
    })
}

/// Of a macro triangle whose elements are alike: summed up on its lattice first.
fn add_even<const N: usize>(
    problem: &Discretisation,
    triangle: usize,
    law: &PlaneLaw,
    even: &EvenTriangle<N>,
    sums: &mut Field<5>,
) -> Result<(), SystemError> {
    let (mesh, numbering) = (&problem.scene.mesh, &problem.finest().numbering);
    let n = numbering.level.intervals;
    let (slopes, area) = corner_slopes(&even.x)?;
    let of_sign = [slopes.map(|slope| -slope), slopes];
    let mut own = vec![[0.0; 5]; lattice::node_count(n)];
    even.each(|at, u, sign| {
        for (node, [xx, yy, xy, zz]) in at.into_iter().zip(straight_stresses(&u, &of_sign[usize::from(sign > 0.0)], law)) {
            own[node].iter_mut().zip([xx, yy, xy, zz, 1.0]).for_each(|(sum, value)| *sum += area * value);
        }
    });
    let numbers = numbering.triangle(mesh, triangle);
    for ((i, j), own) in lattice::nodes(n).zip(own) {
        sums.at_mut(numbers.node(i, j)).iter_mut().zip(own).for_each(|(sum, value)| *sum += value);
    }
    Ok(())
}
