//! Nodal forces of loads and body forces.

use super::node_positions::NodePositions;
use super::{BodyPart, Load, LoadKind, PointLoad};
use crate::element::{BadJacobian, by_order, edge_load, heat_load, triangle_load};
use crate::geometry::{Formula, Point};
use crate::mesh::{BoundaryEdge, MacroMesh, Numbering, Partition, lattice};

/// Parts of a macro edge over which a formula is integrated at least, four points on each: a bump is seen from a fiftieth of the edge
/// on.
const PARTS: usize = 16;

/// Parts of an edge at most, as for a formula that jumps: the place of the jump is off by less than a five-hundredth of the edge then.
const MOST_PARTS: usize = 512;

/// Change of the forces, relative to their sum, by which they stand: far less than the error of any mesh.
const STANDS: f64 = 1e-7;

/// What acts on bodies.
pub struct Applied<'a> {
    /// The parts of the bodies in the order of the mesh, with their forces per area.
    pub parts: &'a [&'a BodyPart],
    /// Loads on their boundaries.
    pub loads: &'a [Load],
    /// Loads at their points.
    pub point_loads: &'a [PointLoad],
}

/// Hands every nodal force of the macro triangles that `rank` owns to `add(node number, force)`; a node comes many times.
///
/// # Errors
/// [`BadJacobian`] if a triangle is turned inside out.
pub fn applied_forces(
    mesh: &MacroMesh,
    partition: &Partition,
    rank: usize,
    numbering: &Numbering,
    applied: &Applied,
    mut add: impl FnMut(usize, Point),
) -> Result<(), BadJacobian> {
    let Applied { parts, loads, point_loads } = applied;
    for load in *loads {
        for edge in mesh.edges_on(&load.on).filter(|&edge| partition.owner(mesh.beside(edge).0) == rank) {
            for small in BoundaryEdge::all_of(mesh, edge, numbering) {
                let traction = |x: Point, normal| load.kind.traction(x, normal) * mesh.plane.width(x);
                let forces = forces_on_edge(&small.points, numbering.level.intervals, load.kind.is_even(), traction);
                small.nodes.iter().zip(forces).for_each(|(node, force)| add(node.number(mesh, numbering), force));
            }
        }
    }
    for load in *point_loads {
        let Some(vertex) = mesh.vertex_at(&load.at) else { continue };
        if mesh.triangle_at(vertex).is_some_and(|triangle| partition.owner(triangle) == rank) {
            add(numbering.vertex(vertex), load.force());
        }
    }
    let all_over = parts.iter().any(|part| part.is_loaded());
    for &triangle in partition.triangles_of(rank).iter().filter(|_| all_over) {
        let part = parts[mesh.triangles[triangle as usize].part as usize];
        heat_forces(mesh, triangle as usize, numbering, part, &mut add)?;
        if part.force.iter().all(Formula::is_zero) {
            continue;
        }
        let density = |points: &[Point; 6]| {
            let [x, y] = [0, 1].map(|component: usize| part.force[component].values(points));
            std::array::from_fn(|k| Point::new(x[k], y[k]))
        };
        body_forces(mesh, triangle as usize, numbering, density, &mut add)?;
    }
    Ok(())
}

/// Nodal forces by which a heated macro triangle pushes, as of [`applied_forces`].
///
/// # Errors
/// [`BadJacobian`] if a triangle is turned inside out.
pub fn heat_forces(
    mesh: &MacroMesh,
    triangle: usize,
    numbering: &Numbering,
    part: &BodyPart,
    add: &mut impl FnMut(usize, Point),
) -> Result<(), BadJacobian> {
    let Some(heat) = &part.heat else { return Ok(()) };
    let law = part.material.law();
    by_order!(numbering.level.order, small_forces(mesh, triangle, numbering, |x| heat_load(x, &law, heat), add))
}

/// Nodal forces of a force per area of the mesh (per volume in a body of revolution) on one macro triangle, as of
/// [`applied_forces`]; `density` takes some points.
///
/// # Errors
/// [`BadJacobian`] if a triangle is turned inside out.
pub fn body_forces(
    mesh: &MacroMesh,
    triangle: usize,
    numbering: &Numbering,
    density: impl Fn(&[Point; 6]) -> [Point; 6],
    add: &mut impl FnMut(usize, Point),
) -> Result<(), BadJacobian> {
    let whole = |points: &[Point; 6]| {
        let densities = density(points);
        std::array::from_fn(|k| densities[k] * mesh.plane.width(points[k]))
    };
    by_order!(numbering.level.order, small_forces(mesh, triangle, numbering, |x| triangle_load(x, whole), add))
}

/// Hands on the forces at the nodes of each small triangle of a macro triangle.
fn small_forces<const N: usize>(
    mesh: &MacroMesh,
    triangle: usize,
    numbering: &Numbering,
    forces: impl Fn(&[Point; N]) -> Result<[Point; N], BadJacobian>,
    add: &mut impl FnMut(usize, Point),
) -> Result<(), BadJacobian> {
    let (numbers, all) = (numbering.triangle(mesh, triangle), NodePositions::new(mesh, triangle, numbering.level));
    for small in lattice::triangles(numbering.level.intervals, numbering.level.order) {
        let nodes = small.nodes::<N>();
        let forces = forces(&all.of(&nodes))?;
        nodes.iter().zip(forces).for_each(|(&(i, j), force)| add(numbers.node(i, j), force));
    }
    Ok(())
}

/// Nodal forces of a traction on one of the `intervals` edges of a macro edge, as of [`edge_load`]. A traction that is not even is
/// integrated over ever more parts of the edge until the forces stand: what acts on a short part has its resultant, too.
/// `50*exp(-((x-0.33)/w)^2)` on edges of length 1 was 1.8 times that with the points of one part for w = .1, and 18 times for .01.
pub fn forces_on_edge(points: &[Point], intervals: usize, is_even: bool, traction: impl Fn(Point, Point) -> Point) -> [Point; 3] {
    let by = |parts| edge_load(points, parts, &traction);
    if is_even {
        return by(1);
    }
    let mut parts = PARTS.div_ceil(intervals);
    let mut forces = by(parts);
    while parts < MOST_PARTS {
        parts *= 2;
        let before = std::mem::replace(&mut forces, by(parts));
        let apart = forces.iter().zip(before).map(|(now, before)| (now - before).norm()).fold(0.0, f64::max);
        if apart <= STANDS * forces.iter().map(|force| force.norm()).sum::<f64>() {
            break;
        }
    }
    forces
}

impl LoadKind {
    /// Its formulas: one, or one for each axis.
    pub fn formulas(&self) -> &[Formula] {
        match self {
            Self::Pressure(pressure) => std::slice::from_ref(pressure),
            Self::Traction(both) => both,
        }
    }

    /// Whether it is the same everywhere.
    pub fn is_even(&self) -> bool {
        self.formulas().iter().all(|formula| formula.as_constant().is_some())
    }

    /// Traction at a point with the given outward normal (force per length).
    pub fn traction(&self, x: Point, normal: Point) -> Point {
        match self {
            Self::Pressure(pressure) => -pressure.value(&[x.x, x.y]) * normal,
            Self::Traction([tx, ty]) => Point::new(tx.value(&[x.x, x.y]), ty.value(&[x.x, x.y])),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn what_acts_on_a_short_part_of_an_edge_has_its_resultant_and_its_moment() {
        let edge = [Point::zeros(), Point::new(1.0, 0.0)];
        for (width, intervals) in [(0.1, 1), (0.03, 1), (0.01, 1), (0.01, 4)] {
            let bump = |x: Point, _| Point::new(0.0, 50.0 * (-((x.x - 0.33) / width).powi(2)).exp());
            let forces = forces_on_edge(&edge, intervals, false, bump);
            let (sum, moment) = (forces[0].y + forces[1].y, forces[1].y);
            let wanted = 50.0 * width * PI.sqrt();
            assert!((sum / wanted - 1.0).abs() < 1e-3 && (moment / (0.33 * wanted) - 1.0).abs() < 1e-3, "{width}: {sum}");
        }
        let jumps = forces_on_edge(&edge, 1, false, |x, _| Point::new(0.0, if x.x < 0.3 { 1.0 } else { 0.0 }));
        assert!((jumps[0].y + jumps[1].y - 0.3).abs() < 1e-3);
        let even = forces_on_edge(&edge, 1, true, |_, normal| -normal);
        assert!((even[0] - Point::new(0.0, 0.5)).norm() < 1e-15);
    }
}
