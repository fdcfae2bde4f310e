//! Whether supports and contact hold every piece of every body.
//!
//! Each contact is tried with the normals of body 1 and with those of body 2, and one of them is enough to let go: a body that
//! slides along its own smooth boundary changes no gap. The least hold of 1e-4 leaves room: a bar a hundred times longer than
//! its seat is held by 1e-2. A body whose loads do no work on its free motion, as a disc that is squeezed from above and below,
//! is in balance, but its turn is not determined: it is not held either.

use crate::body::{Constraints, HeldMode, MeanHold, RigidSet, UNIT_MOTIONS};
use crate::contact::{self, Condition, Extent, Mechanism, Side, Touch, find_mechanism};
use crate::discretisation::contacts::{Contact, Coupled, coupled_here};
use crate::discretisation::error::SystemError;
use crate::discretisation::levels::Discretisation;
use crate::discretisation::motions::free_motion::FreeMotion;
use crate::discretisation::scene::Scene;
use crate::element::{Order, Plane};
use crate::geometry::{AXES, Point};
use crate::mesh::{Level, MacroMesh, Numbering, SmoothNormals, each_once};
use crate::petsc::Session;
use std::collections::{HashMap, HashSet};
use std::ops::Range;

/// Cosine of the angle (8 degrees) between a chord's normal and that of its arc at most.
const ALIKE: f64 = 0.99;

/// Stiffness of springs by Young's modulus of their body below which equilibrium sets the force of a contact beside them, to a hundredth.
pub(super) const FIRM: f64 = 1e-2;

/// Words for a body that neither supports nor the active multipliers hold; nothing if all are held. **Collective**
pub fn not_held(problem: &Discretisation, active: &[bool]) -> Option<String> {
    Restraints::of(problem).not_held(active)
}

/// Words for a body that nothing drives, and that neither supports nor those contacts hold of which a multiplier is active; nothing if
/// there is none. **Collective**
pub fn adrift(problem: &Discretisation, active: &[bool]) -> Option<String> {
    let is_closed = |contact: &Contact| vec![active[contact.range()].contains(&true); contact.multipliers.count()];
    let closed: Vec<bool> = problem.contacts.iter().flat_map(is_closed).collect();
    let whole = Restraints::of(problem);
    let mechanism = whole.mechanism(&closed)?;
    if whole.free(|free| free.is_driven(), &mechanism) { None } else { whole.not_held(&closed) }
}

/// The same where all contact is closed, of contacts whose edges are all on this rank.
///
/// # Errors
/// [`SystemError::Case`] if a contact cannot be integrated.
pub fn not_held_if_closed(scene: &Scene, numbering: &Numbering, contacts: &[Contact]) -> Result<Option<String>, SystemError> {
    let rows = coupled_here(contacts)?.0;
    Ok(Restraints { scene, numbering, contacts, rows: &rows, shared: None }.not_held(&vec![true; rows.len()]))
}

/// A rigid motion of a piece that nothing holds.
pub struct LooseMotion {
    /// The piece and its motion.
    pub mechanism: Mechanism,
    /// Whether loads do work in it.
    pub is_driven: bool,
    /// Keys that hold its shift, if that goes along no axis.
    pub slanted: Option<[String; 2]>,
}

/// A rigid motion of a piece that nothing holds there; nothing if all are held.
///
/// # Errors
/// As of [`not_held_if_closed`].
pub fn free_motion_if_closed(
    scene: &Scene,
    numbering: &Numbering,
    contacts: &[Contact],
) -> Result<Option<LooseMotion>, SystemError> {
    let rows = coupled_here(contacts)?.0;
    let whole = Restraints { scene, numbering, contacts, rows: &rows, shared: None };
    let mechanism = whole.mechanism(&vec![true; rows.len()]);
    Ok(mechanism.map(|mechanism| {
        let (is_driven, slanted) = whole.free(|free| (free.is_driven(), free.slanted_shift()), &mechanism);
        LooseMotion { mechanism, is_driven, slanted }
    }))
}

/// For each contact whether some body could move if it were open: then equilibrium sets its force, and bodies that are a little
/// farther apart there come together again. **Collective**
pub fn needed_contacts(problem: &Discretisation, active: &[bool]) -> Vec<bool> {
    let (whole, extents) = (Restraints::of(problem), problem.scene.extents());
    let mut held = support_conditions(&problem.scene, &extents);
    held.extend(spring_conditions(&problem.scene, &extents, FIRM));
    contact::needed_contacts(&extents, &held, &whole.touches(&extents, active))
}

/// Of the open multipliers those that hold every body if they close: for one motion after the other that nothing holds, the one with
/// the largest `force` on the contact that the loads drive the body against, or on any of its contacts where there is none. In a box
/// with clearance the wall that a body is driven off may be as near as the one that stops it. **Collective**
pub fn few_that_hold(problem: &Discretisation, active: &[bool], force: impl Fn(usize) -> f64) -> Vec<usize> {
    let whole = Restraints::of(problem);
    let (mut closed, mut few) = (active.to_vec(), Vec::new());
    while let Some(mechanism) = whole.mechanism(&closed) {
        let stops = whole.free(|free| free.stopped_by(&whole.touches(free.extents, &vec![true; closed.len()])), &mechanism);
        let body = problem.scene.mesh.pieces[mechanism.piece].body;
        let own = problem.contacts.iter().filter(|contact| contact.bodies.contains(&body));
        let open = |range: Range<usize>| range.filter(|&i| !closed[i]).max_by(|&a, &b| force(a).total_cmp(&force(b)));
        let stopping = stops.and_then(|at| open(problem.contacts[at].range()));
        let any = || own.filter_map(|contact| open(contact.range())).max_by(|&a, &b| force(a).total_cmp(&force(b)));
        let Some(next) = stopping.or_else(any) else { break };
        closed[next] = true;
        few.push(next);
    }
    few
}

/// Everything that holds bodies. Rigid motions are those of the undeformed bodies: a disc that is pressed flat rolls on.
pub(super) struct Restraints<'a> {
    scene: &'a Scene,
    numbering: &'a Numbering,
    contacts: &'a [Contact],
    /// Rows of all multipliers, or at least of those of this rank.
    rows: &'a [Vec<Coupled>],
    /// All ranks with the owners of the multipliers; nothing if this rank has all rows.
    shared: Option<(&'a Session, &'a [usize])>,
}

impl<'a> Restraints<'a> {
    pub(super) fn of(problem: &'a Discretisation) -> Self {
        Self {
            scene: &problem.scene,
            numbering: &problem.finest().numbering,
            contacts: &problem.contacts,
            rows: &problem.coupling.rows,
            shared: Some((&problem.session, &problem.coupling.owners)),
        }
    }

    /// What the closed multipliers of all contacts resist, the same on every rank. **Collective**
    pub(super) fn touches(&self, extents: &[Extent], active: &[bool]) -> Vec<Touch> {
        let own: Vec<Touch> = self.contacts.iter().map(|contact| self.touch(contact, extents, active)).collect();
        match self.shared {
            Some((session, _)) => of_all_ranks(&own, session),
            None => own,
        }
    }

    /// **Collective**
    fn mechanism(&self, active: &[bool]) -> Option<Mechanism> {
        let extents = self.scene.extents();
        find_mechanism(&extents, &holding_conditions(self.scene, &extents), &self.touches(&extents, active))
    }

    /// What is told of a motion that nothing holds.
    fn free<T>(&self, tell: impl FnOnce(&FreeMotion) -> T, mechanism: &Mechanism) -> T {
        let extents = self.scene.extents();
        let supports = holding_conditions(self.scene, &extents);
        tell(&FreeMotion { scene: self.scene, mechanism, extents: &extents, supports: &supports })
    }

    /// **Collective**
    fn not_held(&self, active: &[bool]) -> Option<String> {
        let mechanism = self.mechanism(active)?;
        Some(self.free(|free| self.words(free, active), &mechanism))
    }

    /// Words for a motion that is free with what is `active`. **Collective**
    fn words(&self, free: &FreeMotion, active: &[bool]) -> String {
        let (mechanism, touches) = (free.mechanism, self.touches(free.extents, active));
        let name = self.scene.mesh.name_of_piece(mechanism.piece);
        if let Some(contact) = free.stopped_by(&self.touches(free.extents, &vec![true; active.len()])) {
            return format!(
                "{name} can {} with what was found to press, but its loads drive it against contact {}, which would hold it: no set of what presses was found; refine the mesh where contact is, or draw the bodies where they touch",
                mechanism.motion, self.contacts[contact].pair.name
            );
        }
        let (by, moved) = match (active.contains(&true), self.scene.is_moved()) {
            (true, _) => ("supports and contact do not hold it", ""),
            (false, is_moved) => (
                "contact is open everywhere and supports do not hold it",
                if is_moved { "; where what moves is to press it, refine the mesh where contact is" } else { "" },
            ),
        };
        format!("{name} can {}: {by}; {}{moved}", mechanism.motion, free.remedy(&touches))
    }

    /// What the closed multipliers of a contact that are this rank's resist, by the normals of body 1 and by those of body 2.
    fn touch(&self, contact: &Contact, extents: &[Extent], active: &[bool]) -> Touch {
        let mesh = &self.scene.mesh;
        let normals = contact.pair.between.each_ref().map(|name| SmoothNormals::new(mesh, mesh.edges_of(name)));
        let mut touch = Touch::default();
        let is_own = |i: usize| self.shared.is_none_or(|(session, owners)| owners[i] == session.rank());
        for row in contact.range().filter(|&i| active[i] && is_own(i)).map(|i| &self.rows[i]) {
            let pieces = [Side::First, Side::Second].map(|side| self.heaviest_piece(row, side));
            let [Some(first), Some(second)] = pieces else { continue };
            for (k, (side, against)) in [(Side::First, second), (Side::Second, first)].into_iter().enumerate() {
                touch[k].extend(self.conditions(row, side, &normals[k], against, extents));
            }
        }
        touch
    }

    /// The piece that takes most of a multiplier on one side.
    fn heaviest_piece(&self, row: &[Coupled], side: Side) -> Option<usize> {
        let own = row.iter().filter(|coupled| coupled.side == side);
        let heaviest = own.max_by(|a, b| a.value.norm().total_cmp(&b.value.norm()))?;
        Some(self.scene.mesh.piece_beside(heaviest.node.edge))
    }

    /// What one multiplier resists by the normals of one body, for each of its pieces that takes part.
    fn conditions(
        &self,
        row: &[Coupled],
        side: Side,
        normals: &SmoothNormals,
        against: usize,
        extents: &[Extent],
    ) -> Vec<Condition> {
        let mesh = &self.scene.mesh;
        let of_side = || row.iter().filter(|coupled| coupled.side == side);
        let pieces = each_once(of_side().map(|coupled| mesh.piece_beside(coupled.node.edge)));
        let of_piece = |piece: usize| {
            let (mut terms, mut doubt) = (Vec::new(), 0.0_f64);
            for coupled in of_side().filter(|coupled| mesh.piece_beside(coupled.node.edge) == piece) {
                let point = normals.at(mesh, coupled.node.edge, coupled.node.fraction(mesh, self.numbering));
                terms.push((point.place, coupled.value.norm() * point.normal));
                doubt = doubt.max(point.doubt);
            }
            Condition::new(extents, piece, Some(against), &terms, doubt)
        };
        pieces.into_iter().filter_map(of_piece).collect()
    }
}

/// What the multipliers of all ranks resist, by the ranks that own them. **Collective**
fn of_all_ranks(own: &[Touch], session: &Session) -> Vec<Touch> {
    let (mut keys, mut values) = (Vec::new(), Vec::new());
    for (number, touch) in own.iter().enumerate() {
        for (k, condition) in (0..2).flat_map(|k| touch[k].iter().map(move |condition| (k, condition))) {
            let against = condition.against.map_or(-1, |piece| piece as i32);
            keys.extend([(2 * number + k) as i32, condition.piece as i32, against]);
            values.extend_from_slice(condition.sees.as_flattened());
            values.push(condition.doubt);
        }
    }
    let (keys, values) = (session.gather_all(&keys), session.gather_all(&values));
    let mut all = vec![Touch::default(); own.len()];
    for (key, value) in keys.chunks_exact(3).zip(values.chunks_exact(7)) {
        let sees = [[value[0], value[1], value[2]], [value[3], value[4], value[5]]];
        let (piece, against) = (key[1] as usize, usize::try_from(key[2]).ok());
        all[key[0] as usize / 2][key[0] as usize % 2].push(Condition { piece, against, sees, doubt: value[6] });
    }
    all
}

/// Everything that supports and springs hold, at the macro vertices.
fn holding_conditions(scene: &Scene, extents: &[Extent]) -> Vec<Condition> {
    support_conditions(scene, extents).into_iter().chain(spring_conditions(scene, extents, 0.0)).collect()
}

/// Everything that supports hold, at the macro vertices.
pub fn support_conditions(scene: &Scene, extents: &[Extent]) -> Vec<Condition> {
    conditions_with(scene, extents, |_| true)
}

/// Everything that supports hold, of mean motions those that count.
pub(super) fn conditions_with(scene: &Scene, extents: &[Extent], counts: impl Fn(&MeanHold) -> bool) -> Vec<Condition> {
    let numbering = Numbering::new(Level { intervals: 1, order: Order::P1 }, &scene.partition);
    let along_normals = scene.supports.iter().filter(|support| support.normal.is_some());
    let normals = mean_normals(&scene.mesh, along_normals.map(|support| scene.mesh.edges_on(&support.on).collect()));
    let condition = |held: Held| {
        // A direction along the mean of two chords' normals stands for the normal of their arc.
        let smooth = normals.get(&held.vertex).map(|normal| normal * normal.dot(&held.direction).signum());
        let direction = smooth.filter(|normal| normal.dot(&held.direction) > ALIKE).unwrap_or(held.direction);
        Condition::new(extents, held.piece, None, &[(held.place, direction)], 0.0)
    };
    let free = scene.rigid.iter().filter(|set| set.free().next().is_some());
    let rigid = free.flat_map(|set| rigid_conditions(scene, set, extents)).chain(revolution_conditions(scene));
    let held = supported(scene, &numbering, &[]).into_iter().filter_map(condition);
    held.chain(mean_conditions(scene, extents, counts)).chain(rigid).collect()
}

/// The mean motions that are held: a turn about the middle of a body, or the shift of that. Anchors would hold a turn as far as the body
/// does not shift.
fn mean_conditions(scene: &Scene, extents: &[Extent], counts: impl Fn(&MeanHold) -> bool) -> impl Iterator<Item = Condition> {
    let mesh = &scene.mesh;
    let of_hold = |hold: &MeanHold| {
        let piece = mesh.pieces.iter().position(|piece| mesh.bodies[piece.body] == hold.body);
        let condition = |held: &HeldMode| match held.is_turn() {
            true => Some(Condition { piece: piece?, against: None, sees: [UNIT_MOTIONS[2], [0.0; 3]], doubt: 0.0 }),
            false => Condition::new(extents, piece?, None, &[(hold.middle, held.direction())], 0.0),
        };
        hold.held.iter().filter_map(condition).collect::<Vec<_>>()
    };
    scene.means.iter().filter(move |hold| counts(hold)).flat_map(of_hold)
}

/// The motions that no body of revolution has: shifts across the axis, and turns.
fn revolution_conditions(scene: &Scene) -> impl Iterator<Item = Condition> {
    let pieces = if scene.mesh.plane == Plane::Revolution { scene.mesh.pieces.len() } else { 0 };
    let held = |piece: usize, k: usize| Condition { piece, against: None, sees: [UNIT_MOTIONS[k], [0.0; 3]], doubt: 0.0 };
    (0..pieces).flat_map(move |piece| [held(piece, 0), held(piece, 2)])
}

/// What is prescribed of the motion of a rigid set that is free otherwise: the shift of its reference point, and its turn.
fn rigid_conditions(scene: &Scene, set: &RigidSet, extents: &[Extent]) -> Vec<Condition> {
    let mesh = &scene.mesh;
    let edges = set.edges(mesh);
    let Some(&first) = edges.first() else { return Vec::new() };
    let ends = edges.iter().flat_map(|&edge| mesh.edges[edge as usize].vertices).map(|vertex| mesh.vertices[vertex as usize]);
    let arm = ends.map(|x| (x - set.about).norm()).fold(f64::MIN_POSITIVE, f64::max);
    let [along, up] = [Point::new(arm, 0.0), Point::new(0.0, 1.0)];
    let terms =
        [vec![(set.about, Point::new(1.0, 0.0))], vec![(set.about, up)], vec![(set.about + along, up), (set.about - along, -up)]];
    let piece = mesh.piece_beside(first);
    let prescribed = terms.into_iter().zip(set.prescribed).filter(|(_, component)| component.is_some());
    prescribed.filter_map(|(terms, _)| Condition::new(extents, piece, None, &terms, 0.0)).collect()
}

/// What springs resist at the macro vertices, if their whole boundary is this much stiffer than the body's Young's modulus.
pub(super) fn spring_conditions(scene: &Scene, extents: &[Extent], firm: f64) -> Vec<Condition> {
    let mesh = &scene.mesh;
    let mut all = Vec::new();
    for springs in &scene.springs {
        let edges = springs.edges(mesh);
        let normals = mean_normals(mesh, [edges.clone()]);
        let length: f64 = edges.iter().map(|&edge| mesh.edge_slope(edge, 0.5).norm()).sum();
        for &edge in &edges {
            let least = firm * scene.young_of(mesh.triangles[mesh.beside(edge).0 as usize].part as usize) / length;
            for vertex in mesh.edges[edge as usize].vertices {
                let place = mesh.vertices[vertex as usize];
                let held = springs.stiffness.at(place, normals[&vertex]).into_iter().filter(|(_, k)| *k > least);
                let piece = mesh.piece_beside(edge);
                all.extend(held.filter_map(|(direction, _)| Condition::new(extents, piece, None, &[(place, direction)], 0.0)));
            }
        }
    }
    all
}

/// Smooth normals at the vertices of groups of edges: means over the edges there, each of which goes on in its own group alone.
fn mean_normals(mesh: &MacroMesh, groups: impl IntoIterator<Item = Vec<u32>>) -> HashMap<u32, Point> {
    let mut normals = HashMap::new();
    for edges in groups {
        let smooth = SmoothNormals::new(mesh, &edges);
        for edge in edges {
            for (vertex, t) in mesh.edges[edge as usize].vertices.into_iter().zip([0.0, 1.0]) {
                *normals.entry(vertex).or_insert_with(Point::zeros) += smooth.at(mesh, edge, t).normal;
            }
        }
    }
    normals.values_mut().for_each(|normal: &mut Point| *normal = normal.normalize());
    normals
}

/// A displacement that is prescribed.
pub struct Held {
    /// Piece of a body.
    pub piece: usize,
    /// Macro vertex.
    pub vertex: u32,
    /// Where.
    pub place: Point,
    /// In which direction, a unit vector.
    pub direction: Point,
    /// How far (length).
    pub value: f64,
}

/// Everything that supports prescribe at the macro vertices, rigid sets that are not free in any component, and these means at their
/// anchors.
pub fn supported(scene: &Scene, numbering: &Numbering, means: &[MeanHold]) -> Vec<Held> {
    let Ok(constraints) = Constraints::new(&scene.mesh, numbering, &scene.supports, means, &scene.rigid) else {
        return Vec::new();
    };
    let mut piece = vec![0; scene.mesh.vertices.len()];
    for triangle in scene.mesh.triangles.iter().filter(|_| scene.mesh.pieces.len() > 1) {
        triangle.vertices.iter().for_each(|&vertex| piece[vertex as usize] = triangle.piece as usize);
    }
    let free = scene.rigid.iter().filter(|set| set.free().next().is_some());
    let moving: HashSet<usize> = free.flat_map(|set| set.places(&scene.mesh, numbering).into_keys()).collect();
    let mut all = Vec::new();
    for (vertex, &place) in scene.mesh.vertices.iter().enumerate() {
        if moving.contains(&numbering.vertex(vertex as u32)) {
            continue;
        }
        let Some(constraint) = constraints.get(numbering.vertex(vertex as u32)) else { continue };
        for (k, axis) in AXES.into_iter().enumerate() {
            if constraint.fixed[k] {
                let direction = constraint.to_global(axis);
                all.push(Held { piece: piece[vertex], vertex: vertex as u32, place, direction, value: constraint.value[k] });
            }
        }
    }
    all
}
