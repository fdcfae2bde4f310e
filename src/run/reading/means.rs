//! Whether the mean motions that a case holds are free to be held.

use crate::body::{HeldMode, MeanHold, Springs, Support, rigid_displacement};
use crate::case::Case;
use crate::geometry::Point;
use crate::mesh::MacroMesh;

/// A motion that moves a supported point, in the direction of the support, by less than this share of itself leaves it at rest.
const AT_REST: f64 = 1e-9;

/// A body is of one piece, has vertices enough, and nothing but contact resists the motions whose mean is held.
///
/// # Errors
/// Words that begin with the key, and tell the remedy.
pub fn check_means(case: &Case, mesh: &MacroMesh) -> Result<(), String> {
    for hold in &case.mean_holds(mesh)? {
        let error = |words: String| Err(format!("support.{}: {words}", hold.name));
        let pieces = mesh.pieces.iter().filter(|piece| mesh.bodies[piece.body] == hold.body).count();
        if pieces > 1 {
            return error(format!("body \"{}\" is of {pieces} pieces; hold each by points, at = [x, y]", hold.body));
        }
        if hold.anchors.is_empty() {
            return error(format!("body \"{}\" has too few vertices; hold it by a boundary, on = \"...\"", hold.body));
        }
        if let Some(words) = hold.redundant() {
            return error(words);
        }
        if let Some((key, held, x)) = resisting(case, mesh, hold) {
            return error(format!(
                "{} of \"{}\" is held at ({}, {}) by {key}, too; leave one of them out",
                held.key, hold.body, x.x, x.y
            ));
        }
        let spots = case.supports.iter().filter_map(|support| support.at.as_ref());
        if spots.filter_map(|spot| mesh.vertex_at(spot)).any(|vertex| hold.anchors.iter().any(|anchor| anchor.vertex == vertex)) {
            return error("a point at which another support holds this body is in its way; hold the body by points alone".into());
        }
    }
    Ok(())
}

/// What resists a held mean motion: its key, the motion, and where.
fn resisting<'a>(case: &Case, mesh: &MacroMesh, hold: &'a MeanHold) -> Option<(String, &'a HeldMode, Point)> {
    let (about, reach) = (hold.middle, hold.reach);
    let moved = |x: Point, direction: Point| {
        hold.held.iter().find(|held| {
            let whole = if held.is_turn() { reach } else { 1.0 };
            rigid_displacement(about, &held.mode, x).dot(&direction).abs() > AT_REST * whole
        })
    };
    let supports = case.supports.iter().map(|support| (&support.name, held_directions(support, mesh, &hold.body)));
    let springs = case.springs.iter().map(|springs| (&springs.name, pulled_directions(springs, mesh, &hold.body)));
    let resisted = supports.chain(springs).find_map(|(name, directions)| {
        let (x, held) = directions.into_iter().find_map(|(x, direction)| Some((x, moved(x, direction)?)))?;
        Some((format!("support.{name}"), held, x))
    });
    resisted.or_else(|| {
        let on = case.plates.iter().find_map(|plate| Some((plate, *edges_of(mesh, &plate.on, &hold.body).first()?)));
        on.and_then(|(plate, edge)| Some((format!("load.{}", plate.name), hold.held.first()?, mesh.edge_position(edge, 0.5))))
    })
}

/// Edges of some boundaries beside a body.
fn edges_of(mesh: &MacroMesh, names: &[String], body: &str) -> Vec<u32> {
    let edges = names.iter().filter_map(|name| mesh.boundary(name)).flat_map(|boundary| boundary.edges.iter().copied());
    edges.filter(|&edge| mesh.bodies[mesh.body_beside(edge)] == body).collect()
}

/// Ends and middles of such edges, with the normals there.
fn places_on(mesh: &MacroMesh, names: &[String], body: &str) -> Vec<(Point, Point)> {
    let places = edges_of(mesh, names, body).into_iter().flat_map(|edge| [0.0, 0.5, 1.0].map(|t| (edge, t)));
    places.map(|(edge, t)| (mesh.edge_position(edge, t), mesh.edge_normal(edge, t))).collect()
}

/// Points of a body at which a support holds it, each with a direction.
fn held_directions(support: &Support, mesh: &MacroMesh, body: &str) -> Vec<(Point, Point)> {
    let on_edges = places_on(mesh, &support.on, body);
    let vertex = support.at.as_ref().and_then(|spot| mesh.vertex_at(spot)).filter(|&vertex| {
        mesh.triangle_at(vertex).is_some_and(|triangle| mesh.bodies[mesh.triangles[triangle as usize].body as usize] == body)
    });
    let places = vertex.map(|vertex| mesh.vertices[vertex as usize]).into_iter().chain(on_edges.iter().map(|(x, _)| *x));
    let axes = [(&support.ux, Point::new(1.0, 0.0)), (&support.uy, Point::new(0.0, 1.0))];
    let axes = axes.into_iter().filter(|(given, _)| given.is_some()).map(|(_, axis)| axis);
    let along = places.flat_map(|x| axes.clone().map(move |axis| (x, axis)));
    on_edges.iter().copied().filter(|_| support.normal.is_some()).chain(along).collect()
}

/// Points of a body at which springs pull, each with a direction.
fn pulled_directions(springs: &Springs, mesh: &MacroMesh, body: &str) -> Vec<(Point, Point)> {
    let at = |(x, normal): (Point, Point)| {
        let pulling = springs.stiffness.at(x, normal).into_iter().filter(|(_, k)| *k > 0.0);
        pulling.map(move |(direction, _)| (x, direction)).collect::<Vec<_>>()
    };
    places_on(mesh, &springs.on, body).into_iter().flat_map(at).collect()
}
