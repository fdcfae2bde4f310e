//! A solution in the terms of `summary.json`.

use crate::case::Case;
use crate::contact::{MultiplierSpace, Zone};
use crate::discretisation::Contact;
use crate::element::Order;
use crate::geometry::Point;
use crate::output::summary::{self, Summary};
use crate::petsc::versions;
use crate::procedure::Solved;
use crate::recovery::{Corners, Evaluation, TracePoint};

/// From this error on λ may grow at a corner as it does towards a singular end.
const GROWS_AT_CORNERS: f64 = 5e-3;

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
    summary.outer = solved.passes.iter().map(Into::into).collect();
    summary.boundaries = solved.boundaries.iter().map(Into::into).collect();
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
        cycles: Some(solved.work()),
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
    let scene = &problem.scene;
    let names = scene.supports.iter().map(|support| &support.name).chain(scene.springs.iter().map(|springs| &springs.name));
    let moments = names.clone().map(|_| None).chain(balance.mean_moments.iter().map(|moment| Some(*moment)));
    let names = names.chain(scene.means.iter().map(|hold| &hold.name));
    let told = |(reaction, moment): (&Point, _)| summary::SupportSummary { reaction: Some((*reaction).into()), moment };
    summary.support = names.zip(balance.reactions.iter().zip(moments)).map(|(name, found)| (name.clone(), told(found))).collect();
    let rigid = scene.rigid.iter().zip(&balance.rigid).zip(&balance.motions);
    summary.rigid = rigid
        .map(|((set, &[x, y, moment]), motion)| {
            let about = Some(set.about.into());
            let told = summary::RigidSummary { motion: Some(*motion), about, force: Some([x, y]), moment: Some(moment) };
            (set.key.split_once('.').map_or(set.key.as_str(), |(_, name)| name).to_string(), told)
        })
        .collect();
    let bodies = &scene.bodies;
    let names = bodies.iter().map(|body| body.name.clone());
    let parts = scene.mesh.parts.iter().zip(&balance.strain_of_parts);
    let parts = parts.filter(|(part, _)| bodies[part.body as usize].has_parts());
    summary.energy = summary::Energy {
        strain: names.zip(balance.strain.iter().map(|&u| Some(u))).collect(),
        parts: parts.map(|(part, &u)| (part.name.clone(), Some(u))).collect(),
        total: Some(balance.strain.iter().sum()),
        stationary: balance.stationary,
        springs: balance.springs,
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
    let zones = pressure.zones();
    let mut closed: Vec<[f64; 2]> = zones.iter().flat_map(Zone::intervals).collect();
    closed.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let inf_sup = solution.inf_sup.get(at).copied().flatten();
    summary::ContactSummary {
        length: Some(boundary.length()),
        segments: Some(boundary.segments()),
        multiplier: Some(space_name(contact.pair.space).into()),
        h_ratio: Some(contact.segment_ratio),
        ends: Some([pair(boundary.point(knots[0])), pair(boundary.point(knots[knots.len() - 1]))]),
        closed_points: Some(closed.iter().map(|&[a, b]| [end(a), end(b)]).collect()),
        closed_edges: closed_edges(contact, &zones),
        closed: Some(closed),
        force: Some(force.force),
        unresolved_force: None,
        resultant: Some(pair(force.resultants[1])),
        place: place(points),
        moment: Some(force.moments[1]),
        pressure_max: Some(pressure.largest()),
        oscillation: pressure.oscillation(),
        inf_sup,
        zones: Vec::new(),
        missing: None,
        depth: Some(found.penetrations[at].depth),
        deepest: (found.penetrations[at].depth > 0.0).then(|| pair(found.penetrations[at].place)),
        approach: Some(found.penetrations[at].approach),
        missing_force: None,
        trust: None,
        verdict: None,
        slip: None,
        slip_at_ends: None,
        lost_at_ends: None,
        slip_error: None,
        rotation_error: None,
        corner_angle: None,
        corner_error: None,
        trust_force: None,
        lost_points: Some(problem.coupling.lost[at] + points.iter().filter(|point| !point.is_complete()).count()),
    }
}

/// The centre of the pressure, in either sign; where nothing presses, the point with the smallest gap.
fn place(points: &[TracePoint]) -> Option<[f64; 2]> {
    let parts = points.windows(2).map(|ends| {
        let [a, b] = [0, 1].map(|k| 0.5 * (ends[1].arc - ends[0].arc) * ends[k].lambda.abs());
        (a + b, a * ends[0].x + b * ends[1].x)
    });
    let (weight, moment) = parts.fold((0.0, Point::zeros()), |sum, part| (sum.0 + part.0, sum.1 + part.1));
    let nearest = || points.iter().filter(|point| point.gap.is_finite()).min_by(|a, b| a.gap.total_cmp(&b.gap));
    let place = if weight > 0.0 { Some(moment / weight) } else { nearest().map(|point| point.x) };
    place.map(Into::into)
}

/// What sliding and turning spoil. Where nothing presses, the growth of bodies that turn is compared with the smallest gap.
pub fn motions(contact: &mut summary::ContactSummary, evaluation: &Evaluation, at: usize, points: &[TracePoint]) {
    let found = evaluation.motions[at];
    contact.slip = found.and_then(|found| found.slip);
    contact.slip_error = found.and_then(|found| found.slip_error);
    let idle = contact.closed.as_ref().is_some_and(Vec::is_empty);
    let growth = || evaluation.growth_by_gap(at, points).filter(|_| idle);
    contact.rotation_error = found.map(|found| found.rotation_error).or_else(growth);
}

/// What corners do, if they do anything. Beside such corners λ grows, and what looks singular at an end may be one of them.
pub fn corners(contact: &mut summary::ContactSummary, zones: &mut [summary::ZoneSummary], corners: &Corners) {
    contact.corner_angle = Some(corners.angle.to_degrees());
    contact.corner_error = Some(corners.error);
    if corners.error > GROWS_AT_CORNERS {
        zones.iter_mut().for_each(|zone| zone.singular = Some(false));
    }
}

/// Name of a multiplier space in the case file.
fn space_name(space: MultiplierSpace) -> &'static str {
    match space {
        MultiplierSpace::P0 => "p0",
        MultiplierSpace::P1Discontinuous => "p1-discontinuous",
        MultiplierSpace::P1Continuous => "p1-continuous",
    }
}

/// Most edges of the softer body on a zone.
fn closed_edges(contact: &Contact, zones: &[Zone]) -> Option<f64> {
    zones.iter().map(|zone| contact.edges_on(zone)).reduce(f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn growth_beside_corners_that_matter_is_not_called_singular() {
        for (error, singular) in [(0.004, Some(true)), (0.006, Some(false))] {
            let (mut contact, mut zones) = (summary::ContactSummary::default(), [summary::ZoneSummary::default()]);
            zones[0].singular = Some(true);
            corners(&mut contact, &mut zones, &Corners { angle: std::f64::consts::PI / 18.0, error });
            assert_eq!((zones[0].singular, contact.corner_error), (singular, Some(error)));
            assert!((contact.corner_angle.unwrap_or(0.0) - 10.0).abs() < 1e-9);
        }
    }
}
