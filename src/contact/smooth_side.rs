//! One side of a contact as a smooth curve through its nodes, undeformed and as it lies now.

use super::pair::{Configuration, GapChoice, Pair};
use super::side::Side;
use crate::element::Plane;
use crate::geometry::{Curve, Point, Spline, chord_lengths, cross, turn_right};
use crate::mesh::{EdgeNode, MacroMesh, Numbering, Stretch};

/// Cosine of the angle between normals up to which sides face each other.
const FACING: f64 = 0.7;

/// What lies deeper in a body than this share of a stretch belongs to another side of it.
const DEEP: f64 = 0.25;

/// Boundaries that are said to touch do so where they are drawn closer than this share of their length.
pub const APART: f64 = 6.4e-2;

/// Cosine of the angle between the outward normals of a place and of its foot (120 degrees) above which neither looks at the other:
/// points half-way between round bodies are told by their feet for a third of a right angle on either side.
const LOOKS_BACK: f64 = -0.5;

/// Sine of the angle to a right one up to which a side meets the axis of revolution as its own image.
const SQUARE: f64 = 1e-9;

/// Displacement of a boundary node.
pub type Displacement<'a> = &'a dyn Fn(EdgeNode) -> Point;

/// Gap between a node of one side and the other side.
#[derive(Clone, Copy, Debug)]
pub struct SideGaps {
    /// As the bodies lie (length; negative where they penetrate).
    pub now: f64,
    /// Before they were moved (length).
    pub at_rest: f64,
    /// Cosine of the angle between the normal of one side and that against the other.
    pub facing: f64,
    /// Whether it is farther than an edge from the ends of both sides, where corners press.
    pub is_inside: bool,
}

/// A smooth stretch of a body's boundary by its nodes on the finest level, from smaller to larger x (upwards if it is
/// vertical); a closed one counter-clockwise, its last node the first again. Its parameter is the undeformed length along
/// them, deformed or not.
#[derive(Clone)]
pub struct SmoothSide {
    /// Undeformed positions of the nodes on the smooth shape.
    pub places: Vec<Point>,
    /// Positions now.
    pub points: Vec<Point>,
    /// Parameters of the nodes.
    pub parameters: Vec<f64>,
    /// +1 if the body lies on the left of the curve, -1 if on the right.
    pub hand: f64,
    /// Length of an edge, in nodes.
    degree: usize,
    /// Smooth shape of the undeformed side as it is known: declared, straight, or a spline through the vertices of the mesh file.
    pub shape: Curve,
    undeformed: Curve,
    deformed: Curve,
    /// Whether it closes in itself.
    closed: bool,
    /// Where it lies apart from Γ_C, which has its shape: the way there (length).
    pub shift: Point,
    /// Whether Γ_C lies on this side, or on the other one, and has the normals of that; nothing if it lies between both.
    bears: Option<bool>,
    /// Whether its first and its last node are poles of a body of revolution: on the axis, which it meets at a right angle.
    poles: [bool; 2],
}

impl SmoothSide {
    /// The stretches of both sides of a pair.
    pub fn of_pair(mesh: &MacroMesh, numbering: &Numbering, pair: &Pair, displacement: Displacement) -> [Vec<Self>; 2] {
        [Side::First, Side::Second].map(|side| {
            let edges = mesh.edges_of(&pair.between[side as usize]);
            let bears = pair.curve.own_side().map(|own| own == side);
            let new = |stretch: &Stretch| Self { bears, ..Self::new(mesh, numbering, stretch, displacement) };
            mesh.stretches(edges).iter().map(new).collect()
        })
    }

    fn new(mesh: &MacroMesh, numbering: &Numbering, stretch: &Stretch, displacement: Displacement) -> Self {
        let mut nodes = nodes_along(mesh, numbering, &stretch.edges);
        let closed = mesh.is_closed(&stretch.edges);
        let ends = [nodes[0], nodes[nodes.len() - 1]].map(|node| node.place(mesh, numbering));
        let along = ends[1] - ends[0];
        let falls = match closed {
            true => turns_clockwise(nodes.iter().map(|node| node.place(mesh, numbering))),
            false => along.x < -1e-9 * along.norm() || (along.x <= 1e-9 * along.norm() && along.y < 0.0),
        };
        if falls {
            nodes.reverse();
        }
        let smooth = |node: &EdgeNode| {
            let place = node.place(mesh, numbering);
            let exact = stretch.curve.is_line() || mesh.edges[node.edge as usize].shape.is_some();
            if exact { place } else { stretch.curve.point(stretch.curve.nearest(place)) }
        };
        let places: Vec<Point> = nodes.iter().map(smooth).collect();
        let points: Vec<Point> = nodes.iter().zip(&places).map(|(&node, place)| place + displacement(node)).collect();
        let (hand, degree) = (if falls { -1.0 } else { 1.0 }, numbering.level.order.degree());
        let is_open_round = mesh.plane == Plane::Revolution && !closed;
        let slope = |x: Point| stretch.curve.tangent(stretch.curve.nearest(x)).y;
        let is_pole = |x: Point| is_open_round && x.x.abs() <= 1e-9 * along.norm() && slope(x).abs() <= SQUARE;
        let poles = if falls { [ends[1], ends[0]] } else { ends }.map(is_pole);
        Self { poles, ..Self::through(stretch.curve.clone(), places, points, hand, degree, closed) }
    }

    /// Through nodes at rest and as they lie now, with the shape as it is known.
    pub(super) fn through(
        shape: Curve,
        mut places: Vec<Point>,
        mut points: Vec<Point>,
        hand: f64,
        degree: usize,
        closed: bool,
    ) -> Self {
        let last = places.len() - 1;
        if closed {
            (places[last], points[last]) = (places[0], points[0]);
        }
        let parameters = chord_lengths(&places);
        let spline = |points: &[Point]| Curve::Spline(Spline::through(parameters.clone(), points, closed));
        let (undeformed, shift) = (spline(&places), Point::zeros());
        let deformed = if points == places { undeformed.clone() } else { spline(&points) };
        Self {
            places,
            points,
            parameters,
            hand,
            degree,
            shape,
            undeformed,
            deformed,
            closed,
            shift,
            bears: None,
            poles: [false; 2],
        }
    }

    /// The side begun at node `seam`, if it is closed, and with its shift from Γ_C (length).
    pub fn laid(&self, seam: usize, shift: Point) -> Self {
        let begun = if self.closed && seam > 0 { self.begun_at(seam) } else { self.clone() };
        Self { shift, bears: self.bears, ..begun }
    }

    fn begun_at(&self, node: usize) -> Self {
        let count = self.places.len() - 1;
        let turned = |points: &[Point]| (0..=count).map(|k| points[(node + k) % count]).collect::<Vec<_>>();
        Self::through(self.shape.clone(), turned(&self.places), turned(&self.points), self.hand, self.degree, self.closed)
    }

    /// Length of one turn in the parameter, if it closes in itself.
    pub fn turn(&self) -> Option<f64> {
        self.closed.then(|| self.length())
    }

    /// Number of its nodes, each counted once.
    pub fn nodes(&self) -> usize {
        self.places.len() - usize::from(self.closed)
    }

    /// Parameter of a node; on a closed side nodes count on beyond one turn, and so does the parameter.
    pub fn unrolled(&self, node: usize) -> f64 {
        let count = self.nodes();
        self.turn().map_or_else(|| self.parameters[node], |turn| self.parameters[node % count] + (node / count) as f64 * turn)
    }

    /// Nodes at which it meets the axis of revolution at a right angle: it goes on there as its own image.
    pub fn poles(&self) -> impl Iterator<Item = usize> {
        [0, self.places.len() - 1].into_iter().zip(self.poles).filter(|(_, is_pole)| *is_pole).map(|(node, _)| node)
    }

    /// Positions of the nodes in a configuration.
    pub fn positions(&self, configuration: Configuration) -> &[Point] {
        match configuration {
            Configuration::Reference => &self.places,
            Configuration::Deformed => &self.points,
        }
    }

    /// Length of the undeformed side.
    pub fn length(&self) -> f64 {
        self.parameters[self.parameters.len() - 1]
    }

    /// Parameter of the point nearest to `x` in a configuration; beyond the ends along the tangents, on a closed side within one
    /// turn from its first node.
    pub fn nearest(&self, x: Point, configuration: Configuration) -> f64 {
        let t = self.curve(configuration).nearest(x);
        self.turn().map_or(t, |turn| t.rem_euclid(turn))
    }

    /// Length of boundary that a node stands for, undeformed.
    pub fn weight(&self, node: usize) -> f64 {
        let last = self.parameters.len() - 1;
        let at = |k: usize| self.parameters[k.min(last)];
        // The last node of a closed side is its first.
        let before = if self.closed && node == 0 { self.length() - at(last - 1) } else { at(node) - at(node.saturating_sub(1)) };
        0.5 * (at(node + 1) - at(node) + before)
    }

    /// Longest edge that meets a range of nodes.
    pub fn edge_length(&self, first: usize, last: usize) -> f64 {
        let end = self.parameters.len() - 1;
        let [from, to] = [first.saturating_sub(self.degree), (last + self.degree).min(end)];
        (from..=to.saturating_sub(self.degree).max(from))
            .map(|k| self.parameters[(k + self.degree).min(end)] - self.parameters[k])
            .fold(0.0, f64::max)
    }

    /// Whether places of this side and of another, by their parameters, look at each other.
    pub fn looks_at(&self, parameter: f64, other: &Self, foot: f64, configuration: Configuration) -> bool {
        let [one, two] = [self.curve(configuration).tangent(parameter), other.curve(configuration).tangent(foot)];
        self.hand * other.hand * one.normalize().dot(&two.normalize()) <= LOOKS_BACK
    }

    /// The point of the undeformed side that is nearest to `x`, and the outward normal there.
    pub fn nearest_place(&self, x: Point) -> (Point, Point) {
        let t = self.nearest(x, Configuration::Reference).clamp(0.0, self.length());
        (self.undeformed.point(t), turn_right(self.undeformed.tangent(t)) * self.hand)
    }

    /// Displacement of what lies nearest to `x` now (length).
    pub fn moved(&self, x: Point) -> Point {
        let t = self.nearest(x, Configuration::Deformed).clamp(0.0, self.length());
        self.deformed.point(t) - self.undeformed.point(t)
    }

    /// The undeformed node nearest to `x`.
    pub fn nearest_node(&self, x: Point) -> usize {
        let away = |node: &usize| (self.places[*node] - x).norm_squared();
        (0..self.nodes()).min_by(|a, b| away(a).total_cmp(&away(b))).unwrap_or_default()
    }

    /// Whether a parameter is farther than an edge from both ends.
    fn is_inside(&self, t: f64) -> bool {
        let last = self.parameters.len() - 1;
        self.closed || t > self.parameters[self.degree.min(last)] && t < self.parameters[last.saturating_sub(self.degree)]
    }

    /// The side as a curve in a configuration.
    pub fn curve(&self, configuration: Configuration) -> &Curve {
        match configuration {
            Configuration::Reference => &self.undeformed,
            Configuration::Deformed => &self.deformed,
        }
    }

    /// Gap between one of the nodes and another side, as the pair declares it (length; negative where they penetrate);
    /// nothing if the node's foot lies beyond the ends of that side by more than `reach`, or if it belongs to another part
    /// of the body. On undeformed bodies it is the gap before loading and the normal part of the displacements, as in the
    /// contact law; on deformed ones the distance as they lie.
    pub fn gap(&self, node: usize, other: &Self, pair: &Pair, reach: f64) -> Option<f64> {
        self.gaps(node, other, pair, reach).map(|gaps| gaps.now)
    }

    /// Gaps where the sides face each other: elsewhere those along normals mean nothing.
    pub fn facing_gaps(&self, node: usize, other: &Self, pair: &Pair, reach: f64) -> Option<SideGaps> {
        self.gaps(node, other, pair, reach).filter(|gaps| gaps.facing > FACING)
    }

    /// Gaps between one of the nodes and another side, as [`SmoothSide::gap`] defines them, now and at rest (length), and how far the
    /// two sides face each other there.
    pub fn gaps(&self, node: usize, other: &Self, pair: &Pair, reach: f64) -> Option<SideGaps> {
        let configuration = pair.configuration;
        let x = self.positions(configuration)[node];
        let t = other.nearest(x, configuration).clamp(0.0, other.length());
        let curve = other.curve(configuration);
        let (foot, tangent) = (curve.point(t), curve.tangent(t));
        if (x - foot).dot(&tangent).abs() > reach {
            return None;
        }
        let outward = turn_right(tangent) * other.hand;
        let drawn = (x - foot).dot(&outward);
        if drawn < -DEEP * other.length() {
            return None;
        }
        // The normal of the contact law is that of the side on which Γ_C lies, or bisects those of both.
        let own_outward = turn_right(self.undeformed.tangent(self.parameters[node])) * self.hand;
        let moved = (self.points[node] - self.places[node]) - (other.deformed.point(t) - other.undeformed.point(t));
        let is_inside = self.is_inside(self.parameters[node]) && other.is_inside(t);
        let normal =
            self.bears.map_or_else(|| (outward - own_outward).normalize(), |bears| if bears { -own_outward } else { outward });
        let (opened, facing) = (moved.dot(&normal), -own_outward.dot(&outward));
        if configuration == Configuration::Deformed {
            return Some(SideGaps { now: drawn, at_rest: drawn - opened, facing, is_inside });
        }
        let initial = match &pair.gap {
            GapChoice::Closed if drawn.abs() <= APART * self.length().max(other.length()) => 0.0,
            GapChoice::Closed | GapChoice::Geometry => drawn,
            GapChoice::Formula(formula) => {
                let middle = 0.5 * (x + foot);
                formula.value(&[middle.x, middle.y])
            }
        };
        Some(SideGaps { now: initial + opened, at_rest: initial, facing, is_inside })
    }
}

/// Whether points go round clockwise.
fn turns_clockwise(points: impl Iterator<Item = Point>) -> bool {
    let points: Vec<Point> = points.collect();
    points.windows(2).map(|two| cross(two[0] - points[0], two[1] - points[0])).sum::<f64>() < 0.0
}

/// Nodes of a chain of edges on the finest level, in its order.
fn nodes_along(mesh: &MacroMesh, numbering: &Numbering, edges: &[u32]) -> Vec<EdgeNode> {
    let n = numbering.level.intervals as u32;
    let mut nodes = Vec::with_capacity(edges.len() * n as usize + 1);
    for (at, &edge) in edges.iter().enumerate() {
        let (triangle, side) = mesh.beside(edge);
        let forward = mesh.triangles[triangle as usize].forward[side];
        let along = (if at == 0 { 0 } else { 1 }..=n).map(|k| EdgeNode { edge, position: if forward { k } else { n - k } });
        nodes.extend(along);
    }
    nodes
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The last of 40 nodes of a circle is the first again, at angle 0: just before it the nearest place is no farther than just behind.
    #[test]
    fn the_nearest_place_of_a_closed_side_may_lie_on_either_side_of_its_seam() {
        let at = |degrees: f64, radius: f64| radius * Point::new(degrees.to_radians().cos(), degrees.to_radians().sin());
        let points: Vec<Point> = (0..=40).map(|k| at(9.0 * f64::from(k), 1.0)).collect();
        let circle = Curve::Circle { centre: [0.0, 0.0], radius: 1.0 };
        let side = SmoothSide::through(circle, points.clone(), points, 1.0, 1, true);
        for degrees in [-20.0, -4.0, -0.5, 0.0, 0.5, 4.0, 20.0] {
            let (place, _) = side.nearest_place(at(degrees, 1.1));
            assert!((place - at(degrees, 1.0)).norm() < 1e-4, "{degrees}: {place}");
        }
    }
}
