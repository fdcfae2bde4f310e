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
    if heat.is_none() && law.plane != Plane::Revolution {
        if N == 3 {
            return Ok([(heated_stress(nodes, u, NODES[0], law, None)?, jacobian(nodes, NODES[0])?.1); N]);
        }
        if is_straight(nodes) {
            return straight(nodes, u, law);
        }
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

/// On a straight P2 triangle the stress is linear: that of a midside is the mean of its corners, and one map serves all.
fn straight<const N: usize>(nodes: &[Point; N], u: &[Point; N], law: &PlaneLaw) -> Result<[([f64; 4], f64); N], BadJacobian> {
    let (corner_gradients, determinant) = jacobian(&[nodes[0], nodes[1], nodes[2]], NODES[0])?;
    let mut found = [([0.0; 4], determinant); N];
    for corner in 0..3 {
        let (next, last) = ((corner + 1) % 3, (corner + 2) % 3);
        // ∂u by the corner's own barycentric coordinate, and by those of the two others, at the corner.
        let own = 3.0 * u[corner];
        let others = [4.0 * u[3 + corner] - u[next], 4.0 * u[3 + last] - u[last]];
        let by = [(own, corner), (others[0], next), (others[1], last)];
        let mut gradient = Matrix2::zeros();
        for (slope, of) in by {
            gradient += slope * corner_gradients[of].transpose();
        }
        found[corner].0 = law.stress(&Strain { gradient, hoop: 0.0 });
    }
    for side in 0..3 {
        let (a, b) = (found[side].0, found[(side + 1) % 3].0);
        found[3 + side].0 = std::array::from_fn(|k| 0.5 * (a[k] + b[k]));
    }
    Ok(found)
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
