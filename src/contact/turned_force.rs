//! How the force of a contact turns and moves with bodies that have rolled, slid or turned.

use super::contact_boundary::ContactBoundary;
use super::finite_motion::{feet, pressed_places};
use super::multiplier::Multipliers;
use super::pair::Configuration;
use super::smooth_side::SmoothSide;
use crate::geometry::{Curve, Point, cross, turn_right};
use nalgebra::{Matrix3, Rotation2, Vector3};

/// A side that turns by less than this over what presses (radians) is flat: the other one may press anywhere on it.
const FLAT: f64 = 1e-6;

/// Forces and moments of a contact (per thickness) about a point.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TurnedForce {
    /// `∫λ ds`.
    pub force: f64,
    /// The point: the middle of what presses.
    pub middle: Point,
    /// `∫λ w wᵀ ds` by the force and moment `w` of the normals: what it resists of shifts, and of turns about the point.
    pub resistance: Matrix3<f64>,
    /// Force and moment on each body where it presses on the displaced sides, less those on Γ_C.
    pub turned: [Vector3<f64>; 2],
}

/// Integrates over the segments that press. Without `sides`, as on boundaries that follow the deformed bodies, forces keep to Γ_C.
pub fn turned_force(
    sides: Option<[&SmoothSide; 2]>,
    boundary: &ContactBoundary,
    multipliers: &Multipliers,
    lambda: &[f64],
) -> TurnedForce {
    let (points, _) = pressed_places(boundary, multipliers, lambda);
    let force: f64 = points.iter().map(|[_, weight, _]| weight).sum();
    if force == 0.0 {
        return TurnedForce::default();
    }
    let middle = points.iter().map(|&[t, weight, _]| weight / force * boundary.point(t)).sum();
    let pressed = sides.and_then(|sides| PressedSides::new(sides, boundary, &points));
    let (mut resistance, mut turned) = (Matrix3::zeros(), [Vector3::zeros(); 2]);
    for (at, &[t, weight, _]) in points.iter().enumerate() {
        let (x, normal) = (boundary.point(t), boundary.normal(t));
        let before = wrench(normal, x - middle);
        let Some((common, moved)) = pressed.as_ref().map(|sides| sides.displaced(at, normal)) else {
            resistance += weight * before * before.transpose();
            continue;
        };
        // What the sides have in common resists: on a flat one a force that moves along it goes on in the same direction.
        let after = wrench(common, x - middle);
        resistance += weight * after * after.transpose();
        // Contact pushes body 1 against the normal.
        for ((turned, sign), moved) in turned.iter_mut().zip([-1.0, 1.0]).zip(moved) {
            *turned += sign * weight * (wrench(common, x + moved - middle) - before);
        }
    }
    TurnedForce { force, middle, resistance, turned }
}

/// A force with its moment by an arm.
pub fn wrench(force: Point, arm: Point) -> Vector3<f64> {
    Vector3::new(force.x, force.y, cross(arm, force))
}

/// An undeformed side that has moved as it does in the mean where it presses: within a contact deformed sides lie on each other, and have
/// one normal wherever they have moved to.
struct RigidSide<'a> {
    curve: &'a Curve,
    about: Point,
    shift: Point,
    turn: Rotation2<f64>,
}

impl RigidSide<'_> {
    /// A place of the undeformed side.
    fn moved(&self, x: Point) -> Point {
        self.about + self.shift + self.turn * (x - self.about)
    }

    /// The normal at a parameter that points as this one does.
    fn facing(&self, at: f64, normal: Point) -> Point {
        self.turn * facing(self.curve, at, self.turn.inverse() * normal)
    }

    /// The parameter that is nearest to a place.
    fn nearest(&self, x: Point) -> f64 {
        self.curve.nearest(self.about + self.turn.inverse() * (x - self.about - self.shift))
    }
}

/// Both sides where they press.
struct PressedSides<'a> {
    /// Parameters of the places of both that correspond to each point of Γ_C.
    feet: Vec<[f64; 2]>,
    moved: [RigidSide<'a>; 2],
    /// Share of each side's normal in the one that both have in common.
    shares: [f64; 2],
    /// The side that is bent more, and its radius, with the sign of the normal from its centre.
    round: Option<(usize, f64)>,
    /// From the first point that presses to the last (length).
    length: f64,
}

impl<'a> PressedSides<'a> {
    /// Sides that are tilted to each other press elsewhere, until they are parallel: a flat one has its normal there, too. Of two round
    /// ones it turns as far as each is curved, and of such as fit each other by half. Nothing without points.
    fn new(sides: [&'a SmoothSide; 2], boundary: &ContactBoundary, points: &[[f64; 3]]) -> Option<Self> {
        let all: Option<Vec<[f64; 2]>> =
            points.iter().map(|&[t, ..]| feet(sides, boundary.point(t), boundary.normal(t))).collect();
        let (all, normal) = (all?, boundary.normal(points.first()?[0]));
        let force: f64 = points.iter().map(|[_, weight, _]| weight).sum();
        let moved = [0, 1].map(|k| {
            let [curve, after] = [Configuration::Reference, Configuration::Deformed].map(|which| sides[k].curve(which));
            let pressed = || points.iter().zip(&all).map(|([_, weight, _], feet)| (*weight / force, feet[k]));
            let about: Point = pressed().map(|(share, foot)| share * curve.point(foot)).sum();
            let shift = pressed().map(|(share, foot)| share * after.point(foot)).sum::<Point>() - about;
            let tilt = |foot: f64| {
                let [from, to] = [curve, after].map(|curve| curve.tangent(foot));
                cross(from, to).atan2(from.dot(&to))
            };
            let turn = Rotation2::new(pressed().map(|(share, foot)| share * tilt(foot)).sum());
            RigidSide { curve, about, shift, turn }
        });
        let ends = [all[0], all[all.len() - 1]];
        let bent = [0, 1].map(|k| {
            let curve = sides[k].curve(Configuration::Reference);
            let [[a, x], [b, y]] = ends.map(|feet| [facing(curve, feet[k], normal), curve.point(feet[k])]);
            (cross(a, b).atan2(a.dot(&b)), y - x, a + b)
        });
        let [a, b] = bent.map(|(angle, ..)| angle.abs());
        let shares = if a + b > FLAT { [b / (a + b), a / (a + b)] } else { [0.5; 2] };
        let side = usize::from(b > a);
        let (angle, chord, normals) = bent[side];
        let round = (angle.abs() > FLAT).then(|| (side, cross(normals.normalize(), chord) / angle));
        Some(Self { feet: all, moved, shares, round, length: chord.norm() })
    }

    /// Normal that the displaced sides have in common where a point of Γ_C presses, and how far from the places of each body that have been
    /// in contact there. Flat sides press where they did.
    fn displaced(&self, at: usize, normal: Point) -> (Point, [Point; 2]) {
        let feet = self.feet[at];
        let places = [0, 1].map(|k| self.moved[k].moved(self.moved[k].curve.point(feet[k])));
        let place = 0.5 * (places[0] + places[1]);
        let angle = |k: usize| {
            let own = self.moved[k].facing(self.moved[k].nearest(place), normal);
            cross(normal, own).atan2(normal.dot(&own))
        };
        let common = Rotation2::new(self.shares[0] * angle(0) + self.shares[1] * angle(1)) * normal;
        let Some((side, radius)) = self.round else { return (common, [Point::zeros(); 2]) };
        let way = radius * (common - self.moved[side].facing(feet[side], normal));
        let there = places[side] + way * (self.length / way.norm()).min(1.0);
        (common, places.map(|place| there - place))
    }
}

/// The normal of a side that points as this one does.
fn facing(curve: &Curve, at: f64, normal: Point) -> Point {
    let own = turn_right(curve.tangent(at));
    own * own.dot(&normal).signum()
}
