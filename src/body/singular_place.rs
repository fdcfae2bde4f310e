//! Places where the exact stress of a body has no bound: by its shape, by what holds it, by its materials.
//!
//! Near a corner of the angle α between two straight sides the stress goes like a power of the distance, which is negative from
//! some α on (Williams 1952): 180 degrees where both sides are free, or both are held; 90 degrees where one of them is a mirror,
//! along which the body slides freely, for there it goes on with the angle 2α; and about 63 degrees between a side that is held and
//! a free one (ν = 0.3 in plane strain). Chords of arcs turn a little at their ends without a corner being meant.

use super::rigid::{RigidNodes, RigidSet};
use super::{BodyPart, Support};
use crate::geometry::{Coordinates, Point, cross};
use crate::mesh::{BoundaryVertex, MacroMesh};
use std::collections::HashMap;
use std::fmt::{self, Display, Formatter};

/// Turns of a boundary that are smaller are those of chords (degrees), as where boundaries are parted at corners.
pub const CHORDS: f64 = 20.0;

/// Angle from which on the stress has no bound between a side that is held and a free one (degrees).
const HELD_AND_FREE: f64 = 63.0;

/// Directions closer than this (sine) are one direction.
const SAME: f64 = 1e-6;

/// Why the stress has no bound at a place.
#[derive(Clone, Debug, PartialEq)]
pub enum Unbounded {
    /// The body has a re-entrant corner.
    Corner,
    /// What holds the boundary ends there, or begins to hold it otherwise: its key in the case file.
    HoldEnds(String),
    /// Two materials meet at the boundary, or with a corner.
    Materials,
    /// A force acts at a point.
    Point,
    /// The corner of a body presses at the end of the contact of this name, where the other body goes on.
    PressingCorner(String),
    /// The pressure grows without bound towards the end of the contact of this name, as far as meshes tell.
    GrowingPressure(String),
}

/// A place where the stress of a body has no bound.
#[derive(Clone, Debug, PartialEq)]
pub struct SingularPlace {
    /// Index of the body.
    pub body: usize,
    /// Where.
    pub place: Point,
    /// The vertex of the mesh that it is, if it is one.
    pub vertex: Option<u32>,
    /// Whether that is meant on the deformed bodies.
    pub is_deformed: bool,
    /// Why.
    pub why: Unbounded,
}

impl SingularPlace {
    /// A vertex of the undeformed body.
    pub fn at_vertex(mesh: &MacroMesh, body: usize, vertex: u32, why: Unbounded) -> Self {
        Self { body, place: mesh.vertices[vertex as usize], vertex: Some(vertex), is_deformed: false, why }
    }
}

impl Display for SingularPlace {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        let place = Coordinates(self.place);
        match &self.why {
            Unbounded::Corner => write!(f, "at the corner {place}"),
            Unbounded::HoldEnds(key) => write!(f, "at the end of {key}, {place}"),
            Unbounded::Materials => write!(f, "at the end of an edge between two materials, {place}"),
            Unbounded::Point => write!(f, "at the point {place}, which carries a force"),
            Unbounded::PressingCorner(name) => write!(f, "at the pressing corner of contact {name}, {place}"),
            Unbounded::GrowingPressure(name) => write!(f, "at the end of contact {name}, {place}"),
        }
    }
}

/// How a boundary edge is held: along its normal, along its tangent; and by what, as the case calls it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct EdgeHold<'a> {
    normal: bool,
    tangent: bool,
    key: Option<(&'static str, &'a str)>,
}

impl EdgeHold<'_> {
    fn kind(&self) -> (bool, bool) {
        (self.normal, self.tangent)
    }

    /// Whether the body slides along it as along a mirror, or as along the axis of an odd one.
    fn is_mirror(&self) -> bool {
        self.normal != self.tangent
    }

    fn is_free(&self) -> bool {
        !self.normal && !self.tangent
    }

    fn key(&self) -> Option<String> {
        self.key.map(|(kind, name)| format!("{kind}{name}"))
    }
}

/// The places that shape, supports, stiff boundaries and materials of all bodies make. `parts` are those of the mesh.
pub fn singular_places(mesh: &MacroMesh, parts: &[&BodyPart], supports: &[Support], rigid: &[RigidSet]) -> Vec<SingularPlace> {
    let holds = edge_holds(mesh, supports, rigid);
    let hold = |edge: u32| holds.get(&edge).copied().unwrap_or_default();
    let mut joints = joints(mesh, parts);
    let mut found = Vec::new();
    for at in mesh.boundary_vertices() {
        let joint = joints.remove(&at.vertex);
        let why = by_sides(&at, at.edges.map(hold)).or_else(|| {
            let is_on_mirror = at.edges.iter().all(|&edge| hold(edge).is_mirror());
            joint.filter(|_| !is_on_mirror).map(|_| Unbounded::Materials)
        });
        found.extend(why.map(|why| SingularPlace::at_vertex(mesh, mesh.body_beside(at.edges[0]), at.vertex, why)));
    }
    let inside = joints.into_iter().filter(|(_, Joint { directions, .. })| turns(directions));
    let at_joint = |(vertex, Joint { body, .. })| SingularPlace::at_vertex(mesh, body, vertex, Unbounded::Materials);
    found.extend(inside.map(at_joint));
    found
}

/// Why the stress has no bound at a vertex of the boundary, by the angle there and by how both sides are held.
fn by_sides(at: &BoundaryVertex, [before, behind]: [EdgeHold; 2]) -> Option<Unbounded> {
    let angle = at.angle.to_degrees();
    let is_one = before.kind() == behind.kind();
    if is_one && (angle - 180.0).abs() < CHORDS {
        return None;
    }
    let least = match (before.is_mirror() || behind.is_mirror(), is_one) {
        (true, _) => 90.0 + 0.5 * CHORDS,
        (false, true) => 180.0 + CHORDS,
        (false, false) => HELD_AND_FREE,
    };
    let is_corner = before.is_free() && behind.is_free() || angle >= 180.0 + CHORDS;
    let key = || before.key().or_else(|| behind.key());
    (angle > least).then(|| if is_corner { Unbounded::Corner } else { key().map_or(Unbounded::Corner, Unbounded::HoldEnds) })
}

/// How boundary edges are held, those that are.
fn edge_holds<'a>(mesh: &MacroMesh, supports: &'a [Support], rigid: &'a [RigidSet]) -> HashMap<u32, EdgeHold<'a>> {
    let mut holds: HashMap<u32, EdgeHold> = HashMap::new();
    for support in supports {
        for edge in mesh.edges_on(&support.on) {
            let [a, b] = mesh.edge_ends(edge);
            let along = (b - a).normalize();
            let hold = holds.entry(edge).or_default();
            hold.key = Some(("support.", &support.name));
            hold.normal |= support.normal.is_some();
            for (_, axis) in support.axes() {
                // Along neither of both it holds a part of each.
                hold.normal |= cross(along, axis).abs() > SAME;
                hold.tangent |= along.dot(&axis).abs() > SAME;
            }
        }
    }
    for set in rigid {
        let RigidNodes::Boundaries(names) = &set.nodes else { continue };
        let key = Some(("", set.key.as_str()));
        mesh.edges_on(names).for_each(|edge| _ = holds.insert(edge, EdgeHold { normal: true, tangent: true, key }));
    }
    if mesh.plane == crate::element::Plane::Revolution {
        mesh.edges_on_axis().for_each(|edge| holds.entry(edge).or_default().normal = true);
    }
    holds
}

/// A vertex at which edges between two materials end.
struct Joint {
    body: usize,
    /// Along those edges, away from the vertex.
    directions: Vec<Point>,
}

/// The vertices at which edges between different materials end.
fn joints(mesh: &MacroMesh, parts: &[&BodyPart]) -> HashMap<u32, Joint> {
    let mut joints: HashMap<u32, Joint> = HashMap::new();
    for (edge, beside) in mesh.edges.iter().enumerate() {
        let [Some(first), Some(second)] = beside.triangles.map(|k| k.map(|k| &mesh.triangles[k as usize])) else { continue };
        let [a, b] = [first, second].map(|triangle| parts[triangle.part as usize]);
        let is_one = first.part == second.part || a.is_alike(b);
        for vertex in beside.vertices.into_iter().filter(|_| !is_one) {
            let joint = joints.entry(vertex).or_insert(Joint { body: first.body as usize, directions: Vec::new() });
            joint.directions.push(mesh.direction_from(edge as u32, vertex));
        }
    }
    joints
}

/// Whether edges between materials meet otherwise than as two that go on as each other.
fn turns(directions: &[Point]) -> bool {
    match directions {
        [a, b] => a.dot(b) > -CHORDS.to_radians().cos(),
        _ => true,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::Material;
    use crate::element::Plane;
    use crate::geometry::Formula;
    use crate::mesh::samples::two_blocks;

    fn part(name: &str, young: f64) -> BodyPart {
        let zero = || Formula::constant(0.0);
        BodyPart {
            name: name.into(),
            material: Material { young, poisson: 0.3, plane: Plane::Strain },
            force: [zero(), zero()],
            heat: None,
        }
    }

    fn support(on: &str, [ux, uy]: [bool; 2]) -> Support {
        let zero = |is: bool| is.then(|| Formula::constant(0.0));
        Support { name: format!("of {on}"), on: vec![on.into()], at: None, ux: zero(ux), uy: zero(uy), normal: None }
    }

    /// Places and reasons of the two blocks, the middle of the lower side of the upper one moved up.
    fn found(up: f64, supports: &[Support]) -> Vec<String> {
        let mut mesh = two_blocks();
        mesh.vertices.iter_mut().filter(|x| x.x == 0.9 && x.y == 1.0).for_each(|x| x.y += up);
        let parts = [part("lower", 1.0), part("upper", 2.0)];
        let mut words: Vec<String> =
            singular_places(&mesh, &parts.each_ref(), supports, &[]).iter().map(|place| place.to_string()).collect();
        words.sort();
        words
    }

    #[test]
    fn a_reentrant_corner_counts_and_a_blunt_one_does_not() {
        assert_eq!(found(0.0, &[]), [""; 0]);
        assert_eq!(found(0.1, &[]), [""; 0], "it turns by less than chords may");
        assert_eq!(found(0.3, &[]), ["at the corner (0.9, 1.3)"]);
        assert_eq!(found(-0.3, &[]), [""; 0], "it bulges");
    }

    #[test]
    fn a_clamped_side_ends_at_singular_corners_and_a_mirror_does_not() {
        let ends = ["at the end of support.of bottom, (0, 0)", "at the end of support.of bottom, (2, 0)"];
        assert_eq!(found(0.0, &[support("bottom", [true, true])]), ends);
        assert_eq!(found(0.0, &[support("bottom", [false, true])]), [""; 0], "the block slides along it");
        assert_eq!(found(0.0, &[support("bottom", [true, false])]), [""; 0], "and across it, as an odd mirror");
        let both = [support("bottom", [false, true]), support("bottom", [true, false])];
        assert_eq!(found(0.0, &both).len(), 2, "two supports clamp it");
    }

    #[test]
    fn materials_meet_at_the_boundary_unless_it_is_a_mirror() {
        let mut mesh = crate::mesh::samples::parted_square();
        let parts = [part("core", 1.0), part("film", 2.0)];
        let count = |mesh: &MacroMesh, parts: &[BodyPart; 2], supports: &[Support]| {
            let found = singular_places(mesh, &parts.each_ref(), supports, &[]);
            assert!(found.iter().all(|found| found.why == Unbounded::Materials), "{found:?}");
            found.len()
        };
        assert_eq!(count(&mesh, &parts, &[]), 2);
        assert_eq!(count(&mesh, &[part("core", 1.0), part("film", 1.0)], &[]), 0, "one material");
        mesh.plane = Plane::Revolution;
        assert_eq!(count(&mesh, &parts, &[support("bottom", [false, true])]), 1, "(0, 0) lies on the axis and on a mirror");
    }
}
