//! A solution made into a result folder.

use super::exact::{Errors, compare};
use super::report::{Report, memory};
use super::{Outcome, RunError, RunOptions, Stages, fields};
use crate::case::Case;
use crate::contact::{MultiplierSpace, softer_edge_length};
use crate::element::Order;
use crate::geometry::Point;
use crate::mesh::BoundaryEdge;
use crate::output::summary::{self, Status, Summary};
use crate::output::{ContactPoint, ResultFolder, plot, vtk, write_contact};
use crate::petsc::{Session, versions};
use crate::system::recovery::{Balance, TracePoint, balance, nodal_stress, probe, trace_points};
use crate::system::{Contact, Discretisation, Field, Solution, Verdict};

/// Evaluates a solution, writes everything, prints the verdict. **Collective**
#[allow(clippy::too_many_arguments)]
pub fn write(
    case: &Case,
    options: &RunOptions,
    problem: &Discretisation,
    solution: &Solution,
    solver_name: &str,
    stages: &Stages,
    report: &Report,
    folder: Option<ResultFolder>,
    session: &Session,
) -> Result<Outcome, RunError> {
    let mut summary = Summary::new(&case.name, session.size());
    let (mut status, mut reason) = match &solution.verdict {
        Verdict::Converged(words) => (Status::Converged, words.clone()),
        Verdict::NotConverged(words) => (Status::NotConverged, words.clone()),
    };
    describe(&mut summary, case, problem, solution, solver_name);
    if solution.is_solved() {
        let _stage = stages.output.enter();
        let errors = evaluate(&mut summary, case, options, problem, solution, session)?;
        for missed in &errors.missed {
            report.say(&format!("missed: {missed}"));
        }
        if !errors.missed.is_empty() && case.exact.must_hold && status == Status::Converged {
            status = Status::NotConverged;
            reason = format!("expected values are missed ({})", errors.missed.join("; "));
        }
        summary.errors = errors.values;
    }
    summary.status = status;
    summary.reason = Some(reason.clone());
    summary.time_s = report.times(stages, session);
    summary.memory_mib = memory(session);
    let finished = folder.map_or(Ok(()), |folder| finish(case, &summary, folder));
    session.agree(finished.map_err(|error| error.to_string())).map_err(RunError::Failed)?;
    report.table(&summary);
    let outcome = if status == Status::Converged { Outcome::Converged } else { Outcome::NotConverged };
    if outcome == Outcome::Converged {
        report.say(&format!("mezha: converged: {reason}"));
    } else {
        report.say(&format!("mezha: NOT converged: {reason}"));
    }
    report.say(&format!("results in {}", options.out.display()));
    Ok(outcome)
}

fn finish(case: &Case, summary: &Summary, folder: ResultFolder) -> Result<(), crate::output::OutputError> {
    let file = folder.path("case.toml");
    std::fs::write(&file, case.resolved()).map_err(|source| crate::output::OutputError::Io {
        action: "write",
        path: file.clone(),
        source,
    })?;
    summary.write(&folder.path("summary.json"))?;
    folder.commit()
}

/// What is known without the solution's fields.
fn describe(summary: &mut Summary, case: &Case, problem: &Discretisation, solution: &Solution, solver_name: &str) {
    let (scene, numbering) = (&problem.scene, &problem.finest().numbering);
    let count = numbering.level.triangles_per_edge();
    let triangles = scene.mesh.triangles.len() * count * count;
    let lengths = (0..scene.mesh.edges.len()).map(|edge| scene.mesh.edge_length(edge as u32) / count as f64);
    let corners = if scene.order == Order::P1 { numbering.node_count() } else { numbering.node_count() - edge_count(problem) };
    summary.mesh = summary::Mesh {
        triangles: Some(triangles as u64),
        vertices: Some(corners as u64),
        order: Some(scene.order.degree() as u8),
        h_min: Some(lengths.clone().fold(f64::INFINITY, f64::min)),
        h_max: Some(lengths.fold(0.0, f64::max)),
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
            active: Some(step.active),
            added: Some(step.added),
            released: Some(step.released),
            krylov_iterations: Some(step.krylov_iterations),
            residual: Some(step.residual),
            max_penetration: Some(step.max_penetration),
            du: Some(step.du),
        })
        .collect();
    summary.solver = summary::Solver {
        name: Some(case.solver.choice.name().into()),
        krylov: Some(solver_name.into()),
        iterations: solution.steps.iter().map(|step| step.krylov_iterations).collect(),
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

/// Fields, traces, balances and errors; their files too. **Collective**
fn evaluate(
    summary: &mut Summary,
    case: &Case,
    options: &RunOptions,
    problem: &Discretisation,
    solution: &Solution,
    session: &Session,
) -> Result<Errors, RunError> {
    let scene = &problem.scene;
    let u = Field::displacement(problem, &solution.displacement, session)?;
    let balance = balance(problem, solution, &u, session)?;
    let names = scene.bodies.iter().map(|body| body.name.clone());
    summary.energy = summary::Energy {
        strain: names.zip(balance.strain.iter().map(|&u| Some(u))).collect(),
        total: Some(balance.strain.iter().sum()),
        external_work: Some(balance.external_work),
    };
    summary.balance =
        summary::Balance { force: balance.force, moment: balance.moment, energy: balance.energy, bodies: balance.bodies };
    let mut traces = Vec::new();
    for (at, contact) in problem.contacts.iter().enumerate() {
        let points = trace_points(problem, contact, &solution.multipliers[contact.range()], &u, session)?;
        summary.contact.insert(contact.pair.name.clone(), contact_summary(contact, at, problem, solution, &balance, &points));
        traces.push(contact_points(contact, &points));
    }
    for point in &case.probes {
        let body = scene.bodies.iter().position(|body| body.name == point.body).expect("checked names");
        let Some(found) = probe(problem, &u, body, Point::new(point.point[0], point.point[1]), session)? else {
            return Err(RunError::Input(format!(
                "{}: probe.{}.point lies outside body \"{}\"",
                case.file.display(),
                point.name,
                point.body
            )));
        };
        let [xx, yy, xy, _] = found.stress;
        let values = summary::Probe { x: Some(point.point), u: Some(found.displacement.into()), stress: Some([xx, yy, xy]) };
        summary.probe.insert(point.name.clone(), values);
    }
    let errors = compare(case, problem, solution, &balance, &u, session)?;
    write_files(case, options, problem, &u, &traces, session)?;
    Ok(errors)
}

fn write_files(
    case: &Case,
    options: &RunOptions,
    problem: &Discretisation,
    u: &Field<2>,
    traces: &[Vec<ContactPoint>],
    session: &Session,
) -> Result<(), RunError> {
    let folder = ResultFolder::temporary_path(&options.out);
    let stress = nodal_stress(problem, u, session)?;
    let written = fields::write(&folder, problem, u, &stress, session);
    session.agree(written).map_err(RunError::Failed)?;
    let facets = fields::facets(problem, u, &stress, session);
    if session.rank() != 0 {
        return Ok(());
    }
    let title = if case.title.is_empty() { &case.name } else { &case.title };
    for (contact, points) in problem.contacts.iter().zip(traces) {
        let name = &contact.pair.name;
        write_contact(&folder.join(format!("contact_{name}.csv")), &[], points)?;
        vtk::write_curve(&folder.join(format!("contact_{name}.vtu")), points)?;
        plot::write_pressure(&folder.join(format!("pressure_{name}.svg")), title, points)?;
        plot::write_displacement(&folder.join(format!("displacement_{name}.svg")), title, points)?;
    }
    let lines: Vec<&[ContactPoint]> = traces.iter().map(Vec::as_slice).collect();
    plot::write_deformed(&folder.join("deformed.svg"), title, None, &facets, &lines)?;
    Ok(())
}

fn contact_summary(
    contact: &Contact,
    at: usize,
    problem: &Discretisation,
    solution: &Solution,
    balance: &Balance,
    points: &[TracePoint],
) -> summary::Contact {
    let boundary = &contact.boundary;
    let knots = boundary.knots();
    let pair = |p: Point| [p.x, p.y];
    let force = &balance.contacts[at];
    let closed = closed(contact, &solution.active[contact.range()]);
    let end = |s: f64| pair(boundary.point(boundary.parameter_at(s)));
    let young = contact.bodies.map(|body| problem.scene.bodies[body].material.young);
    let edges = [0, 1].map(|k| {
        let edges = problem.scene.mesh.boundary(&contact.pair.between[k]).map(|b| b.edges.as_slice()).unwrap_or(&[]);
        edges.iter().flat_map(|&edge| BoundaryEdge::all_of(&problem.scene.mesh, edge, &problem.finest().numbering)).collect()
    });
    let shortest = (0..boundary.segments()).map(|k| boundary.segment_length(k)).fold(f64::INFINITY, f64::min);
    summary::Contact {
        length: Some(boundary.length()),
        segments: Some(boundary.segments()),
        multiplier: Some(space_name(contact.pair.space).into()),
        h_ratio: Some(shortest / softer_edge_length(&edges, young)),
        ends: Some([pair(boundary.point(knots[0])), pair(boundary.point(knots[knots.len() - 1]))]),
        closed_points: Some(closed.iter().map(|&[a, b]| [end(a), end(b)]).collect()),
        closed: Some(closed),
        force: Some(force.force),
        resultant: Some(pair(force.resultants[1])),
        moment: Some(force.moments[1]),
        pressure_max: Some(solution.multipliers[contact.range()].iter().copied().fold(f64::NEG_INFINITY, f64::max)),
        lost_points: Some(points.iter().filter(|point| !point.is_complete()).count()),
        ..Default::default()
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

fn contact_points(contact: &Contact, points: &[TracePoint]) -> Vec<ContactPoint> {
    use crate::contact::GapChoice;
    let initial = |p: &TracePoint| match &contact.pair.gap {
        GapChoice::Closed => 0.0,
        GapChoice::Formula(formula) => formula.value(&[p.x.x, p.x.y]),
        GapChoice::Geometry => p.distance[1] - p.distance[0],
    };
    let one = |p: &TracePoint| ContactPoint {
        s: p.arc,
        x: p.x.x,
        y: p.x.y,
        nx: p.normal.x,
        ny: p.normal.y,
        lambda: p.lambda,
        gap: initial(p) + p.displacement[1] - p.displacement[0],
        un_1: p.displacement[0],
        un_2: p.displacement[1],
        sigma_1: p.stress[0],
        sigma_2: p.stress[1],
    };
    points.iter().map(one).collect()
}
