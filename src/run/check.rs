//! `mezha check` and `mezha info`.

use super::{RunError, accuracy, memory, scene};
use crate::body::Material;
use crate::case::Case;
use crate::element::{Order, Plane};
use crate::mesh::Partition;
use crate::petsc::{Session, versions};
use crate::system::Procedure;

/// What a look at a case finds.
#[derive(Clone, Debug, PartialEq)]
pub struct Checked {
    /// What would be solved.
    pub words: String,
    /// Words for a run that would be refused on this machine, for want of memory.
    pub warning: Option<String>,
    /// Words for a body that can move though contact is closed everywhere; nothing if all are held.
    pub not_held: Option<String>,
}

/// Reads everything, solves nothing, and says what would be solved, and whether contact, closed everywhere, would hold all
/// bodies.
///
/// # Errors
/// [`RunError::Input`] with words.
pub fn check(case: &Case) -> Result<Checked, RunError> {
    describe(case).map_err(|error| error.in_case(case))
}

fn describe(case: &Case) -> Result<Checked, RunError> {
    let mesh = scene::read_mesh_file(case).and_then(|bytes| scene::read_mesh(case, &bytes)).map_err(RunError::Input)?;
    let partition = Partition::new(&mesh, &vec![0; mesh.triangles.len()], 1);
    let scene = scene::assemble(case, mesh, partition);
    let at_rest = Procedure::look(&scene, 0)?;
    let triangles = scene.mesh.triangles.len() * at_rest.numbering.level.triangles_per_edge().pow(2);
    let order = if scene.order == Order::P1 { "P1" } else { "P2" };
    let mut lines = vec![
        format!("{}: {}", case.name, case.title),
        format!(
            "mesh: {} macro triangles, {triangles} {order} triangles after {} refinements, {} unknowns of displacement",
            scene.mesh.triangles.len(),
            scene.refine,
            2 * at_rest.numbering.node_count()
        ),
    ];
    for body in &scene.bodies {
        for part in &body.parts {
            let of = if body.has_parts() { format!("{}, part {}", body.name, part.name) } else { body.name.clone() };
            let Material { young, poisson, plane } = part.material;
            let plane = if plane == Plane::Stress { ", plane stress" } else { "" };
            lines.push(format!("body {of}: E = {young}, ν = {poisson}{plane}"));
        }
    }
    for contact in &at_rest.contacts {
        lines.push(format!(
            "contact {}: {} segments over a length of {}, {} multipliers",
            contact.pair.name,
            contact.boundary.segments(),
            super::report::length(contact.boundary.length()),
            contact.multipliers.count()
        ));
    }
    if let Some(accuracy) = &case.accuracy {
        lines.push(format!("accuracy asked for: {}; the mesh is adapted to it", accuracy::request(accuracy)));
    }
    let [need, of_macro_mesh] = Procedure::look_at_need(&scene, case.solver.choice);
    // An accuracy has a limit to its meshes.
    let (memory, warning) = if case.accuracy.is_none() { memory::told(need, of_macro_mesh) } else { Default::default() };
    lines.extend((!memory.is_empty()).then_some(memory));
    let not_held = at_rest.not_held(&scene)?;
    Ok(Checked { words: lines.join("\n"), warning, not_held })
}

/// Versions of everything that matters.
pub fn info(session: &Session) -> String {
    format!(
        "mezha {}\nPETSc {}, {}-bit indices\nMPI   {}\nBLAS  {}\nranks {}",
        env!("CARGO_PKG_VERSION"),
        versions::petsc(),
        versions::index_bits(),
        versions::mpi(),
        versions::blas(),
        session.size()
    )
}
