//! The rigid motion that supports ask of each body: what prescribed displacements are like without any strain.

use crate::discretisation::levels::Discretisation;
use crate::discretisation::motions::held::{Held, supported};
use crate::discretisation::scene::Scene;
use crate::element::Order;
use crate::geometry::Point;
use crate::mesh::{Level, Numbering};
use nalgebra::{Matrix3, Vector3};

/// Rigid motions flatter than this share of the largest are not told by the supports.
const FLAT: f64 = 1e-9;

/// This rank's displacements, in the nodes' frames, where every piece of a body moves by the rigid motion that is nearest to
/// what its supports prescribe at the macro vertices (least squares); nothing if they prescribe zero everywhere.
pub fn rigid_start(problem: &Discretisation, rank: usize) -> Option<Vec<f64>> {
    let (scene, space) = (&problem.scene, problem.finest());
    let motions = motions(scene)?;
    let extents = scene.extents();
    Some(space.unknowns_of(scene, rank, |triangle| {
        let piece = scene.mesh.triangles[triangle].piece as usize;
        let ([u, v, turn], extent): ([f64; 3], _) = (motions[piece].into(), &extents[piece]);
        move |_, at| {
            let arm = (scene.mesh.node_position(triangle, space.numbering.level, at) - extent.middle) / extent.radius;
            Point::new(u - turn * arm.y, v + turn * arm.x)
        }
    }))
}

/// Shift and turn of each piece, the turn by its radius.
fn motions(scene: &Scene) -> Option<Vec<Vector3<f64>>> {
    let numbering = Numbering::new(Level { intervals: 1, order: Order::P1 }, &scene.partition);
    let extents = scene.extents();
    let mut sums = vec![(Matrix3::<f64>::zeros(), Vector3::<f64>::zeros()); extents.len()];
    let mut moves = false;
    for Held { piece, place, direction, value, .. } in supported(scene, &numbering, &scene.means) {
        let arm = (place - extents[piece].middle) / extents[piece].radius;
        let row = Vector3::new(direction.x, direction.y, direction.y * arm.x - direction.x * arm.y);
        sums[piece].0 += row * row.transpose();
        sums[piece].1 += value * row;
        moves |= value != 0.0;
    }
    let solve = |(gram, right): (Matrix3<f64>, Vector3<f64>)| {
        let inverse = gram.pseudo_inverse(FLAT * gram.amax()).unwrap_or_default();
        inverse * right
    };
    moves.then(|| sums.into_iter().map(solve).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::Support;
    use crate::contact::MultiplierSpace;
    use crate::discretisation::samples::{blocks, pair};
    use crate::geometry::Formula;

    /// Supports that ask of the lower block a shift and a turn, at both ends of its bottom, or that ask for nothing.
    #[test]
    fn supports_that_turn_a_body_tell_its_rigid_motion() {
        let formula = |text| Some(Formula::parse(text, &["x", "y"]).expect("a formula"));
        let found = |ux, uy| {
            let on = vec!["bottom".into(), "lower.seam".into()];
            let support = Support { name: "held".into(), on, at: None, ux: formula(ux), uy: formula(uy), normal: None };
            let scene = blocks(pair(MultiplierSpace::P0, 4), |_| Point::zeros(), vec![support]);
            (motions(&scene), scene)
        };
        assert_eq!(found("0", "0").0, None);
        let (motions, scene) = found("0.03 - 0.1 * y", "0.1 * x - 0.02");
        let (motions, extents) = (motions.expect("they move"), scene.extents());
        let lower = scene.mesh.bodies.iter().position(|name| name == "lower").expect("a body");
        let [middle, radius] = [extents[lower].middle, Point::repeat(extents[lower].radius)];
        let wanted = Vector3::new(0.03 - 0.1 * middle.y, 0.1 * middle.x - 0.02, 0.1 * radius.x);
        assert!((motions[lower] - wanted).norm() < 1e-12, "{} instead of {wanted}", motions[lower]);
        assert_eq!(motions[1 - lower], Vector3::zeros(), "nothing holds the other one");
    }
}
