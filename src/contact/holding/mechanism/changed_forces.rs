//! By how much the forces of closed contacts change when a piece is pushed.

use super::{Condition, Extent, Holding, LEAST_HOLD, Touch};
use nalgebra::{DVector, Vector3};

/// For each closed contact the force by which it changes when a piece is pushed, with a moment about its middle by the radius, and the sum
/// of all that presses more there or less; where sides are curved what presses moves along them instead, and the sum of the force alone
/// counts (a disc of a pile had .07 of its force for 2e-5 by which it changes): what equilibrium says where that sets the forces, and
/// else of contacts that are alike. Nothing if supports and contacts do not resist the push, whichever body's normals count, or if a body
/// is to turn that may roll.
pub fn changed_forces(
    pieces: &[Extent],
    supports: &[Condition],
    contacts: &[Touch],
    (piece, push): (usize, [f64; 3]),
) -> Option<Vec<[f64; 2]>> {
    let holding = Holding::new(pieces, supports, contacts);
    let curved = holding.curved();
    // Where a round body presses, it goes on as it turns.
    let is_own = |condition: &Condition| condition.piece == piece || condition.against == Some(piece);
    let rolls = || curved.iter().any(|&at| contacts[at].iter().flatten().any(is_own));
    if push[..2] == [0.0; 2] && rolls() {
        return None;
    }
    let mut load = DVector::zeros(3 * pieces.len());
    load.fixed_rows_mut::<3>(3 * piece).copy_from(&Vector3::from(push));
    let mut changes = vec![[0.0_f64; 2]; contacts.len()];
    for choice in holding.bases(&curved) {
        let moved = holding.factor(&choice, None)?.solve(&load);
        // What is held by h of a unit motion gives way by 1/h² at most.
        if load.dot(&moved) > load.norm_squared() * LEAST_HOLD.powi(-2) {
            return None;
        }
        for (at, ((touch, &side), change)) in contacts.iter().zip(&choice).zip(&mut changes).enumerate() {
            let pressed = || touch[side].iter().map(|condition| condition.sees_of(&moved));
            let sum: f64 = pressed().sum();
            let size = if curved.contains(&at) { sum.abs() } else { pressed().map(f64::abs).sum() };
            if size > change[1] {
                *change = [sum, size];
            }
        }
    }
    Some(changes)
}

impl Condition {
    /// What it sees of a motion of all pieces, positive where the sides come closer.
    fn sees_of(&self, motion: &DVector<f64>) -> f64 {
        self.parts().map(|(piece, sees)| (0..3).map(|k| sees[k] * motion[3 * piece + k]).sum::<f64>()).sum()
    }
}
