//! The map from the reference triangle to one of the mesh, straight or isoparametric.

use super::shape::{shape, slopes};
use crate::geometry::{Coordinates, Point};
use nalgebra::Matrix2;

/// A triangle whose map from the reference triangle folds over.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("the triangle around {} is turned inside out (Jacobian {jacobian:.3e})", Coordinates(*middle))]
pub struct BadJacobian {
    /// Mean of its corners.
    pub middle: Point,
    /// Smallest Jacobian determinant found.
    pub jacobian: f64,
}

/// The place of barycentric coordinates in a triangle.
pub fn place_of<const N: usize>(nodes: &[Point; N], l: [f64; 3]) -> Point {
    nodes.iter().zip(shape::<N>(l)).fold(Point::zeros(), |sum, (node, value)| sum + value * node)
}

/// Derivatives of the shape functions by x and y at barycentric coordinates `l`, and the Jacobian determinant
/// (twice the area for a straight triangle).
///
/// # Errors
/// [`BadJacobian`] if the determinant is not positive.
pub fn jacobian<const N: usize>(nodes: &[Point; N], l: [f64; 3]) -> Result<([Point; N], f64), BadJacobian> {
    let reference = slopes::<N>(l);
    let mut j = Matrix2::zeros();
    for (x, d) in nodes.iter().zip(&reference) {
        j += Matrix2::new(x.x * d[0], x.x * d[1], x.y * d[0], x.y * d[1]);
    }
    let determinant = j.determinant();
    if determinant <= 0.0 || !determinant.is_finite() {
        return Err(BadJacobian { middle: (nodes[0] + nodes[1] + nodes[2]) / 3.0, jacobian: determinant });
    }
    let (a, b, c, d) = (j[(0, 0)], j[(0, 1)], j[(1, 0)], j[(1, 1)]);
    let gradients = reference.map(|[r, s]| Point::new((d * r - c * s) / determinant, (a * s - b * r) / determinant));
    Ok((gradients, determinant))
}

/// The map from the reference triangle to one of the mesh at several of its points: that of a straight triangle is the same everywhere.
pub struct TriangleMap<'a, const N: usize> {
    nodes: &'a [Point; N],
    /// Gradients of the reference coordinates and the Jacobian determinant, if the triangle is straight.
    straight: Option<([Point; 2], f64)>,
}

impl<'a, const N: usize> TriangleMap<'a, N> {
    /// Of a triangle, with its midsides in the middles of its sides where it is straight.
    ///
    /// # Errors
    /// As [`jacobian`].
    pub fn new(nodes: &'a [Point; N], is_straight: bool) -> Result<Self, BadJacobian> {
        let of_corners = || jacobian(&[nodes[0], nodes[1], nodes[2]], [1.0, 0.0, 0.0]);
        let straight = is_straight.then(of_corners).transpose()?.map(|([_, xi, eta], determinant)| ([xi, eta], determinant));
        Ok(Self { nodes, straight })
    }

    /// As [`jacobian`].
    ///
    /// # Errors
    /// Likewise.
    #[inline]
    pub fn at(&self, l: [f64; 3]) -> Result<([Point; N], f64), BadJacobian> {
        let Some(([xi, eta], determinant)) = self.straight else { return jacobian(self.nodes, l) };
        Ok((slopes::<N>(l).map(|[r, s]| xi * r + eta * s), determinant))
    }
}
