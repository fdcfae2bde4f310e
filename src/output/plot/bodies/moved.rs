//! What moves along with the bodies.

use super::facets::{FacetCorner, displacement_near};
use crate::output::data::ContactPoint;
use crate::output::plot::diagrams::DrawnContact;
use crate::output::plot::drawing::{INK, Paint, WHITE};

/// Points of a contact boundary that are drawn at most, up to a factor of two.
const MOST_POINTS: usize = 1000;

/// How a contact boundary is drawn: lines that lie on each other.
pub const CONTACT: [Paint; 2] = [Paint::line(INK, 3.0), Paint::line(WHITE, 1.4)];

/// A contact boundary moved along with the bodies; of many points so many that none is missed.
pub fn moved_contact(contact: &DrawnContact, boundary: &[[FacetCorner; 2]], scale: f64) -> Vec<[f64; 2]> {
    some_of(contact.points, MOST_POINTS)
        .map(|p| moved_point(contact, p, boundary, scale))
        .filter(|x| x.iter().all(|x| x.is_finite()))
        .collect()
}

/// About so many of the points, spread over all of them, with the first and the last.
pub fn some_of<T>(points: &[T], most: usize) -> impl Iterator<Item = &T> {
    let (every, last) = (points.len().div_ceil(most).max(1), points.len().saturating_sub(1));
    points.iter().enumerate().filter(move |(k, _)| k % every == 0 || *k == last).map(|(_, point)| point)
}

/// One point of it: normal to the boundary by the mean of both bodies' normal displacements, along it with the nearest boundary.
pub fn moved_point(contact: &DrawnContact, p: &ContactPoint, boundary: &[[FacetCorner; 2]], scale: f64) -> [f64; 2] {
    let there = if contact.is_deformed { 1.0 } else { 0.0 };
    let u = displacement_near([p.x, p.y], boundary, there);
    let (along, across) = (p.nx * u[1] - p.ny * u[0], 0.5 * (p.un_1 + p.un_2));
    let left = scale - there;
    [p.x + left * (across * p.nx - along * p.ny), p.y + left * (across * p.ny + along * p.nx)]
}
