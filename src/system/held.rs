//! Whether supports and contact hold every piece of every body.

use crate::body::{Constraints, RigidSet};
use crate::contact::{Condition, Extent, Mechanism, Side, Touch, find_mechanism, integrate};
use crate::element::Order;
use crate::geometry::Point;
use crate::mesh::{Level, MacroMesh, Numbering, SmoothNormals};
use crate::petsc::Session;
use crate::system::{Contact, Coupled, Discretisation, Scene, SystemError};
use std::collections::{HashMap, HashSet};

/// Points of a boundary that are proposed for a support.
const POINTS: usize = 8;

/// Cosine of the angle (8 degrees) between a chord's normal and that of its arc at most.
const ALIKE: f64 = 0.99;

/// Points that are tried, whether a support there would hold all.
const MOST_POINTS: usize = 32;

/// Words for a body that neither supports nor the active multipliers hold; nothing if all are held. **Collective**
pub fn not_held(problem: &Discretisation, active: &[bool], session: &Session) -> Option<String> {
    Restraints::of(problem, session).not_held(active)
}

/// The same where all contact is closed, of contacts whose edges are all on this rank.
///
/// # Errors
/// [`SystemError::Case`] if a contact cannot be integrated.
pub fn not_held_if_closed(scene: &Scene, numbering: &Numbering, contacts: &[Contact]) -> Result<Option<String>, SystemError> {
    let rows = coupled_rows(contacts)?;
    Ok(Restraints { scene, numbering, contacts, rows: &rows, shared: None }.not_held(&vec![true; rows.len()]))
}

/// A rigid motion of a piece that nothing holds there; nothing if all are held.
///
/// # Errors
/// As of [`not_held_if_closed`].
pub fn free_motion_if_closed(
    scene: &Scene,
    numbering: &Numbering,
    contacts: &[Contact],
) -> Result<Option<Mechanism>, SystemError> {
    let rows = coupled_rows(contacts)?;
    Ok(Restraints { scene, numbering, contacts, rows: &rows, shared: None }.mechanism(&vec![true; rows.len()]))
}

/// What each multiplier couples, of contacts whose edges are all on this rank.
fn coupled_rows(contacts: &[Contact]) -> Result<Vec<Vec<Coupled>>, SystemError> {
    let mut rows = vec![Vec::new(); contacts.last().map_or(0, |contact| contact.range().end)];
    for contact in contacts {
        for (k, side) in [Side::First, Side::Second].into_iter().enumerate() {
            let (rule, edges) = (contact.pair.quadrature, &contact.edges[k]);
            let own = integrate(&contact.boundary, &contact.multipliers, rule, side, edges, &contact.distance(k))
                .map_err(|words| SystemError::Case(format!("contact.{}: {words}", contact.pair.name)))?;
            for entry in own.entries {
                let coupled = Coupled { node: entry.node, body: contact.bodies[k], side, value: entry.value };
                rows[contact.first + entry.multiplier].push(coupled);
            }
        }
    }
    Ok(rows)
}

/// Whether some body could move if this contact were open: then equilibrium sets its force, and bodies that are a little
/// farther apart there come together again. **Collective**
pub fn is_needed(problem: &Discretisation, active: &[bool], contact: &Contact, session: &Session) -> bool {
    let mut others = active.to_vec();
    others[contact.range()].fill(false);
    Restraints::of(problem, session).mechanism(&others).is_some()
}

/// Of the open multipliers those with the largest `force`, 1, 2, 4, ... of them: as many as it takes to hold every body.
/// **Collective**
pub fn few_that_hold(problem: &Discretisation, active: &[bool], force: impl Fn(usize) -> f64, session: &Session) -> Vec<usize> {
    let mut open: Vec<usize> = (0..active.len()).filter(|&i| !active[i]).collect();
    open.sort_by(|&a, &b| force(b).total_cmp(&force(a)));
    let (whole, mut count) = (Restraints::of(problem, session), 1);
    while count < open.len() {
        let mut closed = active.to_vec();
        open[..count].iter().for_each(|&i| closed[i] = true);
        if whole.mechanism(&closed).is_none() {
            break;
        }
        count *= 2;
    }
    open.truncate(count);
    open
}

/// Everything that holds bodies. Rigid motions are those of the undeformed bodies: a disc that is pressed flat rolls on.
struct Restraints<'a> {
    scene: &'a Scene,
    numbering: &'a Numbering,
    contacts: &'a [Contact],
    /// Rows of all multipliers, or at least of those of this rank.
    rows: &'a [Vec<Coupled>],
    /// All ranks with the owners of the multipliers; nothing if this rank has all rows.
    shared: Option<(&'a Session, &'a [usize])>,
}

impl<'a> Restraints<'a> {
    fn of(problem: &'a Discretisation, session: &'a Session) -> Self {
        Self {
            scene: &problem.scene,
            numbering: &problem.finest().numbering,
            contacts: &problem.contacts,
            rows: &problem.coupling.rows,
            shared: Some((session, &problem.coupling.owners)),
        }
    }

    /// What the closed multipliers of all contacts resist, the same on every rank. **Collective**
    fn touches(&self, extents: &[Extent], active: &[bool]) -> Vec<Touch> {
        let own: Vec<Touch> = self.contacts.iter().map(|contact| self.touch(contact, extents, active)).collect();
        match self.shared {
            Some((session, _)) => of_all_ranks(&own, session),
            None => own,
        }
    }

    /// **Collective**
    fn mechanism(&self, active: &[bool]) -> Option<Mechanism> {
        let extents = self.scene.extents();
        find_mechanism(&extents, &support_conditions(self.scene, &extents), &self.touches(&extents, active))
    }

    /// **Collective**
    fn not_held(&self, active: &[bool]) -> Option<String> {
        let extents = self.scene.extents();
        let touches = self.touches(&extents, active);
        let mechanism = find_mechanism(&extents, &support_conditions(self.scene, &extents), &touches)?;
        let by = if active.contains(&true) {
            "supports and contact do not hold it"
        } else {
            "contact is open everywhere and supports do not hold it"
        };
        let name = self.scene.mesh.name_of_piece(mechanism.piece);
        Some(format!("{name} can {}: {by}; {}", mechanism.motion, self.remedy(&mechanism, &extents, &touches)))
    }

    /// What the closed multipliers of a contact that are this rank's resist, by the normals of body 1 and by those of body 2.
    fn touch(&self, contact: &Contact, extents: &[Extent], active: &[bool]) -> Touch {
        let mesh = &self.scene.mesh;
        let normals = contact.pair.between.each_ref().map(|name| {
            let edges = mesh.boundary(name).map(|boundary| boundary.edges.as_slice()).unwrap_or(&[]);
            SmoothNormals::new(mesh, edges)
        });
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
        let mut pieces: Vec<usize> = of_side().map(|coupled| mesh.piece_beside(coupled.node.edge)).collect();
        pieces.sort_unstable();
        pieces.dedup();
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

    /// A support at one point that would hold the motion, on a named boundary without contact if there is one; rather such a
    /// one that leaves no other motion free.
    fn remedy(&self, mechanism: &Mechanism, extents: &[Extent], touches: &[Touch]) -> String {
        if let Some(tool) = self.scene.tool(self.scene.mesh.pieces[mechanism.piece].body) {
            return format!("prescribe ux, uy or angle of {}", tool.key);
        }
        let extent = &extents[mechanism.piece];
        let supports = support_conditions(self.scene, extents);
        let holds_all = |at: &SupportPoint| {
            let terms = [(at.point, Point::ith(at.axis, 1.0))];
            let with: Vec<Condition> = Condition::new(extents, mechanism.piece, None, &terms, 0.0).into_iter().collect();
            find_mechanism(extents, &[supports.as_slice(), &with].concat(), touches).is_none()
        };
        let mut candidates = self.support_points(mechanism, extent);
        candidates.sort_by(|a, b| (b.free, b.moves).partial_cmp(&(a.free, a.moves)).unwrap_or(std::cmp::Ordering::Equal));
        let Some(at) = candidates.iter().take(MOST_POINTS).find(|at| holds_all(at)).or(candidates.first()) else {
            return "hold it by a support at one of its points, at = [x, y] with ux or uy".into();
        };
        format!(
            "hold it, for example by a support with at = [{}, {}], body = \"{}\" and {} = 0, which is a point of \"{}\"",
            coordinate(at.point.x, extent.radius),
            coordinate(at.point.y, extent.radius),
            self.scene.bodies[self.scene.mesh.pieces[mechanism.piece].body].name,
            ["ux", "uy"][at.axis],
            at.boundary,
        )
    }

    /// Vertices on the named boundaries of a piece, with the axis in which they move most; some of each boundary.
    fn support_points(&self, mechanism: &Mechanism, extent: &Extent) -> Vec<SupportPoint<'_>> {
        let mesh = &self.scene.mesh;
        let touches = |name: &str| self.scene.pairs.iter().any(|pair| pair.between.iter().any(|side| side == name));
        let mut found = Vec::new();
        for boundary in mesh.physical_curves() {
            let own: Vec<u32> =
                boundary.edges.iter().copied().filter(|&edge| mesh.piece_beside(edge) == mechanism.piece).collect();
            for &edge in own.iter().step_by(own.len().div_ceil(POINTS).max(1)) {
                let point = mesh.vertices[mesh.edges[edge as usize].vertices[0] as usize];
                let u = mechanism.displacement(extent, point);
                // Rounded, so that the order does not hang on the last digit.
                let moves = (1e6 * u.amax()).round();
                found.push(SupportPoint {
                    free: !touches(&boundary.name),
                    moves,
                    boundary: &boundary.name,
                    point,
                    axis: u.iamax(),
                });
            }
        }
        found
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

/// A coordinate as the case wants it: so many digits that a vertex is known again.
fn coordinate(v: f64, large: f64) -> String {
    let unit = 10f64.powf(large.log10().floor() - 9.0);
    if v.abs() < unit { "0".into() } else { format!("{:.9e}", (v / unit).round() * unit).parse::<f64>().unwrap_or(v).to_string() }
}

/// Where a support might be.
struct SupportPoint<'a> {
    /// Whether no contact is there.
    free: bool,
    /// How far the point moves.
    moves: f64,
    boundary: &'a str,
    point: Point,
    axis: usize,
}

/// Everything that supports hold, at the macro vertices.
fn support_conditions(scene: &Scene, extents: &[Extent]) -> Vec<Condition> {
    let numbering = Numbering::new(Level { intervals: 1, order: Order::P1 }, &scene.partition);
    let normals = normal_supports(scene);
    let condition = |held: Held| {
        // A direction along the mean of two chords' normals stands for the normal of their arc.
        let smooth = normals.get(&held.vertex).map(|normal| normal * normal.dot(&held.direction).signum());
        let direction = smooth.filter(|normal| normal.dot(&held.direction) > ALIKE).unwrap_or(held.direction);
        Condition::new(extents, held.piece, None, &[(held.place, direction)], 0.0)
    };
    let free = scene.rigid.iter().filter(|set| set.free().next().is_some());
    let rigid = free.flat_map(|set| rigid_conditions(scene, set, extents));
    supported(scene, &numbering).into_iter().filter_map(condition).chain(rigid).chain(spring_conditions(scene, extents)).collect()
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

/// What springs resist at the macro vertices, however soft they are.
fn spring_conditions(scene: &Scene, extents: &[Extent]) -> Vec<Condition> {
    let mesh = &scene.mesh;
    let mut all = Vec::new();
    for springs in &scene.springs {
        let edges = springs.edges(mesh);
        let normals = mean_normals(mesh, &edges);
        for &edge in &edges {
            for vertex in mesh.edges[edge as usize].vertices {
                let place = mesh.vertices[vertex as usize];
                let held = springs.stiffness.at(place, normals[&vertex]).into_iter().filter(|(_, k)| *k > 0.0);
                let piece = mesh.piece_beside(edge);
                all.extend(held.filter_map(|(direction, _)| Condition::new(extents, piece, None, &[(place, direction)], 0.0)));
            }
        }
    }
    all
}

/// Smooth normals at the vertices of some edges.
fn mean_normals(mesh: &MacroMesh, edges: &[u32]) -> HashMap<u32, Point> {
    let smooth = SmoothNormals::new(mesh, edges);
    let mut normals = HashMap::new();
    for &edge in edges {
        for (vertex, t) in mesh.edges[edge as usize].vertices.into_iter().zip([0.0, 1.0]) {
            *normals.entry(vertex).or_insert_with(Point::zeros) += smooth.at(mesh, edge, t).normal;
        }
    }
    normals.values_mut().for_each(|normal: &mut Point| *normal = normal.normalize());
    normals
}

/// Smooth normals at the vertices that supports hold along the normal.
fn normal_supports(scene: &Scene) -> HashMap<u32, Point> {
    let mesh = &scene.mesh;
    let mut normals = HashMap::new();
    for support in scene.supports.iter().filter(|support| support.normal.is_some()) {
        let on = support.on.iter().filter_map(|name| mesh.boundary(name));
        let edges: Vec<u32> = on.flat_map(|boundary| boundary.edges.iter().copied()).collect();
        let smooth = SmoothNormals::new(mesh, &edges);
        for &edge in &edges {
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

/// Everything that supports prescribe at the macro vertices, and rigid sets that are not free in any component.
pub fn supported(scene: &Scene, numbering: &Numbering) -> Vec<Held> {
    let Ok(constraints) = Constraints::new(&scene.mesh, numbering, &scene.supports, &scene.means, &scene.rigid) else {
        return Vec::new();
    };
    let mut piece = vec![0; scene.mesh.vertices.len()];
    for triangle in &scene.mesh.triangles {
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
        for (k, axis) in [Point::new(1.0, 0.0), Point::new(0.0, 1.0)].into_iter().enumerate() {
            if constraint.fixed[k] {
                let direction = constraint.to_global(axis);
                all.push(Held { piece: piece[vertex], vertex: vertex as u32, place, direction, value: constraint.value[k] });
            }
        }
    }
    all
}
