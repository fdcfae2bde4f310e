//! Whether the mean motions that a case holds are free to be held.

use crate::body::{HeldMode, MeanHold, rigid_displacement};
use crate::case::Case;
use crate::geometry::Point;
use crate::mesh::MacroMesh;

/// A motion that moves a supported point, in the direction of the support, by less than this share of itself leaves it at rest.
const AT_REST: f64 = 1e-9;

/// A body is of one piece, has vertices enough, and nothing but contact resists the motions whose mean is held.
///
/// # Errors
/// Words that name the file, the support and the remedy.
pub fn check_means(case: &Case, mesh: &MacroMesh) -> Result<(), String> {
    let holds = case.mean_holds(mesh).map_err(|words| format!("{}: {words}", case.file.display()))?;
    for hold in &holds {
        let error = |words: String| Err(format!("{}: support.{}: {words}", case.file.display(), hold.name));
        let pieces = mesh.pieces.iter().filter(|piece| mesh.bodies[piece.body] == hold.body).count();
        if pieces > 1 {
            return error(format!("body \"{}\" is of {pieces} pieces; hold each by points, at = [x, y]", hold.body));
        }
        let Some(anchors) = hold.anchors(mesh) else {
            return error(format!("body \"{}\" has too few vertices; hold it by a boundary, on = \"...\"", hold.body));
        };
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
        if spots.filter_map(|spot| mesh.vertex_at(spot)).any(|vertex| anchors.iter().any(|anchor| anchor.vertex == vertex)) {
            return error("a point at which another support holds this body is in its way; hold the body by points alone".into());
        }
    }
    Ok(())
}

/// What resists a held mean motion: its key, the motion, and where.
fn resisting<'a>(case: &Case, mesh: &MacroMesh, hold: &'a MeanHold) -> Option<(String, &'a HeldMode, Point)> {
    let (about, reach) = (hold.middle(mesh), hold.reach(mesh));
    let moved = |x: Point, direction: Point| {
        hold.held.iter().find(|held| {
            let whole = if held.is_turn() { reach } else { 1.0 };
            rigid_displacement(about, &held.mode, x).dot(&direction).abs() > AT_REST * whole
        })
    };
    let of_body = |edge: u32| mesh.bodies[mesh.body_beside(edge)] == hold.body;
    let edges = |names: &[String]| -> Vec<u32> {
        let boundaries = names.iter().filter_map(|name| mesh.boundary(name));
        boundaries.flat_map(|boundary| boundary.edges.iter().copied()).filter(|&edge| of_body(edge)).collect()
    };
    let axes = [Point::new(1.0, 0.0), Point::new(0.0, 1.0)];
    for support in &case.supports {
        let given = [support.ux.is_some(), support.uy.is_some()];
        let key = format!("support.{}", support.name);
        let mut places: Vec<Point> = Vec::new();
        if let Some(vertex) = support.at.as_ref().and_then(|spot| mesh.vertex_at(spot)) {
            let body = mesh.triangle_at(vertex).map(|triangle| mesh.triangles[triangle as usize].body as usize);
            places.extend(body.filter(|&body| mesh.bodies[body] == hold.body).map(|_| mesh.vertices[vertex as usize]));
        }
        let edges = edges(&support.on);
        for (edge, t) in edges.iter().flat_map(|&edge| [0.0, 0.5, 1.0].map(|t| (edge, t))) {
            let x = mesh.edge_position(edge, t);
            places.push(x);
            if let Some(held) = moved(x, mesh.edge_normal(edge, t)).filter(|_| support.normal.is_some()) {
                return Some((key, held, x));
            }
        }
        for (x, axis) in places.iter().flat_map(|&x| (0..2).map(move |axis| (x, axis))).filter(|(_, axis)| given[*axis]) {
            if let Some(held) = moved(x, axes[axis]) {
                return Some((key, held, x));
            }
        }
    }
    for springs in &case.springs {
        for (edge, t) in edges(&springs.on).into_iter().flat_map(|edge| [0.0, 0.5, 1.0].map(|t| (edge, t))) {
            let x = mesh.edge_position(edge, t);
            let mut pulling = springs.stiffness.at(x, mesh.edge_normal(edge, t)).into_iter().filter(|(_, k)| *k > 0.0);
            if let Some(held) = pulling.find_map(|(direction, _)| moved(x, direction)) {
                return Some((format!("support.{}", springs.name), held, x));
            }
        }
    }
    let plate = case.plates.iter().find_map(|plate| Some((plate, *edges(&plate.on).first()?)));
    plate.and_then(|(plate, edge)| Some((format!("load.{}", plate.name), hold.held.first()?, mesh.edge_position(edge, 0.5))))
}
