//! Consistent nodal forces.

use super::map::{BadJacobian, jacobian};
use super::plane_law::{Heat, Plane, PlaneLaw};
use super::shape::{edge_shape, edge_slope, shape};
use super::stiffness::{SIX_POINTS, six_points};
use crate::geometry::{Point, gauss_points, turn_right};
use std::f64::consts::TAU;

/// Nodal forces of a traction on an element edge, `∫ N_a t ds` per unit thickness.
///
/// `points` are the edge's 2 or 3 nodes, body on the left; `traction` takes a point and the unit outward normal there
/// and returns force per length. Exact for tractions of degree 4 on each of so many equal parts of a straight edge.
pub fn edge_load(points: &[Point], parts: usize, traction: impl Fn(Point, Point) -> Point) -> [Point; 3] {
    let mut forces = [Point::zeros(); 3];
    let share = 1.0 / parts as f64;
    for (part, &(z, weight)) in (0..parts).flat_map(|part| gauss_points(4).iter().map(move |point| (part, point))) {
        let (t, weight) = ((part as f64 + z) * share, weight * share);
        let (values, slopes) = (edge_shape(points.len(), t), edge_slope(points.len(), t));
        let (mut x, mut along) = (Point::zeros(), Point::zeros());
        for (a, point) in points.iter().enumerate() {
            x += values[a] * point;
            along += slopes[a] * point;
        }
        let force = traction(x, turn_right(along).normalize()) * (weight * along.norm());
        for (sum, value) in forces.iter_mut().zip(values) {
            *sum += value * force;
        }
    }
    forces
}

/// Nodal forces of a force per area on a triangle, `∫ N_a b dA` per unit thickness; `force` takes the points where it is looked
/// at.
///
/// # Errors
/// [`BadJacobian`] where the map folds over.
pub fn triangle_load<const N: usize>(
    nodes: &[Point; N],
    force: impl Fn(&[Point; 6]) -> [Point; 6],
) -> Result<[Point; N], BadJacobian> {
    let mut forces = [Point::zeros(); N];
    let densities = force(&six_points(nodes));
    for (&(l, weight), density) in SIX_POINTS.iter().zip(densities) {
        let (_, determinant) = jacobian(nodes, l)?;
        let density = density * (0.5 * weight * determinant);
        for (sum, value) in forces.iter_mut().zip(shape::<N>(l)) {
            *sum += value * density;
        }
    }
    Ok(forces)
}

/// Nodal forces by which a heated triangle pushes, `∫ p (∇N_a + h_a e_x) w dA` with the pressure `p` that keeps it from growing,
/// the width `w` across the plane and, of a ring, the hoop strain `h_a = N_a / x`.
///
/// # Errors
/// [`BadJacobian`] where the map folds over.
pub fn heat_load<const N: usize>(nodes: &[Point; N], law: &PlaneLaw, heat: &Heat) -> Result<[Point; N], BadJacobian> {
    let mut forces = [Point::zeros(); N];
    for (&(l, weight), x) in SIX_POINTS.iter().zip(six_points(nodes)) {
        let (gradients, determinant) = jacobian(nodes, l)?;
        let (width, around) = match law.plane {
            Plane::Revolution => (law.plane.width(x), TAU),
            Plane::Strain | Plane::Stress => (1.0, 0.0),
        };
        let pressed = 0.5 * weight * determinant * law.pressure_by_growth() * heat.growth(x);
        for ((sum, gradient), value) in forces.iter_mut().zip(gradients).zip(shape::<N>(l)) {
            *sum += pressed * (width * gradient + Point::new(around * value, 0.0));
        }
    }
    Ok(forces)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Formula;

    #[test]
    fn pressure_on_a_closed_quarter_arc_acts_on_its_chord() {
        // Three nodes of a quadratic edge; uniform pressure on any curve adds up to that on the chord between its ends.
        let points = [Point::new(1.0, 0.0), Point::new(0.0, 1.0), Point::new(0.75, 0.75)];
        let total: Point = edge_load(&points, 1, |_, normal| -normal).iter().sum();
        assert!((total - Point::new(-1.0, -1.0)).norm() < 1e-14);
    }

    #[test]
    fn what_is_heated_pushes_as_much_to_all_sides_in_the_plane_and_outwards_in_a_ring() {
        let heat = Heat { expansion: 2e-5, temperature: Formula::constant(50.0) };
        let corners = [Point::new(1.0, 0.0), Point::new(3.0, 0.0), Point::new(1.0, 1.0)];
        for plane in [Plane::Strain, Plane::Stress, Plane::Revolution] {
            let law = PlaneLaw::new(7000.0, 0.3, plane);
            let forces = heat_load(&corners, &law, &heat).expect("a good triangle");
            let (sum, pressed) = (forces.iter().sum::<Point>(), law.pressure_by_growth() * 1e-3);
            // Along the axis nothing is left; around it the ring of the area 1 pushes by 2π p for each unit of it.
            let outwards = if plane == Plane::Revolution { TAU * pressed } else { 0.0 };
            assert!((sum - Point::new(outwards, 0.0)).norm() < 1e-11, "{plane:?}: {sum}");
            let work: f64 = forces.iter().zip(corners).map(|(force, x)| force.dot(&x)).sum();
            let volume = if plane == Plane::Revolution { 3.0 * TAU * 5.0 / 3.0 } else { 2.0 };
            assert!((work - pressed * volume).abs() < 1e-10, "{plane:?}: virtual work of an even growth: {work}");
        }
    }

    #[test]
    fn a_uniform_force_on_a_straight_triangle_goes_to_the_known_nodes() {
        let corners = [Point::new(0.0, 0.0), Point::new(2.0, 0.0), Point::new(0.0, 1.0)];
        let linear = triangle_load(&corners, |points| points.map(|_| Point::new(0.0, -3.0))).expect("a good triangle");
        assert!(linear.iter().all(|f| (f - Point::new(0.0, -1.0)).norm() < 1e-14));
        let [a, b, c] = corners;
        let quadratic =
            triangle_load(&[a, b, c, 0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)], |points| points.map(|_| Point::new(3.0, 0.0)))
                .expect("a good triangle");
        assert!(quadratic[..3].iter().all(|f| f.norm() < 1e-14));
        assert!(quadratic[3..].iter().all(|f| (f - Point::new(1.0, 0.0)).norm() < 1e-14));
    }
}
