//! What contacts take up of each other's forces once these have turned with the bodies.
//!
//! On undeformed bodies a contact presses along normals of Γ_C. Where a body rolls or slides along it, the sides have another normal in
//! common, and their force turns by the angle between. On a body that supports hold that goes to the supports. A free body is in balance by
//! its other contacts, and beside a large force that turns a little a small one is wrong by much: of a rocker of radius 4 on a stiff flat,
//! under 20 off its centre by .1, that .4 push onto a wall, the wall had .0988, and 3.05 of itself too little by this estimate.

use crate::contact::FiniteMotion;
use crate::discretisation::{Discretisation, shifts_held_by_supports};
use crate::element::Plane;
use crate::geometry::Point;
use nalgebra::Matrix2;

/// Resistance to a shift, by the largest, that counts as none: contacts whose normals are parallel but for rounding, and for what a mesh
/// file with six digits makes of them, hold nothing across.
const NOTHING: f64 = 1e-6;

/// For each contact what it takes up on either of its bodies, the larger one, by its own force; zero where nothing presses. Forces of the
/// contacts of a body change as little as balance of its shifts allows, together with those of supports that see them.
pub fn direction_errors(problem: &Discretisation, motions: &[Option<&FiniteMotion>]) -> Vec<f64> {
    let contacts = &problem.contacts;
    // A body of revolution is shifted along its axis alone.
    let shifted =
        if problem.scene.mesh.plane == Plane::Revolution { Matrix2::new(0.0, 0.0, 0.0, 1.0) } else { Matrix2::identity() };
    let resistance = |motion: &FiniteMotion| shifted * motion.normals * shifted / motion.force;
    let mut of_body: Vec<Vec<(usize, &FiniteMotion, f64)>> = vec![Vec::new(); problem.scene.bodies.len()];
    for (at, motion) in motions.iter().enumerate() {
        let Some(motion) = motion.filter(|motion| motion.force > 0.0) else { continue };
        contacts[at].bodies.into_iter().zip([1.0, -1.0]).for_each(|(body, sign)| of_body[body].push((at, motion, sign)));
    }
    let mut errors = vec![0.0; contacts.len()];
    for (own, held) in of_body.iter().zip(shifts_held_by_supports(&problem.scene)) {
        let Some(held) = held else { continue };
        let all = own.iter().map(|(_, motion, _)| resistance(motion)).sum::<Matrix2<f64>>() + held;
        let turned: Point = own.iter().map(|(_, motion, sign)| *sign * shifted * motion.turned).sum();
        let shift = shift_by(all, turned);
        for &(at, motion, _) in own {
            errors[at] = f64::max(errors[at], (resistance(motion) * shift).norm() / motion.force);
        }
    }
    errors
}

/// The smallest shift that is resisted by a force; none of it where nothing resists.
fn shift_by(resistance: Matrix2<f64>, force: Point) -> Point {
    let eigen = resistance.symmetric_eigen();
    let least = NOTHING * eigen.eigenvalues.max();
    let along = |k: usize| {
        let axis: Point = eigen.eigenvectors.column(k).into();
        if eigen.eigenvalues[k] > least { axis.dot(&force) / eigen.eigenvalues[k] * axis } else { Point::zeros() }
    };
    along(0) + along(1)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A bar between two flanks with the normals (±.8, .6): flanks share a force along the bar, and a force across it they take by 1/1.6.
    /// Between two parallel plates a roller that is pushed along them takes up nothing.
    #[test]
    fn a_wedge_takes_up_more_than_it_is_pushed_by() {
        let shift = |normals: [Point; 2], force| shift_by(normals.map(|n| n * n.transpose()).into_iter().sum(), force);
        let flanks = [Point::new(0.8, 0.6), Point::new(-0.8, 0.6)];
        let taken = |force| flanks.map(|normal| normal.dot(&shift(flanks, force)));
        for (force, wanted) in [(Point::y(), [1.0 / 1.2; 2]), (Point::x(), [1.0 / 1.6, -1.0 / 1.6])] {
            taken(force)
                .into_iter()
                .zip(wanted)
                .for_each(|(found, wanted)| assert!((found - wanted).abs() < 1e-12, "{found} for {wanted}"));
        }
        let plates = [Point::y(), -Point::y()];
        assert_eq!(shift(plates, Point::x()), Point::zeros());
        assert_eq!(shift(plates, Point::y()), Point::new(0.0, 0.5));
    }
}
