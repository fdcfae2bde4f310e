//! Whether supports and contact hold every body.

use super::{Coupled, Discretisation, Scene};
use crate::body::Constraints;
use crate::contact::{Condition, find_mechanism};
use crate::element::Order;
use crate::geometry::Point;
use crate::mesh::{Level, Numbering};

/// Words for a body that neither supports nor the active multipliers hold; nothing if all are held.
pub fn not_held(problem: &Discretisation, active: &[bool]) -> Option<String> {
    let (scene, finest) = (&problem.scene, problem.finest());
    let numbering = Numbering::new(Level { intervals: 1, order: Order::P1 }, &scene.partition);
    let mut conditions = support_conditions(scene, &numbering);
    let place = |coupled: &Coupled| (coupled.body, coupled.node.place(&scene.mesh, &finest.numbering), coupled.value);
    let rows = problem.coupling.rows.iter().zip(active).filter(|(_, active)| **active);
    conditions.extend(rows.map(|(row, _)| row.iter().map(place).collect::<Condition>()));
    let mechanism = find_mechanism(&scene.extents(), &conditions)?;
    let by = if active.contains(&true) {
        "supports and contact do not hold it"
    } else {
        "contact is open everywhere and supports do not hold it"
    };
    Some(format!("body {} can {}: {by}", scene.bodies[mechanism.body].name, mechanism.motion))
}

/// Everything that supports hold, at the macro vertices.
fn support_conditions(scene: &Scene, numbering: &Numbering) -> Vec<Condition> {
    let Ok(constraints) = Constraints::new(&scene.mesh, numbering, &scene.supports) else { return Vec::new() };
    let mut body = vec![0; scene.mesh.vertices.len()];
    for triangle in &scene.mesh.triangles {
        triangle.vertices.iter().for_each(|&vertex| body[vertex as usize] = triangle.body as usize);
    }
    let mut conditions = Vec::new();
    for (vertex, &x) in scene.mesh.vertices.iter().enumerate() {
        let Some(constraint) = constraints.get(numbering.vertex(vertex as u32)) else { continue };
        for (k, axis) in [Point::new(1.0, 0.0), Point::new(0.0, 1.0)].into_iter().enumerate() {
            if constraint.fixed[k] {
                conditions.push(vec![(body[vertex], x, constraint.to_global(axis))]);
            }
        }
    }
    conditions
}
