//! Points half-way between two sides, from which the curve between them is made.

use crate::contact::pair::Pair;
use crate::contact::smooth_side::SmoothSide;
use crate::geometry::{Curve, Point, turn_right};
use std::ops::Range;

/// Share of the curve by which a foot goes along its side in one correction at most: the normal of a curve that is not half-way yet may
/// meet a round body on its far side.
const NEAR_BY: f64 = 0.1;

/// Places along a side between which its points are taken, at least: long edges, of a coarse mesh or beside short ones, leave spans of
/// the curve without data otherwise.
const PLACES: usize = 16;

/// Share of the length of the data by which a foot may lie beyond the end of a side, and the curve go on to such an end.
pub const BEYOND: f64 = 1e-3;

/// A point half-way between two sides.
#[derive(Clone, Copy, Debug)]
pub struct Halfway {
    /// Parameter of the curve: that of the first side.
    pub parameter: f64,
    /// Parameters of the points of both sides that it lies between.
    pub feet: [f64; 2],
    /// Position of the point.
    pub place: Point,
    /// Length of boundary that it stands for.
    pub weight: f64,
    /// Whether the normal of the curve there meets both sides near its feet; the curve is no better than a guess where it does not.
    pub is_between: bool,
}

impl Halfway {
    /// Moves it to the middle between the sides, along the normal of a curve that is nearly half-way, with the parameter of the point
    /// of the first side that this normal meets; `whole` is the length of the curve. Returns by how much it is moved (length).
    /// Feet of the nodes of one side and of the other are not alike where the sides part: a fit to both would turn at its ends.
    pub fn centre(&mut self, curve: &Curve, sides: [&Curve; 2], whole: f64) -> f64 {
        let before = self.place;
        let (x, normal) = (curve.point(self.parameter), turn_right(curve.tangent(self.parameter)));
        let hits = [0, 1].map(|k| sides[k].hit_from(self.feet[k], x, normal));
        let near = |hit: f64, foot: f64| (hit - foot).abs() <= NEAR_BY * whole;
        self.is_between = hits.iter().zip(&self.feet).all(|(hit, foot)| hit.is_some_and(|hit| near(hit, *foot)));
        if let ([Some(first), Some(second)], true) = (hits, self.is_between) {
            self.feet = [first, second];
            self.parameter = first;
            let away = [0, 1].map(|k| (sides[k].point(self.feet[k]) - x).dot(&normal));
            self.place = x + 0.5 * (away[0] + away[1]) * normal;
        }
        (self.place - before).norm()
    }
}

/// The smallest and the largest parameter of the points that lie between the sides.
pub fn parameters_between(points: &[Halfway]) -> [f64; 2] {
    let between = points.iter().filter(|point| point.is_between).map(|point| point.parameter);
    between.fold([f64::INFINITY, f64::NEG_INFINITY], |[first, last], t| [first.min(t), last.max(t)])
}

/// Sorts points by their parameters.
pub fn sort(points: &mut [Halfway]) {
    points.sort_by(|a, b| a.parameter.total_cmp(&b.parameter));
}

/// Points half-way between the nodes of each side, and places between few of them, and their feet on the other side, where there is
/// one that looks back.
pub fn halfway(sides: [&SmoothSide; 2], nodes: &[Range<usize>; 2], pair: &Pair) -> Vec<Halfway> {
    let configuration = pair.configuration;
    let mut points = Vec::new();
    for (k, nodes) in nodes.iter().enumerate() {
        let (side, other) = (sides[k], sides[1 - k]);
        let (curve, other_curve) = (side.curve(configuration), other.curve(configuration));
        if nodes.is_empty() {
            continue;
        }
        let last = side.parameters.len() - 1;
        let whole = side.parameters[(nodes.end - 1).min(last)] - side.parameters[nodes.start];
        // Between two bodies that end at one line of symmetry, the normal at the end of one may just miss the other.
        let (longest, least) = (whole / PLACES as f64, (1e-9 * other.length()).max(BEYOND * whole));
        let parts = |node: usize| match nodes.contains(&(node + 1)) {
            true => ((side.parameters[node + 1] - side.parameters[node]) / longest).ceil().max(1.0) as usize,
            false => 1,
        };
        for (node, step, between) in nodes.clone().flat_map(|node| (0..parts(node)).map(move |step| (node, step, parts(node)))) {
            let next = (node + 1).min(last);
            let share = step as f64 / between as f64;
            let t = side.parameters[node] + share * (side.parameters[next] - side.parameters[node]);
            let x = if step == 0 { side.positions(configuration)[node] } else { curve.point(t) };
            let foot = other.nearest(x, configuration);
            let misses = other.turn().is_none() && (foot < -least || foot > other.length() + least);
            if misses || !side.looks_at(t, other, foot, configuration) {
                continue;
            }
            let feet = if k == 0 { [t, foot] } else { [foot, t] };
            let (place, weight) = (0.5 * (x + other_curve.point(foot)), side.weight(node) / between as f64);
            points.push(Halfway { parameter: feet[0], feet, place, weight, is_between: true });
        }
    }
    points
}
