//! Stiffness and stress of one triangle, straight or isoparametric.

use super::block::{Block, times};
use super::map::{BadJacobian, TriangleMap, jacobian, place_of};
use super::plane_law::{Heat, Plane, PlaneLaw, Strain};
use super::revolution;
use crate::geometry::Point;
use nalgebra::Matrix2;

/// A quadrature rule: barycentric coordinates and weights of sum 1.
pub type Rule = &'static [([f64; 3], f64)];

const CENTRE: Rule = &[([1.0 / 3.0; 3], 1.0)];

/// Degree 2.
const THREE: Rule = &[
    ([2.0 / 3.0, 1.0 / 6.0, 1.0 / 6.0], 1.0 / 3.0),
    ([1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0], 1.0 / 3.0),
    ([1.0 / 6.0, 1.0 / 6.0, 2.0 / 3.0], 1.0 / 3.0),
];

const A: f64 = 0.091_576_213_509_770_74;
const B: f64 = 0.445_948_490_915_964_9;
const WA: f64 = 0.109_951_743_655_321_87;
const WB: f64 = 0.223_381_589_678_011_47;

/// Degree 4. Dunavant, International Journal for Numerical Methods in Engineering 21 (1985), 1129-1148.
pub const SIX_POINTS: &[([f64; 3], f64); 6] = &[
    ([1.0 - 2.0 * A, A, A], WA),
    ([A, 1.0 - 2.0 * A, A], WA),
    ([A, A, 1.0 - 2.0 * A], WA),
    ([1.0 - 2.0 * B, B, B], WB),
    ([B, 1.0 - 2.0 * B, B], WB),
    ([B, B, 1.0 - 2.0 * B], WB),
];

/// Where these points lie in a triangle.
pub fn six_points<const N: usize>(nodes: &[Point; N]) -> [Point; 6] {
    SIX_POINTS.map(|(l, _)| place_of(nodes, l))
}

/// Rule for stiffness integrals of an `N`-node triangle: exact where it is straight, as P1 triangles always are, of degree 4
/// where a P2 triangle is curved.
fn stiffness_rule<const N: usize>(straight: bool) -> Rule {
    match (N, straight) {
        (3, _) => CENTRE,
        (_, true) => THREE,
        (_, false) => SIX_POINTS,
    }
}

/// Looks at the map of a bent triangle wherever [`stiffness`] does.
///
/// # Errors
/// [`BadJacobian`] if it folds over there.
pub fn check_map<const N: usize>(nodes: &[Point; N]) -> Result<(), BadJacobian> {
    check_corners(nodes)?;
    stiffness_rule::<N>(false).iter().try_for_each(|&(l, _)| jacobian(nodes, l).map(|_| ()))
}

/// A quadratic map may fold over at a corner before it does inside.
fn check_corners<const N: usize>(nodes: &[Point; N]) -> Result<(), BadJacobian> {
    let corners: &[[f64; 3]] = if N == 6 { &[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]] } else { &[] };
    corners.iter().try_for_each(|&corner| jacobian(nodes, corner).map(|_| ()))
}

/// Stiffness of a triangle of unit thickness, `K_ab = ∫ λ g_a ⊗ g_b + μ (g_b ⊗ g_a + g_a·g_b I)` with `g_a = ∇N_a`; that of a
/// body of revolution is told in `revolution.rs`.
///
/// | argument | shape | unit |
/// |---|---|---|
/// | `nodes` | corners counter-clockwise, then midsides | length |
/// | returns | `N x N` blocks of 2 x 2 | stress (force per length and thickness); force per length for a ring |
///
/// # Errors
/// [`BadJacobian`] if the map folds over at a quadrature point or, for P2, at a corner.
/// # Source
/// Zienkiewicz and Taylor, The Finite Element Method, vol. 1, plane elasticity.
pub fn stiffness<const N: usize>(nodes: &[Point; N], law: &PlaneLaw, straight: bool) -> Result<[[Block; N]; N], BadJacobian> {
    if !straight {
        check_corners(nodes)?;
    }
    if law.plane == Plane::Revolution {
        return revolution::stiffness(nodes, law);
    }
    let mut k = [[[[0.0; 2]; 2]; N]; N];
    let map = TriangleMap::new(nodes, straight)?;
    for &(l, weight) in stiffness_rule::<N>(straight) {
        let (gradients, determinant) = map.at(l)?;
        let (lambda, mu) = (0.5 * weight * determinant * law.lambda, 0.5 * weight * determinant * law.mu);
        for (row, a) in k.iter_mut().zip(&gradients) {
            for (block, b) in row.iter_mut().zip(&gradients) {
                let shear = mu * a.dot(b);
                block[0][0] += (lambda + mu) * a.x * b.x + shear;
                block[0][1] += lambda * a.x * b.y + mu * a.y * b.x;
                block[1][0] += lambda * a.y * b.x + mu * a.x * b.y;
                block[1][1] += (lambda + mu) * a.y * b.y + shear;
            }
        }
    }
    Ok(k)
}

/// Internal forces `∫σ:∇N_a` of the nodal displacements `u` (force per thickness; of the whole ring in a body of revolution): the
/// product of the [`stiffness`] with them.
///
/// # Errors
/// [`BadJacobian`] if the map folds over at a quadrature point.
pub fn internal_forces<const N: usize>(
    nodes: &[Point; N],
    u: &[Point; N],
    law: &PlaneLaw,
    straight: bool,
) -> Result<[Point; N], BadJacobian> {
    let mut forces = [Point::zeros(); N];
    if law.plane == Plane::Revolution {
        for (force, row) in forces.iter_mut().zip(revolution::stiffness(nodes, law)?) {
            *force = row.iter().zip(u).map(|(block, u)| times(block, u)).sum();
        }
        return Ok(forces);
    }
    let map = TriangleMap::new(nodes, straight)?;
    for &(l, weight) in stiffness_rule::<N>(straight) {
        let (gradients, determinant) = map.at(l)?;
        let gradient = u.iter().zip(&gradients).fold(Matrix2::zeros(), |sum, (u, g)| sum + u * g.transpose());
        let [xx, yy, xy, _] = law.stress(&Strain { gradient, hoop: 0.0 }).map(|stress| 0.5 * weight * determinant * stress);
        for (force, g) in forces.iter_mut().zip(&gradients) {
            *force += Point::new(xx * g.x + xy * g.y, xy * g.x + yy * g.y);
        }
    }
    Ok(forces)
}

/// Strain of the nodal displacements `u` at barycentric coordinates `l`, and the Jacobian determinant there.
///
/// # Errors
/// [`BadJacobian`] where the map folds over.
pub fn strain<const N: usize>(
    nodes: &[Point; N],
    u: &[Point; N],
    l: [f64; 3],
    law: &PlaneLaw,
) -> Result<(Strain, f64), BadJacobian> {
    let (gradients, determinant) = jacobian(nodes, l)?;
    let gradient = u.iter().zip(&gradients).fold(Matrix2::zeros(), |sum, (u, g)| sum + u * g.transpose());
    let hoop = if law.plane == Plane::Revolution { revolution::hoop_strain(nodes, u, l, &gradient) } else { 0.0 };
    Ok((Strain { gradient, hoop }, determinant))
}

/// Strain energy of the nodal displacements `u` (energy per thickness; of the whole ring in a body of revolution), and where in
/// the triangle it lies: at three points, one near each corner, given by their barycentric coordinates.
///
/// # Errors
/// [`BadJacobian`] where the map folds over.
pub fn energies<const N: usize>(nodes: &[Point; N], u: &[Point; N], law: &PlaneLaw) -> Result<[([f64; 3], f64); 3], BadJacobian> {
    let mut found = [([0.0; 3], 0.0); 3];
    for (place, &(l, weight)) in found.iter_mut().zip(THREE) {
        let (strain, determinant) = strain(nodes, u, l, law)?;
        let width = law.plane.width(place_of(nodes, l));
        *place = (l, 0.25 * weight * determinant * width * strain.work(law.stress(&strain)));
    }
    Ok(found)
}

/// Stress (xx, yy, xy, zz) of the nodal displacements `u` at barycentric coordinates `l`, without that of heat.
///
/// # Errors
/// [`BadJacobian`] where the map folds over.
pub fn stress<const N: usize>(nodes: &[Point; N], u: &[Point; N], l: [f64; 3], law: &PlaneLaw) -> Result<[f64; 4], BadJacobian> {
    Ok(law.stress(&strain(nodes, u, l, law)?.0))
}

/// Stress (xx, yy, xy, zz) of the nodal displacements `u` and of heat at barycentric coordinates `l`.
///
/// # Errors
/// [`BadJacobian`] where the map folds over.
pub fn heated_stress<const N: usize>(
    nodes: &[Point; N],
    u: &[Point; N],
    l: [f64; 3],
    law: &PlaneLaw,
    heat: Option<&Heat>,
) -> Result<[f64; 4], BadJacobian> {
    Ok(law.heated(stress(nodes, u, l, law)?, heat, place_of(nodes, l)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const LAW: PlaneLaw = PlaneLaw { lambda: 2.0, mu: 1.5, across: 2.0, plane: Plane::Strain };

    /// A P2 triangle with all midsides moved a little.
    fn curved() -> [Point; 6] {
        let (a, b, c) = (Point::new(0.0, 0.1), Point::new(1.2, 0.0), Point::new(0.3, 0.9));
        let middle = |p: Point, q: Point, dx: f64, dy: f64| 0.5 * (p + q) + Point::new(dx, dy);
        [a, b, c, middle(a, b, 0.02, -0.05), middle(b, c, 0.06, 0.04), middle(c, a, -0.03, 0.0)]
    }

    fn energy<const N: usize>(k: &[[Block; N]; N], u: &[Point; N]) -> f64 {
        let mut sum = 0.0;
        for a in 0..N {
            for b in 0..N {
                for (i, row) in k[a][b].iter().enumerate() {
                    sum += u[a][i] * (row[0] * u[b].x + row[1] * u[b].y);
                }
            }
        }
        0.5 * sum
    }

    #[test]
    fn rigid_motions_store_no_energy_even_on_curved_triangles() {
        let nodes = curved();
        let k = stiffness(&nodes, &LAW, false).expect("a good triangle");
        let scale = k[0][0][0][0];
        for motion in [|_: Point| Point::new(1.0, 0.0), |_: Point| Point::new(0.0, 1.0), |x: Point| Point::new(-x.y, x.x)] {
            assert!(energy(&k, &nodes.map(motion)).abs() < 1e-14 * scale);
        }
    }

    #[test]
    fn internal_forces_are_the_product_of_the_stiffness_with_the_displacement() {
        fn check<const N: usize>(nodes: [Point; N], straight: bool) {
            for plane in [Plane::Strain, Plane::Stress, Plane::Revolution] {
                let law = PlaneLaw::new(2.0, 0.3, plane);
                let u: [Point; N] = std::array::from_fn(|a| Point::new((2.0 * a as f64).sin(), (a as f64).cos()));
                let k = stiffness(&nodes, &law, straight).expect("a good triangle");
                for (force, row) in internal_forces(&nodes, &u, &law, straight).expect("a good triangle").iter().zip(&k) {
                    let product: Point = row.iter().zip(&u).map(|(block, u)| times(block, u)).sum();
                    assert!((force - product).norm() < 1e-13 * k[0][0][0][0].abs(), "{plane:?}, {N} nodes");
                }
            }
        }
        let corners = [Point::new(0.0, 0.1), Point::new(1.2, 0.0), Point::new(0.3, 0.9)];
        check(corners, true);
        check(
            std::array::from_fn::<Point, 6, _>(
                |a| if a < 3 { corners[a] } else { 0.5 * (corners[a - 3] + corners[(a - 2) % 3]) },
            ),
            true,
        );
        check(curved(), false);
    }

    #[test]
    fn a_linear_field_has_its_exact_stress_everywhere() {
        let nodes = curved();
        let u = nodes.map(|x| Point::new(0.3 * x.x - 0.1 * x.y, 0.2 * x.x + 0.5 * x.y));
        let exact = LAW.stress(&Strain { gradient: Matrix2::new(0.3, -0.1, 0.2, 0.5), hoop: 0.0 });
        for &(l, _) in SIX_POINTS {
            let found = stress(&nodes, &u, l, &LAW).expect("a good triangle");
            assert!(found.iter().zip(exact).all(|(a, b)| (a - b).abs() < 1e-13));
        }
    }

    #[test]
    fn an_inverted_triangle_is_refused_with_its_place() {
        let mut nodes = curved();
        nodes[3] = Point::new(0.5, 0.8);
        assert!(stiffness(&nodes, &LAW, false).unwrap_err().jacobian <= 0.0);
        let clockwise = [Point::new(0.0, 0.0), Point::new(0.0, 1.0), Point::new(1.0, 0.0)];
        assert!(stiffness(&clockwise, &LAW, true).is_err());
    }

    #[test]
    fn the_rules_are_exact_for_their_degree() {
        let exact = |p: i32, q: i32| {
            let f = |n: i32| (1..=n).product::<i32>() as f64;
            2.0 * f(p) * f(q) / f(p + q + 2)
        };
        for (rule, degree) in [(CENTRE, 1), (THREE, 2), (SIX_POINTS, 4)] {
            for p in 0..=degree {
                for q in 0..=degree - p {
                    let sum: f64 = rule.iter().map(|(l, w)| w * l[1].powi(p) * l[2].powi(q)).sum();
                    assert!((sum / exact(p, q) - 1.0).abs() < 1e-13, "degree {degree}: x^{p} y^{q}");
                }
            }
        }
    }

    proptest! {
        /// In the plane the stiffness depends on the shape of a triangle, not on its size: one matrix serves every level.
        #[test]
        fn stiffness_does_not_depend_on_size(x in 0.2f64..2.0, y in 0.2f64..2.0, size in 1e-6f64..1e6) {
            let one = [Point::new(0.0, 0.0), Point::new(1.0, 0.1), Point::new(0.3 * x, y)];
            let a = stiffness(&one, &LAW, true).expect("a good triangle");
            let b = stiffness(&one.map(|p| p * size), &LAW, true).expect("a good triangle");
            for (a, b) in a.iter().flatten().flatten().flatten().zip(b.iter().flatten().flatten().flatten()) {
                prop_assert!((a - b).abs() <= 1e-12 * (1.0 + a.abs()));
            }
        }
    }
}
