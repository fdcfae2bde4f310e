//! Stress at the nodes.

use crate::discretisation::{Discretisation, Field, SystemError, agreed};
use crate::element::{Heat, PlaneLaw, by_order, nodal_stresses};
use crate::mesh::MacroMesh;
use crate::petsc::Session;

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
pub fn nodal_stress(problem: &Discretisation, u: &Field<2>, session: &Session) -> Result<NodalStress, SystemError> {
    let of_part = fields_of_parts(&problem.scene.mesh);
    let count = of_part.iter().max().map_or(0, |last| last + 1);
    let fields = (0..count).map(|field| stress_of_parts(problem, u, |part| of_part[part as usize] == field, session));
    Ok(NodalStress { fields: fields.collect::<Result<_, _>>()?, of_part })
}

/// The field of each part: its place among the parts of its body.
fn fields_of_parts(mesh: &MacroMesh) -> Vec<usize> {
    let place = |at: usize| mesh.parts[..at].iter().filter(|other| other.body == mesh.parts[at].body).count();
    (0..mesh.parts.len()).map(place).collect()
}

/// The stress of some parts, not a number at nodes of none of them. **Collective**
fn stress_of_parts(
    problem: &Discretisation,
    u: &Field<2>,
    is_in: impl Fn(u32) -> bool,
    session: &Session,
) -> Result<Field<4>, SystemError> {
    let (mesh, laws) = (&problem.scene.mesh, problem.scene.laws());
    // Stress times area, and area.
    let mut sums = Field::<5>::zeros(&problem.scene, problem.finest(), session);
    let mut own = problem.scene.partition.triangles_of(session.rank()).iter();
    let added = own.try_for_each(|&triangle| {
        let part = mesh.triangles[triangle as usize].part;
        let material = (&laws[part as usize], problem.scene.heat(part as usize));
        if !is_in(part) {
            return Ok(());
        }
        by_order!(problem.finest().numbering.level.order, add(problem, u, triangle as usize, material, &mut sums))
    });
    agreed(session, added)?;
    Ok(sums.sum(session).map(|[xx, yy, xy, zz, area]| [xx, yy, xy, zz].map(|sum| sum / area)))
}

fn add<const N: usize>(
    problem: &Discretisation,
    u: &Field<2>,
    triangle: usize,
    (law, heat): (&PlaneLaw, Option<&Heat>),
    sums: &mut Field<5>,
) -> Result<(), SystemError> {
    problem.each_element::<N, _>(triangle, |element| {
        for (&node, (s, area)) in element.nodes.iter().zip(nodal_stresses(&element.x, &u.on(element), law, heat)?) {
            let sum = sums.at_mut(node);
            for k in 0..4 {
                sum[k] += area * s[k];
            }
            sum[4] += area;
        }
        Ok(())
    })
}
