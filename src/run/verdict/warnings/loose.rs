//! Bodies that nothing but contact holds, and that their loads pull away from all of it, or that shrink away from all of it: no pressure
//! balances them.

use crate::body::{Applied, RigidNodes, applied_forces};
use crate::contact::{GapChoice, Law, Pair, drawn_gap};
use crate::discretisation::Scene;
use crate::element::Plane;
use crate::geometry::Point;
use crate::mesh::Numbering;

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

/// A share of a body's size that is rounding.
const SIZE_ROUNDING: f64 = 1e-6;

/// A mean motion that is held holds a shift if its direction has at least this part along it.
const ALONG: f64 = 1e-6;

/// Words for the body of a scene in the plane that shrinks evenly and comes loose from what it touches, if nothing else acts there and
/// all contacts are its own: as small as its heat makes it, about the middle of its contacts, it touches none of them any more, and no
/// stress is left. Where anything else acts, what it touches may follow it; what is cooled unevenly bends.
pub fn comes_loose(scene: &Scene, numbering: &Numbering) -> Option<String> {
    let mesh = &scene.mesh;
    let mut cold = scene.clone();
    cold.bodies.iter_mut().flat_map(|body| &mut body.parts).for_each(|part| part.heat = None);
    if !scene.is_heated() || cold.is_pushed() || mesh.plane == Plane::Revolution {
        return None;
    }
    let strains = strains(scene);
    let mut warm = (0..mesh.bodies.len()).filter(|&body| strains[body] != [0.0; 2]);
    let body = warm.next().filter(|&body| !held_bodies(scene)[body] && warm.next().is_none())?;
    let pairs: Option<Vec<(&Pair, usize)>> = scene.pairs.iter().map(|pair| Some((pair, side(scene, pair, body)?))).collect();
    let (pairs, [least, most], moves) = (pairs?, strains[body], free_shifts(scene, body));
    let is_even = most < 0.0 && most - least < SIZE_ROUNDING * -least;
    let opens = |by: f64| pairs.iter().all(|(pair, _)| depth(scene, numbering, pair) < by);
    let is_loose = is_even && moves != [false; 2] && opens(-most * least_reach(scene, &pairs)?);
    is_loose.then(|| loose_words(scene, body, moves))
}

/// What is said of a body that comes loose, of whose two shifts nothing holds these.
fn loose_words(scene: &Scene, body: usize, moves: [bool; 2]) -> String {
    let keys = ["ux = 0.0", "uy = 0.0"].into_iter().zip(moves).filter(|(_, moves)| *moves);
    let (name, keys) = (&scene.mesh.bodies[body], keys.map(|(key, _)| key).collect::<Vec<_>>().join(" and "));
    let remedy = match scene.means.iter().find(|hold| hold.body == *name) {
        Some(hold) => format!("write {keys} into [support.{}], too", hold.name),
        None => format!("hold its mean, by a support with body = \"{name}\", mean = true, {keys}"),
    };
    format!(
        "body {name} shrinks, as it is cooler than what it touches, so that all its contacts open, and nothing else holds it: {remedy}"
    )
}

/// Which side of a contact lies on a body.
fn side(scene: &Scene, pair: &Pair, body: usize) -> Option<usize> {
    let is_own = |name: &String| scene.mesh.edges_of(name).first().is_some_and(|&edge| scene.mesh.body_beside(edge) == body);
    pair.between.iter().position(is_own)
}

/// The least and the largest strain `α ϑ` of each body by its heat, at its vertices.
fn strains(scene: &Scene) -> Vec<[f64; 2]> {
    let mesh = &scene.mesh;
    let mut strains = vec![[f64::INFINITY, f64::NEG_INFINITY]; mesh.bodies.len()];
    for triangle in &mesh.triangles {
        let heat = scene.heat(triangle.part as usize);
        for x in triangle.vertices.map(|vertex| mesh.vertices[vertex as usize]) {
            let strain = heat.map_or(0.0, |heat| heat.expansion * heat.temperature.value(&[x.x, x.y]));
            let [least, most] = &mut strains[triangle.body as usize];
            (*least, *most) = (least.min(strain), most.max(strain));
        }
    }
    strains
}

/// How deep the sides of a contact reach into each other before anything moves (length); without bound where that is not known.
fn depth(scene: &Scene, numbering: &Numbering, pair: &Pair) -> f64 {
    match &pair.gap {
        GapChoice::Closed => 0.0,
        GapChoice::Formula(gap) => gap.as_constant().map_or(f64::INFINITY, |gap| -gap),
        GapChoice::Geometry => drawn_gap(&scene.mesh, numbering, pair).map_or(f64::INFINITY, |gap| -gap.least),
    }
}

/// The least distance of the sides that a body has in contact from their middle, along their normals (length); nothing where one does
/// not look away from that.
fn least_reach(scene: &Scene, pairs: &[(&Pair, usize)]) -> Option<f64> {
    let mesh = &scene.mesh;
    let edges = || pairs.iter().flat_map(|(pair, own)| mesh.edges_of(&pair.between[*own]));
    let length: f64 = edges().map(|&edge| mesh.edge_length(edge)).sum();
    let middle = edges().map(|&edge| mesh.edge_length(edge) * mesh.edge_position(edge, 0.5)).sum::<Point>() / length;
    let reach = |&edge: &u32| (mesh.edge_position(edge, 0.5) - middle).dot(&mesh.edge_normal(edge, 0.5));
    edges().map(reach).reduce(f64::min).filter(|least| *least > SIZE_ROUNDING * length)
}

/// The shifts of a body that no mean hold takes.
fn free_shifts(scene: &Scene, body: usize) -> [bool; 2] {
    let own = scene.means.iter().filter(|hold| hold.body == scene.mesh.bodies[body]).flat_map(|hold| &hold.held);
    let shifts: Vec<_> = own.filter(|held| !held.is_turn()).collect();
    [0, 1].map(|k| shifts.iter().all(|held| held.mode[k].abs() < ALONG))
}
