//! Stress at all nodes of one triangle.

use super::map::{BadJacobian, jacobian};
use super::plane_law::{Heat, Plane, PlaneLaw, Strain};
use super::stiffness::heated_stress;
use crate::geometry::Point;
use nalgebra::Matrix2;

/// The nodes in barycentric coordinates: corners, then midsides.
const NODES: [[f64; 3]; 6] = [[1., 0., 0.], [0., 1., 0.], [0., 0., 1.], [0.5, 0.5, 0.], [0., 0.5, 0.5], [0.5, 0., 0.5]];

/// A midside that lies off the middle of its corners by a smaller share of their distances is there but for rounding.
const ROUNDING: f64 = 1e-12;

/// Stress (xx, yy, xy, zz) and Jacobian determinant at each node of a triangle.
///
/// # Errors
/// [`BadJacobian`] where the map folds over.
pub fn nodal_stresses<const N: usize>(
    nodes: &[Point; N],
    u: &[Point; N],
    law: &PlaneLaw,
    heat: Option<&Heat>,
) -> Result<[([f64; 4], f64); N], BadJacobian> {
    if heat.is_none() && law.plane != Plane::Revolution && (N == 3 || is_straight(nodes)) {
        let (slopes, determinant) = corner_slopes(nodes)?;
        return Ok(straight_stresses(u, &slopes, law).map(|stress| (stress, determinant)));
    }
    let mut found = [([0.0; 4], 0.0); N];
    for (found, l) in found.iter_mut().zip(NODES) {
        *found = (heated_stress(nodes, u, l, law, heat)?, jacobian(nodes, l)?.1);
    }
    Ok(found)
}

fn is_straight(nodes: &[Point]) -> bool {
    (0..3).all(|side| {
        let (a, b) = (nodes[side], nodes[(side + 1) % 3]);
        (nodes[3 + side] - 0.5 * (a + b)).amax() <= ROUNDING * (b - a).amax()
    })
}

/// Slopes by x and y of the barycentric coordinates of a straight triangle (1/length), and its Jacobian determinant.
///
/// # Errors
/// [`BadJacobian`] if it is turned inside out.
pub fn corner_slopes<const N: usize>(nodes: &[Point; N]) -> Result<([Point; 3], f64), BadJacobian> {
    jacobian(&[nodes[0], nodes[1], nodes[2]], NODES[0])
}

/// Stress (xx, yy, xy, zz) at each node of a straight triangle, by the slopes of its barycentric coordinates. It is constant for P1, and
/// linear for P2: that of a midside is the mean of its corners.
#[inline]
pub fn straight_stresses<const N: usize>(u: &[Point; N], slopes: &[Point; 3], law: &PlaneLaw) -> [[f64; 4]; N] {
    let stress = |by: [(Point, usize); 3]| {
        let gradient = by.into_iter().fold(Matrix2::zeros(), |sum, (slope, of)| sum + slope * slopes[of].transpose());
        law.stress(&Strain { gradient, hoop: 0.0 })
    };
    if N == 3 {
        return [stress([(u[0], 0), (u[1], 1), (u[2], 2)]); N];
    }
    let mut found = [[0.0; 4]; N];
    for corner in 0..3 {
        let (next, last) = ((corner + 1) % 3, (corner + 2) % 3);
        // ∂u by the corner's own barycentric coordinate, and by those of the two others, at the corner.
        let own = 3.0 * u[corner];
        let others = [4.0 * u[3 + corner] - u[next], 4.0 * u[3 + last] - u[last]];
        found[corner] = stress([(own, corner), (others[0], next), (others[1], last)]);
    }
    for side in 0..3 {
        let (a, b) = (found[side], found[(side + 1) % 3]);
        found[3 + side] = std::array::from_fn(|k| 0.5 * (a[k] + b[k]));
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn on_a_straight_triangle_one_map_gives_what_each_node_gives() {
        let corners = [Point::new(0.1, -0.2), Point::new(1.3, 0.1), Point::new(0.4, 0.9)];
        let middle = |a: usize, b: usize| 0.5 * (corners[a] + corners[b]);
        let nodes = [corners[0], corners[1], corners[2], middle(0, 1), middle(1, 2), middle(2, 0)];
        let law = PlaneLaw::new(3.0, 0.3, Plane::Strain);
        let u = nodes.map(|x| Point::new(0.3 * x.x * x.y - x.y * x.y, 0.7 * x.x * x.x + 0.2 * x.y));
        let fast = nodal_stresses(&nodes, &u, &law, None).expect("a good triangle");
        for ((stress, determinant), l) in fast.into_iter().zip(NODES) {
            let each = heated_stress(&nodes, &u, l, &law, None).expect("a good triangle");
            assert!(stress.iter().zip(each).all(|(a, b)| (a - b).abs() < 1e-13), "{stress:?} {each:?}");
            assert!((determinant - jacobian(&nodes, l).expect("a good triangle").1).abs() < 1e-14);
        }
        let mut bent = nodes;
        bent[3] += Point::new(0.0, -1e-3);
        assert!(is_straight(&nodes) && !is_straight(&bent));
    }
}
