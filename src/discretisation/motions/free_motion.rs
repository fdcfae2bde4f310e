//! A rigid motion that nothing holds: what drives it, what would stop it, and what would hold it.

use crate::body::{Applied, HeldMode, MOTIONS, Motion, RigidNodes, RigidSet, UNIT_MOTIONS, applied_forces, rigid_displacement};
use crate::contact::{Condition, Extent, Mechanism, Touch, find_mechanism, tidy};
use crate::discretisation::scene::Scene;
use crate::element::{Order, Plane};
use crate::geometry::Point;
use crate::mesh::{Level, Numbering};
use std::collections::HashMap;

/// Points of a boundary that are proposed for a support.
const POINTS: usize = 8;

/// Points that are tried, whether a support there would hold all.
const MOST_POINTS: usize = 32;

/// Work of the loads in a motion, as a share of their sizes times the ways of their points, that is none: as much as polygons make
/// of round bodies.
const NOTHING: f64 = 1e-2;

/// Share of a motion that goes along the normals of a contact which stops it.
const STOPS: f64 = 0.5;

/// Share of the largest component of a motion from which another one holds it as well.
const AS_LARGE: f64 = 0.5;

/// Share of a shift across an axis, and of a turn beside it, below which it goes along that axis: as much as polygons make of round
/// bodies.
const ALONG: f64 = 1e-3;

/// A motion of one piece that nothing holds.
pub struct FreeMotion<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// The motion.
    pub mechanism: &'a Mechanism,
    /// All pieces.
    pub extents: &'a [Extent],
    /// What supports resist.
    pub supports: &'a [Condition],
}

impl FreeMotion<'_> {
    /// A support that would hold the motion: rather such a one that leaves no other motion free. The mean of a body that nothing
    /// drives and no support holds; else one point, on a named boundary without contact if there is one.
    pub fn remedy(&self, touches: &[Touch]) -> String {
        // A plate takes all of the body with it, and a mean would hold the same motion twice.
        if let Some(set) = self.scene.rigid.iter().find(|set| self.moves(set) && set.free().next().is_some()) {
            return format!("prescribe ux, uy or angle of {}", set.key);
        }
        if let Some(words) = self.mean_hold(touches) {
            return words;
        }
        let extent = &self.extents[self.mechanism.piece];
        let holds_all = |at: &SupportPoint| self.is_held_by([vec![(at.point, Point::ith(at.axis, 1.0))]].into_iter(), touches);
        let mut candidates = self.support_points(extent);
        candidates.sort_by(|a, b| (b.free, b.moves).partial_cmp(&(a.free, a.moves)).unwrap_or(std::cmp::Ordering::Equal));
        let Some(at) = candidates.iter().take(MOST_POINTS).find(|at| holds_all(at)).or(candidates.first()) else {
            return "hold it by a support at one of its points, at = [x, y] with ux or uy".into();
        };
        format!(
            "hold it, for example by a support with at = [{}, {}], body = \"{}\" and {} = 0, which is a point of \"{}\"",
            coordinate(at.point.x, extent.radius),
            coordinate(at.point.y, extent.radius),
            self.scene.bodies[self.body()].name,
            ["ux", "uy"][at.axis],
            at.boundary,
        )
    }

    /// Keys that hold the mean shift of the piece if the motion is mainly a shift, along no axis: around the centre of the motion, as of a
    /// roller between two rings, or in its direction, as of a disc on an incline; a coordinate alone would hold it across, too.
    pub fn slanted_shift(&self) -> Option<[String; 2]> {
        let (shift, turn) = self.mechanism.moves;
        let Extent { middle, radius } = self.extents[self.mechanism.piece];
        let (size, turned) = (shift.norm(), (turn * radius).abs());
        if shift.amin() <= ALONG * shift.amax() || turned > size {
            return None;
        }
        let numbers = |v: Point, large: f64| format!("[{}, {}]", tidy(v.x, large), tidy(v.y, large));
        if turned <= ALONG * size {
            return Some([format!("direction = {}", numbers(shift / size, 1.0)), "along = 0.0".into()]);
        }
        let arm = Point::new(-shift.y, shift.x) / turn;
        Some([format!("about = {}", numbers(middle + arm, arm.norm())), "tangential = 0.0".into()])
    }

    /// The contact that the loads drive the piece against, by the normals of both bodies.
    pub fn stopped_by(&self, touches: &[Touch]) -> Option<usize> {
        let Mechanism { piece, moves: (shift, turn), .. } = *self.mechanism;
        let work = self.work();
        let motion = [shift.x, shift.y, turn * self.extents[piece].radius].map(|v| v * work.signum());
        let most = STOPS * motion.iter().map(|v| v * v).sum::<f64>().sqrt();
        let closes = |condition: &Condition| {
            let of = |own: Option<usize>, sees: &[f64; 3]| {
                if own == Some(piece) { (0..3).map(|k| sees[k] * motion[k]).sum() } else { 0.0 }
            };
            of(Some(condition.piece), &condition.sees[0]) + of(condition.against, &condition.sees[1]) > most
        };
        let stops = |touch: &Touch| touch.iter().all(|own| own.iter().any(closes));
        if self.is_driven() { touches.iter().position(stops) } else { None }
    }

    /// Whether loads do work in the motion.
    pub fn is_driven(&self) -> bool {
        self.work().abs() > NOTHING
    }

    /// The hold of a mean motion, in words; nothing if the body has other supports, or is of several pieces, or if loads drive it.
    fn mean_hold(&self, touches: &[Touch]) -> Option<String> {
        let Mechanism { piece, moves: (shift, turn), .. } = *self.mechanism;
        let (mesh, name) = (&self.scene.mesh, &self.scene.bodies[self.body()].name);
        let before = self.scene.means.iter().find(|hold| hold.body == *name);
        let held = UNIT_MOTIONS.map(|mode| before.is_some_and(|hold| hold.held.iter().any(|held| held.mode == mode)));
        // A body of revolution neither shifts across its axis nor turns.
        let by_itself = if mesh.plane == Plane::Revolution { 2 } else { 0 };
        let count = by_itself + before.map_or(0, |hold| hold.held.len());
        let others = self.supports.iter().filter(|condition| condition.piece == piece).count() > count;
        let is_whole = mesh.pieces.iter().filter(|own| own.body == self.body()).count() == 1;
        if others || !is_whole || self.is_driven() {
            return None;
        }
        let Extent { middle, radius } = self.extents[piece];
        let slanted = self.slanted_shift().filter(|_| before.is_none_or(|hold| hold.held.iter().all(HeldMode::is_turn)));
        let shifts = if slanted.is_some() { Vec::new() } else { vec![0, 1] };
        let unit = |k: usize| (format!("{} = 0.0", MOTIONS[k]), UNIT_MOTIONS[k]);
        let slanted = slanted.map(|keys| (keys.join(" and "), [shift.x, shift.y, 0.0]));
        let modes: Vec<(String, Motion)> = shifts.into_iter().chain([2]).filter(|&k| !held[k]).map(unit).chain(slanted).collect();
        let size = |k: usize| {
            let of_mode = modes[k].1;
            (of_mode[0] * shift.x + of_mode[1] * shift.y).abs() + (of_mode[2] * turn).abs() * radius
        };
        let largest = (0..modes.len()).map(size).fold(0.0, f64::max);
        let mut able: Vec<usize> = (0..modes.len()).filter(|&k| size(k) >= AS_LARGE * largest).collect();
        able.sort_by(|a, b| size(*b).total_cmp(&size(*a)));
        let arms = [Point::new(radius, 0.0), Point::new(0.0, radius)].map(|arm| [arm, -arm]);
        let places = || arms.as_flattened().iter().map(|arm| middle + arm);
        let terms = |k: &usize| places().map(|x| (x, rigid_displacement(middle, &modes[*k].1, x))).collect::<Vec<_>>();
        let holds = |some: &[usize]| self.is_held_by(some.iter().map(terms), touches);
        // One mode that holds all, or as many as it takes.
        let one = able.iter().copied().find(|&k| holds(&[k]));
        let mut some = vec![one.or(able.first().copied())?];
        for k in 0..modes.len() {
            if !some.contains(&k) && !holds(&some) {
                some.push(k);
            }
        }
        if !holds(&some) {
            some.truncate(1);
        }
        let keys = some.iter().map(|&k| modes[k].0.as_str()).collect::<Vec<_>>().join(" and ");
        Some(match before {
            Some(hold) => format!("no load of its own drives that: hold it by {keys} in support.{}, too", hold.name),
            None => format!(
                "no load of its own drives that: hold its mean, for example by a support with mean = true, body = \"{name}\" and {keys}"
            ),
        })
    }

    fn body(&self) -> usize {
        self.scene.mesh.pieces[self.mechanism.piece].body
    }

    /// Whether all is held if these groups of points of the piece are, too, each point along a direction, in the mean of its group.
    fn is_held_by(&self, groups: impl Iterator<Item = Vec<(Point, Point)>>, touches: &[Touch]) -> bool {
        let condition = |terms: Vec<(Point, Point)>| Condition::new(self.extents, self.mechanism.piece, None, &terms, 0.0);
        let with: Vec<Condition> = groups.filter_map(condition).collect();
        find_mechanism(self.extents, &[self.supports, &with].concat(), touches).is_none()
    }

    /// Work of the loads on the piece in the motion, as a share of their sizes times the ways of their points.
    fn work(&self) -> f64 {
        let Scene { mesh, partition, rigid, loads, point_loads, .. } = self.scene;
        let extent = &self.extents[self.mechanism.piece];
        let moved = |x: Point| self.mechanism.displacement(extent, x);
        let (mut work, mut size) = (0.0, 0.0);
        let mut add = |force: Point, way: Point| {
            work += force.dot(&way);
            size += force.norm() * way.norm();
        };
        let numbering = Numbering::new(Level { intervals: 1, order: Order::P1 }, partition);
        let own = mesh.triangles.iter().filter(|triangle| triangle.piece as usize == self.mechanism.piece);
        let places: HashMap<usize, Point> =
            own.flat_map(|own| own.vertices).map(|vertex| (numbering.vertex(vertex), mesh.vertices[vertex as usize])).collect();
        let applied = Applied { parts: &self.scene.parts(), loads, point_loads };
        for rank in 0..partition.size() {
            // A load without a value is an error elsewhere.
            let _ = applied_forces(mesh, partition, rank, &numbering, &applied, |node, force| {
                places.get(&node).into_iter().for_each(|&x| add(force, moved(x)));
            });
        }
        for set in rigid.iter().filter(|set| self.moves(set)) {
            let [x, y, moment] = set.applied;
            add(Point::new(x, y), moved(set.about));
            add(Point::new(moment / extent.radius, 0.0), Point::new(self.mechanism.moves.1 * extent.radius, 0.0));
        }
        if size > 0.0 { work / size } else { 0.0 }
    }

    /// Whether a rigid set is the body that moves, or a plate on the piece.
    fn moves(&self, set: &RigidSet) -> bool {
        let mesh = &self.scene.mesh;
        match &set.nodes {
            RigidNodes::Body(name) => *name == mesh.bodies[self.body()],
            RigidNodes::Boundaries(_) => set.edges(mesh).iter().any(|&edge| mesh.piece_beside(edge) == self.mechanism.piece),
        }
    }

    /// Vertices on the named boundaries of a piece, with the axis in which they move most; some of each boundary.
    fn support_points(&self, extent: &Extent) -> Vec<SupportPoint<'_>> {
        let mesh = &self.scene.mesh;
        let touches = |name: &str| self.scene.pairs.iter().any(|pair| pair.between.iter().any(|side| side == name));
        let mut found = Vec::new();
        for boundary in mesh.physical_curves() {
            let is_own = |edge: &u32| mesh.piece_beside(*edge) == self.mechanism.piece;
            let own: Vec<u32> = boundary.edges.iter().copied().filter(is_own).collect();
            for &edge in own.iter().step_by(own.len().div_ceil(POINTS).max(1)) {
                let point = mesh.vertices[mesh.edges[edge as usize].vertices[0] as usize];
                let u = self.mechanism.displacement(extent, point);
                // Rounded, so that the order does not hang on the last digit.
                let moves = (1e6 * u.amax()).round();
                let (free, axis) = (!touches(&boundary.name), u.iamax());
                found.push(SupportPoint { free, moves, boundary: &boundary.name, point, axis });
            }
        }
        found
    }
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
