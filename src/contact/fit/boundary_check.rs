//! Whether a fitted Γ_C is what it should be: between the two sides, and no longer than they are.

use crate::contact::contact_boundary::ContactBoundary;
use crate::contact::pair::Pair;
use crate::contact::smooth_side::SmoothSide;

/// Share of the longer of two sides by which Γ_C may be longer than that between its ends: half-way it is shorter.
const LONGER: f64 = 0.1;

/// Largest distance from a side of those points of Γ_C that are farther from one of the two sides than the sides are from
/// each other and an edge; nothing if there are none.
pub fn stray(sides: [&SmoothSide; 2], boundary: &ContactBoundary, pair: &Pair) -> Option<f64> {
    let knots = boundary.knots();
    let places = knots.windows(2).flat_map(|ends| [ends[0], 0.5 * (ends[0] + ends[1])]).chain([boundary.ends()[1]]);
    let longest = sides.iter().map(|side| side.edge_length(0, side.points.len() - 1)).fold(0.0, f64::max);
    let mut worst: f64 = 0.0;
    for x in places.map(|t| boundary.point(t)) {
        let feet = sides.map(|side| side.nearest(x, pair.configuration).clamp(0.0, side.length()));
        let [a, b] = [0, 1].map(|k| sides[k].curve(pair.configuration).point(feet[k]));
        let away = (x - a).norm().max((x - b).norm());
        if away > (a - b).norm() + longest {
            worst = worst.max(away);
        }
    }
    (worst > 0.0).then_some(worst)
}

/// Whether Γ_C is longer than both sides are between its ends: a fit that swings where long edges leave it few data.
pub fn swings(sides: [&SmoothSide; 2], boundary: &ContactBoundary, pair: &Pair) -> bool {
    let ends = boundary.ends().map(|t| boundary.point(t));
    let stretch = |side: &SmoothSide| {
        let [a, b] = ends.map(|end| side.nearest(end, pair.configuration));
        let way = (b - a).abs();
        side.turn().map_or(way, |turn| way.min(turn - way))
    };
    !boundary.is_closed() && boundary.length() > (1.0 + LONGER) * stretch(sides[0]).max(stretch(sides[1]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::samples::seam;
    use crate::element::Order;
    use crate::geometry::{Curve, Point};
    use crate::mesh::samples::two_blocks;
    use crate::mesh::{Level, Numbering, Partition};
    use std::rc::Rc;

    /// A boundary between two flat sides is where it should be; one that leaves them is told with its distance.
    #[test]
    fn a_boundary_that_leaves_both_sides_is_told_with_its_distance() {
        let mesh = two_blocks();
        let partition = Rc::new(Partition::new(&mesh, &[0; 6], 1));
        let numbering = Numbering::new(Level { intervals: 16, order: Order::P2 }, &partition);
        let pair = seam();
        let sides = SmoothSide::of_pair(&mesh, &numbering, &pair, &|_| Point::zeros());
        let sides = [&sides[0][0], &sides[1][0]];
        for (end, distance) in [([2.0, 1.0], None), ([2.0, 1.8], Some(0.8)), ([2.6, 1.0], Some(0.6))] {
            let boundary = ContactBoundary::new(Curve::Line([[0.0, 1.0], end]), [0.0, 1.0], Point::new(0.0, 1.0));
            let found = stray(sides, &boundary, &pair);
            assert_eq!(found.is_some(), distance.is_some(), "{end:?}: {found:?}");
            assert!((found.unwrap_or(0.0) - distance.unwrap_or(0.0)).abs() < 1e-9, "{end:?}: {found:?}");
        }
    }
}
