//! What a place of a side sees.

use crate::geometry::{Point, cross};

/// Cosine of the angle between two outward normals that face each other, at most (120 degrees).
const OPPOSITE: f64 = -0.5;

/// A place of a side: where it is, its outward normal, and how far the next place is.
#[derive(Clone, Copy)]
pub struct Sight {
    pub place: Point,
    pub normal: Point,
    pub spacing: f64,
    /// Whether it is an end of an edge, where sides that look elsewhere may meet.
    pub is_end: bool,
}

impl Sight {
    /// How far another place lies along the normal (length), if it looks back, lies within reach behind or ahead, and not far aside.
    pub fn faces(&self, other: &Self, [behind, ahead]: [f64; 2]) -> Option<f64> {
        if self.normal.dot(&other.normal) >= OPPOSITE {
            return None;
        }
        let way = other.place - self.place;
        let (along, aside) = (way.dot(&self.normal), cross(way, self.normal).abs());
        let is_near = (-behind..=ahead).contains(&along) && aside <= 0.5 * along.abs() + self.spacing + other.spacing;
        is_near.then_some(along)
    }
}
