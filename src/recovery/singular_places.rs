//! All places where the stress of a solution has no bound: by the bodies, and by what presses on them.

use super::evaluation::Evaluation;
use super::zone_ends::SAME;
use crate::body::{CHORDS, SingularPlace, Unbounded, singular_places};
use crate::contact::Configuration;
use crate::discretisation::{Contact, ContactPressure, Discretisation, Scene, Solution};
use crate::geometry::Point;
use crate::mesh::{MacroMesh, Region, Spot};
use rustc_hash::FxHashMap;

/// Coordinates below this share of the scene are rounding.
const ROUNDING: f64 = 1e-12;

/// Share of all forces from which a point at a support carries any.
const LOADED: f64 = 1e-4;

/// Share of the scene up to which a point is at a singular place: coordinates of six digits.
const AT: f64 = 1e-6;

/// All places where the stress has no bound: by the shape of a body and what holds it, at points that carry a force, where a corner
/// presses at the end of a contact, and at the ends of those contacts whose pressure `grows`.
pub fn all_singular_places(found: &Evaluation, grows: &[bool], joints: &[Vec<Point>]) -> Vec<SingularPlace> {
    let (problem, scene, balance) = (found.problem, &found.problem.scene, &found.balance);
    let mut all = places(problem, found.solution, grows);
    let held = scene.supports.iter().zip(&balance.reactions);
    let held =
        held.filter(|(_, reaction)| reaction.norm() > LOADED * balance.forces).filter_map(|(support, _)| support.at.as_ref());
    all.extend(held.filter_map(|spot| at_point(&scene.mesh, spot)));
    for (contact, place) in
        problem.contacts.iter().zip(joints).flat_map(|(contact, own)| own.iter().map(move |place| (contact, *place)))
    {
        let is_deformed = contact.pair.configuration == Configuration::Deformed;
        let of_body = |body| SingularPlace { body, place, vertex: None, is_deformed, why: Unbounded::Materials };
        all.extend(contact.bodies.map(of_body));
    }
    let size = size_of(&scene.mesh);
    all.iter_mut().for_each(|found| found.place = without_rounding(found.place, size));
    all
}

/// Why the stress of a body, or of a part of one, has no bound at a point, if that is known without a comparison of meshes.
pub fn unbounded_at(problem: &Discretisation, solution: &Solution, (name, x): (&str, Point)) -> Option<Unbounded> {
    let (mesh, no_growth) = (&problem.scene.mesh, vec![false; problem.contacts.len()]);
    let body = match mesh.region(name)? {
        Region::Body(body) => body as usize,
        Region::Part(part) => mesh.parts[part as usize].body as usize,
    };
    let near = AT * size_of(mesh);
    let is_there = |found: &SingularPlace| {
        let place = found.vertex.map_or(found.place, |vertex| mesh.vertices[vertex as usize]);
        found.body == body && (place - x).norm() <= near
    };
    places(problem, solution, &no_growth).into_iter().find(is_there).map(|found| found.why)
}

/// The places that bodies, supports and point loads make, and the ends of contacts: those where corners press or λ `grows`.
fn places(problem: &Discretisation, solution: &Solution, grows: &[bool]) -> Vec<SingularPlace> {
    let scene = &problem.scene;
    let mut all = singular_places(&scene.mesh, &scene.parts(), &scene.supports, &scene.rigid);
    all.extend(scene.point_loads.iter().filter_map(|load| at_point(&scene.mesh, &load.at)));
    let angles: FxHashMap<u32, f64> =
        scene.mesh.boundary_vertices().into_iter().map(|found| (found.vertex, found.angle)).collect();
    let contacts = problem.contacts.iter().zip(grows);
    let ends = contacts.flat_map(|(contact, grows)| contact_ends((&scene.mesh, &angles), &solution.pressure(contact), *grows));
    all.extend(ends.filter(|found| !is_mirrored_by_tool(scene, &angles, found)));
    all
}

/// The largest coordinate of a mesh (length).
fn size_of(mesh: &MacroMesh) -> f64 {
    mesh.vertices.iter().map(|x| x.amax()).fold(0.0, f64::max)
}

/// A place with zeros instead of the rounding of them, in a scene of this size.
pub fn without_rounding(place: Point, size: f64) -> Point {
    place.map(|x| if x.abs() < ROUNDING * size { 0.0 } else { x })
}

/// The vertex of a point that carries a force.
fn at_point(mesh: &MacroMesh, spot: &Spot) -> Option<SingularPlace> {
    let vertex = mesh.vertex_at(spot)?;
    let body = mesh.triangles[mesh.triangle_at(vertex)? as usize].body as usize;
    Some(SingularPlace::at_vertex(mesh, body, vertex, Unbounded::Point))
}

/// The ends of a contact up to which bodies press with a pressure that has no bound, for each of its bodies: where a corner of one
/// presses on the other, and where λ `grows`. `angles` are those of the bodies at the vertices of their boundaries (radians).
fn contact_ends(
    (mesh, angles): (&MacroMesh, &FxHashMap<u32, f64>),
    pressure: &ContactPressure,
    grows: bool,
) -> Vec<SingularPlace> {
    let (contact, zones) = (pressure.contact, pressure.zones());
    let (knots, last) = (contact.boundary.knots(), contact.boundary.segments() - 1);
    let why = |end: usize| {
        let zone = zones.iter().find(|zone| zone.is_at_end[end])?;
        let [outer, inner] = if end == 0 { [0, 1] } else { [last, last.saturating_sub(1)] };
        let is_higher = pressure.value(outer, 0.5) > pressure.value(inner.min(last), 0.5);
        let is_corner = pressure.ends_at_a_corner(mesh, zone, end)
            || one_turns((mesh, angles), contact, knots[if end == 0 { 0 } else { last + 1 }]);
        let name = || contact.pair.name.clone();
        match is_corner {
            true => Some(Unbounded::PressingCorner(name())),
            false => (grows && is_higher).then(|| Unbounded::GrowingPressure(name())),
        }
    };
    let ends = [(0, knots[0]), (1, knots[knots.len() - 1])].into_iter().filter(|_| !contact.boundary.is_closed());
    let found = ends.filter_map(|(end, knot)| Some((knot, why(end)?)));
    let is_deformed = contact.pair.configuration == Configuration::Deformed;
    let of_both = |(knot, why): (f64, Unbounded)| {
        let place = contact.boundary.point(knot);
        let is_there = |vertex: &u32| (mesh.vertices[*vertex as usize] - place).norm() < SAME * contact.boundary.length();
        [0, 1].map(|side| {
            let (body, why) = (contact.bodies[side], why.clone());
            let vertex = nearest_vertex(mesh, &contact.pair.between[side], place).filter(is_there);
            SingularPlace { body, place, vertex, is_deformed, why }
        })
    };
    found.flat_map(of_both).collect()
}

/// Whether a corner of 90 degrees or less presses on a rigid tool, which is a mirror for it: the stress has a bound there.
fn is_mirrored_by_tool(
    scene: &Scene,
    angles: &FxHashMap<u32, f64>,
    SingularPlace { body, vertex, why, .. }: &SingularPlace,
) -> bool {
    let Unbounded::PressingCorner(name) = why else { return false };
    let beside_a_tool = scene.pairs.iter().filter(|pair| pair.name == *name).flat_map(|pair| &pair.between).any(|side| {
        let edge = scene.mesh.edges_of(side).first();
        edge.is_some_and(|&edge| scene.mesh.body_beside(edge) != *body && scene.is_rigid(scene.mesh.body_beside(edge)))
    });
    let angle = vertex.and_then(|vertex| angles.get(&vertex)).map_or(180.0, |angle| angle.to_degrees());
    beside_a_tool && angle <= 90.0 + 0.5 * CHORDS
}

/// Whether one body of a contact has a corner at an end of Γ_C, and the other has none: nearest to it on both boundaries.
fn one_turns((mesh, angles): (&MacroMesh, &FxHashMap<u32, f64>), contact: &Contact, knot: f64) -> bool {
    let here = contact.boundary.point(knot);
    let turns = contact.pair.between.each_ref().map(|name| {
        let nearest = nearest_vertex(mesh, name, here)?;
        Some((180.0 - angles.get(&nearest)?.to_degrees()).abs() > CHORDS)
    });
    matches!(turns, [Some(one), Some(other)] if one != other)
}

/// The vertex of a boundary nearest to a place.
fn nearest_vertex(mesh: &MacroMesh, boundary: &str, place: Point) -> Option<u32> {
    let vertices = mesh.boundary(boundary)?.edges.iter().flat_map(|&edge| mesh.edges[edge as usize].vertices);
    let away = |vertex: u32| (mesh.vertices[vertex as usize] - place).norm();
    vertices.min_by(|a, b| away(*a).total_cmp(&away(*b)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::{Known, MultiplierSpace};
    use crate::discretisation::samples::{blocks, contact, pair};

    #[test]
    fn what_is_rounding_beside_a_scene_is_zero() {
        assert_eq!(without_rounding(Point::new(1e-16, -2.0), 2.0), Point::new(0.0, -2.0));
        assert_eq!(without_rounding(Point::new(1e-16, -2e-16), 1e-15), Point::new(1e-16, -2e-16));
    }

    /// The blocks as they are end together; the upper one, made narrower, presses with its corners.
    #[test]
    fn a_corner_presses_where_one_body_ends() {
        let ends = |upper: &dyn Fn(Point) -> Point, values: [f64; 4], grows: bool| {
            let scene = blocks(pair(MultiplierSpace::P0, 4), upper, Vec::new());
            let contact = contact(&scene, Known::default());
            let active = values.map(|value| value > 0.0);
            let angles = scene.mesh.boundary_vertices().into_iter().map(|found| (found.vertex, found.angle)).collect();
            let pressure = ContactPressure { contact: &contact, values: &values, active: &active };
            let found = contact_ends((&scene.mesh, &angles), &pressure, grows);
            assert!(found.iter().all(|found| !found.is_deformed) && found.len().is_multiple_of(2), "one for each body");
            assert!(found.iter().any(|found| found.vertex.is_some()) || found.is_empty(), "the corner that presses is a vertex");
            found.iter().step_by(2).map(|found| (found.place.x, found.why.clone())).collect::<Vec<_>>()
        };
        let narrower = |x: Point| Point::new(0.3 * (1.0 - x.x), 0.0);
        let corner = || Unbounded::PressingCorner("seam".into());
        let pressed = ends(&narrower, [1.0; 4], false);
        assert!((pressed[0].0 - 0.3).abs() < 1e-9 && (pressed[1].0 - 1.7).abs() < 1e-9, "{pressed:?}");
        assert_eq!(pressed.into_iter().map(|(_, why)| why).collect::<Vec<_>>(), [corner(), corner()]);
        assert_eq!(ends(&narrower, [0.0, 1.0, 1.0, 0.0], true), [], "it presses up to neither end");
        let as_they_are = |_: Point| Point::zeros();
        assert_eq!(ends(&as_they_are, [1.0; 4], false), []);
        let grown = ends(&as_they_are, [1.0, 2.0, 3.0, 5.0], true);
        assert_eq!(grown, [(2.0, Unbounded::GrowingPressure("seam".into()))], "towards one end");
    }
}
