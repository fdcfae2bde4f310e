//! What a solution says of the next contact boundary.

use crate::contact::MultiplierSpace;
use crate::discretisation::{Contact, ContactPressure, Solution};
use crate::system::Start;

/// A start from a solution, on the boundary it was found on.
pub fn start_from(solution: &Solution) -> Start {
    let Solution { displacement, multipliers, active, .. } = solution;
    Start { displacement: displacement.clone(), pressures: multipliers.clone(), active: active.clone() }
}

/// A start from a solution on the next boundaries: pressures and states stay with their segments where these are as many as before,
/// and with their places where they are not.
pub fn carried(before: &[Contact], after: &[Contact], solution: &Solution) -> Start {
    let mut start = Start { displacement: solution.displacement.clone(), pressures: Vec::new(), active: Vec::new() };
    for (old, new) in before.iter().zip(after) {
        if old.multipliers.count() == new.multipliers.count() {
            start.pressures.extend_from_slice(&solution.multipliers[old.range()]);
            start.active.extend_from_slice(&solution.active[old.range()]);
        } else {
            let (pressures, active) = by_place(old, new, (&solution.multipliers, &solution.active));
            start.pressures.extend(pressures);
            start.active.extend(active);
        }
    }
    start
}

/// Pressures and states of the multipliers of a contact cut anew, or moved a little: those at the same places before, of all contacts
/// numbered through.
pub fn by_place(old: &Contact, new: &Contact, (multipliers, active): (&[f64], &[bool])) -> (Vec<f64>, Vec<bool>) {
    let knots = new.boundary.knots();
    let place = |i: usize| match new.multipliers.space {
        MultiplierSpace::P0 => 0.5 * (knots[i] + knots[i + 1]),
        MultiplierSpace::P1Continuous => knots[i],
        // A little inside, where the segment is known.
        MultiplierSpace::P1Discontinuous => {
            let [a, b] = [knots[i / 2], knots[i / 2 + 1]];
            if i.is_multiple_of(2) { a + 1e-3 * (b - a) } else { b - 1e-3 * (b - a) }
        }
    };
    let at = |i: usize| {
        let (segment, z) = old.boundary.locate(old.boundary.foot(new.boundary.point(place(i))));
        let z = z.clamp(0.0, 1.0);
        let rows = old.multipliers.on_segment(segment, 0.0).0;
        let carries = active[old.first + if z < 0.5 { rows[0] } else { rows[1] }];
        let pressure = ContactPressure::new(old, multipliers, active).value(segment, z);
        (if carries { pressure } else { 0.0 }, carries)
    };
    (0..new.multipliers.count()).map(at).unzip()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::Known;
    use crate::discretisation::samples::{blocks, contact, pair};
    use crate::geometry::Point;

    /// One contact of two that is cut anew must not take from the other what was found there.
    #[test]
    fn pressures_stay_with_their_segments_or_else_with_their_places() {
        let on = |segments: usize, first: usize| {
            let scene = blocks(pair(MultiplierSpace::P0, segments), |_| Point::zeros(), Vec::new());
            Contact { first, ..contact(&scene, Known::default()) }
        };
        let multipliers = vec![1.0, 2.0, 3.0, 0.0, 5.0, 6.0];
        let active = vec![true, true, true, false, true, true];
        let solution =
            Solution { displacement: vec![0.5], multipliers, active, residual: 0.0, plain_residual: 0.0, inf_sup: Vec::new() };
        let start = carried(&[on(4, 0), on(2, 4)], &[on(8, 0), on(2, 8)], &solution);
        assert_eq!(start.displacement, [0.5]);
        assert_eq!(start.pressures, [1.0, 1.0, 2.0, 2.0, 3.0, 3.0, 0.0, 0.0, 5.0, 6.0]);
        let states = [true, true, true, true, true, true, false, false, true, true];
        assert_eq!(start.active, states);
    }
}
