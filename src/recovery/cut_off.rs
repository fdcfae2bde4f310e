//! How bodies go on where contact ends: smoothly, so that it is cut off where nothing takes over, or round a corner.
//!
//! Of the roller of a chain that lies in its seat and beside it on the flank, with a contact in the seat alone, λ was 6 to 20 % off a
//! few edges from the end of the seat.

use super::zone_ends::{SAME, beyond, outwards};
use crate::contact::{Law, Zone};
use crate::discretisation::{Contact, ContactPressure, Discretisation, Scene, Solution};
use crate::geometry::Point;
use crate::mesh::MacroMesh;
use std::f64::consts::PI;

/// A boundary goes on smoothly where it turns towards the other body by less than this (20 degrees): less is taken for chords of an
/// arc.
const SMOOTH: f64 = PI / 9.0;

/// Where it turns away by more than this (3 degrees), as at a chamfer, contact may end: chords of 120 around a circle turn by as much.
const OPENS: f64 = PI / 60.0;

/// Contacts that adjoin begin within this share of the length from each other, or within an edge: each has a curve of its own. What
/// overlapped in a hole of 2 % of the length was worth 5 % of the force.
const NEAR: f64 = 0.01;

impl ContactPressure<'_> {
    /// λ where a zone presses up to an end of Γ_C, by the largest λ of the zone, if a named boundary, or a piece of one, ends there,
    /// both bodies go on smoothly, and none of `all` contacts begins there: what presses beyond is left out. The larger one of both ends; 0 if
    /// neither is such an end.
    pub fn cut_off(&self, mesh: &MacroMesh, zone: &Zone, all: &[Contact]) -> f64 {
        let contact = self.contact;
        let is_cut = |end: &usize| zone.is_at_end[*end] && !is_taken_over(contact, *end, all) && goes_on(contact, mesh, *end);
        [0, 1].into_iter().filter(is_cut).map(|end| self.height(zone, end)).fold(0.0, f64::max)
    }

    /// λ beside an end of a zone, by the largest λ of the zone.
    fn height(&self, zone: &Zone, end: usize) -> f64 {
        let segment = [zone.segments.start, zone.segments.end - 1][end];
        self.value(segment, [0.05, 0.95][end]) / self.peak_of(zone)
    }

    /// Whether a zone reaches an end of Γ_C where one of the bodies has a corner and the other goes on.
    pub fn ends_at_a_corner(&self, mesh: &MacroMesh, zone: &Zone, end: usize) -> bool {
        if !zone.is_at_end[end] || self.contact.boundary.is_closed() {
            return false;
        }
        let beyond = beyond(self.contact, mesh, end);
        let least = beyond[0].min(beyond[1]);
        let ending = usize::from(beyond[1] < beyond[0]);
        least.abs() < SAME && beyond[0].max(beyond[1]) > SAME && !is_smooth(self.contact, mesh, ending, end)
    }

    /// Whether the corner of an elastic body presses at an end of a zone on an elastic one that goes on.
    pub fn presses_with_a_corner(&self, scene: &Scene, zone: &Zone, end: usize) -> bool {
        let (contact, mesh) = (self.contact, &scene.mesh);
        let is_elastic = !contact.bodies.iter().any(|&body| scene.is_rigid(body));
        // The side that ends here: where the other one ends, farther on, is no matter.
        let ending = || {
            let beyond = beyond(contact, mesh, end);
            usize::from(beyond[1] < beyond[0])
        };
        is_elastic && self.ends_at_a_corner(mesh, zone, end) && ends_with_a_corner(contact, mesh, ending(), end)
    }
}

/// Whether the outline of a body turns away from the other one where its side ends.
pub fn ends_with_a_corner(contact: &Contact, mesh: &MacroMesh, side: usize, end: usize) -> bool {
    turn_at_end(contact, mesh, side, end).is_some_and(|turn| turn < -SMOOTH)
}

/// Whether both bodies go on smoothly beyond an end of Γ_C, though the boundary of one or both ends there by its name.
fn goes_on(contact: &Contact, mesh: &MacroMesh, end: usize) -> bool {
    // What is joined may end where it likes.
    if contact.boundary.is_closed() || contact.pair.law == Law::Bilateral {
        return false;
    }
    let reach = beyond(contact, mesh, end);
    let has_ended = |side: &usize| reach[*side].abs() < SAME;
    let ended: Vec<usize> = [0, 1].into_iter().filter(has_ended).collect();
    if ended.is_empty() {
        return contact.ends_with_a_body()[end]
            && reach.iter().all(|reach| *reach > SAME)
            && goes_on_in_another_shape(contact, mesh, end);
    }
    reach.iter().all(|reach| *reach > -SAME) && ended.into_iter().all(|side| is_smooth(contact, mesh, side, end))
}

/// Whether no side has a corner beside an end of Γ_C where pieces of sides end that the mesh knows by their shapes, and not by their names:
/// a crown of two radii pressed on the first one alone, with a contact 6 % too narrow.
fn goes_on_in_another_shape(contact: &Contact, mesh: &MacroMesh, end: usize) -> bool {
    let here = contact.boundary.point(contact.boundary.ends()[end]);
    let around = mesh.boundary_vertices();
    [0, 1].into_iter().all(|side| {
        let vertices = mesh.edges_of(&contact.pair.between[side]).iter().flat_map(|&edge| mesh.edges[edge as usize].vertices);
        let away = |vertex: &u32| (mesh.vertices[*vertex as usize] + contact.moved[side][end] - here).norm_squared();
        let nearest = vertices.min_by(|a, b| away(a).total_cmp(&away(b)));
        around
            .iter()
            .find(|found| Some(found.vertex) == nearest)
            .is_some_and(|found| (-OPENS..SMOOTH).contains(&(found.angle - PI)))
    })
}

/// Whether a body goes on smoothly where its boundary ends.
fn is_smooth(contact: &Contact, mesh: &MacroMesh, side: usize, end: usize) -> bool {
    turn_at_end(contact, mesh, side, end).is_some_and(|turn| (-OPENS..SMOOTH).contains(&turn))
}

/// By how much the boundary of a body turns towards the other one where its side ends (radians), negative where it turns away.
fn turn_at_end(contact: &Contact, mesh: &MacroMesh, side: usize, end: usize) -> Option<f64> {
    let last = outwards(contact, mesh, side, end).into_iter().max_by(|(_, a), (_, b)| a.total_cmp(b)).map(|(vertex, _)| vertex);
    let around = mesh.boundary_vertices();
    around.iter().find(|found| Some(found.vertex) == last).map(|found| found.angle - PI)
}

/// Ends of a contact where another one of the same bodies begins, and both bodies go on smoothly.
#[derive(Default)]
pub struct SmoothJoints {
    /// λ where one of the two presses alone, by the largest λ of the zone: the other one is missed, however small. A flat of a crowned
    /// punch had 30 for 27.8, and 1.1 was missed on either side. 0 if there is no such end.
    pub cut: f64,
    /// The contacts that press there, too: they share a force with this one.
    pub shared: Vec<usize>,
}

/// The smooth joints of contact `at` with others.
pub fn smooth_joints(at: usize, problem: &Discretisation, solution: &Solution) -> SmoothJoints {
    let (all, mesh) = (&problem.contacts, &problem.scene.mesh);
    let height = |contact: &Contact, end: usize| {
        let pressure = solution.pressure(contact);
        pressure.zones().iter().filter(|zone| zone.is_at_end[end]).map(|zone| pressure.height(zone, end)).fold(0.0, f64::max)
    };
    let heights = |contact: &Contact, end: usize, other: &Contact| {
        let (there, is_near) = going_on(contact, end, other, mesh)?;
        let is_smooth = goes_on(contact, mesh, end) || goes_on(other, mesh, there);
        is_smooth.then(|| [height(contact, end), if is_near { height(other, there) } else { 0.0 }])
    };
    let own = &all[at];
    let is_beside = |other: &&Contact| other.first != own.first && other.bodies.iter().all(|body| own.bodies.contains(body));
    let mut joints = SmoothJoints::default();
    for (k, other) in all.iter().enumerate().filter(|(_, other)| is_beside(other)) {
        // Γ_C of one that does not press may begin farther off.
        let ends = [(own, 0, other), (own, 1, other), (other, 0, own), (other, 1, own)];
        for [here, there] in ends.into_iter().filter_map(|(contact, end, other)| heights(contact, end, other)) {
            match here > 0.0 && there > 0.0 {
                true => joints.shared.push(k),
                false => joints.cut = joints.cut.max(here.max(there)),
            }
        }
    }
    joints.shared.dedup();
    joints
}

/// Whether sides of another contact go on from a vertex at an end of Γ_C: with which of its ends, and whether its Γ_C begins there.
fn going_on(contact: &Contact, end: usize, other: &Contact, mesh: &MacroMesh) -> Option<(usize, bool)> {
    let here = contact.boundary.point(contact.boundary.ends()[end]);
    let reach = |contact: &Contact| contact.edge_length().max(NEAR * contact.boundary.length());
    let near = reach(contact).max(reach(other));
    let vertices = |side: &String| mesh.edges_of(side).iter().flat_map(|&edge| mesh.edges[edge as usize].vertices);
    let place = |vertex: u32| mesh.vertices[vertex as usize];
    let [own, others] = [contact, other].map(|contact| &contact.pair.between);
    // A side that both have goes on anywhere; of two quarters of a circle in four of another one, one may end and the other not.
    let common = |a: &String, b: &String| {
        vertices(a)
            .filter(|&vertex| (place(vertex) - here).norm() < near)
            .find(|&vertex| vertices(b).any(|other| other == vertex))
    };
    let apart = own.iter().filter(|a| !others.contains(a));
    let joints: Option<Vec<u32>> = apart.map(|a| others.iter().find_map(|b| common(a, b))).collect();
    let joint = *joints?.first()?;
    let away = other.boundary.ends().map(|t| (other.boundary.point(t) - place(joint)).norm());
    let there = usize::from(away[1] < away[0]);
    Some((there, away[there] < near))
}

/// Whether another contact of the same bodies begins at an end of Γ_C.
pub fn is_taken_over(contact: &Contact, end: usize, all: &[Contact]) -> bool {
    let ends = |contact: &Contact| -> [Point; 2] { contact.boundary.ends().map(|t| contact.boundary.point(t)) };
    let (here, near) = (ends(contact)[end], contact.edge_length().max(NEAR * contact.boundary.length()));
    let others =
        all.iter().filter(|other| other.first != contact.first && other.bodies.iter().all(|body| contact.bodies.contains(body)));
    others.flat_map(ends).any(|there| (there - here).norm() < near)
}
