//! Γ_C on the curve of one of its two sides: a rigid tool's own, or that of a body whose shape is known.
//!
//! Where the sides are drawn apart, the curve is shifted by the way between them where that is shortest: it lies on the other
//! side there, as it will when they touch, and points of its own side correspond to it that are as far shifted. Seen from afar,
//! the normals of a curved side would spread, or crowd, on the other.

use crate::contact::pair::{Configuration, Pair};
use crate::contact::smooth_side::SmoothSide;
use crate::geometry::{Curve, Point};

/// Nodes of the other side that are looked at for the shortest way, at most.
const LOOKS: usize = 200;

/// Steps from one curve to the other and back on which the shortest way is made exact.
const STEPS: usize = 60;

/// A way shorter than this share of a side is none.
const TOUCHING: f64 = 1e-9;

/// The shape of one side as it carries Γ_C.
pub struct OwnCurve<'a> {
    /// Body 1's side and body 2's, closed ones begun at their seams.
    sides: [&'a SmoothSide; 2],
    /// Which of them carries Γ_C.
    own: usize,
    /// The curve.
    pub curve: Curve,
    /// Parameter at the middle of the side; on a closed curve parameters lie within half a turn from it.
    middle: f64,
}

impl<'a> OwnCurve<'a> {
    /// The shape of the side that Γ_C of a pair lies on, shifted as that is, if it lies on one; closed sides are begun at their seams.
    pub fn of_pair(sides: [&'a SmoothSide; 2], pair: &Pair) -> Option<Self> {
        let own = pair.curve.own_side()? as usize;
        let side = sides[own];
        let middle = side.shape.nearest(side.places[side.places.len() / 2]);
        Some(Self { sides, own, curve: side.shape.moved(side.shift), middle })
    }

    /// How far Γ_C is shifted from the side that it has the shape of, for each side (length).
    pub fn shifts(sides: [&SmoothSide; 2], pair: &Pair) -> [Point; 2] {
        let mut shifts = [Point::zeros(); 2];
        if let Some(own) = pair.curve.own_side().map(|side| side as usize) {
            shifts[own] = shortest_way(sides[own], sides[1 - own]).unwrap_or_default();
        }
        shifts
    }

    /// One whole turn from the beginning of a closed curve; all of an open one.
    pub fn turn(&self) -> [f64; 2] {
        self.curve.range()
    }

    /// Parameters of points of body 1's side, by their parameters there: the lower first.
    pub fn ends(&self, ends: [f64; 2]) -> [f64; 2] {
        let [a, b] = ends.map(|t| self.foot(0, self.sides[0].curve(Configuration::Reference).point(t)));
        [a.min(b), a.max(b)]
    }

    /// Parameter of the foot of a node of body 1's side.
    pub fn node(&self, node: usize) -> f64 {
        self.foot(0, self.sides[0].places[node])
    }

    /// Parameters up to which both sides are there, around a place between them. An end of the other side that looks away from the curve is
    /// no limit: that of a circle that is open at its back.
    pub fn limits(&self, around: f64) -> [f64; 2] {
        let mut limits = match self.curve.period() {
            Some(period) => [self.middle - 0.5 * period, self.middle + 0.5 * period],
            None => [f64::NEG_INFINITY, f64::INFINITY],
        };
        for (k, side) in self.sides.iter().enumerate().filter(|(_, side)| side.turn().is_none()) {
            let ends = [side.places[0], side.places[side.places.len() - 1]];
            for end in ends.into_iter().filter(|end| k == self.own || self.faces(*end)) {
                let foot = self.foot(k, end);
                if foot < around {
                    limits[0] = limits[0].max(foot);
                } else {
                    limits[1] = limits[1].min(foot);
                }
            }
        }
        limits
    }

    /// Whether the other side looks at the curve from a point of its own.
    fn faces(&self, x: Point) -> bool {
        let [own, other] = [self.sides[self.own], self.sides[1 - self.own]];
        let (_, outward) = other.nearest_place(x);
        let (_, outward_of_own) = own.nearest_place(x + other.shift - own.shift);
        outward.dot(&outward_of_own) < 0.0
    }

    /// Parameter of the foot of a point of a side.
    fn foot(&self, side: usize, x: Point) -> f64 {
        let t = self.curve.nearest(x + self.sides[side].shift);
        self.curve.period().map_or(t, |period| {
            let way = (t - self.middle + 0.5 * period).rem_euclid(period) - 0.5 * period;
            self.middle + way
        })
    }
}

/// The shortest way from a side to another, both undeformed; nothing where they touch or overlap.
fn shortest_way(side: &SmoothSide, other: &SmoothSide) -> Option<Point> {
    let nearest = |side: &SmoothSide, x: Point| side.nearest_place(x);
    let away = |x: &Point| (nearest(side, *x).0 - x).norm();
    let looks = other.places.iter().step_by(other.places.len().div_ceil(LOOKS)).chain(other.places.last());
    let mut x = *looks.min_by(|a, b| away(a).total_cmp(&away(b)))?;
    for _ in 0..STEPS {
        x = nearest(other, nearest(side, x).0).0;
    }
    let (own, _) = nearest(side, x);
    let (x, outward) = nearest(other, own);
    ((own - x).dot(&outward) > TOUCHING * side.length()).then(|| x - own)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::pair::CurveChoice;
    use crate::contact::samples::seam;
    use crate::contact::side::Side;
    use crate::element::Order;
    use crate::mesh::samples::two_blocks;
    use crate::mesh::{Level, Numbering, Partition, each_once};
    use std::rc::Rc;

    /// The upper of two blocks, lifted: its flat seam is shifted onto that of the lower one, from end to end.
    #[test]
    fn the_curve_of_a_side_drawn_apart_lies_on_the_other_side() {
        for (lift, shifted) in [(0.3, true), (0.0, false), (-0.1, false)] {
            let mut mesh = two_blocks();
            let upper = mesh.bodies.iter().position(|name| name == "upper").expect("named") as u32;
            let of_upper = mesh.triangles.iter().filter(|triangle| triangle.body == upper).flat_map(|triangle| triangle.vertices);
            each_once(of_upper).into_iter().for_each(|vertex| mesh.vertices[vertex as usize].y += lift);
            let numbering = Numbering::new(Level { intervals: 4, order: Order::P1 }, &Rc::new(Partition::new(&mesh, &[0; 6], 1)));
            let pair = Pair { curve: CurveChoice::Own(Side::Second), ..seam() };
            let sides = SmoothSide::of_pair(&mesh, &numbering, &pair, &|_| Point::zeros());
            let [first, second] = [&sides[0][0], &sides[1][0]];
            let way = shortest_way(second, first);
            assert_eq!(way.is_some(), shifted, "{way:?}");
            let way = way.unwrap_or_default();
            assert!((way - Point::new(0.0, if shifted { -lift } else { 0.0 })).norm() < 1e-12, "{way}");
            let laid = second.laid(0, way);
            let own = OwnCurve::of_pair([first, &laid], &pair).expect("on the second");
            let ends = own.limits(0.5).map(|t| own.curve.point(t));
            let y = if shifted { 1.0 } else { 1.0 + lift };
            for (x, end) in [0.0, 2.0].into_iter().zip(if ends[0].x < ends[1].x { ends } else { [ends[1], ends[0]] }) {
                assert!((end - Point::new(x, y)).norm() < 1e-12, "{end}");
            }
        }
    }
}
