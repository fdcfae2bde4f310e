//! Bodies that nothing but contact holds, and that their loads pull away from all of it: no pressure balances them.

use crate::body::{Applied, RigidNodes, applied_forces};
use crate::contact::Law;
use crate::discretisation::Scene;
use crate::geometry::Point;

/// A share of the force on a body that is rounding.
const ROUNDING: f64 = 1e-9;

/// Words for the first such body. A side pushes against its own normals alone: where the force on the body points away from every one
/// of them, no pressures add up to it.
pub fn pulled_off(scene: &Scene) -> Option<String> {
    let mesh = &scene.mesh;
    let mut held = held_bodies(scene);
    let named = scene.means.iter().filter_map(|hold| mesh.bodies.iter().position(|name| *name == hold.body));
    named.for_each(|body| held[body] = true);
    let mut forces: Option<Vec<Point>> = None;
    (0..mesh.bodies.len()).filter(|&body| !held[body]).find_map(|body| {
        let is_own = |edges: &&[u32]| edges.first().is_some_and(|&edge| mesh.body_beside(edge) == body);
        let sides = scene.pairs.iter().flat_map(|pair| &pair.between).map(|name| mesh.edges_of(name)).filter(is_own);
        let mut normals = sides.flatten().flat_map(|&edge| [0.0, 0.5, 1.0].map(|t| mesh.edge_normal(edge, t))).peekable();
        normals.peek()?;
        let force = forces.get_or_insert_with(|| forces_on_bodies(scene).unwrap_or_default()).get(body).copied()?;
        let loads = loads_of(scene, body);
        let is_pulled = !loads.is_empty() && normals.all(|normal| force.dot(&normal) < -ROUNDING * force.norm());
        is_pulled.then(|| {
            let (name, pull) = (&mesh.bodies[body], if loads.len() > 1 { "pull" } else { "pulls" });
            format!(
                "{} {pull} body {name} off all its contacts, which only push: turn the load round if it is meant to press the bodies together",
                loads.join(", ")
            )
        })
    })
}

/// Which bodies something else than a unilateral contact and a hold of their mean holds.
pub fn held_bodies(scene: &Scene) -> Vec<bool> {
    let mesh = &scene.mesh;
    let mut held: Vec<bool> = (0..mesh.bodies.len()).map(|body| scene.is_rigid(body)).collect();
    let names = scene.supports.iter().map(|support| &support.on).chain(scene.springs.iter().map(|springs| &springs.on));
    let bilateral = scene.pairs.iter().filter(|pair| pair.law == Law::Bilateral).map(|pair| &pair.between);
    let edges = names.flat_map(|on| mesh.edges_on(on)).chain(bilateral.flat_map(|names| mesh.edges_on(names)));
    edges.for_each(|edge| held[mesh.body_beside(edge)] = true);
    let spots = scene.supports.iter().filter_map(|support| mesh.triangle_at(mesh.vertex_at(support.at.as_ref()?)?));
    spots.for_each(|triangle| held[mesh.triangles[triangle as usize].body as usize] = true);
    for set in &scene.rigid {
        if let RigidNodes::Boundaries(names) = &set.nodes {
            mesh.edges_on(names).for_each(|edge| held[mesh.body_beside(edge)] = true);
        }
    }
    held
}

/// The force on each body, on the mesh of the file.
fn forces_on_bodies(scene: &Scene) -> Option<Vec<Point>> {
    let mesh = &scene.mesh;
    let numbering = scene.macro_numbering().ok()?;
    let mut body_of = vec![0; numbering.node_count()];
    for (triangle, _, node) in numbering.nodes_of(mesh, 0..mesh.triangles.len()) {
        body_of[node] = mesh.triangles[triangle].body as usize;
    }
    let mut forces = vec![Point::zeros(); mesh.bodies.len()];
    let applied = Applied { parts: &scene.parts(), loads: &scene.loads, point_loads: &scene.point_loads };
    applied_forces(mesh, &scene.partition, 0, &numbering, &applied, |node, force| forces[body_of[node]] += force).ok()?;
    Some(forces.into_iter().map(|force| mesh.plane.resultant(force)).collect())
}

/// The loads of a body, as the case calls them.
fn loads_of(scene: &Scene, body: usize) -> Vec<String> {
    let mesh = &scene.mesh;
    let along = scene.loads.iter().filter(|load| mesh.edges_on(&load.on).any(|edge| mesh.body_beside(edge) == body));
    let at_body = |vertex: u32| mesh.triangle_at(vertex).map(|triangle| mesh.triangles[triangle as usize].body as usize);
    let at_points = scene.point_loads.iter().filter(|load| mesh.vertex_at(&load.at).and_then(at_body) == Some(body));
    let named = along.map(|load| &load.name).chain(at_points.map(|load| &load.name)).map(|name| format!("load.{name}"));
    let has_force = scene.bodies[body].parts.iter().any(|part| part.force.iter().any(|force| force.as_constant() != Some(0.0)));
    named.chain(has_force.then(|| "its body_force or gravity".into())).collect()
}
