//! The contact pressure against exact values.

use crate::geometry::{Formula, Point, gauss_points};
use crate::system::Contact;

/// Pressure at the foot of a point on Γ_C; at a segment end the mean of both values.
pub fn pressure_at(contact: &Contact, lambda: &[f64], x: Point) -> f64 {
    let knots = contact.boundary.knots();
    let t = contact.boundary.foot(x).clamp(knots[0], knots[knots.len() - 1]);
    let (k, z) = contact.boundary.locate(t);
    let near = 1e-9;
    let here = contact.multipliers.value(lambda, k, z.clamp(0.0, 1.0));
    if z < near && k > 0 {
        0.5 * (here + contact.multipliers.value(lambda, k - 1, 1.0))
    } else if z > 1.0 - near && k + 1 < contact.boundary.segments() {
        0.5 * (here + contact.multipliers.value(lambda, k + 1, 0.0))
    } else {
        here
    }
}

/// Relative L2 error of the pressure on Γ_C against a formula of `x, y`.
pub fn pressure_error(contact: &Contact, lambda: &[f64], exact: &Formula) -> f64 {
    let mut sums = [0.0; 2];
    for (k, ends) in contact.boundary.knots().windows(2).enumerate() {
        for (z, weight) in gauss_points(8) {
            let t = ends[0] + z * (ends[1] - ends[0]);
            let x = contact.boundary.point(t);
            let wanted = exact.value(&[x.x, x.y]);
            let ds = weight * (ends[1] - ends[0]) * contact.boundary.speed(t);
            sums[0] += ds * (contact.multipliers.value(lambda, k, *z) - wanted).powi(2);
            sums[1] += ds * wanted * wanted;
        }
    }
    (sums[0] / sums[1]).sqrt()
}
