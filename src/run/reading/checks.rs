//! A case against its mesh, before anything is solved: whether the mean motions that it holds are free to be held, and whether
//! expected values have places and formulas values.

use crate::body::{Body, BodyPart, HeldMode, MeanHold, Springs, Support, rigid_displacement};
use crate::case::{BodyExact, Case, ContactExact, ExpectedAt, LambdaExact};
use crate::contact::{ContactBoundary, Pair};
use crate::discretisation::Contact;
use crate::geometry::{Coordinates, Formula, Point, Rounded};
use crate::mesh::MacroMesh;

/// A motion that moves a supported point, in the direction of the support, by less than this share of itself leaves it at rest.
const AT_REST: f64 = 1e-9;

/// Moduli that are farther apart leave no number of both within those that a computer has: their products are zero, or without bound.
const MOST_APART: f64 = 1e60;

/// Young's moduli of all bodies can be added up and multiplied.
///
/// # Errors
/// Words that begin with the key, and tell the remedy.
pub fn check_moduli(case: &Case) -> Result<(), String> {
    let young = |part: &BodyPart| part.material.young;
    let parts: Vec<(&Body, &BodyPart)> = case.parts().collect();
    let hardest = parts.iter().map(|(_, part)| young(part)).fold(0.0, f64::max);
    match parts.iter().find(|(_, part)| hardest / young(part) > MOST_APART) {
        None => Ok(()),
        Some((body, part)) => Err(format!(
            "{}: young = {:e} beside {hardest:e}: there is no computing with both; take a rigid tool for what is so hard, or leave out what is so soft",
            body.key_of(part),
            young(part)
        )),
    }
}

/// Contacts of which a side is of chords that turn by more than 20 degrees each, and words for it: of a polygon, pressures at its corners
/// would grow without bound.
pub fn coarse_arcs<'a>(case: &'a Case, mesh: &MacroMesh) -> Vec<(&'a Pair, String)> {
    let sides = case.contacts.iter().flat_map(|pair| pair.between.iter().map(move |name| (pair, name)));
    let coarse = sides.filter(|(_, name)| case.tool_of(name).is_none()).filter_map(|(pair, name)| {
        let turn = mesh.turn_of_chords(mesh.edges_of(name))?.to_degrees();
        Some((pair, format!(
            "\"{name}\" has single edges that turn by {turn:.0} degrees, like chords of an arc; tell its shape by a [geometry], mesh it finer or with second-order elements; if these are sides of a polygon, give each a name of its own"
        )))
    });
    coarse.collect()
}

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
                "{} of \"{}\" is held at {} by {key}, too; leave one of them out",
                held.key,
                hold.body,
                Coordinates(x)
            ));
        }
        if let Some(plate) = case.plates.iter().find(|plate| !edges_of(mesh, &plate.on, &hold.body).is_empty()) {
            return error(format!(
                "load.{} moves \"{}\" as a plate, and beside that no mean is held; prescribe ux, uy or angle of the plate, or let it be a traction, and hold the mean",
                plate.name, hold.body
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
    supports.chain(springs).find_map(|(name, directions)| {
        let (x, held) = directions.into_iter().find_map(|(x, direction)| Some((x, moved(x, direction)?)))?;
        Some((format!("support.{name}"), held, x))
    })
}

/// Edges of some boundaries beside a body.
fn edges_of(mesh: &MacroMesh, names: &[String], body: &str) -> Vec<u32> {
    mesh.edges_on(names).filter(|&edge| mesh.bodies[mesh.body_beside(edge)] == body).collect()
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

/// Points inside a macro triangle at which a stress is looked at: their barycentric coordinates.
const INSIDE: [[f64; 2]; 3] = [[1.0 / 6.0, 1.0 / 6.0], [2.0 / 3.0, 1.0 / 6.0], [1.0 / 6.0, 2.0 / 3.0]];

/// Looks at what `[exact]` says of a mesh.
///
/// # Errors
/// Words that begin with the key.
pub fn check_exact(case: &Case, mesh: &MacroMesh) -> Result<(), String> {
    case.exact.contacts.iter().try_for_each(|exact| check_points(case, mesh, exact))?;
    case.exact.bodies.iter().try_for_each(|exact| check_fields(mesh, exact))
}

/// Points of an expected pressure lie on the boundaries of its contact, or between them.
fn check_points(case: &Case, mesh: &MacroMesh, exact: &ContactExact) -> Result<(), String> {
    let Some(LambdaExact::Points(ExpectedAt { at, .. })) = &exact.lambda else { return Ok(()) };
    let Some(pair) = case.contacts.iter().find(|pair| pair.name == exact.name) else { return Ok(()) };
    let sides = pair.between.each_ref().map(|name| mesh.edges_of(name));
    let longest = sides.iter().copied().flatten().map(|&edge| mesh.edge_length(edge)).fold(0.0, f64::max);
    for &[x, y] in at {
        let here = Point::new(x, y);
        let [Some(first), Some(second)] = sides.map(|side| nearest(mesh, side, here)) else { return Ok(()) };
        let (near, other) = if first.1 <= second.1 { (first, 1) } else { (second, 0) };
        // Bodies may be drawn apart, with Γ_C between them.
        let apart = nearest(mesh, sides[other], near.0).map_or(0.0, |(_, distance)| distance);
        if near.1 > longest + apart {
            let (name, [one, two], [x, y, far]) = (&exact.name, &pair.between, [x, y, near.1].map(Rounded));
            return Err(format!(
                "exact.contact.{name}.lambda.at: the point ({x}, {y}) lies {far} away from \"{one}\" and \"{two}\"; the nearest point there is {}: give points on the contact boundary",
                Coordinates(near.0)
            ));
        }
    }
    Ok(())
}

/// The nearest point on the chords of some edges, and how far it is.
fn nearest(mesh: &MacroMesh, edges: &[u32], x: Point) -> Option<(Point, f64)> {
    let on_edge = |&edge: &u32| {
        let foot = mesh.foot_on_chord(edge, x);
        (foot, (x - foot).norm())
    };
    edges.iter().map(on_edge).min_by(|a, b| a.1.total_cmp(&b.1))
}

/// Displacements have values at vertices, which are nodes on every mesh, and stresses inside.
fn check_fields(mesh: &MacroMesh, exact: &BodyExact) -> Result<(), String> {
    let Some(region) = mesh.region(&exact.name) else { return Ok(()) };
    let own = || (0..mesh.triangles.len()).filter(|&triangle| region.holds(&mesh.triangles[triangle]));
    let check = |key: &str, formulas: &[Formula], x: Point| {
        let mut values = formulas.iter().map(|formula| formula.finite_value(x));
        values.try_for_each(|value| value.map(|_| ()).map_err(|words| format!("exact.body.{}.{key}: {words}", exact.name)))
    };
    if let Some(u) = &exact.u {
        let vertices = own().flat_map(|triangle| mesh.triangles[triangle].vertices);
        vertices.map(|vertex| mesh.vertices[vertex as usize]).try_for_each(|x| check("u", u, x))?;
    }
    if let Some(stress) = &exact.stress {
        let places = own().flat_map(|triangle| INSIDE.map(|[xi, eta]| mesh.position(triangle, xi, eta)));
        places.into_iter().try_for_each(|x| check("stress", stress, x))?;
    }
    Ok(())
}

/// An expected pressure has values all along a contact boundary that stays where it is placed: one that follows the solution may
/// leave the places where it has none.
///
/// # Errors
/// Words that begin with the key.
pub fn check_pressures(case: &Case, contacts: &[Contact]) -> Result<(), String> {
    for exact in &case.exact.contacts {
        let contact = contacts.iter().find(|contact| contact.pair.name == exact.name && !contact.pair.follows());
        if let (Some(LambdaExact::Formula { formula, .. }), Some(contact)) = (&exact.lambda, contact) {
            has_values(formula, &contact.boundary)
                .map_err(|words| format!("exact.contact.{}.lambda.formula: {words}", exact.name))?;
        }
    }
    Ok(())
}

/// Whether a formula has values where errors of a pressure are integrated.
///
/// # Errors
/// Words on the first point where it has none.
pub fn has_values(formula: &Formula, boundary: &ContactBoundary) -> Result<(), String> {
    if formula.as_constant().is_some() {
        return Ok(());
    }
    boundary.gauss_by_parameter(8).try_for_each(|(_, _, t, _)| formula.finite_value(boundary.point(t)).map(|_| ()))
}
