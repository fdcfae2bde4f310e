//! Assemblies drawn by lot: bodies that have been dropped, one after the other, each onto two supports, between two walls;
//! and rollers between two plates.

use super::round::{Round, direction, dot, minus};
use super::statics::Finding;
use crate::draw::Lot;
use std::f64::consts::PI;

/// A body that moves.
#[derive(Clone, Debug)]
pub struct Member {
    pub shape: Shape,
    pub rigid: bool,
    /// Whether its mean turn is held.
    pub upright: bool,
    /// Whether its mean motion along x is held.
    pub guided: bool,
    /// Force on it, its weight among it.
    pub load: [f64; 2],
}

#[derive(Clone, Copy, Debug)]
pub enum Shape {
    /// Drawn smaller than it is by a clearance, or larger where that is negative.
    Round { round: Round, clearance: f64 },
    /// A plate, 2 `half` wide and `depth` high, by the middle of its lower side; a load acts in the middle of the upper one.
    Plate { middle: [f64; 2], half: f64, depth: f64 },
}

/// A wall: bodies lie on the left of it, seen along its direction.
#[derive(Clone, Copy, Debug)]
pub struct Wall {
    pub from: [f64; 2],
    pub to: [f64; 2],
    pub rigid: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    Wall(usize),
    Member(usize),
}

/// Two sides that touch, or nearly; the normal points from the first one to the second.
#[derive(Clone, Copy, Debug)]
pub struct Touch {
    pub pair: [Side; 2],
    pub at: [f64; 2],
    pub normal: [f64; 2],
}

/// The physics. Lengths are of the order of 1, times `scale`; stresses are times `young`.
#[derive(Clone, Debug)]
pub struct Assembly {
    pub members: Vec<Member>,
    pub walls: Vec<Wall>,
    pub touches: Vec<Touch>,
    pub scale: f64,
    pub young: f64,
}

/// Bodies that are closer than this, and do not lie on each other, are dropped again.
const CLEAR: f64 = 0.03;

impl Wall {
    fn along(&self) -> [f64; 2] {
        let [x, y] = minus(self.to, self.from);
        let length = x.hypot(y);
        [x / length, y / length]
    }

    pub fn inward(&self) -> [f64; 2] {
        let [x, y] = self.along();
        [-y, x]
    }
}

/// Draws an assembly.
pub fn draw(lot: &mut Lot) -> Assembly {
    let mut assembly = if lot.chance(0.2) { rollers(lot) } else { pile(lot) };
    assembly.scale = lot.one(&[1e-3, 1.0, 1.0, 25.0]);
    assembly.young = lot.one(&[1.0, 1e3, 2.1e5, 2.1e11]);
    let mut spoilt = assembly.clone();
    spoil(&mut spoilt, lot);
    if spoilt.statics().is_clear() { spoilt } else { assembly }
}

/// Now and then something is missing: a hold, a support, or loads push aside.
fn spoil(assembly: &mut Assembly, lot: &mut Lot) {
    let last = assembly.members.len() - 1;
    let kind = lot.between(0.0, 1.0);
    if kind < 0.08 {
        let which = (lot.between(0.0, 1.0) * (last + 1) as f64) as usize;
        assembly.members[which].upright &= assembly.members[which].rigid;
    } else if kind < 0.14 {
        assembly.touches.pop();
    } else if kind < 0.3 {
        for member in &mut assembly.members {
            let push = lot.between(-0.25, 0.25) * member.load[1];
            member.load[0] += if member.guided { 0.0 } else { push };
        }
    }
}

/// Bodies between two walls that meet at the origin; what they weigh presses them by some thousandths at most.
fn pile(lot: &mut Lot) -> Assembly {
    let count = lot.factor(2.0, 30.99) as usize;
    let (left, right) = (lot.between(95.0, 155.0f64).to_radians(), lot.between(4.0, 70.0f64).to_radians());
    let length = 4.0 + 3.0 * (count as f64).sqrt();
    let end = |angle: f64| direction(angle).map(|x| length * x);
    let rigid = lot.chance(0.6);
    let walls = vec![Wall { from: end(left), to: [0.0; 2], rigid }, Wall { from: [0.0; 2], to: end(right), rigid }];
    let mut assembly = Assembly { members: Vec::new(), walls, touches: Vec::new(), scale: 1.0, young: 1.0 };
    let weight = lot.factor(1e-4, 1e-3) / (count as f64).sqrt();
    for _ in 0..20 * count {
        if assembly.members.len() == count {
            break;
        }
        let wave = if lot.chance(0.5) { 0.0 } else { lot.between(0.2, 0.6) };
        let corners = lot.one(&[3.0, 4.0, 5.0]);
        let size = lot.between(0.6, 1.3);
        let top = assembly.members.iter().filter_map(Member::round).map(|round| round.centre[1] + 3.0).fold(length, f64::max);
        let x = lot.between(length * left.cos(), length * right.cos()) * 0.7;
        let shape = Round { centre: [x, top], size, wave: wave / (corners * corners - 1.0), corners, turn: lot.between(-PI, PI) };
        let wish = lot.chance(0.15) && wave == 0.0;
        let clearance = if lot.chance(0.5) { 0.0 } else { lot.between(-5e-4, 1e-3) };
        if let Some((round, touches)) = assembly.drop(shape) {
            let rigid = wish && touches.iter().all(|touch| assembly.is_elastic(touch.pair[0]));
            if touches.iter().any(|touch| rigid && !assembly.is_elastic(touch.pair[0])) || !rigid && wish {
                continue;
            }
            let load = [0.0, -weight * round.area()];
            let shape = Shape::Round { round, clearance: if rigid { 0.0 } else { clearance * size } };
            assembly.members.push(Member { shape, rigid, upright: true, guided: false, load });
            assembly.touches.extend(touches);
            // One more may push others out of their places.
            if !matches!(assembly.statics().finding(), Finding::Forces(_)) || !assembly.statics().is_clear() {
                assembly.members.pop();
                assembly.touches.truncate(2 * assembly.members.len());
            }
        }
    }
    assembly
}

/// Rollers between a floor and a plate that is pressed down.
fn rollers(lot: &mut Lot) -> Assembly {
    let count = lot.one(&[1, 2, 2, 3, 4, 6]);
    let pitch = lot.between(2.2, 3.5);
    let half = 0.5 * pitch * count as f64 + 0.3;
    let wall = Wall { from: [-half, 0.0], to: [half, 0.0], rigid: lot.chance(0.5) };
    let aside = lot.one(&[-1.0, 1.0]) * lot.between(0.05, 0.2) * pitch;
    let mut assembly = Assembly { members: Vec::new(), walls: vec![wall], touches: Vec::new(), scale: 1.0, young: 1.0 };
    let force = lot.factor(1e-4, 2e-3) * count as f64;
    let upper = Shape::Plate { middle: [0.0, 2.0], half, depth: lot.between(0.5, 2.0) };
    for k in 0..count {
        let x = pitch * (k as f64 - 0.5 * (count - 1) as f64) + aside;
        let round = Round { centre: [x, 1.0], size: 1.0, wave: 0.0, corners: 3.0, turn: 0.0 };
        let clearance = if lot.chance(0.5) { 0.0 } else { lot.between(-2e-4, 2e-4) };
        let shape = Shape::Round { round, clearance };
        assembly.members.push(Member { shape, rigid: false, upright: true, guided: true, load: [0.0, -0.05 * force] });
        let pairs = [([Side::Wall(0), Side::Member(k)], 0.0), ([Side::Member(k), Side::Member(count)], 2.0)];
        assembly.touches.extend(pairs.map(|(pair, y)| Touch { pair, at: [x, y], normal: [0.0, 1.0] }));
    }
    // On one roller it tips, unless that is held.
    let upright = count == 1 && lot.chance(0.5);
    assembly.members.push(Member { shape: upper, rigid: false, upright, guided: true, load: [0.0, -force] });
    assembly
}

impl Member {
    pub fn round(&self) -> Option<Round> {
        match self.shape {
            Shape::Round { round, .. } => Some(round),
            Shape::Plate { .. } => None,
        }
    }

    /// Where its turn is about, and its loads act.
    pub fn middle(&self) -> [f64; 2] {
        match self.shape {
            Shape::Round { round, .. } => round.centre,
            Shape::Plate { middle, depth, .. } => [middle[0], middle[1] + 0.5 * depth],
        }
    }
}

impl Assembly {
    pub fn is_elastic(&self, side: Side) -> bool {
        match side {
            Side::Wall(k) => !self.walls[k].rigid,
            Side::Member(k) => !self.members[k].rigid,
        }
    }

    /// Distance of a body from everything that is there, and the normals towards it.
    fn around(&self, round: &Round) -> Vec<(Side, f64, [f64; 2])> {
        let wall = |(k, wall): (usize, &Wall)| {
            let n = wall.inward();
            (Side::Wall(k), dot(minus(round.centre, wall.from), n) - round.reach((-n[1]).atan2(-n[0]))[0], n)
        };
        let member = |(k, member): (usize, &Member)| {
            let own = member.round()?;
            let [x, y] = minus(own.centre, round.centre);
            if x.hypot(y) > 1.2 * (own.size + round.size) + 1.0 {
                return None;
            }
            let (distance, angle) = own.apart(round);
            Some((Side::Member(k), distance, direction(angle)))
        };
        let members = self.members.iter().enumerate().filter_map(member);
        self.walls.iter().enumerate().map(wall).chain(members).collect()
    }

    /// The place where a body comes to rest that falls and slides, and its supports, if they are two and nothing else is close.
    ///
    /// Distances from convex bodies are convex, so that each step, the lowest point of what the tangents leave, stays outside.
    fn drop(&self, mut round: Round) -> Option<(Round, Vec<Touch>)> {
        for _ in 0..200 {
            let around = self.around(&round);
            let step = lowest(&around, 0.5);
            round.centre = [0, 1].map(|c| round.centre[c] + step[c]);
            if step[0].hypot(step[1]) < 1e-13 {
                break;
            }
        }
        let around = self.around(&round);
        let near: Vec<_> = around.iter().filter(|(_, distance, _)| *distance < CLEAR).collect();
        let [(first, a, m), (second, b, n)] = near[..] else { return None };
        let det = m[0] * n[1] - m[1] * n[0];
        let shares = [-n[0] / det, m[0] / det];
        let on_wall = [first, second].iter().all(|side| match side {
            Side::Wall(k) => {
                let wall = &self.walls[*k];
                let along = dot(minus(round.centre, wall.from), wall.along());
                let [x, y] = minus(wall.to, wall.from);
                along > 0.3 && along < x.hypot(y) - 0.3
            }
            Side::Member(_) => true,
        });
        let good = a.abs().max(b.abs()) < 1e-9 && shares.iter().all(|share| *share > 0.03 && *share < 3.0) && on_wall;
        let own = Side::Member(self.members.len());
        let touch = |side: Side, n: [f64; 2]| {
            let at = round.point((-n[1]).atan2(-n[0]));
            Touch { pair: [side, own], at, normal: n }
        };
        good.then(|| (round, vec![touch(*first, *m), touch(*second, *n)]))
    }
}

/// The lowest step within a square that keeps all distances, as far as tangents know.
fn lowest(around: &[(Side, f64, [f64; 2])], most: f64) -> [f64; 2] {
    let mut bounds: Vec<([f64; 2], f64)> = around.iter().map(|(_, distance, n)| (*n, -distance)).collect();
    bounds.retain(|(_, bound)| *bound > -2.0 * most);
    bounds.extend([[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]].map(|n| (n, -most)));
    let is_outside = |step: [f64; 2]| bounds.iter().all(|(n, bound)| dot(*n, step) >= bound - 1e-13);
    let mut best = if is_outside([0.0, -most]) { [0.0, -most] } else { [0.0; 2] };
    for (k, (m, a)) in bounds.iter().enumerate() {
        for (n, b) in &bounds[k + 1..] {
            let det = m[0] * n[1] - m[1] * n[0];
            if det.abs() < 1e-9 {
                continue;
            }
            let step = [(a * n[1] - b * m[1]) / det, (m[0] * b - n[0] * a) / det];
            if step[1] < best[1] - 1e-15 && is_outside(step) {
                best = step;
            }
        }
    }
    best
}
