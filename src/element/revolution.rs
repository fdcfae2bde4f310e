//! Stiffness of a triangle that is turned about the axis x = 0: a ring, with hoop strains `u_x / x`.
//!
//! `K_ab = 2π ∫ x [λ d_a ⊗ d_b + μ (g_b ⊗ g_a + g_a·g_b I + 2 h_a h_b e_x ⊗ e_x)]` with `g_a = ∇N_a`, `h_a = N_a / x` and
//! `d_a = g_a + h_a e_x`. The terms with `x h_a h_b = N_a N_b / x` are no polynomials. The rule is that of Gauss in both
//! coordinates of a square which is collapsed into the corner that lies nearest to the axis: where this one lies on it, `x` is a
//! product of the first coordinate and a linear function of the second, by which the couplings of the other nodes have no pole,
//! nor have those of a node off the axis where two corners lie on it. Entries of the radial displacement of nodes on the axis are
//! finite and mean nothing: it is held to zero.

use super::block::Block;
use super::map::{BadJacobian, jacobian, place_of};
use super::plane_law::PlaneLaw;
use super::shape::shape;
use crate::geometry::{Point, gauss_points};
use nalgebra::Matrix2;
use std::f64::consts::TAU;

/// Error of an integral of `1/x`, relative to it, that rounding does not tell.
const ROUNDING: f64 = 1e-13;

/// Most points in one direction: enough for radii as 1 to 6.
const MOST_POINTS: usize = 20;

/// Share of the largest radius of an element within which a place lies on the axis: beside it `u_x / x` has lost as many digits as
/// rounding has of `x`, which leaves six here.
const ON_AXIS: f64 = 1e-10;

/// Hoop strain `u_x / x` at barycentric coordinates `l`, on the axis its limit `∂u_x/∂x`.
pub(super) fn hoop_strain<const N: usize>(nodes: &[Point; N], u: &[Point; N], l: [f64; 3], gradient: &Matrix2<f64>) -> f64 {
    let radius = place_of(nodes, l).x;
    let largest = nodes.iter().map(|node| node.x).fold(0.0, f64::max);
    match radius > ON_AXIS * largest {
        true => u.iter().zip(shape::<N>(l)).map(|(u, value)| value * u.x).sum::<f64>() / radius,
        false => gradient[(0, 0)],
    }
}

/// Stiffness of the whole ring (force per length), as that of a triangle in the plane.
///
/// # Errors
/// [`BadJacobian`] if the map folds over at a quadrature point.
pub(super) fn stiffness<const N: usize>(nodes: &[Point; N], law: &PlaneLaw) -> Result<[[Block; N]; N], BadJacobian> {
    let mut k = [[[[0.0; 2]; 2]; N]; N];
    let (first, points) = rule(nodes);
    for (&(s, ws), &(t, wt)) in gauss_points(points).iter().flat_map(|s| gauss_points(points).iter().map(move |t| (s, t))) {
        let mut l = [0.0; 3];
        (l[first], l[(first + 1) % 3], l[(first + 2) % 3]) = (1.0 - s, s * (1.0 - t), s * t);
        let (gradients, determinant) = jacobian(nodes, l)?;
        let values = shape::<N>(l);
        let radius = place_of(nodes, l).x;
        let weight = TAU * radius * ws * wt * s * determinant;
        add_point(&mut k, &gradients, &values.map(|value| value / radius), weight * law.lambda, weight * law.mu);
    }
    Ok(k)
}

/// Adds what one point of the rule sees: gradients and hoop strains of the shape functions, and the constants of the law times the
/// weight of the point.
fn add_point<const N: usize>(k: &mut [[Block; N]; N], gradients: &[Point; N], hoops: &[f64; N], lambda: f64, mu: f64) {
    for ((row, a), ha) in k.iter_mut().zip(gradients).zip(hoops) {
        for ((block, b), hb) in row.iter_mut().zip(gradients).zip(hoops) {
            let (da, db) = (a.x + ha, b.x + hb);
            block[0][0] += lambda * da * db + mu * (2.0 * (a.x * b.x + ha * hb) + a.y * b.y);
            block[0][1] += lambda * da * b.y + mu * a.y * b.x;
            block[1][0] += lambda * a.y * db + mu * a.x * b.y;
            block[1][1] += (lambda + 2.0 * mu) * a.y * b.y + mu * a.x * b.x;
        }
    }
}

/// The corner that is nearest to the axis, and how many points the rule takes in each direction.
///
/// The error of `n` points of Gauss for a polynomial of degree `m` times `1/x` between two radii falls as `ρ^(m - 2 n)`, where
/// `ρ = (√b + √a) / (√b - √a)` is the sum of the half axes of the ellipse through the pole (Trefethen, Approximation Theory and
/// Approximation Practice, theorem 19.3).
fn rule<const N: usize>(nodes: &[Point; N]) -> (usize, usize) {
    let radii = [0, 1, 2].map(|k: usize| nodes[k].x);
    let first = (0..3).min_by(|&a, &b| radii[a].total_cmp(&radii[b])).unwrap_or(0);
    let largest = radii.into_iter().fold(0.0, f64::max);
    let off_axis = radii.into_iter().filter(|&radius| radius > ON_AXIS * largest).fold(largest, f64::min);
    let (inner, outer) = (off_axis.sqrt(), largest.sqrt());
    // A square of the shape functions' degree, and the weight of the collapsed square.
    let degree = if N == 3 { 3 } else { 5 };
    let ellipse = (outer + inner) / (outer - inner).max(f64::MIN_POSITIVE);
    let more = (-ROUNDING.ln() / ellipse.ln()).ceil();
    let points = 0.5 * (f64::from(degree) + more.min(100.0));
    (first, (points.ceil() as usize).clamp(3, MOST_POINTS))
}

#[cfg(test)]
mod tests {
    use super::super::plane_law::Plane;
    use super::*;

    /// A P2 triangle of these corners with straight sides.
    fn with_midsides([a, b, c]: [Point; 3]) -> [Point; 6] {
        [a, b, c, 0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)]
    }

    /// Triangles far from the axis, near it, with a corner on it, and with a side on it, each with the nodes that lie off it.
    fn triangles() -> [([Point; 6], Vec<usize>); 4] {
        let of = |corners: [[f64; 2]; 3]| {
            let nodes = with_midsides(corners.map(Point::from));
            (nodes, (0..6).filter(|&a| nodes[a].x > 0.0).collect())
        };
        [
            of([[5.0, 0.0], [6.0, 0.2], [5.3, 0.9]]),
            of([[0.5, 0.0], [1.5, 0.2], [0.8, 0.9]]),
            of([[1.0, 0.0], [0.6, 0.8], [0.0, 0.1]]),
            of([[0.0, 0.0], [1.0, 0.3], [0.0, 0.9]]),
        ]
    }

    /// The stiffness by a rule that is far finer than any that is used.
    fn fine(nodes: &[Point; 6], law: &PlaneLaw) -> [[Block; 6]; 6] {
        let mut k = [[[[0.0; 2]; 2]; 6]; 6];
        let first = rule(nodes).0;
        for (&(s, ws), &(t, wt)) in gauss_points(20).iter().flat_map(|s| gauss_points(20).iter().map(move |t| (s, t))) {
            let mut l = [0.0; 3];
            (l[first], l[(first + 1) % 3], l[(first + 2) % 3]) = (1.0 - s, s * (1.0 - t), s * t);
            let (gradients, determinant) = jacobian(nodes, l).expect("a good triangle");
            let radius = place_of(nodes, l).x;
            let weight = TAU * radius * ws * wt * s * determinant;
            let hoops = shape::<6>(l).map(|value| value / radius);
            add_point(&mut k, &gradients, &hoops, weight * law.lambda, weight * law.mu);
        }
        k
    }

    #[test]
    fn integrals_are_exact_to_rounding_wherever_the_radius_varies() {
        let law = PlaneLaw::new(3.0, 0.3, Plane::Revolution);
        for (nodes, off_axis) in triangles() {
            let (found, wanted) = (stiffness(&nodes, &law).expect("a good triangle"), fine(&nodes, &law));
            let size = off_axis.iter().map(|&a| wanted[a][a][0][0].abs()).fold(0.0, f64::max);
            for (a, b) in off_axis.iter().flat_map(|&a| off_axis.iter().map(move |&b| (a, b))) {
                for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                    let apart = (found[a][b][i][j] - wanted[a][b][i][j]).abs();
                    assert!(apart < 1e-12 * size, "{nodes:?}: nodes {a}, {b}: {apart:e} of {size}");
                }
            }
        }
    }

    #[test]
    fn a_shift_along_the_axis_has_no_force_and_a_radial_growth_its_hoop_stress() {
        let law = PlaneLaw::new(3.0, 0.3, Plane::Revolution);
        for (nodes, off_axis) in triangles() {
            let k = stiffness(&nodes, &law).expect("a good triangle");
            // Radial growth by 1 with `ε_yy = -2 ν/(1 - ν)` has no stress along the axis.
            let u = nodes.map(|x| Point::new(x.x, -2.0 * 0.3 / 0.7 * x.y));
            for &a in &off_axis {
                let along: Point = (0..6).map(|b| Point::new(k[a][b][0][1], k[a][b][1][1])).sum();
                assert!(along.norm() < 1e-12 * k[a][a][0][0].abs());
                let axial: f64 = (0..6).map(|b| k[a][b][1][0] * u[b].x + k[a][b][1][1] * u[b].y).sum();
                assert!(axial.abs() < 1e-11, "no stress along the axis: {axial:e}");
            }
            let strain = super::super::stiffness::strain(&nodes, &u, [0.2, 0.3, 0.5], &law).expect("a good triangle").0;
            assert!((strain.hoop - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn the_hoop_strain_has_its_limit_on_the_axis() {
        let (nodes, _) = &triangles()[3];
        let law = PlaneLaw::new(3.0, 0.3, Plane::Revolution);
        let u = nodes.map(|x| Point::new(0.7 * x.x + 0.2 * x.x * x.y, 0.0));
        for (l, y) in [([1.0, 0.0, 0.0], 0.0), ([0.5, 0.0, 0.5], 0.45)] {
            let strain = super::super::stiffness::strain(nodes, &u, l, &law).expect("a good triangle").0;
            assert!((strain.hoop - 0.7 - 0.2 * y).abs() < 1e-12, "{}", strain.hoop);
        }
    }
}
