//! Bodies that nothing but contact holds, and that shrink away from all of it.

use super::pulled::held_bodies;
use crate::contact::{GapChoice, Pair, drawn_gap};
use crate::discretisation::Scene;
use crate::element::Plane;
use crate::geometry::Point;
use crate::mesh::Numbering;

/// A share of a body's size that is rounding.
const ROUNDING: f64 = 1e-6;

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
    let is_even = most < 0.0 && most - least < ROUNDING * -least;
    let opens = |by: f64| pairs.iter().all(|(pair, _)| depth(scene, numbering, pair) < by);
    let is_loose = is_even && moves != [false; 2] && opens(-most * least_reach(scene, &pairs)?);
    is_loose.then(|| words(scene, body, moves))
}

/// What is said of a body that comes loose, of whose two shifts nothing holds these.
fn words(scene: &Scene, body: usize, moves: [bool; 2]) -> String {
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
    edges().map(reach).reduce(f64::min).filter(|least| *least > ROUNDING * length)
}

/// The shifts of a body that no mean hold takes.
fn free_shifts(scene: &Scene, body: usize) -> [bool; 2] {
    let own = scene.means.iter().filter(|hold| hold.body == scene.mesh.bodies[body]).flat_map(|hold| &hold.held);
    let shifts: Vec<_> = own.filter(|held| !held.is_turn()).collect();
    [0, 1].map(|k| shifts.iter().all(|held| held.mode[k].abs() < ALONG))
}
