//! How deep the bodies of each contact lie in each other, by their whole sides.

use crate::contact::{Penetration, SmoothSide, penetration};
use crate::discretisation::{BoundaryMotion, Discretisation, Solution};
use crate::geometry::Point;
use crate::mesh::EdgeNode;
use crate::petsc::Session;

/// For each contact, with its force (per thickness, of a body of revolution that of the whole); ranks take them in turn. Bodies that
/// lie along each other from the beginning come together by what strains them: a pressure p over a width w moves a boundary by about
/// `2 p w/E`. **Collective**
pub fn penetrations(problem: &Discretisation, solution: &Solution, forces: &[f64], session: &Session) -> Vec<Penetration> {
    let (mesh, space) = (&problem.scene.mesh, problem.finest());
    let motion = BoundaryMotion::new(&problem.scene, space, &solution.displacement, session);
    let displacement = |node: EdgeNode| motion.at(node, mesh, space);
    let mut values = vec![0.0; 5 * problem.contacts.len()];
    for (at, contact) in problem.contacts.iter().enumerate().filter(|(at, _)| at % session.size() == session.rank()) {
        let sides = SmoothSide::of_pair(mesh, &space.numbering, &contact.pair, &displacement);
        let boundary = &contact.boundary;
        let [first, last] = boundary.ends();
        let away = |place| {
            let foot = boundary.foot(place);
            (foot - last).max(0.0) + (foot - first).min(0.0)
        };
        let Penetration { depth, place, beyond, approach } = penetration(&sides, &contact.pair, away);
        let softest = contact.moduli.iter().copied().fold(f64::INFINITY, f64::min);
        // The force of a body of revolution is that of the whole ring.
        let width = mesh.plane.width(boundary.point(boundary.parameter_at(0.5 * boundary.length())));
        let approach = approach.max(2.0 * forces[at].abs() / (width * softest));
        values[5 * at..5 * at + 5].copy_from_slice(&[depth, place.x, place.y, beyond, approach]);
    }
    session.sum(&mut values);
    let found = |&[depth, x, y, beyond, approach]: &[f64; 5]| Penetration { depth, place: Point::new(x, y), beyond, approach };
    values.as_chunks().0.iter().map(found).collect()
}
