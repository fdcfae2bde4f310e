//! Arcs over the sides of second-order elements, and which of them go on in one another.

use crate::geometry::{Point, cross};

/// A midside node within this share of its side from the chord lies on it: files have six digits or more.
pub const FLAT: f64 = 1e-6;

/// Neighbours whose tangents differ by more (radians, 20 degrees) have a corner between them.
const CORNER: f64 = 20.0 * std::f64::consts::PI / 180.0;

/// Curvatures of neighbours on one smooth curve differ by this share of their sum at most.
const JUMP: f64 = 0.5;

/// From one side of a smooth curve to the next the curvature changes by this multiple at most of what it changes by, in the same
/// sense, one side before or after; so it does where it goes through zero.
const STEEPER: f64 = 2.5;

/// Neighbours whose curvatures differ by more than [`JUMP`] are on one smooth curve only if their tangents differ by less (radians, one
/// degree).
const SMOOTH: f64 = std::f64::consts::PI / 180.0;

/// Curvatures of neighbours on one circle differ by this share of their sum at most.
const EQUAL: f64 = 1e-3;

/// Tangents of neighbours on one circle differ by this angle (radians) at most: two arcs that differ by more have a corner
/// between them, however blunt, since circles tell their tangents to all digits.
const KINK: f64 = 1e-3;

/// A side with its midside node, curved or straight: first end, midside node, second end.
#[derive(Clone, Copy)]
pub struct Bow {
    pub edge: u32,
    pub ends: [u32; 2],
    pub points: [Point; 3],
}

impl Bow {
    /// The side run through from its second end.
    pub fn reversed(self) -> Self {
        let ([a, b], [x, y, z]) = (self.ends, self.points);
        Self { ends: [b, a], points: [z, y, x], ..self }
    }

    /// Direction at the first end of the circle through the three nodes: by the inversion about this end that circle is the
    /// straight line through the two other nodes.
    fn tangent(&self) -> Point {
        let [a, m, b] = self.points;
        ((m - a) / (m - a).norm_squared() - (b - a) / (b - a).norm_squared()).normalize()
    }

    /// Signed curvature of the circle through the three nodes (1/length), positive to the left.
    fn curvature(&self) -> f64 {
        let [a, m, b] = self.points;
        2.0 * cross(m - a, b - m) / ((m - a).norm() * (b - m).norm() * (b - a).norm())
    }

    /// Length of its chord.
    pub fn chord(&self) -> f64 {
        (self.points[2] - self.points[0]).norm()
    }

    /// Height of the midside node over the chord, as a share of its length.
    pub fn height(&self) -> f64 {
        let [a, m, b] = self.points;
        cross(b - a, m - a).abs() / (b - a).norm_squared()
    }

    /// Whether it is straight.
    pub fn is_flat(&self) -> bool {
        self.height() <= FLAT
    }

    /// Derivative of the curvature by the arc length from here to the next side (1/length²).
    fn steepness(&self, next: &Self) -> f64 {
        2.0 * (next.curvature() - self.curvature()) / (self.chord() + next.chord())
    }
}

/// Whether the sides in the middle of four in a row are on one smooth curve: their curvatures are alike, or change as they do on
/// the side before or after. A straight side is on one only where the curvature changes its sign there.
pub fn go_on([before, bow, other, after]: [Option<Bow>; 4]) -> bool {
    let (Some(bow), Some(other)) = (bow, other) else { return false };
    if bow.is_flat() || other.is_flat() {
        return false;
    }
    if turns_by_less(CORNER, &bow, &other) && differ_by(&bow, &other) <= JUMP {
        return true;
    }
    turns_by_less(SMOOTH, &bow, &other)
        && (before.is_some_and(|before| changes_alike([before, bow, other]))
            || after.is_some_and(|after| changes_alike([bow, other, after])))
}

/// Whether a straight side in the middle of five in a row is an inflection of the smooth curve of the others.
pub fn is_inflection(five: [Option<Bow>; 5]) -> bool {
    let [Some(first), Some(before), Some(flat), Some(after), Some(last)] = five else { return false };
    let turns = before.curvature() * after.curvature() < 0.0 && flat.is_flat();
    turns && [[first, before, flat], [before, flat, after], [flat, after, last]].into_iter().all(changes_alike)
}

/// Whether two neighbours are arcs of one circle.
pub fn on_one_circle(bow: &Bow, other: &Bow) -> bool {
    differ_by(bow, other) <= EQUAL && turns_by_less(KINK, bow, other)
}

/// Whether the curvature of three smooth neighbours goes on changing in one sense, and by no more than [`STEEPER`] either way.
fn changes_alike([a, b, c]: [Bow; 3]) -> bool {
    let steepness = [a.steepness(&b), b.steepness(&c)];
    let [least, most] = [steepness[0].abs().min(steepness[1].abs()), steepness[0].abs().max(steepness[1].abs())];
    turns_by_less(SMOOTH, &a, &b) && turns_by_less(SMOOTH, &b, &c) && steepness[0] * steepness[1] > 0.0 && most <= STEEPER * least
}

/// Whether the tangents of a side and of the one that begins at its end differ by less than an angle (radians).
fn turns_by_less(angle: f64, bow: &Bow, other: &Bow) -> bool {
    (-bow.reversed().tangent()).dot(&other.tangent()) > angle.cos()
}

/// Difference of the curvatures of two sides as a share of their sum.
fn differ_by(bow: &Bow, other: &Bow) -> f64 {
    let (a, b) = (bow.curvature(), other.curvature());
    (a - b).abs() / (a.abs() + b.abs())
}
