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

/// Of the two sides of a unilateral contact, by the nodes of both; `away` is how far a place lies beyond the last end of Γ_C, or, below
/// zero, before the first one; zero between them.
pub fn penetration(sides: &[Vec<SmoothSide>; 2], pair: &Pair, away: impl Fn(Point) -> f64) -> Penetration {
    let mut penetration = Penetration::default();
    if pair.law != Law::Unilateral {
        return penetration;
    }
    let (mut closed, mut nearest) = (0.0_f64, f64::INFINITY);
    for (stretches, others) in [(&sides[0], &sides[1]), (&sides[1], &sides[0])] {
        for (side, other) in stretches.iter().flat_map(|side| others.iter().map(move |other| (side, other))) {
            let mut overlaps = Vec::with_capacity(side.nodes());
            for node in 0..side.nodes() {
                let gaps = side.facing_gaps(node, other, pair, REACH * other.length());
                let gaps = gaps.filter(|gaps| gaps.now.is_finite());
                let place = side.points[node];
                let overlap = gaps.as_ref().filter(|gaps| gaps.is_inside).map_or(0.0, |gaps| -gaps.now);
                overlaps.push((away(place), overlap));
                if overlap > penetration.depth {
                    (penetration.depth, penetration.place) = (overlap, place);
                }
                let Some(gaps) = gaps else { continue };
                closed = closed.max(gaps.at_rest - gaps.now);
                nearest = nearest.min(gaps.at_rest);
            }
            penetration.beyond = penetration.beyond.max(deepest_beyond(&overlaps));
        }
    }
    penetration.approach = if nearest.is_finite() { (closed - nearest.max(0.0)).max(-nearest).max(0.0) } else { 0.0 };
    penetration
}

/// The deepest overlap of nodes in a row that overlap and lie all beyond one end of Γ_C, with an open node between them and it; each
/// node with how far it lies beyond.
fn deepest_beyond(nodes: &[(f64, f64)]) -> f64 {
    rows_beyond(nodes).into_iter().flatten().map(|node| node.1).fold(0.0, f64::max)
}

/// The rows of nodes that overlap and lie all beyond one end of Γ_C, with an open node between them and it; each node with how far it
/// lies beyond, and how deep it overlaps.
pub fn rows_beyond(nodes: &[(f64, f64)]) -> Vec<&[(f64, f64)]> {
    let rows: Vec<_> = nodes.chunk_by(|a, b| (a.1 > 0.0) == (b.1 > 0.0) && a.0 * b.0 > 0.0).collect();
    // Beside a row lies Γ_C where the next node is not open, or not on the same side.
    let is_open = |at: Option<usize>, away: f64| at.and_then(|at| rows.get(at)).is_none_or(|row| row[0].0 * away > 0.0);
    let is_apart = |at: usize| {
        let (away, overlap) = rows[at][0];
        overlap > 0.0 && away != 0.0 && is_open(at.checked_sub(1), away) && is_open(Some(at + 1), away)
    };
    (0..rows.len()).filter(|&at| is_apart(at)).map(|at| rows[at]).collect()
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
        penetration(&SmoothSide::of_pair(&mesh, &numbering, &pair, &displacement), &pair, |x| (x.x - within).max(0.0))
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

    #[test]
    fn what_overlaps_beside_the_ends_of_the_contact_boundary_is_its_own() {
        let deepest = |nodes: &[(f64, f64)]| deepest_beyond(nodes);
        let far = [(-3.0, 0.1), (-2.0, 0.2), (-1.0, 0.0), (0.0, 0.5), (1.0, 0.3), (2.0, -1.0), (3.0, 0.15)];
        assert_eq!(deepest(&far), 0.2);
        assert_eq!(deepest(&far[3..]), 0.15);
        assert_eq!(deepest(&[(-1.0, 0.1), (0.0, 0.0), (1.0, 0.2), (2.0, 0.0)]), 0.0);
        assert_eq!(deepest(&[(-1.0, 0.1), (1.0, 0.2)]), 0.0, "no node faces it");
    }
}
