//! Expected values against the mesh, before anything is solved: points that lie where something is known, formulas with values.

use crate::case::{BodyExact, Case, ContactExact, LambdaExact};
use crate::contact::ContactBoundary;
use crate::discretisation::Contact;
use crate::geometry::{Coordinates, Formula, Point, Rounded, gauss_points};
use crate::mesh::MacroMesh;

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
    let Some(LambdaExact::Points { at, .. }) = &exact.lambda else { return Ok(()) };
    let Some(pair) = case.contacts.iter().find(|pair| pair.name == exact.name) else { return Ok(()) };
    let sides = pair.between.each_ref().map(|name| mesh.boundary(name).map(|side| side.edges.as_slice()).unwrap_or_default());
    let longest = sides.iter().copied().flatten().map(|&edge| mesh.edge_length(edge)).fold(0.0, f64::max);
    for &[x, y] in at {
        let here = Point::new(x, y);
        let nearest = sides.map(|side| nearest(mesh, side, here));
        let [Some(first), Some(second)] = nearest else { return Ok(()) };
        let (near, other) = if first.1 <= second.1 { (first, 1) } else { (second, 0) };
        // Bodies may be drawn apart, with Γ_C between them.
        let apart = self::nearest(mesh, sides[other], near.0).map_or(0.0, |(_, distance)| distance);
        if near.1 > longest + apart {
            return Err(format!(
                "exact.contact.{}.lambda.at: the point ({}, {}) lies {} away from \"{}\" and \"{}\"; the nearest point there is {}: give points on the contact boundary",
                exact.name,
                Rounded(x),
                Rounded(y),
                Rounded(near.1),
                pair.between[0],
                pair.between[1],
                Coordinates(near.0)
            ));
        }
    }
    Ok(())
}

/// The nearest point on the chords of some edges, and how far it is.
fn nearest(mesh: &MacroMesh, edges: &[u32], x: Point) -> Option<(Point, f64)> {
    let on_edge = |&edge: &u32| {
        let [a, b] = mesh.edges[edge as usize].vertices.map(|vertex| mesh.vertices[vertex as usize]);
        let share = ((x - a).dot(&(b - a)) / (b - a).norm_squared()).clamp(0.0, 1.0);
        let foot = a + share * (b - a);
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
    let places =
        boundary.knots().windows(2).flat_map(|ends| gauss_points(8).iter().map(|(z, _)| ends[0] + z * (ends[1] - ends[0])));
    places.into_iter().try_for_each(|t| formula.finite_value(boundary.point(t)).map(|_| ()))
}
