//! How deep two bodies lie in each other, by their whole sides: a contact boundary may see less than that.

use super::pair::{Law, Pair};
use super::smooth_side::SmoothSide;
use crate::geometry::Point;

/// Reach beyond the ends of a side, as a share of its length.
const REACH: f64 = 1e-9;

/// How two bodies have come together.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Penetration {
    /// The deepest place of one in the other (length), but for the edges at the ends of the sides, where corners press; zero where
    /// none is.
    pub depth: f64,
    /// Where that is.
    pub place: Point,
    /// The deepest place of a stretch that overlaps all beyond the contact boundary (length).
    pub beyond: f64,
    /// How far the sides have come together since they touched first, or have parted that were drawn in each other (length).
    pub approach: f64,
}

/// Of the two sides of a unilateral contact, by the nodes of both; `is_within` tells which places Γ_C faces.
pub fn penetration(sides: &[Vec<SmoothSide>; 2], pair: &Pair, is_within: impl Fn(Point) -> bool) -> Penetration {
    let mut penetration = Penetration::default();
    if pair.law != Law::Unilateral {
        return penetration;
    }
    let (mut closed, mut nearest) = (0.0_f64, f64::INFINITY);
    for (stretches, others) in [(&sides[0], &sides[1]), (&sides[1], &sides[0])] {
        for (side, other) in stretches.iter().flat_map(|side| others.iter().map(move |other| (side, other))) {
            // The deepest place of the stretch that overlaps here, while none of it lies within Γ_C.
            let mut stretch = Some(0.0_f64);
            for node in 0..side.nodes() {
                let gaps = side.facing_gaps(node, other, pair, REACH * other.length());
                let gaps = gaps.filter(|gaps| gaps.now.is_finite());
                let place = side.points[node];
                let overlap = gaps.as_ref().filter(|gaps| gaps.is_inside).map_or(0.0, |gaps| -gaps.now);
                stretch = if is_within(place) {
                    None
                } else if overlap <= 0.0 {
                    Some(0.0)
                } else {
                    stretch.map(|deepest| deepest.max(overlap))
                };
                penetration.beyond = penetration.beyond.max(stretch.unwrap_or(0.0));
                let Some(gaps) = gaps else { continue };
                closed = closed.max(gaps.at_rest - gaps.now);
                nearest = nearest.min(gaps.at_rest);
                if overlap > penetration.depth {
                    (penetration.depth, penetration.place) = (overlap, place);
                }
            }
        }
    }
    penetration.approach = if nearest.is_finite() { (closed - nearest.max(0.0)).max(-nearest).max(0.0) } else { 0.0 };
    penetration
}

#[cfg(test)]
mod tests {
    use super::super::pair::{Configuration, CurveChoice};
    use super::*;
    use crate::contact::samples::seam;
    use crate::element::Order;
    use crate::mesh::samples::two_blocks;
    use crate::mesh::{EdgeNode, Level, Numbering, Partition};
    use std::rc::Rc;

    /// Of the two blocks, nodes every eighth of an edge, the upper one lowered by a function of x.
    fn lowered(configuration: Configuration, within: f64, by: impl Fn(f64) -> f64) -> Penetration {
        let pair = Pair { curve: CurveChoice::Fit, configuration, ..seam() };
        let mesh = two_blocks();
        let numbering = Numbering::new(Level { intervals: 16, order: Order::P1 }, &Rc::new(Partition::new(&mesh, &[0; 6], 1)));
        let upper = mesh.bodies.iter().position(|name| name == "upper");
        let displacement = |node: EdgeNode| {
            let x = node.place(&mesh, &numbering);
            Point::new(0.0, if Some(mesh.body_beside(node.edge)) == upper { -by(x.x) } else { 0.0 })
        };
        penetration(&SmoothSide::of_pair(&mesh, &numbering, &pair, &displacement), &pair, |x| x.x < within)
    }

    #[test]
    fn the_deepest_place_and_the_approach_are_those_of_the_whole_sides() {
        for configuration in [Configuration::Reference, Configuration::Deformed] {
            let found = lowered(configuration, 2.0, |x| 0.01 * x);
            // The last nodes are the ends of the sides.
            assert!((found.depth - 0.01875).abs() < 1e-3 && (found.approach - 0.02).abs() < 1e-4, "{found:?}");
            assert!(found.place.x > 1.8 && found.place.x < 2.0, "{found:?}");
            assert_eq!(lowered(configuration, 2.0, |_| -0.03).depth, 0.0, "they are apart");
        }
    }

    /// The upper block lies in the lower one around x = .3 and from 1.2 on, and Γ_C ends somewhere.
    #[test]
    fn a_stretch_that_overlaps_all_beyond_the_contact_boundary_is_seen() {
        let by = |x: f64| if x < 0.5 { 0.02 - 0.1 * (x - 0.3).abs() } else { 0.05 * (x - 1.2) };
        for configuration in [Configuration::Reference, Configuration::Deformed] {
            let beyond = |within: f64| lowered(configuration, within, by).beyond;
            assert!((beyond(0.9) - 0.05 * 0.675).abs() < 2e-3, "{}", beyond(0.9));
            assert_eq!(beyond(1.5), 0.0, "what goes on from within is that contact's own");
        }
    }
}
