//! Supports at the nodes of one level: which displacement components are prescribed, in which frame.
//!
//! # Rows and frames
//!
//! A prescribed component keeps its row, with the diagonal of K and zeros elsewhere, on every level; its column goes to the
//! right-hand side, its columns in B and rows and columns in the interpolation are zero. So all levels have two unknowns per
//! node, PETSc sees 2 × 2 blocks, and the rigid scale of the diagonal fits.
//! Under an inclined support (`normal`) the unknowns of a node are its components along and across the normal: the node has a
//! *frame*. Stiffness, coupling, load and interpolation turn into the frames of their nodes where they are assembled, on coarse
//! levels too; `Field` turns back. Supports that hold two directions at a node fix it; contradictions are errors that name
//! both.

use super::Support;
use super::mean_hold::{Anchor, MeanHold};
use super::rigid::{MOTIONS, Motion, RigidSet};
use crate::element::Plane;
use crate::geometry::{AXES, Coordinates, Point, Rounded, cross};
use crate::mesh::{EdgeNode, MacroMesh, Numbering};
use nalgebra::Matrix2;
use std::collections::HashMap;

/// Directions closer than this (radians) are one direction.
pub(super) const SAME: f64 = 1e-6;

/// Outward normals that turn by less than this (radians, 20 degrees) at a node belong to one smooth boundary.
const SMOOTH: f64 = 20.0 * std::f64::consts::PI / 180.0;

/// Prescribed components of one node, in the frame `(axis, axis turned left)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Constraint {
    /// First axis of the frame, a unit vector; (1, 0) unless the support is inclined.
    pub axis: Point,
    /// Which components of the frame are prescribed.
    pub fixed: [bool; 2],
    /// Values of the fixed components (length).
    pub value: [f64; 2],
}

impl Constraint {
    /// Columns: the axes of the frame.
    pub fn frame(&self) -> Matrix2<f64> {
        Matrix2::new(self.axis.x, -self.axis.y, self.axis.y, self.axis.x)
    }

    /// A vector given in the frame, in global axes.
    pub fn to_global(&self, v: Point) -> Point {
        self.frame() * v
    }

    /// A vector given in global axes, in the frame.
    pub fn to_frame(&self, v: Point) -> Point {
        self.frame().transpose() * v
    }

    /// The vector in the frame with its prescribed components set to zero.
    pub fn free_part(&self, v: Point) -> Point {
        Point::new(if self.fixed[0] { 0.0 } else { v.x }, if self.fixed[1] { 0.0 } else { v.y })
    }

    /// The prescribed displacement in the frame.
    pub fn prescribed(&self) -> Point {
        Point::new(if self.fixed[0] { self.value[0] } else { 0.0 }, if self.fixed[1] { self.value[1] } else { 0.0 })
    }
}

impl Support {
    /// Straight edges on which it holds what is normal to them, and nothing else: a line of symmetry does that.
    pub fn mirrors<'m>(&'m self, mesh: &'m MacroMesh) -> impl Iterator<Item = u32> + 'm {
        let is_mirror = |edge: &u32| {
            let normal = mesh.edge_normal(*edge, 0.5);
            mesh.edges[*edge as usize].shape.is_none() && self.axes().all(|(_, axis)| cross(axis, normal).abs() <= SAME)
        };
        mesh.edges_on(&self.on).filter(is_mirror)
    }
}

/// What holds a node, by its name; shown as the key of the case.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub(super) enum HeldBy<'a> {
    #[error("support.{0}")]
    Support(&'a str),
    #[error("{0}")]
    Rigid(&'a str),
    #[error("the axis of revolution")]
    Axis,
}

/// One direction held at a node.
pub(super) struct Hold<'a> {
    pub by: HeldBy<'a>,
    pub direction: Point,
    value: f64,
}

/// Place and holds of each node that supports hold, by its number.
pub(super) type AllHolds<'a> = HashMap<usize, (Point, Vec<Hold<'a>>)>;

/// All constrained nodes of a level, by number; the same on every rank.
#[derive(Clone, Debug, Default)]
pub struct Constraints {
    nodes: HashMap<usize, Constraint>,
    /// Whether nodes from 0 on are among them, a bit for each: most are not, and are asked for often.
    among: Vec<u64>,
}

impl Constraints {
    /// Collects what all supports, anchors of mean motions, rigid sets and the axis of revolution say at the nodes of a level. Anchors are at rest, and rigid
    /// sets where the components of their motion that are prescribed put them; see [`Constraints::move_anchor`] and
    /// [`Constraints::move_rigidly`] for the others.
    ///
    /// # Errors
    /// Words, if two supports give different values to one component of one node, or a value is not finite, or a support
    /// holds a rigid set that is to move.
    pub fn new(
        mesh: &MacroMesh,
        numbering: &Numbering,
        supports: &[Support],
        means: &[MeanHold],
        rigid: &[RigidSet],
    ) -> Result<Self, String> {
        let mut holds = all_holds(mesh, numbering, supports)?;
        for hold in means {
            for anchor in &hold.anchors {
                let (_, known) = holds.entry(numbering.vertex(anchor.vertex)).or_insert((anchor.place, Vec::new()));
                add(known, HeldBy::Support(&hold.name), anchor.direction, 0.0, anchor.place)?;
            }
        }
        for set in rigid {
            hold_rigidly(mesh, numbering, set, &mut holds)?;
        }
        if mesh.plane == Plane::Revolution {
            hold_on_axis(mesh, numbering, &mut holds)?;
        }
        let nodes = holds.iter().map(|(&node, (x, holds))| Ok((node, combine(*x, holds)?)));
        let nodes = nodes.collect::<Result<HashMap<usize, Constraint>, String>>().map_err(|_| first_clash(&holds))?;
        let mut among = vec![0; nodes.keys().max().map_or(0, |last| last / 64 + 1)];
        nodes.keys().for_each(|&node| among[node / 64] |= 1 << (node % 64));
        Ok(Self { nodes, among })
    }

    /// Constraint of a node.
    #[inline]
    pub fn get(&self, node: usize) -> Option<&Constraint> {
        let bits = *self.among.get(node / 64)?;
        if bits >> (node % 64) & 1 == 1 { self.nodes.get(&node) } else { None }
    }

    /// Puts the nodes of a rigid set where a motion takes them.
    pub fn move_rigidly(&mut self, mesh: &MacroMesh, numbering: &Numbering, set: &RigidSet, motion: &Motion) {
        for (node, x) in set.places(mesh, numbering) {
            let u = set.displacement(motion, x);
            if let Some(constraint) = self.nodes.get_mut(&node) {
                constraint.value = constraint.to_frame(u).into();
            }
        }
    }

    /// Puts an anchor of a mean motion where a displacement takes it.
    pub fn move_anchor(&mut self, numbering: &Numbering, anchor: &Anchor, displacement: Point) {
        if let Some(constraint) = self.nodes.get_mut(&numbering.vertex(anchor.vertex)) {
            constraint.value = constraint.to_frame(displacement).into();
        }
    }

    /// All constrained nodes, in no order.
    pub fn iter(&self) -> impl Iterator<Item = (usize, &Constraint)> {
        self.nodes.iter().map(|(&node, constraint)| (node, constraint))
    }
}

/// The contradiction farthest to the left, and lowest there: the same on every rank, and in every run.
fn first_clash(holds: &AllHolds) -> String {
    let mut all: Vec<&(Point, Vec<Hold>)> = holds.values().collect();
    all.sort_by(|(a, _), (b, _)| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    let clash = all.into_iter().find_map(|(x, holds)| combine(*x, holds).err());
    clash.unwrap_or_else(|| "supports contradict each other".into())
}

/// Holds both components of every node of a rigid set, where its prescribed motion puts it.
fn hold_rigidly<'a>(mesh: &MacroMesh, numbering: &Numbering, set: &'a RigidSet, holds: &mut AllHolds<'a>) -> Result<(), String> {
    let motion = set.prescribed_motion();
    for (node, x) in set.places(mesh, numbering) {
        let (_, known) = holds.entry(node).or_insert((x, Vec::new()));
        for hold in known.iter() {
            let moves = |&k: &usize| set.mode(k, x).dot(&hold.direction).abs() > SAME * set.mode(k, x).norm();
            if let Some(k) = set.free().find(moves) {
                return Err(format!(
                    "{} holds a node at {} that {} is to move: prescribe its {}, or leave the support out there",
                    hold.by,
                    Coordinates(x),
                    set.key,
                    MOTIONS[k]
                ));
            }
        }
        let u = set.displacement(&motion, x);
        for (direction, value) in AXES.into_iter().zip([u.x, u.y]) {
            add(known, HeldBy::Rigid(&set.key), direction, value, x)?;
        }
    }
    Ok(())
}

/// Holds the nodes on the axis of revolution there: a ring without a radius has none to gain.
fn hold_on_axis(mesh: &MacroMesh, numbering: &Numbering, holds: &mut AllHolds) -> Result<(), String> {
    let inner = mesh.edges_on_axis().flat_map(|edge| EdgeNode::along(edge, numbering.level));
    let ends = (0..mesh.vertices.len() as u32).map(|vertex| (numbering.vertex(vertex), mesh.vertices[vertex as usize]));
    let of_ends = ends.filter(|(_, x)| x.x == 0.0);
    for (node, x) in inner.map(|node| (node.number(mesh, numbering), node.place(mesh, numbering))).chain(of_ends) {
        let (_, known) = holds.entry(node).or_insert((x, Vec::new()));
        add(known, HeldBy::Axis, Point::new(1.0, 0.0), 0.0, x)?;
    }
    Ok(())
}

/// What all supports say at the nodes of a level: the place of each, and the directions that are held there.
pub(super) fn all_holds<'a>(mesh: &MacroMesh, numbering: &Numbering, supports: &'a [Support]) -> Result<AllHolds<'a>, String> {
    let mut holds = AllHolds::new();
    for support in supports {
        if let Some(vertex) = support.at.as_ref().and_then(|spot| mesh.vertex_at(spot)) {
            let x = mesh.vertices[vertex as usize];
            let (_, known) = holds.entry(numbering.vertex(vertex)).or_insert((x, Vec::new()));
            collect_axes(support, x, known)?;
        }
        for node in mesh.edges_on(&support.on).flat_map(|edge| EdgeNode::along(edge, numbering.level)) {
            let x = node.place(mesh, numbering);
            let (_, known) = holds.entry(node.number(mesh, numbering)).or_insert((x, Vec::new()));
            collect_axes(support, x, known)?;
            if let Some(formula) = &support.normal {
                let normal = mesh.edge_normal(node.edge, node.fraction(mesh, numbering));
                add(known, HeldBy::Support(&support.name), normal, formula.value(&[x.x, x.y]), x)?;
            }
        }
    }
    Ok(holds)
}

/// Adds what a support says of both axes at a point.
fn collect_axes<'a>(support: &'a Support, x: Point, known: &mut Vec<Hold<'a>>) -> Result<(), String> {
    let mut axes = support.axes();
    axes.try_for_each(|(formula, axis)| add(known, HeldBy::Support(&support.name), axis, formula.value(&[x.x, x.y]), x))
}

/// Adds a hold; normals of one support that nearly agree at a node become their mean.
fn add<'a>(known: &mut Vec<Hold<'a>>, by: HeldBy<'a>, direction: Point, value: f64, x: Point) -> Result<(), String> {
    if !value.is_finite() {
        return Err(format!("{by}: its formula has no finite value at {}; correct the formula", Coordinates(x)));
    }
    let near = |hold: &&mut Hold| hold.by == by && hold.direction.dot(&direction) > SMOOTH.cos();
    match known.iter_mut().find(near) {
        Some(hold) => hold.direction = (hold.direction + direction).normalize(),
        None => known.push(Hold { by, direction, value }),
    }
    Ok(())
}

fn combine(x: Point, holds: &[Hold]) -> Result<Constraint, String> {
    let first = &holds[0];
    let second = holds.iter().find(|hold| cross(first.direction, hold.direction).abs() > SAME);
    let constraint = match second {
        None if first.direction.x == 0.0 => {
            Constraint { axis: Point::new(1.0, 0.0), fixed: [false, true], value: [0.0, first.value * first.direction.y] }
        }
        None => {
            let along = if first.direction.y == 0.0 { first.direction.x } else { 1.0 };
            Constraint { axis: first.direction * along, fixed: [true, false], value: [first.value * along, 0.0] }
        }
        Some(second) => {
            let (a, b) = (first.direction, second.direction);
            let inverse = 1.0 / cross(a, b);
            let u = Point::new(first.value * b.y - second.value * a.y, second.value * a.x - first.value * b.x) * inverse;
            Constraint { axis: Point::new(1.0, 0.0), fixed: [true, true], value: [u.x, u.y] }
        }
    };
    let u = constraint.to_global(constraint.prescribed());
    for hold in holds {
        let along = u.dot(&hold.direction);
        // Against the whole displacement: two supports that fix a node leave rounding of it in the direction of a third.
        if (along - hold.value).abs() > 1e-9 * (u.norm() + hold.value.abs()) {
            let says_of_it = |other: &&Hold| other.by != hold.by && other.direction.dot(&hold.direction).abs() > SAME;
            let mut others: Vec<_> = holds.iter().filter(says_of_it).map(|other| other.by.to_string()).collect();
            others.dedup();
            return Err(format!(
                "{} asks for displacement {} in direction ({:.6}, {:.6}) at {}, {} for {}; leave one of them out there",
                hold.by,
                Rounded(hold.value),
                hold.direction.x,
                hold.direction.y,
                Coordinates(x),
                others.join(" and "),
                Rounded(along)
            ));
        }
    }
    Ok(constraint)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn hold(name: &str, angle: f64, value: f64) -> Hold<'_> {
        Hold { by: HeldBy::Support(name), direction: Point::new(angle.cos(), angle.sin()), value }
    }

    #[test]
    fn two_directions_fix_the_node_wherever_they_point() {
        let holds = [hold("a", 0.3, 0.1), hold("b", 1.4, -0.2), hold("a", 0.3, 0.1)];
        let constraint = combine(Point::zeros(), &holds).expect("no contradiction");
        let u = constraint.to_global(constraint.prescribed());
        assert_eq!(constraint.fixed, [true, true]);
        assert!(holds.iter().all(|h| (u.dot(&h.direction) - h.value).abs() < 1e-15));
    }

    #[test]
    fn an_inclined_support_leaves_its_tangent_free() {
        let constraint = combine(Point::zeros(), &[hold("a", 0.7, 0.5)]).expect("one support");
        assert_eq!(constraint.fixed, [true, false]);
        let u = constraint.to_global(Point::new(0.5, 3.0));
        assert!((u.dot(&Point::new(0.7f64.cos(), 0.7f64.sin())) - 0.5).abs() < 1e-15);
        assert!((constraint.to_frame(u) - Point::new(0.5, 3.0)).norm() < 1e-15);
    }

    #[test]
    fn a_repeated_hold_agrees_but_for_rounding() {
        let (sin, cos) = 37f64.to_radians().sin_cos();
        let hold = |name, x, y, value| Hold { by: HeldBy::Support(name), direction: Point::new(x, y), value };
        for turn in [1.0, 1.0 + 1e-15] {
            let holds = [hold("wall", -cos, -sin, 0.0), hold("top", -sin, cos, -1e-3), hold("more", -cos * turn, -sin, 0.0)];
            assert_eq!(combine(Point::zeros(), &holds).expect("they agree").fixed, [true, true]);
        }
    }

    #[test]
    fn opposite_directions_are_one_direction() {
        let holds = [hold("a", 0.0, 0.25), Hold { by: HeldBy::Support("b"), direction: Point::new(-1.0, 0.0), value: -0.25 }];
        assert_eq!(combine(Point::zeros(), &holds).expect("they agree").fixed, [true, false]);
    }

    #[test]
    fn a_contradiction_names_both_supports() {
        let words = combine(Point::new(1.0, 2.0), &[hold("wall", 0.0, 0.0), hold("pull", 0.0, 0.1)]).unwrap_err();
        assert!(words.contains("support.wall") && words.contains("support.pull") && words.contains("(1, 2)"), "{words}");
    }
}
