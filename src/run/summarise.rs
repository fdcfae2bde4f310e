//! A solution in the terms of `summary.json`.

use super::solve::Solved;
use crate::case::Case;
use crate::contact::{MultiplierSpace, oscillation};
use crate::element::Order;
use crate::geometry::Point;
use crate::output::summary::{self, Summary};
use crate::petsc::versions;
use crate::system::recovery::{Balance, TracePoint};
use crate::system::{BoundaryStep, Contact, Discretisation, Estimate, Solution};

/// What is known without the solution's fields.
pub fn describe(summary: &mut Summary, case: &Case, problem: &Discretisation, solved: &Solved) {
    let solution = &solved.solution;
    let (scene, numbering) = (&problem.scene, &problem.finest().numbering);
    let count = numbering.level.triangles_per_edge();
    let triangles = scene.mesh.triangles.len() * count * count;
    let [shortest, longest] = scene.mesh.shortest_and_longest_edge(numbering.level);
    let corners = if scene.order == Order::P1 { numbering.node_count() } else { numbering.node_count() - edge_count(problem) };
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
    summary.outer = solution
        .steps
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
    let boundary = |step: &BoundaryStep| summary::BoundaryIteration {
        iteration: step.iteration,
        length: Some(step.length),
        moved: step.moved,
        du: step.du,
        flipped: step.flipped,
    };
    summary.boundaries = solution.boundaries.iter().map(boundary).collect();
    summary.solver = summary::Solver {
        name: Some(case.solver.choice.name().into()),
        krylov: Some(solved.solver.clone()),
        iterations: solution.steps.iter().map(|step| step.krylov_iterations).collect(),
        coarse: solved.coarse.clone(),
        residual: Some(solution.residual),
        plain_residual: Some(solution.plain_residual),
        blas: Some(versions::blas()),
    };
}

/// Triangle edges of the finest level: the midside nodes of P2.
fn edge_count(problem: &Discretisation) -> usize {
    let count = problem.finest().numbering.level.triangles_per_edge();
    let mesh = &problem.scene.mesh;
    mesh.edges.len() * count + mesh.triangles.len() * (3 * count * (count - 1) / 2)
}

/// Estimated discretisation errors.
pub fn estimate(summary: &mut Summary, problem: &Discretisation, estimate: &Estimate) {
    summary.estimate.energy = estimate.energy;
    for (at, contact) in problem.contacts.iter().enumerate() {
        let of = |errors: &[Option<f64>]| errors.get(at).copied().flatten();
        let errors = summary::ContactEstimate { force: of(&estimate.force), lambda: of(&estimate.pressure) };
        summary.estimate.contact.insert(contact.pair.name.clone(), errors);
    }
}

/// Energies and balances.
pub fn balances(summary: &mut Summary, problem: &Discretisation, balance: &Balance) {
    let names = problem.scene.bodies.iter().map(|body| body.name.clone());
    summary.energy = summary::Energy {
        strain: names.zip(balance.strain.iter().map(|&u| Some(u))).collect(),
        total: Some(balance.strain.iter().sum()),
        stationary: balance.stationary,
        external_work: Some(balance.external_work),
    };
    summary.balance =
        summary::Balance { force: balance.force, moment: balance.moment, energy: balance.energy, bodies: balance.bodies };
}

/// One contact; `at` is its place among all.
pub fn contact(
    problem: &Discretisation,
    at: usize,
    solution: &Solution,
    balance: &Balance,
    points: &[TracePoint],
) -> summary::Contact {
    let contact = &problem.contacts[at];
    let boundary = &contact.boundary;
    let knots = boundary.knots();
    let pair = |p: Point| [p.x, p.y];
    let force = &balance.contacts[at];
    let closed = closed(contact, &solution.active[contact.range()]);
    let end = |s: f64| pair(boundary.point(boundary.parameter_at(s)));
    let lambda = &solution.multipliers[contact.range()];
    let oscillation = oscillation(boundary, &contact.multipliers, lambda, &solution.active[contact.range()]);
    let inf_sup = solution.inf_sup.get(at).copied().flatten();
    summary::Contact {
        length: Some(boundary.length()),
        segments: Some(boundary.segments()),
        multiplier: Some(space_name(contact.pair.space).into()),
        h_ratio: Some(contact.segment_ratio),
        ends: Some([pair(boundary.point(knots[0])), pair(boundary.point(knots[knots.len() - 1]))]),
        closed_points: Some(closed.iter().map(|&[a, b]| [end(a), end(b)]).collect()),
        closed: Some(closed),
        force: Some(force.force),
        resultant: Some(pair(force.resultants[1])),
        moment: Some(force.moments[1]),
        pressure_max: Some(lambda.iter().copied().fold(f64::NEG_INFINITY, f64::max)),
        oscillation,
        inf_sup,
        trust: if contact.is_smaller_than_an_edge() { Some(false) } else { trust(inf_sup, oscillation) },
        lost_points: Some(problem.coupling.lost[at] + points.iter().filter(|point| !point.is_complete()).count()),
    }
}

/// A contact whose inf-sup constant is below this has pressures that its displacements do not control.
pub const LEAST_INF_SUP: f64 = 0.1;

/// A pressure with more alternation than this is not one.
pub const MOST_OSCILLATION: f64 = 0.05;

/// Whether a pressure can be trusted, as far as there are figures.
fn trust(inf_sup: Option<f64>, oscillation: Option<f64>) -> Option<bool> {
    let stable = inf_sup.map(|beta| beta >= LEAST_INF_SUP);
    let smooth = oscillation.map(|share| share <= MOST_OSCILLATION);
    match (stable, smooth) {
        (None, None) => None,
        (stable, smooth) => Some(stable.unwrap_or(true) && smooth.unwrap_or(true)),
    }
}

/// Why the pressures of some contacts cannot be trusted, and what to do; nothing if all can.
pub fn distrust(summary: &Summary) -> Option<String> {
    let words = |(name, contact): (&String, &summary::Contact)| {
        let figures = [
            contact
                .inf_sup
                .filter(|beta| *beta < LEAST_INF_SUP)
                .map(|beta| format!("inf-sup constant {beta:.3}, at least {LEAST_INF_SUP} wanted")),
            contact
                .oscillation
                .filter(|share| *share > MOST_OSCILLATION)
                .map(|share| format!("oscillation {share:.3}, at most {MOST_OSCILLATION} wanted")),
            contact.h_ratio.map(|ratio| format!("shortest segment {ratio:.2} edges of the softer body")),
        ];
        format!("contact {name} ({})", figures.into_iter().flatten().collect::<Vec<_>>().join("; "))
    };
    let bad: Vec<String> = summary.contact.iter().filter(|(_, contact)| contact.trust == Some(false)).map(words).collect();
    (!bad.is_empty()).then(|| {
        format!("{}; take fewer segments (\"auto\" is safe), stabilise = true, or another multiplier space", bad.join(", "))
    })
}

/// Name of a multiplier space in the case file.
fn space_name(space: MultiplierSpace) -> &'static str {
    match space {
        MultiplierSpace::P0 => "p0",
        MultiplierSpace::P1Discontinuous => "p1-discontinuous",
        MultiplierSpace::P1Continuous => "p1-continuous",
    }
}

/// Arc-length intervals of segments with an active multiplier.
fn closed(contact: &Contact, active: &[bool]) -> Vec<[f64; 2]> {
    let arcs = contact.boundary.arcs();
    let mut intervals: Vec<[f64; 2]> = Vec::new();
    for k in 0..contact.boundary.segments() {
        let rows = contact.multipliers.on_segment(k, 0.0).0;
        if !rows.iter().any(|&i| active[i]) {
            continue;
        }
        match intervals.last_mut() {
            Some([_, end]) if *end == arcs[k] => *end = arcs[k + 1],
            _ => intervals.push([arcs[k], arcs[k + 1]]),
        }
    }
    intervals
}
