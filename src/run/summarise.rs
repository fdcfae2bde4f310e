//! A solution in the terms of `summary.json`.

use crate::case::Case;
use crate::contact::MultiplierSpace;
use crate::element::Order;
use crate::geometry::Point;
use crate::output::ContactPoint;
use crate::output::summary::{self, Summary};
use crate::petsc::versions;
use crate::system::recovery::{Deformation, Evaluation, TracePoint};
use crate::system::{Contact, Solved};

/// A gap smaller than this share of the growth counts as large as that.
const NO_GAP: f64 = 1e-3;

/// Growth by less than this share of the displacements is rounding.
const ROUNDING: f64 = 1e-5;

/// What is known without the solution's fields.
pub fn describe(summary: &mut Summary, case: &Case, solved: &Solved) {
    let Solved { problem, solution, .. } = solved;
    let (scene, numbering) = (&problem.scene, &problem.finest().numbering);
    let count = numbering.level.triangles_per_edge();
    let triangles = scene.mesh.triangles.len() * count * count;
    let [shortest, longest] = scene.mesh.shortest_and_longest_edge(numbering.level);
    let corners = if scene.order == Order::P1 { numbering.node_count() } else { numbering.node_count() - edge_count(solved) };
    summary.mesh = summary::Mesh {
        triangles: Some(triangles as u64),
        vertices: Some(corners as u64),
        order: Some(scene.order.degree() as u8),
        h_min: Some(shortest),
        h_max: Some(longest),
    };
    summary.unknowns = summary::Unknowns {
        displacement: Some(2 * numbering.node_count() as u64),
        multiplier: Some(problem.multiplier_count() as u64),
    };
    summary.outer = solved
        .passes
        .iter()
        .map(|step| summary::OuterIteration {
            iteration: step.iteration,
            boundary: step.boundary,
            active: Some(step.active),
            added: Some(step.added),
            released: Some(step.released),
            krylov_iterations: Some(step.krylov_iterations),
            residual: Some(step.residual),
            max_penetration: Some(step.max_penetration),
            du: Some(step.du),
        })
        .collect();
    summary.boundaries = solved
        .boundaries
        .iter()
        .map(|step| summary::BoundaryIteration {
            iteration: step.iteration,
            length: Some(step.length),
            moved: step.moved,
            du: step.du,
            flipped: step.flipped,
        })
        .collect();
    summary.solver = summary::SolverSummary {
        name: Some(case.solver.choice.name().into()),
        krylov: Some(solved.solver.clone()),
        iterations: solved.passes.iter().map(|step| step.krylov_iterations).collect(),
        coarse: solved
            .coarse
            .iter()
            .map(|solve| summary::CoarseSolveSummary {
                refine: solve.refine,
                unknowns: solve.unknowns,
                iterations: solve.iterations.clone(),
            })
            .collect(),
        residual: Some(solution.residual),
        plain_residual: Some(solution.plain_residual),
        blas: Some(versions::blas()),
    };
}

/// Triangle edges of the finest level: the midside nodes of P2.
fn edge_count(Solved { problem, .. }: &Solved) -> usize {
    let count = problem.finest().numbering.level.triangles_per_edge();
    let mesh = &problem.scene.mesh;
    mesh.edges.len() * count + mesh.triangles.len() * (3 * count * (count - 1) / 2)
}

/// Energies and balances.
pub fn balances(summary: &mut Summary, Evaluation { problem, balance, .. }: &Evaluation) {
    let names = problem.scene.bodies.iter().map(|body| body.name.clone());
    summary.energy = summary::Energy {
        strain: names.zip(balance.strain.iter().map(|&u| Some(u))).collect(),
        total: Some(balance.strain.iter().sum()),
        stationary: balance.stationary,
        external_work: Some(balance.external_work),
    };
    summary.balance =
        summary::BalanceSummary { force: balance.force, moment: balance.moment, energy: balance.energy, bodies: balance.bodies };
}

/// Largest strain and mean rotation of the bodies.
pub fn deformations(summary: &mut Summary, found: &Evaluation) {
    let names = || found.problem.scene.bodies.iter().map(|body| body.name.clone());
    summary.strain_max = names().zip(found.deformations.iter().map(|body| Some(body.strain))).collect();
    summary.rotation = names().zip(found.deformations.iter().map(|body| Some(body.rotation))).collect();
}

/// One contact; `at` is its place among all.
pub fn contact(found: &Evaluation, at: usize, points: &[TracePoint]) -> summary::ContactSummary {
    let Evaluation { problem, solution, balance, .. } = found;
    let pressure = found.pressure(at);
    let contact = pressure.contact;
    let boundary = &contact.boundary;
    let knots = boundary.knots();
    let pair = |p: Point| [p.x, p.y];
    let force = &balance.contacts[at];
    let end = |s: f64| pair(boundary.point(boundary.parameter_at(s)));
    let closed: Vec<[f64; 2]> = pressure.zones().iter().map(|zone| zone.arcs).collect();
    let inf_sup = solution.inf_sup.get(at).copied().flatten();
    summary::ContactSummary {
        length: Some(boundary.length()),
        segments: Some(boundary.segments()),
        multiplier: Some(space_name(contact.pair.space).into()),
        h_ratio: Some(contact.segment_ratio),
        ends: Some([pair(boundary.point(knots[0])), pair(boundary.point(knots[knots.len() - 1]))]),
        closed_points: Some(closed.iter().map(|&[a, b]| [end(a), end(b)]).collect()),
        closed_edges: closed_edges(contact, &closed),
        closed: Some(closed),
        force: Some(force.force),
        unresolved_force: None,
        resultant: Some(pair(force.resultants[1])),
        moment: Some(force.moments[1]),
        pressure_max: Some(pressure.largest()),
        oscillation: pressure.oscillation(),
        inf_sup,
        zones: Vec::new(),
        missing: None,
        trust: None,
        slip: None,
        slip_error: None,
        rotation_error: None,
        corner_angle: None,
        corner_error: None,
        trust_force: None,
        lost_points: Some(problem.coupling.lost[at] + points.iter().filter(|point| !point.is_complete()).count()),
    }
}

/// What sliding and turning spoil. Where nothing presses, and so there are gaps along all `points`, the growth of bodies that
/// turn is compared with the smallest one.
pub fn motions(contact: &mut summary::ContactSummary, evaluation: &Evaluation, at: usize, points: Option<&[ContactPoint]>) {
    let found = evaluation.motions[at];
    contact.slip = found.and_then(|found| found.slip);
    contact.slip_error = found.and_then(|found| found.slip_error);
    let bodies = evaluation.problem.contacts[at].bodies.map(|body| &evaluation.deformations[body]);
    let idle = points.and_then(|points| growth_by_gap(bodies, points));
    contact.rotation_error = found.map(|found| found.rotation_error).or(idle);
}

/// Growth of two bodies by their turning, relative to the smallest gap; nothing if it is rounding beside their displacements.
fn growth_by_gap(bodies: [&Deformation; 2], points: &[ContactPoint]) -> Option<f64> {
    let growth: f64 = bodies.iter().map(|body| 0.5 * body.rotation * body.rotation * body.radius).sum();
    let moved = points.iter().map(|point| point.un_1.abs().max(point.un_2.abs())).fold(0.0, f64::max);
    let smallest = points.iter().map(|point| point.gap).filter(|gap| gap.is_finite()).reduce(f64::min)?;
    (growth > ROUNDING * moved).then(|| growth / smallest.max(NO_GAP * growth))
}

/// Name of a multiplier space in the case file.
fn space_name(space: MultiplierSpace) -> &'static str {
    match space {
        MultiplierSpace::P0 => "p0",
        MultiplierSpace::P1Discontinuous => "p1-discontinuous",
        MultiplierSpace::P1Continuous => "p1-continuous",
    }
}

/// Most edges of the softer body on an interval.
fn closed_edges(contact: &Contact, closed: &[[f64; 2]]) -> Option<f64> {
    let arcs = contact.boundary.arcs();
    let edges = |k: usize| (arcs[k + 1] - arcs[k]) / contact.edge_lengths[k];
    let on =
        |&[from, to]: &[f64; 2]| (0..contact.edge_lengths.len()).filter(|&k| arcs[k] >= from && arcs[k] < to).map(edges).sum();
    closed.iter().map(on).reduce(f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bodies_that_turn_grow_by_half_the_square_of_the_angle() {
        let turned = |rotation: f64| {
            let (place, middle) = (Point::zeros(), Point::zeros());
            Deformation { strain: 0.0, place, rotation, growth: 0.0, middle, radius: 3.0 }
        };
        let point = |gap: f64| ContactPoint { gap, un_1: 1e-4, un_2: -2e-4, ..ContactPoint::default() };
        let points = [point(0.02), point(0.01), point(f64::NAN)];
        let found = growth_by_gap([&turned(0.01), &turned(-0.02)], &points).expect("growth");
        assert!((found / (1.5 * (0.01f64.powi(2) + 0.02f64.powi(2)) / 0.01) - 1.0).abs() < 1e-12, "{found}");
        assert_eq!(growth_by_gap([&turned(1e-6), &turned(0.0)], &points), None, "rounding beside the displacements");
        assert_eq!(growth_by_gap([&turned(0.1), &turned(0.0)], &[]), None, "no gap");
    }
}
