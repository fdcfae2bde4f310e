//! Whether contact boundaries have come to rest: how far they moved, and how far the mesh lets that be told.

use super::ends::OF_A_SEGMENT;
use crate::accuracy::{Accuracy, Goal, Quantity, share_of_nothing};
use crate::contact::Configuration;
use crate::discretisation::Contact;
use crate::procedure::ending::{Failure, HeldEnds, Standing};
use serde::Serialize;

/// Boundaries placed at most.
pub const MOST_BOUNDARIES: usize = 30;

/// Number of the boundary from which on ends are held where they are, should they still move.
pub const HELD: usize = 10;

/// Ends that moved by more than this share of the length just before are held where they have reached farthest, others
/// where they are.
pub const MOST_HELD: f64 = 1e-2;

/// Error that the ends have on a mesh anyway, as a share of their way since the coarser one: a third, if it falls by four from
/// mesh to mesh, all of it, if by two.
const OWN_ERROR: f64 = 0.45;

/// Share of the length that ends may be left to move, however coarse the mesh is: force and peak feel the square of it.
const MOST_LEFT: f64 = 1.6e-3;

/// That share by the root of the error that is asked for, where it is of forces alone: its square is a fortieth of the error. It counts
/// up to an error of a hundredth, the largest that was tried.
const LEFT_BY_ROOT: f64 = 0.16;
const LOOSEST: f64 = 1e-2;

/// One boundary of the loop, in figures.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct BoundaryStep {
    /// Number of the boundary, from 1.
    pub iteration: usize,
    /// Length of all contact boundaries that follow (length).
    pub length: f64,
    /// Largest way of a segment end to the next boundary, of contacts that count, relative to the length; nothing if the segments are
    /// others.
    pub moved: Option<f64>,
    /// Change of the displacement since the boundary before, relative to its norm; nothing for the first.
    pub du: Option<f64>,
    /// Multipliers whose state has changed since the boundary before; nothing if there are others now.
    pub flipped: Option<usize>,
}

/// Share of the length that ends may be left to move, for what is asked for.
pub fn most_left(asked: Option<&Accuracy>) -> f64 {
    let is_force = |goal: &Goal| matches!(goal.quantity, Quantity::Force(_));
    let by_root = |_| MOST_LEFT.max(LEFT_BY_ROOT * share_of_nothing(asked).min(LOOSEST).sqrt());
    asked.filter(|asked| asked.goals.iter().all(is_force)).map_or(MOST_LEFT, by_root)
}

/// By how much the ends of the boundaries would still move, as a share of the length, if that is less than they are exact
/// for: by their way since the coarser mesh and the segments beside them, `most` at most, or by what is `still`.
pub fn left_to_the_mesh(contacts: &[[&Contact; 2]], most: f64, still: f64) -> Option<f64> {
    let mut left: f64 = 0.0;
    for [old, new] in contacts {
        let (boundary, last) = (&old.boundary, old.boundary.segments() - 1);
        let (now, next, coarser) = (old.ends(), new.ends(), new.known.coarser?);
        for (k, segment) in [0, last].into_iter().enumerate() {
            let (way, since) = ((next[k] - now[k]).norm(), (next[k] - coarser[k]).norm());
            let own = (OWN_ERROR * since).max(OF_A_SEGMENT * boundary.segment_length(segment));
            if way > own.min(most * boundary.length()).max(still * boundary.length()) {
                return None;
            }
            left = left.max(way / boundary.length());
        }
    }
    Some(left)
}

/// Largest way of a segment end between two placings of some contacts, relative to the length.
pub fn way(contacts: &[[&Contact; 2]]) -> Option<f64> {
    let mut most: f64 = 0.0;
    for [old, new] in contacts {
        if old.boundary.segments() != new.boundary.segments() {
            return None;
        }
        let ends = old.boundary.knots().iter().zip(new.boundary.knots());
        let ways = ends.map(|(&s, &t)| (old.boundary.point(s) - new.boundary.point(t)).norm() / old.boundary.length());
        most = ways.fold(most, f64::max);
        // Corresponding points and distances move with the bodies, even if the curve does not.
        if old.pair.configuration == Configuration::Deformed {
            most = most.max(f64::MIN_POSITIVE);
        }
    }
    Some(most)
}

/// The failure of a boundary that is still moving after the last fit.
pub fn moves(&BoundaryStep { moved, du, flipped, .. }: &BoundaryStep) -> Failure {
    Failure::BoundaryMoves { fits: MOST_BOUNDARIES, moved, du, flipped }
}

/// What stands after these boundaries of some contacts: to what the mesh is exact for if there is a `way` left; `within` is
/// what stands on the last of them.
pub fn standing(contacts: &[Contact], steps: &[BoundaryStep], way: Option<f64>, within: Standing) -> Standing {
    let may_be_held = contacts.iter().any(|contact| contact.pair.has_free_ends());
    let held = steps.get(HELD - 1).filter(|_| may_be_held).map(|_| {
        let way = steps[HELD - 2].moved;
        HeldEnds { fit: HELD - 1, way, farthest: way.is_some_and(|way| way > MOST_HELD) }
    });
    Standing::Boundary { fits: steps.len(), held, way, within: Box::new(within) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::{EndRule, Known, MultiplierSpace, Pair};
    use crate::discretisation::samples::{blocks, contact, pair};
    use crate::geometry::Point;

    /// Between two places of Γ_C on the seam, which is 2 long; the first is 0.5 long.
    fn way_to(ends: [f64; 2], segments: usize, rule: EndRule) -> Option<f64> {
        let place = |ends, segments| {
            let pair = Pair { ends: rule, ..pair(MultiplierSpace::P0, segments) };
            contact(&blocks(pair, |_| Point::zeros(), Vec::new()), Known { ends: Some(ends), ..Known::default() })
        };
        way(&[[&place([0.25, 0.5], 5), &place(ends, segments)]])
    }

    #[test]
    fn the_way_of_free_ends_is_measured_by_the_length() {
        let near = |found: Option<f64>, wanted: f64| assert!((found.expect("as many") - wanted).abs() < 1e-12, "{found:?}");
        near(way_to([0.25, 0.5], 5, EndRule::Free), 0.0);
        near(way_to([0.2, 0.5], 5, EndRule::Free), 0.1 / 0.5);
        near(way_to([0.3, 0.8], 5, EndRule::Free), 0.6 / 0.5);
        assert_eq!(way_to([0.25, 0.5], 4, EndRule::Free), None, "other segments");
    }

    #[test]
    fn ends_are_left_to_move_by_what_is_asked_for() {
        let asked = |quantities: &[Quantity], tolerance: f64| {
            let goals = quantities.iter().map(|quantity| Goal { quantity: quantity.clone(), tolerance }).collect();
            most_left(Some(&Accuracy { goals, most_unknowns: None, most_seconds: None }))
        };
        let force = Quantity::Force("seam".into());
        assert_eq!(asked(&[force.clone(), force.clone()], 1e-2), 1.6e-2);
        assert_eq!(asked(&[force.clone(), Quantity::Energy], 1e-2), MOST_LEFT, "so does the energy norm");
        assert_eq!(asked(std::slice::from_ref(&force), 1e-6), MOST_LEFT);
        assert_eq!(asked(&[force, Quantity::Ends("seam".into())], 1e-2), MOST_LEFT, "ends feel all of it");
        assert_eq!(most_left(None), MOST_LEFT);
    }
}
