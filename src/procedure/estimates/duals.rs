//! What the goals of an accuracy are sensitive to: the dual problem of each, on the set and the boundaries of the solution.
//!
//! The error of a linear functional J is `a(u - u_h, z - z_h)`, where z solves the same system with J as its right-hand side
//! (Becker, Rannacher, Acta Numerica 10, 2001; with contact on a frozen set: Blum, Suttmeier, Computing 65, 2000). So a macro
//! triangle counts by the product of what is left there of u and of z. The stress at a point is no functional of
//! displacements with finite energy; its mean over the triangle of the lattice that holds the point is.

use crate::accuracy::{Goal, ProbePoint, Quantity};
use crate::contact::Zone;
use crate::discretisation::{ContactPressure, Discretisation, Field, Solution, SystemError, load};
use crate::geometry::Point;
use crate::mesh::Cells;
use crate::procedure::coarse_solution::{CoarseSolution, coarse_values};
use crate::recovery::{cell_energies, holding, shapes_at, stress_forces};
use crate::system::System;

/// Relative residual of dual solutions: they weigh errors, and are no results. With 1e-3 meshes differed from one number of ranks to
/// another; no time was saved by it on cases of 10 to 50 thousand unknowns.
const ROUGH: f64 = 1e-6;

/// Segments on either side of the one with the largest pressure that tell of it.
const AT_THE_PEAK: usize = 1;

/// Segments at an end of a zone that tell where it ends.
const AT_AN_END: usize = 2;

/// The dual problems of a solution.
pub(crate) struct Duals<'d> {
    /// What the goals are of.
    pub solution: &'d Solution,
    /// The solution on the mesh before, if there is any.
    pub coarse: Option<&'d CoarseSolution>,
}

/// The right-hand side of a dual problem: this rank's nodal forces, and gaps of all multipliers.
struct Functional {
    load: Vec<f64>,
    gap: Vec<f64>,
}

impl Duals<'_> {
    /// The dual displacement of a goal, by a system with the set of the solution; none for the energy norm, where the error weighs
    /// itself. **Collective**
    pub fn solve(&self, system: &mut System, goal: &Goal) -> Result<Option<Vec<f64>>, SystemError> {
        let functional = self.functional(&goal.quantity, system.problem())?;
        functional.map(|Functional { load, gap }| system.response(&load, &gap, ROUGH)).transpose()
    }

    /// The right-hand side of the dual problem of a quantity. **Collective**
    fn functional(&self, quantity: &Quantity, problem: &Discretisation) -> Result<Option<Functional>, SystemError> {
        let nothing = vec![0.0; problem.finest().local_unknowns()];
        let of_pressure = |name: &str, weights: &dyn Fn(usize, &ContactPressure) -> Vec<f64>| {
            let at = problem.contacts.iter().position(|contact| contact.pair.name == name)?;
            let contact = &problem.contacts[at];
            let mut gap = vec![0.0; problem.multiplier_count()];
            gap[contact.range()].copy_from_slice(&weights(at, &self.solution.pressure(contact)));
            Some(Functional { load: nothing.clone(), gap })
        };
        let of_load = |load: Vec<f64>| Functional { load, gap: vec![0.0; problem.multiplier_count()] };
        Ok(match quantity {
            Quantity::Energy => None,
            Quantity::Force(name) => of_pressure(name, &|_, pressure| force_weights(pressure)),
            Quantity::Pressure(name) => of_pressure(name, &|at, pressure| self.pressure_weights(at, pressure)),
            Quantity::Peak(name) => of_pressure(name, &|_, pressure| peak_weights(pressure)),
            Quantity::Ends(name) => of_pressure(name, &|_, pressure| end_weights(pressure)),
            Quantity::Displacement(point) => Some(of_load(point_force(problem, point, self.solution))),
            Quantity::Stress(point) => Some(of_load(self.stress_load(problem, point)?)),
        })
    }

    /// `∫ψ_i e ds` over the middle of each zone, where e is how λ differs from that on the mesh before: its product with an
    /// error of λ is largest where λ is worst.
    fn pressure_weights(&self, at: usize, pressure: &ContactPressure) -> Vec<f64> {
        let Some(coarse) = self.coarse else { return force_weights(pressure) };
        let (boundary, zones) = (&pressure.contact.boundary, pressure.zones());
        let mut weights = vec![0.0; pressure.values.len()];
        let is_in_a_middle = |arc: f64| zones.iter().any(|zone| zone.has_in_its_middle(arc));
        let points = boundary.gauss_on(0..boundary.segments(), 3);
        for (k, z, _, length) in points.filter(|(_, _, arc, _)| is_in_a_middle(*arc)) {
            let x = boundary.point(boundary.parameter_on(k, z));
            let error = pressure.value(k, z) - coarse.pressure(at).at_foot(x);
            let (rows, shapes) = pressure.contact.multipliers.on_segment(k, z);
            for (row, shape) in rows.into_iter().zip(shapes) {
                weights[row] += length * error * shape;
            }
        }
        weights
    }

    /// The nodal forces of the mean stress over the triangles that hold a point, in the direction in which it changed from the
    /// mesh before: this rank's part. **Collective**
    fn stress_load(&self, problem: &Discretisation, point: &ProbePoint) -> Result<Vec<f64>, SystemError> {
        let space = problem.finest();
        let mut change = self.solution.displacement.clone();
        if let Some(coarse) = self.coarse {
            let before = coarse.displacement(&problem.scene, space, problem.session.rank());
            change.iter_mut().zip(before).for_each(|(now, before)| *now -= before);
        }
        let change = Field::displacement(problem, &change);
        let Some(region) = problem.scene.mesh.region(&point.body) else {
            return Ok(vec![0.0; space.local_unknowns()]);
        };
        let forces = stress_forces(problem, &change, region, point.point)?;
        Ok(load(problem, &forces))
    }
}

/// `∫ψ_i ds`: the force.
fn force_weights(pressure: &ContactPressure) -> Vec<f64> {
    (0..pressure.values.len()).map(|i| pressure.contact.multipliers.integral(i)).collect()
}

/// The force on the segments beside the largest pressure.
fn peak_weights(pressure: &ContactPressure) -> Vec<f64> {
    let multipliers = &pressure.contact.multipliers;
    let highest = |k: usize| pressure.value(k, 0.0).max(pressure.value(k, 1.0));
    let segments = pressure.contact.boundary.segments();
    let top = (0..segments).max_by(|a, b| highest(*a).total_cmp(&highest(*b))).unwrap_or(0);
    let mut weights = vec![0.0; pressure.values.len()];
    let near = match pressure.contact.boundary.is_closed() && segments > 2 * AT_THE_PEAK {
        true => top + segments - AT_THE_PEAK..top + segments + 1 + AT_THE_PEAK,
        false => top.saturating_sub(AT_THE_PEAK)..(top + 1 + AT_THE_PEAK).min(segments),
    };
    for k in near {
        multipliers.on_segment(k, 0.5).0.into_iter().for_each(|row| weights[row] = multipliers.integral(row));
    }
    weights
}

/// The force near both ends of each zone, but for those where a body ends.
fn end_weights(pressure: &ContactPressure) -> Vec<f64> {
    let contact = pressure.contact;
    let (multipliers, whole) = (&contact.multipliers, contact.ends_with_a_body());
    let mut weights = vec![0.0; pressure.values.len()];
    let beside = |zone: &Zone, k: usize| {
        let [first, last] = [k - zone.segments.start, zone.segments.end - 1 - k].map(|away| away < AT_AN_END);
        (first && !(zone.is_at_end[0] && whole[0])) || (last && !(zone.is_at_end[1] && whole[1]))
    };
    for zone in pressure.zones().into_iter().filter(|zone| !zone.goes_round()) {
        for k in zone.segments.clone().filter(|&k| beside(&zone, k)) {
            multipliers.on_segment(k, 0.5).0.into_iter().for_each(|row| weights[row] = multipliers.integral(row));
        }
    }
    weights
}

/// A force of one at a point, in the direction that it moves in: this rank's part. **Collective**
fn point_force(problem: &Discretisation, point: &ProbePoint, solution: &Solution) -> Vec<f64> {
    let u = Field::displacement(problem, &solution.displacement);
    let mut force = Field::<2>::zeros(&problem.scene, problem.finest(), &problem.session);
    let region = problem.scene.mesh.region(&point.body);
    for (triangle, at) in region.map_or_else(Vec::new, |region| holding(problem, region, point.point)) {
        let shapes = shapes_at(problem, triangle, at);
        let moved: Point = shapes.iter().fold(Point::zeros(), |sum, (node, value)| sum + *value * u.point(*node));
        let direction = moved.try_normalize(0.0).unwrap_or(Point::y());
        shapes.into_iter().for_each(|(node, value)| force.add_at(node, value * direction));
    }
    load(problem, &force.sum(&problem.session))
}

/// What each cell of this rank's macro triangles counts for a goal: the product of what is left there of the solution and of the
/// dual one. `left` are squares in the energy norm. **Collective**
pub(crate) fn weighted(problem: &Discretisation, left: &[Cells], dual: &[f64]) -> Result<Vec<Cells>, SystemError> {
    let dual = cell_energies(problem, &surplus(problem, dual))?;
    // Rounding may leave a rigid motion a little less than nothing.
    Ok(left.iter().zip(dual).map(|(u, z)| u.combined(&z, |u, z| (u * z).max(0.0).sqrt())).collect())
}

/// What the finest level adds to a displacement: its difference from its interpolant on the next coarser one. **Collective**
fn surplus(problem: &Discretisation, unknowns: &[f64]) -> Field<2> {
    let whole = Field::displacement(problem, unknowns);
    let (mesh, space) = (&problem.scene.mesh, problem.finest());
    let level = space.numbering.level;
    let left = space.unknowns_of(&problem.scene, problem.session.rank(), |triangle| {
        let (numbers, whole) = (space.numbering.triangle(mesh, triangle), &whole);
        move |node, at| {
            let take = |u, ((k, l), weight): (_, f64)| u - weight * whole.point(numbers.node(2 * k, 2 * l));
            coarse_values(mesh, triangle, level, at).fold(whole.point(node), take)
        }
    });
    Field::displacement(problem, &left)
}
