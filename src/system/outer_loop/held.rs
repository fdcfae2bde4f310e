//! Whether supports and contact hold every body.

use crate::body::Constraints;
use crate::contact::{Condition, Mechanism, find_mechanism};
use crate::element::Order;
use crate::geometry::Point;
use crate::mesh::{Level, Numbering};
use crate::system::{Coupled, Discretisation, Scene};

/// Words for a body that neither supports nor the active multipliers hold; nothing if all are held.
pub fn not_held(problem: &Discretisation, active: &[bool]) -> Option<String> {
    let mechanism = mechanism(problem, active)?;
    let by = if active.contains(&true) {
        "supports and contact do not hold it"
    } else {
        "contact is open everywhere and supports do not hold it"
    };
    Some(format!("body {} can {}: {by}", problem.scene.bodies[mechanism.body].name, mechanism.motion))
}

/// Of the open multipliers those with the largest `force`, 1, 2, 4, ... of them: as many as it takes to hold every body.
pub fn few_that_hold(problem: &Discretisation, active: &[bool], force: impl Fn(usize) -> f64) -> Vec<usize> {
    let mut open: Vec<usize> = (0..active.len()).filter(|&i| !active[i]).collect();
    open.sort_by(|&a, &b| force(b).total_cmp(&force(a)));
    let mut count = 1;
    while count < open.len() {
        let mut closed = active.to_vec();
        open[..count].iter().for_each(|&i| closed[i] = true);
        if mechanism(problem, &closed).is_none() {
            break;
        }
        count *= 2;
    }
    open.truncate(count);
    open
}

/// A motion that neither supports nor the active multipliers resist.
fn mechanism(problem: &Discretisation, active: &[bool]) -> Option<Mechanism> {
    let (scene, finest) = (&problem.scene, problem.finest());
    let numbering = Numbering::new(Level { intervals: 1, order: Order::P1 }, &scene.partition);
    let mut conditions = support_conditions(scene, &numbering);
    let place = |coupled: &Coupled| (coupled.body, coupled.node.place(&scene.mesh, &finest.numbering), coupled.value);
    let rows = problem.coupling.rows.iter().zip(active).filter(|(_, active)| **active);
    conditions.extend(rows.map(|(row, _)| row.iter().map(place).collect::<Condition>()));
    find_mechanism(&scene.extents(), &conditions)
}

/// Everything that supports hold, at the macro vertices.
fn support_conditions(scene: &Scene, numbering: &Numbering) -> Vec<Condition> {
    supported(scene, numbering).into_iter().map(|(body, x, direction, _)| vec![(body, x, direction)]).collect()
}

/// Body, place, direction and prescribed displacement of everything that supports hold at the macro vertices.
pub fn supported(scene: &Scene, numbering: &Numbering) -> Vec<(usize, Point, Point, f64)> {
    let Ok(constraints) = Constraints::new(&scene.mesh, numbering, &scene.supports) else { return Vec::new() };
    let mut body = vec![0; scene.mesh.vertices.len()];
    for triangle in &scene.mesh.triangles {
        triangle.vertices.iter().for_each(|&vertex| body[vertex as usize] = triangle.body as usize);
    }
    let mut all = Vec::new();
    for (vertex, &x) in scene.mesh.vertices.iter().enumerate() {
        let Some(constraint) = constraints.get(numbering.vertex(vertex as u32)) else { continue };
        for (k, axis) in [Point::new(1.0, 0.0), Point::new(0.0, 1.0)].into_iter().enumerate() {
            if constraint.fixed[k] {
                all.push((body[vertex], x, constraint.to_global(axis), constraint.value[k]));
            }
        }
    }
    all
}
