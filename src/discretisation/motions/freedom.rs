//! What supports leave free of the rigid motions of bodies.

use super::held::support_conditions;
use crate::contact::{Condition, Extent, wrench};
use crate::discretisation::scene::Scene;
use crate::geometry::{Point, gauss_points};
use nalgebra::{Matrix3, Vector3};

/// Resistance to a motion, by the largest, that counts as none: normals that are parallel but for rounding, and for what a mesh file
/// with six digits makes of them, hold nothing across.
const NOTHING: f64 = 1e-6;

/// What is held is seen by a support by this much at least, of the square of what it sees of all: a seat of 3 % of the body's size holds its
/// turn. Normals at the ends of an arc of 40 chords see a hundredth of a turn about its centre, and of the square a few 1e-5.
const HELD: f64 = 1e-4;

/// Gauss points of an edge with springs.
const POINTS: usize = 2;

/// The rigid motions of a body that supports do not hold: shifts of its middle, and turns about it by its radius.
#[derive(Clone, Debug)]
pub struct Freedom {
    /// Middle and radius.
    pub extent: Extent,
    /// Projection onto what is free.
    pub free: Matrix3<f64>,
    /// What springs resist (force per thickness and length).
    pub springs: Matrix3<f64>,
}

impl Freedom {
    /// What each body may do; nothing of those that supports hold.
    pub fn of_bodies(scene: &Scene) -> Vec<Option<Self>> {
        let (mesh, extents) = (&scene.mesh, scene.extents());
        let first = |body: usize| mesh.pieces.iter().position(|piece| piece.body == body);
        let of_body: Vec<Option<Extent>> = (0..mesh.bodies.len()).map(|body| Some(extents[first(body)?])).collect();
        let mut held = vec![Matrix3::zeros(); mesh.bodies.len()];
        for condition in support_conditions(scene, &extents) {
            let (body, piece) = (mesh.pieces[condition.piece].body, extents[condition.piece]);
            if let Some(extent) = of_body[body] {
                let seen = seen_from(&condition, piece, extent);
                held[body] += seen * seen.transpose();
            }
        }
        let mut springs = vec![Matrix3::zeros(); mesh.bodies.len()];
        for own in &scene.springs {
            for edge in own.edges(mesh) {
                let body = mesh.body_beside(edge);
                let Some(extent) = of_body[body] else { continue };
                for &(t, weight) in gauss_points(POINTS) {
                    let x = mesh.edge_position(edge, t);
                    let area = weight * mesh.edge_slope(edge, t).norm() * mesh.plane.width(x);
                    for (direction, stiffness) in own.stiffness.at(x, mesh.edge_normal(edge, t)) {
                        let seen = in_extent(wrench(direction, x - extent.middle), extent);
                        springs[body] += stiffness * area * seen * seen.transpose();
                    }
                }
            }
        }
        let freedom = |((held, extent), springs): ((&Matrix3<f64>, Option<Extent>), Matrix3<f64>)| {
            let free = split(held, HELD)[1];
            (free != Matrix3::zeros()).then_some(Self { extent: extent?, free, springs })
        };
        held.iter().zip(of_body).zip(springs).map(freedom).collect()
    }

    /// Forces and moments about a point in the frame of the body: moments about its middle, by its radius.
    pub fn frame(&self, about: Point) -> Matrix3<f64> {
        let arm = about - self.extent.middle;
        let r = self.extent.radius;
        Matrix3::new(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, -arm.y / r, arm.x / r, 1.0 / r)
    }

    /// The smallest motion for a force and moment that is resisted so: none of it where hardly anything resists.
    pub fn compliance(&self, resistance: &Matrix3<f64>) -> Matrix3<f64> {
        split(&(self.free * (resistance + self.springs) * self.free), NOTHING)[0]
    }
}

/// The inverse of a resistance where it resists, and the projection onto what it does not resist.
fn split(resistance: &Matrix3<f64>, share: f64) -> [Matrix3<f64>; 2] {
    let eigen = resistance.symmetric_eigen();
    let least = share * eigen.eigenvalues.max();
    let (mut inverse, mut free) = (Matrix3::zeros(), Matrix3::zeros());
    for (value, axis) in eigen.eigenvalues.iter().zip(eigen.eigenvectors.column_iter()) {
        let both = axis * axis.transpose();
        if *value > least { inverse += both / *value } else { free += both }
    }
    [inverse, free]
}

fn in_extent(wrench: Vector3<f64>, extent: Extent) -> Vector3<f64> {
    Vector3::new(wrench.x, wrench.y, wrench.z / extent.radius)
}

/// What a condition on a piece sees of the motion of the body.
fn seen_from(condition: &Condition, piece: Extent, body: Extent) -> Vector3<f64> {
    let [x, y, turn] = condition.sees[0];
    let force = Point::new(x, y);
    let moment = turn * piece.radius + wrench(force, piece.middle - body.middle).z;
    in_extent(Vector3::new(x, y, moment), body)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn free() -> Freedom {
        let extent = Extent { middle: Point::new(3.0, 4.0), radius: 2.0 };
        Freedom { extent, free: Matrix3::identity(), springs: Matrix3::zeros() }
    }

    /// A bar between two flanks with the normals (±.8, .6): flanks share a force along the bar, and a force across it they take by 1/1.6.
    /// Between two parallel plates a roller that is pushed along them takes up nothing, and nothing resists its turn.
    #[test]
    fn a_wedge_takes_up_more_than_it_is_pushed_by() {
        let normals = |x: f64, y: f64| [[x, y, 0.0], [-x, y, 0.0]].map(Vector3::from);
        let taken = |normals: [Vector3<f64>; 2], force: [f64; 3]| {
            let compliance = free().compliance(&normals.iter().map(|n| n * n.transpose()).sum());
            normals.map(|normal| normal.dot(&(compliance * Vector3::from(force))))
        };
        for (force, wanted) in [([0.0, 1.0, 0.0], [1.0 / 1.2; 2]), ([1.0, 0.0, 0.0], [1.0 / 1.6, -1.0 / 1.6])] {
            let found = taken(normals(0.8, 0.6), force);
            assert!(found.iter().zip(wanted).all(|(found, wanted)| (found - wanted).abs() < 1e-12), "{found:?} for {wanted:?}");
        }
        assert_eq!(taken(normals(0.0, 1.0), [1.0, 0.0, 0.0]), [0.0; 2]);
        assert_eq!(taken(normals(0.0, 1.0), [0.0, 1.0, 1.0]), [0.5; 2]);
    }

    #[test]
    fn moments_are_about_the_middle_of_the_body_and_by_its_radius() {
        let force = Vector3::new(0.0, 5.0, 7.0);
        let found = free().frame(Point::new(4.0, 4.0)) * force;
        assert!((found - Vector3::new(0.0, 5.0, 6.0)).norm() < 1e-12, "{found}");
    }

    #[test]
    fn what_supports_see_hardly_is_free() {
        let seen = |x: f64| Vector3::new(x, 1.0, 0.0);
        let held = |x: f64| split(&(seen(x) * seen(x).transpose() + seen(-x) * seen(-x).transpose()), HELD)[1];
        assert!((held(1e-3) - Matrix3::from_diagonal(&Vector3::new(1.0, 0.0, 1.0))).norm() < 1e-12);
        assert!((held(0.1) - Matrix3::from_diagonal(&Vector3::new(0.0, 0.0, 1.0))).norm() < 1e-12);
    }
}
